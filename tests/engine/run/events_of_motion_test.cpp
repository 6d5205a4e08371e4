// SPDX-License-Identifier: GPL-3.0-or-later
/// Events of velocities, energies, reactions and integrals over time; where a run is stopped by a step of the
/// scheme itself; and events that reflect.
#include <QTest>

#include <cmath>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::events_of_motion_test {
namespace {

std::string scene(const std::string& model, const std::string& initial, const std::string& scheme, double end,
                  const std::string& events) {
    return "{\"extremal\":1,\"model\":" + model + ",\"initial\":" + initial +
           ",\"time\":{\"end\":" + std::to_string(end) + "},\"schemes\":[" + scheme +
           "],\"events\":" + events + "}";
}
Comparison resultOf(const std::string& text) {
    const ReadScene read = readScene(text);
    if (!read.errors.empty()) qFatal("%s %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return run(read.scene);
}
const FoundEvents& foundIn(const Comparison& comparison) {
    return *comparison.schemes.at(0)->products.find<FoundEvents>();
}
std::string errorsOf(const std::string& text) {
    std::string all;
    for (const Problem& p : readScene(text).errors)
        all += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return all;
}

const std::string oscillator = R"({"type":"lagrangian","coordinates":["x"],"parameters":{"m":2},
    "lagrangian":"m*(x_t^2-x^2)/2"})";
const std::string ball = R"({"type":"lagrangian","coordinates":["x","y"],"parameters":{"l":1,"g":9.81},
    "lagrangian":"(x_t^2+y_t^2)/2-g*y","constraints":{"rod":"x^2+y^2-l^2"}})";

}  // namespace

class EventsOfMotionTest : public QObject {
    Q_OBJECT
private slots:
    /// x = cos t: its velocity passes 0 at pi, its kinetic energy is half of all at pi/4, and the integral of
    /// x^2 is t/2 + sin(2t)/4.
    void velocitiesEnergiesAndIntegrals() {
        const Comparison c = resultOf(
            scene(oscillator, R"({"q":[1],"v":[0]})", R"({"scheme":"galerkin-gauss-6","step":0.25})", 7,
                  R"json(["x_t", {"expression":"m*x_t^2/2 - energy/2","direction":"up"},
                      "integral(x^2) - pi/2", "integral(1) + 2*integral( x_t ) - 1", "energy - 5"])json"));
        const FoundEvents& found = foundIn(c);
        QCOMPARE(found.all[0].count, 2LL);
        QVERIFY(std::abs(found.all[0].first - M_PI) < 1e-9);
        QVERIFY(std::abs(found.all[1].first - M_PI / 4) < 1e-9);
        QCOMPARE(found.all[2].count, 1LL);
        QVERIFY(std::abs(found.all[2].first - M_PI) < 1e-9);
        // t + 2 (cos t - 1) = 1
        const double t = found.all[3].first;
        QVERIFY(std::abs(t + 2 * (std::cos(t) - 1) - 1) < 1e-9);
        QCOMPARE(found.all[4].count, 0LL);
    }
    /// A ball let go level: the tension of its rod, 2 |lambda| = 3 g sin(angle), passes 10.
    void reactions() {
        const Comparison c =
            resultOf(scene(ball, R"({"q":[1,0],"v":[0,0]})", R"({"scheme":"galerkin-gauss-4","step":0.01})",
                           0.5, R"json(["2*reaction_rod + 10"])json"));
        const FoundEvents& found = foundIn(c);
        QCOMPARE(found.all[0].count, 1LL);
        const double y = found.rows["q.y"][0];
        qInfo("3 g |y| = %.10f", 3 * 9.81 * std::abs(y));
        QVERIFY(std::abs(3 * 9.81 * std::abs(y) - 10) < 1e-6);
    }
    /// Where a run is stopped is the end of a step of the scheme: of its order, not that of the dense output.
    void aStopIsAStepOfTheScheme() {
        double error[2];
        for (int i = 0; i < 2; ++i) {
            const std::string h = i == 0 ? "0.4" : "0.2";
            const Comparison c = resultOf(scene(oscillator, R"({"q":[1],"v":[0]})",
                                                R"({"scheme":"galerkin-gauss-3","step":)" + h + "}", 4,
                                                R"json([{"expression":"x + 0.3","action":"stop"}])json"));
            error[i] = std::abs(foundIn(c).all[0].first - std::acos(-0.3));
            const auto& t = c.schemes[0]->trajectory;
            QVERIFY(std::abs(t["q.x"].back() + 0.3) < 1e-14);
            QCOMPARE(t["t"].back(), foundIn(c).all[0].first);
        }
        qInfo("errors %.1e %.1e, order %.2f", error[0], error[1], std::log2(error[0] / error[1]));
        QVERIFY(error[1] < 1e-8 && std::log2(error[0] / error[1]) > 5);
    }
    void aStopByAnIntegralAsWell() {
        const Comparison c =
            resultOf(scene(oscillator, R"({"q":[1],"v":[0]})", R"({"scheme":"galerkin-gauss-4","step":0.3})",
                           9, R"json([{"expression":"integral(x_t^2) - 2","action":"stop"}])json"));
        const double t = foundIn(c).all[0].first;
        QVERIFY(std::abs(t / 2 - std::sin(2 * t) / 4 - 2) < 1e-9);
    }
    /// A ball that bounces off y = 0 by an event is that of a wall.
    void reflectionsAreWalls() {
        const std::string plain = R"({"type":"lagrangian","coordinates":["x","y"],"parameters":{"g":9.81},
            "lagrangian":"(x_t^2+y_t^2)/2-g*y")";
        const std::string start = R"({"q":[0,1],"v":[1,0]})",
                          scheme = R"({"scheme":"galerkin-gauss-3","step":0.05})";
        const Comparison wall = resultOf(scene(
            plain + R"(,"walls":{"floor":{"gap":"y-0.1*x","restitution":0.8}}})", start, scheme, 2, "[]"));
        const Comparison event = resultOf(scene(
            plain + "}", start, scheme, 2,
            R"json([{"expression":"y-0.1*x","action":"reflect","direction":"down","restitution":0.8,"label":"floor"}])json"));
        QCOMPARE(event.schemes[0]->summary.impacts, wall.schemes[0]->summary.impacts);
        QCOMPARE(foundIn(event).all[0].count, static_cast<long long>(wall.schemes[0]->summary.impacts));
        for (const char* column : {"q.x", "q.y", "p.x", "p.y"})
            QCOMPARE(event.schemes[0]->trajectory[column].back(), wall.schemes[0]->trajectory[column].back());
        const Comparison up = resultOf(scene(
            plain + "}", start, scheme, 2,
            R"json([{"expression":"0.1*x-y","action":"reflect","direction":"up","restitution":0.8}])json"));
        QVERIFY(std::abs(up.schemes[0]->trajectory["q.y"].back() -
                         wall.schemes[0]->trajectory["q.y"].back()) < 1e-13);
    }
    /// Of a built-in system too: a pendulum against a post, beside what is known of it without.
    void builtInSystemsReflect() {
        const Comparison c = resultOf(scene(
            R"({"type":"pendulum"})", R"({"q":[1],"p":[0]})", R"({"scheme":"galerkin-gauss-4","step":0.02})",
            5, R"json([{"expression":"theta + 0.5","action":"reflect","direction":"down"}, "p_theta"])json"));
        const auto& t = c.schemes[0]->trajectory;
        double least = 9;
        for (const double theta : t["q.theta"]) least = std::min(least, theta);
        QVERIFY(least > -0.5 - 1e-9 && least < -0.45);
        QVERIFY(c.schemes[0]->summary.impacts >= 2);
        QVERIFY(c.reference.type != "exact");
    }
    void whatIsWrongIsSaid_data() {
        QTest::addColumn<QString>("events");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* name, const char* events, const char* words) {
            QTest::newRow(name) << events << words;
        };
        row("nested", R"json(["integral(integral(x))"])json", "an integral within an integral");
        row("nothing", R"json(["2*m"])json", "has nothing of the state in it");
        row("name in an integral", R"json(["integral(z)-1"])json", "unknown name \"z\"");
        row("unknown velocity", R"json(["z_t"])json", "unknown name");
        row("direction", R"json([{"expression":"x","action":"reflect"}])json", "has no direction");
        row("velocity", R"json([{"expression":"x_t","action":"reflect","direction":"up"}])json",
            "without x_t");
        row("energy", R"json([{"expression":"x-energy","action":"reflect","direction":"up"}])json",
            "without energy");
        row("integral", R"json([{"expression":"integral(x)-1","action":"reflect","direction":"up"}])json",
            "without integral");
        row("restitution", R"json([{"expression":"x","restitution":0.5}])json", "for events that reflect");
        row("too large",
            R"json([{"expression":"x","action":"reflect","direction":"up","restitution":2}])json", "got 2");
    }
    void whatIsWrongIsSaid() {
        QFETCH(QString, events);
        QFETCH(QString, words);
        const std::string said =
            errorsOf(scene(oscillator, R"({"q":[1],"v":[0]})", R"({"scheme":"galerkin-gauss-3","step":0.1})",
                           1, events.toStdString()));
        QVERIFY2(said.find(words.toStdString()) != std::string::npos, said.c_str());
    }
    /// Who does not take walls refuses a scene with reflections.
    void schemesWithoutWallsRefuseReflections() {
        for (const char* scheme : {R"({"baseline":"rk4","step":0.1})", R"({"scheme":"sem-1","step":0.1})"}) {
            const std::string said =
                errorsOf(scene(oscillator, R"({"q":[1],"v":[0]})", scheme, 1,
                               R"json([{"expression":"x","action":"reflect","direction":"down"}])json"));
            QVERIFY2(said.find("wall") != std::string::npos, said.c_str());
        }
    }
};

EXTREMAL_TEST(EventsOfMotionTest)
}  // namespace extremal::events_of_motion_test
#include "events_of_motion_test.moc"
