// SPDX-License-Identifier: GPL-3.0-or-later
/// Lie group integrators on SE(3): a satellite in the gradient of gravity, bodies that move freely, and what
/// typed potentials keep.
#include <QTest>

#include <algorithm>

#include "tests/laws/bodies.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::motions_test {
namespace {

using Vector = so3::Vector<double>;
using Quaternion = so3::Quaternion<double>;

const char* const gravityGradient =
    "-mu*mass/sqrt(x^2+y^2+z^2) - mu/(2*(x^2+y^2+z^2)^(3/2))*(I1+I2+I3 - 3*(I1*(x*R11+y*R21+z*R31)^2"
    " + I2*(x*R12+y*R22+z*R32)^2 + I3*(x*R13+y*R23+z*R33)^2)/(x^2+y^2+z^2))";

System satellite(const std::string& more = "") {
    return systemNamed("rigid-body-se3", {{"inertia", Value::Array{0.0012, 0.0058, 0.0061}},
                                          {"potential", gravityGradient + more},
                                          {"parameters", Value::Object{{"mu", 1.0}}}});
}
System freelyMoving() {
    return systemNamed("rigid-body-se3", {{"inertia", Value::Array{1.0, 2.0, 3.0}}, {"mass", 2.0}});
}

/// Attitude q, momentum in the body, position and linear momentum in space.
State motionState(const Four& q, const Three& Pi, const Vector& x, const Vector& p) {
    State s = bodyState(Pi, q);
    for (const Vector& v : {x, p}) s.x.insert(s.x.end(), v.data(), v.data() + 3);
    return s;
}
State satelliteStart() {
    return motionState({std::cos(0.15), 0, 0, std::sin(0.15)}, {0.05 * 0.0012, 0.02 * 0.0058, 1.25 * 0.0061},
                       {0.8, 0, 0}, {0, 1.2, 0.1});
}
/// On a nearly round orbit, its long axis swinging about the direction of the centre: a regular motion, where
/// drift shows.
State librating() {
    return motionState({std::cos(0.05), 0, 0, std::sin(0.05)}, {0, 0.02 * 0.0058, 0.0061}, {1, 0, 0},
                       {0, 1.02, 0});
}
State freeStart() {
    return motionState({0.5, 0.5, -0.5, 0.5}, {std::cos(1.1), 0, std::sin(1.1)}, {0.3, -0.4, 0.1},
                       {1.1, 0.6, -0.8});
}

/// Everything turned about the origin.
State turned(const State& s, const Quaternion& by) {
    const so3::Matrix<double> R = so3::matrix(by);
    const Quaternion q = so3::product(by, Quaternion(s.x[0], s.x[1], s.x[2], s.x[3]));
    return motionState({q(0), q(1), q(2), q(3)}, {s.x[4], s.x[5], s.x[6]},
                       R * Vector(s.x[10], s.x[11], s.x[12]), R * Vector(s.x[13], s.x[14], s.x[15]));
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}
/// The four errors of a motion: attitude, momentum in the body relative to `spin`, position, linear momentum.
std::array<double, 4> errorsOf(const State& a, const State& b, double spin) {
    return {attitudeError(a.x, {b.x[0], b.x[1], b.x[2], b.x[3]}),
            momentumError(a.x, {b.x[4], b.x[5], b.x[6]}) / spin, distance(a.x, b.x, 10, 13),
            distance(a.x, b.x, 13, 16)};
}

}  // namespace

class MotionsTest : public QObject {
    Q_OBJECT
private slots:
    void ordersOfAttitudeMomentumAndPosition_data() {
        QTest::addColumn<bool>("isFree");
        QTest::addColumn<int>("degree");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<int>("form");
        for (const bool isFree : {false, true})
            for (int degree = 1; degree <= 4; ++degree)
                for (const char* rule : {"gauss", "lobatto"})
                    for (int form = 0; form < std::ssize(lieForms); ++form)
                        QTest::addRow("%s, degree %d, %s%s", isFree ? "free" : "satellite", degree, rule,
                                      lieForms[form].name)
                            << isFree << degree << QString(rule) << form;
    }
    void ordersOfAttitudeMomentumAndPosition() {
        QFETCH(bool, isFree);
        QFETCH(int, degree);
        QFETCH(QString, rule);
        QFETCH(int, form);
        const System system = isFree ? freelyMoving() : satellite();
        const State start = isFree ? freeStart() : satelliteStart();
        const double T = 3, spin = isFree ? 1 : 0.0076;
        const auto run = [&](const Discretization& discretization, int n) {
            return after(*makeIntegrator(system, discretization, {0, T / n}), start, n);
        };
        const auto reference = run(liePair(8), isFree ? 40 : 160);
        QVERIFY(reference.has_value());
        std::vector<double> h;
        std::array<std::vector<double>, 4> errors;
        // Where the first term reigns: the errors of high degrees have to be small, and are soon at
        // round-off.
        const double largest = degree == 4 ? 1e-6 : 3e-3, smallest = degree == 4 ? 1e-12 : 2e-12;
        for (double n = 2; n < 2000; n *= degree == 4 ? 1.15 : 1.3) {
            const auto end =
                run(lieFormed(degree, lieForms[form], {rule.toStdString(), {}, {}}), static_cast<int>(n));
            if (!end) continue;
            const auto e = errorsOf(*end, *reference, spin);
            const int kinds = isFree ? 3 : 4;  // free: the linear momentum is exact
            if (*std::max_element(e.begin(), e.begin() + kinds) > largest) continue;
            if (*std::min_element(e.begin(), e.begin() + kinds) < smallest) break;
            h.push_back(-std::log(std::floor(n)));
            for (std::size_t k = 0; k < 4; ++k) errors[k].push_back(std::log(e[k]));
        }
        const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
        QVERIFY2(points >= 3, "no window");
        h.erase(h.begin(), h.end() - points);
        std::array<double, 4> order{};
        for (std::size_t k = 0; k < 4; ++k) {
            errors[k].erase(errors[k].begin(), errors[k].end() - points);
            order[k] = slope(h, errors[k]);
        }
        qInfo("claimed %d, measured attitude %.2f, momentum %.2f, position %.2f, linear momentum %.2f",
              2 * degree, order[0], order[1], order[2], order[3]);
        for (std::size_t k = 0; k < (isFree ? 3 : 4); ++k)
            QVERIFY(std::abs(order[k] - 2 * degree) < (degree == 4 ? 0.5 : 0.1));
    }

    void orbitAndSpinTogetherKeepTheirAngularMomentum() {
        const System system = satellite();
        QCOMPARE(system.momenta.size(), std::size_t(3));
        const EnergyFunction energy = energyOf(system);
        for (int degree = 1; degree <= 4; ++degree) {
            const State start = librating();
            const auto integrator = makeIntegrator(system, liePair(degree), {0, 0.05});
            State s = start;
            double momentum = 0, exchanged = 0;
            std::array<double, 4> worst{};  ///< energy error in each quarter
            constexpr int steps = 40000;
            for (int k = 0; k < steps; ++k) {
                QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
                for (const MomentumMap& map : system.momenta)
                    momentum = std::max(momentum, std::abs(map.value(s.x.data(), nullptr) -
                                                           map.value(start.x.data(), nullptr)));
                exchanged = std::max(exchanged, std::abs(s.x[9] - start.x[9]));
                const double error = energy(0, s.x.data()) - energy(0, start.x.data());
                auto& quarter = worst[static_cast<std::size_t>(4 * k / steps)];
                quarter = std::max(quarter, std::abs(error));
            }
            qInfo("degree %d: momentum %.1e, the spin alone %.1e; energy %.3e %.3e %.3e %.3e", degree,
                  momentum, exchanged, worst[0], worst[1], worst[2], worst[3]);
            QVERIFY(momentum < 1e-12);
            QVERIFY(exchanged > 1e-4);  // neither part is kept by itself: the law can fail
            QVERIFY(worst[3] <= 1.05 * worst[0] + 1e-12);
        }
        // The law can fail: RK4 drifts away.
        Settings keys{"rk4-quaternion", {{"projection", true}}, {}};
        const auto kutta = findBaseline("rk4-quaternion")->make(system, {0.05, {}, 0, keys});
        const State start = librating();
        std::array<double, 2> error{};
        State s = start;
        for (double& e : error) {
            s = after(*kutta, s, 20000).value();
            e = energy(0, s.x.data()) - energy(0, start.x.data());
        }
        qInfo("RK4: energy %.2e after half the time, %.2e at the end; momentum %.1e", error[0], error[1],
              std::abs(system.momenta[2].value(s.x.data(), nullptr) -
                       system.momenta[2].value(start.x.data(), nullptr)));
        QVERIFY(std::abs(error[1]) > 1.7 * std::abs(error[0]));
    }
    void onlyWhatThePotentialLeavesIsKept() {
        // A pull along x leaves no axis but x; the same run without the claim loses the others.
        const System pulled = satellite(" + x/50");
        QCOMPARE(pulled.momenta.size(), std::size_t(1));
        QCOMPARE(QString::fromStdString(pulled.momenta[0].name), QString("angular.x"));
        const State start = satelliteStart();
        const auto end = after(*makeIntegrator(pulled, liePair(2), {0, 0.05}), start, 200);
        const auto change = [&](const MomentumMap& map) {
            return std::abs(map.value(end->x.data(), nullptr) - map.value(start.x.data(), nullptr));
        };
        QVERIFY(change(pulled.momenta[0]) < 1e-14);
        for (const MomentumMap& map : satellite().momenta)
            if (map.name != "angular.x") QVERIFY(change(map) > 1e-3);
        // No pull depends on the place: a free body, whose linear momenta are kept too.
        QCOMPARE(freelyMoving().momenta.size(), std::size_t(6));
    }

    void freeBodiesGoStraightAndKeepTheirMomentumToTheLastBit() {
        const System system = freelyMoving();
        const State start = freeStart();
        const ExactSolution exact = system.exact(start);
        for (int degree = 1; degree <= 4; ++degree) {
            State s = start;
            const auto integrator = makeIntegrator(system, liePair(degree), {0, 0.1});
            double change = 0;
            for (int k = 0; k < 1000; ++k) {
                QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
                for (std::size_t i = 13; i < 16; ++i)
                    change = std::max(change, std::abs(s.x[i] - start.x[i]));
            }
            std::vector<double> x(16);
            exact(100, x);
            const State right{100, 0, x};
            const auto e = errorsOf(s, right, 1);
            qInfo("degree %d: linear momentum %.1e, attitude %.1e, position %.1e", degree, change, e[0],
                  e[2]);
            QCOMPARE(change, 0.0);
            if (degree == 4)
                QVERIFY(e[0] < 5e-11 && e[2] < 5e-12);  // 1.1e-11 rad after 1000 steps of round-off
        }
    }
    void reducedAndUnreducedStepsAgree() {
        for (int degree = 1; degree <= 4; ++degree) {
            State a = freeStart(), b = a;
            const auto reduced = makeIntegrator(freelyMoving(), liePair(degree), {0, 0.2});
            const auto full =
                makeIntegrator(freelyMoving(), liePair(degree, {"gauss", {}, {}}, false, false), {0, 0.2});
            for (int k = 0; k < 500; ++k) {
                QVERIFY(advance(*reduced, a).outcome == Outcome::converged);
                QVERIFY(advance(*full, b).outcome == Outcome::converged);
            }
            qInfo("degree %d: %.1e after 500 steps", degree, largestDifference(a.x, b.x));
            QVERIFY(largestDifference(a.x, b.x) > 0 && largestDifference(a.x, b.x) < 1e-12);
        }
    }
    void aTurnedStartGivesTheTurnedMotion() {
        const Quaternion by = so3::quaternionExp(Vector(0.7, -1.2, 0.4));
        for (int degree = 1; degree <= 4; ++degree) {
            const auto defect = [&](const System& system) {
                const auto run = [&](const State& s) {
                    return after(*makeIntegrator(system, liePair(degree), {0, 0.1}), s, 50).value();
                };
                State expected = turned(run(satelliteStart()), by), found = run(turned(satelliteStart(), by));
                if (expected.x[0] * found.x[0] < 0)
                    for (std::size_t i = 0; i < 4; ++i) found.x[i] = -found.x[i];
                return largestDifference(expected.x, found.x);
            };
            const double central = defect(satellite()), pulled = defect(satellite(" + x/50"));
            qInfo("degree %d: %.1e; with a pull that has a direction %.1e", degree, central, pulled);
            QVERIFY(central < 1e-12);
            QVERIFY(pulled > 1e-3);  // the law can fail
        }
    }
    void aStartInASingularityIsNoNumber() {
        const System system = systemNamed("rigid-body-se3", {{"potential", "-1/sqrt(x^2+y^2+z^2)"}});
        State s = motionState({1, 0, 0, 0}, {0.1, 0.2, 0.3}, {0, 0, 0}, {0, 0, 0});
        const State start = s;
        QVERIFY(advance(*makeIntegrator(system, liePair(2), {0, 0.1}), s).outcome == Outcome::notFinite);
        QCOMPARE(s.x, start.x);
    }
    void symmetrisedStepsReturn() {
        for (int degree = 2; degree <= 4; ++degree)
            for (const LieForm& form : lieForms) {
                const Discretization discretization = lieFormed(degree, form);
                const auto there =
                    after(*makeIntegrator(satellite(), discretization, {0, 0.2}), satelliteStart(), 1);
                const auto back = after(*makeIntegrator(satellite(), discretization, {0.2, -0.2}), *there, 1);
                const double defect = largestDifference(back->x, satelliteStart().x);
                qInfo("degree %d%s: %.1e", degree, form.name, defect);
                if (form.isSelfAdjoint()) QVERIFY(defect < 1e-14);
                if (!form.isSelfAdjoint() && degree < 4) QVERIFY(defect > 1e-13);
            }
    }
};

EXTREMAL_TEST(MotionsTest)
}  // namespace extremal::laws::motions_test

#include "motions_test.moc"
