// SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of points on spheres: orders against another route, which has coordinates in space and multipliers
/// and knows neither charts nor momenta; poles, momenta, long runs, rotated scenes, the way back and
/// refusals.
#include <QTest>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/core/problem.hpp"
#include "engine/model/group/sphere_system.hpp"
#include "engine/model/symplectic_form.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::spheres_test {
namespace {

using namespace laws;
using Three = Eigen::Vector3d;
using List = std::vector<double>;
using Rates = std::function<void(const List& y, List& dy)>;

Value listOf(const Three& v) { return Value::Array{v(0), v(1), v(2)}; }
Three threeAt(const List& y, std::size_t from) { return {y[from], y[from + 1], y[from + 2]}; }
void put(const Three& v, List& y, std::size_t from) {
    std::copy_n(v.data(), 3, y.begin() + static_cast<long>(from));
}

/// Places and velocities of each sphere at the start, and their rates.
struct SphereCase {
    const char* name;
    Value::Array spheres;
    Value lagrangian;
    List places, velocities;
    Rates rates;  ///< of (places, velocities)
    std::function<List(const List& y)> momenta;
    double duration;
    int coarsest;

    System system(const Value::Object& parameters = {}) const {
        return systemNamed("spheres",
                           {{"spheres", spheres}, {"lagrangian", lagrangian}, {"parameters", parameters}});
    }
    State start(const System& system) const {
        Settings initial;
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            const std::string sphere = spheres[k].asString();
            initial.keys.emplace_back(sphere, listOf(threeAt(places, 3 * k)));
            initial.keys.emplace_back(sphere + "_t", listOf(threeAt(velocities, 3 * k)));
        }
        return {0, 0, system.start(initial, 0)};
    }
    /// The state at the end.
    List reference() const {
        List y = places;
        y.insert(y.end(), velocities.begin(), velocities.end());
        const auto rate = [this](const List& at, List& dy, double) { rates(at, dy); };
        boost::numeric::odeint::runge_kutta_fehlberg78<List> stepper;
        constexpr int steps = 2000;
        for (int k = 0; k < steps; ++k) stepper.do_step(rate, y, k * duration / steps, duration / steps);
        List x(y.begin(), y.begin() + static_cast<long>(places.size()));
        const List pi = momenta(y);
        x.insert(x.end(), pi.begin(), pi.end());
        return x;
    }
};

/// x'' = -e_3 + (x_3 - |x'|^2) x.
void pendulumRates(const List& y, List& dy) {
    const Three x = threeAt(y, 0), v = threeAt(y, 3);
    put(v, dy, 0);
    put(-Three::UnitZ() + (x(2) - v.squaredNorm()) * x, dy, 3);
}
List pendulumMomentum(const List& y) {
    List pi(3);
    put(threeAt(y, 0).cross(threeAt(y, 3)), pi, 0);
    return pi;
}

SphereCase pendulum(const char* name, const Three& x, const Three& v) {
    return {name,
            {"x"},
            "(x_1_t^2 + x_2_t^2 + x_3_t^2)/2 - x_3",
            {x(0), x(1), x(2)},
            {v(0), v(1), v(2)},
            pendulumRates,
            pendulumMomentum,
            10,
            20};
}

/// 2u'' + w'' = -2 e_3 + a u, u'' + w'' = -e_3 + b w, with the multipliers of |u| = |w| = 1.
void doubleRates(const List& y, List& dy) {
    const Three u = threeAt(y, 0), w = threeAt(y, 3), du = threeAt(y, 6), dw = threeAt(y, 9);
    const double c = u.dot(w), right = u(2) - du.squaredNorm(), other = -dw.squaredNorm();
    const double b = (other + c * right) / (2 - c * c), a = right + b * c;
    put(du, dy, 0);
    put(dw, dy, 3);
    put(-Three::UnitZ() + a * u - b * w, dy, 6);
    put(-a * u + 2 * b * w, dy, 9);
}
List doubleMomenta(const List& y) {
    const Three u = threeAt(y, 0), w = threeAt(y, 3), du = threeAt(y, 6), dw = threeAt(y, 9);
    List pi(6);
    put(u.cross(2 * du + dw), pi, 0);
    put(w.cross(du + dw), pi, 3);
    return pi;
}
const char* const linked =
    "(u_1_t^2 + u_2_t^2 + u_3_t^2)/2 + ((u_1_t + w_1_t)^2 + (u_2_t + w_2_t)^2 + (u_3_t + w_3_t)^2)/2";
SphereCase doublePendulum() {
    return {"double spherical pendulum",
            {"u", "w"},
            std::string(linked) + " - 2*u_3 - w_3",
            {0.8, 0, -0.6, 0, 0.6, -0.8},
            {0, 0.4, 0, 0.5, 0, 0},
            doubleRates,
            doubleMomenta,
            5,
            20};
}

std::vector<SphereCase> sphereCases() {
    return {pendulum("spherical pendulum", {0.8, 0, -0.6}, {0, 0.7, 0}),
            pendulum("planar, through both poles", {0, 0, 1}, {0.6, 0, 0}), doublePendulum()};
}

double verticalOf(const List& x) {
    double sum = 0;
    for (std::size_t k = x.size() / 2 + 2; k < x.size(); k += 3) sum += x[k];
    return sum;
}

/// A state displaced along the spheres by the tangent vectors F (zeta x e_3) and by momenta in the frames
/// that go there on shortest lines, and the opposite.
State displaced(const GroupMechanics& on, const State& from, const Eigen::VectorXd& by) {
    const MatrixGroup::Entries frames = spheres::framesAt(on, from.x.data());
    State to = from;
    const Eigen::Index d = on.dimension();
    for (Eigen::Index k = 0; k < d; k += 3) {
        const Eigen::Matrix3d F = spheres::frameOf(frames, static_cast<int>(k));
        const Three zeta(by(2 * k / 3), by(2 * k / 3 + 1), 0),
            change(by(2 * d / 3 + 2 * k / 3), by(2 * d / 3 + 2 * k / 3 + 1), 0),
            mu = F.transpose() * threeAt(from.x, static_cast<std::size_t>(d + k)) + change;
        const Eigen::Matrix3d R = F * so3::Exponential<double, 0>(zeta).rotation();
        put(R.col(2), to.x, static_cast<std::size_t>(k));
        put(R * mu, to.x, static_cast<std::size_t>(d + k));
    }
    return to;
}
Eigen::VectorXd difference(const GroupMechanics& on, const State& from, const State& to) {
    const MatrixGroup::Entries frames = spheres::framesAt(on, from.x.data());
    const Eigen::Index d = on.dimension();
    Eigen::VectorXd v(4 * d / 3);
    for (Eigen::Index k = 0; k < d; k += 3) {
        const Eigen::Matrix3d F = spheres::frameOf(frames, static_cast<int>(k));
        const Three x = F.transpose() * threeAt(to.x, static_cast<std::size_t>(k));
        const double sine = std::hypot(x(0), x(1)), ratio = sine > 0 ? std::atan2(sine, x(2)) / sine : 1;
        const Three zeta(-ratio * x(1), ratio * x(0), 0);
        const auto muAt = [&](const State& s, const Eigen::Matrix3d& R) -> Three {
            return R.transpose() * threeAt(s.x, static_cast<std::size_t>(d + k));
        };
        const Three change = muAt(to, F * so3::Exponential<double, 0>(zeta).rotation()) - muAt(from, F);
        v.segment<2>(2 * k / 3) = zeta.head<2>();
        v.segment<2>(2 * d / 3 + 2 * k / 3) = change.head<2>();
    }
    return v;
}

double distanceFromSpheres(const System& system, const State& state) {
    double value = 0;
    measureOf(system, "group-distance")->bind(state)(state.t, state.x.data(), &value);
    return value;
}

std::string refusalOf(const Value::Array& spheres, const char* lagrangian) {
    try {
        const System system = systemNamed(
            "spheres", {{"spheres", spheres}, {"lagrangian", lagrangian}, {"parameters", Value::Object{}}});
        findModel("spheres")->checkInitial({}, system, {0, 0, system.start({}, 0)});
    } catch (const InvalidScene& e) {
        return e.problems()[0].pointer + " " + e.problems()[0].message;
    }
    return "accepted";
}

}  // namespace

class SpheresTest : public QObject {
    Q_OBJECT

private slots:
    void orders() {
        for (const SphereCase& each : sphereCases()) {
            const System system = each.system();
            const State start = each.start(system);
            const List reference = each.reference();
            const std::size_t half = start.x.size() / 2;
            for (int k = 2; k <= 9; ++k) {
                const int s = k / 2;
                const LieForm& form = lieForms[k % 2 == 0 ? 0 : 2];
                double slope = 0, slopePi = 0, before = 0, beforePi = 0;
                std::string row;
                for (int n = each.coarsest; n <= 8 * each.coarsest; n *= 2) {
                    const auto end =
                        after(*makeIntegrator(system, lieFormed(s, form), {0, each.duration / n}), start, n);
                    QVERIFY(end);
                    const double now = distance(end->x, reference, 0, half),
                                 nowPi = distance(end->x, reference, half, 2 * half);
                    row += QString::asprintf(" %.3e/%.3e", now, nowPi).toStdString();
                    if (std::min(now, nowPi) < 2e-12) break;
                    slope = std::log2(before / now);
                    slopePi = std::log2(beforePi / nowPi);
                    before = now;
                    beforePi = nowPi;
                }
                qInfo("%s, s = %d%s: x/pi%s, slopes %.2f, %.2f", each.name, s, form.name, row.c_str(), slope,
                      slopePi);
                // Of degree 4 the coarsest pair is the only one above round-off, and is better than its
                // order.
                const double most = s < 4 ? 2 * s + 0.2 : 11;
                QVERIFY2(slope > 2 * s - 0.2 && slope < most, each.name);
                QVERIFY2(slopePi > 2 * s - 0.2 && slopePi < most, each.name);
            }
        }
    }

    void momenta() {
        for (const SphereCase& each : sphereCases()) {
            const System system = each.system();
            QCOMPARE(system.momenta.size(), std::size_t{1});
            QCOMPARE(system.momenta[0].name, std::string("angular.z"));
            const State start = each.start(system);
            for (const int s : {1, 2}) {
                const auto end = after(*makeIntegrator(system, liePair(s), {0, 0.1}), start, 2000);
                QVERIFY(end);
                const double change = std::abs(verticalOf(end->x) - verticalOf(start.x));
                qInfo("%s, s = %d: vertical momentum %.1e", each.name, s, change);
                QVERIFY(change < 2e-14);
            }
        }
        // Two links without weight: all of the sum.
        SphereCase free = doublePendulum();
        free.lagrangian = linked;
        const System system = free.system();
        QCOMPARE(system.momenta.size(), std::size_t{3});
        const State start = free.start(system);
        const auto end = after(*makeIntegrator(system, liePair(2), {0, 0.1}), start, 2000);
        QVERIFY(end);
        for (const MomentumMap& each : system.momenta)
            QVERIFY(std::abs(each.value(end->x.data(), end->x.data()) -
                             each.value(start.x.data(), start.x.data())) < 2e-14);
    }

    /// A part of pi along x grows by 1/(x_0 . x_1) from step to step, unless it is taken away.
    void longRun() {
        const SphereCase each = sphereCases()[0];
        const System system = each.system();
        const State start = each.start(system);
        const double energy = system.energy(0, start.x.data());
        for (int s = 1; s <= 3; ++s) {
            const auto integrator = makeIntegrator(system, liePair(s), {0, 0.2});
            State state = start;
            double quarters[4] = {};
            constexpr int steps = 20000;
            for (int k = 0; k < steps; ++k) {
                QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                double& worst = quarters[4 * k / steps];
                worst = std::max(worst, std::abs(system.energy(0, state.x.data()) - energy));
            }
            const double off = distanceFromSpheres(system, state);
            qInfo("s = %d: energy %.3e %.3e %.3e %.3e, distance %.1e, vertical momentum %.1e", s, quarters[0],
                  quarters[1], quarters[2], quarters[3], off,
                  std::abs(verticalOf(state.x) - verticalOf(start.x)));
            QVERIFY(off < 1e-15);
            for (const double quarter : quarters) QVERIFY(std::abs(quarter / quarters[0] - 1) < 0.05);
            QVERIFY(std::abs(verticalOf(state.x) - verticalOf(start.x)) < 1e-13);
        }
    }

    /// No force has a vertical component, and pi . x is not taken from pi: with that J_z moved by 6.7e-12.
    void verticalMomentum() {
        const SphereCase each = sphereCases()[0];
        const System system = each.system();
        const State start = each.start(system);
        for (const LieForm& form : lieForms)
            for (int s = 1; s <= 3; ++s) {
                const auto end = after(*makeIntegrator(system, lieFormed(s, form), {0, 0.2}), start, 50000);
                QVERIFY(end);
                const double moved = std::abs(verticalOf(end->x) - verticalOf(start.x));
                qInfo("s = %d%s: J_z moves by %.1e in 50000 steps", s, form.name, moved);
                QVERIFY(moved < 1e-14);
            }
    }

    /// Against differences of order 6, the canonical form, and transposed solves.
    void tangents() {
        for (const SphereCase& each : sphereCases()) {
            const System system = each.system();
            const GroupMechanics& on = *system.part<Spheres>().mechanics;
            const auto n = static_cast<Eigen::Index>(each.places.size());
            for (const int s : {1, 2, 3})
                for (const LieForm& form : lieForms) {
                    const Discretization scheme = lieFormed(s, form);
                    const auto integrator = makeIntegrator(system, scheme, {0, 0.1});
                    State state = each.start(system);
                    for (int k = 0; k < 5; ++k)
                        QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                    const State before = state;
                    QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                    const auto M = tangentMap(*integrator);
                    QVERIFY(M);
                    QCOMPARE(M->rows(), 4 * n / 3);
                    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(M->rows(), M->cols());
                    constexpr double delta = 2e-3;
                    for (Eigen::Index j = 0; j < M->cols(); ++j)
                        for (int k = 1; k <= 3; ++k)
                            for (const int sign : {1, -1}) {
                                State moved = displaced(
                                    on, before, Eigen::VectorXd::Unit(M->rows(), j) * (sign * k * delta));
                                QVERIFY(advance(*makeIntegrator(system, scheme, {0, 0.1}), moved).outcome ==
                                        Outcome::converged);
                                D.col(j) +=
                                    difference(on, state, moved) *
                                    (sign * centralDifferences[static_cast<std::size_t>(k - 1)] / delta);
                            }
                    const double apart = (*M - D).cwiseAbs().maxCoeff(),
                                 defect =
                                     formDefect(SymplecticForm(system), before.x.data(), state.x.data(), *M),
                                 transposed = transposedDefect(*integrator, *M);
                    qInfo("%s, s = %d%s: differences %.1e, form %.1e, transposed %.1e", each.name, s,
                          form.name, apart, defect, transposed);
                    QVERIFY2(apart < 1e-9, each.name);
                    QVERIFY2(defect < 1e-13, each.name);
                    QVERIFY2(transposed < 1e-13, each.name);
                }
        }
    }

    void rotatedScene() {
        const Eigen::Matrix3d R =
            Eigen::AngleAxisd(1.1, Three(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
        SphereCase plain = doublePendulum();
        plain.lagrangian =
            std::string(linked) + " - 2*(n1*u_1 + n2*u_2 + n3*u_3) - (n1*w_1 + n2*w_2 + n3*w_3)";
        SphereCase turned = plain;
        for (List* list : {&turned.places, &turned.velocities})
            for (const std::size_t k : {0, 3}) put(R * threeAt(*list, k), *list, k);
        const auto endOf = [](const SphereCase& each, const Three& n, const LieForm& form) {
            const System system = each.system({{"n1", n(0)}, {"n2", n(1)}, {"n3", n(2)}});
            return after(*makeIntegrator(system, lieFormed(2, form), {0, 0.1}), each.start(system), 200);
        };
        for (const LieForm& form : lieForms) {
            const auto one = endOf(plain, Three::UnitZ(), form), other = endOf(turned, R.col(2), form);
            QVERIFY(one && other);
            double apart = 0;
            for (std::size_t k = 0; k < one->x.size(); k += 3)
                apart = std::max(apart, (R * threeAt(one->x, k) - threeAt(other->x, k)).norm());
            qInfo("200 steps, rotated: %.1e", apart);
            QVERIFY(apart < 1e-11);
        }
    }

    void wayBack() {
        for (const SphereCase& each : sphereCases()) {
            const System system = each.system();
            const State start = each.start(system);
            const Discretization scheme = lieFormed(2, lieForms[1]);
            const auto there = after(*makeIntegrator(system, scheme, {0, 0.2}), start, 50);
            QVERIFY(there);
            const auto back = after(*makeIntegrator(system, scheme, {0, -0.2}), {0, 0, there->x}, 50);
            QVERIFY(back);
            const double apart = distance(back->x, start.x, 0, start.x.size());
            qInfo("%s: back to %.1e", each.name, apart);
            QVERIFY(apart < 1e-11);
        }
    }

    void refusals() {
        QVERIFY(refusalOf({"x"}, "(x_1_t^2 + x_2_t^2)/2 - y")
                    .starts_with("/lagrangian the expression has an unknown name \"y\"") ||
                refusalOf({"x"}, "x_1_t^2 - y").find("unknown name \"y\"") != std::string::npos);
        QVERIFY(refusalOf({"x"}, "x_1_t^2 - x_g13").find("unknown name \"x_g13\"") != std::string::npos);
        const std::string degenerate = refusalOf({"x"}, "(x_2_t^2)/2 - x_3");
        QVERIFY2(degenerate.starts_with("/lagrangian is degenerate"), degenerate.c_str());
        QVERIFY(refusalOf({"x", "x"}, "x_1_t^2").starts_with("/spheres/1 the name \"x\" is listed twice"));
        Value::Array many;
        for (int k = 0; k < 401; ++k) many.emplace_back("s" + std::to_string(k));
        QVERIFY(refusalOf(many, "1").starts_with("/spheres has 401"));
        const SphereCase each = sphereCases()[0];
        const System system = each.system();
        Settings initial{"", {{"x", listOf({2, 0, 0})}, {"x_t", listOf({1, 1, 0})}}, {}};
        const auto notes = spheres::startNotesOf(system.part<Spheres>(), initial);
        QCOMPARE(notes.size(), std::size_t{2});
        QCOMPARE(notes[1].pointer, std::string("/x_t"));
        QCOMPARE(refusalOf({"x"}, "(x_1_t^2 + x_2_t^2 + x_3_t^2)/2"), std::string("accepted"));
    }
};

EXTREMAL_TEST(SpheresTest)
}  // namespace extremal::spheres_test

#include "spheres_test.moc"
