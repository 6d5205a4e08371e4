// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/panels.hpp"
#include "tests/tools/test.hpp"

#include <QTest>

#include <cmath>
#include <numbers>
#include <numeric>

namespace extremal::panels_test {

/// Two schemes on circles of radius 1 and 2; the first stays three quarters of its time on the right half.
Figure circles() {
    Figure figure;
    figure.view = "phase";
    figure.title = "Phase portrait";
    figure.x = {"q"};
    figure.y = {"p"};
    figure.x.range = figure.y.range = {-2.5, 2.5};
    for (int k = 0; k < 2; ++k) {
        Series s;
        s.label = k == 0 ? "A" : "B, \"two\"";
        s.style = k;
        s.kind = SeriesKind::curve;
        for (int i = 0; i <= 400; ++i) {
            const double part = i / 400.0, angle = 2 * std::numbers::pi * part - std::numbers::pi / 2;
            s.x.push_back((k + 1) * std::cos(angle));
            s.y.push_back((k + 1) * std::sin(angle));
            s.t.push_back(k == 1 ? part : part < 0.5 ? 1.5 * part : 0.75 + 0.5 * (part - 0.5));
        }
        figure.add(std::move(s));
    }
    Guide guide;
    guide.x = {0, 1};
    guide.y = {0, 1};
    figure.add(guide);
    return figure;
}

double sumOf(const HeatMap& heat, bool isRight) {
    double sum = 0;
    for (int c = 0; c < heat.columns; ++c)
        for (int r = 0; r < heat.rows; ++r)
            if (const double v = heat.values[static_cast<std::size_t>(c * heat.rows + r)];
                std::isfinite(v) && (c >= heat.columns / 2) == isRight)
                sum += v;
    return sum;
}

class PanelsTest : public QObject {
    Q_OBJECT
private slots:
    void aWindowOfTimeCutsCurvesAtBothEnds() {
        const Figure part = withinTimes(circles(), 0.1234, 0.4321);
        QCOMPARE(part.x.range, circles().x.range);
        for (const Series& s : part.series()) {
            QCOMPARE(s.t.front(), 0.1234);
            QCOMPARE(s.t.back(), 0.4321);
            QCOMPARE(s.x.size(), s.t.size());
            for (const double t : s.t) QVERIFY(t >= 0.1234 && t <= 0.4321);
        }
        // The second scheme turns evenly: its ends are known, up to the chords of 400 samples.
        const Series& even = part.series()[1];
        const double angle = 2 * std::numbers::pi * 0.4321 - std::numbers::pi / 2;
        QVERIFY(std::abs(even.x.back() - 2 * std::cos(angle)) < 1e-4);
        Figure energy = circles();
        energy.x.isTime = true;
        QCOMPARE(withinTimes(energy, 0.2, 0.3).x.range->first, 0.2);
        QCOMPARE(withinTimes(energy, 0.2, 0.3).series()[0].x.size(), energy.series()[0].x.size());
    }

    void schemesBesideEachOtherShareTheirAxes() {
        const std::vector<Figure> panels = besideEachOther(circles());
        QCOMPARE(panels.size(), std::size_t{2});
        for (std::size_t i = 0; i < 2; ++i) {
            QCOMPARE(panels[i].series().size(), std::size_t{1});
            QCOMPARE(panels[i].title, circles().series()[i].label);
            QCOMPARE(panels[i].x.range, circles().x.range);
            QVERIFY(panels[i].find<Guide>());  // what belongs to no scheme is in each
        }
        Figure overTime = circles();
        overTime.x.isTime = true;
        QCOMPARE(besideEachOther(overTime).size(), std::size_t{1});
    }

    void densitiesAreSharesOfTheTime() {
        const std::string first = "A";
        const Figure one = withSchemes(circles(), std::span(&first, 1));
        for (const int cells : {10, 80}) {
            const Figure map = densityOf(one, cells);
            QVERIFY(map.series().empty());
            const HeatMap& heat = *map.heat();
            QVERIFY(std::abs(sumOf(heat, true) + sumOf(heat, false) - 1) < 1e-12);
            QVERIFY2(std::abs(sumOf(heat, true) - 0.75) < 2e-3,
                     qPrintable(QString::number(sumOf(heat, true))));
            QVERIFY(heat.low > 0 && heat.low < heat.high);
        }
    }

    void densitiesDoNotDependOnSamples() {
        // A quarter of the samples, evenly: the same times in the same cells, but for the chords.
        Figure sparse = circles();
        for (Series& s : sparse.series()) {
            Series few = s;
            few.x.clear();
            few.y.clear();
            few.t.clear();
            for (std::size_t i = 0; i < s.x.size(); i += 4) {
                few.x.push_back(s.x[i]);
                few.y.push_back(s.y[i]);
                few.t.push_back(s.t[i]);
            }
            s = few;
        }
        const HeatMap fine = *densityOf(circles(), 20).heat(), coarse = *densityOf(sparse, 20).heat();
        for (std::size_t i = 0; i < fine.values.size(); ++i)
            if (std::isfinite(fine.values[i]) && fine.values[i] > 0.01)
                QVERIFY2(std::abs(coarse.values[i] / fine.values[i] - 1) < 0.2,
                         qPrintable(QString::number(i)));
    }
};

EXTREMAL_TEST(PanelsTest)
}  // namespace extremal::panels_test

#include "panels_test.moc"
