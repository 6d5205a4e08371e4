// SPDX-License-Identifier: GPL-3.0-or-later
/// Physics typed as on a blackboard, in the whole window: names come with the formula, and lines of
/// constraints, forces and damping under it.
#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::part_lines_test {

class PartLinesTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        Window() : MainWindow(Theme::light(), false) {
            show();
            workspace().adopt(newLagrangianScene());
        }
        template <class T>
        T* part(const QString& name) {
            return findChild<T*>(name);
        }
        FormulaEdit* formula() { return part<FormulaEdit>("field.lagrangian"); }
        void type(FormulaEdit* field, const QString& text) {
            field->setFocus();
            field->selectAll();
            QTest::keyClicks(field, text);
        }
        const Value* at(const char* pointer) { return valueAt(workspace().document(), pointer); }
        QString text(const char* pointer) {
            const Value* value = at(pointer);
            return value && value->isString() ? QString::fromStdString(value->asString()) : QString();
        }
        QStringList coordinates() {
            QStringList names;
            for (const Value& name : at("/model/coordinates")->asArray())
                names << QString::fromStdString(name.asString());
            return names;
        }
        QStringList parameters() {
            QStringList names;
            for (const auto& [name, value] : at("/model/parameters")->asObject())
                names << QString::fromStdString(name);
            return names;
        }
        /// A line of a kind, from the menu.
        void add(const QString& key) {
            QMenu* const menu = part<QToolButton>("addPart")->menu();
            emit menu->aboutToShow();
            auto* const action = menu->findChild<QAction*>("add." + key);
            QVERIFY(action && action->isEnabled());
            action->trigger();
        }
        QString equations() { return part<QLabel>("equations")->text(); }
        bool isDone() {
            if (!waitForResults(*this)) return false;
            for (const auto& scheme : runControl().results()->schemes)
                if (scheme->summary.status != RunStatus::done) return false;
            return !runControl().results()->schemes.empty();
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aFormulaOnAnEmptyPageRuns() {
        Window window;
        QCOMPARE(window.coordinates(), QStringList{"theta"});
        window.type(window.formula(), "m/2*x_t^2 - k/2*x^2");
        QTRY_COMPARE(window.coordinates(), QStringList{"x"});
        QCOMPARE(window.parameters(), (QStringList{"m", "k"}));  // l and g have gone
        QCOMPARE(window.formula()->toPlainText(), QString("m/2*x_t^2 - k/2*x^2"));
        QVERIFY(window.part<QSlider>("slider.k")->isEnabled());
        QVERIFY(window.part<QLabel>("note.names")->text().contains("x is a coordinate"));
        QVERIFY(window.isDone());
        emit window.part<QLabel>("note.names")->linkActivated("undo:");
        QCOMPARE(window.coordinates(), QStringList{"theta"});
    }
    void aPlanetOnAnEmptyPageRuns() {
        Window window;
        window.type(window.formula(), "(x_t^2 + y_t^2)/2 + mu/sqrt(x^2 + y^2)");
        QTRY_COMPARE(window.coordinates(), (QStringList{"x", "y"}));
        QCOMPARE(window.parameters(), QStringList{"mu"});
        QVERIFY(window.isDone());
        const auto& rows = window.runControl().results()->schemes.front()->trajectory;
        QVERIFY(std::abs(rows["q.y"][rows.rows() / 4]) > 0.1);  // it does not fall into the centre
    }
    /// A letter that was a parameter while its velocity was not typed yet.
    void theOrderOfTypingDoesNotMatter() {
        Window window;
        window.type(window.formula(), "theta_t^2/2 - k*x^2");
        QTRY_VERIFY(window.parameters().contains("x"));
        window.type(window.formula(), "theta_t^2/2 - k*x^2 + x_t^2/2");
        QTRY_COMPARE(window.coordinates(), (QStringList{"theta", "x"}));
        QCOMPARE(window.parameters(), QStringList{"k"});
    }
    void namesThatAreGoneAreRemembered() {
        Window window;
        window.type(window.formula(), "x_t^2/2 - k*x^2");
        QTRY_VERIFY(window.parameters().contains("k"));
        QVERIFY(window.workspace().edit({{"/model/parameters/k", 7.0}}, "k"));
        window.type(window.formula(), "x_t^2/2 - w*x^2");
        QTRY_COMPARE(window.parameters(), QStringList{"w"});
        window.type(window.formula(), "x_t^2/2 - k*x^2");
        QTRY_COMPARE(window.parameters(), QStringList{"k"});
        QCOMPARE(window.at("/model/parameters/k")->asNumber(), 7.0);
    }
    void aSlipIsAskedAbout() {
        Window window;
        window.type(window.formula(), "theta_t^2/2 + g*cos(thetta)");
        auto* const problem = window.part<QLabel>("problem.lagrangian");
        QTRY_VERIFY(problem->isVisible());
        QVERIFY(problem->text().contains("thetta"));
        QVERIFY(!window.parameters().contains("thetta"));
        emit problem->linkActivated("name:thetta");
        QTRY_VERIFY(window.parameters().contains("thetta"));
        QVERIFY(!problem->isVisible());
    }
    void texIsUnderstoodTypedAndPasted() {
        Window window;
        const QString typed = R"(\frac{1}{2} m \dot{x}^2 - \frac{k}{2} x^2)";
        window.type(window.formula(), typed);
        QTRY_COMPARE(window.text("/model/lagrangian"), QString("1/2*m*x_t^2 - k/2*x^2"));
        QCOMPARE(window.formula()->toPlainText(), typed);  // what is typed stays
        QVERIFY(window.part<QLabel>("problem.lagrangian")->isHidden());
        QApplication::clipboard()->setText(R"(\frac{1}{2}\dot\varphi^2 + \cos\varphi)");
        window.formula()->selectAll();
        window.formula()->paste();
        QCOMPARE(window.formula()->toPlainText(), QString("1/2*phi_t^2 + cos(phi)"));
        QTRY_COMPARE(window.coordinates(), QStringList{"phi"});
    }
    void constraintsForcesAndDampingAreLines() {
        Window window;
        window.type(window.formula(), "m/2*(x_t^2 + y_t^2) - m*g*y");
        QTRY_COMPARE(window.coordinates(), (QStringList{"x", "y"}));
        window.add("constraints");
        auto* const rod = window.part<FormulaEdit>("partFormula.constraints.rod");
        QVERIFY(rod && rod->hasFocus());
        QTest::keyClicks(rod, "x^2 + y^2 - l^2");
        QTRY_COMPARE(window.text("/model/constraints/rod"), QString("x^2 + y^2 - l^2"));
        QVERIFY(window.parameters().contains("l"));
        QTRY_VERIFY(window.equations().contains("2 <i>λ</i> <i>x</i>"));
        window.add("forces");
        QTest::keyClicks(window.part<FormulaEdit>("partFormula.forces.x"), "A*sin(t)");
        QTRY_COMPARE(window.text("/model/forces/x"), QString("A*sin(t)"));
        window.add("dissipation");
        auto* const damping = window.part<FormulaEdit>("partFormula.dissipation");
        QTest::keyClicks(damping, "c/2*(x_t^2 + y_t^2)");
        QTest::keyClick(damping, Qt::Key_Return);  // at once
        QCOMPARE(window.text("/model/dissipation"), QString("c/2*(x_t^2 + y_t^2)"));
        QTRY_VERIFY(window.equations().contains("<i>c</i> <i>y</i>′"));
        QVERIFY(window.isDone());
        // A slider moves what the rod demands, and the start follows.
        window.part<QSlider>("slider.l")->setValue(150);
        QCOMPARE(window.at("/model/parameters/l")->asNumber(), 1.5);
        QVERIFY(window.isDone());
        QTest::mouseClick(window.part<QToolButton>("copyTex"), Qt::LeftButton);
        QVERIFY(QApplication::clipboard()->text().contains("\\lambda"));
    }
    void aWrongLineWaitsWithItsPlace() {
        Window window;
        window.type(window.formula(), "(x_t^2 + y_t^2)/2");
        QTRY_COMPARE(window.coordinates(), (QStringList{"x", "y"}));
        window.add("constraints");
        auto* const rod = window.part<FormulaEdit>("partFormula.constraints.rod");
        QTest::keyClicks(rod, "x + x_t");
        auto* const problem = window.part<QLabel>("partProblem.constraints.rod");
        QTRY_VERIFY(problem->isVisible());
        QVERIFY(problem->text().contains("velocity"));
        QVERIFY(problem->text().contains('^'));
        QCOMPARE(rod->extraSelections().size(), 1);
        QCOMPARE(rod->extraSelections()[0].cursor.selectedText(), QString("x_t"));
        QVERIFY(rod->property("invalid").toBool());
        QVERIFY(!window.at("/model/constraints"));
        QCOMPARE(rod->toPlainText(), QString("x + x_t"));
        window.type(rod, "x - y/2");
        QTRY_COMPARE(window.text("/model/constraints/rod"), QString("x - y/2"));
        QVERIFY(!problem->isVisible());
        QVERIFY(rod->extraSelections().isEmpty());
        window.workspace().undo();
        QTRY_VERIFY(!window.at("/model/constraints"));
        window.workspace().redo();
        QCOMPARE(window.text("/model/constraints/rod"), QString("x - y/2"));
    }
    void linesAreRenamedAndRemoved() {
        Window window;
        window.open("preset:rod-and-ball");
        QVERIFY(window.at("/model/constraints"));
        const QString first =
            QString::fromStdString(window.at("/model/constraints")->asObject().front().first);
        const std::size_t count = window.at("/model/constraints")->asObject().size();
        enter(window.part<QLineEdit>("partName.constraints." + first), "link");
        QCOMPARE(window.at("/model/constraints")->asObject().front().first, std::string("link"));
        QCOMPARE(window.at("/model/constraints")->asObject().size(), count);
        window.workspace().undo();
        QCOMPARE(window.at("/model/constraints")->asObject().front().first, first.toStdString());
        Window own;
        own.type(own.formula(), "(x_t^2 + y_t^2)/2 - g*y");
        QTRY_COMPARE(own.coordinates(), (QStringList{"x", "y"}));
        own.add("constraints");
        QTest::keyClicks(own.part<FormulaEdit>("partFormula.constraints.rod"), "y - x");
        QTRY_VERIFY(own.at("/model/constraints/rod"));
        QVERIFY(own.workspace().edit({{"/observe", Value::Array{"energy", "constraint"}}}, "observe"));
        QTest::mouseClick(own.part<QToolButton>("removePart.constraints.rod"), Qt::LeftButton);
        QVERIFY(!own.at("/model/constraints"));
        QVERIFY(!own.part<FormulaEdit>("partFormula.constraints.rod") ||
                !own.part<FormulaEdit>("partFormula.constraints.rod")->isVisible());
        QVERIFY(own.isDone());
    }
    void aCoordinateIsRenamedInLinesToo() {
        Window window;
        window.type(window.formula(), "(x_t^2 + y_t^2)/2");
        QTRY_COMPARE(window.coordinates(), (QStringList{"x", "y"}));
        window.add("forces");
        QTest::keyClicks(window.part<FormulaEdit>("partFormula.forces.x"), "-x_t");
        QTRY_COMPARE(window.text("/model/forces/x"), QString("-x_t"));
        enter(window.part<QLineEdit>("field.coordinates"), "u, y");
        QCOMPARE(window.text("/model/forces/u"), QString("-u_t"));
        QVERIFY(!window.at("/model/forces/x"));
    }
};

EXTREMAL_TEST(PartLinesTest)
}  // namespace extremal::part_lines_test

#include "part_lines_test.moc"
