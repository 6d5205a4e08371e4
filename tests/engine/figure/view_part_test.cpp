// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a plot that a view asks for, and the curve it draws for comparison.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/fit_axes.hpp"
#include "engine/figure/sample.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/tools/test.hpp"

namespace extremal::view_part_test {
namespace {

Number number(double value) { return {value, {}}; }

View part(const std::string& id, std::pair<double, double> x) {
    View view{id, "", ""};
    view.xRange = {number(x.first), number(x.second)};
    return view;
}

/// The largest distance of a curve's chords from the curve, over its places.
double deviation(const Series& s, double (*f)(double)) {
    double most = 0;
    for (std::size_t i = 1; i < s.x.size(); ++i)
        most = std::max(most, std::abs((s.y[i - 1] + s.y[i]) / 2 - f((s.x[i - 1] + s.x[i]) / 2)));
    return most;
}

}  // namespace

class ViewPartTest : public QObject {
    Q_OBJECT
private slots:
    void theAxesKnownBeforehandAreThoseOfTheFigures() {
        const Comparison comparison = handmade::comparison();
        for (const System& system : {handmade::pendulum(), handmade::kepler()})
            for (const ViewEntry& entry : viewEntries()) {
                if (!entry.isPlot()) continue;
                const View view{entry.item.id, "", ""};
                const Figure f = makeFigure(comparison, view, &system);
                const ViewAxes axes = axesOf(view, system);
                QVERIFY2(axes.isXLog == f.x.isLog && axes.isYLog == f.y.isLog, entry.item.id.c_str());
                QVERIFY2((axes.variable == "t") == f.x.isTime || entry.item.id == "section",
                         entry.item.id.c_str());
            }
        const System kepler = handmade::kepler();
        QCOMPARE(axesOf({"trajectory", "", ""}, kepler).variable, std::string());
        QCOMPARE(axesOf({"trajectory", "", "q.y"}, kepler).variable, std::string("t"));
        QCOMPARE(axesOf({"phase", "t", "q.y"}, kepler).variable, std::string("t"));
        QCOMPARE(axesOf({"profile", "", ""}, kepler).variable, std::string("x"));
        QVERIFY(!axesOf({"stage", "", ""}, kepler).hasScales);
    }
    void theScaleOfYIsThatOfTheScene() {
        const System system = handmade::pendulum();
        const Comparison comparison = handmade::comparison();
        const auto made = [&](const char* id, std::optional<bool> isLog) {
            View view{id, "", ""};
            view.isLog = isLog;
            return makeFigure(comparison, view, &system);
        };
        const Figure energy = made("energy", {}), linear = made("energy", false);
        QVERIFY(energy.y.isLog && !linear.y.isLog);
        QVERIFY(linear.y.range->first <= 0 && energy.y.range->first > 0);
        // Zero at the start is a gap of the logarithmic axis alone.
        QVERIFY(energy.series()[0].hidden > 0 && linear.series()[0].hidden == 0);
        QVERIFY(!made("phase", {}).y.isLog && made("phase", true).y.isLog);
        QVERIFY(made("phase", true).y.range->first > 0);
        View phase{"phase", "", ""};
        phase.isLog = true;
        QVERIFY(axesOf(phase, system).isYLog && !axesOf({"phase", "", ""}, system).isYLog);
        QVERIFY(canHaveScale(linear, true) && canHaveScale(energy, false));
        Figure below;  // nothing is positive
        below.add({});
        below.series()[0].x = below.series()[0].y = {-2, -1};
        QVERIFY(!canHaveScale(below, true) && canHaveScale(below, false));
        below.add(HeatMap());
        QVERIFY(!canHaveScale(below, false));
    }
    void theOtherAxisFitsWhatThePartShows() {
        const System system = handmade::pendulum();
        const Comparison comparison = handmade::comparison();
        // RK4 gains energy: by t = 1 a tenth of what it has at 10.
        const Figure all = makeFigure(comparison, {"energy", "", ""}, &system);
        const Figure f = makeFigure(comparison, part("energy", {0, 1}), &system);
        QCOMPARE(*f.x.range, (std::pair<double, double>{0, 1}));
        QVERIFY(f.y.range->second < all.y.range->second / 3 && f.y.range->first > 0);
        QVERIFY(!all.x.whole && !all.y.whole);
        QCOMPARE(*f.x.whole, *all.x.range);
        QCOMPARE(*f.y.whole, *all.y.range);
        View both = part("energy", {0, 1});
        both.yRange = {number(1e-9), number(1)};
        QCOMPARE(*makeFigure(comparison, both, &system).y.range, (std::pair<double, double>{1e-9, 1}));
    }
    void aLineWhosePointsAreAllOutsideCounts() {
        Figure f;
        f.add({});
        f.series()[0].x = {0, 10};
        f.series()[0].y = {0, 100};
        View view = part("phase", {4, 6});
        fitAxes(f, view, "");
        QVERIFY(f.y.range->first > 35 && f.y.range->first < 40 && f.y.range->second > 60 &&
                f.y.range->second < 65);
        f.series()[0].kind = SeriesKind::marks;  // dots are outside altogether
        f.x.range = f.y.range = {};
        fitAxes(f, view, "");
        QCOMPARE(*f.y.range, (std::pair<double, double>{0, 1}));
    }
    void theCurveIsTheExpressionOverThePartShown() {
        const System system = handmade::pendulum();
        View view = part("trajectory", {2, 4});
        view.curve = {"0.5*cos(w*t)", {{"w", 3.0}}};
        const Figure f = makeFigure(handmade::comparison(), view, &system);
        QCOMPARE(f.series().size(), std::size_t(6));
        const Series& s = f.series().back();
        QVERIFY(s.style == formulaStyle && s.label == "0.5*cos(w*t)" && s.x.size() == 4001);
        QVERIFY(s.x.front() == 2 && s.x.back() == 4);
        for (std::size_t i = 0; i < s.x.size(); ++i) QCOMPARE(s.y[i], 0.5 * std::cos(3 * s.x[i]));
        QVERIFY(figureCsv(f, false).find("\n0.5*cos(w*t),2,") != std::string::npos);
        QVERIFY(f.summary.find("cos") == std::string::npos);  // it tells of the schemes
    }
    void fastCurvesGetThePointsTheyNeed() {
        const ViewCurve fast{"sin(2000*t)", {}};
        const Series s = formulaSeries(fast, "t", 0, 10);
        QVERIFY(s.x.size() > 4001 && s.label == "sin(2000*t)");
        const double most = deviation(s, [](double t) { return std::sin(2000 * t); });
        QVERIFY2(most < 0.02, qPrintable(QString::number(most)));  // measured: 0.0122
        const Series part = formulaSeries(fast, "t", 0, 0.1);
        QCOMPARE(part.x.size(), std::size_t(4001));
        const Series tooFast = formulaSeries({"sin(1e6*t)", {}}, "t", 0, 10);
        QVERIFY(tooFast.label.ends_with("(too fast for this range)") && tooFast.x.size() == 64001);
    }
    void shapeFunctionsAreThoseOfTheSchemes() {
        const Scene scene = readScene(findPreset("seed-elliptic")->json).scene;
        const Comparison comparison = run(scene);
        const Figure f = makeFigure(comparison, scene.views[2]);
        QVERIFY(f.series().size() == 2 && f.subtitle == "of node 2 of 10, x = 0.2 · zoomed");
        QVERIFY(f.x.range->first == 0.2 && f.x.range->second == 0.3 &&
                std::abs(f.x.whole->first - 0.1) < 1e-15);
        QCOMPARE(f.series()[0].y[f.series()[0].y.size() / 2], 1.0);
        // Where the source hardly acts the solution is a multiple of the shape function; of the hat it is
        // none.
        const Figure u = makeFigure(comparison, {"trajectory", "", "u_exact"});
        QVERIFY(u.series().size() == 1 && u.series()[0].style == exactStyle && u.y.title == "u");
        const auto at = [](const Series& s, double x) { return pointAt(s, x)->second; };
        double apart[2] = {0, 0};
        for (double x = 0.205; x < 0.3; x += 0.005)
            for (std::size_t i = 0; i < 2; ++i) {
                const double share = (at(u.series()[0], x) - at(u.series()[0], 0.3)) /
                                     (at(u.series()[0], 0.2) - at(u.series()[0], 0.3));
                apart[i] = std::max(apart[i], std::abs(share - at(f.series()[i], x)));
            }
        qInfo("the solution differs from the multiscale function by %.3f, from the hat by %.3f", apart[0],
              apart[1]);
        QVERIFY(apart[0] < 0.02 && apart[1] > 0.05);
    }
    void whatTheAxisCannotShowIsAGap() {
        const System system = handmade::pendulum();
        View view{"energy", "", ""};
        view.curve = {"t-5", {}};
        const Series onLog = makeFigure(handmade::comparison(), view, &system).series().back();
        QVERIFY(onLog.hidden == 2001 && std::isnan(onLog.y[2000]) && onLog.y[2001] > 0);
        view = {"trajectory", "", ""};
        view.curve = {"sqrt(t-5)", {}};
        const Figure f = makeFigure(handmade::comparison(), view, &system);
        QVERIFY(std::isnan(f.series().back().y.front()) && std::isfinite(f.y.range->second));
    }
};

EXTREMAL_TEST(ViewPartTest)
}  // namespace extremal::view_part_test

#include "view_part_test.moc"
