// SPDX-License-Identifier: GPL-3.0-or-later
/// The editor of a scheme with a rule for each term: its list of rules is that of the other terms.
#include <QComboBox>
#include <QTest>

#include "engine/quadrature/tensor.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::term_rules_test {

class TermRulesTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase() { loadFonts(); }
    void theListIsTheRuleOfTheOtherTerms() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:averaged-rotations"));
        Workspace& workspace = window.workspace();
        const auto rule = [&](const char* term) {
            return QString::fromStdString(termPart(workspace.scene().schemes[0].quadrature, term).type);
        };
        QCOMPARE(rule(otherTerms), QString("midpoint"));
        SchemeEditor editor(workspace, 0);
        auto* const list = editor.findChild<QComboBox*>("rule");
        QCOMPARE(list->currentData().toString(), rule(otherTerms));
        const auto choose = [&](const char* id) {
            list->setCurrentIndex(list->findData(id));
            emit list->activated(list->currentIndex());
        };
        choose("gauss");
        QCOMPARE(rule(otherTerms), QString("gauss"));
        QCOMPARE(rule("across"), QString("trapezoid"));  // stays
        QCOMPARE(list->currentData().toString(), QString("gauss"));
        QVERIFY(editor.findChild<QWidget*>("field.nodes"));  // of this rule
        // Without a rule of their own the others have the one that fits.
        QVERIFY(workspace.edit({{"/schemes/0/quadrature", Value(Value::Object{{"across", "trapezoid"}})}},
                               "rules"));
        QCOMPARE(list->currentIndex(), -1);
        QCOMPARE(list->placeholderText(), QString("auto"));
        // And back.
        workspace.undo();
        workspace.undo();
        QCOMPARE(list->currentData().toString(), QString("midpoint"));
    }
};

EXTREMAL_TEST(TermRulesTest)
}  // namespace extremal::term_rules_test

#include "term_rules_test.moc"
