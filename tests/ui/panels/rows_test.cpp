// SPDX-License-Identifier: GPL-3.0-or-later
/// What is edited in place: steps, names, colours and parameters, with the mouse.
#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QToolButton>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/scrub_label.hpp"
#include "ui/panels/explain.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::rows_test {
namespace {

void wheel(QWidget& at, int notches, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    const QPoint centre = at.rect().center();
    QWheelEvent event(centre, at.mapToGlobal(centre), {}, {0, 120 * notches}, Qt::NoButton, keys,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&at, &event);
}

void drag(QWidget& label, int pixels) {
    const QPoint from = label.rect().center();
    QTest::mousePress(&label, Qt::LeftButton, {}, from);
    for (int k = 1; k <= 10; ++k) {
        const QPointF at = from + QPointF(pixels * k / 10.0, 0);
        QMouseEvent move(QEvent::MouseMove, at, label.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                         Qt::NoModifier);
        QApplication::sendEvent(&label, &move);
    }
    QTest::mouseRelease(&label, Qt::LeftButton, {}, from + QPoint(pixels, 0));
}

}  // namespace

class RowsTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        Window() : MainWindow(Theme::light(), false) {
            resize(1400, 900);
            show();
            open("preset:spring-pendulum");
            QVERIFY(waitForResults(*this));
        }
        SchemeCard* card(int index) { return findChild<SchemeCard*>(QString("scheme.%1").arg(index)); }
        ScrubLabel* step(int index) { return card(index)->findChild<ScrubLabel*>("stepLabel"); }
        double h(int index) {
            return workspace().scene().schemes[static_cast<std::size_t>(index)].step.value;
        }
        std::vector<bool> on() {
            std::vector<bool> all;
            for (const SchemeSpec& s : workspace().scene().schemes) all.push_back(s.isEnabled);
            return all;
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void theWheelDoublesTheStepOfTheSelectedScheme() {
        Window window;
        const double before = window.h(0);
        wheel(*window.step(0), 1);  // not selected: the list scrolls
        QCOMPARE(window.h(0), before);
        window.workspace().selectScheme(0);
        wheel(*window.step(0), 1);
        QCOMPARE(window.h(0), 2 * before);
        wheel(*window.step(0), -2);
        QCOMPARE(window.h(0), before / 2);
        window.workspace().undo();
        QCOMPARE(window.h(0), before);  // one change
    }
    /// Below the name the step makes the card lower, and a scroll bar may go: it does not come back by that.
    void theStepDoesNotComeBackByTheWidthOfAScrollBar() {
        Window window;
        SchemeCard card(window.workspace(), 0, Theme::light());
        card.showSpec();
        card.show();
        const auto* const step = card.findChild<ScrubLabel*>("stepLabel");
        const auto isBelow = [&](int width) {
            card.resize(width, card.height());
            card.layout()->activate();
            return step->y() > card.height() / 4 || step->x() < width / 2;
        };
        int width = 600;
        QVERIFY(!isBelow(width));
        while (width > 40 && !isBelow(width)) --width;
        const int least = width + 1;  // beside the name
        QVERIFY(isBelow(least - 14));
        QVERIFY(isBelow(least));
        QVERIFY(!isBelow(least + 40));
    }
    void aDragScalesTheStepAndAClickOpensIt() {
        Window window;
        const double before = window.h(1);
        drag(*window.step(1), 50);  // ten notches of a fiftieth of a decade
        QVERIFY(std::abs(window.h(1) / before - std::pow(10, 0.2)) < 0.02 * std::pow(10, 0.2));
        auto* field = window.card(1)->findChild<QLineEdit*>("step");
        QVERIFY(!field->isVisible());
        QTest::mouseClick(window.step(1), Qt::LeftButton);
        QVERIFY(field->isVisible());
        QCOMPARE(window.workspace().selectedScheme(), 1);
    }
    void soloLeavesOneSchemeAndBringsAllBack() {
        Window window;
        window.workspace().selectScheme(2);
        window.actions().find("solo")->trigger();
        QCOMPARE(window.on(), (std::vector<bool>{false, false, true, false, false, false}));
        window.actions().find("solo")->trigger();
        QCOMPARE(window.on(), std::vector<bool>(6, true));
    }
    void aColourThatIsTakenIsExchanged() {
        Window window;
        const Scene before = window.workspace().scene();
        QVERIFY(window.workspace().edit(editsForStyle(before, 0, 3), "colour"));
        const Scene& after = window.workspace().scene();
        QCOMPARE(styleOf(after.schemes[0], 0), 3);
        QCOMPARE(styleOf(after.schemes[3], 3), 0);
        QCOMPARE(styleOf(after.schemes[1], 1), 1);
        QVERIFY(editsForStyle(after, 0, 3).empty());
    }
    void aDoubleClickOnTheNameRenames() {
        Window window;
        SchemeCard* card = window.card(0);
        QTest::mouseDClick(card, Qt::LeftButton, {}, QPoint(70, 18));
        auto* name = card->findChild<QLineEdit*>("name");
        QVERIFY(name->isVisible() && !card->isEditing());
    }
    void aParameterIsScrubbedByItsLabel() {
        Window window;
        const double before = window.workspace().scene().model.number("g");
        drag(*window.findChild<ScrubLabel*>("label.g"), 50);
        QVERIFY(window.workspace().scene().model.number("g") > before);
        window.workspace().undo();
        QCOMPARE(window.workspace().scene().model.number("g"), before);
    }
    void numbersAreExplained() {
        Window window;
        const auto tip = [&](const char* name) {
            return window.card(0)->findChild<QLabel*>(name)->toolTip();
        };
        const ReferenceInfo& reference = window.runControl().results()->reference;
        QVERIFY(tip("error").contains(QString::fromStdString(reference.description)));
        QVERIFY(tip("error").contains("good to"));
        QVERIFY(tip("cost").contains("per step") && tip("order").contains("claims the order 8"));
        Summary summary;
        summary.maxError = 1e-9;
        QVERIFY(explainError(summary, {"computed", 1e-8, "x", {}}, "rad").contains("upper bound"));
        QVERIFY(explainError(summary, {"computed", 1e-12, "x", {}}, "rad").contains("0.1 %"));
        QVERIFY(explainError(summary, {}, {}).contains("no reference"));
    }
    void aMotionStartsFromTheCursor() {
        Window window;
        window.workspace().selectScheme(1);
        window.playback().setTime(5);
        const auto result = window.runControl().results()->schemes[1];
        window.actions().find("startHere")->trigger();
        const Initial& initial = window.workspace().scene().initial;
        std::size_t row = 0;
        const auto t = result->trajectory["t"];
        while (row + 1 < t.size() && t[row] < 5 - 1e-9) ++row;
        QCOMPARE(initial.q[1].value, result->trajectory["q.theta"][row]);
        QCOMPARE(initial.pOrV[0].value, result->trajectory["p.a"][row]);
        window.workspace().undo();
        QCOMPARE(window.workspace().scene().initial.q[1].value, 1.0);
    }
    void escapeClosesTheEditorThenTakesTheSelectionAway() {
        Window window;
        window.workspace().selectScheme(1);
        window.actions().find("editScheme")->trigger();
        QVERIFY(window.card(1)->isEditing());
        window.actions().find("stop")->trigger();
        QVERIFY(!window.card(1)->isEditing());
        QCOMPARE(window.workspace().selectedScheme(), 1);
        window.actions().find("stop")->trigger();
        QCOMPARE(window.workspace().selectedScheme(), -1);
    }
    /// The numbers of the last run belong to its step.
    void noOldNumberStandsBesideANewStep() {
        Window window;
        const auto number = [&](int index, const char* name) {
            return window.card(index)->findChild<QLabel*>(name)->text();
        };
        const QString other = number(1, "error");
        QVERIFY(number(0, "error") != "–" && number(0, "cost") != "–");
        QVERIFY(window.workspace().edit({{"/schemes/0/step", Value(0.02)}}, "step"));
        for (const char* name : {"cost", "error", "order", "steps"}) QCOMPARE(number(0, name), QString("–"));
        QCOMPARE(number(1, "error"), other);
        QVERIFY(waitForResults(window));
        QVERIFY(number(0, "error") != "–");
        // Another rule, the same step.
        QVERIFY(window.workspace().edit({{"/schemes/1/quadrature/nodes", Value(3)}}, "nodes"));
        QCOMPARE(number(1, "error"), QString("–"));
        window.workspace().undo();
        QCOMPARE(number(1, "error"), other);
        // Another name and colour change no number.
        QVERIFY(window.workspace().edit({{"/schemes/1/label", Value("another name")}}, "name"));
        QCOMPARE(number(1, "error"), other);
    }
    void aSchemeThatTookNoStepHasNoError() {
        Window window;
        QVERIFY(window.workspace().edit({{"/schemes/0/step", Value(100.0)}}, "step"));  // the run ends at 10
        QVERIFY(waitForResults(window));
        QCOMPARE(window.runControl().results()->schemes[0]->summary.steps, 0LL);
        for (const char* name : {"error", "order", "steps"})
            QCOMPARE(window.card(0)->findChild<QLabel*>(name)->text(), QString("–"));
        QVERIFY(window.card(0)->findChild<QLabel*>("error")->toolTip().contains("No step was taken"));
    }
};

EXTREMAL_TEST(RowsTest)
}  // namespace extremal::rows_test

#include "rows_test.moc"
