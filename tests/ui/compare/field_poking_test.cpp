// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields are struck on the stage of the window, and start from where they are.
#include <QLabel>
#include <QLineEdit>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/scene/bind.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/compare/field_poking.hpp"
#include "ui/compare/profile_drawing.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/camera.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::field_poking_test {
namespace {

struct Window : MainWindow {
    explicit Window(const QString& preset) : MainWindow(Theme::light(), false) {
        resize(1400, 900);
        show();
        QVERIFY(open("preset:" + preset));
        QVERIFY(waitForResults(*this));
    }
    StageWidget& stage() { return *compareView().stage(); }
    const System& system() { return *workspace().resolved()->system; }
    /// The nearest picture to the time of the cursor.
    std::vector<double> shown() {
        return *sampleAt(system(), *runControl().results()->schemes.front(), playback().time());
    }
    std::vector<double> start() {
        std::vector<double> values(system().field.size());
        system().field.sample(workspace().resolved()->initial.x.data(), values.data());
        return values;
    }
    QPoint onStage(const Point& p) {
        const Point at = stage().camera().project(p);
        return QPointF(stage().width() / 2.0 + at[0], stage().height() / 2.0 - at[1]).toPoint();
    }
    void act(const char* id) { actions().find(id)->trigger(); }
};

}  // namespace

class FieldPokingTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    void aFieldStartsFromTheCursor() {
        for (const char* preset : {"sine-gordon-kink", "membrane", "coherent-state"}) {
            Window window(preset);
            window.playback().setTime(0.4 * window.playback().end());
            const std::vector<double> there = window.shown(), before = window.start();
            QVERIFY(there != before);
            window.act("startHere");
            const std::vector<double> now = window.start();
            for (std::size_t i = 0; i < now.size(); ++i)
                QVERIFY2(std::abs(now[i] - there[i]) <= 1e-12 * (1 + std::abs(there[i])),
                         qPrintable(QString("%1 %2 %3").arg(preset).arg(now[i]).arg(there[i])));
        }
    }

    void aGraphIsPulledToThePointer() {
        Window window("sine-gordon-kink");
        const Value before = window.workspace().document();
        const FieldSampling& field = window.system().field;
        window.playback().setTime(0.3 * window.playback().end());
        const std::vector<double> there = window.shown();
        const double width = (field.x.back() - field.x.front()) / 25, unit = heightOfOne(window.system());
        const std::size_t at = field.x.size() / 4;
        QTest::mouseClick(&window.stage(), Qt::LeftButton, Qt::NoModifier,
                          window.onStage({field.x[at], unit * 3, 0}));
        QVERIFY(window.workspace().document() == before);  // a click alone does nothing
        QTest::mouseClick(&window.stage(), Qt::LeftButton, Qt::ShiftModifier,
                          window.onStage({field.x[at], unit * 3, 0}));
        const std::vector<double> now = window.start();
        const double pixel = 1 / window.stage().camera().pixelsPerUnit;
        QVERIFY2(std::abs(now[at] - 3) < 2 * pixel / unit + 0.1, qPrintable(QString::number(now[at])));
        for (std::size_t i = 0; i < now.size(); ++i) {
            const bool isFar = i >= field.x.size() || std::abs(field.x[i] - field.x[at]) > 8 * width;
            if (isFar) QVERIFY(std::abs(now[i] - there[i]) < 1e-9);
        }
        window.workspace().undo();  // one step
        QVERIFY(window.workspace().document() == before);
        // A mouse that moves has moved the picture.
        const QPoint from = window.onStage({field.x[at], unit * 3, 0});
        QTest::mousePress(&window.stage(), Qt::LeftButton, Qt::ShiftModifier, from);
        QTest::mouseRelease(&window.stage(), Qt::LeftButton, Qt::ShiftModifier, from + QPoint(30, 0));
        QVERIFY(window.workspace().document() == before);
    }

    void aMembraneIsStruckInItsMiddleByKeys() {
        Window window("membrane");
        const FieldSampling& field = window.system().field;
        const std::size_t first = field.places() * field.components.size(), n = field.furtherNodes.size();
        window.playback().setTime(0.25 * window.playback().end());
        window.playback().setPlaying(true);
        window.stage().setFocus();
        window.act("poke");
        const std::vector<double> there = window.shown();
        QTest::keyClick(&window.stage(), Qt::Key_Return);
        QVERIFY(window.playback().isPlaying());
        const std::vector<double> now = window.start();
        double largest = 0, most = 0, rim = 0;
        for (std::size_t a = 0; a < n; ++a) {
            const double by = now[first + a] - there[first + a];
            largest = std::max(largest, std::abs(there[first + a]));
            most = std::max(most, by);
            if (field.isHeld(a)) rim = std::max(rim, std::abs(by));
            QVERIFY(std::abs(now[first + n + a] - there[first + n + a]) < 1e-12);
        }
        QVERIFY(largest > 0 && rim == 0);
        QVERIFY2(most > 0.3 * largest && most < 1.01 * largest, qPrintable(QString::number(most / largest)));
        // So many numbers are not shown in a line that would cut them.
        const auto* const line = window.findChild<QLineEdit*>(QStringLiteral("field.displacement"));
        QVERIFY2(line && line->isReadOnly() && line->text() == QString::number(n) + " values",
                 line ? qPrintable(line->text().left(60)) : "no line");
        QVERIFY(waitForResults(window));
    }

    void inThePlaneTheNearestNodesAreRaised() {
        Window window("yee");
        QVERIFY(!canBePoked(window.system()));  // values on edges cannot be written as initial data
        Window plane("anisotropy");
        const FieldSampling& field = plane.system().field;
        QVERIFY(canBePoked(plane.system()));
        const std::vector<double> there = plane.shown();
        const double x = field.along.left + 0.7 * field.along.length,
                     y = field.across.left + 0.2 * field.across.length;
        QTest::mouseClick(&plane.stage(), Qt::LeftButton, Qt::ShiftModifier, plane.onStage({x, y, 0}));
        const std::vector<double> now = plane.start();
        std::size_t highest = 0;
        for (std::size_t i = 0; i < field.places(); ++i)
            if (now[i] - there[i] > now[highest] - there[highest]) highest = i;
        const double pixel = 1 / plane.stage().camera().pixelsPerUnit,
                     cell = field.along.length / static_cast<double>(field.x.size());
        QVERIFY(std::abs(field.x[highest % field.x.size()] - x) < cell + 2 * pixel);
        QVERIFY(std::abs(field.y[highest / field.x.size()] - y) < cell + 2 * pixel);
    }

    void whatIsNoFieldSaysSo() {
        Window window("kepler");
        const Value before = window.workspace().document();
        const auto has = [&] {
            const auto all = window.findChildren<QLabel*>();
            return std::any_of(all.begin(), all.end(), [](const QLabel* label) {
                return label->text().contains("no field of this scene can be poked");
            });
        };
        QVERIFY(!has());
        window.act("poke");
        QTRY_VERIFY(has());
        QVERIFY(window.workspace().document() == before);
    }
};

EXTREMAL_TEST(FieldPokingTest)

}  // namespace extremal::field_poking_test

#include "field_poking_test.moc"
