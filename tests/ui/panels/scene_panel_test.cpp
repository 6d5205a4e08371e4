// SPDX-License-Identifier: GPL-3.0-or-later
/// The form of a scene, driven as a user does, in the whole window.
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QToolButton>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "ui/base/format.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/scene_panel.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::scene_panel_test {

class ScenePanelTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aPotentialAndItsConstantsAreFieldsOfTheForm() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:satellite");
        QTRY_VERIFY(window.findChild<QLineEdit*>("field.potential"));
        auto* potential = window.findChild<QLineEdit*>("field.potential");
        auto* constants = window.findChild<QLineEdit*>("field.parameters");
        QTRY_VERIFY(potential->isVisible());
        QVERIFY(constants && constants->isVisible());
        QVERIFY(potential->text().startsWith("-mu*mass"));
        QCOMPARE(constants->text(), QString("mu = 1"));
        enter(constants, "mu = 1.2, k = 0.01");
        const auto value = [&](const char* pointer) {
            return valueAt(window.workspace().document(), pointer);
        };
        QCOMPARE(value("/model/parameters/mu")->asNumber(), 1.2);
        QCOMPARE(value("/model/parameters/k")->asNumber(), 0.01);
        enter(potential, "-mu*mass/sqrt(x^2+y^2+z^2) + k*R33");
        QVERIFY(value("/model/potential")->asString().ends_with("k*R33"));
        QVERIFY(!potential->property("invalid").toBool());
        // What has no meaning is refused and marked; the scene stays as it was.
        enter(potential, "-mu*mass/sqrt(x^2+y^2+z^2) + k*Q33");
        QVERIFY(potential->property("invalid").toBool());
        QVERIFY(value("/model/potential")->asString().ends_with("k*R33"));
    }
    /// Hamilton's equations stand under H, and follow it.
    void equationsOfTypedPhaseSpacesAreShown() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:three-species");
        auto* lines = window.findChild<QLabel*>("equations");
        QTRY_VERIFY(lines->isVisible() && lines->text().contains("<i>u</i>′ = "));
        QTest::mouseClick(window.findChild<QToolButton*>("copyTex"), Qt::LeftButton);
        QVERIFY(QApplication::clipboard()->text().contains("\\dot{u} &= "));
        window.open("preset:hamiltonian-chaos");
        QTRY_VERIFY(lines->text().contains("<i>p</i><sub>q</sub>′ = "));
        auto* energy = window.findChild<FormulaEdit*>("field.hamiltonian");
        QVERIFY(energy);
        energy->setPlainText("p_q^2/2 + p_r^2/2 + q^4");
        QTRY_VERIFY(lines->text().contains("−4 <i>q</i><sup>3</sup>"));
        window.open("preset:kepler");
        QTRY_VERIFY(!lines->isVisible());
        window.open("preset:duffing");
        QTRY_VERIFY(lines->isVisible());
    }
    void theReferenceIsChosen() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        auto* panel = window.findChild<ScenePanel*>();
        const auto box = [&]() -> QComboBox* {  // the newest: others wait for their end
            const auto all = panel->findChildren<QComboBox*>("field.type");
            return all.isEmpty() ? nullptr : all.last();
        };
        const auto kind = [&] {
            return QString::fromStdString(
                valueAt(window.workspace().document(), "/reference/type")->asString());
        };
        const auto choose = [&](const QString& name) {
            const int index = box()->findText(name);
            QVERIFY(index >= 0);
            box()->setCurrentIndex(index);
            emit box()->activated(index);
            QCoreApplication::processEvents();
        };
        QTRY_VERIFY(box());
        QCOMPARE(box()->currentText(), kind());
        choose("companion");
        QCOMPARE(kind(), QString("companion"));
        // A scheme of the scene: one more choice, for as long as it is the reference.
        QAction* selected = nullptr;
        for (QAction* action : panel->menu()->actions())
            if (action->text() == "Compare with the selected scheme") selected = action;
        QVERIFY(selected);
        window.workspace().selectScheme(0);
        selected->trigger();
        QCoreApplication::processEvents();
        QCOMPARE(kind(), QString("scheme"));
        QVERIFY(valueAt(window.workspace().document(), "/reference/scheme/step"));
        QCOMPARE(box()->currentText(), QString("scheme"));
        choose("none");
        QCOMPARE(kind(), QString("none"));
        QVERIFY(!valueAt(window.workspace().document(), "/reference/scheme"));
        QCOMPARE(box()->findText("scheme"), -1);
        // What does not exist is refused at the field.
        window.open("preset:double-pendulum");
        QCoreApplication::processEvents();
        const QString before = kind();
        choose("exact");
        QCOMPARE(kind(), before);
        QVERIFY(panel->findChildren<QLabel*>("problem.type").last()->text().contains("no exact solution"));
    }
    void constantsAreReadAsTheyAreShown() {
        const Value value = constantsFrom(" a=1 , b = 2e3,c = pi/2");
        QCOMPARE(constantsText(value), QString("a = 1, b = 2000, c = pi/2"));
        QVERIFY(constantsFrom("").isObject());
        QVERIFY(constantsFrom("a = 1, b").isString());
        QVERIFY(constantsFrom("a = ").isString());
    }
    void potentialsAndPacketsAreSmallForms() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:tunnelling"));
        const auto field = [&](const char* key) {
            return window.findChild<QLineEdit*>(QString("field.") + key);
        };
        QTRY_VERIFY(field("height"));
        QCOMPARE(field("height")->text(), QString("60"));
        QCOMPARE(field("wave_number")->text(), QString("10"));
        for (const QLineEdit* edit : window.findChildren<QLineEdit*>())
            QVERIFY2(!edit->text().contains('{'), qPrintable(edit->text()));
        enter(field("height"), "45");
        QCOMPARE(valueAt(window.workspace().document(), "/model/potential/height")->asNumber(), 45.0);
        // Another kind comes with its own defaults; one that there is not is refused and stays in the field.
        enter(field("name"), "nonsense");
        QCOMPARE(valueAt(window.workspace().document(), "/model/potential/name")->asString(),
                 std::string("barrier"));
        QCOMPARE(field("name")->text(), QString("nonsense"));
        enter(field("name"), "harmonic");
        QTRY_VERIFY(!field("height") || !field("height")->isVisible());
        QCOMPARE(valueAt(window.workspace().document(), "/model/potential/name")->asString(),
                 std::string("harmonic"));
    }
    /// Values of elements by the name of the element; keys that an action of an event needs come and go with
    /// it.
    void elementsAndEventsHaveRows() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        // The row that this is the label of, as long as it is shown.
        const auto row = [&](const QString& title) -> QWidget* {
            for (const QLabel* label : window.findChildren<QLabel*>())
                if (label->objectName().startsWith("label.") && label->text() == title && label->isVisible())
                    return label->buddy();
            return nullptr;
        };
        const auto line = [&](const QString& title) {
            QWidget* const edit = row(title);
            return edit ? edit->findChild<QLineEdit*>() : nullptr;
        };
        const auto value = [&](const char* pointer) {
            return valueAt(window.workspace().document(), pointer);
        };
        QVERIFY(window.open("preset:four-bar-by-hand"));
        QTRY_VERIFY(line("B: mass"));
        QCOMPARE(line("B: mass")->text(), QString("2"));
        enter(line("B: mass"), "3.5");
        QCOMPARE(value("/model/points/B/mass")->asNumber(), 3.5);
        QCOMPARE(value("/model/points/A/mass")->asNumber(), 1.0);
        enter(line("damper: damping"), "0.25");
        QCOMPARE(value("/model/dampers/damper/damping")->asNumber(), 0.25);
        enter(line("stop: through x"), "1.05");
        QCOMPARE(value("/model/walls/stop/through/0")->asNumber(), 1.05);
        // What cannot be is refused at its own row, and the scene stays.
        enter(line("rocker: length"), "-1");
        QVERIFY(line("rocker: length")->property("invalid").toBool());
        QCOMPARE(value("/model/rods/rocker/length")->asNumber(), 1.8);

        // In space places have three numbers, and joints a type.
        QVERIFY(window.open("preset:door"));
        QTRY_VERIFY(line("door: inertia 2"));
        enter(line("door: inertia 2"), "8.25");
        QCOMPARE(value("/model/bodies/door/inertia/1")->asNumber(), 8.25);
        enter(line("door: at z"), "1.25");
        QCOMPARE(value("/model/bodies/door/at/2")->asNumber(), 1.25);
        QVERIFY(row("hinge: type")->findChild<QComboBox*>() || qobject_cast<QComboBox*>(row("hinge: type")));

        QVERIFY(window.open("preset:latch"));
        QTRY_VERIFY(line("value 1"));
        enter(line("value 1"), "5");
        QCOMPARE(value("/events/0/value")->asNumber(), 5.0);
        enter(line("event 2"), "x_t - 0.1");
        QCOMPARE(value("/events/1/expression")->asString(), std::string("x_t - 0.1"));
        auto* const action = row("action 1")->findChild<QComboBox*>();
        QVERIFY(action);
        action->setCurrentIndex(action->findText("stop"));
        emit action->activated(action->currentIndex());
        QTRY_VERIFY(!row("value 1"));
        QVERIFY(!value("/events/0/value") && !value("/events/0/parameter"));
        QVERIFY(row("value 2"));
    }
};

EXTREMAL_TEST(ScenePanelTest)
}  // namespace extremal::scene_panel_test

#include "scene_panel_test.moc"
