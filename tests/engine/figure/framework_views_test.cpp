// SPDX-License-Identifier: GPL-3.0-or-later
/// The views of the equations themselves: the pattern of the KKT matrix, the defect of the discrete
/// Lagrangian.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::framework_views_test {
namespace {

ReadScene pendulum(const std::string& views, const std::string& schemes) {
    const std::string text =
        R"({"extremal":1,"model":{"type":"pendulum"},"initial":{"q":[1],"p":[0.7]},"time":{"end":1},)"
        R"("schemes":[)" +
        schemes + R"(],"views":)" + views + "}";
    return readScene(std::string_view(text));
}
const std::string gauss2 = R"({"label":"nodal","step":0.1,"scheme":"galerkin-gauss-2"})";
const std::string modal =
    R"({"label":"modal","step":0.1,"space":{"type":"polynomial","degree":2,"basis":"legendre"},"quadrature":"gauss"})";
const std::string rk4 = R"({"label":"rk4","step":0.1,"baseline":"rk4"})";

}  // namespace

class FrameworkViewsTest : public QObject {
    Q_OBJECT
private slots:
    void onePictureForEachPair() {
        const Scene scene = pendulum(R"(["sparsity"])", gauss2 + "," + rk4 + "," + modal).scene;
        const std::vector<View> views = plotViews(scene);
        QCOMPARE(views.size(), std::size_t(2));
        QCOMPARE(views[0].scheme, std::string("nodal"));
        QCOMPARE(views[1].scheme, std::string("modal"));
    }
    void cellsAreTheEntries() {
        const Scene scene = pendulum(R"(["sparsity"])", gauss2 + "," + modal).scene;
        const Comparison c = run(scene);
        for (std::size_t i = 0; i < 2; ++i) {
            const KktPattern& p = *c.schemes[i]->products.find<KktPattern>();
            const Figure f = makeFigure(c, plotViews(scene)[i]);
            QCOMPARE(f.series().size(), std::size_t(2));
            QCOMPARE(f.series()[0].x.size(), p.action.size());
            QCOMPARE(f.series()[1].x.size(), p.continuity.size());
            QVERIFY(f.series()[0].kind == SeriesKind::cells && f.series()[0].tone == Tone::full &&
                    f.series()[1].tone == Tone::pale);
            QCOMPARE(f.x.ticks.size(), p.blocks.size());
            // Rows grow downwards: row r of the matrix is at size - 1 - r.
            QCOMPARE(f.series()[0].y[0], static_cast<double>(p.size - 1 - p.action[0].first));
        }
        // Four elements of three functions, five multipliers; modes reach both ends of an element with all of
        // their functions.
        QCOMPARE(c.schemes[0]->products.find<KktPattern>()->size, 17);
        QCOMPARE(c.schemes[0]->products.find<KktPattern>()->continuity.size(), std::size_t(16));
        QCOMPARE(c.schemes[1]->products.find<KktPattern>()->continuity.size(), std::size_t(48));
    }
    void everySchemeWithoutOneSaysWhy() {
        const std::string off = R"({"label":"off","enabled":false,"step":0.1,"scheme":"galerkin-gauss-2"})",
                          fast = R"({"label":"fast","step":0.1,"space":{"type":"oscillatory","omega":3,)"
                                 R"("degree":2,"harmonics":[1]}})",
                          composed =
                              R"({"label":"Y","step":0.1,"scheme":"midpoint","composition":"yoshida"})";
        const ReadScene read =
            pendulum(R"(["sparsity","discrete-lagrangian",{"view":"sparsity","scheme":"Y"}])",
                     off + "," + rk4 + "," + fast + "," + composed);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Comparison c = run(read.scene);
        const std::string reasons =
            "rk4: a baseline, which no discrete action defines; fast: made of functions that change with the "
            "step, not of one table; Y: a composition, whose step is several elements";
        const std::vector<View> views = plotViews(c.scene);
        QCOMPARE(makeFigure(c, views.at(0)).message, "No matrix of equations: " + reasons);
        QCOMPARE(makeFigure(c, views.at(1)).message, "No discrete Lagrangian: " + reasons);
        QCOMPARE(makeFigure(c, views.at(2)).message,
                 std::string("No matrix of equations: Y: a composition, whose step is several elements"));
        for (const View& v : views) QVERIFY(isEmpty(makeFigure(c, v)));
    }
    void nothingIsComputedThatNoViewShows() {
        const Comparison c = run(pendulum(R"(["energy"])", gauss2).scene);
        QCOMPARE(c.schemes[0]->products.size(), std::size_t(0));
    }
    void slopesStandInTheSubtitle() {
        const Scene scene = pendulum(R"(["discrete-lagrangian"])", gauss2 + "," + rk4 + "," + modal).scene;
        const Comparison c = run(scene);
        const Figure f = makeFigure(c, plotViews(scene)[0]);
        QCOMPARE(f.series().size(), std::size_t(2));
        QCOMPARE(f.subtitle,
                 std::string("slope 4.98 of 5, 4.98 of 5 · none of rk4: a baseline, which no discrete "
                             "action defines"));
        // The same action, whatever the basis: to the round-off of the action.
        for (std::size_t i = 0; i < 6; ++i)
            QVERIFY(std::abs(f.series()[0].y[i] / f.series()[1].y[i] - 1) < 1e-6);
    }
    void labelsOfOtherSchemesAreErrors() {
        const ReadScene wrong = pendulum(R"([{"view":"sparsity","scheme":"nodl"}])", gauss2);
        QCOMPARE(wrong.errors.size(), std::size_t(1));
        QCOMPARE(wrong.errors[0].pointer, std::string("/views/0/scheme"));
        QVERIFY(wrong.errors[0].message.find("nodal") != std::string::npos ||
                wrong.errors[0].hint.find("nodal") != std::string::npos);
        QCOMPARE(pendulum(R"([{"view":"energy","scheme":"nodal"}])", gauss2).errors.size(), std::size_t(1));
        const ReadScene right = pendulum(R"([{"view":"sparsity","scheme":"nodal"}])", gauss2);
        QVERIFY(right.errors.empty());
        QCOMPARE(readScene(std::string_view(writeScene(right.scene))).scene.views, right.scene.views);
    }
};

EXTREMAL_TEST(FrameworkViewsTest)
}  // namespace extremal::framework_views_test

#include "framework_views_test.moc"
