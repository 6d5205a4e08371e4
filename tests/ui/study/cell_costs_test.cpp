// SPDX-License-Identifier: GPL-3.0-or-later
/// The cells of the discretizer are shaded by what the wanted error costs with each, as it is measured; the
/// strip below them stays in sight.
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QTest>

#include <algorithm>

#include "tests/tools/slowdown.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/study/cell_costs.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::cell_costs_test {
namespace {

bool waitForCosts(MainWindow& window) {
    return QTest::qWaitFor([&] { return window.cellCosts().isCurrent(); }, 60000);
}

std::ptrdiff_t measured(MainWindow& window) {
    const auto& cells = window.discretizer().cells();
    return std::count_if(cells.begin(), cells.end(),
                         [](const auto* c) { return c->cost() && c->cost()->seconds > 0; });
}

}  // namespace

class CellCostsTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    void cellsTellWhatTheWantedErrorCosts() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        QCOMPARE(measured(window), std::ptrdiff_t{0});
        window.wanted().setError(1e-3);
        window.actions().find("cellCosts")->trigger();
        QVERIFY(waitForCosts(window));
        // In the time of a search a build with sanitizers comes to some cells only.
        const std::ptrdiff_t fewest = tests::slowdown > 1 ? 2 : 10;
        QVERIFY2(measured(window) >= fewest, qPrintable(QString::number(measured(window))));
        double least = 1e9;
        for (const DiscretizerCell* cell : window.discretizer().cells())
            if (cell->cost() && cell->cost()->seconds > 0) least = std::min(least, cell->cost()->times);
        QCOMPARE(least, 1.0);
        // Another scheme is no other problem; another parameter, and another wanted error, are.
        QVERIFY(window.workspace().edit({{"/schemes/0/enabled", false}}, "off"));
        QVERIFY(window.cellCosts().isCurrent());
        window.wanted().setError(1e-5);
        QVERIFY(!window.cellCosts().isCurrent());
        QCOMPARE(measured(window), std::ptrdiff_t{0});
        QVERIFY(waitForCosts(window));
        QVERIFY(measured(window) > 0);
        window.actions().find("cellCosts")->trigger();
        QCOMPARE(measured(window), std::ptrdiff_t{0});
    }
    void theStripStaysInSight_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QSize>("size");
        for (const char* preset :
             {"spring-pendulum", "kepler", "coherent-state", "sine-gordon-kink", "free-body"})
            for (const QSize size : {QSize(1600, 1000), QSize(1280, 800)})
                QTest::addRow("%s %d", preset, size.width()) << QString("preset:") + preset << size;
    }
    void theStripStaysInSight() {
        QFETCH(QString, preset);
        QFETCH(QSize, size);
        MainWindow window(Theme::light(), false);
        window.resize(size);
        window.show();
        QVERIFY(window.open(preset));
        QVERIFY(waitForResults(window));
        for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
        auto* const strip = window.discretizer().findChild<QLabel*>("aboutCell");
        QVERIFY(strip && strip->isVisible());
        const QRect there(strip->mapTo(&window, QPoint(0, 0)), strip->size());
        QVERIFY2(window.rect().contains(there), qPrintable(QString::number(there.bottom())));
        QCOMPARE(strip->visibleRegion().boundingRect().size(), strip->size());
        // The scene has its share of the panel.
        const auto* const panel = window.findChild<QSplitter*>()->widget(0);
        const auto* const scene = panel->findChild<QScrollArea*>();
        const int least = std::min(scene->widget()->sizeHint().height(), panel->height() * 2 / 5);
        QVERIFY2(scene->height() >= least, qPrintable(QString::number(scene->height())));
        // And some of the cells.
        const auto& cells = window.discretizer().cells();
        const auto seen = std::count_if(cells.begin(), cells.end(),
                                        [](const auto* c) { return !c->visibleRegion().isEmpty(); });
        QVERIFY2(seen >= std::min<std::ptrdiff_t>(21, std::ssize(cells)), qPrintable(QString::number(seen)));
    }
    void wideCellsSpeakInWords() {
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        DiscretizerCell* const gauss = window.discretizer().cell(2, "gauss");
        QVERIFY(gauss);
        QVERIFY2(gauss->words().contains("order 4"), qPrintable(gauss->words()));
        const int narrow = gauss->width();
        window.actions().find("wideDiscretizer")->trigger();
        for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
        QVERIFY2(gauss->width() > 2 * narrow, qPrintable(QString::number(gauss->width())));
        window.actions().find("wideDiscretizer")->trigger();
    }
};

EXTREMAL_TEST(CellCostsTest)
}  // namespace extremal::cell_costs_test

#include "cell_costs_test.moc"
