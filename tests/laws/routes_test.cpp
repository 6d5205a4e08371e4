// SPDX-License-Identifier: GPL-3.0-or-later
/// The same step by independent routes agrees to round-off.
#include <QTest>

#include <random>

#include "engine/model/parts/constraint.hpp"
#include "engine/quadrature/rule.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::routes_test {
namespace {

State randomState(std::mt19937& random, const System& system) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    State s;
    for (int i = 0; i < 2 * system.dimension(); ++i) s.x.push_back(uniform(random));
    if (system.id == "kepler") s.x[0] += s.x[0] > 0 ? 1 : -1;
    if (system.id == "spring-pendulum") s.x[0] *= 0.05;
    return s;
}

/// Largest difference of one step relative to the largest entry, over random states.
double stepDifference(const System& system, Integrator& a, Integrator& b) {
    std::mt19937 random(7);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        const State start = randomState(random, system);
        const auto x = after(a, start, 1), y = after(b, start, 1);
        if (!x || !y) return 1e300;
        double scale = 0, difference = 0;
        for (std::size_t k = 0; k < start.x.size(); ++k) {
            scale = std::max(scale, std::abs(x->x[k]));
            difference = std::max(difference, std::abs(x->x[k] - y->x[k]));
        }
        worst = std::max(worst, difference / scale);
    }
    return worst;
}

/// Partitioned Runge-Kutta step by fixed-point iteration, q' = p/m, p' = f(q), from the nodes and weights
/// alone: A_ij = int_0^{c_i} l_j and Ahat from symplecticity, b_i Ahat_ij + b_j A_ji = b_i b_j.
std::vector<double> partitionedRungeKutta(const Rule<double>& rule, const System& system,
                                          const std::vector<double>& x, double h) {
    const auto n = static_cast<std::size_t>(rule.size()), d = system.coordinates.size();
    std::vector<std::vector<double>> A(n, std::vector<double>(n)), Ahat = A;
    const Rule<double> fine = gauss<double>(static_cast<int>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < n; ++k) {
                double l = rule.c[i] * fine.b[k];
                for (std::size_t m = 0; m < n; ++m)
                    if (m != j) l *= (rule.c[i] * fine.c[k] - rule.c[m]) / (rule.c[j] - rule.c[m]);
                A[i][j] += l;
            }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) Ahat[i][j] = rule.b[j] * (1 - A[j][i] / rule.b[i]);
    const auto& mech = system.mechanics();
    std::vector<double> Q(n * d), P(n * d), F(n * d);
    for (std::size_t i = 0; i < n * d; ++i) {
        Q[i] = x[i % d];
        P[i] = x[d + i % d];
    }
    for (int iteration = 0; iteration < 300; ++iteration) {
        for (std::size_t i = 0; i < n; ++i) mech.force(mech.model.get(), 0, &Q[i * d], &F[i * d]);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < d; ++k) {
                double q = x[k], p = x[d + k];
                for (std::size_t j = 0; j < n; ++j) {
                    q += h * A[i][j] * P[j * d + k] / mech.masses[k];
                    p += h * Ahat[i][j] * F[j * d + k];
                }
                Q[i * d + k] = q;
                P[i * d + k] = p;
            }
    }
    std::vector<double> end = x;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < d; ++k) {
            end[k] += h * rule.b[i] * P[i * d + k] / mech.masses[k];
            end[d + k] += h * rule.b[i] * F[i * d + k];
        }
    return end;
}

/// Hamilton's equations are all of its motion: no constraint.
bool isFree(const System& s) { return s.hasCoordinates() && !s.parts.find<Constraint>(); }

}  // namespace

class RoutesTest : public QObject {
    Q_OBJECT
private slots:
    void degreeOneWithTheMidpointIsTheMidpointRule() {
        for (const ModelEntry& e : modelCatalog()) {
            const System s = systemNamed(e.item.id);
            if (!isFree(s)) continue;
            const auto discretization = makeIntegrator(s, polynomialPair(1, {"midpoint", {}, {}}), {0, 0.02});
            const auto rule = findBaseline("implicit-midpoint")->make(s, {0.02, {}, 0, {}});
            const double difference = stepDifference(s, *discretization, *rule);
            qInfo("%s: %.2e", e.item.id.c_str(), difference);
            QVERIFY(difference < 1e-13);
        }
    }
    void degreeOneWithTheTrapezoidIsVerletWhereSeparable() {
        for (const char* id : {"kepler", "pendulum", "harmonic-oscillator"}) {
            const System s = systemNamed(id);
            const auto discretization =
                makeIntegrator(s, polynomialPair(1, {"trapezoid", {}, {}}), {0, 0.05});
            const auto verlet = findBaseline("stormer-verlet")->make(s, {0.05, {}, 0, {}});
            QVERIFY(stepDifference(s, *discretization, *verlet) < 1e-14);
        }
    }
    void everyBasisGivesTheSameStep_data() {
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 3, 5, 8, 12, 16, 20, 24}) QTest::addRow("degree %d", degree) << degree;
    }
    void everyBasisGivesTheSameStep() {
        QFETCH(int, degree);
        for (const char* id : {"kepler", "spring-pendulum"}) {
            const System s = systemNamed(id);
            const auto nodal = makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}), {0, 0.02});
            for (const char* basis : {"chebyshev", "equispaced", "legendre", "chebyshev-modal"}) {
                const auto other =
                    makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}, basis), {0, 0.02});
                const double difference = stepDifference(s, *nodal, *other);
                qInfo("%s, %s: %.2e", id, basis, difference);
                QVERIFY(difference < 2e-14);  // measured: below 2e-15, at degree 24 as well
            }
        }
    }
    void everyBasisGivesTheSameCurve() {
        // The curve alone is evaluated in the basis: cardinal functions of equispaced points reach 1e5 at
        // degree 24.
        const System s = systemNamed("kepler");
        for (const int degree : {3, 12, 24})
            for (const char* basis : {"chebyshev", "equispaced", "legendre", "chebyshev-modal"}) {
                const auto a = makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}), {0, 0.2});
                const auto b = makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}, basis), {0, 0.2});
                QVERIFY(after(*a, keplerStart, 1) && after(*b, keplerStart, 1));
                std::vector<double> x(4), y(4);
                double worst = 0;
                for (double tau = 0; tau <= 1; tau += 0.01) {
                    a->denseOutput(tau, x);
                    b->denseOutput(tau, y);
                    worst = std::max(worst, distance(x, y, 0, 4));
                }
                qInfo("degree %d, %s: %.2e", degree, basis, worst);
                QVERIFY(worst < (degree == 24 && std::string(basis) == "equispaced" ? 1e-9 : 1e-12));
            }
    }
    void splinesOfDegreeOneAreAsManySteps() {
        // A broken line with n cells is n steps of straight lines: the stationarity conditions at its knots
        // are the discrete Euler-Lagrange equations. With both ends of a cell as nodes, each side of a knot
        // has its own.
        for (const char* id : {"kepler", "spring-pendulum"}) {
            const System s = systemNamed(id);
            for (const char* rule : {"gauss", "trapezoid", "radau"}) {
                const auto one = makeIntegrator(s, splinePair(1, 5, {rule, {}, {}}), {0, 0.05});
                const auto five = makeIntegrator(s, polynomialPair(1, {rule, {}, {}}), {0, 0.01});
                std::mt19937 random(3);
                double worst = 0;
                for (int i = 0; i < 50; ++i) {
                    const State start = randomState(random, s);
                    const auto x = after(*one, start, 1), y = after(*five, start, 5);
                    QVERIFY(x && y);
                    worst = std::max(worst, distance(x->x, y->x, 0, x->x.size()));
                }
                qInfo("%s, %s: %.2e", id, rule, worst);
                QVERIFY(worst < 5e-13);
            }
        }
    }
    void splinesOfOneCellArePolynomials() {
        const System s = systemNamed("kepler");
        for (const int degree : {1, 3, 8, 24}) {
            const auto one = makeIntegrator(s, splinePair(degree, 1, {"gauss", {}, {}}), {0, 0.02});
            const auto other = makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}), {0, 0.02});
            const double difference = stepDifference(s, *one, *other);
            qInfo("degree %d: %.2e", degree, difference);
            QVERIFY(difference < 2e-14);
        }
    }
    void gaussAndLobattoPairsAreTheirRungeKuttaMethods() {
        for (const char* id : {"kepler", "pendulum"}) {
            const System s = systemNamed(id);
            std::mt19937 random(11);
            for (int degree = 1; degree <= 4; ++degree)
                for (const bool isGauss : {true, false}) {
                    const Rule<double> rule = isGauss ? gauss<double>(degree) : lobatto<double>(degree + 1);
                    const auto discretization = makeIntegrator(
                        s, polynomialPair(degree, {isGauss ? "gauss" : "lobatto", {}, {}}), {0, 0.05});
                    double worst = 0;
                    for (int i = 0; i < 50; ++i) {
                        const State start = randomState(random, s);
                        const State end = after(*discretization, start, 1).value();
                        const auto expected = partitionedRungeKutta(rule, s, start.x, 0.05);
                        worst = std::max(worst, distance(end.x, expected, 0, expected.size()));
                    }
                    qInfo("%s, %s(%d): %.2e", id, isGauss ? "Gauss" : "Lobatto", rule.size(), worst);
                    QVERIFY(worst < 2e-14);
                }
        }
    }
    void gaussPairsAreGaussCollocationOfHamiltonsEquations_data() {
        QTest::addColumn<QString>("model");
        for (const ModelEntry& e : modelCatalog())
            if (isFree(systemNamed(e.item.id)))
                QTest::newRow(e.item.id.c_str()) << QString::fromStdString(e.item.id);
    }
    void gaussPairsAreGaussCollocationOfHamiltonsEquations() {
        QFETCH(QString, model);
        const System s = systemNamed(model.toStdString());
        for (const int stages : {1, 2, 3, 4, 6, 8, 12}) {
            const auto discretization =
                makeIntegrator(s, polynomialPair(stages, {"gauss", {}, {}}), {0, 0.01});
            const Settings keys{"gauss-collocation", {{"stages", static_cast<double>(stages)}}, {}};
            const auto collocation = findBaseline("gauss-collocation")->make(s, {0.01, {}, 0, keys});
            const double difference = stepDifference(s, *discretization, *collocation);
            qInfo("%d stages: %.2e", stages, difference);
            QVERIFY(difference < 1e-14);  // measured: at most 1.1e-15
        }
    }
    void gaussPairsAndGaussCollocationHaveTheSameCurve() {
        for (const char* id : {"kepler", "spring-pendulum"}) {
            const System s = systemNamed(id);
            std::mt19937 random(3);
            const auto discretization = makeIntegrator(s, polynomialPair(5, {"gauss", {}, {}}), {0, 0.02});
            const auto collocation =
                findBaseline("gauss-collocation")->make(s, {0.02, {}, 0, {"", {{"stages", 5.0}}, {}}});
            const State start = randomState(random, s);
            (void)after(*discretization, start, 3).value();
            (void)after(*collocation, start, 3).value();
            std::vector<double> x(4), y(4);
            for (const double tau : {0.0, 0.3, 0.77, 1.0}) {
                discretization->denseOutput(tau, x);
                collocation->denseOutput(tau, y);
                qInfo("%s at %.2f: %.2e", id, tau, distance(x, y, 0, 4));
                QVERIFY(distance(x, y, 0, 4) < 2e-14);  // measured: at most 1.8e-15
            }
        }
    }
    void fixedPointAndNewtonFindTheSameStep() {
        const System s = systemNamed("kepler");
        Discretization fixed = polynomialPair(4, {"gauss", {}, {}}), newton = fixed;
        fixed.solver.type = "fixed-point";
        newton.solver.type = "newton";
        const double difference =
            stepDifference(s, *makeIntegrator(s, fixed, {0, 0.05}), *makeIntegrator(s, newton, {0, 0.05}));
        qInfo("%.2e", difference);
        QVERIFY(difference < 1e-14);
    }
    void anotherRuleIsSeenToDiffer() {
        // Teeth: the comparisons above would notice a wrong rule.
        const System s = systemNamed("kepler");
        const auto a = makeIntegrator(s, polynomialPair(2, {"gauss", {}, {}}), {0, 0.05});
        const auto b = makeIntegrator(s, polynomialPair(2, {"lobatto", {}, {}}), {0, 0.05});
        QVERIFY(stepDifference(s, *a, *b) > 1e-9);
    }
};

EXTREMAL_TEST(RoutesTest)
}  // namespace extremal::laws::routes_test

#include "routes_test.moc"
