// SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that are evaluated together with their Lagrangian: the sums of what both say alone, and used for
/// this Lagrangian only.
#include <QTest>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace joined_force_test {

/// A mass matrix, a time, parameters and all kinds of forces.
System forced() {
    return typedWith({"x", "y"}, "m*(1 + x^2)*x_t^2/2 + (2 + sin(t))*y_t^2/2 + x_t*y_t/3 - k*cos(x - y)",
                     {{"forces", Value::Object{{"x", "3*sin(x)*y_t - k*t"}, {"y", "x^2*y"}}},
                      {"dissipation", "0.2*(1 + x^2)*x_t^2 + 0.1*y_t^2"}},
                     {{"m", 1.5}, {"k", 2}});
}

class JoinedForceTest : public QObject {
    Q_OBJECT
private slots:
    void bothAreSums() {
        constexpr int nodes = 8, d = 2;
        const System s = forced();
        const auto& L = s.mechanics();
        const Force& force = *s.parts.find<Force>();
        QVERIFY(force.withLagrangian && force.withLagrangian->lagrangian == L.model.get());
        std::vector<double> t(nodes), q(d * nodes), v(d * nodes);
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = 0.1 * static_cast<double>(i);
        for (std::size_t i = 0; i < q.size(); ++i) {
            q[i] = std::sin(0.7 * static_cast<double>(i));
            v[i] = std::cos(1.9 * static_cast<double>(i));
        }
        std::vector<double> g(2 * d * nodes), h(4 * d * d * nodes), f(d * nodes), df(2 * d * d * nodes);
        std::vector<double> gBoth(g.size(), 7.0), hBoth(h.size(), 7.0);
        L.gradients(L.model.get(), t.data(), nodes, q.data(), v.data(), g.data());
        L.hessians(L.model.get(), t.data(), nodes, q.data(), v.data(), h.data());
        force.values(force.model.get(), t.data(), nodes, q.data(), v.data(), f.data());
        force.derivatives(force.model.get(), t.data(), nodes, q.data(), v.data(), df.data());
        force.withLagrangian->gradients(force.model.get(), t.data(), nodes, q.data(), v.data(), gBoth.data());
        force.withLagrangian->hessians(force.model.get(), t.data(), nodes, q.data(), v.data(), hBoth.data());
        for (std::size_t i = 0; i < g.size(); ++i)
            QVERIFY(std::abs(gBoth[i] - g[i] - (i < f.size() ? f[i] : 0)) < 1e-13);
        for (std::size_t i = 0; i < h.size(); ++i)
            QVERIFY(std::abs(hBoth[i] - h[i] - (i < df.size() ? df[i] : 0)) < 1e-13);
        std::vector<double> gWithMasses(g.size(), 7.0), masses(d * d * nodes, 7.0);
        force.withLagrangian->gradientsAndMasses(force.model.get(), t.data(), nodes, q.data(), v.data(),
                                                 gWithMasses.data(), masses.data());
        for (std::size_t i = 0; i < g.size(); ++i) QVERIFY(std::abs(gWithMasses[i] - gBoth[i]) < 1e-13);
        for (std::size_t k = 0; k < d; ++k)
            for (std::size_t i = 0; i < d * nodes; ++i)
                QVERIFY(std::abs(masses[k * d * nodes + i] - h[((d + k) * 2 * d + d) * nodes + i]) < 1e-13);
    }

    /// Sweeps are the same with masses that come with the gradient, and with those of all second derivatives.
    void massesMayComeWithTheGradient() {
        const auto endOf = [](const System& s, long long& sweeps) {
            Discretization scheme = *namedScheme("galerkin-gauss-4");
            scheme.solver = {"auto", {{"tolerance", 1e-10}}, {}};
            const auto integrator = makeIntegrator(s, scheme, {0, 0.05});
            State state{0, 0, {0.3, -0.4, 1.0, 0.5}};
            integrator->begin(state);
            for (int i = 0; i < 40; ++i) {
                const StepReport report = advance(*integrator, state);
                if (report.outcome != Outcome::converged || report.cost.linearSolves > 0) return State{};
                sweeps += report.cost.iterations;
            }
            return state;
        };
        System apart = forced();
        Force force = *apart.parts.find<Force>();
        Force::WithLagrangian calls = *force.withLagrangian;
        calls.gradientsAndMasses = nullptr;
        force.withLagrangian = std::make_shared<Force::WithLagrangian>(calls);
        apart.parts.set(force);
        long long sweeps = 0, sweepsApart = 0;
        const State state = endOf(forced(), sweeps), expected = endOf(apart, sweepsApart);
        QVERIFY(state.x.size() == 4 && expected.x.size() == 4);
        QCOMPARE(sweeps, sweepsApart);
        for (std::size_t k = 0; k < 4; ++k) QVERIFY(std::abs(state.x[k] - expected.x[k]) < 1e-13);
    }

    /// With the calls for both, with those of each alone, and with calls for both of another Lagrangian,
    /// which would crash.
    void stepsAreThoseOfBothAlone() {
        const auto endOf = [](const System& s) {
            return run({s, {0, 0, {0.3, -0.4, 1.0, 0.5}}}, "galerkin-gauss-3", 2, 40).state.x;
        };
        System alone = forced(), other = forced();
        Force force = *alone.parts.find<Force>();
        force.withLagrangian.reset();
        alone.parts.set(force);
        int another = 0;
        force.withLagrangian =
            std::make_shared<Force::WithLagrangian>(Force::WithLagrangian{&another, nullptr, nullptr});
        other.parts.set(force);
        const std::vector<double> x = endOf(forced()), expected = endOf(alone);
        QVERIFY(std::abs(x[0] - 0.3) > 0.1);
        for (std::size_t k = 0; k < x.size(); ++k) QVERIFY(std::abs(x[k] - expected[k]) < 1e-12);
        QCOMPARE(endOf(other), expected);
    }

    /// Sweeps over the nodes, to a tolerance or to round-off, end where Newton's method does; and where
    /// damping is too stiff for them it is Newton's method that ends.
    void sweepsEndWhereNewtonDoes() {
        double tolerance = 0;
        const auto endOf = [&](const std::string& method, const std::string& dissipation, long long& solves) {
            Discretization scheme = *namedScheme("galerkin-gauss-4");
            scheme.solver = {method, {}, {}};
            if (tolerance > 0) scheme.solver.keys.emplace_back("tolerance", tolerance);
            const System s =
                typedWith({"x", "y"}, "(1 + x^2)*x_t^2/2 + y_t^2/2 + x_t*y_t/3 + cos(x - y)",
                          {{"forces", Value::Object{{"x", "sin(y)"}}}, {"dissipation", dissipation}});
            const auto integrator = makeIntegrator(s, scheme, {0, 0.05});
            State state{0, 0, {0.3, -0.4, 1.0, 0.5}};
            integrator->begin(state);
            solves = 0;
            for (int i = 0; i < 60; ++i) {
                const StepReport report = advance(*integrator, state);
                if (report.outcome != Outcome::converged) return std::vector<double>{};
                solves += report.cost.linearSolves;
            }
            return state.x;
        };
        for (const auto& [isStiff, to] :
             {std::pair(false, 1e-10), {true, 1e-10}, {false, 0.0}, {true, 0.0}}) {
            tolerance = to;
            const std::string dissipation = isStiff ? "400*x_t^2" : "0.1*x_t^2 + 0.2*y_t^2";
            long long bySweeps = 0, byNewton = 0;
            const std::vector<double> x = endOf("auto", dissipation, bySweeps),
                                      expected = endOf("newton", dissipation, byNewton);
            QVERIFY(x.size() == 4 && expected.size() == 4);
            for (std::size_t k = 0; k < 4; ++k)
                QVERIFY2(std::abs(x[k] - expected[k]) < (tolerance > 0 ? 1e-8 : 1e-12),
                         qPrintable(QString::number(x[k] - expected[k])));
            QVERIFY2(isStiff ? bySweeps > byNewton / 2 : bySweeps == 0,
                     qPrintable(QString::number(bySweeps)));
        }
    }
};

EXTREMAL_TEST(JoinedForceTest)
}  // namespace joined_force_test
}  // namespace extremal::mechanism_test
#include "joined_force_test.moc"
