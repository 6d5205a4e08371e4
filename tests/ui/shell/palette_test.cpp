// SPDX-License-Identifier: GPL-3.0-or-later
/// The palette finds whatever can be done, and goes there.
#include <QApplication>
#include <QLineEdit>
#include <QListWidget>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::palette_test {

class PaletteTest : public QObject {
    Q_OBJECT

    /// Types into the palette of a window and takes the first entry, whose text is returned.
    static QString take(MainWindow& window, const QString& text) {
        window.actions().find("palette")->trigger();
        auto* dialog = window.findChild<PaletteDialog*>();
        if (!dialog) return {};
        auto* input = dialog->findChild<QLineEdit*>();
        QTest::keyClicks(input, text);
        const QString taken = dialog->findChild<QListWidget*>()->item(0)->text();
        QTest::keyClick(input, Qt::Key_Return);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        return taken;
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void itLeadsToEverything() {
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        // Of presets that begin alike, the one that was asked for.
        QCOMPARE(take(window, "open preset: spring-pendulum"), QString("Open preset: spring-pendulum"));
        QCOMPARE(window.workspace().origin(), QString("preset:spring-pendulum"));
        QVERIFY(waitForResults(window));

        take(window, "change stiffness");
        auto* stiffness = window.findChild<QLineEdit*>("field.k");
        QCOMPARE(window.focusWidget(), static_cast<QWidget*>(stiffness));
        QCOMPARE(stiffness->selectedText(), stiffness->text());

        const std::size_t schemes = window.workspace().scene().schemes.size();
        take(window, "add degree 3 lobatto");
        QCOMPARE(window.workspace().scene().schemes.size(), schemes + 1);
        QCOMPARE(window.workspace().scene().schemes.back().space.integer("degree"), 3);

        take(window, "step of midpoint");
        const auto& all = window.workspace().scene().schemes;
        const int selected = window.workspace().selectedScheme();
        QVERIFY(selected >= 0);
        QCOMPARE(all[static_cast<std::size_t>(selected)].label, std::string("midpoint"));
        auto* card = window.findChild<SchemeCard*>(QString("scheme.%1").arg(selected));
        QVERIFY(card->findChild<QLineEdit*>("step")->isVisible());

        take(window, "maximise the plot energy error");
        int visible = 0;
        for (const PlotWidget* plot : window.compareView().plots()) visible += plot->isVisible();
        QCOMPARE(visible, 1);
        QCOMPARE(window.compareView().currentPlot()->figure().view, std::string("energy"));
        QVERIFY(window.compareView().restore());
    }
    void whatIsNotThereIsSaid() {
        MainWindow window(Theme::light(), false);
        window.show();
        QCOMPARE(take(window, "xyzzy"), QString("No matching action"));
        auto* dialog = window.findChild<PaletteDialog*>();
        QVERIFY(dialog && dialog->isVisible());  // Return does nothing
        dialog->reject();
    }
};

EXTREMAL_TEST(PaletteTest)
}  // namespace extremal::palette_test

#include "palette_test.moc"
