// SPDX-License-Identifier: GPL-3.0-or-later
/// Between the nodes plots follow the scheme's own curve, not a chord.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/figure/figure.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::curve_test {
namespace {

Scene kepler(const std::string& scheme, double step, double end) {
    const std::string text =
        R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":)" +
        std::to_string(end) + R"(},"schemes":[{"label":"s","step":)" + std::to_string(step) +
        ",\"scheme\":\"" + scheme + "\"}]}";
    return readScene(std::string_view(text)).scene;
}

/// Largest distance from the exact orbit: along what plots are drawn through, and along straight lines
/// between nodes.
struct Off {
    double curve = 0, chord = 0;
};
Off offOrbit(const std::string& scheme, double step) {
    const Scene scene = kepler(scheme, step, 6);
    const System system = makeSystem(scene);
    const auto exact = system.exact(initialState(scene, system));
    const Comparison c = run(scene);
    const Trajectory& curve = c.schemes[0]->products.find<DenseOutput>()->points;
    const Trajectory& nodes = c.schemes[0]->trajectory;
    Off off;
    const auto distance = [&](double t, double x, double y) {
        std::vector<double> at(4);
        exact(t, at);
        return std::hypot(x - at[0], y - at[1]);
    };
    for (std::size_t i = 0; i < curve["t"].size(); ++i)
        off.curve = std::max(off.curve, distance(curve["t"][i], curve["q.x"][i], curve["q.y"][i]));
    for (std::size_t i = 0; i + 1 < nodes.rows(); ++i) {
        const auto middle = [&](const char* name) { return (nodes[name][i] + nodes[name][i + 1]) / 2; };
        off.chord = std::max(off.chord, distance(middle("t"), middle("q.x"), middle("q.y")));
    }
    return off;
}

}  // namespace

class CurveTest : public QObject {
    Q_OBJECT
private slots:
    void theCurveHasTheOrderOfTheSpacePlusOne() {
        // Degree 4: 5. A chord has order 2, whatever the scheme: what this test would see in its place.
        const Off coarse = offOrbit("galerkin-gauss-4", 0.2), fine = offOrbit("galerkin-gauss-4", 0.1);
        const double order = std::log2(coarse.curve / fine.curve),
                     ofChords = std::log2(coarse.chord / fine.chord);
        qInfo("curve %.2e, order %.2f; chords %.2e, order %.2f", fine.curve, order, fine.chord, ofChords);
        QVERIFY(order > 4.5 && order < 5.8);
        QVERIFY(ofChords < 2.5 && fine.chord > 100 * fine.curve);
    }
    void partsThatAViewShowsHaveMorePoints() {
        // 20 steps: 40 points per step everywhere, some hundreds where one step is looked at.
        const auto rowsIn = [](const char* views) {
            const std::string text = std::string(R"({"extremal":1,"model":{"type":"spring-pendulum","k":1e6},
                "initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":2},"schemes":[{"step":0.1,"scheme":"galerkin-gauss-4"}],
                "reference":"none","observe":["energy"],"views":[)") +
                                     views + "]}";
            const ReadScene read = readScene(std::string_view(text));
            if (!read.errors.empty()) qWarning("%s", read.errors[0].message.c_str());
            const Trajectory curve = run(read.scene).schemes.at(0)->products.find<DenseOutput>()->points;
            const auto t = curve["t"];
            return std::pair{t.size(), std::count_if(t.begin(), t.end(),
                                                     [](double at) { return at > 0.501 && at < 0.599; })};
        };
        const auto usual = rowsIn(R"("stage",{"view":"phase","range":{"x":[0.5,0.6]}})");
        QCOMPARE(usual.first, std::size_t(20 * 40 + 1));
        const auto shown = rowsIn(R"({"view":"trajectory","y":"q.a","range":{"x":[0.505,0.595]}})");
        QVERIFY(shown.second > 900 && shown.first < 2000);
        const auto narrow = rowsIn(R"({"view":"trajectory","y":"q.a","range":{"x":[0.55,0.5501]}})");
        QVERIFY(narrow.first < 2000);
        const auto all = rowsIn(R"({"view":"trajectory","y":"q.a","range":{"x":[0,2]}})").first;
        QVERIFY(all >= 20 * 50 + 1 && all <= 20 * 51 + 1);
    }
    void manyStepsHavePointsInsideWhereTheMotionIsCurved() {
        const auto curveOf = [](int steps, double step) {
            Scene scene = readScene(findPreset("harmonic-oscillator")->json).scene;
            scene.schemes.resize(1);
            scene.schemes[0].step = {step, {}};
            scene.end = {steps * step, {}};
            scene.reference.kind = ReferenceSpec::Kind::none;
            scene.observe = {"energy"};
            scene.views = {{"phase", "", ""}};
            const Comparison c = run(scene);
            const DenseOutput* dense = c.schemes.at(0)->products.find<DenseOutput>();
            return dense ? dense->points : Trajectory{};
        };
        // Six steps per period, whose chords would be a hexagon; sixty, whose chords are a circle.
        const Trajectory coarse = curveOf(1000, 1);
        QCOMPARE(coarse.rows(), std::size_t(4 * 1000 + 1));
        const auto q = coarse["q.x"], p = coarse["p.x"];
        double longest = 0;
        for (std::size_t i = 1; i < q.size(); ++i)
            longest = std::max(longest, std::hypot(q[i] - q[i - 1], p[i] - p[i - 1]));
        QVERIFY2(longest < 0.3, qPrintable(QString::number(longest)));  // .250 on the circle; 1 along chords
        const std::size_t fine = curveOf(1000, 0.1).rows();
        QVERIFY2(fine >= 1001 && fine < 1100, qPrintable(QString::number(fine)));  // the range grows at first
        QCOMPARE(curveOf(4001, 1).rows(), std::size_t(0));
    }
    void oscillationsInsideAStepAreResolvedOrFillTheirBand() {
        const auto curveOf = [](const char* k, const char* step) {
            const std::string text =
                std::string(R"({"extremal":1,"model":{"type":"spring-pendulum","k":)") + k +
                R"_(},"initial":{"q":["0.05*sqrt(1e4/k)",1],"p":[0,0]},"time":{"end":2},"schemes":[{"step":)_" +
                step +
                R"(,"scheme":"multiscale-r2"}],"reference":"none","observe":["energy"],"views":["trajectory"]})";
            return run(readScene(std::string_view(text)).scene)
                .schemes.at(0)
                ->products.find<DenseOutput>()
                ->points;
        };
        // 15.9 periods per step, 16 points each: as many zeros as the spring has, two per period.
        const Trajectory resolved = curveOf("1e6", "0.1");
        const auto zeros = [](const Trajectory& curve) {
            const auto a = curve["q.a"];
            int count = 0;
            for (std::size_t i = 1; i < a.size(); ++i) count += (a[i - 1] < 0) != (a[i] < 0);
            return count;
        };
        QVERIFY(std::abs(zeros(resolved) - 2 * 2 * 1000 / (2 * M_PI)) < 5);
        // At k = 1e10 this step has exactly 1000 periods, which so few points cannot resolve. With 40 of them
        // at equal distances the spring would stand still; at unequal ones it fills its band in every step.
        const Trajectory band = curveOf("1e10", "0.06283185307179587");
        QVERIFY(band.rows() < 2500);
        const auto a = band["q.a"];
        const std::size_t perStep = 40;
        for (std::size_t first = 1; first + perStep <= a.size(); first += perStep) {
            std::array<int, 4> quarter{};
            for (std::size_t i = first; i < first + perStep; ++i)
                ++quarter[static_cast<std::size_t>(
                    std::clamp(static_cast<int>((a[i] / 5e-5 + 1) * 2), 0, 3))];
            QVERIFY(*std::min_element(quarter.begin(), quarter.end()) > 2);
        }
        qInfo("%d zeros in %d points", zeros(band), static_cast<int>(band.rows()));
        const auto t = band["t"];
        QVERIFY(std::is_sorted(t.begin(), t.end()) && std::adjacent_find(t.begin(), t.end()) == t.end());
    }
    void plotsAreDrawnAlongIt() {
        const Scene scene = kepler("galerkin-gauss-4", 0.5, 6);
        const Comparison c = run(scene);
        const Figure f = makeFigure(c, {"trajectory", "", ""});
        QCOMPARE(f.series()[0].x.size(), c.schemes[0]->products.find<DenseOutput>()->points.rows());
        QVERIFY(f.series()[0].x.size() > 10 * c.schemes[0]->trajectory.rows());
        QCOMPARE(f.series()[0].t.size(), f.series()[0].x.size());
    }
    void errorsAlongTheCurveAreShownBesideThoseAtNodes() {
        Scene scene = kepler("galerkin-gauss-4", 0.1, 0.5);  // before phase errors grow
        scene.observe = {"error"};
        scene.views = {{"curve-error", "", ""}};
        const Comparison c = run(scene);
        const std::span<const double> error = c.schemes[0]->products.find<DenseOutput>()->points["error"];
        QCOMPARE(error.size(), c.schemes[0]->products.find<DenseOutput>()->points.rows());
        const double most = *std::max_element(error.begin(), error.end());
        qInfo("largest on the curve %.2e, at nodes %.2e", most, c.schemes[0]->summary.maxError);
        QVERIFY(most >
                3 * c.schemes[0]->summary.maxError);  // order 5 between nodes of order 8: measured 76 times
        const Figure f = makeFigure(c, scene.views[0]);
        QCOMPARE(f.series().size(), std::size_t(1));
        QVERIFY(f.subtitle.starts_with("largest on the curve"));
        scene.views = {{"phase", "", ""}};
        QVERIFY(
            !run(scene).schemes[0]->products.find<DenseOutput>()->points.find("error"));  // no view shows it
    }
    void eventsAreFoundOnTheCurve() {
        // Kepler's orbit passes y = 0 upwards at every multiple of its period.
        const double period = 2 * std::numbers::pi;
        std::vector<double> worst, ofChords;
        for (const double h : {0.2, 0.1, 0.05}) {
            Scene scene = kepler("galerkin-gauss-3", h, 33);
            scene.views = {{"section", "", "", "q.y"}};
            const Comparison c = run(scene);
            const Trajectory& events = c.schemes[0]->products.find<Sections>()->all.at(0).events;
            QCOMPARE(events.rows(), std::size_t(5));
            double w = 0, chord = 0;
            const Trajectory& nodes = c.schemes[0]->trajectory;
            for (std::size_t k = 0; k < events.rows(); ++k) {
                QVERIFY(std::abs(events["q.y"][k]) < 1e-13);
                w = std::max(w, std::abs(events["t"][k] - static_cast<double>(k + 1) * period));
            }
            std::size_t found = 0;
            for (std::size_t i = 0; i + 1 < nodes.rows(); ++i) {
                const double a = nodes["q.y"][i], b = nodes["q.y"][i + 1];
                if (!(a < 0 && b >= 0)) continue;
                chord = std::max(
                    chord, std::abs(nodes["t"][i] + a / (a - b) * h - static_cast<double>(++found) * period));
            }
            worst.push_back(w);
            ofChords.push_back(chord);
        }
        const double order = std::log2(worst[1] / worst[2]);
        qInfo("times off by %.2e, %.2e, order %.2f; by chords %.2e, %.2e", worst[1], worst[2], order,
              ofChords[1], ofChords[2]);
        QVERIFY(order > 3.5 && worst[2] < 1e-5);
        QVERIFY(ofChords[2] > 10 * worst[2]);
    }
    void sectionsThatNoMotionPassesAreEmpty() {
        Scene scene = kepler("midpoint", 0.1, 2);
        scene.views = {{"section", "", "", "q.y"}};  // y grows from zero: at the start it does not pass
        const Comparison c = run(scene);
        QCOMPARE(c.schemes[0]->products.find<Sections>()->all.at(0).events.rows(), std::size_t(0));
        QVERIFY(!makeFigure(c, scene.views[0]).message.empty());
    }
    void columnsOfSectionsAreChecked() {
        const auto read = [](const std::string& view) {
            return readScene(std::string_view(
                R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":1},)"
                R"("schemes":[{"step":0.1,"scheme":"midpoint"}],"views":[)" +
                view + "]}"));
        };
        QVERIFY(read(R"({"view":"section","at":"q.y","x":"t","y":"p.y"})").errors.empty());
        QCOMPARE(read(R"({"view":"section","at":"q.z"})").errors.at(0).pointer, std::string("/views/0/at"));
        QCOMPARE(read(R"({"view":"section","at":"t"})").errors.at(0).pointer, std::string("/views/0/at"));
        QCOMPARE(read(R"({"view":"phase","at":"q.y"})").errors.at(0).pointer, std::string("/views/0/at"));
        const Scene scene = read(R"({"view":"section","at":"q.y"})").scene;
        QCOMPARE(readScene(std::string_view(writeScene(scene))).scene.views, scene.views);
    }
    void longRunsKeepTheirRowsAlone() {
        const Comparison c = run(kepler("midpoint", 0.001, 6));
        QVERIFY(!c.schemes[0]->products.find<DenseOutput>());
    }
    void nodesOfTheCurveAreThoseOfTheRun() {
        const Comparison c = run(kepler("galerkin-lobatto-3", 0.25, 6));
        const Trajectory& curve = c.schemes[0]->products.find<DenseOutput>()->points;
        const Trajectory& rows = c.schemes[0]->trajectory;
        const std::size_t points = (curve.rows() - 1) / (rows.rows() - 1);
        for (std::size_t i = 0; i < rows.rows(); ++i) QCOMPARE(curve["q.x"][i * points], rows["q.x"][i]);
    }
};

EXTREMAL_TEST(CurveTest)
}  // namespace extremal::curve_test

#include "curve_test.moc"
