// SPDX-License-Identifier: GPL-3.0-or-later
/// The editor of typed models, driven as a user does, in the whole window.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTest>
#include <QThreadPool>
#include <QToolButton>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/typed_model_editor.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/typed_edits.hpp"
#include "ui/workspace/typed_kind.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::typed_model_editor_test {

class TypedModelEditorTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const QString& scene) : MainWindow(Theme::light(), false) {
            show();
            open(scene);
            // Its formula has been differentiated, or it has none.
            QVERIFY(QTest::qWaitFor(
                [&] { return !formula()->isVisible() || !part<QLabel>("equations")->text().isEmpty(); },
                60000));
        }
        template <class T>
        T* part(const QString& name) {
            return findChild<T*>(name);
        }
        FormulaEdit* formula() {
            return findChild<TypedModelEditor*>()->findChild<FormulaEdit*>({}, Qt::FindDirectChildrenOnly);
        }
        QString problem() {
            for (const char* name : {"problem.lagrangian", "problem.hamiltonian"})
                if (auto* label = part<QLabel>(name); label && label->isVisible()) return label->text();
            return {};
        }
        QString inScene(const char* pointer = nullptr) {
            const TypedKind* const kind = typedKindOf(workspace().document());
            if (!pointer && !kind) return {};
            const Value* value =
                valueAt(workspace().document(), pointer ? std::string(pointer) : kind->formulaPlace());
            return value && value->isString() ? QString::fromStdString(value->asString()) : QString();
        }
        std::size_t coordinates() {
            return valueAt(workspace().document(), "/model/coordinates")->asArray().size();
        }
        std::size_t names() { return typedNamesOf(workspace().document()).size(); }
        void type(const QString& text) {
            formula()->setFocus();
            formula()->selectAll();
            QTest::keyClicks(formula(), text);
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void theFormulaAndItsEquationsAreShown() {
        Window window("preset:duffing");
        QVERIFY(window.formula()->isVisible());
        QCOMPARE(window.formula()->toPlainText(), window.inScene());
        QTRY_VERIFY(window.part<QLabel>("equations")->text().contains("<i>x</i><sup>3</sup>"));
        QVERIFY(window.problem().isEmpty());
        QVERIFY(!window.formula()->property("invalid").toBool());
        window.open("preset:kepler");
        QTRY_VERIFY(!window.formula()->isVisible());
    }
    void whatIsTypedSurvivesANewNameAndUndo() {
        Window window("preset:duffing");
        const QString before = window.inScene();
        const QString typed = "m/2*x_t^2 - k*x^";  // not valid yet
        window.type(typed);
        QTRY_VERIFY(!window.problem().isEmpty());
        QCOMPARE(window.inScene(), before);
        enter(window.part<QLineEdit>("field.coordinates"), "u");
        QCOMPARE(window.inScene("/model/coordinates/0"), QString("u"));
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*u_t^2 - k*u^"));
        while (window.inScene("/model/coordinates/0") != "x") window.actions().find("undo")->trigger();
        QCOMPARE(window.formula()->toPlainText(), typed);
        QCOMPARE(window.inScene(), before);
        window.actions().find("redo")->trigger();
        while (window.inScene("/model/coordinates/0") != "u") window.actions().find("redo")->trigger();
        window.type("m/2*u_t^2 - k*u^2");
        QTRY_COMPARE(window.inScene(), QString("m/2*u_t^2 - k*u^2"));
    }
    void aSoundFormulaBecomesTheScene() {
        Window window("preset:duffing");
        const QString before = window.inScene();
        window.type("m/2*x_t^2 - k*x^2");
        QCOMPARE(window.inScene(), before);  // not while it is being typed
        QTRY_COMPARE(window.inScene(), QString("m/2*x_t^2 - k*x^2"));
        QTRY_VERIFY(!window.part<QLabel>("equations")->text().contains("<sup>3</sup>"));
        window.actions().find("undo")->trigger();
        QCOMPARE(window.inScene(), before);
        QTRY_COMPARE(window.formula()->toPlainText(), before);
        window.actions().find("redo")->trigger();
        QTRY_COMPARE(window.formula()->toPlainText(), QString("m/2*x_t^2 - k*x^2"));
    }
    void aWrongFormulaIsMarkedAndTheSceneStays() {
        Window window("preset:duffing");
        const QString before = window.inScene();
        window.type("m/2*x_t^2 - kk*x^2");
        QTRY_VERIFY(window.problem().contains("unknown name &quot;kk&quot;"));
        QVERIFY(window.problem().contains("did you mean &quot;k&quot;?"));
        QVERIFY(window.problem().contains('^'));
        QCOMPARE(window.inScene(), before);
        QVERIFY(window.formula()->property("invalid").toBool());
        QCOMPARE(window.formula()->extraSelections().size(), 1);
        QCOMPARE(window.formula()->extraSelections()[0].cursor.selectedText(), QString("kk"));
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*x_t^2 - kk*x^2"));  // what was typed stays
        window.type("m/2*x_t^2 - k*x^2");
        QTRY_VERIFY(window.problem().isEmpty());
        QVERIFY(window.formula()->extraSelections().isEmpty());
        QTRY_COMPARE(window.inScene(), QString("m/2*x_t^2 - k*x^2"));
    }
    void degenerateIsSaidToBeSo() {
        Window window("preset:duffing");
        window.type("m*x_t - k*x^2");
        QTRY_VERIFY(window.problem().contains("is degenerate"));
    }
    void aSliderChangesTheParameter() {
        Window window("preset:duffing");
        auto* slider = window.part<QSlider>("slider.c");
        QVERIFY(slider && slider->isEnabled());
        QCOMPARE(slider->value(), 100);  // 4, from 0 to 8
        for (int i = 1; i <= 20; ++i) slider->setValue(100 + i);
        QCOMPARE(valueAt(window.workspace().document(), "/model/parameters/c")->asNumber(), 4.8);
        QCOMPARE(window.part<QLineEdit>("field.c")->text(), QString("4.8"));
        window.actions().find("undo")->trigger();  // one drag is one step
        QCOMPARE(valueAt(window.workspace().document(), "/model/parameters/c")->asNumber(), 4.0);
        QCOMPARE(slider->value(), 100);
        Window forced("preset:forced-pendulum");
        QVERIFY(!forced.part<QSlider>("slider.omega")->isEnabled());  // an expression
    }
    void parametersAreAddedRenamedAndRemoved() {
        Window window("preset:duffing");
        QTest::mouseClick(window.part<QToolButton>("addParameter"), Qt::LeftButton);
        QCOMPARE(valueAt(window.workspace().document(), "/model/parameters/a")->asNumber(), 1.0);
        QVERIFY(window.part<QToolButton>("remove.a")->isEnabled());
        QVERIFY(!window.part<QToolButton>("remove.m")->isEnabled());  // the formula uses it
        auto* name = window.part<QLineEdit>("name.c");
        enter(name, "beta");
        QVERIFY(!valueAt(window.workspace().document(), "/model/parameters/c"));
        QVERIFY(window.inScene().contains("beta/4*x^4"));
        QTRY_VERIFY(window.part<QLabel>("equations")->text().contains("β"));
        QTest::mouseClick(window.part<QToolButton>("remove.a"), Qt::LeftButton);
        QVERIFY(!valueAt(window.workspace().document(), "/model/parameters/a"));
        auto* taken = window.part<QLineEdit>("name.k");
        enter(taken, "x");
        QVERIFY(window.part<QLabel>("problem.parameters")->isVisible());
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/k"));
    }
    /// What is typed and not valid yet stays as it was typed, whatever button is pressed beside it.
    void whatIsTypedIsNeverReplaced() {
        Window window("preset:duffing");
        const QString half = "m/2*x_t^2 - k*(x + c*";
        const auto typeHalf = [&] {
            window.type(half);
            QTRY_VERIFY(!window.problem().isEmpty());
        };
        typeHalf();
        const QString before = window.inScene();
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(window.coordinates(), std::size_t(2));
        QCOMPARE(window.formula()->toPlainText(), half);
        QCOMPARE(window.inScene(), before + " + y_t^2/2");  // sound with both
        QVERIFY(!window.problem().isEmpty());
        window.workspace().undo();  // one step
        QCOMPARE(window.coordinates(), std::size_t(1));
        QCOMPARE(window.formula()->toPlainText(), half);
        QVERIFY(!window.problem().isEmpty());
        enter(window.part<QLineEdit>("name.c"), "beta");
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/beta"));
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*x_t^2 - k*(x + beta*"));
        QVERIFY(window.inScene().contains("beta"));
        window.workspace().undo();
        QCOMPARE(window.formula()->toPlainText(), half);
        QTest::mouseClick(window.part<QToolButton>("addParameter"), Qt::LeftButton);
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/a"));
        QCOMPARE(window.formula()->toPlainText(), half);
        window.part<QSlider>("slider.c")->setValue(120);
        QCOMPARE(window.formula()->toPlainText(), half);
        QTest::mouseClick(window.part<QToolButton>("remove.a"), Qt::LeftButton);
        QCOMPARE(window.formula()->toPlainText(), half);
        enter(window.part<QLineEdit>("field.coordinates"), "z");
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*z_t^2 - k*(z + c*"));
    }
    /// Typed a moment ago, and not looked at yet: taken first, whether it is valid or not.
    void whatWasJustTypedIsNotReplacedEither() {
        Window window("preset:duffing");
        window.type("m/2*x_t^2 - k/2*x^2 + c*x");
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(window.inScene(), QString("m/2*x_t^2 - k/2*x^2 + c*x + y_t^2/2"));
        QTRY_COMPARE(window.formula()->toPlainText(), window.inScene());
        window.type("m/2*x_t^2 - k/2*x^");
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*x_t^2 - k/2*x^"));
        QCOMPARE(window.coordinates(), std::size_t(3));
        window.type("m/2*x_t^2 + y_t^2/2 + z_t^2/2 - k/2*x^2");
        enter(window.part<QLineEdit>("name.k"), "kappa");
        QCOMPARE(window.inScene(), QString("m/2*x_t^2 + y_t^2/2 + z_t^2/2 - kappa/2*x^2"));
    }
    /// Names that are typed and not taken yet are taken by the button beside them.
    void namesAreTakenBeforeAButtonActs() {
        Window window("preset:double-well");
        auto* names = window.part<QLineEdit>("field.coordinates");
        names->setFocus();
        names->selectAll();
        QTest::keyClicks(names, "u");
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(names->text(), QString("u, x"));
        QCOMPARE(window.coordinates(), std::size_t(2));
        QVERIFY(window.inScene().contains("u_t"));
    }
    void coordinatesAreAddedRenamedAndRemoved() {
        Window window("preset:double-well");
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(window.coordinates(), std::size_t(2));
        QVERIFY(window.inScene().endsWith("+ y_t^2/2"));
        QCOMPARE(valueAt(window.workspace().document(), "/initial/q")->asArray().size(), std::size_t(2));
        QTRY_COMPARE(window.formula()->toPlainText(), window.inScene());
        auto* names = window.part<QLineEdit>("field.coordinates");
        QCOMPARE(names->text(), QString("x, y"));
        QVERIFY(window.part<QLineEdit>("field.q.y"));  // the initial data follow
        enter(names, "x, phi");
        QVERIFY(window.inScene().endsWith("+ phi_t^2/2"));
        enter(names, "x");  // the formula still has phi
        QTRY_VERIFY(window.problem().contains("unknown name &quot;phi_t&quot;"));
        QCOMPARE(window.coordinates(), std::size_t(2));
        window.type("x_t^2/2 - x^4");  // both together are sound
        QTRY_COMPARE(window.coordinates(), std::size_t(1));
        QVERIFY(window.problem().isEmpty());
        QCOMPARE(window.inScene(), QString("x_t^2/2 - x^4"));
        QCOMPARE(valueAt(window.workspace().document(), "/initial/q")->asArray().size(), std::size_t(1));
    }
    void typingStaysFastWhileAHardFormulaIsDifferentiated() {
        Window window("preset:duffing");
        QString nest = "x", kinetic = "x_t^2";
        Value::Array names{"x"};
        for (int i = 1; i < 64; ++i) {
            names.emplace_back("q" + std::to_string(i));
            kinetic += QString(" + q%1_t^2").arg(i);
        }
        for (int i = 1; i < 190; ++i)
            nest = QString("tan(%1+q%2*q%3)").arg(nest).arg(i % 63 + 1).arg(7 * i % 63 + 1);
        std::vector<std::string> coordinates;
        for (const Value& n : names) coordinates.push_back(n.asString());
        std::vector<Edit> edits = editsForCoordinates(window.workspace().document(), coordinates);
        edits.push_back({"/model/lagrangian", kinetic.toStdString()});
        QVERIFY(window.workspace().edit(edits, "many"));
        const auto isDifferentiating = [] {
            return qApp->findChild<QThreadPool*>(QStringLiteral("background"))->activeThreadCount() > 0;
        };
        // What the edit has set going in the background has come to its end.
        QTRY_VERIFY_WITH_TIMEOUT(waitForResults(window) && !isDifferentiating(), 20000);
        window.formula()->setPlainText(kinetic + " + " + nest);
        QTRY_VERIFY(isDifferentiating());
        QVERIFY(window.workspace().edit({{"/time/end", 5.0}}, "end"));
        QVERIFY(isDifferentiating());                        // the edit did not wait for it
        window.formula()->setPlainText(kinetic + " - x^2");  // stops it
        QTRY_COMPARE(window.inScene(), kinetic + " - x^2");
    }
    void aNewTypedModelIsSound_data() {
        QTest::addColumn<QString>("type");
        for (const char* type : {"lagrangian", "hamiltonian", "phase-space", "poisson"})
            QTest::newRow(type) << type;
    }
    void aNewTypedModelIsSound() {
        QFETCH(QString, type);
        Window window("preset:kepler");
        auto* model = window.part<QComboBox>("model");
        model->setCurrentIndex(model->findData(type));
        emit model->activated(model->currentIndex());
        QCOMPARE(window.inScene("/model/type"), type);
        QTRY_VERIFY(window.formula()->isVisible());
        QTRY_VERIFY(!window.part<QLabel>("equations")->text().isEmpty());
        QVERIFY(window.problem().isEmpty());
        // One more coordinate, or two more variables, keep it sound.
        const std::size_t before = window.names();
        QTest::mouseClick(window.part<QToolButton>("addCoordinate"), Qt::LeftButton);
        QCOMPARE(window.names(), before + (type == "lagrangian" || type == "hamiltonian" ? 1 : 2));
        QVERIFY(window.problem().isEmpty());
        window.workspace().undo();  // one step
        QCOMPARE(window.names(), before);
    }
    /// Momenta make coordinates, other names parameters; what is not sound has a caret.
    void aHamiltonianIsTyped() {
        Window window("preset:hamiltonian-chaos");
        QCOMPARE(window.part<QLabel>("equations")->text().count("′ = "), 4);
        window.type("p_q^2/2 + p_r^2/2 + kk*q^2");
        QTRY_VERIFY(window.problem().contains("unknown name &quot;kk&quot;"));
        QVERIFY(window.problem().contains("H has an unknown name") && window.problem().contains('^'));
        QCOMPARE(window.formula()->extraSelections()[0].cursor.selectedText(), QString("kk"));
        window.type("p_q^2/2 + p_u^2/2 + k*q^2/2 + omega*u^4");
        QTRY_COMPARE(window.inScene(), QString("p_q^2/2 + p_u^2/2 + k*q^2/2 + omega*u^4"));
        QCOMPARE(window.part<QLineEdit>("field.coordinates")->text(), QString("q, u"));
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/omega"));
        QVERIFY(window.part<QLabel>("note.names")->text().contains("u is a coordinate"));
        QCOMPARE(valueAt(window.workspace().document(), "/initial/p")->asArray().size(), std::size_t(2));
        QTRY_VERIFY(window.part<QLabel>("equations")->text().contains("<i>p</i><sub>u</sub>′ = "));
        // A velocity is no name of a Hamiltonian, and p_0 is a constant.
        window.type("p_q^2/2 + q_t*q");
        QTRY_VERIFY(window.problem().contains("has the velocity q_t"));
        window.type("(p_q - p_0)^2/2 + q^2");
        QTRY_COMPARE(window.names(), std::size_t(1));
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/p_0"));
        // Its name is that of its momentum too.
        enter(window.part<QLineEdit>("field.coordinates"), "phi");
        QCOMPARE(window.inScene(), QString("(p_phi - p_0)^2/2 + phi^2"));
    }
    /// A one-form has a line for each variable that has a velocity; its unknown names are parameters.
    void aOneFormIsTyped() {
        Window window("preset:kepler");
        auto* model = window.part<QComboBox>("model");
        model->setCurrentIndex(model->findData("phase-space"));
        emit model->activated(model->currentIndex());
        QTRY_VERIFY(window.formula()->isVisible());
        window.type("x^2/2 + y^2/2 + c*x^4");
        QTRY_COMPARE(window.inScene(), QString("x^2/2 + y^2/2 + c*x^4"));
        QCOMPARE(valueAt(window.workspace().document(), "/model/parameters/c")->asNumber(), 0.1);
        auto* form = window.part<FormulaEdit>("partFormula.one_form.x");
        QVERIFY(form && form->isVisible());
        QCOMPARE(form->toPlainText(), QString("y"));
        const auto type = [&](const QString& text) {
            form->setFocus();
            form->selectAll();
            QTest::keyClicks(form, text);
        };
        type("y + y^3/");
        QTRY_VERIFY(window.part<QLabel>("partProblem.one_form.x")->isVisible());
        QVERIFY(window.part<QLabel>("partProblem.one_form.x")->text().contains('^'));
        QCOMPARE(window.inScene("/model/one_form/x"), QString("y"));
        type("y + b*y^3");
        QTRY_COMPARE(window.inScene("/model/one_form/x"), QString("y + b*y^3"));
        QVERIFY(valueAt(window.workspace().document(), "/model/parameters/b"));
        QTRY_VERIFY(window.part<QLabel>("equations")->text().contains("<i>y</i><sup>2</sup>"));
        enter(window.part<QLineEdit>("field.variables"), "q, y");
        QCOMPARE(window.inScene("/model/one_form/q"), QString("y + b*y^3"));
        QCOMPARE(window.inScene(), QString("q^2/2 + y^2/2 + c*q^4"));
        enter(window.part<QLineEdit>("field.variables"), "q, y, z");  // an odd number
        QTRY_VERIFY(!window.problem().isEmpty());
        QCOMPARE(window.names(), std::size_t(2));
        enter(window.part<QLineEdit>("field.variables"), "q, y");
        QTRY_VERIFY(window.problem().isEmpty());
    }
    void aBracketIsTyped() {
        Window window("preset:three-species");
        QVERIFY(window.part<FormulaEdit>("partFormula.bracket.u,v"));
        QVERIFY(window.part<FormulaEdit>("partFormula.casimirs.sum"));
        enter(window.part<QLineEdit>("field.variables"), "u, s, w");
        QCOMPARE(window.inScene("/model/bracket/u,s"), QString("1"));
        QCOMPARE(window.inScene("/model/casimirs/sum"), QString("u + s + w"));
        QCOMPARE(window.inScene(), QString("exp(u) + a*exp(s) + exp(w)"));
        auto* casimir = window.part<FormulaEdit>("partFormula.casimirs.sum");
        casimir->setFocus();
        casimir->selectAll();
        QTest::keyClicks(casimir, "u + s");
        QTRY_VERIFY(window.part<QLabel>("partProblem.casimirs.sum")->isVisible());
        QCOMPARE(window.inScene("/model/casimirs/sum"), QString("u + s + w"));
    }
};

EXTREMAL_TEST(TypedModelEditorTest)
}  // namespace extremal::typed_model_editor_test

#include "typed_model_editor_test.moc"
