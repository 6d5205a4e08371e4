// SPDX-License-Identifier: GPL-3.0-or-later
/// What the window offers for the elliptic problem: its own elements, and nothing that would be refused.
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QStandardItemModel>
#include <QTest>

#include <algorithm>

#include "engine/family/family.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/format.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::elliptic_choices_test {

class EllipticChoicesTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void whatHasNoTimeAsksForNone() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:elliptic");
        QVERIFY(waitForResults(window));
        auto* stage = window.findChild<StageWidget*>();
        auto* end = window.findChild<QWidget*>("field.end");
        QVERIFY(stage && end);
        QTRY_VERIFY(!stage->isVisible() && !end->isVisible());
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(window.findChild<StageWidget*>()->isVisible() &&
                    window.findChild<QWidget*>("field.end")->isVisible());
    }
    void rowsSpeakOfElements() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:elliptic");
        QVERIFY(waitForResults(window));
        const auto row = [&](int i) { return window.findChild<SchemeCard*>(QString("scheme.%1").arg(i)); };
        const auto stepOf = [&](int i) { return row(i)->findChild<QLabel*>("stepLabel")->text(); };
        QCOMPARE(stepOf(0), QString("10 elements"));
        const auto labels = row(0)->findChildren<QLabel*>();
        const auto hasCaption = [&](const char* text) {
            return std::any_of(labels.begin(), labels.end(),
                               [&](const QLabel* l) { return l->text() == QLatin1String(text); });
        };
        QVERIFY(hasCaption("elements") && !hasCaption("steps"));
        auto* const number = row(0)->findChild<QLabel*>("steps");
        QCOMPARE(number->text(), QString("10"));
        QVERIFY(number->toolTip().contains("elements") && !number->toolTip().contains("t ="));
        QCOMPARE(stepText(window.workspace().scene().schemes[0]), QString("h = 0.1"));

        // Typed and scaled, both for elements of the model and for a number of the scheme's own.
        const auto type = [&](int i, const QString& text) {
            row(i)->editStep();
            enter(row(i)->findChild<QLineEdit*>("step"), text);
        };
        type(1, "20");
        QCOMPARE(stepOf(1), QString("20 elements"));
        QVERIFY(!window.workspace().hasDrafts());
        QCOMPARE(stepOf(0), QString("10 elements"));
        QTest::mouseClick(window.discretizer().findChild<DiscretizerCell*>("cell.linear.40"), Qt::LeftButton);
        QCOMPARE(stepOf(2), QString("40 elements"));
        QVERIFY(!schemeText(window.workspace().scene().schemes[2]).contains("auto"));
        type(2, "80");
        QCOMPARE(stepOf(2), QString("80 elements"));
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(waitForResults(window));
        for (const auto& scheme : window.runControl().results()->schemes)
            QVERIFY(scheme->summary.status == RunStatus::done);
    }
    void everyCellOfTheDiscretizerRuns() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:elliptic");
        QTRY_VERIFY(window.discretizer().isCurrent());
        const auto cells = window.discretizer().findChildren<DiscretizerCell*>();
        QCOMPARE(cells.size(), qsizetype(12));
        for (DiscretizerCell* cell : cells) QTest::mouseClick(cell, Qt::LeftButton);
        const auto& schemes = window.workspace().scene().schemes;
        QCOMPARE(schemes.size(), std::size_t(12));  // those with ten elements were there
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(waitForResults(window));
        for (const auto& scheme : window.runControl().results()->schemes) {
            const auto discretization = discretizationOf(scheme->spec);
            QVERIFY(scheme->summary.status == RunStatus::done && discretization &&
                    familyOf(discretization->space)->item.id == "elliptic");
            if (discretization->space.text("functions") == "multiscale")
                QVERIFY(scheme->summary.maxError < 1e-13);
            else
                QVERIFY(scheme->summary.maxError > 1e-5);
        }
        // Clicked again a cell shows its scheme.
        QTest::mouseClick(cells.front(), Qt::LeftButton);
        QCOMPARE(schemes.size(), std::size_t(12));
    }
    void menusAndEditorsOfferWhatFits() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:elliptic");
        auto* add = window.findChild<QPushButton*>("add");
        add->click();
        QStringList entries;
        for (QWidget* widget : QApplication::topLevelWidgets())
            if (auto* menu = qobject_cast<QMenu*>(widget); menu && menu->isVisible())
                for (QAction* action : menu->actions())
                    if (action->isVisible()) entries << action->text();
        QCOMPARE(entries, QStringList{"Named scheme"});
        QApplication::activePopupWidget()->close();
        SchemeEditor editor(window.workspace(), 0);
        auto* kind = editor.findChild<QComboBox*>("kind");
        QVERIFY(!qobject_cast<QStandardItemModel*>(kind->model())->item(1)->isEnabled());
        kind->setCurrentIndex(0);
        emit kind->activated(0);
        QCOMPARE(window.workspace().scene().schemes[0].space.type, std::string("elliptic-elements"));
        QVERIFY(!window.workspace().hasDrafts());
        QCOMPARE(editor.findChild<QComboBox*>("rule")->count(), 1);
        QCOMPARE(editor.findChild<QComboBox*>("choice")->count(), 1);
    }
    void anotherModelTakesSchemesThatFit() {
        MainWindow window(Theme::light(), false);
        window.show();
        for (const auto& [preset, model] : {std::pair{"preset:spring-pendulum", "multiscale-elliptic"},
                                            {"preset:elliptic", "pendulum"},
                                            {"preset:elliptic", "rigid-body"}}) {
            window.open(preset);
            const ModelEntry* entry = findModel(model);
            QVERIFY2(entry, model);
            const auto problems =
                window.workspace().tryEdit(editsForModel(window.workspace().scene(), *entry), "model");
            QVERIFY2(problems.empty(),
                     problems.empty() ? model : (problems[0].pointer + ": " + problems[0].message).c_str());
            QVERIFY(waitForResults(window));
            for (const auto& scheme : window.runControl().results()->schemes)
                QVERIFY(scheme->summary.status == RunStatus::done);
        }
    }
};

EXTREMAL_TEST(EllipticChoicesTest)
}  // namespace extremal::elliptic_choices_test

#include "elliptic_choices_test.moc"
