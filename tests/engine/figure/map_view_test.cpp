// SPDX-License-Identifier: GPL-3.0-or-later
/// The view "parameter-map": one scale for all schemes, cells that can be asked, data that can be saved.
#include <QTest>

#include <cmath>

#include "engine/figure/sample.hpp"
#include "tests/engine/figure/hand_made_map.hpp"
#include "tests/tools/test.hpp"

namespace extremal::map_view_test {

class MapViewTest : public QObject {
    Q_OBJECT
private slots:
    void everySchemeHasAPicture() {
        const std::vector<View> views = plotViews(handmade::mapScene());
        QCOMPARE(views.size(), std::size_t(2));
        QCOMPARE(views[0].scheme, std::string("midpoint"));
        QCOMPARE(views[1].scheme, std::string("RK4"));
        QVERIFY(views[0].keys == handmade::mapScene().views[0].keys);
    }
    void allHaveOneScale() {
        const Figure midpoint = handmade::mapFigure("midpoint"), rk4 = handmade::mapFigure("RK4");
        QCOMPARE(midpoint.title, std::string("midpoint"));
        QCOMPARE(midpoint.heat()->low, rk4.heat()->low);
        QCOMPARE(midpoint.heat()->high, rk4.heat()->high);
        // Of the 53 values 1e-10 and 10 are there once: one of the two percent at either end.
        QVERIFY(std::abs(midpoint.heat()->low / 1e-9 - 1) < 1e-9 &&
                std::abs(midpoint.heat()->high - 1) < 1e-9);
        QCOMPARE(midpoint.heat()->scale, std::string("max |H − H(0)|  [J]"));
        QCOMPARE(midpoint.x.title, std::string("k  [N/m]"));
        QCOMPARE(midpoint.y.title, std::string("h  [s]"));
        QVERIFY(midpoint.x.isLog && midpoint.y.isLog);
        QVERIFY2(midpoint.subtitle.find("to t = 1 s · 5 of 30 fail") != std::string::npos,
                 midpoint.subtitle.c_str());
    }
    void theDotIsTheScene() {
        const Figure rk4 = handmade::mapFigure("RK4");
        QCOMPARE(rk4.series().size(), std::size_t(1));
        QCOMPARE(rk4.series()[0].x, std::vector<double>{100});
        QCOMPARE(rk4.series()[0].y, std::vector<double>{0.05});
    }
    void cellsSayWhatTheyAre() {
        const Figure figure = handmade::mapFigure("midpoint");
        // The grid: 1, 10, .. 1e5 and 0.001, 0.00316, .. 0.1; a cell reaches half a ratio to either side.
        const auto cell = cellAt(figure, 1.4e3, 0.0095);
        QVERIFY(cell);
        QCOMPARE(cell->x, 1000.0);
        QCOMPARE(cell->y, 0.01);
        QCOMPARE(cell->text, std::string("k = 1000 N/m, h = 0.01 s\nmax |H − H(0)| = 1e-05 J"));
        QCOMPARE(cellAt(figure, 1e5, 0.1)->text.substr(cellAt(figure, 1e5, 0.1)->text.find('\n') + 1),
                 std::string("blow-up"));
        QVERIFY(cellAt(figure, 1e4, 0.0316)->text.ends_with("diverged"));
        QVERIFY(cellAt(figure, 1e5, 0.01)->text.ends_with("not known"));
        Figure drifting = figure;
        for (std::string& fault : drifting.heat()->faults)
            if (fault.empty()) fault = "drifting";
        QCOMPARE(cellAt(drifting, 1.4e3, 0.0095)->text, cell->text + ", drifting");
        QVERIFY(cellAt(figure, 0.32, 0.01) && !cellAt(figure, 0.31, 0.01));
        QVERIFY(!cellAt(figure, 1e3, 0.2) && !cellAt(Figure(), 1, 1));
    }
    void dataHaveARowForEachCell() {
        Figure figure = handmade::mapFigure("midpoint");
        const std::string all = figureCsv(figure, false);
        QVERIFY2(all.starts_with("k  [N/m],h  [s],max |H − H(0)|  [J],outcome\n1,0.001,1e-10,\n"),
                 all.c_str());
        QCOMPARE(std::count(all.begin(), all.end(), '\n'), std::ptrdiff_t(31));
        QVERIFY(all.find("\n100000,0.1,,blow-up\n") != std::string::npos ||
                all.find("\n1e+05,0.1,,blow-up\n") != std::string::npos);
        figure.x.range = {5, 500};
        const std::string some = figureCsv(figure, true);
        QCOMPARE(std::count(some.begin(), some.end(), '\n'), std::ptrdiff_t(11));
    }
    void whatBlowsUpDoesNotTakeTheScale() {
        Comparison c = handmade::mapComparison();
        auto& maps = c.products.make<ParameterMaps>().all;
        auto wild = std::make_shared<ParameterMap>(*maps[1]);
        wild->cells[29].value = 1e200;
        maps[1] = wild;
        View view = c.scene.views[0];
        const Figure figure = makeFigure(c, view);
        QVERIFY(figure.heat()->high < 100);
    }
};

EXTREMAL_TEST(MapViewTest)
}  // namespace extremal::map_view_test

#include "map_view_test.moc"
