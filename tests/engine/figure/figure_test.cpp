// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/figure.hpp"

#include <QTest>
#include <array>
#include <cmath>
#include <stdexcept>

#include "engine/figure/build.hpp"
#include "engine/figure/image/digest.hpp"
#include "engine/figure/range.hpp"
#include "engine/figure/sample.hpp"
#include "engine/view/catalog.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/tools/test.hpp"

namespace extremal::figure_test {

namespace {
Figure energyFigure(const Comparison& comparison) {
    const System system = handmade::pendulum();
    return makeFigure(comparison, {"energy", "", ""}, &system);
}
}  // namespace

class FigureTest : public QObject {
    Q_OBJECT
private slots:
    void axesCarrySymbolsAndUnits() {
        const Comparison comparison = handmade::comparison();
        const System pendulum = handmade::pendulum(), kepler = handmade::kepler();
        const auto titles = [&](const char* id, const System& system) {
            const Figure f = makeFigure(comparison, {id, "", ""}, &system);
            return f.x.title + " | " + f.y.title;
        };
        QCOMPARE(titles("energy", pendulum), "t  [s] | |H − H(0)|  [J]");
        QCOMPARE(titles("error", pendulum), "t  [s] | |θ − θ_ref|  [rad]");
        QCOMPARE(titles("momentum", kepler), "t  [s] | |L − L(0)|");
        QCOMPARE(titles("trajectory", pendulum), "t  [s] | θ  [rad]");
        QCOMPARE(titles("trajectory", kepler), "x | y");
        QCOMPARE(titles("phase", pendulum), "θ  [rad] | p  [kg m²/s]");
        QCOMPARE(titles("step", pendulum), "t  [s] | h  [s]");
        QCOMPARE(titles("work-precision", pendulum), "CPU time  [s] | max error in θ  [rad]");
    }
    /// Titles of cards are plain texts: no marks of lowered parts in them.
    void titlesOfColumnsAreWords() {
        const Comparison comparison = handmade::comparison();
        const System pendulum = handmade::pendulum();
        const auto title = [&](const char* y) {
            return makeFigure(comparison, {"trajectory", "", y}, &pendulum).title;
        };
        QCOMPARE(title("q.theta"), "Angle");
        QCOMPARE(title("error.theta"), "Error: angle");
        QCOMPARE(title("one_two"), "one two");
    }
    void zerosAndInfinitiesAreGapsAndCounted() {
        const Figure f = energyFigure(handmade::comparison());
        QCOMPARE(f.series().size(), std::size_t{5});
        QCOMPARE(f.series()[0].hidden, 1);  // the error at t = 0 is zero
        QVERIFY(std::isnan(f.series()[0].y[0]));
        QCOMPARE(f.series()[4].hidden, 2);  // and the last value is infinite
        QVERIFY(std::isnan(f.series()[4].y.back()));
        for (const Series& s : f.series())
            for (double v : s.y) QVERIFY(std::isnan(v) || v > 0);
    }
    void driftIsSeen() {
        QCOMPARE(energyFigure(handmade::comparison()).subtitle, "no drift: 3 of 5, drift: 1, failed: 1");
    }
    void blowUpDoesNotFlattenTheOthers() {
        const Figure f = energyFigure(handmade::comparison());
        const auto [low, high] = *f.y.range;
        QVERIFY2(high < 1e4, qPrintable(QString::number(high)));  // the failed scheme reaches 1e28
        QVERIFY(high > 0.09);                                     // RK4 reaches 0.09
        QVERIFY(low > 1e-10 && low < 1e-7);  // sign changes of 2e-7 |sin| reach below 1e-10
        QCOMPARE(*f.x.range, (std::pair<double, double>{0, 10}));
    }
    void rangesAreUsableForAnyData() {
        const double inf = std::numeric_limits<double>::infinity();
        const std::vector<std::vector<double>> cases = {{},
                                                        {0},
                                                        {1},
                                                        {-1, -1},
                                                        {inf, -inf, std::nan("")},
                                                        {1e300, 1},
                                                        {-1e300, 1e300},
                                                        {1e-300},
                                                        {0, 0, 5e-324},
                                                        {1e279, -1e279}};
        for (const auto& values : cases)
            for (bool isLog : {false, true})
                for (bool hasFailed : {false, true}) {
                    const auto [low, high] = fitRange({{values, hasFailed}}, isLog);
                    QVERIFY(std::isfinite(low) && std::isfinite(high) && low < high && (!isLog || low > 0));
                }
    }
    void failuresAreMarkedWithTimeAndCause() {
        const Figure f = energyFigure(handmade::comparison());
        QCOMPARE(f.all<FailureMark>().size(), std::size_t{1});
        QCOMPARE(f.all<FailureMark>()[0].text, "not finite at t = 0.31 s");
        QCOMPARE(f.all<FailureMark>()[0].style, 4);
        QVERIFY(f.summary.find("Störmer-Verlet not finite at t = 0.31 s") != std::string::npos);
    }
    void unresolvedErrorsAreMarked() {
        Comparison c = handmade::comparison();
        const System system = handmade::pendulum();
        Figure f = makeFigure(c, {"error", "", ""}, &system);
        QCOMPARE(floorOf(f), 3e-12);
        QCOMPARE(f.find<DoubtfulBand>()->top, 3e-11);
        QCOMPARE(f.subtitle, "reference: Gauss(12), h = 0.01, good to 3e-12");
        c.reference = {"exact", Summary::unknown, ""};
        f = makeFigure(c, {"error", "", ""}, &system);
        QCOMPARE(f.subtitle, "reference: exact");
        QCOMPARE(floorOf(f), 0x1p-52);  // |q(0)| = 1
        QVERIFY(!f.find<DoubtfulBand>());
    }
    void energyFloorIsRelativeToTheEnergy() {
        QCOMPARE(floorOf(energyFigure(handmade::comparison())), 4 * 0x1p-52);  // H(0) = -4
    }
    void costPlotHasOnePointPerFinishedScheme() {
        const Figure f = makeFigure(handmade::comparison(), {"work-precision", "", ""}, nullptr);
        QCOMPARE(f.series().size(), std::size_t{4});
        for (const Series& s : f.series()) QVERIFY(s.x.size() == 1 && s.kind == SeriesKind::marks);
        QVERIFY(f.x.isLog && f.y.isLog);
    }
    /// Without a reference, where forces work: the balance, and not the change of the energy.
    void costsAreHeldAgainstTheBalance() {
        Comparison c = handmade::comparison();
        double value = 1e-6;
        for (auto& scheme : c.schemes) {
            auto changed = std::make_shared<SchemeResult>(*scheme);
            changed->summary.maxError = changed->summary.maxEnergyError = Summary::unknown;
            changed->summary.extremes.push_back({"balance", "balance", value});
            value *= 10;
            scheme = std::move(changed);
        }
        const Figure f = makeFigure(c, {"work-precision", "", ""}, nullptr);
        QVERIFY2(f.y.title.starts_with("max |H − H(0) − W|"), f.y.title.c_str());
        QCOMPARE(f.series().front().y, std::vector<double>{1e-6});
    }
    void fixedStepsNeedNoColumn() {
        const Figure f = makeFigure(handmade::comparison(), {"step", "", ""}, nullptr);
        QCOMPARE(f.series()[1].y, (std::vector<double>{0.02, 0.02}));
    }
    void orbitsHaveEqualScales() {
        const System kepler = handmade::kepler(), pendulum = handmade::pendulum();
        const Comparison c = handmade::comparison();
        QVERIFY(makeFigure(c, {"trajectory", "", ""}, &kepler).aspect == Aspect::equal);
        QVERIFY(makeFigure(c, {"trajectory", "", ""}, &pendulum).aspect == Aspect::free);
        const Figure other = makeFigure(c, {"phase", "p.theta", "q.theta"}, &pendulum);
        QCOMPARE(other.y.title, "θ  [rad]");
        QVERIFY(other.series()[0].kind == SeriesKind::curve);
    }
    void emptyComparisonsSayWhatIsMissing() {
        Comparison c;
        c.scene.end.value = 1;
        for (const CatalogItem& item : viewCatalog()) {
            if (item.id == "stage") continue;
            const Figure f = makeFigure(c, {item.id, "", ""}, nullptr);
            QVERIFY2(!f.message.empty() && !f.title.empty() && f.y.range, item.id.c_str());
        }
        QCOMPARE(makeFigure(c, {"energy", "", ""}, nullptr).message, "The scene does not observe \"energy\"");
        QVERIFY_THROWS_EXCEPTION(std::invalid_argument, makeFigure(c, {"stage", "", ""}, nullptr));
        QVERIFY_THROWS_EXCEPTION(std::invalid_argument, makeFigure(c, {"enrgy", "", ""}, nullptr));
    }
    void defaultViewsFollowWhatIsObserved() {
        Scene scene;
        scene.observe = {"energy"};
        std::vector<std::string> ids;
        for (const View& v : plotViews(scene)) ids.push_back(v.id);
        QCOMPARE(ids, (std::vector<std::string>{"work-precision", "energy", "trajectory", "phase"}));
        scene.views = {{"stage", "", ""}, {"phase", "q.x", "p.y"}};
        QCOMPARE(plotViews(scene), (std::vector<View>{{"phase", "q.x", "p.y"}}));
    }
    void layersOfAKindKeepTheirOrder() {
        Figure f;
        QVERIFY(isEmpty(f) && f.series().empty() && !f.heat() && floorOf(f) == 0);
        f.add(Guide{{0, 1}, {0, 1}});
        for (const char* label : {"a", "b", "c"}) {
            Series s;
            s.label = label;
            f.add(std::move(s));
            f.add(Label{0, 0, label});
        }
        f.put(RoundOffFloor{1e-16});
        f.put(RoundOffFloor{2e-16});  // the only one of its kind
        QCOMPARE(f.layers.size(), std::size_t{8});
        QCOMPARE(floorOf(f), 2e-16);
        std::string order;
        for (const Series& s : std::as_const(f).series()) order += s.label;
        QCOMPARE(order, std::string("abc"));
        QCOMPARE(f.series().at(1).label, std::string("b"));
        QVERIFY_THROWS_EXCEPTION(std::out_of_range, f.series().at(3));
        f.series()[1].label = "d";
        QCOMPARE(f.series().back().label + f.series()[1].label, std::string("cd"));
        f.drop<Label>();
        QCOMPARE(f.layers.size(), std::size_t{5});
        QVERIFY(!isEmpty(f));
        f.drop<Series>();
        QVERIFY(isEmpty(f));  // guides and a floor are no data
    }
    void digestSeesNineDigitsAndNotMore() {
        const Comparison c = handmade::comparison();
        Figure a = energyFigure(c), b = a, d = a;
        for (double& v : b.series()[1].y) v *= 1 + 1e-14;
        for (double& v : d.series()[1].y) v *= 1 + 1e-7;
        QCOMPARE(digest(a), digest(b));
        QVERIFY(digest(a) != digest(d));
        d = a;
        d.series()[1].style = 2;
        QVERIFY(digest(a) != digest(d));
    }
    void numbersAreShort() {
        QCOMPARE(shortNumber(3.21e-7), "3.2e-7");
        QCOMPARE(shortNumber(0.31, 3), "0.31");
        QCOMPARE(shortNumber(1200), "1200");
        QCOMPARE(shortNumber(1e7), "1e7");
        QCOMPARE(shortNumber(0), "0");
        QCOMPARE(axisTitle("H - H(0)", "J"), "H − H(0)  [J]");
    }
    void rowsManyStepsApartAreNotJoined() {
        // A circle, sampled at each 30th of its turns and at each 0.7th of them.
        const auto figure = [](const char* view, double turns, double nodesApart) {
            Comparison comparison = handmade::comparison();
            SchemeResult result = *comparison.schemes[0];
            result.trajectory = {};
            for (const char* name : {"t", "q.x", "q.y", "p.x"}) {
                Column column;
                column.name = column.symbol = name;
                result.trajectory.columns.push_back(std::move(column));
            }
            for (int i = 0; i < 500; ++i) {
                const double a = 2 * M_PI * turns * i;
                const std::array<double, 4> row{0.1 * i, std::cos(a), std::sin(a), -std::sin(a)};
                for (std::size_t c = 0; c < 4; ++c) result.trajectory.columns[c].values.push_back(row[c]);
                result.trajectory.nodes.push_back(nodesApart * i);
            }
            result.products = {};
            comparison.schemes = {std::make_shared<const SchemeResult>(result)};
            const System kepler = handmade::kepler();
            return makeFigure(comparison, {view, "", ""}, &kepler);
        };
        for (const char* view : {"trajectory", "phase"}) {
            QVERIFY(!figure(view, 1.0 / 30, 500).series()[0].isSparse);
            QVERIFY(figure(view, 0.7, 500).series()[0].isSparse);
            QVERIFY(!figure(view, 0.7, 1).series()[0].isSparse);  // these are the steps themselves
        }
        // Between samples that are not joined the nearer one counts.
        const Figure orbit = figure("trajectory", 0.7, 500);
        const Series& samples = orbit.series()[0];
        const auto point = pointAt(samples, 0.1 * 20 + 0.02);
        QVERIFY(point && *point == std::pair(samples.x[20], samples.y[20]));
    }
};

EXTREMAL_TEST(FigureTest)
}  // namespace extremal::figure_test

#include "figure_test.moc"
