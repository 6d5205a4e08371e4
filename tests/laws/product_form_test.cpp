// SPDX-License-Identifier: GPL-3.0-or-later
/// The printed product of a slow part and one oscillation: right where its curves contain the motion, and
/// where it fails.
#include <QTest>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "tests/laws/claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::product_form_test {
namespace {

Discretization product(int slow, int fast, const char* frequency, Value omega = "model") {
    Discretization discretization = *namedScheme("product-form");
    for (auto& [key, value] : discretization.space.keys) {
        if (key == "degree") value = static_cast<double>(slow);
        if (key == "fast") value = Value(Value::Object{{"degree", static_cast<double>(fast)}});
        if (key == "frequency") value = frequency;
        if (key == "omega") value = omega;
    }
    return discretization;
}

/// Time of the first step that has no solution; infinity where there is none to t = 10.
double failsAt(const System& s, const Discretization& discretization, double h, Outcome& outcome) {
    const auto integrator = makeIntegrator(s, discretization, {0, h});
    State state{0, 0, {0.05, 1, 0, 0}};
    while (state.t < 10 - h / 2) {
        const double t = state.t;
        outcome = advance(*integrator, state).outcome;
        if (outcome != Outcome::converged) return t;
    }
    return INFINITY;
}

}  // namespace

class ProductFormTest : public QObject {
    Q_OBJECT
private slots:
    /// On a spring that hardens, where its steps have solutions; of a step with leaking momentum the law is
    /// not.
    void theStepIsSymplectic() {
        const System s =
            systemNamed("lagrangian", {{"coordinates", Value(Value::Array{"a"})},
                                       {"parameters", Value(Value::Object{{"k", 1e4}, {"g", 9.81}})},
                                       {"lagrangian", "a_t^2/2 + g*a - k*a^2/2 - 200*a^4"}});
        const Subject on = subjectOf("hardening spring", s, {0, 0, {0.05, 0.3}}, 0.1);
        for (const char* frequency : {"fixed", "free"}) {
            const Discretization pair = product(2, 2, frequency, 100.0);
            QVERIFY(describe(pair).claims.isSymplectic);
            const auto make = [&](double step) { return makeIntegrator(s, pair, {0, step}); };
            const double defect = symplecticDefect({on, describe(pair).claims, make}, 1);
            qInfo("%s frequency: %.1e", frequency, defect);
            QVERIFY(defect < 1e-7);
        }
    }
    void aSpringUnderItsWeightIsExact() {
        // a_s (1 + alpha sin wt + beta cos wt), alpha and beta some 50: what the products are made for.
        const System s =
            systemNamed("lagrangian", {{"coordinates", Value(Value::Array{"a"})},
                                       {"parameters", Value(Value::Object{{"k", 1e4}, {"g", 9.81}})},
                                       {"lagrangian", "a_t^2/2 + g*a - k*a^2/2"}});
        const double h = 0.1, rest = 9.81e-4;
        const auto integrator = makeIntegrator(s, product(2, 2, "fixed", 100.0), {0, h});
        State state{0, 0, {0.05, 0.3}};
        double worst = 0, x[2];
        for (int n = 0; n < 100; ++n) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            for (const double tau : {0.3, 1.0}) {
                integrator->denseOutput(tau, x);
                const double t = (n + tau) * h, c = std::cos(100 * t), w = std::sin(100 * t);
                worst = std::max({worst, std::abs(x[0] - (rest + (0.05 - rest) * c + 0.003 * w)),
                                  tau == 1 ? std::abs(x[1] - state.x[1]) : 0});
            }
        }
        qInfo("%.1e", worst);
        QVERIFY(worst < 1e-12);
    }
    void itFailsOnThePendulumWhereAddedAmplitudesDoNot() {
        const System s = systemNamed("spring-pendulum", {{"k", 1e4}});
        for (const char* frequency : {"fixed", "free"})
            for (const double h : {0.1, 0.2, 0.25}) {
                Outcome outcome{}, ofAdded{};
                const double t = failsAt(s, product(4, 2, frequency), h, outcome);
                qInfo("%s, h = %g: %s at t = %g", frequency, h, std::string(name(outcome)).c_str(), t);
                QVERIFY(t < 10);
                QVERIFY(outcome == Outcome::diverged || outcome == Outcome::singular ||
                        outcome == Outcome::notFinite);
                QVERIFY(std::isinf(failsAt(s, *namedScheme("multiscale-r1"), h, ofAdded)));
            }
    }
    void whereAStepHasASolutionItIsSymplectic() {
        const System s = systemNamed("spring-pendulum", {{"k", 1e4}});
        const auto map = [&](std::vector<double> x) {
            const auto integrator = makeIntegrator(s, product(4, 2, "fixed"), {0, 0.1});
            State state{0, 0, std::move(x)};
            if (advance(*integrator, state).outcome != Outcome::converged)
                throw std::runtime_error("no step");
            return state.x;
        };
        Eigen::Matrix4d M, J = Eigen::Matrix4d::Zero();
        J.topRightCorner<2, 2>().setIdentity();
        J.bottomLeftCorner<2, 2>() = -Eigen::Matrix2d::Identity();
        const std::vector<double> start{0.05, 1, 0, 0};
        const double scale[] = {0.05, 1, 5, 3};
        for (int j = 0; j < 4; ++j) {
            std::vector<double> up = start, down = start;
            const auto at = static_cast<std::size_t>(j);
            const double d = 1e-5 * scale[j];
            up[at] += d;
            down[at] -= d;
            const std::vector<double> a = map(up), b = map(down);
            for (int i = 0; i < 4; ++i)
                M(i, j) = (a[static_cast<std::size_t>(i)] - b[static_cast<std::size_t>(i)]) / (2 * d);
        }
        const double defect = (M.transpose() * J * M - J).cwiseAbs().maxCoeff() / M.cwiseAbs().maxCoeff();
        qInfo("defect %.1e", defect);
        QVERIFY(defect < 1e-6);
    }
    void angularMomentumIsLostWithoutGravity() {
        // Constants are not variations of a product; of added amplitudes they are.
        const System s = systemNamed("spring-pendulum", {{"k", 1e4}, {"g", 0.0}});
        const auto change = [&](const Discretization& discretization) {
            const auto integrator = makeIntegrator(s, discretization, {0, 0.1});
            State state{0, 0, {0.02, 0.3, 0, 0.8}};
            if (advance(*integrator, state).outcome != Outcome::converged) return double(NAN);
            return std::abs(state.x[3] - 0.8);
        };
        const double product1 = change(product(4, 2, "fixed")), added = change(*namedScheme("multiscale-r1"));
        qInfo("product %.1e, added %.1e", product1, added);
        QVERIFY(added < 1e-13);
        QVERIFY(product1 > 1e-8);
    }
};

EXTREMAL_TEST(ProductFormTest)
}  // namespace extremal::laws::product_form_test

#include "product_form_test.moc"
