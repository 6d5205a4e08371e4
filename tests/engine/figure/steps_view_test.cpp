// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors against the number of steps: which step each row is, axes that fit, and what a scene may ask for.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/figure/image/digest.hpp"
#include "engine/figure/sample.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/axes.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/tools/test.hpp"

namespace extremal::steps_view_test {
namespace {

std::string pendulumText(const std::string& scheme, const std::string& end, const std::string& views,
                         const std::string& more = "") {
    return R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [2]}, "time": {"start": 1, "end": )" +
           end + R"(}, "schemes": [{"label": "one", )" + scheme +
           R"(}], "reference": {"type": "none"}, "observe": ["energy"], "views": )" + views + more + "}";
}

Trajectory rowsOf(const std::string& scheme, const std::string& end, const std::string& more = "") {
    return run(readScene(pendulumText(scheme, end, R"(["stage"])", more)).scene).schemes.at(0)->trajectory;
}

}  // namespace

class StepsViewTest : public QObject {
    Q_OBJECT

    static ReadScene sceneWith(const std::string& views) {
        return readScene(pendulumText(R"("step": 0.1, "baseline": "stormer-verlet")", "11", views));
    }

private slots:
    void rowsKnowTheirStepWhereStepsAreEqual() {
        for (const char* every : {"", R"(, "output": {"every": 0.37})"}) {
            const Trajectory rows = rowsOf(R"("step": 0.001, "baseline": "stormer-verlet")", "8", every);
            QVERIFY(rows.rows() > 15 && rows.nodes.size() == rows.rows());
            for (std::size_t r = 0; r < rows.rows(); ++r)
                QCOMPARE(rows.nodes[r], std::round((rows["t"][r] - 1) / 0.001));
        }
    }
    /// The other route: a run that keeps every node says which step ends at a time.
    void rowsKnowTheirStepWhereStepsDiffer() {
        const char* scheme = R"("tolerance": 1e-9, "baseline": "dopri5")";
        const Trajectory all = rowsOf(scheme, "21"),
                         some = rowsOf(scheme, "21", R"(, "output": {"every": 1.3})");
        QVERIFY(all.rows() > 100 && all.rows() < 2000 && some.rows() > 10 && some.rows() < 20);
        std::map<double, double> stepAt;
        for (std::size_t r = 0; r < all.rows(); ++r) {
            QCOMPARE(all.nodes[r], static_cast<double>(r));
            stepAt[all["t"][r]] = static_cast<double>(r);
        }
        for (std::size_t r = 0; r < some.rows(); ++r) {
            QVERIFY(stepAt.count(some["t"][r]) == 1);
            QCOMPARE(some.nodes[r], stepAt.at(some["t"][r]));
        }
        const double mean =
            (some["t"].back() - 1) / some.nodes.back();  // as if they were equal: several rows are others
        int wrong = 0;
        for (std::size_t r = 0; r < some.rows(); ++r)
            wrong += some.nodes[r] != std::round((some["t"][r] - 1) / mean);
        QVERIFY(wrong > 3);
    }
    void rowsLeftOutTakeTheirStepsAlong() {
        const char* scheme = R"("tolerance": 1e-12, "baseline": "dopri5")";
        const Trajectory rows = rowsOf(scheme, "301");
        QVERIFY(rows.rows() > 1000 && rows.rows() <= 2000 && rows.nodes.size() == rows.rows());
        const double m = rows.nodes[1];
        QVERIFY(m > 1);
        for (std::size_t r = 0; r + 1 < rows.rows(); ++r) QCOMPARE(rows.nodes[r], m * static_cast<double>(r));
        QVERIFY(rows.nodes.back() > rows.nodes[rows.rows() - 2]);
    }
    void rowsInsideStepsHaveFractions() {
        const Trajectory rows = rowsOf(R"("step": 0.1, "scheme": "galerkin-gauss-2")", "4",
                                       R"(, "output": {"every": 0.03, "dense": true})");
        QVERIFY(rows.rows() > 90);
        for (std::size_t r = 0; r < rows.rows(); ++r)
            QVERIFY(std::abs(rows.nodes[r] - 0.3 * static_cast<double>(r)) < 1e-9);
    }

    void theAxisCountsSteps() {
        const Scene scene = sceneWith(R"([{"view": "energy", "against": "steps"}, "energy"])").scene;
        const Comparison comparison = run(scene);
        const System system = makeSystem(scene);
        const Figure steps = makeFigure(comparison, scene.views.at(0), &system),
                     time = makeFigure(comparison, scene.views.at(1), &system);
        QVERIFY(steps.x.isLog && !steps.x.isTime && time.x.isTime && !time.x.isLog);
        QCOMPARE(steps.x.title, std::string("steps"));
        QVERIFY(axesOf(scene.views[0], system).isXLog && axesOf(scene.views[0], system).variable == "n");
        QVERIFY(!axesOf(scene.views[1], system).isXLog && axesOf(scene.views[1], system).variable == "t");
        const Series& s = steps.series().at(0);
        QCOMPARE(s.x.size(), std::size_t(101));
        QVERIFY(std::isnan(s.x[0]) && s.hidden == 1);  // no step yet: not on a logarithmic axis
        for (std::size_t r = 1; r < s.x.size(); ++r) {
            QCOMPARE(s.x[r], static_cast<double>(r));
            QVERIFY(s.y[r] == time.series().at(0).y[r]);
        }
        QVERIFY(steps.x.range->first < 1 && steps.x.range->second > 100 && steps.x.range->second < 200);
        const auto point = pointAt(s, 6);  // a cursor in time finds its step
        QVERIFY(point && std::abs(point->first - 50) < 1e-9);
        QVERIFY(figureCsv(steps, false).starts_with("scheme,steps,|H − H(0)|  [J]\n"));
    }
    void chanceIsALineOfSlopeHalf() {
        const Scene scene = sceneWith(R"([{"view": "energy", "against": "steps"}])").scene;
        const System system = makeSystem(scene);
        const Figure figure = makeFigure(run(scene), scene.views.at(0), &system);
        const Series& chance = figure.series().back();
        QCOMPARE(chance.style, formulaStyle);
        QVERIFY(std::abs(std::log(chance.y[1] / chance.y[0]) / std::log(chance.x[1] / chance.x[0]) - 0.5) <
                1e-12);
        QVERIFY(chance.x[0] == 1 && std::abs(chance.y[0] / floorOf(figure) - 1) < 1e-12);
        QVERIFY(figure.subtitle.starts_with("relative, at most: ") && figure.subtitle.ends_with("(one)"));
    }
    /// 1e-12 n over 2000 rows: the first of them, a twentieth, are half of the logarithmic axis.
    void theFirstDecadesAreShown() {
        Comparison made = handmade::comparison();
        made.schemes.resize(1);
        auto counted = std::make_shared<SchemeResult>(*handmade::scheme("line", 0, 1e-7, 0, 10, 2001));
        for (std::size_t r = 0; r < counted->trajectory.rows(); ++r) {
            counted->trajectory.nodes.push_back(static_cast<double>(r));
            counted->trajectory.columns[5].values[r] =
                r == 1500 ? 1e-30 : 1e-12 * static_cast<double>(r);  // and a spike
        }
        made.schemes[0] = counted;
        const System system = handmade::pendulum();
        View view{"error", "", ""};
        view.keys.keys.emplace_back("against", "steps");
        QCOMPARE(counted->trajectory.columns[5].name, std::string("error"));
        const auto range = *makeFigure(made, view, &system).y.range;
        QVERIFY2(range.first < 3e-12 && range.first > 1e-14 && range.second > 2e-9,
                 std::to_string(std::log10(range.first)).c_str());
    }
    void againstTimeIsAsBefore() {
        const System system = handmade::pendulum();
        View plain{"energy", "", ""}, said = plain;
        said.keys.keys.emplace_back("against", "time");
        QCOMPARE(digest(makeFigure(handmade::comparison(), said, &system)),
                 digest(makeFigure(handmade::comparison(), plain, &system)));
        QVERIFY(digest(makeFigure(handmade::comparison(), plain, &system)).find("chance") ==
                std::string::npos);
    }

    void theKeyIsReadWrittenAndChecked() {
        const auto steps = sceneWith(R"([{"view": "energy", "against": "steps", "range": {"x": [10, 90]}}])");
        QVERIFY(steps.errors.empty());
        const Scene again = readScene(writeJson(toValue(steps.scene))).scene;
        QVERIFY(again.views == steps.scene.views && again.views.at(0).keys.text("against") == "steps");
        const auto time = sceneWith(R"([{"view": "energy", "against": "time"}, "energy"])").scene;
        QVERIFY(time.views.at(0) == time.views.at(1));  // the default, said or not
        QVERIFY(*toValue(time).find("views") == Value(Value::Array{"energy", "energy"}));

        const auto phase = sceneWith(R"([{"view": "phase", "x": "q.theta", "y": "p.theta"}])");
        QVERIFY(phase.errors.empty() &&
                phase.scene.views.at(0).keys.keys.empty());  // keys that other parts of a view read

        const auto message = [](const std::string& views) {
            const auto read = sceneWith(views);
            return read.errors.empty() ? std::string()
                                       : read.errors.front().pointer + ": " + read.errors.front().message;
        };
        QCOMPARE(message(R"([{"view": "energy", "against": "step"}])"),
                 std::string("/views/0/against: must be one of time and steps, got \"step\""));
        QVERIFY(message(R"([{"view": "phase", "against": "steps"}])").starts_with("/views/0/against: "));
        QVERIFY(message(R"([{"view": "energy", "against": "steps", "range": {"x": [0, 90]}}])")
                    .starts_with("/views/0/range/x/0"));
        QCOMPARE(message(R"([{"view": "energy", "range": {"x": [0, 9]}}])"), std::string());
    }
    void aCurveIsOfTheNumberOfSteps() {
        const auto read = sceneWith(R"([{"view": "energy", "against": "steps", "curve": "1e-6*n^2"}])");
        QVERIFY(read.errors.empty());
        const System system = makeSystem(read.scene);
        const Series curve = makeFigure(run(read.scene), read.scene.views.at(0), &system).series().back();
        QVERIFY(curve.x.size() > 4000);
        for (std::size_t i = 0; i < curve.x.size(); ++i)
            QVERIFY(std::abs(curve.y[i] / (1e-6 * curve.x[i] * curve.x[i]) - 1) < 1e-9);
        const double ratio = curve.x[1] / curve.x[0];  // equally spaced on the logarithmic axis
        QVERIFY(std::abs(curve.x[4000] / curve.x[3999] / ratio - 1) < 1e-9);
        QVERIFY(!sceneWith(R"([{"view": "energy", "against": "steps", "curve": "1e-6*t"}])").errors.empty());
        QVERIFY(!sceneWith(R"([{"view": "energy", "curve": "1e-6*n"}])").errors.empty());
    }
};

EXTREMAL_TEST(StepsViewTest)
}  // namespace extremal::steps_view_test

#include "steps_view_test.moc"
