/// Between the nodes plots follow the scheme's own curve, not a chord.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/codec.hpp"

namespace extremal {
namespace {

Scene kepler(const std::string& scheme, double step, double end) {
    const std::string text = R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":)" +
                             std::to_string(end) + R"(},"schemes":[{"label":"s","step":)" + std::to_string(step) +
                             ",\"scheme\":\"" + scheme + "\"}]}";
    return readScene(std::string_view(text)).scene;
}

/// Largest distance from the exact orbit: along what plots are drawn through, and along straight lines between nodes.
struct Off {
    double curve = 0, chord = 0;
};
Off offOrbit(const std::string& scheme, double step) {
    const Scene scene = kepler(scheme, step, 6);
    const System system = makeSystem(scene);
    const auto exact = system.exact(initialState(scene, system));
    const Comparison c = run(scene);
    const Trajectory& curve = c.schemes[0]->curve;
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
        const double order = std::log2(coarse.curve / fine.curve), ofChords = std::log2(coarse.chord / fine.chord);
        qInfo("curve %.2e, order %.2f; chords %.2e, order %.2f", fine.curve, order, fine.chord, ofChords);
        QVERIFY(order > 4.5 && order < 5.8);
        QVERIFY(ofChords < 2.5 && fine.chord > 100 * fine.curve);
    }
    void plotsAreDrawnAlongIt() {
        const Scene scene = kepler("galerkin-gauss-4", 0.5, 6);
        const Comparison c = run(scene);
        const Figure f = makeFigure(c, {"trajectory", "", ""});
        QCOMPARE(f.series[0].x.size(), c.schemes[0]->curve.rows());
        QVERIFY(f.series[0].x.size() > 10 * c.schemes[0]->trajectory.rows());
        QCOMPARE(f.series[0].t.size(), f.series[0].x.size());
    }
    void longRunsKeepTheirRowsAlone() {
        const Comparison c = run(kepler("midpoint", 0.01, 6));
        QCOMPARE(c.schemes[0]->curve.rows(), std::size_t(0));
    }
    void nodesOfTheCurveAreThoseOfTheRun() {
        const Comparison c = run(kepler("galerkin-lobatto-3", 0.25, 6));
        const Trajectory& curve = c.schemes[0]->curve;
        const Trajectory& rows = c.schemes[0]->trajectory;
        const std::size_t points = (curve.rows() - 1) / (rows.rows() - 1);
        for (std::size_t i = 0; i < rows.rows(); ++i) QCOMPARE(curve["q.x"][i * points], rows["q.x"][i]);
    }
};

}  // namespace extremal

QTEST_APPLESS_MAIN(extremal::CurveTest)
#include "curve_test.moc"
