// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawing with mouse and keys: a four-bar becomes the scene as it is drawn, mistakes leave the scene alone
/// and say why, and each action is taken back by itself.
#include <QSignalSpy>
#include <QTest>

#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/notices.hpp"
#include "ui/sketch/mechanism_sketch.hpp"
#include "ui/sketch/sketch_canvas.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::mechanism_sketch_test {
namespace {

/// A sheet over a stage of 900 x 600 pixels, and a hand.
struct Sheet {
    Notices notices;
    Workspace workspace{notices};
    StageWidget stage;
    MechanismSketch sketch{workspace, stage};

    Sheet() {
        stage.resize(900, 600);
        workspace.adopt(newMechanismScene());
        sketch.begin(true);
    }
    SketchCanvas& canvas() { return sketch.canvas(); }
    QPoint at(double x, double y) {
        const Point p = canvas().camera().project({x, y, 0});
        return {qRound(canvas().width() / 2.0 + p[0]), qRound(canvas().height() / 2.0 - p[1])};
    }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&canvas(), key, modifiers);
    }
    void click(double x, double y) { QTest::mouseClick(&canvas(), Qt::LeftButton, {}, at(x, y)); }
    void drag(double x, double y, double toX, double toY) {
        QTest::mousePress(&canvas(), Qt::LeftButton, {}, at(x, y));
        QTest::mouseMove(&canvas(), at((x + toX) / 2, (y + toY) / 2));
        QTest::mouseMove(&canvas(), at(toX, toY));
        QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, at(toX, toY));
    }
    void drawFourBar() {
        key(Qt::Key_F);
        click(-1, 0);
        click(1.2, 0);
        key(Qt::Key_R);
        drag(-1, 0, -1, 0.8);
        drag(-1, 0.8, 0.8, 1.2);
        drag(0.8, 1.2, 1.2, 0);
    }
    const System& system() const { return *workspace.resolved()->system; }
    bool isInScene() const {
        const Value& drawn = const_cast<Sheet*>(this)->canvas().drawing().model();
        const Value* const model = workspace.document().find("model");
        for (const auto& [key, value] : drawn.asObject())
            if (const Value* const there = model->find(key); !there || !(*there == value)) return false;
        return true;
    }
};

}  // namespace

class MechanismSketchTest : public QObject {
    Q_OBJECT
private slots:
    void aFourBarIsTheSceneAsItIsDrawn() {
        Sheet sheet;
        QSignalSpy refused(&sheet.sketch, &MechanismSketch::refused);
        sheet.drawFourBar();
        QVERIFY(sheet.isInScene());
        QCOMPARE(sheet.system().dimension(), 4);
        QCOMPARE(sheet.system().parts.find<Constraint>()->count(), 3);
        sheet.key(Qt::Key_M);
        sheet.click(-1, 0.4);
        sheet.key(Qt::Key_D);
        sheet.click(0.8, 1.2);
        sheet.click(0.8, 1.2);
        QVERIFY(sheet.system().parts.find<Force>());
        sheet.key(Qt::Key_W);
        sheet.drag(2, -1, 2, 1);
        QCOMPARE(sheet.system().parts.find<Wall>()->count(), 2);
        QVERIFY(sheet.isInScene());
        QCOMPARE(refused.count(), 0);
        QVERIFY(sheet.workspace.document().find("observe")->asArray().size() == 4);
    }
    void undoTakesBackOneAction() {
        Sheet sheet;
        sheet.drawFourBar();
        sheet.key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(sheet.system().parts.find<Constraint>()->count(), 2);
        sheet.key(Qt::Key_Z, Qt::ControlModifier);
        sheet.key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(sheet.canvas().drawing().find({"points", "B"}) &&
                !sheet.canvas().drawing().model().find("rods"));
        sheet.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        sheet.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        sheet.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(sheet.system().parts.find<Constraint>()->count(), 3);
        QVERIFY(sheet.isInScene());
    }
    /// A wall through the mechanism: the scene stays, and the banner names the point.
    void aMistakeIsSaidAndLeavesTheScene() {
        Sheet sheet;
        sheet.drawFourBar();
        QSignalSpy refused(&sheet.sketch, &MechanismSketch::refused);
        sheet.key(Qt::Key_W);
        sheet.drag(0, -1, 0, 1);
        QCOMPARE(refused.count(), 1);
        QVERIFY2(refused[0][0].toString().contains("starts inside the wall"),
                 qPrintable(refused[0][0].toString()));
        QVERIFY(!sheet.system().parts.find<Wall>());
        QSignalSpy accepted(&sheet.sketch, &MechanismSketch::accepted);
        sheet.key(Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(accepted.count() > 0 && sheet.isInScene());
    }
    void pointsAreDraggedAndRemoved() {
        Sheet sheet;
        sheet.drawFourBar();
        sheet.key(Qt::Key_V);
        sheet.drag(0.8, 1.2, 1, 1.4);
        QVERIFY(*sheet.canvas().drawing().find({"points", "D"})->find("at") == Value(Value::Array{1, 1.4}));
        QVERIFY(sheet.isInScene());
        sheet.key(Qt::Key_Delete);
        QVERIFY(!sheet.canvas().drawing().find({"points", "D"}) &&
                !sheet.canvas().drawing().find({"rods", "rod2"}));
        QCOMPARE(sheet.system().dimension(), 2);
    }
    /// An empty sheet is no mistake; it says at its top why nothing runs.
    void anEmptySheetIsNoMistake() {
        Sheet sheet;
        QSignalSpy refused(&sheet.sketch, &MechanismSketch::refused);
        sheet.key(Qt::Key_F);
        sheet.click(0, 0);
        QCOMPARE(refused.count(), 0);
        QVERIFY(!sheet.isInScene());
        sheet.key(Qt::Key_P);
        sheet.click(1, 0);
        QVERIFY(sheet.isInScene());
    }
};

EXTREMAL_TEST(MechanismSketchTest)

}  // namespace extremal::mechanism_sketch_test
#include "mechanism_sketch_test.moc"
