// SPDX-License-Identifier: GPL-3.0-or-later
/// The integral of the one-form over a ring that moves with the scheme: kept by symplectic steps, and lost by
/// schemes of the same order that keep the energy or nothing.
#include <QTest>

#include <cmath>
#include <string>

#include "engine/figure/figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::loop_test {
namespace {

std::vector<double> lossesOf(const std::string& scene) {
    const ReadScene read = readScene(scene);
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    std::vector<double> losses;
    for (const auto& scheme : run(read.scene).schemes) {
        double most = 0;
        for (const double each : scheme->trajectory["loop_error"])
            most = std::max(most, std::isnan(each) ? 1 : std::abs(each));
        losses.push_back(most);
        qInfo("%s: %.2e of %.3e", scheme->spec.label.c_str(), most, scheme->trajectory["loop"][0]);
    }
    return losses;
}

}  // namespace

class LoopTest : public QObject {
    Q_OBJECT
private slots:
    void ofHamiltonsEquations() {
        const auto losses =
            lossesOf(R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1], "p": [0.5]},
            "time": {"end": 20}, "observe": ["loop"], "reference": "none", "schemes": [
            {"scheme": "galerkin-gauss-2", "step": 0.1}, {"baseline": "stormer-verlet", "step": 0.05},
            {"baseline": "rk4", "step": 0.1},
            {"scheme": "galerkin-gauss-1", "step": 0.1, "keep": "energy"}]})");
        QVERIFY(losses[0] < 1e-13 && losses[1] < 1e-13);
        QVERIFY(losses[2] > 1e-8 && losses[3] > 1e-8);
    }
    /// Hénon and Heiles in variables that are not canonical: of the same order, one keeps it.
    void ofOneForms() {
        const auto losses = lossesOf(R"json({"extremal": 1, "model": {"type": "phase-space",
            "variables": ["q1", "q2", "y1", "y2"],
            "one_form": {"q1": "y1*(1 + 0.8*q2) + y2^3/2", "q2": "y2*(1 + 0.6*q1) + 0.4*y1^2"},
            "hamiltonian": "((y1*(1 + 0.8*q2) + y2^3/2)^2 + (y2*(1 + 0.6*q1) + 0.4*y1^2)^2)/2 + (q1^2 + q2^2)/2 + q1^2*q2 - q2^3/3"},
            "initial": {"x": [0.05, -0.2, 0.3, 0.15]}, "time": {"end": 100}, "observe": ["loop"],
            "reference": "none", "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.2},
            {"baseline": {"type": "gauss-collocation", "stages": 2}, "step": 0.2}]})json");
        QVERIFY(losses[0] < 1e-14);
        QVERIFY(losses[1] > 5e-10);
    }
    /// The area of an ellipse: minus pi times its axes.
    void theFirstValueIsTheArea() {
        const ReadScene read = readScene(std::string_view(R"({"extremal": 1, "model": {"type": "pendulum"},
            "initial": {"q": [1], "p": [0.5]}, "time": {"end": 1}, "observe": ["loop"], "reference": "none",
            "schemes": [{"scheme": "midpoint", "step": 0.1}]})"));
        const double area = run(read.scene).schemes.front()->trajectory["loop"][0];
        QVERIFY(std::abs(area + 3.14159265358979323846 * 0.05 * 0.025) < 1e-15);
    }
    /// The view: the ring of each scheme, at rows, over that of the start.
    void theRingIsDrawnAsItMoves() {
        const ReadScene read = readScene(std::string_view(R"({"extremal": 1, "model": {"type": "pendulum"},
            "initial": {"q": [1], "p": [0.5]}, "time": {"end": 20}, "observe": ["loop"], "views": ["ring"],
            "reference": "none", "schemes": [{"label": "G", "scheme": "galerkin-gauss-2", "step": 0.1},
            {"label": "R", "baseline": "rk4", "step": 0.2}, {"label": "A", "baseline": "dopri5",
            "tolerance": 1e-6}]})"));
        QVERIFY(read.errors.empty());
        const Comparison result = run(read.scene);
        QVERIFY(!result.schemes[2]->products.find<MovedRings>());  // its steps are its own
        const Figure figure = makeFigure(result, read.scene.views.front());
        QCOMPARE(figure.series().size(), std::size_t(2));
        QVERIFY(figure.find<Guide>());
        QVERIFY(figure.subtitle.find("(R)") != std::string::npos);
        double kept = 1, others = 0;
        for (const Series& s : figure.series()) {
            QVERIFY(s.moving && s.x == s.moving->moments.back().x && s.x.front() == s.x.back());
            const auto& now = s.moving->at(10.05);
            QVERIFY(std::abs(now.t - 10) < 1e-9);
            // The polygon of 64 points has a share of 1.6e-3 less than its ellipse at the start.
            const auto area = [](const MovingCurve::Moment& of) {
                double sum = 0;
                for (std::size_t i = 1; i < of.x.size(); ++i)
                    sum += (of.x[i - 1] * of.y[i] - of.x[i] * of.y[i - 1]) / 2;
                return sum;
            };
            const double start = area(s.moving->moments.front()),
                         ellipse = 3.14159265358979323846 * 0.05 * 0.025;
            QVERIFY(std::abs(start / ellipse - 1) < 2e-3);
            const double lost = std::abs(area(now) / start - 1);
            qInfo("%s: area %.1e lost", s.label.c_str(), lost);
            (s.label == "G" ? kept : others) = lost;
        }
        QVERIFY(kept < 1e-3 && others > 5e-3);  // 1.5e-4, of the polygon, and 2.1e-2
        // The integral is exact where the polygon is not.
        const auto loops = result.schemes[0]->trajectory["loop"];
        const auto& frames = result.schemes[0]->products.find<MovedRings>()->frames;
        QCOMPARE(frames.size(), loops.size());
        for (std::size_t k = 0; k < frames.size(); ++k) QCOMPARE(frames[k].values->back(), loops[k]);
        const Value summary = summaryValue(result);
        std::string files;
        for (const Value& file : summary.find("files")->asArray()) files += file.asString() + " ";
        QVERIFY(files.find("g.ring.csv") != std::string::npos &&
                files.find("r.ring.csv") != std::string::npos);
        QVERIFY(files.find("a.ring.csv") == std::string::npos);
    }
    void stepsOfTheirOwnHaveNone() {
        const ReadScene read = readScene(std::string_view(R"({"extremal": 1, "model": {"type": "kepler"},
            "initial": {"q": [0.4, 0], "p": [0, 2]}, "time": {"end": 1}, "observe": ["loop"],
            "reference": "none", "schemes": [{"scheme": "midpoint", "step": 0.01, "monitor": "auto"}]})"));
        QVERIFY(read.errors.empty());
        const Comparison result = run(read.scene);
        for (const double each : result.schemes.front()->trajectory["loop"]) QVERIFY(std::isnan(each));
    }
};

EXTREMAL_TEST(LoopTest)
}  // namespace extremal::loop_test
#include "loop_test.moc"
