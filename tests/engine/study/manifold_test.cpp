// SPDX-License-Identifier: GPL-3.0-or-later
/// Invariant manifolds of periodic orbits: what is on one is mapped along it by its multiplier, forwards on
/// the unstable and backwards on the stable one; and sections of motions backwards.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/run/cases/start_sets.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/orbits/orbit_request.hpp"
#include "tests/tools/test.hpp"

namespace extremal::manifold_test {
namespace {

using Place = std::pair<double, double>;

ReadScene sceneFrom(const std::string& initial, const std::string& end, const std::string& view,
                    const char* scheme = R"({"label": "s", "step": 0.1, "scheme": "galerkin-gauss-4"})") {
    ReadScene read = readScene(R"({"extremal": 1, "model": {"type": "henon-heiles"}, "initial": )" + initial +
                               R"(, "time": {"end": )" + end + R"(}, "schemes": [)" + scheme +
                               R"(], "reference": "none", "observe": [], "views": [)" + view + "]}");
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return read;
}
const char* const chaotic = R"json({"q": [0, -0.25], "p": ["sqrt(2*(1/8 - 0.25^2/2 - 0.25^3/3))", 0]})json";

const StartSet& setOf(const Comparison& comparison) {
    return comparison.products.find<StartSets>()->all.at(0);
}
/// Where a motion passes the section nearest to a time.
Place passageAt(const Orbit& orbit, double t) {
    const auto times = orbit.points["t"], y = orbit.points["q.y"], py = orbit.points["p.y"];
    std::size_t best = 0;
    for (std::size_t k = 0; k < times.size(); ++k)
        if (std::abs(times[k] - t) < std::abs(times[best] - t)) best = k;
    return {y[best], py[best]};
}

std::string refusal(const std::string& initial, const std::string& end, const std::string& view,
                    const OrbitRequest& request) {
    try {
        (void)seekOrbit(*sceneFrom(initial, end, view).resolved, request);
    } catch (const InvalidScene& e) {
        return e.problems().front().pointer + ": " + e.problems().front().message;
    }
    return "none";
}

}  // namespace

class ManifoldTest : public QObject {
    Q_OBJECT
private slots:
    void startsAreMappedAlongTheManifold_data() {
        QTest::addColumn<QString>("name");
        QTest::newRow("unstable") << "unstable";
        QTest::newRow("stable") << "stable";
    }
    void startsAreMappedAlongTheManifold() {
        QFETCH(QString, name);
        const ReadScene read = sceneFrom(chaotic, "60", R"({"view": "section"})");
        const OrbitAnswer answer = seekOrbit(*read.resolved, {.manifold = name.toStdString(), .starts = 20});
        QVERIFY(answer.isFound() && answer.manifold);
        const Manifold& of = *answer.manifold;
        const bool isUnstable = name == "unstable";
        QVERIFY(isUnstable == (std::abs(of.multiplier) > 1));
        QCOMPARE(of.starts.size(), std::size_t(20));
        const ReadScene made = readScene(answer.scene);
        QVERIFY(made.errors.empty());
        const Comparison result = run(made.scene);
        const StartSet& set = setOf(result);
        const Place middle{(of.starts[0].first + of.starts[1].first) / 2,
                           (of.starts[0].second + of.starts[1].second) / 2};
        const double period = answer.orbit->period, factor = isUnstable ? of.multiplier : 1 / of.multiplier;
        double worst = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Place start = of.starts[k],
                        image = passageAt(*set.orbits[k], isUnstable ? period : -period);
            const double size = std::hypot(start.first - middle.first, start.second - middle.second);
            const double off =
                std::hypot(image.first - middle.first - factor * (start.first - middle.first),
                           image.second - middle.second - factor * (start.second - middle.second));
            worst = std::max(worst, off / (std::abs(factor) * size));
        }
        qInfo("multiplier %.6f: off by %.1e of the distance", of.multiplier, worst);
        QVERIFY(std::abs(factor) > 10);
        QVERIFY(worst < 0.01);
    }
    /// The equations are reversible: the stable manifold is the unstable one with the momenta turned round.
    void oneIsTheMirrorOfTheOther() {
        const ReadScene read = sceneFrom(chaotic, "60", R"({"view": "section"})");
        const OrbitAnswer forwards = seekOrbit(*read.resolved, {.manifold = "unstable", .starts = 2}),
                          backwards = seekOrbit(*read.resolved, {.manifold = "stable", .starts = 2});
        QVERIFY(std::abs(forwards.manifold->multiplier * backwards.manifold->multiplier - 1) < 1e-9);
    }
    void whatHasNoneIsRefused() {
        const std::string straight = R"json({"q": [0, 0], "p": [0, "sqrt(1/6)"]})json",
                          section = R"({"view": "section"})",
                          other = R"({"view": "section", "at": "q.y", "x": "q.x", "y": "p.x"})";
        QVERIFY(refusal(straight, "8", other, {.manifold = "unstable"})
                    .starts_with("--manifold: the orbit has none: no multiplier is larger"));
        QVERIFY(refusal(straight, "8", section, {.manifold = "unstable"})
                    .starts_with("--manifold: the orbit does not pass q.x = 0 upwards"));
        QVERIFY(refusal(chaotic, "60", section, {.manifold = "left"})
                    .starts_with("--manifold: must be unstable"));
        QVERIFY(refusal(chaotic, "60", section, {.starts = 10}).starts_with("--starts: is of a manifold"));
        QVERIFY(refusal(chaotic, "60", section, {.manifold = "stable", .starts = 1})
                    .starts_with("--starts: must be"));
        QVERIFY(refusal(chaotic, "60", section, {.follow = "energy=0.12", .manifold = "stable"})
                    .starts_with("--manifold: is of one orbit"));
    }
    /// A section is one surface: there and back the same points are passed.
    void sectionsAreTheSameBackwards() {
        const auto pointsOf = [](const std::string& initial, const std::string& end) {
            const ReadScene read = sceneFrom(initial, end, R"({"view": "section"})");
            const Comparison result = run(read.scene);
            std::vector<Place> points;
            const Trajectory& events = result.schemes.front()->products.find<Sections>()->all.at(0).events;
            for (std::size_t k = 0; k < events.rows(); ++k)
                points.emplace_back(events["q.y"][k], events["p.y"][k]);
            const Trajectory& rows = result.schemes.front()->trajectory;
            const auto last = [&](const char* name) { return std::to_string(rows[name].back()); };
            return std::pair{points, R"({"q": [)" + last("q.x") + "," + last("q.y") + R"(], "p": [)" +
                                         last("p.x") + "," + last("p.y") + "]}"};
        };
        const auto [there, end] = pointsOf(R"({"q": [0.1, -0.25], "p": [0.3, 0.1]})", "30");
        auto [back, start] = pointsOf(end, "-30");
        QVERIFY(there.size() > 3);
        QCOMPARE(back.size(), there.size());
        std::reverse(back.begin(), back.end());
        for (std::size_t k = 0; k < there.size(); ++k)
            QVERIFY(std::hypot(back[k].first - there[k].first, back[k].second - there[k].second) < 1e-4);
    }
};

EXTREMAL_TEST(ManifoldTest)

}  // namespace extremal::manifold_test

#include "manifold_test.moc"
