// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanisms by their elements: the same numbers as the typed form written by hand, the same motion as
/// closed equations of fewer coordinates, and refusals that name the element and the remedy.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/model/parts/force.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/typed_scene.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::cartesian_test {
namespace {

using mechanism_test::Ending;
using mechanism_test::Mechanical;

std::string textOf(const std::vector<Problem>& problems) {
    std::string all;
    for (const Problem& p : problems) all += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return all;
}

/// A scene with this model, given as JSON without its type.
ReadScene read(const std::string& keys, const std::string& further = "") {
    return readScene(
        parseJson(R"({"extremal": 1, "model": {"type": "mechanism", )" + keys + "}, " + further +
                  R"("time": {"end": 1}, "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.1}]})"));
}
Mechanical mechanical(const std::string& keys) {
    const ReadScene scene = read(keys);
    if (!scene.errors.empty()) qFatal("%s", textOf(scene.errors).c_str());
    return {*scene.resolved->system, scene.resolved->initial};
}

/// The four-bar of the presets, with a motor, a damper and a wall.
const char* const fourBar = R"(
    "points": {"O": {"at": [0, 0], "fixed": true}, "A": {"mass": 1, "at": [-0.416146836547142, 0.909297426825682]},
               "B": {"mass": 2, "at": [1.4963985963719, 1.49425038819995]}, "D": {"at": [2.5, 0], "fixed": true}},
    "rods": {"crank": {"from": "O", "to": "A", "length": 1}, "coupler": {"from": "A", "to": "B", "length": 2},
             "rocker": {"from": "D", "to": "B", "length": 1.8}},
    "dampers": {"damper": {"from": "B", "damping": 1.5}},
    "motors": {"motor": {"rod": "crank", "torque": 12}},
    "walls": {"stop": {"points": ["B"], "through": [1.1, 0], "normal": [1, 0]}})";

Mechanical fourBarByFormulas() {
    return mechanism_test::startAt(
        mechanism_test::typedWith(
            {"x1", "y1", "x2", "y2"}, "(x1_t^2 + y1_t^2)/2 + (x2_t^2 + y2_t^2) - 9.81*y1 - 2*9.81*y2",
            {{"constraints", Value::Object{{"crank", "x1^2 + y1^2 - 1"},
                                           {"coupler", "(x2 - x1)^2 + (y2 - y1)^2 - 4"},
                                           {"rocker", "(x2 - 2.5)^2 + y2^2 - 1.8^2"}}},
             {"forces", Value::Object{{"x1", "-12*y1/(x1^2 + y1^2)"}, {"y1", "12*x1/(x1^2 + y1^2)"}}},
             {"dissipation", "0.75*(x2_t^2 + y2_t^2)"},
             {"walls", Value::Object{{"stop", Value::Object{{"gap", "x2 - 1.1"}, {"restitution", 1}}}}}}),
        {-0.416146836547142, 0.909297426825682, 1.4963985963719, 1.49425038819995}, {0, 0, 0, 0});
}

/// A plate on a pin away from its centre, and a second point of it on a spring.
const char* const plate = R"(
    "points": {"O": {"at": [0, 0], "fixed": true}, "P": {"body": "plate", "at": [-0.3, 0.4]}},
    "bodies": {"plate": {"mass": 2, "inertia": 0.7, "at": [0.3, -0.4], "spin": 1, "velocity": [0.4, 0.3]}},
    "pins": {"pin": {"from": "P", "to": "O"}})";

/// Springs, dampers and motors between points that move, points of a body and the ground.
const char* const manyForces = R"("gravity": 3,
            "points": {"O": {"at": [0, 1], "fixed": true}, "P": {"body": "b", "at": [0.5, 0.2]},
                       "Q": {"body": "b", "at": [-0.5, 0]}, "A": {"mass": 1, "at": [2, 1]}},
            "bodies": {"b": {"mass": 2, "inertia": 0.4, "at": [0, 0], "angle": 0.3}},
            "rods": {"rod": {"from": "O", "to": "Q"}},
            "springs": {"s": {"from": "P", "to": "A", "stiffness": 8, "damping": 0.5}},
            "dampers": {"d": {"from": "O", "to": "A", "damping": 0.7}, "turning": {"body": "b", "damping": 0.1}},
            "motors": {"m": {"rod": "rod", "torque": "2*cos(t)+0"}, "n": {"body": "b", "torque": 0.5}})";

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() ? 0 : 1e300;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

}  // namespace

class MechanismTest : public QObject {
    Q_OBJECT private slots :
        /// Loops, a motor, a damper and a wall: 100 steps and their impacts.
        void
        aFourBarIsThatOfItsFormulas() {
        const Mechanical elements = mechanical(fourBar), formulas = fourBarByFormulas();
        QVERIFY(largestDifference(elements.start.x, formulas.start.x) < 1e-15);
        const Ending a = mechanism_test::run(elements, "galerkin-gauss-2", 2, 100),
                     b = mechanism_test::run(formulas, "galerkin-gauss-2", 2, 100);
        QVERIFY(a.outcome == Outcome::converged && b.outcome == Outcome::converged);
        const double difference = largestDifference(a.state.x, b.state.x);
        qInfo("difference %.1e, impacts %d and %d, |g| %.1e", difference, a.impacts, b.impacts,
              a.largestValue);
        QVERIFY(a.impacts > 0);
        QCOMPARE(a.impacts, b.impacts);
        QVERIFY(difference < 1e-14);  // measured 0
        const Ending one = mechanism_test::run(elements, "galerkin-gauss-2", 0.02, 1),
                     other = mechanism_test::run(formulas, "galerkin-gauss-2", 0.02, 1);
        QVERIFY(largestDifference(one.state.x, other.state.x) < 1e-14);
    }
    /// A body on a pin is a pendulum of one angle: (J + m r^2) phi'' = -m g r sin.
    void aBodyOnAPinIsAPendulumWithInertia() {
        const Mechanical body = mechanical(plate);
        const double angle = std::atan2(-0.4, 0.3);
        const System closed =
            laws::systemNamed("lagrangian", {{"coordinates", Value::Array{"a"}},
                                             {"parameters", Value::Object{}},
                                             {"lagrangian", "(0.7 + 2*0.25)/2*a_t^2 - 2*9.81*0.5*sin(a)"}});
        State s{0, 0, {angle, 1.2}};
        const auto integrator = makeIntegrator(closed, *namedScheme("galerkin-gauss-6"), {0, 0.02});
        for (int i = 0; i < 100; ++i) QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        const Ending end = mechanism_test::run(body, "galerkin-gauss-6", 2, 100);
        QVERIFY(end.outcome == Outcome::converged);
        const double x = end.state.x[0] - 0.5 * std::cos(s.x[0]), y = end.state.x[1] - 0.5 * std::sin(s.x[0]),
                     turned = end.state.x[2] - (s.x[0] - angle);
        qInfo("differences %.1e, %.1e, %.1e", x, y, turned);
        QVERIFY(std::abs(x) + std::abs(y) + std::abs(turned) < 1e-10);
    }
    void orders_data() {
        QTest::addColumn<QString>("keys");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        // Without its wall: the reference does not take walls.
        QString loop = fourBar;
        loop.truncate(loop.indexOf("\"walls\""));
        loop.truncate(loop.lastIndexOf(','));
        for (const auto& [name, keys] :
             {std::pair<const char*, QString>{"plate", plate}, {"four-bar", loop}}) {
            const int few = keys == loop ? 4 : 1;
            QTest::addRow("%s, Gauss 1", name) << keys << "galerkin-gauss-1" << 2 << 100 * few;
            QTest::addRow("%s, Gauss 2", name) << keys << "galerkin-gauss-2" << 4 << 40 * few;
            QTest::addRow("%s, Lobatto 2", name) << keys << "galerkin-lobatto-2" << 4 << 40 * few;
            QTest::addRow("%s, Gauss 3", name) << keys << "galerkin-gauss-3" << 6 << 24 * few;
        }
    }
    void orders() {
        QFETCH(QString, keys);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const auto m =
            mechanism_test::orderOf(mechanical(keys.toStdString()), scheme.toStdString(), 1, steps);
        QVERIFY(m.isDone());
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; |g| %.0e", m.error.q, m.error.p, m.q, m.p,
              m.fine.largestValue);
        QVERIFY(std::abs(m.q - order) < 0.3);
        QVERIFY(std::abs(m.p - order) < 0.3);
        QVERIFY(m.fine.largestValue < 1e-13);
    }
    /// Damping takes what the balance says, of springs, dampers and motors that join moving points and
    /// bodies.
    void energyMinusWorkIsKept() {
        const Mechanical of = mechanical(manyForces);
        const EnergyFunction energy = energyOf(of.system);
        double before = 0;
        for (const int steps : {40, 80}) {
            const Ending end = mechanism_test::run(of, "galerkin-gauss-2", 1, steps);
            QVERIFY(end.outcome == Outcome::converged);
            const double balance =
                std::abs(energy(1, end.state.x.data()) - energy(0, of.start.x.data()) - end.work);
            qInfo("balance %.1e, work %.3f", balance, end.work);
            QVERIFY(std::abs(end.work) > 0.1);
            if (before > 0) QVERIFY(std::abs(std::log2(before / balance) - 4) < 0.5);
            before = balance;
        }
    }
    /// What the forces do on the coordinates is what the elements say of lengths and angles.
    void forcesHaveThePowerOfTheirElements() {
        const Mechanical of = mechanical(manyForces);
        const std::vector<double> q{2.1, 0.8, 0.1, -0.2, 0.4}, v{0.3, -0.7, 0.5, 0.2, 1.3};
        constexpr double t = 0.7, h = 1e-5;
        std::vector<double> force(5);
        const Force& parts = *of.system.parts.find<Force>();
        parts.value(parts.model.get(), t, q.data(), v.data(), force.data());
        double power = 0;
        for (std::size_t i = 0; i < 5; ++i) power += force[i] * v[i];
        // The length of P to A, that of O to A and the angle of O to Q, a time after.
        const auto measured = [&](double time) {
            std::array<double, 5> x{};
            for (std::size_t i = 0; i < 5; ++i) x[i] = q[i] + time * v[i];
            const double c = std::cos(x[4]), s = std::sin(x[4]);
            return std::array<double, 3>{
                std::hypot(x[2] + 0.5 * c - 0.2 * s - x[0], x[3] + 0.5 * s + 0.2 * c - x[1]),
                std::hypot(x[0], x[1] - 1), std::atan2(x[3] - 0.5 * s - 1, x[2] - 0.5 * c)};
        };
        const auto after = measured(h), before = measured(-h);
        const auto rate = [&](std::size_t k) { return (after[k] - before[k]) / (2 * h); };
        const double expected = 2 * std::cos(t) * rate(2) + 0.5 * v[4] - 0.5 * rate(0) * rate(0) -
                                0.7 * rate(1) * rate(1) - 0.1 * v[4] * v[4];
        qInfo("power %.6f, difference %.1e", power, power - expected);
        QVERIFY(std::abs(power - expected) < 1e-8);  // measured 1e-10 or less, of the differences
    }
    /// A crank that is driven has no freedom left, and its end goes around at the given speed.
    void aDrivenCrankTurnsAtItsSpeed() {
        const ReadScene scene = read(R"("parameters": {"w": 3},
            "points": {"O": {"at": [0, 0], "fixed": true}, "A": {"mass": 1, "at": [1, 0]}, "B": {"mass": 1, "at": [3, 0]}},
            "rods": {"crank": {"from": "O", "to": "A"}, "coupler": {"from": "A", "to": "B"}},
            "sliders": {"guide": {"point": "B", "through": [0, 0]}},
            "motors": {"motor": {"rod": "crank", "speed": "w"}})");
        QVERIFY2(scene.errors.empty() && scene.warnings.empty(),
                 (textOf(scene.errors) + textOf(scene.warnings)).c_str());
        const Ending end = mechanism_test::run({*scene.resolved->system, scene.resolved->initial},
                                               "galerkin-gauss-2", 1, 50);
        QVERIFY(end.outcome == Outcome::converged);
        QVERIFY(std::abs(end.state.x[0] - std::cos(3.0)) + std::abs(end.state.x[1] - std::sin(3.0)) < 1e-12);
    }
    /// `extremal formulas`: the written form is a scene of its own with the same motion.
    void theTypedSceneIsTheSame() {
        const ReadScene scene = read(fourBar), typed = readScene(typedScene(*scene.resolved));
        QVERIFY2(typed.errors.empty(), textOf(typed.errors).c_str());
        QCOMPARE(typed.scene.model.type, std::string("lagrangian"));
        QVERIFY(largestDifference(scene.resolved->initial.x, typed.resolved->initial.x) == 0);
        const Ending a = mechanism_test::run({*scene.resolved->system, scene.resolved->initial},
                                             "galerkin-gauss-2", 0.4, 20),
                     b = mechanism_test::run({*typed.resolved->system, typed.resolved->initial},
                                             "galerkin-gauss-2", 0.4, 20);
        QVERIFY(largestDifference(a.state.x, b.state.x) == 0);
    }
    /// The reactions, walls and constraints have the names that the user gave.
    void namesAreThoseOfTheElements() {
        const Mechanical of = mechanical(fourBar);
        QCOMPARE(of.system.parts.find<Constraint>()->names,
                 (std::vector<std::string>{"crank", "coupler", "rocker"}));
        QCOMPARE(of.system.parts.find<Wall>()->names, std::vector<std::string>{"stop"});
    }
    /// Gaps of straight walls, discs and boxes are distances, and have the names of the walls.
    void gapsAreDistances() {
        const Mechanical of = mechanical(R"("points": {"A": {"mass": 1, "at": [1, 2]}}, "walls": {
            "line": {"through": [0, 1], "normal": [3, 4]}, "disc": {"centre": [1, 5], "radius": 1},
            "ring": {"centre": [1, 1], "radius": 3, "inside": true}, "box": {"corner": [4, 3], "opposite": [0, 0]}})");
        const Wall& wall = *of.system.parts.find<Wall>();
        QCOMPARE(wall.names, (std::vector<std::string>{"line", "disc", "ring", "box_left", "box_right",
                                                       "box_bottom", "box_top"}));
        std::vector<double> gap(7), byPlace(14), byTime(7);
        wall.first(wall.model.get(), 0, of.start.x.data(), gap.data(), byPlace.data(), byTime.data());
        const std::vector<double> expected{1.4, 4, 4.0 / 3, 1, 3, 2, 1};
        QVERIFY(largestDifference(gap, expected) < 1e-14);
    }
    /// A start of one's own takes the place of the model's, and is written back into the model.
    void theStartIsTheModels() {
        const ReadScene scene = read(fourBar);
        QVERIFY(writeScene(scene.scene).find("\"q\"") == std::string::npos);
        const auto& form = *scene.resolved->system->parts.find<WrittenForm>();
        std::vector<double> q = form.q, v = form.v;
        q[2] = 7;
        v[0] = 2;
        const Value model = form.withStart(form, toValue(scene.scene).find("model")[0], q.data(), v.data());
        QVERIFY(*model.find("points")->find("B")->find("at") == Value(Value::Array{7, q[3]}));
        QVERIFY(*model.find("points")->find("A")->find("velocity") == Value(Value::Array{2, 0}));
        QVERIFY(!model.find("points")->find("O")->find("velocity"));
        const ReadScene moved = read(R"("points": {"A": {"mass": 1, "at": [0, 1]}})",
                                     R"("initial": {"q": [0.5, 2], "v": [1, 0]}, )");
        QVERIFY2(moved.errors.empty(), textOf(moved.errors).c_str());
        QVERIFY(moved.resolved->initial.x == (std::vector<double>{0.5, 2, 1, 0}));
    }
    void whatIsWrongIsSaidWithItsPlace_data() {
        QTest::addColumn<QString>("keys");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("words");
        const QString points =
            R"("points": {"O": {"at": [0, 0], "fixed": true}, "D": {"at": [2, 0], "fixed": true},
            "A": {"mass": 1, "at": [0, 1]}, "B": {"mass": 1, "at": [2, 1]}})";
        const auto row = [&](const char* what, const QString& keys, const char* pointer, const char* words) {
            QTest::newRow(what) << QString(keys).replace("POINTS", points) << pointer << words;
        };
        row("unknown point", R"(POINTS, "rods": {"r": {"from": "O", "to": "C"}})", "/model/rods/r/to",
            "there is no point \"C\"");
        row("zero length", R"("points": {"O": {"at": [0, 1], "fixed": true}, "A": {"mass": 1, "at": [0, 1]}},
            "rods": {"r": {"from": "O", "to": "A"}})",
            "/model/rods/r", "O and A are at one place");
        row("inside a wall",
            R"(POINTS, "walls": {"w": {"points": ["A"], "through": [0, 2], "normal": [0, 1]}})",
            "/model/walls/w", "the point A starts inside the wall");
        row("inside a disc", R"(POINTS, "walls": {"w": {"points": ["A"], "centre": [0, 2], "radius": 3}})",
            "/model/walls/w", "the point A starts inside the wall");
        row("outside a box",
            R"(POINTS, "walls": {"w": {"points": ["A"], "corner": [1, 0], "opposite": [3, 3]}})",
            "/model/walls/w", "the point A starts inside the wall");
        row("nothing moves", R"("points": {"O": {"at": [0, 0], "fixed": true}})", "/model/points",
            "nothing that moves");
        row("nothing at all", R"("gravity": 1)", "/model/points", "nothing that moves");
        row("one name twice", R"(POINTS, "rods": {"A": {"from": "O", "to": "A"}})", "/model/rods/A",
            "is that of a point as well");
        row("no mass", R"("points": {"A": {"at": [0, 0]}})", "/model/points/A/mass", "is required");
        row("mass of 0", R"("points": {"A": {"at": [0, 0], "mass": 0}})", "/model/points/A/mass",
            "must be a positive number, got 0");
        row("negative mass", R"("points": {"A": {"at": [0, 0], "mass": "-1"}})", "/model/points/A/mass",
            "must be a positive number, got -1");
        row("redundant rods",
            R"(POINTS, "rods": {"a": {"from": "A", "to": "B"}, "b": {"from": "B", "to": "A"}})",
            "/model/rods/b", "depends on the other constraints");
        row("too many rods",
            R"("points": {"O": {"at": [0, 0], "fixed": true}, "D": {"at": [2, 0], "fixed": true},
            "A": {"mass": 1, "at": [1, 1]}}, "rods": {"a": {"from": "O", "to": "A"}, "b": {"from": "D", "to": "A"}})",
            "/model", "so that nothing can move");
        row("a length that misses", R"(POINTS, "rods": {"r": {"from": "O", "to": "A", "length": 1.5}})",
            "/initial", "misses the constraint r");
        row("unknown key", R"(POINTS, "rods": {"r": {"from": "O", "too": "A"}})", "/model/rods/r/too",
            "unknown key");
        row("unknown name in a number", R"("points": {"A": {"at": [0, 0], "mass": "mm"}})",
            "/model/points/A/mass", "unknown name");
        row("a name that formulas cannot have", R"("points": {"a-b": {"at": [0, 0], "mass": 1}})",
            "/model/points/a-b", "the name \"a-b\"");
        row("both ends fixed", R"(POINTS, "rods": {"r": {"from": "O", "to": "D"}})", "/model/rods/r",
            "both ends are fixed");
        row("both ends the same", R"(POINTS, "springs": {"s": {"from": "A", "to": "A", "stiffness": 1}})",
            "/model/springs/s", "both ends are the point A");
        row("motor without an axis", R"(POINTS, "rods": {"r": {"from": "A", "to": "B"}},
            "motors": {"m": {"rod": "r", "torque": 1}})",
            "/model/motors/m/rod", "has no fixed end");
        row("motor without a drive",
            R"(POINTS, "rods": {"r": {"from": "O", "to": "A"}}, "motors": {"m": {"rod": "r"}})",
            "/model/motors/m", "needs one of torque, angle and speed");
        row("unknown body", R"(POINTS, "motors": {"m": {"body": "b", "torque": 1}})", "/model/motors/m/body",
            "there is no body \"b\"");
        row("restitution",
            R"(POINTS, "walls": {"w": {"through": [0, 0], "normal": [0, 1], "restitution": 2}})",
            "/model/walls/w/restitution", "from 0 to 1");
        row("a wall of two shapes",
            R"(POINTS, "walls": {"w": {"through": [0, 0], "normal": [0, 1], "radius": 2}})", "/model/walls/w",
            "needs one shape");
        row("elements without names", R"("points": [{"at": [0, 0]}])", "/model/points",
            "needs a name for each");
        row("a parameter with the name of a coordinate",
            R"("parameters": {"x_A": 1}, "points": {"A": {"mass": 1, "at": [0, 0]}})", "/model/points/A",
            "the name of a parameter as well");
    }
    void whatIsWrongIsSaidWithItsPlace() {
        QFETCH(QString, keys);
        QFETCH(QString, pointer);
        QFETCH(QString, words);
        const ReadScene scene = read(keys.toStdString());
        const std::string said = textOf(scene.errors);
        QVERIFY2(std::any_of(scene.errors.begin(), scene.errors.end(),
                             [&](const Problem& p) {
                                 return p.pointer == pointer.toStdString() &&
                                        QString::fromStdString(p.message).contains(words) && !p.hint.empty();
                             }),
                 said.c_str());
    }
};

EXTREMAL_TEST(MechanismTest)

}  // namespace extremal::cartesian_test
#include "mechanism_test.moc"
