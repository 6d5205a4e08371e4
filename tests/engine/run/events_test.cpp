// SPDX-License-Identifier: GPL-3.0-or-later
/// Events: where expressions in the state pass zero along a run.
#include <QTest>

#include <boost/math/special_functions/ellint_1.hpp>

#include <cmath>
#include <numbers>

#include "engine/run/files/event_files.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::events_test {
namespace {

std::string sceneText(const std::string& events, const std::string& scheme = "galerkin-gauss-6",
                      const std::string& step = "0.1") {
    return R"({"extremal": 1, "model": {"type": "pendulum", "m": 1, "l": 1, "g": 1}, "initial": {"q": [2], "p": [0]},
        "time": {"end": 30}, "schemes": [{"label": "s", "step": )" +
           step + ", \"scheme\": \"" + scheme + "\"}], \"observe\": [\"energy\"], \"views\": [\"energy\"], " +
           "\"events\": " + events + "}";
}
Comparison resultOf(const std::string& events) {
    const ReadScene read = readScene(sceneText(events));
    if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
    return run(read.scene);
}
const FoundEvents& foundIn(const Comparison& comparison) {
    return *comparison.schemes.at(0)->products.find<FoundEvents>();
}

}  // namespace

/// A free particle from (x, y) = (-10, 0.5) with the velocity (1, 0): schemes under error control cross in a
/// step or two.
Comparison freeMotion(const std::string& events, const std::string& scheme, double end = 20) {
    const ReadScene read =
        readScene(R"({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
        "lagrangian": "x_t^2/2 + y_t^2/2"}, "initial": {"q": [-10, 0.5], "v": [1, 0]}, "time": {"end": )" +
                  std::to_string(end) + "}, \"schemes\": [" + scheme +
                  R"(], "observe": ["energy"], "views": ["energy"], "events": )" + events + "}");
    if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
    return run(read.scene);
}

class EventsTest : public QObject {
    Q_OBJECT
private slots:
    void severalZerosInOneLongStepAreFound_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* id : {"dopri5", "fehlberg78", "bulirsch-stoer"})
            QTest::newRow(id) << QString(R"({"baseline": "%1", "tolerance": 1e-9, "label": "s"})").arg(id);
        for (const char* id : {"rk4", "stormer-verlet"})
            QTest::newRow(id) << QString(R"({"baseline": "%1", "step": 20, "label": "s"})").arg(id);
        QTest::newRow("galerkin") << R"({"scheme": "galerkin-gauss-3", "step": 10, "label": "s"})";
        QTest::newRow("composed")
            << R"({"scheme": "midpoint", "composition": {"type": "suzuki"}, "step": 20, "label": "s"})";
    }
    void severalZerosInOneLongStepAreFound() {
        QFETCH(QString, scheme);
        // A cubic, a flyby inside a radius with two crossings, one of t alone, and one nearly touched.
        const Comparison result = freeMotion(
            R"~(["(x + 5)*(x - 1.25)*(x - 2)", "x^2 + y^2 - 1", "sin(3*t)", "hypot(x, y) - 0.5001",
                "hypot(x, y) - 0.4999"])~",
            scheme.toStdString());
        const FoundEvents& found = foundIn(result);
        for (const auto& [event, count] : {std::pair{0, 3}, {1, 2}, {2, 19}, {3, 2}, {4, 0}})
            QCOMPARE(found.all[static_cast<std::size_t>(event)].count, static_cast<long long>(count));
        const auto t = found.rows["t"], x = found.rows["q.x"], event = found.rows["event"];
        QVERIFY(std::is_sorted(t.begin(), t.end()));
        std::vector<double> cubic, flyby;
        for (std::size_t k = 0; k < t.size(); ++k) {
            if (event[k] == 0) cubic.push_back(x[k]);
            if (event[k] == 1) flyby.push_back(x[k]);
        }
        // Measured: 2e-14, of steps of 20.
        for (const auto& [at, exact] : {std::pair{cubic[0], -5.0},
                                        {cubic[1], 1.25},
                                        {cubic[2], 2.0},
                                        {flyby[0], -std::sqrt(0.75)},
                                        {flyby[1], std::sqrt(0.75)}})
            QVERIFY2(std::abs(at - exact) < 1e-12, qPrintable(QString::number(at - exact)));
    }
    /// A change of sign across a pole, a cut or a jump is not an event, and stops nothing.
    void polesAndCutsAreNoEvents() {
        for (const char* scheme : {R"({"baseline": "dopri5", "tolerance": 1e-9, "label": "s"})",
                                   R"({"scheme": "galerkin-gauss-3", "step": 0.375, "label": "s"})"})
            for (const char* event : {"1/(x - 0.2)", "y/x", "atan2(x, -y)", "tan(x/4 + 2.7)", "sign(x)",
                                      "floor(x) + 0.5", "x/abs(x)", "if(x < 0, -1, 2)", "1/(t - 3)"}) {
                const std::string events =
                    QString(R"([{"expression": "%1", "action": "stop"}])").arg(event).toStdString();
                const Comparison result = freeMotion(events, scheme, 9);
                QVERIFY2(foundIn(result).all[0].count == 0, event);
                QCOMPARE(result.schemes[0]->summary.tEnd, 9.0);
            }
    }
    /// "x > 1" is an event where it becomes true, upwards, and where it becomes false.
    void comparisonsAreEvents() {
        const Comparison result =
            freeMotion(R"(["x > 1.5", "x <= -2", "x > -3 && x < 4", "x < -4 || y + x > 3"])",
                       R"({"scheme": "galerkin-gauss-3", "step": 0.5, "label": "s"})");
        const FoundEvents& found = foundIn(result);
        const auto x = found.rows["q.x"], direction = found.rows["direction"];
        const std::vector<double> places{-4, -3, -2, 1.5, 2.5, 4}, ways{-1, 1, -1, 1, 1, -1};
        QCOMPARE(x.size(), places.size());
        for (std::size_t k = 0; k < places.size(); ++k) {
            QVERIFY(std::abs(x[k] - places[k]) < 1e-13);
            QCOMPARE(direction[k], ways[k]);
        }
    }
    /// Sections are found by the same search: a pendulum that turns over more than once in a step.
    void sectionsSeeEveryPassage() {
        const auto passages = [](const char* step) {
            const ReadScene read = readScene(
                R"({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
                "lagrangian": "x_t^2/2 + y_t^2/2 - x^2/2 - y^2"}, "initial": {"q": [1, 0.3], "p": [0, 0]},
                "time": {"end": 64}, "schemes": [{"label": "s", "step": )" +
                std::string(step) +
                R"(, "space": {"type": "polynomial", "degree": 24}, "quadrature": "gauss"}],
                "observe": [], "views": [{"view": "section", "at": "q.x"}]})");
            if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
            return run(read.scene).schemes[0]->products.find<Sections>()->all[0].events.rows();
        };
        QCOMPARE(passages("0.5"), std::size_t(10));
        QCOMPARE(passages("16"), std::size_t(10));
    }
    void aPendulumPassesItsLowestPointAtQuartersOfItsPeriod() {
        const Comparison result = resultOf(R"(["theta"])");
        const FoundEvents& found = foundIn(result);
        const double quarter = boost::math::ellint_1(std::sin(1.0));
        const auto t = found.rows["t"], direction = found.rows["direction"], theta = found.rows["q.theta"];
        QCOMPARE(t.size(), std::size_t(std::floor((30 / quarter + 1) / 2)));
        double leastOfLines = 1;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double exact = quarter * static_cast<double>(2 * k + 1);
            QVERIFY(std::abs(t[k] - exact) < 1e-12);  // measured: 1.5e-13
            QCOMPARE(direction[k], k % 2 == 0 ? -1.0 : 1.0);
            QVERIFY(std::abs(theta[k]) < 1e-14);
            // The straight line between the nodes misses it by 9e-6 to 1.4e-5.
            const auto nodes = result.schemes[0]->trajectory["t"],
                       at = result.schemes[0]->trajectory["q.theta"];
            std::size_t r = 1;
            while (nodes[r] < t[k]) ++r;
            const double line = nodes[r] - at[r] * (nodes[r] - nodes[r - 1]) / (at[r] - at[r - 1]);
            leastOfLines = std::min(leastOfLines, std::abs(line - exact));
        }
        QVERIFY(leastOfLines > 5e-6);
        QCOMPARE(found.all[0].count, static_cast<long long>(t.size()));
        QCOMPARE(found.all[0].first, t.front());
        QCOMPARE(found.all[0].last, t.back());
    }
    void directionsTellEventsApart() {
        const Comparison result = resultOf(R"([{"expression": "theta"},
            {"expression": "theta", "direction": "up", "action": "count"},
            {"expression": "q_theta", "direction": "down", "action": "count", "label": "downwards"}])");
        const FoundEvents& found = foundIn(result);
        QCOMPARE(found.all[1].count + found.all[2].count, found.all[0].count);
        QVERIFY(found.all[2].count - found.all[1].count <= 1 && found.all[1].count == 3);
        QCOMPARE(static_cast<long long>(found.rows.rows()), found.all[0].count);  // counts have no rows
        QCOMPARE(eventsText(*result.schemes[0]), std::string("theta: 7; theta: 3; downwards: 4"));
    }
    void theRunStopsAtAnEvent() {
        const Comparison whole = resultOf("[]"),
                         result = resultOf(R"([{"expression": "theta + 1", "action": "stop"}, "t - 50"])");
        const SchemeResult& scheme = *result.schemes[0];
        const auto t = scheme.trajectory["t"], theta = scheme.trajectory["q.theta"];
        QVERIFY(scheme.summary.status == RunStatus::done);
        QCOMPARE(scheme.fraction, 1.0);
        QVERIFY(std::abs(theta.back() + 1) < 1e-14);
        QCOMPARE(scheme.summary.tEnd, t.back());
        QCOMPARE(scheme.summary.steps, static_cast<long long>(std::ceil(t.back() / 0.1)));
        // All rows before are those of the whole run.
        const auto same = whole.schemes[0]->trajectory["q.theta"];
        for (std::size_t r = 0; r + 1 < theta.size(); ++r) QCOMPARE(theta[r], same[r]);
        QVERIFY(theta[theta.size() - 2] > -1);
        QCOMPARE(foundIn(result).stoppedBy, 0);
        QVERIFY(std::abs(scheme.trajectory["energy_error"].back()) < 1e-11);
    }
    void whatComesLaterInTheStepThatStopsHasNotHappened() {
        // Both within the first step; the later one is named first.
        const Comparison result = resultOf(
            R"([{"expression": "t - 0.07", "action": "count"}, {"expression": "t - 0.03", "action": "count"},
                {"expression": "t - 0.05", "action": "stop"}])");
        const FoundEvents& found = foundIn(result);
        QCOMPARE(found.all[0].count, 0LL);
        QCOMPARE(found.all[1].count, 1LL);
        QVERIFY(std::abs(result.schemes[0]->summary.tEnd - 0.05) < 1e-15);
        QCOMPARE(result.schemes[0]->trajectory.rows(), std::size_t(2));
    }
    void theFileHasARowPerEvent() {
        const Comparison result = resultOf(R"([{"expression": "p_theta", "label": "turn, or not"}])");
        const std::string csv = eventsCsv(foundIn(result));
        QVERIFY2(csv.starts_with("event,direction,t,q.theta,p.theta\n\"turn, or not\",up,"), csv.c_str());
        QCOMPARE(std::count(csv.begin(), csv.end(), '\n'), foundIn(result).all[0].count + 1);
        const Value summary = summaryValue(result);
        const Value& event = summary.find("schemes")->asArray()[0].find("events")->asArray()[0];
        QCOMPARE(event.find("event")->asString(), std::string("turn, or not"));
        std::string files = writeCompactJson(*summary.find("files"));
        QVERIFY(files.find("s.events.csv") != std::string::npos);
    }
    void parametersOfTheModelMayBeInTheExpression() {
        const Comparison result = resultOf(R"(["theta - l/2*g"])");
        QVERIFY(std::abs(foundIn(result).rows["q.theta"].front() - 0.5) < 1e-14);
    }
    void whatIsWrongIsNamed_data() {
        QTest::addColumn<QString>("events");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("message");
        QTest::newRow("name") << R"(["thet"])"
                              << "/events/0"
                              << "unknown name \"thet\"";
        QTest::newRow("syntax") << R"([{"expression": "theta +"}])"
                                << "/events/0/expression"
                                << "the expression";
        QTest::newRow("state") << R"(["l - g"])"
                               << "/events/0"
                               << "has nothing of the state in it";
        QTest::newRow("direction") << R"([{"expression": "theta", "direction": "left"}])"
                                   << "/events/0/direction"
                                   << "unknown direction";
        QTest::newRow("action") << R"([{"expression": "theta", "action": "halt"}])"
                                << "/events/0/action"
                                << "unknown action";
        QTest::newRow("key") << R"([{"expression": "theta", "stop": true}])"
                             << "/events/0/stop"
                             << "unknown key";
        QTest::newRow("none") << R"([{"action": "stop"}])"
                              << "/events/0/expression"
                              << "is required";
    }
    void whatIsWrongIsNamed() {
        QFETCH(QString, events);
        QFETCH(QString, pointer);
        QFETCH(QString, message);
        const ReadScene read = readScene(sceneText(events.toStdString()));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(QString::fromStdString(read.errors[0].pointer), pointer);
        QVERIFY2(read.errors[0].message.find(message.toStdString()) != std::string::npos,
                 read.errors[0].message.c_str());
    }
    void fieldsHaveNoEvents() {
        const ReadScene read = readScene(std::string(
            R"({"extremal": 1, "model": {"type": "schrodinger", "modes": 16}, "time": {"end": 1}, "events": ["t - 1"],
                "schemes": [{"step": 0.1, "scheme": "schrodinger-gauss-1"}]})"));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(read.errors[0].pointer, std::string("/events"));
    }
    void aSceneWithEventsIsWrittenAsItWasRead() {
        const Scene scene =
            readScene(sceneText(R"(["theta", {"expression": "p_theta/g", "label": "a", "action": "stop"}])"))
                .scene;
        QCOMPARE(scene.events.size(), std::size_t(2));
        QVERIFY(readScene(writeScene(scene)).scene == scene);
    }
    void bodiesHaveNamesOfTheirColumns() {
        const ReadScene read = readScene(std::string(
            R"({"extremal": 1, "model": {"type": "rigid-body", "inertia": [1, 2, 3]}, "time": {"end": 20},
                "initial": {"omega": [0.01, 1, 0]}, "observe": [], "views": [],
                "schemes": [{"label": "s", "step": 0.05, "scheme": "lie-2"}], "events": ["momentum_body_2"]})"));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Comparison result = run(read.scene);
        QVERIFY(foundIn(result).all[0].count >= 1);  // the racket turns over
        for (const double value : foundIn(result).rows["momentum.body.2"]) QVERIFY(std::abs(value) < 1e-13);
    }
};

EXTREMAL_TEST(EventsTest)
}  // namespace extremal::events_test

#include "events_test.moc"
