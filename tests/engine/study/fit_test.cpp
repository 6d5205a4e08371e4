// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a scene from measurements, which another integrator or a formula has made.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/fit/fit.hpp"
#include "engine/study/fit/measured_data.hpp"
#include "tests/tools/test.hpp"

namespace extremal::fit_test {
namespace {

ResolvedScene sceneOf(const std::string& model, const std::string& initial, const std::string& scheme) {
    const ReadScene read = readScene(R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial +
                                     R"(,"time":{"end":10},"schemes":[)" + scheme + "]}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

FitAnswer fitted(const ResolvedScene& scene, const std::string& csv, const FitRequest& request) {
    std::istringstream in(csv);
    return fit(scene, readMeasuredData(in, "data.csv", *scene.system, request.columns), request);
}

/// The classical Runge-Kutta method, written here: y' = f(y) with 4 numbers, 2000 steps per unit of time.
using Four = std::array<double, 4>;
Four rungeKutta(const std::function<Four(const Four&)>& f, Four y, double time) {
    const int steps = std::max(1, static_cast<int>(std::ceil(2000 * time)));
    const double h = time / steps;
    const auto plus = [](Four a, const Four& b, double c) {
        for (std::size_t i = 0; i < 4; ++i) a[i] += c * b[i];
        return a;
    };
    for (int k = 0; k < steps; ++k) {
        const Four k1 = f(y), k2 = f(plus(y, k1, h / 2)), k3 = f(plus(y, k2, h / 2)), k4 = f(plus(y, k3, h));
        for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    return y;
}

/// Angles of the spring pendulum of k = 40, g = 9.81, l = 1 at 100 times up to 10, with noise of 1e-3.
std::string springAngles() {
    const auto f = [](const Four& y) {  // a, theta, a', theta'
        const double r = 1 + y[0], g = 9.81;
        return Four{y[2], y[3], r * y[3] * y[3] + g * std::cos(y[1]) - 40 * y[0],
                    -(2 * y[2] * y[3] + g * std::sin(y[1])) / r};
    };
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 1e-3);
    std::string csv = "t,theta\n";
    Four y{0.1, 1, 0, 0};
    for (int i = 1; i <= 100; ++i) {
        y = rungeKutta(f, y, 0.1);
        csv += formatNumber(0.1 * i) + ',' + formatNumber(y[1] + noise(random)) + '\n';
    }
    return csv;
}

/// A pendulum of length 0.8 with damping 0.15, at times of its own, every seventh angle missing.
std::string dampedAngles(unsigned seed, double deviation) {
    const auto f = [](const Four& y) { return Four{y[1], -9.81 / 0.8 * std::sin(y[0]) - 0.15 * y[1], 0, 0}; };
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, deviation);
    std::string csv = "t,theta,sd.theta\n";
    Four y{1.2, 0, 0, 0};
    double t = 0;
    for (int i = 1; i <= 120; ++i) {
        const double next = 0.08 * i + 0.013 * std::sin(7. * i);
        y = rungeKutta(f, y, next - t);
        t = next;
        const double value = y[0] + noise(random);
        csv += formatNumber(t) + ',' + (i % 7 == 0 ? "" : formatNumber(value)) + ',' +
               formatNumber(deviation) + '\n';
    }
    return csv;
}
const char* const damped = R"s({"type":"lagrangian","coordinates":["theta"],
    "parameters":{"l":0.9,"c":0.1,"g":9.81},
    "lagrangian":"l^2*theta_t^2/2+g*l*cos(theta)","forces":{"theta":"-c*l^2*theta_t"}})s";
const char* const gauss6 = R"({"step":0.1,"scheme":"galerkin-gauss-3"})";

const char* const oscillator = R"({"type":"harmonic-oscillator","m":1,"k":1.2})";
/// cos t at 40 times.
std::string cosines() {
    std::string csv = "t,q.x\n";
    for (int i = 1; i <= 40; ++i) csv += formatNumber(0.2 * i) + ',' + formatNumber(std::cos(0.2 * i)) + '\n';
    return csv;
}

}  // namespace

class FitTest : public QObject {
    Q_OBJECT
private slots:
    void theSpringPendulumFromItsAngles() {
        const ResolvedScene scene = sceneOf(R"({"type":"spring-pendulum","m":1,"k":44,"g":10.1,"l":1.03})",
                                            R"({"q":[0.1,1],"p":[0,0]})", gauss6);
        const FitAnswer answer =
            fitted(scene, springAngles(), {.free = {"/model/k", "/model/g", "/model/l"}});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const std::array<double, 3> truth{40, 9.81, 1};
        for (std::size_t i = 0; i < 3; ++i) {
            const FittedNumber& each = answer.numbers[i];
            qInfo("%s %.9g sd %.3g bias %.2g", each.name.c_str(), each.value, each.deviation, each.bias);
            QVERIFY(std::abs(each.value - truth[i]) < 3 * each.deviation);
            QVERIFY(std::abs(each.bias) < 0.3 * each.deviation);
        }
        // 100 angles with noise of 1e-3: the sum is 1e-4 within 15 % (one sigma of it), the scatter 1e-3.
        QVERIFY(std::abs(answer.scatter - 1e-3) < 3e-4);
        QVERIFY(answer.sums.size() <= 12);
        QVERIFY(answer.correlations[1][2] > 0.9);
        QVERIFY(std::any_of(answer.notes.begin(), answer.notes.end(), [](const std::string& note) {
            return note.starts_with("g and l are correlated");
        }));
    }
    /// Deviations are what they say: over many samples of the noise, errors have their size.
    void deviationsAreThoseOfManySamples() {
        const ResolvedScene scene = sceneOf(damped, R"({"q":[1.2],"p":[0]})", gauss6);
        double squares = 0;
        constexpr int samples = 30;
        for (int k = 0; k < samples; ++k) {
            const FitAnswer answer =
                fitted(scene, dampedAngles(static_cast<unsigned>(k + 1), 0.01),
                       {.free = {"/model/parameters/l", "/model/parameters/c"}, .measuresBias = false});
            QVERIFY2(answer.isFound(), answer.problem.c_str());
            QCOMPARE(answer.measurements, std::size_t{103});
            for (const auto& [i, truth] : {std::pair{0U, 0.8}, {1U, 0.15}})
                squares += std::pow((answer.numbers[i].value - truth) / answer.numbers[i].deviation, 2);
        }
        const double ratio = std::sqrt(squares / (2 * samples));
        qInfo("errors over deviations, rms: %.3f", ratio);
        QVERIFY(ratio > 0.7 && ratio < 1.3);
    }
    void whatTheDataDoNotSeeIsSaid() {
        const ResolvedScene scene = sceneOf(oscillator, R"({"q":[1],"p":[0]})", gauss6);
        const FitAnswer answer = fitted(scene, cosines(), {.free = {"/model/m", "/model/k"}});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        // Only k / m.
        QVERIFY(std::abs(answer.numbers[1].value / answer.numbers[0].value - 1) < 1e-7);
        QVERIFY(std::isnan(answer.numbers[0].deviation) && std::isnan(answer.numbers[1].deviation));
        const SeenDirection& last = answer.directions.back();
        QVERIFY(!std::isfinite(last.deviation));
        QVERIFY(std::abs(std::abs(last.parts[0]) - std::sqrt(0.5)) < 1e-6 &&
                std::abs(last.parts[0] - last.parts[1]) < 1e-6);
        QVERIFY(answer.notes.front().starts_with("the data do not see a change of m by"));
    }
    /// The midpoint rule turns by 2 atan(h w / 2) in a step: the stiffness that fits is not the true one.
    void theBiasOfAStepIsThatOfItsFrequency() {
        const ResolvedScene scene =
            sceneOf(oscillator, R"({"q":[1],"p":[0]})", R"({"step":0.2,"scheme":"midpoint"})");
        const FitAnswer answer = fitted(scene, cosines(), {.free = {"/model/k"}});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const auto stiffness = [](double h) { return std::pow(2 / h * std::tan(h / 2), 2); };
        QVERIFY(std::abs(answer.numbers[0].value - stiffness(0.2)) < 1e-9);
        // Half the step has the measurements at its nodes as well.
        QVERIFY(std::abs(answer.numbers[0].bias - (stiffness(0.2) - stiffness(0.1))) < 1e-9);
        QVERIFY(!answer.notes.empty() && answer.notes.back().find("off by") != std::string::npos);
    }
    /// Between nodes a step of its own is taken, of the order of the scheme.
    void measurementsBetweenNodesCountAsWell() {
        std::string csv = "t,x\n";
        for (int i = 1; i <= 60; ++i) {
            const double t = 0.137 * i;
            csv += formatNumber(t) + ',' + formatNumber(std::cos(t)) + '\n';
        }
        const ResolvedScene scene =
            sceneOf(oscillator, R"({"q":[1.1],"p":[0.1]})", R"({"step":0.5,"scheme":"galerkin-gauss-4"})");
        const FitAnswer answer = fitted(scene, csv, {.free = {"/model/k", "/initial/q/0", "/initial/p/0"}});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY(std::abs(answer.numbers[0].value - 1) < 1e-8);
        QVERIFY(std::abs(answer.numbers[1].value - 1) < 1e-8);
        QVERIFY(std::abs(answer.numbers[2].value) < 1e-8);
    }
    void weightsAndDeviationsSayTheSame() {
        const ResolvedScene scene = sceneOf(oscillator, R"({"q":[1],"p":[0]})", gauss6);
        std::string deviations = "t,q.x,sd.q.x\n", weights = "t,q.x,weight.q.x\n", left = weights;
        for (int i = 1; i <= 30; ++i) {
            const double t = 0.3 * i, value = std::cos(t) + 0.01 * std::sin(13. * i),
                         sd = i % 2 ? 0.01 : 0.02;
            const std::string lead = formatNumber(t) + ',' + formatNumber(value) + ',';
            deviations += lead + formatNumber(sd) + '\n';
            weights += lead + formatNumber(1 / (sd * sd)) + '\n';
            left += lead + (i % 2 ? "0" : formatNumber(1 / (sd * sd))) + '\n';
        }
        const FitRequest request{.free = {"/model/k"}, .measuresBias = false};
        const FitAnswer a = fitted(scene, deviations, request), b = fitted(scene, weights, request),
                        c = fitted(scene, left, request);
        QVERIFY(a.hasDeviations);
        QVERIFY(std::abs(a.numbers[0].value - b.numbers[0].value) < 1e-9);
        QVERIFY(std::abs(a.numbers[0].deviation / b.numbers[0].deviation - 1) < 1e-9);
        QCOMPARE(c.measurements, std::size_t{15});
        QVERIFY(c.numbers[0].deviation > 1.5 * a.numbers[0].deviation);
    }
    void whatCannotBeIsSaid_data() {
        QTest::addColumn<QString>("csv");
        QTest::addColumn<QString>("free");
        QTest::addColumn<QString>("message");
        const QString good = QString::fromStdString(cosines());
        QTest::newRow("no time") << "x\n1\n"
                                 << "/model/k"
                                 << "--data: \"data.csv\" has no column \"t\"";
        QTest::newRow("a column that is not of the state")
            << "t,y\n1,1\n"
            << "/model/k"
            << "--data: the column \"y\" is not one of the state";
        QTest::newRow("no number") << "t,x\n1,many\n"
                                   << "/model/k"
                                   << "--data: \"data.csv\", line 2";
        QTest::newRow("a negative deviation") << "t,x,sd.x\n1,1,-1\n"
                                              << "/model/k"
                                              << "--data: \"data.csv\", line 2: has a standard deviation";
        QTest::newRow("too few") << "t,x\n1,\n"
                                 << "/model/k"
                                 << "--data: has 0 measurements for 1 numbers";
        QTest::newRow("before the start") << "t,x\n-1,1\n2,1\n"
                                          << "/model/k"
                                          << "--data: begins at t = -1";
        QTest::newRow("a number that is not there") << good << "/model/nonsense"
                                                    << "--free: /model/nonsense is not";
        QTest::newRow("twice") << good << "/model/k,/model/k"
                               << "--free: /model/k is there twice";
    }
    void whatCannotBeIsSaid() {
        QFETCH(QString, csv);
        QFETCH(QString, free);
        QFETCH(QString, message);
        FitRequest request;
        for (const QString& pointer : free.split(',')) request.free.push_back(pointer.toStdString());
        const ResolvedScene scene = sceneOf(oscillator, R"({"q":[1],"p":[0]})", gauss6);
        std::string said = "nothing";
        try {
            (void)fitted(scene, csv.toStdString(), request);
        } catch (const InvalidScene& e) {
            said = e.problems().front().pointer + ": " + e.problems().front().message;
        }
        QVERIFY2(said.starts_with(message.toStdString()), said.c_str());
    }
};

EXTREMAL_TEST(FitTest)

}  // namespace extremal::fit_test

#include "fit_test.moc"
