// SPDX-License-Identifier: GPL-3.0-or-later
/// The views of the two scales of a fast oscillation: energies and the adiabatic invariant against time.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::scale_views_test {
namespace {

ReadScene spring(const std::string& model, const std::string& observe) {
    const std::string text = R"({"extremal":1,"model":)" + model +
                             R"(,"initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":5},"schemes":[)"
                             R"({"label":"R2","step":0.2,"scheme":"multiscale-r2"},)"
                             R"({"label":"coarse","step":0.2,"scheme":"galerkin-gauss-2"}],)"
                             R"("reference":"none","observe":)" +
                             observe + R"(,"views":["fast-energy","slow-energy","adiabatic-invariant"]})";
    return readScene(std::string_view(text));
}
const std::string stiff = R"({"type":"spring-pendulum","k":1e6})";
const std::string all = R"(["fast-energy","slow-energy","adiabatic-invariant"])";

bool warnsOf(const ReadScene& read, const std::string& text) {
    return std::any_of(read.warnings.begin(), read.warnings.end(),
                       [&](const Problem& p) { return p.message.find(text) != std::string::npos; });
}

}  // namespace

class ScaleViewsTest : public QObject {
    Q_OBJECT
private slots:
    void everyColumnIsShownAsItIs() {
        const Scene scene = spring(stiff, all).scene;
        const Comparison c = run(scene);
        const std::vector<View> views = plotViews(scene);
        QCOMPARE(views.size(), std::size_t(3));
        for (const View& view : views) {
            std::string column = view.id;
            std::replace(column.begin(), column.end(), '-', '_');
            const Figure f = makeFigure(c, view);
            QCOMPARE(f.series().size(), std::size_t(2));
            QVERIFY(!f.x.isLog && !f.y.isLog && f.x.isTime);
            for (std::size_t i = 0; i < 2; ++i) {
                const auto values = c.schemes[i]->trajectory[column];
                QVERIFY(values.size() == 26 && std::equal(values.begin(), values.end(),
                                                          f.series()[i].y.begin(), f.series()[i].y.end()));
            }
        }
        QCOMPARE(makeFigure(c, views[0]).y.title, std::string("H_fast  [J]"));
        QCOMPARE(makeFigure(c, views[2]).y.title, std::string("H_fast / ω  [J s]"));
    }
    void theSubtitleNamesTheLeastAndTheLargestChange() {
        const Scene scene = spring(stiff, all).scene;
        const Comparison c = run(scene);
        const Figure f = makeFigure(c, plotViews(scene)[2]);
        // The invariant of the true motion changes by 2.6e-5 of itself here; a scheme that loses the spring
        // makes more of it.
        double change[2];
        for (std::size_t i = 0; i < 2; ++i) {
            const auto y = c.schemes[i]->trajectory["adiabatic_invariant"];
            change[i] = 0;
            for (const double v : y) change[i] = std::max(change[i], std::abs(v - y.front()) / y.front());
        }
        qInfo("relative change: %.2g, %.2g; %s", change[0], change[1], f.subtitle.c_str());
        QVERIFY(change[0] < 1e-4 && change[1] > 2 * change[0]);
        QVERIFY(f.subtitle.starts_with("largest relative change: ") &&
                f.subtitle.find("(R2) to ") != std::string::npos && f.subtitle.ends_with("(coarse)"));
    }
    void whatIsNotObservedIsAWarning() {
        const ReadScene read = spring(stiff, R"(["energy"])");
        QVERIFY(read.errors.empty());
        QVERIFY(warnsOf(read, "fast-energy is not observed") &&
                warnsOf(read, "adiabatic-invariant is not observed"));
        const Figure f = makeFigure(run(read.scene), plotViews(read.scene)[0]);
        QCOMPARE(f.message, std::string("The scene does not observe \"fast-energy\""));
        QVERIFY(!warnsOf(spring(stiff, all), "not observed"));
    }
    void aModelWithoutAFastOscillationHasNothingToShow() {
        const ReadScene read = spring(R"({"type":"double-pendulum"})", R"(["energy"])");
        QVERIFY(!read.errors.empty());
        QCOMPARE(read.errors[0].message,
                 std::string("fast-energy is not defined for double-pendulum; remove the view"));
    }
};

EXTREMAL_TEST(ScaleViewsTest)
}  // namespace extremal::scale_views_test

#include "scale_views_test.moc"
