// SPDX-License-Identifier: GPL-3.0-or-later
/// A refused edit leaves its words beside the field that was typed, wherever in the scene the problem is
/// found, until it is changed or undone. What no field shows is said in a banner, and not kept.
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSpinBox>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/panels/scene_panel.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::refusals_test {

class RefusalsTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const QString& scene) : MainWindow(Theme::light(), false) {
            resize(1400, 900);
            show();
            QVERIFY(open(scene));
            QApplication::processEvents();
        }
        ScenePanel* panel() { return findChild<ScenePanel*>(); }
        SchemeCard* card(int i) { return findChild<SchemeCard*>(QStringLiteral("scheme.%1").arg(i)); }
        const Notice* banner() {
            const auto& all = notices().all();
            const auto found =
                std::find_if(all.begin(), all.end(), [](const Notice& n) { return n.key == "refused"; });
            return found == all.end() ? nullptr : &*found;
        }
        bool isInLog(const QString& words) {
            const QStringList& log = notices().log();
            return std::any_of(log.begin(), log.end(), [&](const QString& l) { return l.contains(words); });
        }
    };
    static QString wordsOf(QWidget& around, const QString& key) {
        QString words;
        for (const QLabel* label : around.findChildren<QLabel*>("problem." + key))
            if (label->isVisible()) words += label->text();
        return words;
    }
    static bool isRed(const QWidget* field) { return field->property("invalid").toBool(); }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void lines_data() {
        QTest::addColumn<QString>("scene");
        QTest::addColumn<QString>("key");
        QTest::addColumn<QString>("typed");
        QTest::addColumn<QString>("where");  // the problem is found; empty: at the field
        const auto row = [](const char* name, const char* scene, const char* key, const char* typed,
                            const char* where) {
            QTest::newRow(name) << QString("preset:") + scene << QString(key) << QString(typed)
                                << QString(where);
        };
        row("a parameter that loses the fast phase", "spring-pendulum", "k", "1e+300",
            "multiscale R2, step: ");
        row("a parameter that is not positive", "spring-pendulum", "m", "-1", "");
        row("an expression without a name", "spring-pendulum", "g", "9.81*unknown", "");
        row("an end that takes too many steps", "spring-pendulum", "end", "1e+12", "Galerkin 8, step: ");
        row("an end that is not finite", "kepler", "end", "exp(1000)", "");
        row("a start that is not finite", "spring-pendulum", "q.theta", "exp(1000)", "");
        row("a list of another length", "free-body", "inertia", "1, 2", "");
        row("a list with a word", "free-body", "inertia", "1, 2, three", "");
        row("an event", "events", "expression", "no_such_name", "");
    }
    void lines() {
        QFETCH(QString, scene);
        QFETCH(QString, key);
        QFETCH(QString, typed);
        QFETCH(QString, where);
        Window window(scene);
        auto* field = window.panel()->findChild<QLineEdit*>("field." + key);
        QVERIFY(field);
        const QString before = field->text();
        const Value document = window.workspace().document();
        enter(field, typed);
        QVERIFY(window.workspace().document() == document);
        QCOMPARE(field->text(), typed);
        QVERIFY(isRed(field));
        const QString words = wordsOf(*window.panel(), key);
        QVERIFY(!words.isEmpty());
        QVERIFY2(words.contains(where), qPrintable(words));
        QVERIFY(!window.banner());
        QVERIFY(window.isInLog("was refused"));
        // An edit at another place leaves it.
        const bool isOff = window.workspace().scene().schemes[0].isEnabled;
        QVERIFY(window.workspace().edit({{"/schemes/0/enabled", !isOff}}, "Switch"));
        QVERIFY(isRed(field) && field->text() == typed);
        window.workspace().undo();
        QVERIFY(isRed(field) && field->text() == typed && !wordsOf(*window.panel(), key).isEmpty());
        window.workspace().undo();
        QVERIFY(!isRed(field) && wordsOf(*window.panel(), key).isEmpty());
        QCOMPARE(field->text(), before);
        window.workspace().redo();
        QVERIFY(isRed(field) && !wordsOf(*window.panel(), key).isEmpty());
        enter(field, before);
        QVERIFY(!isRed(field) && wordsOf(*window.panel(), key).isEmpty());
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(window.workspace().document() == document);
    }
    void aChoiceIsRedAsWell() {
        Window window("preset:spring-pendulum");
        auto* box = window.panel()->findChild<QComboBox*>("field.type");
        const int exact = box->findText("exact");
        QVERIFY(exact >= 0);
        box->setCurrentIndex(exact);
        emit box->activated(exact);
        QVERIFY(isRed(box));
        QVERIFY(wordsOf(*window.panel(), "type").contains("no exact solution"));
        const int automatic = box->findText("auto");
        box->setCurrentIndex(automatic);
        emit box->activated(automatic);
        QVERIFY(!isRed(box) && !window.workspace().hasDrafts());
    }
    void twoRefusalsHaveTheirOwnWords() {
        Window window("preset:spring-pendulum");
        auto* end = window.panel()->findChild<QLineEdit*>("field.end");
        auto* mass = window.panel()->findChild<QLineEdit*>("field.m");
        enter(end, "1e12");
        enter(mass, "-1");
        QVERIFY(isRed(end) && isRed(mass));
        QVERIFY(wordsOf(*window.panel(), "end").contains("needs 1e+14 steps"));
        QVERIFY(wordsOf(*window.panel(), "m").contains("must be a positive"));
        enter(mass, "1");  // what it was
        QVERIFY(!isRed(mass) && isRed(end));
        QVERIFY(wordsOf(*window.panel(), "end").contains("needs 1e+14 steps"));
        // A value that is valid in place of the one that was refused.
        enter(end, "5");
        QVERIFY(!isRed(end));
        QCOMPARE(window.workspace().scene().end.value, 5.0);
        // Valid together only: each alone is refused.
        QVERIFY(window.workspace().edit(
            {{"/schemes", Value(Value::Array{*valueAt(window.workspace().document(), "/schemes/0")})}},
            "one"));
        enter(end, "1e12");
        QVERIFY(isRed(end));
        QVERIFY(window.workspace().edit({{"/schemes/0/step", Value(1e9)}}, "step"));
        QVERIFY(!isRed(end));
        QCOMPARE(window.workspace().scene().end.value, 1e12);
    }
    void theStepOfARow() {
        Window window("preset:spring-pendulum");
        SchemeCard* const card = window.card(0);
        auto* field = card->findChild<QLineEdit*>("step");
        auto* words = card->findChild<QLabel*>("refusal");
        card->editStep();
        enter(field, "1e-12");
        QVERIFY(field->isVisible() && isRed(field));
        QCOMPARE(field->text(), QString("1e-12"));
        QVERIFY(words->isVisible() && words->text().contains("needs 1e+13 steps"));
        field->setFocus();  // looking at it changes nothing
        window.compareView().setFocus();
        QVERIFY(field->isVisible() && isRed(field));
        enter(field, "0.02");
        QVERIFY(!field->isVisible() && !isRed(field) && !words->isVisible());
        QCOMPARE(window.workspace().scene().schemes[0].step.value, 0.02);
        card->editStep();
        enter(field, "-1");
        QVERIFY(isRed(field) && words->isVisible());
        window.workspace().undo();
        QVERIFY(!field->isVisible() && !words->isVisible());
        QVERIFY(!window.workspace().hasDrafts());
    }
    void theEditorOfAScheme() {
        Window window("preset:spring-pendulum");
        SchemeCard* const card = window.card(0);
        card->setEditing(true);
        QApplication::processEvents();
        auto* nodes = card->findChild<QSpinBox*>("field.nodes");
        QVERIFY(nodes);
        const Value document = window.workspace().document();
        nodes->setValue(1);  // too few for the space: found at the scheme, not at the number
        QVERIFY(isRed(nodes));
        QVERIFY(wordsOf(*card, "nodes").contains("unsupported combination"));
        QVERIFY(window.workspace().document() == document);
        // Closed, the row says it.
        card->setEditing(false);
        auto* words = card->findChild<QLabel*>("refusal");
        QVERIFY(words->isVisible() && words->text().contains("unsupported combination"));
        card->setEditing(true);
        QVERIFY(!words->isVisible());
        window.workspace().undo();
        QVERIFY(!window.workspace().hasDrafts());
    }
    /// A whole scheme that is not taken: the lists show what it still is, and the words stand below them.
    void aKindThatDoesNotFit() {
        Window window("preset:spring-pendulum");
        SchemeCard* const card = window.card(0);
        card->setEditing(true);
        QApplication::processEvents();
        auto* rule = card->findChild<QComboBox*>("rule");
        const QString before = rule->currentText();
        Value scheme = *valueAt(window.workspace().document(), "/schemes/0");
        scheme.set("quadrature", Value(Value::Object{{"type", "gauss"}, {"nodes", 1}}));
        QVERIFY(!window.workspace().edit({{"/schemes/0", scheme}}, "Change scheme"));
        auto* words = card->findChild<QLabel*>("problem.scheme");
        QVERIFY(words->isVisible() && words->text().contains("unsupported combination"));
        QCOMPARE(rule->currentText(), before);
        QVERIFY(!window.banner());
        window.workspace().undo();
        QVERIFY(!words->isVisible());
    }
    void whatNoFieldShowsIsSaidInABanner() {
        Window window("preset:spring-pendulum");
        const Value document = window.workspace().document();
        const Value* const scheme = valueAt(document, "/schemes/0");
        Value tooFine = *scheme;
        tooFine.set("label", "fine");
        tooFine.set("step", 1e-12);
        const std::vector<std::vector<Edit>> all{{{"/schemes/-", tooFine}},
                                                 {{"/views", Value(Value::Array{Value("no-such-view")})}},
                                                 {{"/schemes", std::nullopt}},
                                                 {{"/time/end", std::nullopt}}};
        for (const auto& edits : all) {
            window.notices().dismiss("refused");
            const bool isMade = window.workspace().edit(edits, "Change something");
            if (isMade) {  // what is left out has a default
                window.workspace().undo();
                continue;
            }
            QVERIFY2(window.banner(), edits[0].pointer.c_str());
            QVERIFY(window.banner()->text.startsWith("Change something was refused. "));
            QVERIFY(!window.workspace().hasDrafts());
            QVERIFY(window.workspace().document() == document);
        }
        QVERIFY(window.workspace().edit({{"/model/k", Value(500.0)}}, "Change stiffness"));
        QVERIFY(!window.banner());
    }
    void aFieldThatIsFoldedAwaySaysItInABanner() {
        Window window("preset:spring-pendulum");
        window.actions().find("scenePanel")->trigger();
        QVERIFY(!window.workspace().edit({{"/model/k", Value(-1.0)}}, "Change stiffness"));
        QVERIFY(window.banner() && !window.workspace().hasDrafts());
        window.actions().find("scenePanel")->trigger();
    }
    /// A formula that is sound and makes another part of the scene wrong, and one whose parameters do.
    void aLagrangianThatIsWrongElsewhere() {
        Window window("preset:duffing");
        auto* formula = window.findChild<QPlainTextEdit*>("field.lagrangian");
        formula->setFocus();
        formula->selectAll();
        QTest::keyClicks(formula, "m/2*x_t^2 - log(x - 1000)");
        auto* words = window.findChild<QLabel*>("problem.lagrangian");
        QTRY_VERIFY(words->isVisible());
        QVERIFY(isRed(formula));
        QVERIFY(window.workspace().draftAt("/model/lagrangian"));
        QVERIFY(!words->text().isEmpty());
        QVERIFY(!window.banner());
    }
    void callersThatSayItThemselvesGetTheReason() {
        Window window("preset:spring-pendulum");
        const Value document = window.workspace().document();
        const auto problems = window.workspace().tryEdit({{"/time/end", Value(1e12)}}, "end");
        QVERIFY(!problems.empty() && problems[0].pointer == "/schemes/0/step");
        QVERIFY(!window.workspace().hasDrafts() && !window.banner());
        QVERIFY(window.workspace().document() == document);
        QVERIFY(window.workspace().tryEdit({{"/time/end", Value(9.0)}}, "end").empty());
        QCOMPARE(window.workspace().scene().end.value, 9.0);
    }
};

EXTREMAL_TEST(RefusalsTest)
}  // namespace extremal::refusals_test

#include "refusals_test.moc"
