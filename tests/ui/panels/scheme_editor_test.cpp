// SPDX-License-Identifier: GPL-3.0-or-later
/// The editor of a scheme: what its lists and fields say of what a scheme leaves out, and of a rule for each
/// direction.
#include <QComboBox>
#include <QSpinBox>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::scheme_editor_test {

class SchemeEditorTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    /// Elements of the model's own mesh have no number of cells, and not the least one.
    void aCountThatIsLeftOutStaysSo() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:tensor-elements"));
        SchemeEditor editor(window.workspace(), 1);
        auto* const cells = editor.findChild<QSpinBox*>("field.cells");
        QVERIFY(cells);
        QCOMPARE(cells->text(), QStringLiteral("default"));
        const auto own = [&] { return window.workspace().scene().schemes[1].space.find("cells"); };
        QVERIFY(!own());
        cells->setValue(40);
        QVERIFY(own() && *own() == Value(40.0));
        cells->setValue(cells->minimum());
        QVERIFY(!own() && !window.workspace().hasDrafts());
        QCOMPARE(cells->text(), QStringLiteral("default"));
    }
    void aRuleForEachDirectionIsShown() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:tensor-elements"));
        SchemeEditor editor(window.workspace(), 0);
        auto* const rule = editor.findChild<QComboBox*>("rule");
        QCOMPARE(rule->currentText(), QStringLiteral("tensor product"));
        const int gauss = rule->findData(QStringLiteral("gauss"));
        QVERIFY(gauss >= 0);
        rule->setCurrentIndex(gauss);
        emit rule->activated(gauss);
        QCOMPARE(window.workspace().scene().schemes[0].quadrature.type, std::string("gauss"));
    }
};

EXTREMAL_TEST(SchemeEditorTest)

}  // namespace extremal::scheme_editor_test

#include "scheme_editor_test.moc"
