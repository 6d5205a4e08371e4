// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanisms drawn by hand: what each action makes, what goes with what is removed, and that each action is
/// taken back by itself.
#include <QTest>

#include <cmath>

#include "engine/scene/read/json.hpp"
#include "tests/tools/test.hpp"
#include "ui/sketch/mechanism_drawing.hpp"

namespace extremal::mechanism_drawing_test {
namespace {

using Element = MechanismDrawing::Element;

constexpr double near = 0.1;

/// A crank and a coupler: A fixed, B and C move.
MechanismDrawing crank() {
    MechanismDrawing drawing;
    drawing.addPoint({0, 0}, true);
    drawing.addLink("rods", {0.02, 0}, {0, 1}, near);
    drawing.addLink("rods", {0, 1}, {2, 1.5}, near);
    return drawing;
}

}  // namespace

class MechanismDrawingTest : public QObject {
    Q_OBJECT
private slots:
    void aLinkTakesThePointsThatAreThere() {
        const MechanismDrawing drawing = crank();
        const Value expected = parseJson(R"({"type": "mechanism", "parameters": {}, "gravity": 9.81,
            "points": {"A": {"at": [0, 0], "fixed": true}, "B": {"mass": 1, "at": [0, 1]}, "C": {"mass": 1, "at": [2, 1.5]}},
            "rods": {"rod1": {"from": "A", "to": "B"}, "rod2": {"from": "B", "to": "C"}}})");
        QCOMPARE(writeJson(drawing.model()), writeJson(expected));
    }
    void eachActionIsTakenBackByItself() {
        MechanismDrawing drawing = crank();
        const Value before = drawing.model();
        drawing.addMotor({"rods", "rod1"});
        drawing.addGroundDamper("C");
        drawing.move({"points", "C"}, {2, 2});
        drawing.move({"points", "C"}, {2, 2});  // nothing changes
        drawing.undo();
        drawing.undo();
        QVERIFY(drawing.find({"motors", "motor1"}) && !drawing.find({"dampers", "damper1"}));
        drawing.undo();
        QVERIFY(drawing.model() == before);
        drawing.redo();
        QVERIFY(drawing.find({"motors", "motor1"}));
        for (int k = 0; k < 9; ++k) drawing.undo();
        QVERIFY(drawing.isEmpty() && !drawing.canUndo());
        drawing.addPoint({5, 5}, false);  // what was taken back is gone
        QVERIFY(!drawing.canRedo());
        QCOMPARE(drawing.points().size(), std::size_t{1});
    }
    void whatHangsOnAnElementGoesWithIt() {
        MechanismDrawing drawing = crank();
        drawing.addMotor({"rods", "rod1"});
        drawing.addWall({1, -1}, {1, 3});
        drawing.setKey({"walls", "wall1"}, "points", Value(Value::Array{"B"}));
        drawing.addSlider("C", {3, 1.5});
        drawing.remove({"points", "B"});
        for (const char* kind : {"rods", "motors", "walls"}) QVERIFY2(!drawing.model().find(kind), kind);
        QVERIFY(drawing.find({"sliders", "slider1"}) && drawing.find({"points", "C"}));
        drawing.undo();
        QVERIFY(drawing.find({"motors", "motor1"}) && drawing.find({"rods", "rod2"}));
    }
    void aNewNameIsThatOfAllReferences() {
        MechanismDrawing drawing = crank();
        drawing.addMotor({"rods", "rod1"});
        QVERIFY(drawing.rename({"rods", "rod1"}, "crank"));
        QVERIFY(drawing.rename({"points", "B"}, "elbow"));
        QVERIFY(*drawing.find({"motors", "motor1"})->find("rod") == Value("crank"));
        QVERIFY(*drawing.find({"rods", "rod2"})->find("from") == Value("elbow"));
        for (const char* name : {"C", "rod2", "a-b", "", "t"})
            QVERIFY2(!drawing.rename({"rods", "crank"}, name), name);
    }
    void theOpenSideOfAWallIsThatOfMostPoints() {
        for (const double x : {-1.0, 3.0}) {
            MechanismDrawing drawing = crank();
            for (const bool isUp : {true, false}) {
                drawing.addWall({x, isUp ? -1.0 : 1.0}, {x, isUp ? 1.0 : -1.0});
                const Value* const normal = drawing.find({"walls", isUp ? "wall1" : "wall2"})->find("normal");
                QCOMPARE(normal->asArray()[0].asNumber(), x < 0 ? 1.0 : -1.0);
            }
        }
    }
    /// The end of a bar is where the pointer was, and keeps there when it is dragged.
    void aBodyIsPinnedToPointsAtItsEnds() {
        MechanismDrawing drawing;
        drawing.addPoint({1, 1}, true);
        drawing.addBody({1, 1}, {2, 3}, near);
        QVERIFY(*drawing.find({"pins", "pin1"}) == Value(Value::Object{{"from", "B"}, {"to", "A"}}));
        const auto end = drawing.placeOf({"points", "C"});
        QVERIFY(end && std::hypot((*end)[0] - 2, (*end)[1] - 3) < 1e-12);
        drawing.move({"points", "C"}, {2.5, 3.5});
        const auto moved = drawing.placeOf({"points", "C"});
        QVERIFY(moved && std::hypot((*moved)[0] - 2.5, (*moved)[1] - 3.5) < 1e-10);
    }
    void whatIsUnderThePointerIsFound() {
        MechanismDrawing drawing = crank();
        drawing.addLink("springs", {2, 1.5}, {4, 1.5}, near);
        QVERIFY(drawing.elementAt({0.05, 0.5}, near) == (Element{"rods", "rod1"}));
        QVERIFY(drawing.elementAt({3, 1.55}, near) == (Element{"springs", "spring1"}));
        QVERIFY(drawing.elementAt({0.05, 0.97}, near) == (Element{"points", "B"}));
        QVERIFY(!drawing.elementAt({1, 0}, near));
    }
    void fixingAPointTakesItsMass() {
        MechanismDrawing drawing = crank();
        drawing.toggleFixed("C");
        QVERIFY(drawing.isFixed("C") && !drawing.find({"points", "C"})->find("mass"));
        drawing.toggleFixed("C");
        QVERIFY(!drawing.isFixed("C") && drawing.find({"points", "C"})->find("mass"));
    }
};

EXTREMAL_TEST(MechanismDrawingTest)

}  // namespace extremal::mechanism_drawing_test
#include "mechanism_drawing_test.moc"
