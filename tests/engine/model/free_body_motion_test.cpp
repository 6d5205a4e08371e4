// SPDX-License-Identifier: GPL-3.0-or-later
/// The exact motion of a free body against values known to 1e-16, and as a solution of its equations.
#include <QTest>

#include <random>

#include "tests/laws/bodies.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::free_body_motion_test {
namespace {

/// |xdot - rate(x)| by central differences of order 6, relative to the rates.
double residual(const System& system, const ExactSolution& solution, double t, double h) {
    constexpr std::array<double, 3> c = centralDifferences;
    std::vector<double> x(10), dx(10), plus(10), minus(10), slope(10, 0);
    solution(t, x);
    (void)rateOf(system, t, x.data(), dx.data());
    for (int k = 1; k <= 3; ++k) {
        solution(t + k * h, plus);
        solution(t - k * h, minus);
        for (std::size_t i = 0; i < 10; ++i)
            slope[i] += c[static_cast<std::size_t>(k - 1)] * (plus[i] - minus[i]) / h;
    }
    double worst = 0, scale = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        worst = std::max(worst, std::abs(slope[i] - dx[i]));
        scale = std::max(scale, std::abs(dx[i]));
    }
    return worst / scale;
}

}  // namespace

class FreeBodyMotionTest : public QObject {
    Q_OBJECT
private slots:
    void itMeetsTheKnownValues() {
        const auto check = [](const KnownBody& body, double bound) {
            const System s = body.system();
            const ExactSolution solution = s.exact(bodyState(body.start));
            QVERIFY(static_cast<bool>(solution));
            std::vector<double> x(10);
            for (const Known& known : body.at) {
                solution(known.t, x);
                const double a = attitudeError(x, known.q), p = momentumError(x, known.Pi);
                qInfo("%s, t = %g: attitude %.1e, momentum %.1e", body.name.c_str(), known.t, a, p);
                QVERIFY(a < bound && p < bound);
            }
        };
        check(standard(), 1e-13);
        check(separatrix(), 1e-9);  // adding 1e-16 to the momentum at the start moves t = 100 by 1e-10
        check(nearlySymmetric(), 1e-13);
        check(thinRod(), 1e-11);  // 1e-16 at the start is 1e-12 of the rod's own spin
        check(fastThinRod(), 1e-12);
    }
    void itSolvesTheEquationsForAnyBody() {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> uniform(-1, 1);
        double worst = 0;
        for (int k = 0; k < 400; ++k) {
            const auto size = [&] { return std::pow(10, uniform(random)); };
            const Three I{size(), size(), size()};
            Four q{uniform(random), uniform(random), uniform(random), uniform(random)};
            const double n = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
            for (double& v : q) v /= n;
            const State start = bodyState({uniform(random), uniform(random), uniform(random)}, q);
            const System s = freeBody(I);
            const ExactSolution solution = s.exact(start);
            QVERIFY(static_cast<bool>(solution));
            std::vector<double> x(10);
            solution(0, x);
            for (std::size_t i = 0; i < 10; ++i) QVERIFY(std::abs(x[i] - start.x[i]) < 1e-13);
            const double rate = std::hypot(start.x[4], start.x[5], start.x[6]) / std::min({I[0], I[1], I[2]});
            worst = std::max(worst, residual(s, solution, 7 * uniform(random) / rate, 0.01 / rate));
        }
        qInfo("|xdot - rate| / |rate|: %.1e", worst);
        QVERIFY(worst < 1e-9);
    }
    void permanentRotationsAndSpheresTurnUniformly() {
        for (const auto& [I, Pi] : {std::pair{Three{1, 2, 3}, Three{0, 0, 2}},
                                    {Three{1, 2, 3}, Three{0, 2, 0}},
                                    {Three{2, 2, 2}, Three{1, -2, 0.5}},
                                    {Three{1, 1, 3}, Three{0.6, 0.8, 0}}}) {
            const State start = bodyState(Pi, {0.5, -0.5, 0.5, 0.5});
            const ExactSolution solution = freeBody(I).exact(start);
            std::vector<double> x(10);
            solution(3, x);
            const so3::Quaternion<double> expected =
                so3::product(so3::Quaternion<double>(0.5, -0.5, 0.5, 0.5),
                             so3::quaternionExp(
                                 so3::Vector<double>(3 * Pi[0] / I[0], 3 * Pi[1] / I[1], 3 * Pi[2] / I[2])));
            QVERIFY(attitudeError(x, {expected(0), expected(1), expected(2), expected(3)}) < 1e-15);
            QVERIFY(momentumError(x, Pi) == 0);
        }
    }
    void theSeparatrixItselfIsSolved() {
        // 2 E I_2 = L^2 exactly, in binary too: Pi_1^2 (1 - 3) / 1 + Pi_3^2 (6 - 3) / 6 = 0.
        const System s = freeBody({1, 3, 6});
        const ExactSolution solution = s.exact(bodyState({-0.25, 0.2, 0.5}));
        QVERIFY(static_cast<bool>(solution));
        QVERIFY(residual(s, solution, 2, 0.02) < 1e-9);
        std::vector<double> x(10);
        solution(200, x);
        QVERIFY(std::isfinite(x[0]) && std::abs(std::abs(x[5]) - std::hypot(0.25, 0.2, 0.5)) < 1e-9);
    }
    void creepingMotionsAreLeftToComputedReferences() {
        QVERIFY(!freeBody({1e-4, 1, 1 + 1e-13}).exact(bodyState({1e-12, 0.5, 0.5})));
    }
};

EXTREMAL_TEST(FreeBodyMotionTest)
}  // namespace extremal::laws::free_body_motion_test

#include "free_body_motion_test.moc"
