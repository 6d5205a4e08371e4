// SPDX-License-Identifier: GPL-3.0-or-later
/// The remaining tables of typed spaces, knots and rules for terms, measured: two rates over many fast
/// periods, exponential fitting, a whole orbit as one step, the spring pendulum, and bands of Kronrod's
/// rules.
#include <QTest>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::own_tables_test {
namespace {

using tests::after, tests::apart;

std::string gauss(int nodes) { return "{\"type\": \"gauss\", \"nodes\": " + std::to_string(nodes) + "}"; }
std::string polynomials(int degree) {
    return "{\"type\": \"polynomial\", \"degree\": " + std::to_string(degree) + "}";
}

ReadScene read(const std::string& problem, const std::string& space, const std::string& rule, double h,
               const std::string& more = "") {
    return readScene("{\"extremal\": 1, " + problem + ", \"time\": {\"end\": 20}, \"schemes\": [{\"step\": " +
                     formatNumber(h) + ", \"allow_unstable\": true, \"space\": " + space +
                     (rule.empty() ? "" : ", \"quadrature\": " + rule) + more + "}]}");
}

/// The first coordinate after 0, `every`, 2 `every`, .. steps; ends where a step fails.
std::vector<double> positions(const ReadScene& scene, int steps, int every) {
    const auto integrator = tests::integratorOf(scene);
    const double h = scene.resolved->schemes[0].spec.step.value;
    State state = scene.resolved->initial;
    integrator->begin(state);
    std::vector<double> x{state.x[0]};
    for (int k = 1; k <= steps; ++k) {
        if (integrator->advance(state, k * h).outcome != Outcome::converged) break;
        if (k % every == 0) x.push_back(state.x[0]);
    }
    return x;
}

/// The largest error of the energy over all nodes up to t = 10.
double energyError(const std::string& space, const std::string& rule, double h) {
    const ReadScene scene = read(
        "\"model\": {\"type\": \"spring-pendulum\", \"k\": 10000}, \"initial\": "
        "{\"q\": [0.05, 1], \"p\": [0, 0]}",
        space, rule, h);
    const auto integrator = tests::integratorOf(scene);
    const EnergyFunction energy = energyOf(*scene.resolved->system);
    State state = scene.resolved->initial;
    integrator->begin(state);
    const double start = energy(state.t, state.x.data());
    double worst = 0;
    for (int k = 1; k * h < 10 + h / 2; ++k) {
        if (integrator->advance(state, k * h).outcome != Outcome::converged) return HUGE_VAL;
        worst = std::max(worst, std::abs(energy(state.t, state.x.data()) - start));
    }
    return worst;
}

/// Where Kepler's orbit with major half axis 1, eccentricity e and period 1 is at time tau, from apocentre.
Eigen::Vector2d onOrbit(double tau, double e) {
    double E = 2 * std::numbers::pi * tau;
    for (int i = 0; i < 100; ++i)
        E -= (E + e * std::sin(E) - 2 * std::numbers::pi * tau) / (1 + e * std::cos(E));
    return {-std::cos(E) - e, -std::sqrt(1 - e * e) * std::sin(E)};
}

/// One step of a whole period of Kepler's problem from apocentre.
class OrbitStep {
public:
    OrbitStep(const Table<double>& table, double e)
        : table_(table),
          m_(table.unknowns()),
          q0_(onOrbit(0, e)),
          p0_(0, -std::sqrt((1 - e) / (1 + e))),
          force_(table.nodes(), 2) {
        Eigen::MatrixXd places(table.nodes(), 2);
        for (Eigen::Index i = 0; i < places.rows(); ++i)
            places.row(i) = (onOrbit(table.node(i), e) - q0_).transpose();
        Y_ = (table.value.transpose() * table.value)
                 .eval()
                 .partialPivLu()
                 .solve(Eigen::MatrixXd(table.value.transpose() * places));
    }

    /// The distance of its end, in positions and momenta, from the start; by Newton's method from the orbit.
    double error() {
        double change = 1;
        for (int iteration = 0; iteration < 60 && change > 1e-10; ++iteration) {
            evaluate();
            const Eigen::VectorXd correction = J_.partialPivLu().solve(R_);
            change = correction.cwiseAbs().maxCoeff();
            for (Eigen::Index a = 0; a < m_; ++a)
                for (int k = 0; k < 2; ++k) Y_(a, k) -= correction(2 * a + k);
        }
        if (!(change <= 1e-10)) return HUGE_VAL;
        const Eigen::Vector2d change_p = h * force_.transpose() * table_.weight;
        return std::max(Y_.row(m_ - 1).cwiseAbs().maxCoeff(), change_p.cwiseAbs().maxCoeff());
    }

private:
    static constexpr double h = 2 * std::numbers::pi;

    void evaluate() {
        J_ = Eigen::MatrixXd::Zero(2 * m_, 2 * m_);
        R_ = Eigen::VectorXd::Zero(2 * m_);
        for (Eigen::Index i = 0; i < table_.nodes(); ++i) {
            const Eigen::Vector2d q = q0_ + Y_.transpose() * table_.value.row(i).transpose(),
                                  v = Y_.transpose() * table_.derivative.row(i).transpose() / h;
            const double r = q.norm();
            force_.row(i) = -q.transpose() / (r * r * r);
            const Eigen::Matrix2d slope =
                3 * q * q.transpose() / std::pow(r, 5) - Eigen::Matrix2d::Identity() / (r * r * r);
            const Eigen::VectorXd test = table_.testValue.row(i), dTest = table_.testDerivative.row(i),
                                  phi = table_.value.row(i), dPhi = table_.derivative.row(i);
            for (int k = 0; k < 2; ++k)
                for (Eigen::Index a = 0; a < m_; ++a) {
                    R_(2 * a + k) += table_.weight(i) * (h * force_(i, k) * test(a) + v(k) * dTest(a));
                    for (int l = 0; l < 2; ++l)
                        for (Eigen::Index b = 0; b < m_; ++b)
                            J_(2 * a + k, 2 * b + l) +=
                                table_.weight(i) *
                                (h * slope(k, l) * test(a) * phi(b) + (k == l ? dTest(a) * dPhi(b) / h : 0));
                }
        }
        R_.tail(2) += p0_;
    }

    const Table<double>& table_;
    Eigen::Index m_;
    Eigen::Vector2d q0_, p0_;
    Eigen::MatrixXd Y_, force_, J_;
    Eigen::VectorXd R_;
};

}  // namespace

class OwnTablesTest : public QObject {
    Q_OBJECT
private slots:
    /// y has three periods in a macro step, which neither its last curve nor a parabola follows.
    void twoRatesRunOverManyFastPeriods() {
        const std::string problem =
            "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\", \"y\"], \"parameters\": {}, "
            "\"lagrangian\": {\"kinetic\": \"(x_t^2+y_t^2)/2\", \"fast\": \"-2500*(1+x^2/2)*y^2/2\", "
            "\"slow\": \"-x^2/2-x^4/4\"}}, \"initial\": {\"q\": [1, 0], \"v\": [0, 1]}";
        const auto exact = positions(read(problem, polynomials(6), gauss(6), 0.005), 1920, 64);
        const auto errorOf = [&](const std::vector<double>& x) { return apart(x, exact); };
        const std::string two =
            "{\"otherwise\": \"midpoint\", \"slow\": {\"type\": \"trapezoid\", "
            "\"panels\": 1}}";
        const double one = errorOf(positions(read(problem, polynomials(1), "\"midpoint\"", 0.01), 960, 32)),
                     rates = errorOf(
                         positions(read(problem,
                                        "{\"type\": \"by-coordinate\", \"otherwise\": " + polynomials(1) +
                                            ", \"variables\": {\"y\": {\"type\": \"spline\", \"degree\": "
                                            "1, \"cells\": 32}}}",
                                        two, 0.32),
                                   30, 1));
        qInfo("two rates %.4f of 0.029, one rate %.4f of 0.038", rates, one);
        QVERIFY(std::abs(one / 0.038 - 1) < 0.03);    // 0.0377
        QVERIFY(std::abs(rates / 0.029 - 1) < 0.08);  // 0.0310
    }

    /// {1, tau, exp(-z tau), exp(z tau - z)} contains the motions of q'' = lambda^2 q, z = lambda h.
    void exponentialsAreExactOnTheRepeller_data() {
        QTest::addColumn<double>("z");
        QTest::addColumn<double>("bound");
        QTest::newRow("2") << 2.0 << 2e-15;   // 6e-16
        QTest::newRow("6") << 6.0 << 1e-14;   // 2e-15
        QTest::newRow("20") << 20.0 << 1e-6;  // 2.9e-7, and e^20 eps = 1.1e-7
    }
    void exponentialsAreExactOnTheRepeller() {
        QFETCH(double, z);
        QFETCH(double, bound);
        // Rounding errors grow by exp(z): at 20 no iteration ends at round-off.
        const std::string problem =
            "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\"], \"parameters\": {\"l\": " +
            formatNumber(z) +
            "}, \"lagrangian\": \"(x_t^2 + l^2*x^2)/2\"}, \"initial\": {\"q\": [1], \"v\": "
            "[0]}";
        const auto errorOf = [&](const std::string& functions) {
            const auto x = after(
                read(problem,
                     "{\"type\": \"typed\", \"functions\": " + functions + ", \"let\": {\"z\": \"l*h\"}}", "",
                     1, z > 10 ? ", \"solver\": {\"tolerance\": 1e-6}" : ""),
                1);
            return x.empty() ? HUGE_VAL : std::abs(x[0] / std::cosh(z) - 1);
        };
        const double fitted = errorOf("[\"1\", \"tau\", \"exp(-z*tau)\", \"exp(z*tau-z)\"]"),
                     cubics = errorOf("[\"1\", \"tau\", \"tau^2\", \"tau^3\"]");
        qInfo("fitted %.1e, cubics %.1e", fitted, cubics);
        QVERIFY(fitted < bound);
        QVERIFY(cubics > 1e3 * fitted);
    }

    /// A period of Kepler's problem, e = 0.9, in 24 cubic cells: at equal eccentric anomalies, or equal.
    void knotsFollowTheOrbit() {
        constexpr double e = 0.9;
        Value::Array knots;
        for (int j = 1; j < 24; ++j) {
            const double E = 2 * std::numbers::pi * j / 24;
            knots.emplace_back((E + e * std::sin(E)) / (2 * std::numbers::pi));
        }
        const Settings rule{"gauss", {{"nodes", 3.0}, {"panels", 24.0}}, {}};
        const auto errorOf = [&](const Value& cells, const Value& at) {
            const Table<double> table =
                tableOf({"spline", {{"degree", 3.0}, {"cells", cells}, {"knots", at}}, {}}, rule);
            return OrbitStep(table, e).error();
        };
        const double own = errorOf(Value(), knots), equal = errorOf(24.0, Value());
        qInfo("own knots %.2e, equal cells %.3g", own, equal);
        QVERIFY(own < 0.06);
        QVERIFY(equal > 10);
    }

    /// Gravity, which is slow and cheap, under rules of its own.
    void theSpringPendulumKeepsItsEnergyUnderPoorerRulesForGravity_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<double>("step");
        QTest::addColumn<double>("error");
        QTest::addColumn<double>("within");
        const QString fine = QString::fromStdString(gauss(4)), slow = R"({"otherwise": %1, "slow": %2})";
        QTest::newRow("midpoint") << 1 << "\"midpoint\"" << 0.01 << 3.7e-3 << 0.02;
        QTest::newRow("gravity by the trapezoidal rule")
            << 1 << slow.arg("\"midpoint\"", "\"trapezoid\"") << 0.01 << 3.4e-3 << 0.02;
        // 3.06 at the worst node of this start.
        QTest::newRow("all by the trapezoidal rule") << 1 << "\"trapezoid\"" << 0.01 << 2.6 << 0.2;
        QTest::newRow("4 nodes") << 4 << fine << 0.05 << 1.6e-3 << 0.03;
        QTest::newRow("gravity by 3 nodes")
            << 4 << slow.arg(fine, QString::fromStdString(gauss(3))) << 0.05 << 1.6e-3 << 0.03;
        QTest::newRow("gravity by 2 nodes")
            << 4 << slow.arg(fine, QString::fromStdString(gauss(2))) << 0.05 << 0.27 << 0.02;
    }
    void theSpringPendulumKeepsItsEnergyUnderPoorerRulesForGravity() {
        QFETCH(int, degree);
        QFETCH(QString, rule);
        QFETCH(double, step);
        QFETCH(double, error);
        QFETCH(double, within);
        const double found = energyError(polynomials(degree), rule.toStdString(), step);
        qInfo("%.3g of %.2g", found, error);
        QVERIFY(std::abs(found / error - 1) < within);
    }

    /// On quartic polynomials half the trace passes -1 by some 1e-7 near pi, in a band as wide as 1e-3; where
    /// growth can be seen is far beyond.
    void bandsOfKronrodRulesAtPiAreNarrow_data() {
        QTest::addColumn<QString>("nodes");
        QTest::addColumn<double>("excess");
        QTest::addColumn<double>("limit");
        QTest::newRow("5") << "(1-sqrt(6/7))/2; (1-sqrt(1/3))/2; 1/2; (1+sqrt(1/3))/2; (1+sqrt(6/7))/2"
                           << 1.6e-7 << 6.25;
        QTest::newRow("7") << "(1-sqrt(5/9+sqrt(40/297)))/2; (1-sqrt(3/5))/2; (1-sqrt(5/9-sqrt(40/297)))/2; "
                              "1/2; (1+sqrt(5/9-sqrt(40/297)))/2; (1+sqrt(3/5))/2; "
                              "(1+sqrt(5/9+sqrt(40/297)))/2"
                           << 9.0e-8 << 6.31;
    }
    void bandsOfKronrodRulesAtPiAreNarrow() {
        QFETCH(QString, nodes);
        QFETCH(double, excess);
        QFETCH(double, limit);
        Value::Array c;
        for (const QString& node : nodes.split("; ")) c.emplace_back(node.toStdString());
        const Table<double> table =
            tableOf({"polynomial", {{"degree", 4.0}, {"basis", "lobatto"}}, {}},
                    {"nodes", {{"nodes", c}, {"weights", Value()}, {"panels", 1.0}}, {}});
        double highest = 0, first = 0, last = 0, next = 0;
        for (double z = 3.1; z < 3.2; z += 1e-5) {
            const double over = std::abs(halfTrace(table, z)) - 1;
            highest = std::max(highest, over);
            if (over > 1e-10) last = z;
            if (over > 1e-10 && first == 0) first = z;
        }
        for (double z = 3.2; z < 7 && next == 0; z += 1e-3)
            if (std::abs(halfTrace(table, z)) > 1 + 1e-9) next = z;
        qInfo("%.2e above 1 from %.5f to %.5f, then from %.3f", highest, first, last, next);
        QVERIFY(std::abs(highest / excess - 1) < 0.05);
        QVERIFY(last - first < 2e-3);
        QVERIFY(std::abs(next - limit) < 0.006);
    }

    /// Powers at an end, and poles near it, take panels that become narrower there.
    void automaticRulesAreGradedWhereTheyMustBe_data() {
        QTest::addColumn<QString>("function");
        QTest::addColumn<int>("most");
        QTest::newRow("power") << "tau^1.5" << 192;
        QTest::newRow("pole") << "1/(1.001-tau)" << 192;
        QTest::newRow("power at the end") << "(1-tau)^1.5" << 192;
    }
    void automaticRulesAreGradedWhereTheyMustBe() {
        QFETCH(QString, function);
        QFETCH(int, most);
        const Settings space{"typed",
                             {{"functions", Value::Array{"1", "tau", function.toStdString()}},
                              {"let", Value::Object{}},
                              {"knots", Value::Array{}}},
                             {}};
        const Table<double> table = tableOf(space, {"auto", {}, {}});
        const Eigen::VectorXd K = kineticValues(table);
        const double defect = consistencyDefects(table, 1).front();
        qInfo("%d nodes in %d panels, K to %.1e, D(0) %.1e", table.nodes(), table.rule.panels,
              std::abs(K(0) - 1), defect);
        QVERIFY(table.nodes() <= most);
        QVERIFY(defect < 1e-12);
        QVERIFY(table.consistency >= 1);
    }

    /// The functions inside a step are orthonormal in their slopes to round-off, in splines of any cells.
    void kineticEnergyOfExactRulesIsTheUnitMatrix_data() {
        QTest::addColumn<QString>("type");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("cells");
        for (const auto& [degree, cells] : {std::pair{1, 5}, {2, 2}, {3, 32}})
            QTest::addRow("splines %d, %d cells", degree, cells) << "spline" << degree << cells;
    }
    void kineticEnergyOfExactRulesIsTheUnitMatrix() {
        QFETCH(QString, type);
        QFETCH(int, degree);
        QFETCH(int, cells);
        Settings space{type.toStdString(), {{"degree", static_cast<double>(degree)}}, {}};
        if (cells > 1)
            space.keys.emplace_back("cells", static_cast<double>(cells));
        else
            space.keys.emplace_back("basis", "lobatto");
        const Settings rule{
            "gauss", {{"nodes", static_cast<double>(degree)}, {"panels", static_cast<double>(cells)}}, {}};
        const Eigen::VectorXd K = kineticValues(tableOf(space, rule));
        const double defect = (K.array() - 1).abs().maxCoeff();
        qInfo("%.1e", defect);
        QVERIFY(defect < 1e-12);
    }
};

EXTREMAL_TEST(OwnTablesTest)

}  // namespace extremal::own_tables_test

#include "own_tables_test.moc"
