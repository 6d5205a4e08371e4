// SPDX-License-Identifier: GPL-3.0-or-later
/// What runs of rigid bodies write beside the state, against what it should be: angle of the attitude error,
/// Casimir, orthogonality with and without projection, momenta.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::body_observables_test {
namespace {

Comparison runOf(const std::string& model, const std::string& schemes, const std::string& observe) {
    const std::string text =
        R"({"extremal": 1, "title": "body", "model": )" + model +
        R"(, "initial": {"attitude": [0.5, 0.5, -0.5, 0.5], "momentum": [0.45, 0.1, 0.9]},
        "time": {"end": 50}, "schemes": [)" +
        schemes + R"(], "observe": [)" + observe + "]}";
    return run(readScene(text).scene);
}
double largest(std::span<const double> values) {
    double worst = 0;
    for (const double v : values) worst = std::max(worst, std::abs(v));
    return worst;
}
double spread(std::span<const double> values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

const char* const freeModel = R"({"type": "rigid-body", "inertia": [1, 2, 3]})";
const char* const topModel =
    R"({"type": "heavy-top", "inertia": [1, 1, 0.5], "weight": 1, "centre": [0.3, 0, 1]})";

}  // namespace

class BodyObservablesTest : public QObject {
    Q_OBJECT
private slots:
    void projectionKeepsTheQuaternionAtLengthOne() {
        const Comparison c = runOf(freeModel, R"(
            {"label": "lie", "step": 0.1, "scheme": "lie-2"},
            {"label": "rk4 projected", "step": 0.1, "baseline": {"type": "rk4-quaternion", "projection": true}},
            {"label": "rk4", "step": 0.1, "baseline": {"type": "rk4-quaternion", "projection": false}},
            {"label": "dopri projected", "tolerance": 1e-6, "baseline": {"type": "dopri5-quaternion", "projection": true}},
            {"label": "dopri", "tolerance": 1e-6, "baseline": {"type": "dopri5-quaternion", "projection": false}})",
                                   R"("orthogonality", "error")");
        QCOMPARE(c.schemes.size(), std::size_t(5));
        for (const auto& scheme : c.schemes) {
            const double defect = largest(scheme->trajectory["orthogonality"]);
            qInfo("%s: |R^T R - 1| = %.1e, error %.1e", scheme->spec.label.c_str(), defect,
                  largest(scheme->trajectory["error"]));
            const bool isKept =
                scheme->spec.label.find("projected") != std::string::npos || scheme->spec.label == "lie";
            if (isKept)
                QVERIFY(defect < 4e-15);
            else
                QVERIFY(defect > 1e-9);
        }
    }
    void theErrorIsTheAngleToTheExactAttitude() {
        const Comparison c = runOf(freeModel, R"({"step": 0.5, "scheme": "lie-1"})", R"("error")");
        const Trajectory& t = c.schemes[0]->trajectory;
        const System system = standard().system();
        const ExactSolution exact = system.exact(bodyState({0.45, 0.1, 0.9}, {0.5, 0.5, -0.5, 0.5}));
        double worst = 0;
        std::vector<double> x(10), now(10);
        for (std::size_t row = 0; row < t.rows(); ++row) {
            exact(t["t"][row], x);
            for (std::size_t k = 0; k < 10; ++k) now[k] = t.columns[k + 1].values[row];
            worst = std::max(worst, std::abs(t["error"][row] - attitudeError(now, {x[0], x[1], x[2], x[3]})));
            worst = std::max(worst, std::abs(t["error.p"][row] - momentumError(now, {x[4], x[5], x[6]})));
        }
        qInfo("difference %.1e, largest error %.2e", worst, largest(t["error"]));
        QVERIFY(worst < 1e-12);
        QVERIFY(largest(t["error"]) > 0.01);
    }
    void casimirsAreKeptByWhatTurnsTheMomentum() {
        for (const char* model : {freeModel, topModel}) {
            const bool isTop = model == topModel;
            const Comparison c = runOf(model, R"(
                {"label": "lie", "step": 0.1, "scheme": "lie-2"},
                {"label": "splitting", "step": 0.1, "baseline": "rigid-splitting"},
                {"label": "rk4", "step": 0.1, "baseline": "rk4-quaternion"})",
                                       R"("casimir", "momentum", "energy")");
            for (const auto& scheme : c.schemes) {
                const Trajectory& t = scheme->trajectory;
                const double change = spread(t["casimir"]), momentum = largest(t["momentum_error"]);
                qInfo("%s, %s: Casimir changes by %.1e, momentum by %.1e", isTop ? "top" : "free",
                      scheme->spec.label.c_str(), change, momentum);
                const double start = isTop ? 0 : 0.45 * 0.45 + 0.1 * 0.1 + 0.9 * 0.9;
                if (!isTop) QVERIFY(std::abs(t["casimir"][0] - start) < 1e-15);
                // A top's is the vertical momentum, computed in the body.
                if (isTop && scheme->spec.label != "rk4")
                    QVERIFY(std::abs(t["casimir"][0] - t["momentum.space.z"][0]) < 1e-15);
                if (scheme->spec.label == "rk4")
                    QVERIFY(change > 1e-9 && momentum > 1e-9);  // free: 5.7e-9 and 4.6e-8
                else
                    QVERIFY(change < 1e-13 && momentum < 1e-13);  // at most 1e-14
            }
        }
    }
};

EXTREMAL_TEST(BodyObservablesTest)
}  // namespace extremal::laws::body_observables_test

#include "body_observables_test.moc"
