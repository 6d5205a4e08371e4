// SPDX-License-Identifier: GPL-3.0-or-later
/// The form of a model whose potential is typed, driven as a user does, in the whole window.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "ui/base/format.hpp"
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
};

EXTREMAL_TEST(ScenePanelTest)
}  // namespace extremal::scene_panel_test

#include "scene_panel_test.moc"
