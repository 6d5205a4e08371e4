// SPDX-License-Identifier: GPL-3.0-or-later
/// Derivatives of the discrete motion by numbers of the scene (integrator/variation/with_sensitivities.hpp),
/// against differences of order 8 of runs with other values: of every scheme that has them, positions and
/// momenta. Those of one number of the end by a sweep backwards (study/gradient) against these.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/scene/outlook/sensitivities.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/gradient.hpp"
#include "engine/study/search/candidates.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::sensitivity_test {
namespace {

constexpr int steps = 20;

constexpr double endOfRuns = 0.4;

/// The parameters are in the start as well, and depend on each other.
const char* const spring = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["a", "theta"],
    "parameters": {"m": 1.3, "g": 9.81, "l": 1, "k": "m*w^2", "w": 5},
    "lagrangian": {"kinetic": "m/2*(a_t^2+(l+a)^2*theta_t^2)",
                  "fall" : "m*g*(l+a)*cos(theta)", "spring" : "-k/2*a^2"
}
}
, "initial" : {"q" : [ "1/w", 1 ], "v" : [ 0.1, 0.5 ]},
              "time" : {"end" : 1},
                       "reference" : {"type" : "none"},
                                     "observe" : ["sensitivity"],
                                                 "sensitivity"
    : [
        "/model/parameters/w", "/model/parameters/m", "/initial/q/theta", "/initial/v/0",
        "/model/lagrangian/fall"
    ]
})J";
const char* const builtIn = R"J({"extremal": 1, "model": {"type": "spring-pendulum", "k": 1000},
    "initial": {"q": [0.05, 1], "p": [0, 0.2]}, "time": {"end": 1}, "reference": {"type": "none"},
    "observe": ["sensitivity"]})J";
const char* const separable = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
    "parameters": {"b": 1.5, "f": 0.3, "n": 2}, "lagrangian":
    "(x_t^2+2*y_t^2)/2-(x^2+y^2)/2-b*x^2*y+y^3/3+f*x*sin(n*t)"
}
, "initial" : {"q" : [ 0.2, 0.1 ], "p" : [ 0.1, 0.3 ]},
              "time" : {"end" : 1},
                       "reference" : {"type" : "none"},
                                     "observe" : ["sensitivity"]
})J";
const char* const hamiltonian =
    R"J({"extremal": 1, "model": {"type": "hamiltonian", "coordinates": ["x", "y"],
    "parameters": {"a": 1, "b": 0.5}, "hamiltonian": "p_x*x*(a-y)+p_y*y*(x-b)+a*p_x^2*x/8"},
    "initial": {"q": [1, 0.6], "p": [0.2, 1]}, "time": {"end": 1}, "reference": {"type": "none"},
    "observe": ["sensitivity"]})J";
const char* const rods = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
    "parameters": {"m": 1, "g": 9.81, "l": 1, "c": 0.3}, "lagrangian": "m/2*(x_t^2+y_t^2)-m*g*y",
    "constraints": {"rod": "x^2+y^2-l^2"}, "dissipation": "c/2*(x_t^2+y_t^2)"
}
, "initial" : {"q" : [ "l*sin(1)", "-l*cos(1)" ], "v" : [ 0, 0 ]},
              "time" : {"end" : 1},
                       "reference" : {"type" : "none"},
                                     "observe" : ["sensitivity"]
})J";
const char* const wall = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["y"],
    "parameters": {"m": 1, "g": 9.81, "w": 0.2}, "lagrangian": "m/2*y_t^2-m*g*y",
    "walls": {"floor": "y-w"}}, "initial": {"q": [0.6714], "v": [0]}, "time": {"end": 1},
    "reference": {"type": "none"}, "observe": ["sensitivity"]})J";

Override with(const std::string& pointer, const Value& value) { return {pointer, value}; }

/// The columns at the end; empty where the scheme has none, with the reason.
std::vector<double> columnsOf(const ReadScene& read, std::string& problem) {
    const ResolvedScene& scene = *read.resolved;
    const ResolvedScheme& scheme = scene.schemes[0];
    const double h = scheme.spec.step.value;
    auto plain = scheme.make(*scene.system, h, scene.initial);
    problem = sensitivityProblem(scene, scheme, *plain, h, scene.initial);
    if (!problem.empty()) return {};
    const std::size_t before = plain->quantities().size();
    const auto integrator = measuringSensitivities(std::move(plain), scene, scheme, h, scene.initial);
    State state = scene.initial;
    integrator->begin(state);
    for (int k = 1; k <= steps; ++k)
        if (integrator->advance(state, scheme.isAdaptive() ? scene.scene.end.value : k * h).outcome !=
            Outcome::converged)
            return {};
    std::vector<double> values(integrator->quantities().size());
    integrator->measure(state, values.data());
    return {values.begin() + static_cast<std::ptrdiff_t>(before), values.end()};
}

/// The same by differences of whole runs.
std::vector<double> differencesOf(const std::string& text, const Override& scheme, const ReadScene& read) {
    constexpr std::array<double, 4> weights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    std::vector<double> all;
    std::vector<std::string> pointers = read.scene.sensitivity;
    if (pointers.empty()) {
        const bool isTyped = read.scene.model.find("parameters") != nullptr;
        const Value own(read.scene.model.keys);
        std::vector<std::string> names;
        for (const auto& [name, value] : (isTyped ? *own.find("parameters") : own).asObject())
            names.push_back(name);
        std::sort(names.begin(), names.end());
        for (const std::string& name : names)
            pointers.push_back((isTyped ? "/model/parameters/" : "/model/") + name);
    }
    for (const std::string& pointer : pointers) {
        const Value document = parseJson(writeScene(read.scene));
        const Value* const there = valueAt(document, pointer);
        const bool isTerm = there && there->isString() && pointer.find("lagrangian") != std::string::npos;
        const double mu =
            isTerm ? 1
            : there && there->isNumber()
                ? there->asNumber()
                : (pointer == "/initial/q/theta"
                       ? read.scene.initial.q[1].value
                       : read.scene.model.find("parameters")->find(pointer.substr(18))->asNumber());
        const std::string place = pointer == "/initial/q/theta" ? "/initial/q/1" : pointer;
        const double e = std::abs(mu) / 128;
        std::vector<double> sum(read.resolved->initial.x.size());
        for (int k = 1; k <= 4; ++k)
            for (const int side : {1, -1}) {
                const double value = mu + side * k * e;
                const Value set = isTerm ? Value("(" + formatNumber(1 + side * k / 128.0, 17) + ")*(" +
                                                 there->asString() + ")")
                                         : Value(value);
                const auto x = tests::after(readScene(text, {scheme, with(place, set)}), steps);
                if (x.empty()) return {};
                for (std::size_t i = 0; i < sum.size(); ++i)
                    sum[i] += side * weights[static_cast<std::size_t>(k - 1)] / e * x[i];
            }
        all.insert(all.end(), sum.begin(), sum.end());
    }
    return all;
}

/// A number of the end in which every entry of the state has a part, as a formula and as its parts.
std::pair<std::string, std::vector<double>> mixed(const System& system) {
    std::string text;
    std::vector<double> parts;
    for (const char* const prefix : {"", "p_"})
        for (const auto& coordinate : system.coordinates) {
            parts.push_back(0.3 + 0.25 * static_cast<double>(parts.size()));
            text +=
                (text.empty() ? "" : "+") + formatNumber(parts.back(), 17) + "*" + prefix + coordinate.name;
        }
    return {text, parts};
}
/// The largest difference of the sweep backwards from the columns at the end, and the size of these.
std::pair<double, double> apartFromSweep(const ReadScene& read, const std::vector<std::string>& pointers,
                                         const std::vector<double>& columns) {
    const auto [text, parts] = mixed(*read.resolved->system);
    const GradientAnswer answer = gradient(*read.resolved, {text, "", pointers, ""});
    if (!answer.isFound()) qFatal("%s", answer.problem.c_str());
    double apart = 0, size = 0;
    for (std::size_t i = 0; i < pointers.size(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            sum += parts[k] * columns[i * parts.size() + k];
            size = std::max(size, std::abs(parts[k] * columns[i * parts.size() + k]));
        }
        apart = std::max(apart, std::abs(sum - answer.rows[i].derivative));
    }
    return {apart, size};
}
std::vector<std::string> pointersOf(const ReadScene& read) {
    std::vector<std::string> pointers;
    for (const auto& each : read.resolved->system->parts.find<VariedNumbers>()->all)
        pointers.push_back(each.pointer);
    return pointers;
}

}  // namespace

class SensitivityTest : public QObject {
    Q_OBJECT
private slots:
    void columnsAreDifferencesOfRuns_data() {
        QTest::addColumn<QString>("scene");
        QTest::addColumn<QString>("scheme");
        const std::pair<const char*, const char*> scenes[] = {
            {"spring", spring},           {"built-in", builtIn}, {"separable", separable},
            {"hamiltonian", hamiltonian}, {"rods", rods},        {"wall", wall}};
        std::vector<Value> schemes = extremal::everyScheme({1, 3});
        for (const char* own :
             {R"({"label": "oscillatory", "space": {"type": "oscillatory", "omega": 30, "degree": 4,
                  "variables": {"a": {"degree": 2, "harmonics": [1]}}}})",
              R"({"label": "composed", "scheme": "galerkin-gauss-2", "composition": {"type": "yoshida"}})",
              R"({"label": "spline", "space": {"type": "spline", "degree": 3, "cells": 2}})"})
            schemes.push_back(parseJson(own));
        for (const auto& [name, scene] : scenes)
            for (Value scheme : schemes) {
                const std::string label = scheme.find("label")->asString();
                if (!scheme.find("tolerance")) scheme.set("step", 0.02);
                QTest::addRow("%s, %s", name, label.c_str())
                    << QString(scene) << QString::fromStdString(writeJson(scheme));
            }
    }
    void columnsAreDifferencesOfRuns() {
        QFETCH(QString, scene);
        QFETCH(QString, scheme);
        const std::string text = scene.toStdString();
        const Override scenesOwn = with("/schemes", Value(Value::Array{parseJson(scheme.toStdString())}));
        const ReadScene read = readScene(text, {scenesOwn, with("/time/end", endOfRuns)});
        if (!read.errors.empty()) QSKIP(read.errors[0].message.c_str());
        if (read.resolved->schemes[0].grid != TimeGrid::fixed) QSKIP("steps of its own");
        std::string problem;
        const std::vector<double> columns = columnsOf(read, problem);
        if (!problem.empty()) QSKIP(problem.c_str());
        const std::vector<double> other = differencesOf(text, scenesOwn, read);
        if (other.empty()) QSKIP("no run");
        QCOMPARE(columns.size(), other.size());
        double largest = 0, apart = 0;
        for (std::size_t i = 0; i < other.size(); ++i) {
            largest = std::max(largest, std::abs(other[i]));
            apart = std::max(apart, std::abs(columns[i] - other[i]));
        }
        qInfo("apart %.1e of %.1e", apart, largest);
        QVERIFY(apart <= 1e-8 * largest);
        const auto [fromSweep, size] = apartFromSweep(read, pointersOf(read), columns);
        qInfo("the sweep backwards is apart %.1e of %.1e", fromSweep, size);
        QVERIFY(fromSweep <= 1e-13 * size);
    }
    /// What does not change with a number is no coordinate: of a restitution, which cannot be one, and of a
    /// model that says no formula.
    void onlyWhatChangesIsVaried() {
        const std::string bouncing = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["y"],
            "parameters": {"g": 9.81, "e": 0.8}, "lagrangian": "y_t^2/2-g*y",
            "walls": {"floor": {"gap": "y", "restitution": "e"}}}, "initial": {"q": [0.4], "v": [0]},
            "time": {"end": 1}, "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.05}],
            "reference": {"type": "none"}, "observe": ["sensitivity"]})J";
        std::string problem;
        const ReadScene ball = readScene(bouncing);
        QVERIFY(ball.resolved);
        QVERIFY(columnsOf(ball, problem).empty());
        QVERIFY2(problem.find("/model/parameters/e cannot be varied") == 0, problem.c_str());
        const ReadScene alone =
            readScene(bouncing, {with("/sensitivity", Value(Value::Array{"/model/parameters/g"}))});
        const std::vector<double> columns = columnsOf(alone, problem);
        QVERIFY(problem.empty() && columns.size() == 2 && std::isfinite(columns[0]));
        const ReadScene planets = readScene(
            std::string(R"J({"extremal": 1, "model": {"type": "outer-solar-system"}, "time": {"end": 200},
                "schemes": [{"scheme": "galerkin-gauss-2", "step": 10}], "reference": {"type": "none"},
                "observe": ["sensitivity"], "sensitivity": ["/initial/q/3"]})J"));
        const std::vector<double> places = columnsOf(planets, problem);
        QVERIFY2(problem.empty() && places.size() == 36, problem.c_str());
        QVERIFY(std::abs(places[3] - 1) < 0.5 && places[0] != 0 && std::abs(places[0]) < 1e-3);
    }
    /// Their flow has forces and reactions in it, which the Hessian of the Lagrangian does not know.
    void explicitCodesSayThatForcesAreNotVaried_data() {
        QTest::addColumn<QString>("scheme");
        QTest::newRow("rk4") << R"({"baseline": "rk4", "step": 0.02})";
        QTest::newRow("dopri5") << R"({"baseline": "dopri5", "tolerance": 1e-6})";
        QTest::newRow("fehlberg78") << R"({"baseline": "fehlberg78", "tolerance": 1e-6})";
    }
    void explicitCodesSayThatForcesAreNotVaried() {
        QFETCH(QString, scheme);
        const Value schemes(Value::Array{parseJson(scheme.toStdString())});
        for (const char* const scene : {rods, separable}) {
            const ReadScene read = readScene(std::string(scene), {with("/schemes", schemes)});
            QVERIFY(read.resolved);
            std::string problem;
            (void)columnsOf(read, problem);
            QCOMPARE(problem.empty(), scene != rods);
        }
    }
};

EXTREMAL_TEST(SensitivityTest)

}  // namespace extremal::laws::sensitivity_test

#include "sensitivity_test.moc"
