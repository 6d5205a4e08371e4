// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler arcs between kicks: steps against the definition of the action by other code, orders in q and p,
/// how errors fall with the masses, conics of every kind, round-off over many steps, and which systems are
/// recognised.
#include <QTest>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/free_motion/jacobi_motion.hpp"
#include "engine/family/free_motion/kepler_arc.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/orbit/conic.hpp"
#include "engine/model/parts/held_bodies.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::kepler_arcs_test {
namespace {

Discretization knots(const std::string& id) {
    return {{"kepler-arcs", {{"knots", id}}, {}}, {"auto", {}, {}}, {}};
}
struct Table {
    const char* id;
    std::function<Splitting()> make;
};
const std::vector<Table>& tables() {
    static const std::vector<Table> all = {{"strang", strang},
                                           {"lobatto-3", [] { return lobattoKicks(3); }},
                                           {"lobatto-4", [] { return lobattoKicks(4); }},
                                           {"gauss-2", [] { return gaussKicks(2); }},
                                           {"gauss-3", [] { return gaussKicks(3); }},
                                           {"aba-10-4", aba104},
                                           {"aba-8-6-4", aba864},
                                           {"aba-10-6-4", aba1064},
                                           {"srkn-6b", srkn6b},
                                           {"srkn-11b", srkn11b},
                                           {"srkn-14a", srkn14a}};
    return all;
}

struct Motion {
    const char* name;
    System system;
    State start;
    double end;
};
/// A star and two planets, and two planets about a fixed centre, one of which escapes, under a potential that
/// is written as a Hamiltonian.
std::vector<Motion> motions() {
    std::vector<Motion> all;
    all.push_back({"planets",
                   laws::planets(),
                   {0, 0, {0.1, -0.2, 1, 0, -0.3, 1.9, 0.01, 0, 0, 0.05, -0.014, -0.002}},
                   8});
    all.push_back(
        {"fixed centre",
         laws::systemNamed("hamiltonian", {{"coordinates", Value(Value::Array{"x", "u", "y", "v"})},
                                           {"parameters", Value(Value::Object{{"m", 0.05}})},
                                           {"hamiltonian",
                                            "(p_x^2 + p_y^2)/2 + (p_u^2 + p_v^2)/(2*m) - 1/sqrt(x^2 + y^2) - "
                                            "m/sqrt(u^2 + v^2) - m/20/sqrt((x-u)^2 + (y-v)^2)"}}),
         {0, 0, {1, -2, 0, 0.1, 0.1, 0, 1.1, -0.06}},
         6});
    return all;
}

/// r = J q: the last row is the centre of mass.
Eigen::MatrixXd jacobi(const std::vector<double>& masses) {
    const auto n = static_cast<Eigen::Index>(masses.size());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
    double inside = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double m = masses[static_cast<std::size_t>(i)];
        if (i > 0) {
            J(i - 1, i) = 1;
            for (Eigen::Index j = 0; j < i; ++j) J(i - 1, j) = -masses[static_cast<std::size_t>(j)] / inside;
        }
        inside += m;
    }
    for (Eigen::Index j = 0; j < n; ++j) J(n - 1, j) = masses[static_cast<std::size_t>(j)] / inside;
    return J;
}

/// The Kepler motions of the three bodies of laws::planets as a typed Lagrangian in Jacobi coordinates.
System keplerInJacobi(double m, double n) {
    const double first = m / (1 + m), second = n * (1 + m) / (1 + m + n), all = 1 + m + n;
    return laws::systemNamed(
        "lagrangian",
        {{"coordinates", Value(Value::Array{"a", "b", "c", "d", "e", "f"})},
         {"parameters", Value(Value::Object{{"k", first}, {"l", second}, {"M", all}, {"m", m}, {"n", n}})},
         {"lagrangian",
          "k/2*(a_t^2 + b_t^2) + l/2*(c_t^2 + d_t^2) + M/2*(e_t^2 + f_t^2) + m/sqrt(a^2 + b^2) + "
          "n/sqrt(c^2 + d^2)"}});
}

std::vector<double> endOf(const System& system, const State& start, double end, const Discretization& d,
                          int n) {
    const auto integrator = makeIntegrator(system, d, {start.t, end / n});
    return laws::after(*integrator, start, n).value().x;
}

}  // namespace

class KeplerArcsTest : public QObject {
    Q_OBJECT

private slots:
    void stepsAreThoseOfTheAction_data() {
        QTest::addColumn<int>("table");
        for (int k = 0; k < static_cast<int>(tables().size()); ++k)
            QTest::addRow("%s", tables()[static_cast<std::size_t>(k)].id) << k;
    }
    /// Jacobi coordinates by a matrix, arcs by Gauss 24 on the Kepler problems alone, kicks by the forces of
    /// the system less those of the arcs.
    void stepsAreThoseOfTheAction() {
        QFETCH(int, table);
        const Motion m = motions()[0];
        const double h = 0.2, mass = 0.05, other = 0.4 * mass;
        State state = m.start;
        const Table& t = tables()[static_cast<std::size_t>(table)];
        const auto integrator = makeIntegrator(m.system, knots(t.id), {0, h});
        QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);

        const Eigen::MatrixXd J = jacobi({1, mass, other}), back = J.inverse();
        const System arcs = keplerInJacobi(mass, other);
        const Eigen::Matrix<double, 3, 2, Eigen::RowMajor> q0 =
            Eigen::Map<const Eigen::Matrix<double, 3, 2, Eigen::RowMajor>>(m.start.x.data());
        const Eigen::Matrix<double, 3, 2, Eigen::RowMajor> p0 =
            Eigen::Map<const Eigen::Matrix<double, 3, 2, Eigen::RowMajor>>(m.start.x.data() + 6);
        Eigen::Matrix<double, 3, 2, Eigen::RowMajor> r = J * q0, p = back.transpose() * p0, force;
        for (const SplittingStage& stage : t.make().stages) {
            if (!stage.isKick) {
                State s{0, 0, std::vector<double>(12)};
                std::copy_n(r.data(), 6, s.x.data());
                std::copy_n(p.data(), 6, s.x.data() + 6);
                const auto x = endOf(arcs, s, stage.fraction * h, *namedScheme("galerkin-gauss-12"), 4);
                std::copy_n(x.data(), 6, r.data());
                std::copy_n(x.data() + 6, 6, p.data());
                continue;
            }
            const Eigen::Matrix<double, 3, 2, Eigen::RowMajor> q = back * r;
            m.system.mechanics().force(m.system.mechanics().model.get(), 0, q.data(), force.data());
            force = (back.transpose() * force).eval();
            const double strength[] = {mass, other};
            for (Eigen::Index i = 0; i < 2; ++i)
                force.row(i) += strength[i] * r.row(i) / std::pow(r.row(i).norm(), 3);
            p += stage.fraction * h * force;
        }
        const Eigen::Matrix<double, 3, 2, Eigen::RowMajor> q1 = back * r, p1 = J.transpose() * p;
        double most = 0;
        for (int i = 0; i < 6; ++i) {
            const auto k = static_cast<std::size_t>(i);
            most = std::max(
                {most, std::abs(q1.data()[i] - state.x[k]), std::abs(p1.data()[i] - state.x[6 + k])});
        }
        qInfo("%.1e", most);
        QVERIFY(most < 1e-14);
    }
    void ordersInPlaceAndMomentum_data() {
        QTest::addColumn<int>("motion");
        QTest::addColumn<int>("table");
        const auto all = motions();
        for (int m = 0; m < static_cast<int>(all.size()); ++m)
            // About the fixed centre the others are at round-off from the coarsest steps on.
            for (int k = 0; k < (m == 0 ? static_cast<int>(tables().size()) : 6); ++k)
                QTest::addRow("%s, %s", all[static_cast<std::size_t>(m)].name,
                              tables()[static_cast<std::size_t>(k)].id)
                    << m << k;
    }
    void ordersInPlaceAndMomentum() {
        QFETCH(int, motion);
        QFETCH(int, table);
        const Motion m = motions()[static_cast<std::size_t>(motion)];
        const Table& t = tables()[static_cast<std::size_t>(table)];
        const Discretization scheme = knots(t.id);
        const int order = describe(scheme, m.system).claims.order;
        QCOMPARE(order, t.make().order);
        const auto exact = endOf(m.system, m.start, m.end, *namedScheme("galerkin-gauss-8"), 400);
        const std::size_t d = exact.size() / 2;
        std::vector<double> steps, places, momenta;
        for (int n = 8; n < 4000; n = static_cast<int>(std::ceil(1.3 * n))) {
            const auto x = endOf(m.system, m.start, m.end, scheme, n);
            const double q = laws::distance(x, exact, 0, d), p = laws::distance(x, exact, d, 2 * d);
            if (q < 3e-12 || p < 3e-13) break;
            steps.push_back(-std::log(n));
            places.push_back(std::log(q));
            momenta.push_back(std::log(p));
        }
        // Of the others the terms e h^p count to round-off, p above the order, and change their signs.
        const bool isClean = order == 2 || t.id == std::string("aba-10-4");
        const auto last = static_cast<std::ptrdiff_t>(std::min<std::size_t>(isClean ? 4 : 9, steps.size()));
        QVERIFY(last >= 4);
        for (auto* v : {&steps, &places, &momenta}) v->erase(v->begin(), v->end() - last);
        qInfo("q %.2f, p %.2f", slope(steps, places), slope(steps, momenta));
        for (const double found : {slope(steps, places), slope(steps, momenta)})
            QVERIFY(found > order - 0.3 && (!isClean || found < order + 0.3));
    }
    /// e h^(2n) + e^2 h^2 of the nodes of Gauss: with a tenth of the masses a hundredth of the error where
    /// the second term counts, a tenth where the first one does.
    void errorsFallWithTheMasses() {
        const auto errorWith = [&](double mass, const char* id, int n) {
            const System system = laws::planets(mass);
            State start = motions()[0].start;
            for (std::size_t i = 8; i < 12; ++i) start.x[i] *= mass / 0.05;
            const auto exact = endOf(system, start, 8, *namedScheme("galerkin-gauss-8"), 400);
            return laws::distance(endOf(system, start, 8, knots(id), n), exact, 0, 6);
        };
        for (const auto& [id, factor] :
             {std::pair{"gauss-3", 100.0}, {"lobatto-4", 100.0}, {"strang", 10.0}}) {
            const double found = errorWith(0.05, id, 100) / errorWith(0.005, id, 100);
            qInfo("%s: %.1f", id, found);
            QVERIFY(found > 0.6 * factor && found < 1.7 * factor);
        }
    }
    /// Against orbits that count from their perihelion; times beyond it, behind it, many turns, and
    /// backwards.
    void arcsOfEveryConic() {
        double most = 0;
        for (const double speed : {0.02, 0.5, 1.0, 1.3, 1.41421356237309515, 1.4143, 2.0, 5.0})
            for (const double angle : {0.3, 1.2, 1.9, 2.8, 4.4})
                for (const double time : {0.001, 0.3, 2.0, 7.0, 40.0, 300.0, -1.0, -55.0}) {
                    const double mu = 1.7, v = speed * std::sqrt(mu), x0 = 0.6, y0 = -0.8;
                    State s{0, 0, {x0, y0, v * std::cos(angle), v * std::sin(angle)}};
                    std::array<double, 4> exact;
                    const Conic conic(mu, s);
                    QVERIFY(conic.isKnown());
                    conic(time, exact.data());
                    std::array<double, 3> x{s.x[0], s.x[1], 0}, u{s.x[2], s.x[3], 0};
                    KeplerArc::move(x, u, mu, time);
                    // A time to round-off is a place to the velocity of there, a perihelion to 1/r^2.
                    const double r = std::hypot(exact[0], exact[1]), fast = std::hypot(exact[2], exact[3]),
                                 least = std::min(r, 1 - std::min(1.0, conic.eccentricity())) + 1e-3,
                                 size = (std::abs(time) + 10) * (fast + 1 / (r * r) + r) / least;
                    for (std::size_t k = 0; k < 2; ++k)
                        most = std::max(
                            {most, std::abs(x[k] - exact[k]) / size, std::abs(u[k] - exact[k + 2]) / size});
                }
        qInfo("%.1e", most);
        QVERIFY(most < 2e-15);
    }
    /// Eight ellipses in the lanes, and one by one.
    void lanesMoveLikeOne() {
        double most = 0;
        for (const double e : {0.0, 0.05, 0.4, 0.9, 0.99})
            for (const double time : {0.01, 0.7, 4.0, 60.0, -3.0}) {
                std::array<std::array<double, 8>, 3> x{}, v{};
                std::array<double, 8> mu{};
                for (std::size_t i = 0; i < 8; ++i) {
                    const double a = 1 + 0.3 * static_cast<double>(i);
                    mu[i] = 0.4 + 0.2 * static_cast<double>(i);
                    x[0][i] = a * (1 + e);
                    x[2][i] = 0.1;
                    v[1][i] = std::sqrt(mu[i] / a * (1 - e) / (1 + e));
                    v[0][i] = i % 2 == 0 ? 0 : 0.1 * v[1][i];
                }
                auto y = x, w = v;
                QVERIFY(moveOnEllipses({{y[0].data(), y[1].data(), y[2].data()},
                                        {w[0].data(), w[1].data(), w[2].data()},
                                        mu.data()},
                                       time));
                for (std::size_t i = 0; i < 8; ++i) {
                    std::array<double, 3> one{x[0][i], x[1][i], x[2][i]}, speed{v[0][i], v[1][i], v[2][i]};
                    KeplerArc::move(one, speed, mu[i], time);
                    for (std::size_t k = 0; k < 3; ++k)
                        most = std::max(
                            {most, (1 - e) * std::abs(y[k][i] - one[k]) / (std::abs(time) + 1),
                             (1 - e) * (1 - e) * std::abs(w[k][i] - speed[k]) / (std::abs(time) + 1)});
                }
            }
        qInfo("%.1e", most);
        QVERIFY(most < 2e-14);
        std::array<std::array<double, 8>, 6> escaping{};
        std::array<double, 8> mu{};
        mu.fill(1);
        escaping[0].fill(1);
        escaping[4].fill(1.5);
        const auto before = escaping;
        QVERIFY(!moveOnEllipses({{escaping[0].data(), escaping[1].data(), escaping[2].data()},
                                 {escaping[3].data(), escaping[4].data(), escaping[5].data()},
                                 mu.data()},
                                1));
        QCOMPARE(escaping, before);
    }
    /// 100,000 steps: the energy is that of the first step to a random walk of round-off, not to a drift.
    void roundingDoesNotAddUp() {
        const System system = laws::systemNamed("outer-solar-system");
        const ModelEntry& entry = *findModel("outer-solar-system");
        State state{0, 0, entry.exampleQ};
        state.x.insert(state.x.end(), entry.exampleP.begin(), entry.exampleP.end());
        const auto integrator = makeIntegrator(system, knots("aba-10-6-4"), {0, 50});
        const EnergyFunction energy = energyOf(system);
        const double first = energy(0, state.x.data());
        double most = 0;
        for (int i = 0; i < 100000; ++i) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            most = std::max(most, std::abs(energy(0, state.x.data()) / first - 1));
        }
        qInfo("%.1e", most);
        QVERIFY(most < 4e-13);
    }
    void systemsAreRecognised() {
        const auto held = [](const System& system) { return system.parts.find<HeldBodies>(); };
        const auto typed = [](Value::Array coordinates, const char* lagrangian) {
            return laws::systemNamed(
                "lagrangian", {{"coordinates", Value(std::move(coordinates))}, {"lagrangian", lagrangian}});
        };
        const HeldBodies* found = held(laws::planets());
        QVERIFY(found);
        QCOMPARE(found->bodies.size(), 3u);
        QCOMPARE(found->bodies[2].place, (std::array<int, 3>{4, 5, -1}));
        QVERIFY(std::abs(found->bodies[2].strength - 0.02) < 1e-12);
        QVERIFY(held(motions()[1].system));
        QVERIFY(std::isinf(held(motions()[1].system)->bodies[0].mass));
        // Axis by axis, in space, the heavy one in the middle.
        const System moons =
            typed({"x1", "x2", "x3", "y1", "y2", "y3", "z1", "z2", "z3"},
                  "0.01*(x1_t^2 + y1_t^2 + z1_t^2) + 2*(x2_t^2 + y2_t^2 + z2_t^2) + "
                  "0.02*(x3_t^2 + y3_t^2 + z3_t^2) + 0.08/sqrt((x1-x2)^2+(y1-y2)^2+(z1-z2)^2) + "
                  "0.16/sqrt((x3-x2)^2+(y3-y2)^2+(z3-z2)^2)");
        QVERIFY(held(moons));
        QCOMPARE(held(moons)->bodies[0].place, (std::array<int, 3>{1, 4, 7}));
        // Of other powers, of like masses, with a spring besides, with unlike masses of x and y, of one body.
        for (const System& other :
             {typed({"x", "y", "u", "v"}, "(x_t^2+y_t^2)/2 + 20*(u_t^2+v_t^2) + 1/((x-u)^2+(y-v)^2)"),
              typed({"x", "y", "u", "v"}, "(x_t^2+y_t^2)/2 + (u_t^2+v_t^2) + 1/sqrt((x-u)^2+(y-v)^2)"),
              typed({"x", "y", "u", "v"},
                    "(x_t^2+y_t^2)/2 + 20*(u_t^2+v_t^2) + 1/sqrt((x-u)^2+(y-v)^2) - x^2"),
              typed({"x", "y", "u", "v"}, "(x_t^2+2*y_t^2)/2 + 20*(u_t^2+v_t^2) + 1/sqrt((x-u)^2+(y-v)^2)"),
              typed({"x", "y", "u", "v"}, "(x_t^2+y_t^2)/2 + 20*(u_t^2+v_t^2) - 1/sqrt((x-u)^2+(y-v)^2)"),
              laws::systemNamed("kepler"), laws::systemNamed("henon-heiles")}) {
            QVERIFY(!held(other));
            QVERIFY(mismatch(knots("strang"), other).find("Kepler arcs are for") == 0);
            QVERIFY_THROWS_EXCEPTION(InvalidScene, (void)makeIntegrator(other, knots("strang"), {0, 0.1}));
        }
        QVERIFY(mismatch(knots("strang"), moons).empty());
    }
    /// The outer planets as a formula have the steps of the built-in model.
    void typedPlanetsAreTheBuiltInOnes() {
        const System system = laws::systemNamed("outer-solar-system");
        const ModelEntry& entry = *findModel("outer-solar-system");
        State state{0, 0, entry.exampleQ};
        state.x.insert(state.x.end(), entry.exampleP.begin(), entry.exampleP.end());
        Value::Array coordinates;
        std::string kinetic, pulls;
        const double G = 2.95912208286e-4;
        const auto name = [](int i, char axis) { return std::string(1, axis) + std::to_string(i); };
        for (int i = 0; i < 6; ++i) {
            const double m = system.mechanics().masses[3 * i];
            for (const char axis : {'x', 'y', 'z'}) {
                coordinates.emplace_back(name(i, axis));
                kinetic +=
                    (kinetic.empty() ? "" : " + ") + formatNumber(m / 2) + "*" + name(i, axis) + "_t^2";
            }
            for (int j = 0; j < i; ++j) {
                pulls += " + " + formatNumber(G * m * system.mechanics().masses[3 * j]) + "/sqrt(0";
                for (const char axis : {'x', 'y', 'z'})
                    pulls += " + (" + name(i, axis) + "-" + name(j, axis) + ")^2";
                pulls += ")";
            }
        }
        const System typed = laws::systemNamed(
            "lagrangian", {{"coordinates", Value(coordinates)}, {"lagrangian", kinetic + pulls}});
        QVERIFY(typed.parts.find<HeldBodies>());
        const auto a = endOf(system, state, 4000, knots("aba-10-6-4"), 10),
                   b = endOf(typed, state, 4000, knots("aba-10-6-4"), 10);
        const double q = laws::distance(a, b, 0, 18);
        qInfo("%.1e", q);
        QVERIFY(q < 1e-12);
    }
};

EXTREMAL_TEST(KeplerArcsTest)

}  // namespace extremal::kepler_arcs_test

#include "kepler_arcs_test.moc"
