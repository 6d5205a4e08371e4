// SPDX-License-Identifier: GPL-3.0-or-later
/// What the window offers for wave functions: on a circle everything, with a Dirichlet boundary nothing that
/// would be refused.
#include <QTest>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/scene/bind.hpp"
#include "tests/tools/test.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/fitting.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

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
        QCOMPARE(baselines(window.workspace().scene()),
                 (QStringList{"chebyshev-propagation", "crank-nicolson"}));
        for (const SchemeEntry* e : fittingSchemes(window.workspace().scene()))
            QVERIFY(e->make(e->minDegree).space.text("form") != "three-level");
        // New cells and their layout wait for the event loop.
        QTRY_VERIFY(window.discretizer().isCurrent() &&
                    window.discretizer().findChild<DiscretizerCell*>()->height() > 0);
        for (DiscretizerCell* cell : window.discretizer().findChildren<DiscretizerCell*>())
            if (cell->isEnabled()) QTest::mouseClick(cell, Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes.size(), std::size_t(10));  // degrees 2 and 8 were there
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(QTest::qWaitFor(
            [&] {
                return window.runControl().state() == RunControl::State::finished &&
                       !window.runControl().isStale();
            },
            20000));
        for (const auto& scheme : window.runControl().results()->schemes)
            QVERIFY(scheme->summary.status == RunStatus::done);
    }
    /// What the window offers runs.
    void everythingOfferedRuns_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QStringList>("edits");
        QTest::addColumn<QStringList>("missing");
        QTest::newRow("rectangle") << "preset:double-slit"
                                   << QStringList{"/model/potential", "\"cos(x + y)\"",
                                                  "/model/modes",     "16",
                                                  "/model/modes_y",   "20",
                                                  "/time/end",        "0.05"}
                                   << QStringList{};
        QTest::newRow("convolution") << "preset:tunnelling"
                                     << QStringList{"/model/product", "\"convolution\"",
                                                    "/model/modes",   "32",
                                                    "/time/end",      "0.02"}
                                     << QStringList{"strang", "srkn-14a", "spectral-collocation"};
    }
    void everythingOfferedRuns() {
        QFETCH(QString, preset);
        QFETCH(QStringList, edits);
        QFETCH(QStringList, missing);
        MainWindow window(Theme::light(), false);
        window.show();
        window.open(preset);
        for (int i = 0; i < edits.size(); i += 2)
            QVERIFY(window.workspace().edit(
                {{edits[i].toStdString(), edits[i + 1].startsWith('"')
                                              ? Value(edits[i + 1].mid(1).chopped(1).toStdString())
                                              : Value(edits[i + 1].toDouble())}},
                "smaller"));
        const QStringList offered = baselines(window.workspace().scene());
        QVERIFY(offered.contains("leapfrog") && offered.contains("crank-nicolson"));
        for (const QString& id : missing) QVERIFY2(!offered.contains(id), qPrintable(id));
        QCOMPARE(offered.contains("strang"), missing.isEmpty());
        QTRY_VERIFY(window.discretizer().isCurrent());
        for (DiscretizerCell* cell : window.discretizer().findChildren<DiscretizerCell*>())
            if (cell->isEnabled()) QTest::mouseClick(cell, Qt::LeftButton);
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(QTest::qWaitFor(
            [&] {
                return window.runControl().state() == RunControl::State::finished &&
                       !window.runControl().isStale();
            },
            60000));
        for (const auto& scheme : window.runControl().results()->schemes)
            QVERIFY2(scheme->summary.status == RunStatus::done, scheme->spec.label.c_str());
    }
    void theBoundaryChangesWhatIsOffered() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:box-revival");
        const auto cells = [&] {
            if (!QTest::qWaitFor([&] { return window.discretizer().isCurrent(); })) return qsizetype(-1);
            return window.discretizer().findChildren<DiscretizerCell*>().size();
        };
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
