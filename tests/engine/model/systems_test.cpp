// SPDX-License-Identifier: GPL-3.0-or-later
/// The built-in systems against independent routes: differences of the Lagrangian, normal modes, published
/// figures.
#include <QTest>

#include <Eigen/Core>

#include <cmath>
#include <random>

#include "engine/core/algebra/dense.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::systems_test {
namespace {

/// A state near the example of a system, and velocities near its own.
struct Place {
    std::vector<double> q, v;
};
Place somewhere(const System& s, const ModelEntry& entry, std::mt19937& random) {
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    const auto d = static_cast<std::size_t>(s.dimension());
    Place at{entry.exampleQ, std::vector<double>(d)};
    for (double& q : at.q) q += shift(random);
    for (double& v : at.v) v = shift(random);
    return at;
}

}  // namespace

class SystemsTest : public QObject {
    Q_OBJECT
private slots:
    void derivativesAgreeWithDifferences_data() {
        QTest::addColumn<QString>("id");
        for (const char* id : {"kepler", "pendulum", "spring-pendulum", "double-pendulum", "henon-heiles",
                               "fput-chain", "outer-solar-system"})
            QTest::newRow(id) << id;
    }
    void derivativesAgreeWithDifferences() {
        QFETCH(QString, id);
        const ModelEntry& entry = *findModel(id.toStdString());
        const System s = laws::systemNamed(id.toStdString());
        const auto& m = s.mechanics();
        const auto d = static_cast<std::size_t>(s.dimension()), n = 2 * d;
        std::mt19937 random(7);
        for (int trial = 0; trial < 5; ++trial) {
            const Place at = somewhere(s, entry, random);
            std::vector<double> g(n), H(n * n), alone(n), plus(n), minus(n), unused(n * n), f(d);
            double L = 0, up = 0, down = 0;
            m.jet(m.model.get(), 0, at.q.data(), at.v.data(), &L, g.data(), H.data());
            m.gradient(m.model.get(), 0, at.q.data(), at.v.data(), alone.data());
            double size = 0, curvature = 0;
            for (const double x : g) size = std::max(size, std::abs(x));
            for (const double x : H) curvature = std::max(curvature, std::abs(x));
            for (std::size_t i = 0; i < n; ++i) QVERIFY(std::abs(g[i] - alone[i]) <= 1e-14 * size);
            if (m.isSeparable) {
                m.force(m.model.get(), 0, at.q.data(), f.data());
                for (std::size_t i = 0; i < d; ++i) QVERIFY(std::abs(f[i] - g[i]) <= 1e-14 * size);
            }
            for (std::size_t i = 0; i < n; ++i) {
                constexpr double h = 1e-5;
                Place a = at, b = at;
                (i < d ? a.q[i] : a.v[i - d]) += h;
                (i < d ? b.q[i] : b.v[i - d]) -= h;
                m.jet(m.model.get(), 0, a.q.data(), a.v.data(), &up, plus.data(), unused.data());
                m.jet(m.model.get(), 0, b.q.data(), b.v.data(), &down, minus.data(), unused.data());
                // Errors h^2 and round-off over h; measured at most 1e-8 of the largest entry.
                QVERIFY(std::abs((up - down) / (2 * h) - g[i]) < 1e-7 * (size + std::abs(L)));
                for (std::size_t j = 0; j < n; ++j)
                    QVERIFY(std::abs((plus[j] - minus[j]) / (2 * h) - H[i * n + j]) <
                            1e-7 * (curvature + size));
            }
        }
    }
    void forcesOfManyNodesAreThoseOfEach() {
        for (const char* id : {"kepler", "henon-heiles", "outer-solar-system"}) {
            const System s = laws::systemNamed(id);
            const auto& m = s.mechanics();
            QVERIFY(m.forces);
            const auto d = static_cast<std::size_t>(s.dimension());
            constexpr std::size_t nodes = 24;
            std::mt19937 random(3);
            std::vector<double> t(nodes), q(nodes * d), f(nodes * d), each(d), force(d);
            for (std::size_t i = 0; i < nodes; ++i) {
                const Place at = somewhere(s, *findModel(id), random);
                for (std::size_t k = 0; k < d; ++k) q[k * nodes + i] = at.q[k];
            }
            m.forces(m.model.get(), t.data(), static_cast<int>(nodes), q.data(), f.data());
            for (std::size_t i = 0; i < nodes; ++i) {
                for (std::size_t k = 0; k < d; ++k) each[k] = q[k * nodes + i];
                m.force(m.model.get(), 0, each.data(), force.data());
                for (std::size_t k = 0; k < d; ++k) QCOMPARE(f[k * nodes + i], force[k]);
            }
        }
    }
    void lowSwingsOfTheDoublePendulumAreNormalModes() {
        // Equal masses and lengths: theta2 = +-sqrt 2 theta1, w^2 = (2 -+ sqrt 2) g / l.
        const System s = laws::systemNamed("double-pendulum");
        for (const double sign : {1.0, -1.0}) {
            constexpr double amplitude = 1e-6;
            const double w = std::sqrt((2 - sign * std::sqrt(2.0)) * 9.81);
            State state{0, 0, {amplitude, sign * std::sqrt(2.0) * amplitude, 0, 0}};
            const auto step = makeIntegrator(s, *namedScheme("galerkin-gauss-4"), {0, 0.02});
            double worst = 0;
            for (int k = 0; k < 500; ++k) {
                QVERIFY(advance(*step, state).outcome == Outcome::converged);
                worst = std::max(worst, std::abs(state.x[0] - amplitude * std::cos(w * state.t)));
            }
            // The cubic terms of relative size amplitude^2 = 1e-12 shift the frequency, by w t = 30 in all.
            qInfo("%+.0f: %.1e", sign, worst / amplitude);
            QVERIFY(worst < 1e-9 * amplitude);
        }
    }
    void aLinearChainIsASumOfNormalModes() {
        const System s = laws::systemNamed("fput-chain", {{"beta", 0.0}, {"k_soft", 3.0}, {"k_stiff", 40.0}});
        const auto& m = s.mechanics();
        const int d = s.dimension();
        const std::vector<double> zero(static_cast<std::size_t>(d));
        std::vector<double> g(2 * zero.size()), H(4 * zero.size() * zero.size());
        double L = 0;
        m.jet(m.model.get(), 0, zero.data(), zero.data(), &L, g.data(), H.data());
        const Eigen::Map<const Eigen::MatrixXd> full(H.data(), 2 * d, 2 * d);
        const auto modes = dense::symmetricEigen<double>(-full.topLeftCorner(d, d));
        State state{0, 0, std::vector<double>(static_cast<std::size_t>(2 * d))};
        for (int i = 0; i < d; ++i) state.x[static_cast<std::size_t>(i)] = std::sin(1.0 + 2 * i);
        const Eigen::VectorXd start = Eigen::Map<const Eigen::VectorXd>(state.x.data(), d);
        const auto step = makeIntegrator(s, *namedScheme("galerkin-gauss-6"), {0, 0.05});
        for (int k = 0; k < 200; ++k) QVERIFY(advance(*step, state).outcome == Outcome::converged);
        Eigen::VectorXd c = modes.vectors.transpose() * start;
        for (int i = 0; i < d; ++i) c(i) *= std::cos(std::sqrt(modes.values(i)) * state.t);
        const Eigen::VectorXd exact = modes.vectors * c;
        const double worst =
            (exact - Eigen::Map<const Eigen::VectorXd>(state.x.data(), d)).cwiseAbs().maxCoeff();
        QVERIFY2(worst < 1e-9, qPrintable(QString::number(worst)));
    }
    void theStarEscapesAtOneSixth() {
        const System s = laws::systemNamed("henon-heiles");
        const auto& m = s.mechanics();
        const double q[2] = {0, 1}, p[2] = {0, 0};
        double f[2];
        QVERIFY(std::abs(m.energy(m.model.get(), 0, q, p) - 1.0 / 6) < 1e-15);
        m.force(m.model.get(), 0, q, f);
        QVERIFY(std::abs(f[0]) + std::abs(f[1]) < 1e-15);
    }
    /// Independent figures for h = 200 days, 200,000 days: 1.2e-5 at degree 2 and 1.7e-8 at degree 3.
    void planetsKeepTheirEnergyAsFarAsTheDegreeGoes() {
        const System s = laws::systemNamed("outer-solar-system");
        const ModelEntry& entry = *findModel("outer-solar-system");
        State start{0, 0, entry.exampleQ};
        start.x.insert(start.x.end(), entry.exampleP.begin(), entry.exampleP.end());
        const auto& m = s.mechanics();
        const auto energy = [&](const State& at) {
            return m.energy(m.model.get(), at.t, at.x.data(), at.x.data() + 18);
        };
        const auto momentum = [&](const State& at) {
            double sum = 0;
            for (const MomentumMap& map : s.momenta)
                if (map.name.starts_with("angular"))
                    sum += std::pow(map.value(at.x.data(), at.x.data() + 18), 2);
            return std::sqrt(sum);
        };
        for (const auto& [scheme, expected] :
             {std::pair{"galerkin-gauss-2", 1.2e-5}, std::pair{"galerkin-gauss-3", 1.7e-8}}) {
            const auto step = makeIntegrator(s, *namedScheme(scheme), {0, 200});
            State state = start;
            const double H = energy(start), L = momentum(start);
            double worst = 0, lost = 0;
            for (int k = 0; k < 1000; ++k) {
                QVERIFY(advance(*step, state).outcome == Outcome::converged);
                worst = std::max(worst, std::abs((energy(state) - H) / H));
                lost = std::max(lost, std::abs((momentum(state) - L) / L));
            }
            qInfo("%s: |dH/H| %.3e, |dL/L| %.1e", scheme, worst, lost);
            QVERIFY(std::abs(worst / expected - 1) < 0.1);
            QVERIFY(lost < 1e-13);
        }
    }
};

EXTREMAL_TEST(SystemsTest)
}  // namespace extremal::systems_test

#include "systems_test.moc"
