// SPDX-License-Identifier: GPL-3.0-or-later
/// Complex fields against the tables of their exact solutions, plane waves and Q-balls; and what is refused.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/model/plane_field/q_ball.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/spectral_field/component_fields.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::components_test {
using namespace component_fields;
namespace {

const Value ball(Value::Object{{"name", "q-ball"}, {"a", 1.0}, {"b", 0.25}});

}  // namespace

class ComponentsTest : public QObject {
    Q_OBJECT
private slots:
    void aComplexPlaneWaveHasTheErrorsOfTheTable_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("steps");
        QTest::addColumn<int>("runs");
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("last");
        QTest::newRow("degree 1") << 1 << 20 << 4 << 3.09e-1 << 5.20e-3;
        QTest::newRow("degree 2") << 2 << 20 << 4 << 2.34e-3 << 5.85e-7;
        QTest::newRow("degree 3") << 3 << 20 << 4 << 7.14e-6 << 2.8e-11;
        QTest::newRow("degree 4") << 4 << 20 << 3 << 1.19e-8 << 1.8e-13;
    }
    void aComplexPlaneWaveHasTheErrorsOfTheTable() {
        QFETCH(int, degree);
        QFETCH(int, steps);
        QFETCH(int, runs);
        QFETCH(double, first);
        QFETCH(double, last);
        const System system = plane("klein-gordon-complex", {0, 2 * pi, 16}, {0, 2 * pi, 16});
        const Value wave(Value::Object{
            {"name", "plane-wave"}, {"wave_vector", Value::Array{1.0, 2.0}}, {"amplitude", 0.7}});
        const Settings initial{"", {{"profile", wave}}, {}};
        const State start = startOf(system, initial.keys);
        State known = start;
        system.exactFrom(initial, start)(5, known.x);
        // w^2 = k^2 + m^2 + lambda A^2, by hand.
        const double w = std::sqrt(5 + 1 + 0.49);
        QVERIFY(std::abs(known.x[0] - 0.7 * std::cos(5 * w)) < 1e-13);
        QVERIFY(std::abs(known.x[256] + 0.7 * std::sin(5 * w)) < 1e-13);
        std::vector<double> h, q, p, all;
        for (int run = 0; run < runs; ++run) {
            const int count = steps << run;
            const State end = after(system, start, degree, 5, count);
            all.push_back(distance(system, end, known));
            qInfo("%d steps: u %.3e, u_t %.3e", count, all.back(), distance(system, end, known, true));
            if (all.back() < 2e-12) continue;
            h.push_back(-std::log(count));
            q.push_back(std::log(all.back()));
            p.push_back(std::log(distance(system, end, known, true)));
        }
        qInfo("order %.2f, %.2f", slope(h, q), slope(h, p));
        QVERIFY(std::abs(slope(h, q) - 2 * degree) < 0.15);
        QVERIFY(std::abs(slope(h, p) - 2 * degree) < 0.15);
        QVERIFY(std::abs(all.front() / first - 1) < 0.03);
        QVERIFY(all.back() < 1.03 * last || all.back() < 2.5e-13);
    }
    void aQBallTurnsInPlace_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<double>("coarse");
        QTest::addColumn<double>("fine");
        QTest::newRow("degree 1") << 1 << 7.97e-2 << 1.94e-2;
        QTest::newRow("degree 2") << 2 << 4.22e-4 << 2.66e-5;
        QTest::newRow("degree 3") << 3 << 6.30e-7 << 9.86e-9;
    }
    void aQBallTurnsInPlace() {
        QFETCH(int, degree);
        QFETCH(double, coarse);
        QFETCH(double, fine);
        const System system = plane(ball, {-18, 18, 96}, {-18, 18, 96});
        const Settings initial{"", {{"profile", Value::Object{{"name", "q-ball"}, {"omega", 0.8}}}}, {}};
        const State start = startOf(system, initial.keys);
        const double period = 2 * pi / 0.8;
        State known = start;
        system.exactFrom(initial, start)(period, known.x);
        QVERIFY(largest(start, known) < 1e-13);
        double charge = 0;
        for (const auto& [steps, expected] : {std::pair{20, coarse}, {40, fine}}) {
            const State end = after(system, start, degree, period, steps);
            const double cell = problemOf(system).grid().measure(),
                         error = std::sqrt(cell) * distance(system, end, known);
            charge =
                problemOf(system).charges(end.x.data())[0] / problemOf(system).charges(start.x.data())[0] - 1;
            qInfo("%d steps: %.4e, charge %.1e", steps, error, charge);
            QVERIFY(std::abs(error / expected - 1) < 0.03);
        }
        QVERIFY(std::abs(charge) < 1e-13);
    }
    void theProfileOfAQBallSolvesItsEquation() {
        const System system = plane(ball, {-18, 18, 96}, {-18, 18, 96});
        const QBall lump(problemOf(system), 0.8, "");
        qInfo("f(0) = %.8f", lump.value(0));
        QVERIFY(std::abs(lump.value(0) - 1.4118453) < 1e-7);
        for (const double r : {0.7, 2.0, 4.5, 9.0}) {
            // f'' by five values of f'.
            const double d = 0.05, f = lump.value(r),
                         second = (lump.slope(r - 2 * d) - lump.slope(r + 2 * d) +
                                   8 * (lump.slope(r + d) - lump.slope(r - d))) /
                                  (12 * d),
                         rest =
                             second + lump.slope(r) / r - ((1 - 0.64) * f - f * f * f + std::pow(f, 5) / 4);
            qInfo("%g: %.1e", r, rest);
            QVERIFY(std::abs(rest) < 2e-6);
        }
        for (const double omega : {0.3, 1.2}) {
            std::string pointer;
            try {
                const QBall none(problemOf(system), omega, "/profile");
            } catch (const InvalidScene& e) {
                pointer = e.problems().front().pointer;
            }
            QCOMPARE(pointer, std::string("/profile/omega"));
        }
    }
    void aMovingQBallKeepsItsSpeed() {
        // Its momentum is energy times velocity, and it arrives where it should.
        const System system = plane(ball, {-18, 18, 96}, {-18, 18, 90});
        const Value moving(Value::Object{{"name", "q-ball"},
                                         {"omega", 0.8},
                                         {"centre", Value::Array{-1.0, 0.5}},
                                         {"velocity", Value::Array{0.4, -0.3}}});
        const State start = startOf(system, {{"profile", moving}}), end = after(system, start, 3, 4, 40);
        State known = start;
        known.x = system.start({"", {{"profile", moving}}, {}}, 4);
        const auto momentum = problemOf(system).momentum(start.x.data());
        const double energy = system.energy(0, start.x.data()), error = largest(end, known);
        qInfo("%.6f %.6f, %.6f %.6f: %.1e", momentum[0], 0.4 * energy, momentum[1], -0.3 * energy, error);
        QVERIFY(std::abs(momentum[0] - 0.4 * energy) < 1e-4 * energy);
        QVERIFY(std::abs(momentum[1] + 0.3 * energy) < 1e-4 * energy);
        QVERIFY(error < 2e-3);  // its copies in the neighbouring periods
    }
    void picturesStandSideBySideUnlessTheyAreOneFunction() {
        const auto rastersOf = [](const System& system) {
            const State start = startOf(system, {{"u", "1"}, {"v", "-2*cos(x)^2"}});
            std::vector<double> sample(system.field.size());
            system.field.sample(start.x.data(), sample.data());
            Drawing drawing;
            system.draw(sample.data(), drawing);
            std::vector<Raster> all;
            for (const Shape& shape : drawing.shapes)
                if (const auto* raster = std::get_if<Raster>(&shape)) all.push_back(*raster);
            return all;
        };
        const Side x{0, 2 * pi, 8}, y{-1, 1, 4};
        const System one = plane("klein-gordon-complex", x, y), two = plane("u^2 + v^4", x, y);
        QVERIFY(one.field.isComplex && !two.field.isComplex);
        QCOMPARE(one.field.components, (std::vector<std::string>{"u", "v", "u_t", "v_t"}));
        const std::vector<Raster> whole = rastersOf(one), parts = rastersOf(two);
        QVERIFY(whole.size() == 1 && parts.size() == 2);
        QVERIFY(std::abs(whole[0].strengths[0] - 1) < 1e-12);
        QVERIFY(std::abs(2 * pi * whole[0].hues[0] - std::atan2(-2, 1)) < 1e-6);
        // One scale for both, and each with the colour of its sign.
        QVERIFY(parts[1].corner[0] > parts[0].corner[0] + parts[0].width);
        QVERIFY(std::abs(parts[0].strengths[0] - 0.5) < 1e-12 && std::abs(parts[1].strengths[0] - 1) < 1e-12);
        QVERIFY(parts[0].hues[0] != parts[1].hues[0]);
    }
    void aPoorMeshIsToldWithTheKeyOfItsModel() {
        const ReadScene read = readScene(std::string(
            R"J({"extremal": 1, "model": {"type": "field-2d", "cells": 8}, "initial": {"u": "exp(-4*r^2)"}, )J"
            R"J("time": {"end": 1}, "schemes": [{"step": 0.1, "scheme": "field-gauss-2"}]})J"));
        QVERIFY(read.errors.empty() && read.warnings.size() == 1);
        QCOMPARE(read.warnings.front().hint, std::string("raise /model/cells"));
    }
    void whatDoesNotFitIsRefused_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<QString>("pointer");
        const auto row = [](const char* name, const char* model, const char* initial, const char* pointer) {
            QTest::newRow(name) << model << initial << pointer;
        };
        const char *two = R"("components": ["u", "v"])", *one = R"("u": "1")";
        row("fits", R"("components": ["a1", "b2"], "potential": "a1^2 + b2^4")", R"J("b2": "exp(-r^2)")J",
            "");
        row("a list of speeds", R"("components": ["u", "v"], "wave_speed": [1, 2])", R"("v": "1")", "");
        row("one component", R"("potential": "q-ball")", one, "/model/potential");
        row("too many", R"("components": ["u", "v"], "potential": "phi4")", one, "/model/potential");
        row("a name twice", R"("components": ["u", "u"])", one, "/model/components/1");
        row("a name that is taken", R"("components": ["u", "x"])", one, "/model/components/1");
        row("speeds for others", R"("components": ["u", "v"], "wave_speeds": [1])", one,
            "/model/wave_speeds");
        row("a key of another potential",
            R"("components": ["u", "v"], "potential": {"name": "q-ball", "lambda": 1})", one,
            "/model/potential/lambda");
        row("no such component", two, R"("w": "1")", "/initial/w");
        row("no turning", R"("components": ["u", "v"], "potential": "u^2 + 2*v^2")",
            R"("profile": {"name": "plane-wave"})", "/initial/profile/name");
        row("half a wave", two, R"("profile": {"name": "plane-wave", "wave_vector": [0.5, 1]})",
            "/initial/profile/wave_vector");
        row("faster than waves", R"("components": ["u", "v"], "potential": "q-ball")",
            R"("profile": {"name": "q-ball", "velocity": [1, 0.2]})", "/initial/profile/velocity");
        row("no profile", two, R"("profile": {"name": "kink"})", "/initial/profile/name");
    }
    void whatDoesNotFitIsRefused() {
        QFETCH(QString, model);
        QFETCH(QString, initial);
        QFETCH(QString, pointer);
        const ReadScene read =
            readScene(R"({"extremal": 1, "model": {"type": "field-2d", "cells": 16, "cells_y": 16, )" +
                      model.toStdString() + R"(}, "initial": {)" + initial.toStdString() +
                      R"(}, "time": {"end": 1}, "schemes": [{"step": 0.1, "scheme": "field-gauss-2"}]})");
        const std::string found = read.errors.empty() ? std::string() : read.errors.front().pointer;
        if (!read.errors.empty())
            qInfo("%s (%s)", read.errors.front().message.c_str(), read.errors.front().hint.c_str());
        QCOMPARE(found, pointer.toStdString());
    }
};

EXTREMAL_TEST(ComponentsTest)

}  // namespace extremal::components_test

#include "components_test.moc"
