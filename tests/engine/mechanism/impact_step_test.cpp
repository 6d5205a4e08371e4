// SPDX-License-Identifier: GPL-3.0-or-later
/// Impacts on walls: the order of the scheme in q and p, energies, momenta and times that are known
/// otherwise.
#include <QTest>

#include <cmath>
#include <functional>

#include "engine/mechanism/impact/impact_step.hpp"
#include "engine/model/parts/wall.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::impact_test {
namespace {

using mechanism_test::Distance;
using mechanism_test::distance;
using mechanism_test::Ending;
using mechanism_test::Mechanical;
using mechanism_test::run;
using mechanism_test::startAt;
using mechanism_test::typedWith;

/// A system with a wall, and the same without it.
struct Case {
    Mechanical walled, free;
    std::function<double(const State&)> gap;
    std::function<void(State&)> strike;  ///< what the wall does, by a formula of its own
    double end = 10;
};

/// A pendulum and a wall at the angle -1/2.
Case pendulum(double restitution) {
    const char* const L = "theta_t^2/2 + cos(theta)";
    const Value wall = Value::Object{{"gap", "theta + 0.5"}, {"restitution", restitution}};
    return {startAt(typedWith({"theta"}, L, {{"walls", Value::Object{{"post", wall}}}}), {1}, {0.2}),
            startAt(typedWith({"theta"}, L, {}), {1}, {0.2}), [](const State& s) { return s.x[0] + 0.5; },
            [restitution](State& s) { s.x[1] *= -restitution; }};
}
/// A particle in an ellipse under a force that is not linear.
Case ellipse() {
    const char* const L = "(x_t^2 + y_t^2)/2 - (x^4 + x*y^2)/4";
    const auto normal = [](const State& s) {
        const double x = -s.x[0] / 2, y = -2 * s.x[1], size = std::hypot(x, y);
        return std::pair(x / size, y / size);
    };
    return {startAt(typedWith({"x", "y"}, L, {{"walls", Value::Object{{"rim", "1 - x^2/4 - y^2"}}}}),
                    {0.3, 0.2}, {1, 0.7}),
            startAt(typedWith({"x", "y"}, L, {}), {0.3, 0.2}, {1, 0.7}),
            [](const State& s) { return 1 - s.x[0] * s.x[0] / 4 - s.x[1] * s.x[1]; },
            [normal](State& s) {
                const auto [x, y] = normal(s);
                const double into = s.x[2] * x + s.x[3] * y;
                s.x[2] -= 2 * into * x;
                s.x[3] -= 2 * into * y;
            },
            4};
}
/// A ball on a rod and a wall, with a drag, which is a third of everything, or elastic without it.
Case ballOnRod(bool isElastic = false) {
    const char* const L = "(x_t^2+y_t^2+z_t^2)/2 - 9.81*z";
    const Value::Object rod{{"rod", "x^2+y^2+z^2-1"}};
    const double restitution = isElastic ? 1 : 0.8;
    const Value wall = Value::Object{{"gap", "x + 0.3"}, {"restitution", restitution}};
    Value::Object further{{"constraints", Value::Object{{"rod", "x^2+y^2+z^2-1"}}}};
    if (!isElastic)
        further.push_back({"forces", Value::Object{{"x", "-0.3*x_t"}, {"y", "-0.3*y_t"}, {"z", "-0.3*z_t"}}});
    Value::Object walled = further;
    walled.push_back({"walls", Value::Object{{"w", wall}}});
    const std::vector<double> q{0.6, 0, -0.8}, v{0, 1.5, 0.3};
    return {startAt(typedWith({"x", "y", "z"}, L, walled), q, v),
            startAt(typedWith({"x", "y", "z"}, L, further), q, v),
            [](const State& s) { return s.x[0] + 0.3; },
            [restitution](State& s) {
                // Along the part of (1, 0, 0) that the rod leaves.
                const double n[] = {1 - s.x[0] * s.x[0], -s.x[0] * s.x[1], -s.x[0] * s.x[2]};
                const double J = -(1 + restitution) * s.x[3] / n[0];
                for (int i = 0; i < 3; ++i) s.x[static_cast<std::size_t>(3 + i)] += J * n[i];
            },
            2};
}

/// Short steps of the scheme without a wall, each time up to the contact by bisection of the last one.
State byPieces(const Case& of, int steps) {
    State s = of.free.start;
    const double h = of.end / steps;
    const auto step = [&](State from, double length) {
        from.node = 0;
        const auto integrator = makeIntegrator(of.free.system, *namedScheme("galerkin-gauss-6"), {0, length});
        if (integrator->advance(from, from.t + length).outcome != Outcome::converged) qFatal("no step");
        return from;
    };
    while (s.t < of.end - 1e-12) {
        const double length = std::min(h, of.end - s.t);
        State next = step(s, length);
        if (of.gap(next) < 0) {
            double low = 0, high = 1;
            for (int i = 0; i < 60; ++i) {
                const double middle = (low + high) / 2;
                (of.gap(step(s, middle * length)) > 0 ? low : high) = middle;
            }
            next = step(s, low * length);
            of.strike(next);
        }
        s = next;
    }
    return s;
}

Case named(const QString& name) {
    return name == "elastic"     ? pendulum(1)
           : name == "inelastic" ? pendulum(0.7)
           : name == "ellipse"   ? ellipse()
                                 : ballOnRod(name == "elastic ball on a rod");
}

Discretization withLaw(const std::string& scheme, ImpactLaw law) {
    Discretization d = *namedScheme(scheme);
    d.impact = law;
    return d;
}

}  // namespace

class ImpactStepTest : public QObject {
    Q_OBJECT
private slots:
    /// The contact is where the scheme's own step is: its order stays, of p as of q.
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::addColumn<bool>("isVariational");
        for (const char* name : {"elastic", "inelastic", "ellipse", "ball on a rod"}) {
            QTest::addRow("%s, midpoint", name) << name << "galerkin-gauss-1" << 2 << 320 << false;
            QTest::addRow("%s, Gauss 2", name) << name << "galerkin-gauss-2" << 4 << 80 << false;
            QTest::addRow("%s, Gauss 3", name) << name << "galerkin-gauss-3" << 6 << 40 << false;
            QTest::addRow("%s, Gauss 4", name) << name << "galerkin-gauss-4" << 8 << 16 << false;
        }
        for (const char* name : {"elastic", "ellipse", "elastic ball on a rod"}) {
            QTest::addRow("%s, midpoint, variational", name)
                << name << "galerkin-gauss-1" << 2 << 320 << true;
            QTest::addRow("%s, Gauss 2, variational", name) << name << "galerkin-gauss-2" << 4 << 80 << true;
            QTest::addRow("%s, Gauss 3, variational", name) << name << "galerkin-gauss-3" << 6 << 40 << true;
        }
        // At the post the errors of Lobatto 2 nearly cancel.
        for (const char* name : {"ellipse", "ball on a rod"})
            QTest::addRow("%s, Lobatto 2", name) << name << "galerkin-lobatto-2" << 4 << 80 << false;
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        QFETCH(bool, isVariational);
        const Case of = named(name);
        const Discretization by =
            withLaw(scheme.toStdString(), isVariational ? ImpactLaw::variational : ImpactLaw::energy);
        const State reference = byPieces(of, 400);
        // The constant of the error depends on where in a step the contacts are: errors over seven grids.
        Distance coarse, fine;
        int impacts = 0;
        for (const double many : {1.0, 1.06, 1.13, 1.19, 1.27, 1.33, 1.41}) {
            const int n = static_cast<int>(steps * many);
            const Ending a = run(of.walled, by, of.end, n), b = run(of.walled, by, of.end, 2 * n);
            QVERIFY(a.outcome == Outcome::converged && b.outcome == Outcome::converged);
            coarse = {std::hypot(coarse.q, distance(a.state, reference).q),
                      std::hypot(coarse.p, distance(a.state, reference).p)};
            fine = {std::hypot(fine.q, distance(b.state, reference).q),
                    std::hypot(fine.p, distance(b.state, reference).p)};
            impacts = b.impacts;
        }
        const double q = std::log2(coarse.q / fine.q), p = std::log2(coarse.p / fine.p);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; %d impacts", fine.q, fine.p, q, p, impacts);
        QVERIFY(impacts >= 1);
        const double tolerance = order < 8 ? 0.4 : 0.9;  // long steps for the errors to be above round-off
        // Errors of q by jumps of the energy nearly cancel in the ellipse.
        QVERIFY(isVariational ? q > order - tolerance : std::abs(q - order) < tolerance);
        QVERIFY(std::abs(p - order) < tolerance);
    }
    /// Radau nodes move places by h p_0 alone, so that Newton's method comes to the contact from one side.
    void theContactIsReachedFromOneSide() {
        const Mechanical of = startAt(
            typedWith({"y"}, "y_t^2/2 - 9.81*y", {{"walls", Value::Object{{"floor", "y"}}}}), {1}, {0});
        Discretization scheme = *namedScheme("galerkin-gauss-1");
        scheme.quadrature = {"radau", {{"nodes", 1.0}, {"end", "right"}}, {}};
        const auto integrator = makeIntegrator(of.system, scheme, {0, 0.05});
        State s = of.start, before = s;
        while (integrator->impacts().empty()) {
            before = s;
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        }
        QVERIFY(std::abs(before.x[0] + (integrator->impacts().front().t - before.t) * before.x[1]) < 1e-15);
    }
    /// dq ^ dp through a step with one impact, or with two, by differences of order 4: kept with equal
    /// discrete energies, and with equal H to the error of the scheme only.
    void variationalImpactsAreSymplectic_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("impacts");
        for (const int impacts : {1, 2}) {
            QTest::addRow("midpoint, %d", impacts) << "galerkin-gauss-1" << impacts;
            QTest::addRow("Gauss 2, %d", impacts) << "galerkin-gauss-2" << impacts;
            QTest::addRow("Lobatto 2, %d", impacts) << "galerkin-lobatto-2" << impacts;
        }
    }
    void variationalImpactsAreSymplectic() {
        QFETCH(QString, scheme);
        QFETCH(int, impacts);
        // Between two walls that are not straight.
        const System system = typedWith(
            {"x", "y"}, "(x_t^2 + y_t^2)/2 - (x^4 + x*y^2)/4",
            {{"walls", Value::Object{{"left", "x + 0.3 + 0.2*y^2"}, {"right", "0.3 - x + 0.1*y"}}}});
        const State start{0, 0, {0, 0.2, 1.5, 0.4}};
        const double step = impacts == 1 ? 0.4 : 0.75;
        int found = 0;
        const auto defect = [&](ImpactLaw law) {
            const auto after = [&](int k, double by) {
                State s = start;
                s.x[static_cast<std::size_t>(k)] += by;
                const auto integrator = makeIntegrator(system, withLaw(scheme.toStdString(), law), {0, step});
                if (advance(*integrator, s).outcome != Outcome::converged) qFatal("no step");
                found = static_cast<int>(integrator->impacts().size());
                return Eigen::Vector4d(s.x.data());
            };
            Eigen::Matrix4d M, J = Eigen::Matrix4d::Zero();
            constexpr double apart = 1e-3;
            for (int k = 0; k < 4; ++k)
                M.col(k) = (8 * (after(k, apart) - after(k, -apart)) -
                            (after(k, 2 * apart) - after(k, -2 * apart))) /
                           (12 * apart);
            J.topRightCorner<2, 2>().setIdentity();
            J.bottomLeftCorner<2, 2>() = -Eigen::Matrix2d::Identity();
            return (M.transpose() * J * M - J).norm();
        };
        const double variational = defect(ImpactLaw::variational);
        QCOMPARE(found, impacts);
        const double energy = defect(ImpactLaw::energy);
        qInfo("%.1e with discrete energies, %.1e with H", variational, energy);
        QVERIFY(variational < 1e-10);
        QVERIFY(energy > 100 * variational);
    }
    /// A billiard in an ellipse keeps the energy and the product of the angular momenta about the foci.
    void billiard() {
        const Mechanical of = startAt(typedWith({"x", "y"}, "(x_t^2 + y_t^2)/2",
                                                {{"walls", Value::Object{{"rim", "1 - x^2/4 - y^2"}}}}),
                                      {0.3, 0.2}, {1, 0.7});
        const double focus = std::sqrt(3.0);
        const auto product = [focus](const State& s) {
            const double L = s.x[0] * s.x[3] - s.x[1] * s.x[2];
            return L * L - focus * focus * s.x[3] * s.x[3];
        };
        const Ending r = run(of, "galerkin-gauss-1", 4000, 20000);
        QVERIFY(r.outcome == Outcome::converged && r.impacts > 2000);
        const EnergyFunction energy = energyOf(of.system);
        qInfo("%d impacts: energy %.1e, product %.1e", r.impacts,
              energy(r.state.t, r.state.x.data()) - energy(0, of.start.x.data()),
              product(r.state) - product(of.start));
        QVERIFY(std::abs(energy(r.state.t, r.state.x.data()) - energy(0, of.start.x.data())) < 1e-12);
        QVERIFY(std::abs(product(r.state) - product(of.start)) < 1e-11);
    }
    /// Elastic impacts do not change the energy, and there and back is the start.
    void elasticImpactsAreReversible() {
        const Case of = pendulum(1);
        const auto forth = makeIntegrator(of.walled.system, *namedScheme("galerkin-gauss-2"), {0, 0.1}),
                   back = makeIntegrator(of.walled.system, *namedScheme("galerkin-gauss-2"), {0, -0.1});
        State s = of.walled.start;
        int impacts = 0;
        for (int i = 0; i < 100; ++i) {
            QVERIFY(advance(*forth, s).outcome == Outcome::converged);
            for (const Impact& impact : forth->impacts()) {
                ++impacts;
                QVERIFY(std::abs(impact.energyLoss) < 1e-14);
                QVERIFY(impact.speedBefore < 0 && std::abs(impact.speedAfter + impact.speedBefore) < 1e-14);
            }
        }
        QVERIFY(impacts > 1);
        s.node = 0;
        for (int i = 0; i < 100; ++i) QVERIFY(advance(*back, s).outcome == Outcome::converged);
        QVERIFY(distance(s, of.walled.start).q < 1e-11 && distance(s, of.walled.start).p < 1e-11);
    }
    /// A ball that falls from y = 1 and keeps the part e of its speed lies still at (1 + e)/(1 - e)
    /// sqrt(2/g), and from there on (wall_rest_test.cpp).
    void impactsAccumulate_data() {
        QTest::addColumn<double>("restitution");
        for (const double e : {0.5, 0.8, 0.95}) QTest::addRow("e = %g", e) << e;
    }
    void impactsAccumulate() {
        QFETCH(double, restitution);
        const Value wall = Value::Object{{"gap", "y"}, {"restitution", restitution}};
        const Mechanical of = startAt(
            typedWith({"y"}, "y_t^2/2 - 9.81*y", {{"walls", Value::Object{{"floor", wall}}}}), {1}, {0});
        const auto integrator = makeIntegrator(of.system, *namedScheme("galerkin-gauss-2"), {0, 0.05});
        State s = of.start;
        double last = 0;
        for (int i = 0; i < 500; ++i) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            for (const Impact& impact : integrator->impacts()) last = impact.t;
        }
        const double still = (1 + restitution) / (1 - restitution) * std::sqrt(2 / 9.81);
        qInfo("at rest from %.12f, %.1e too early", last, still - last);
        QVERIFY(std::abs(last - still) < 1e-12 * still);
        QVERIFY(std::abs(s.x[0]) < 1e-14 && s.x[1] == 0);
    }
    /// Five equal balls that touch: the last one takes all.
    void newtonsCradle() {
        Value::Object walls;
        for (int k = 1; k < 5; ++k)
            walls.push_back({"gap" + std::to_string(k),
                             Value("x" + std::to_string(k + 1) + " - x" + std::to_string(k) + " - 1")});
        const Mechanical of = startAt(typedWith({"x1", "x2", "x3", "x4", "x5"},
                                                "(x1_t^2+x2_t^2+x3_t^2+x4_t^2+x5_t^2)/2", {{"walls", walls}}),
                                      {-0.4, 1, 2, 3, 4}, {1, 0, 0, 0, 0});
        const Ending r = run(of, "galerkin-gauss-1", 1, 10);
        QVERIFY(r.outcome == Outcome::converged);
        QCOMPARE(r.impacts, 4);
        for (std::size_t k = 0; k < 5; ++k) QVERIFY(std::abs(r.state.x[5 + k] - (k == 4)) < 1e-14);
        QVERIFY(std::abs(r.state.x[4] - 4.6) < 1e-13);
    }
    /// There and back over many impacts of balls that touch, in steps so long that the gap of the dense
    /// output and that of the scheme's own steps close at different times.
    void thereAndBackInLongSteps_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("step");
        for (const char* scheme : {"galerkin-gauss-1", "galerkin-lobatto-1", "galerkin-gauss-2"})
            for (const double step : {0.16, 0.21, 0.256})
                QTest::addRow("%s, %g", scheme, step) << scheme << step;
    }
    void thereAndBackInLongSteps() {
        QFETCH(QString, scheme);
        QFETCH(double, step);
        const Mechanical of =
            startAt(typedWith({"a", "b", "c"}, "(a_t^2+b_t^2+c_t^2)/2 - 5*(a^2+(b-0.2)^2+(c-0.4)^2)",
                              {{"walls", Value::Object{{"ab", "b - a - 0.2"}, {"bc", "c - b - 0.2"}}}}),
                    {-0.5, 0.2, 0.4}, {0, 0, 0});
        const auto forth = makeIntegrator(of.system, *namedScheme(scheme.toStdString()), {0, step}),
                   back = makeIntegrator(of.system, *namedScheme(scheme.toStdString()), {0, -step});
        State s = of.start;
        int impacts = 0;
        for (int i = 0; i < 40; ++i) {
            QVERIFY(advance(*forth, s).outcome == Outcome::converged);
            impacts += static_cast<int>(forth->impacts().size());
            QVERIFY(s.x[1] - s.x[0] - 0.2 > -1e-11 && s.x[2] - s.x[1] - 0.2 > -1e-11);
        }
        s.node = 0;
        for (int i = 0; i < 40; ++i) {
            QVERIFY(advance(*back, s).outcome == Outcome::converged);
            impacts -= static_cast<int>(back->impacts().size());
        }
        QCOMPARE(impacts, 0);
        qInfo("q %.1e, p %.1e", distance(s, of.start).q, distance(s, of.start).p);
        QVERIFY(distance(s, of.start).q < 1e-12 && distance(s, of.start).p < 1e-11);
    }
    /// A piston that moves as sin t gives its own speed twice.
    void aWallThatMoves() {
        const Mechanical of = startAt(
            typedWith({"x"}, "x_t^2/2", {{"walls", Value::Object{{"piston", "x - 0.3*sin(t)"}}}}), {1}, {-1});
        const Ending r = run(of, "galerkin-gauss-2", 3, 30);
        QVERIFY(r.outcome == Outcome::converged && r.impacts == 1);
        double t = 1;  // 1 - t = 0.3 sin t
        for (int i = 0; i < 50; ++i) t -= (1 - t - 0.3 * std::sin(t)) / (-1 - 0.3 * std::cos(t));
        QVERIFY(std::abs(r.state.x[1] - (1 + 2 * 0.3 * std::cos(t))) < 1e-13);
        const EnergyFunction energy = energyOf(of.system);
        QVERIFY(std::abs(energy(3, r.state.x.data()) - energy(0, of.start.x.data()) - r.work) < 1e-13);
    }
    /// Touched from inside, without a speed into the wall: nothing happens.
    void grazing() {
        const Mechanical of = startAt(
            typedWith({"x", "y"}, "(x_t^2+y_t^2)/2 - y^2/2", {{"walls", Value::Object{{"floor", "y + 1"}}}}),
            {0, 1}, {1, 0});
        const Ending r = run(of, "galerkin-gauss-3", 20, 130);
        QVERIFY(r.outcome == Outcome::converged);
        QVERIFY(std::abs(std::abs(r.state.x[1]) - std::abs(std::cos(20.0))) < 1e-4);
    }
    /// The same step with the time of the contact from its dense output would have the order 5.
    void theContactIsOneOfTheSchemesOwnSteps() {
        const Case of = pendulum(1);
        const auto integrator = makeIntegrator(of.walled.system, *namedScheme("galerkin-gauss-4"), {0, 0.5}),
                   free = makeIntegrator(of.free.system, *namedScheme("galerkin-gauss-4"), {0, 0.5});
        State s = of.walled.start, plain = of.free.start;
        for (int i = 0; i < 20 && integrator->impacts().empty(); ++i) {
            plain = s;
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        }
        QVERIFY(!integrator->impacts().empty());
        const double length = integrator->impacts().front().t - plain.t;
        free->setStep(length);
        QVERIFY(free->advance(plain, plain.t + length).outcome == Outcome::converged);
        QVERIFY(std::abs(of.gap(plain)) < 1e-14);
    }
};

EXTREMAL_TEST(ImpactStepTest)
}  // namespace extremal::impact_test
#include "impact_step_test.moc"
