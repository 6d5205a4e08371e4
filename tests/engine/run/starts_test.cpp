// SPDX-License-Identifier: GPL-3.0-or-later
/// Starts in the plane of a view: their states, and the motions from them.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/run/files/starts_files.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/plane_start.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::starts_test {
namespace {

const std::string henonHeiles =
    R"json({"extremal": 1, "model": {"type": "henon-heiles"}, "initial": {"q": [0, -0.25],
        "p": ["sqrt(2*(1/8 - 0.25^2/2 - 0.25^3/3))", 0]}, "time": {"end": 300}, "schemes": [
        {"label": "s", "step": 0.25, "scheme": "galerkin-gauss-3"}], "reference": "none", "observe": [],
        "views": [{"view": "section"}]})json";
/// A kinetic energy that is not quadratic.
const std::string quartic =
    R"({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
        "lagrangian": "x_t^2/2 + x_t^4/4 + x_t*y_t/2 + y_t^2/2 - x^2/2 - y^2/2 - x^2*y"},
        "initial": {"q": [0, 0.1], "v": [0.5, 0.1]}, "time": {"end": 1},
        "schemes": [{"label": "s", "step": 0.1, "scheme": "midpoint"}], "observe": [],
        "views": [{"view": "section"}]})";

Scene sceneOf(const std::string& text, const std::string& starts, const std::string& value) {
    const ReadScene read = readScene(text, {{"/views/0/" + starts, parseJson(value)}});
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return read.scene;
}
const StartSet& setOf(const Comparison& comparison) {
    return comparison.products.find<StartSets>()->all.at(0);
}

}  // namespace

class StartsTest : public QObject {
    Q_OBJECT
private slots:
    void theStartInASectionHasTheEnergyOfTheScene_data() {
        QTest::addColumn<QString>("text");
        QTest::newRow("Henon-Heiles") << QString::fromStdString(henonHeiles);
        QTest::newRow("not quadratic") << QString::fromStdString(quartic);
    }
    void theStartInASectionHasTheEnergyOfTheScene() {
        QFETCH(QString, text);
        const Scene scene = readScene(text.toStdString()).scene;
        const System system = makeSystem(scene);
        const State start = initialState(scene, system);
        const StartPlane plane(system, start, *planeOf(scene.views[0], system));
        const EnergyFunction energy = energyOf(system);
        const double E = energy(0, start.x.data());
        for (const auto& [x, y] : {std::pair{0.1, 0.05}, {-0.05, 0.2}, {0.2, -0.1}}) {
            const PlaneStart at = plane.at(x, y);
            QVERIFY2(at.problem.empty(), at.problem.c_str());
            QCOMPARE(at.x[0], 0.0);
            QCOMPARE(at.x[1], x);
            QCOMPARE(at.x[3], y);
            QVERIFY(std::abs(energy(0, at.x.data()) - E) < 1e-15);  // measured: at most 1.4e-16
            std::vector<double> rate(4);
            QVERIFY(rateOf(system, 0, at.x.data(), rate.data()));
            QVERIFY(rate[0] > 0.1);  // upwards
        }
        // The scene's own start is found again.
        const PlaneStart again = plane.at(start.x[1], start.x[3]);
        QVERIFY(std::abs(again.x[2] - start.x[2]) < 1e-14);
    }
    void outsideTheEnergySurfaceThereIsNone() {
        const Scene scene = sceneOf(henonHeiles, "starts", "[[0, 0.6], [0.1, 0]]");
        const System system = makeSystem(scene);
        const PlaneStart none =
            StartPlane(system, initialState(scene, system), *planeOf(scene.views[0], system)).at(0, 0.6);
        QCOMPARE(none.problem,
                 std::string("no p.x gives the energy 0.125 of the start: it is at least 0.18 here"));
        const Comparison result = run(scene);
        const StartSet& set = setOf(result);
        QCOMPARE(statusOf(set.orbits[0].get()), std::string("no start"));
        QCOMPARE(statusOf(set.orbits[1].get()), std::string("done"));
        const ReadScene read = readScene(writeScene(scene));
        QCOMPARE(read.warnings.size(), std::size_t(1));
        QCOMPARE(read.warnings[0].pointer, std::string("/views/0/starts/0"));
    }
    void theMotionFromTheScenesOwnStartIsThatOfItsScheme() {
        Scene scene = sceneOf(henonHeiles, "starts", "[[-0.25, 0]]");
        scene.views.push_back({"energy", "", ""});
        const Comparison result = run(scene);
        const Orbit& orbit = *setOf(result).orbits[0];
        const Trajectory& events = result.schemes[0]->products.find<Sections>()->all[0].events;
        QVERIFY(events.rows() > 30);
        QCOMPARE(orbit.points.rows(), events.rows() + 1);  // the start is on the section as well
        // Of a chaotic motion: the starts differ by round-off.
        for (std::size_t r = 0; r < 10; ++r)
            for (const char* column : {"t", "q.y", "p.x", "p.y"})
                QVERIFY(std::abs(orbit.points[column][r + 1] - events[column][r]) < 1e-11);
    }
    void startsAreSpreadOverAllThatTheEnergyAdmits() {
        const Scene scene = sceneOf(henonHeiles, "spread", "200");
        const System system = makeSystem(scene);
        const StartPlane plane(system, initialState(scene, system), *planeOf(scene.views[0], system));
        const auto places = startsOf(plane, scene.views[0]);
        QCOMPARE(places.size(), std::size_t(200));
        double low = 0, high = 0;
        int quadrants[4] = {};
        for (const auto& [y, p] : places) {
            QVERIFY(p * p / 2 + y * y / 2 - y * y * y / 3 <= 0.125 + 1e-15);
            QVERIFY(y < 1);  // not beyond the saddle
            low = std::min(low, y);
            high = std::max(high, y);
            ++quadrants[(y > 0.1) + 2 * (p > 0)];
        }
        // The region goes from -0.4397 to 0.6736 along p_y = 0.
        QVERIFY(low < -0.40 && high > 0.62);
        for (const int count : quadrants) QVERIFY(count > 35);
        QVERIFY(startsOf(plane, scene.views[0]) == places);
    }
    void regularAndChaoticMotionsHaveTheirExponents() {
        const Comparison result = run(sceneOf(henonHeiles, "starts", "[[0.1, 0], [-0.25, 0]]"));
        const auto& orbits = setOf(result).orbits;
        QVERIFY(orbits[0]->lyapunov < 0.02);  // measured: 0.0141
        QVERIFY(orbits[1]->lyapunov > 0.03);  // measured: 0.062
        QVERIFY(orbits[1]->megno > 2 * orbits[0]->megno);
    }
    void oneMoreStartCostsOneMoreMotion() {
        const Comparison before = run(sceneOf(henonHeiles, "starts", "[[0.11, 0], [0.12, 0]]")),
                         after = run(sceneOf(henonHeiles, "starts", "[[0.11, 0], [0.12, 0], [0.13, 0]]"));
        for (std::size_t i = 0; i < 2; ++i) QVERIFY(setOf(before).orbits[i] == setOf(after).orbits[i]);
        QVERIFY(setOf(after).orbits[2]);
    }
    void aPhasePortraitTakesItsPlaceFromTheAxes() {
        const std::string pendulum =
            R"({"extremal": 1, "model": {"type": "pendulum"}, "time": {"end": 10}, "schemes":
                [{"label": "a", "step": 0.1, "scheme": "midpoint"}, {"label": "b", "step": 0.1, "baseline": "rk4"}],
                "observe": [], "views": [{"view": "phase", "scheme": "b"}]})";
        const Comparison result = run(sceneOf(pendulum, "starts", "[[1, 2]]"));
        QCOMPARE(setOf(result).scheme, std::string("b"));
        const Orbit& orbit = *setOf(result).orbits[0];
        QCOMPARE(orbit.start, (std::vector<double>{1, 2}));
        QVERIFY(orbit.points.rows() > 500);  // along the dense output
        QVERIFY(
            startsCsv(setOf(result))
                .starts_with("scheme,start,q.theta,p.theta,lyapunov,megno,steps,points,status\nb,1,1,2,"));
    }
    void whatCannotHaveStartsSaysWhy_data() {
        QTest::addColumn<QString>("view");
        QTest::addColumn<QString>("message");
        QTest::newRow("no plane") << R"({"view": "energy", "starts": [[1, 2]]})"
                                  << "is only for phase portraits and sections";
        QTest::newRow("point") << R"({"view": "section", "starts": [[1]]})"
                               << "must be a point [x, y] of the plot, got 1 numbers";
        QTest::newRow("momentum") << R"({"view": "section", "at": "p.x", "starts": [[1, 2]]})"
                                  << "need a section of a coordinate, and p.x is not one";
        QTest::newRow("axis") << R"({"view": "section", "at": "q.x", "x": "p.x", "starts": [[1, 2]]})"
                              << "need other axes than q.x and its momentum";
        QTest::newRow("time") << R"({"view": "phase", "x": "t", "starts": [[1, 2]]})"
                              << "need state columns along both axes, and t is not one";
        QTest::newRow("where") << R"({"view": "phase", "spread": 10})"
                               << "needs to know where";
        QTest::newRow("many") << R"({"view": "section", "spread": 3000})"
                              << "must be an integer from 0 to 2000";
    }
    void whatCannotHaveStartsSaysWhy() {
        QFETCH(QString, view);
        QFETCH(QString, message);
        const ReadScene read = readScene(henonHeiles, {{"/views/0", parseJson(view.toStdString())}});
        QCOMPARE(read.errors.size(), std::size_t(1));
        QVERIFY2(read.errors[0].message.find(message.toStdString()) != std::string::npos,
                 read.errors[0].message.c_str());
    }
    void aSceneWithStartsIsWrittenAsItWasRead() {
        const Scene scene = sceneOf(henonHeiles, "starts", "[[0.1, \"1/8\"]]");
        QVERIFY(readScene(writeScene(scene)).scene == scene);
        const Scene spread = sceneOf(henonHeiles, "spread", "20");
        QVERIFY(readScene(writeScene(spread)).scene == spread);
    }
};

EXTREMAL_TEST(StartsTest)
}  // namespace extremal::starts_test

#include "starts_test.moc"
