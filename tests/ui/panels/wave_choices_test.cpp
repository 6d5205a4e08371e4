/// What the window offers for wave functions: on a circle everything, between walls nothing that would be refused.
#include <QTest>

#include "engine/baseline/catalog.hpp"
#include "engine/integrator/scheme.hpp"
#include "engine/scene/bind.hpp"
#include "tests/tools/test.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/shell/fitting.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/run_control.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal::wave_choices_test {

class WaveChoicesTest : public QObject {
    Q_OBJECT

    static QStringList baselines(const Scene& scene) {
        QStringList ids;
        for (const BaselineEntry* e : fittingBaselines(scene)) ids << QString::fromStdString(e->item.id);
        ids.sort();
        return ids;
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void everyCellBetweenWallsRuns() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:box-revival");
        QVERIFY(window.workspace().edit({{"/time/end", "pi/10"}}, "end"));
        QCOMPARE(baselines(window.workspace().scene()), (QStringList{"chebyshev-propagation", "crank-nicolson"}));
        for (const SchemeEntry* e : fittingSchemes(window.workspace().scene()))
            QVERIFY(e->make(e->minDegree).space.text("form") != "three-level");
        for (DiscretizerCell* cell : window.discretizer().findChildren<DiscretizerCell*>())
            if (cell->isEnabled()) QTest::mouseClick(cell, Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes.size(), std::size_t(8));  // degrees 2 and 8 were there
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(QTest::qWaitFor(
            [&] { return window.runControl().state() == RunControl::State::finished && !window.runControl().isStale(); }, 20000));
        for (const auto& scheme : window.runControl().results()->schemes)
            QVERIFY(scheme->summary.status == RunStatus::done);
    }
    void theBoundaryChangesWhatIsOffered() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:box-revival");
        const auto cells = [&] { return window.discretizer().findChildren<DiscretizerCell*>().size(); };
        const auto between = cells();
        QVERIFY(window.workspace().edit({{"/model/boundary", "periodic"}}, "boundary"));
        QVERIFY(cells() > between);
        QVERIFY(baselines(window.workspace().scene()).contains("strang"));
        QVERIFY(window.workspace().edit({{"/model/boundary", "dirichlet"}}, "boundary"));
        QCOMPARE(cells(), between);
    }
};

EXTREMAL_TEST(WaveChoicesTest)
}  // namespace extremal::wave_choices_test

#include "wave_choices_test.moc"
