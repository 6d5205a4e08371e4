// SPDX-License-Identifier: GPL-3.0-or-later
/// Tensor elements over rectangles against elements on a line and exact waves: errors, orders, limits,
/// dispersion, and what is refused.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/family/field/plane_tent.hpp"
#include "engine/quadrature/collocation.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/field/plane_tents.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::plane_tent_orders_test {
using namespace plane_tents;
namespace {

/// The mean of the trapezoidal rule and Gauss 2.
Settings fourNodes() {
    return {"nodes",
            {{"nodes", Value::Array{0.0, "(3-sqrt(3))/6", "(3+sqrt(3))/6", 1.0}},
             {"weights", Value::Array{0.25, 0.25, 0.25, 0.25}},
             {"panels", 1.0}},
            {}};
}

/// Values at one set of places in every element along both axes, of the polynomials through those at another.
Row moved(const Row& values, int nodes, int degree, const Row& from, const Row& to) {
    const Row table = lagrangeTable(from, to);
    const auto entry = [&](int a, int b) { return table[static_cast<std::size_t>(a * (degree + 1) + b)]; };
    Row along(values.size()), both(values.size());
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i % nodes + nodes * (j % nodes)); };
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
            for (int b = 0; b <= degree; ++b)
                along[at(i, j)] += entry(i % degree, b) * values[at(i / degree * degree + b, j)];
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
            for (int b = 0; b <= degree; ++b)
                both[at(i, j)] += entry(j % degree, b) * along[at(i, j / degree * degree + b)];
    return both;
}

/// The largest value after 300 steps.
double largestAfter(const System& system, const Discretization& d, const State& start, double step) {
    double most = 0;
    for (const double each : run(system, d, start, step, 300).x) most = std::max(most, std::abs(each));
    return most;
}

}  // namespace

class PlaneTentOrdersTest : public QObject {
    Q_OBJECT
private slots:
    void alongAnAxisTheyAreElementsOnALine_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("inTime");
        QTest::addColumn<Settings>("space");
        QTest::addColumn<Settings>("time");
        QTest::newRow("1, trapezoid") << 1 << 1 << trapezoid() << trapezoid();
        QTest::newRow("1, Gauss 2 and midpoint") << 1 << 1 << gauss2() << midpoint();
        QTest::newRow("1 and 2, Gauss 2 and Lobatto 3") << 1 << 2 << gauss2() << lobattoOf(3);
        QTest::newRow("2, Gauss 3 and 2") << 2 << 2 << gaussOf(3) << gauss2();
        QTest::newRow("2, Lobatto 3") << 2 << 2 << lobattoOf(3) << lobattoOf(3);
        QTest::newRow("3, Gauss 4 and 3") << 3 << 3 << gaussOf(4) << gaussOf(3);
        QTest::newRow("3 and 2, Lobatto 4 and Gauss 3") << 3 << 2 << lobattoOf(4) << gaussOf(3);
        QTest::newRow("2 and 4, Gauss 3 and 4") << 2 << 4 << gaussOf(3) << gaussOf(4);
    }
    void alongAnAxisTheyAreElementsOnALine() {
        QFETCH(int, degree);
        QFETCH(int, inTime);
        QFETCH(Settings, space);
        QFETCH(Settings, time);
        const Discretization d = tents(space, time, degree, inTime);
        const int cells = 48 / degree, steps = 30;
        const double step = 0.1;
        const System line = makeField({"sine-gordon", -10, 20, cells, "periodic", 1, degree});
        // Of a row of values at equidistant nodes: those at the nodes of the line.
        const LobattoBasis basis(degree);
        Row places;
        for (int a = 0; a <= degree; ++a) places.push_back(static_cast<double>(a) / degree);
        const Row table = lagrangeTable(places, basis.reference);
        const auto onLine = [&](const Row& row) {
            Row values;
            for (int e = 0; e < cells; ++e)
                for (int a = 0; a < degree; ++a) {
                    double sum = 0;
                    for (int b = 0; b <= degree; ++b)
                        sum += table[static_cast<std::size_t>(a * (degree + 1) + b)] *
                               row[static_cast<std::size_t>((e * degree + b) % 48)];
                    values.push_back(sum);
                }
            return values;
        };
        const auto rowOf = [&](const State& state, bool isAlongX, int part, int across) {
            Row row;
            for (int i = 0; i < 48; ++i)
                row.push_back(state.x[static_cast<std::size_t>(
                    part * 48 * 12 + (isAlongX ? i + 48 * across : across + 12 * i))]);
            return onLine(row);
        };
        for (const bool isAlongX : {true, false}) {
            const Side with{-10, 10, 48}, other{0, 7, 12};
            const System system =
                plane("sine-gordon", isAlongX ? with : other, isAlongX ? other : with, {"u"});
            const State start =
                component_fields::startOf(system, {{"u", isAlongX ? "3*exp(-x^2/2)" : "3*exp(-y^2/2)"},
                                                   {"u_t", isAlongX ? "x*exp(-x^2)" : "y*exp(-y^2)"}});
            State first{0, 0, rowOf(start, isAlongX, 0, 0)};
            const Row velocity = rowOf(start, isAlongX, 1, 0);
            first.x.insert(first.x.end(), velocity.begin(), velocity.end());
            const State known = run(line, d, first, step, steps), end = run(system, d, start, step, steps);
            double most = 0;
            for (int across = 0; across < 12; ++across)
                for (const int part : {0, 1}) {
                    const Row row = rowOf(end, isAlongX, part, across);
                    for (std::size_t i = 0; i < row.size(); ++i)
                        most = std::max(most,
                                        std::abs(row[i] - known.x[static_cast<std::size_t>(part * 48) + i]));
                }
            qInfo("%s: %.1e", isAlongX ? "x" : "y", most);
            QVERIFY(most < 2e-12);
        }
    }
    void errorsOfAWave_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        QTest::addColumn<QList<double>>("known");
        QTest::newRow("1, Gauss") << 1 << true << QList<double>{1.61e-1, 4.32e-2, 1.26e-2, 3.18e-3};
        QTest::newRow("1, Lobatto") << 1 << false << QList<double>{9.16e-1, 2.89e-1, 7.46e-2, 1.88e-2};
        QTest::newRow("2, Gauss") << 2 << true << QList<double>{3.67e-1, 1.89e-2, 1.24e-3, 8.12e-5};
        QTest::newRow("2, Lobatto") << 2 << false << QList<double>{5.89e-1, 2.54e-2, 1.51e-3, 7.80e-5};
        QTest::newRow("3, Gauss") << 3 << true << QList<double>{2.49e-2, 4.08e-4, 7.19e-6};
        QTest::newRow("3, Lobatto") << 3 << false << QList<double>{5.48e-2, 2.93e-4, 1.24e-5};
    }
    /// A wave with k = (1, 2) up to t = 5, dt = dx/2, at the Lobatto points of the elements, with these in
    /// space and Gauss in time: the second route of the table of errors.
    void errorsOfAWave() {
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        QFETCH(QList<double>, known);
        const Discretization d =
            tents(isGauss ? gaussOf(degree + 1) : lobattoOf(degree + 1), gaussOf(degree), degree, degree);
        int elements = degree == 1 ? 8 : 4;
        Row h, q, p;
        for (const double expected : known) {
            const int nodes = degree * elements;
            const System system = plane("none", {0, 2 * pi, nodes}, {0, 2 * pi, nodes}, {"u"});
            const double dx = 2 * pi / elements, w = std::sqrt(5.0);
            // At the Lobatto points, and back to values at equidistant ones.
            const LobattoBasis basis(degree);
            Row places;
            for (int a = 0; a <= degree; ++a) places.push_back(static_cast<double>(a) / degree);
            const auto at = [&](int i) {
                return dx * (i / degree + basis.reference[static_cast<std::size_t>(i % degree)]);
            };
            const auto wave = [&](int i, int j, double t) { return at(i) + 2 * at(j) - w * t; };
            State start;
            for (const int part : {0, 1}) {
                Row values;
                for (int j = 0; j < nodes; ++j)
                    for (int i = 0; i < nodes; ++i)
                        values.push_back(part == 0 ? std::cos(wave(i, j, 0)) : w * std::sin(wave(i, j, 0)));
                const Row equidistant = moved(values, nodes, degree, basis.reference, places);
                start.x.insert(start.x.end(), equidistant.begin(), equidistant.end());
            }
            const int steps = static_cast<int>(std::lround(5 / (dx / 2)));
            const State end = run(system, d, start, 5.0 / steps, steps);
            double sum[2] = {0, 0};
            const std::size_t n = end.x.size() / 2;
            for (const std::size_t part : {0, 1}) {
                const Row values = moved(Row(end.x.begin() + static_cast<long>(part * n),
                                             end.x.begin() + static_cast<long>((part + 1) * n)),
                                         nodes, degree, places, basis.reference);
                for (int j = 0; j < nodes; ++j)
                    for (int i = 0; i < nodes; ++i)
                        sum[part] +=
                            std::pow(values[static_cast<std::size_t>(i + nodes * j)] -
                                         (part == 0 ? std::cos(wave(i, j, 5)) : w * std::sin(wave(i, j, 5))),
                                     2);
            }
            const double error = std::sqrt(sum[0] / double(n));
            const double ofVelocity = std::sqrt(sum[1] / double(n));
            qInfo("%d elements: %.3e (%.2e), u_t %.2e", elements, error, expected, ofVelocity);
            QVERIFY(std::abs(error / expected - 1) < 0.01);
            h.push_back(-std::log(elements));
            q.push_back(std::log(error));
            p.push_back(std::log(ofVelocity));
            elements *= 2;
        }
        // From the second to the last: inner nodes of degree 3 end at order 5, their velocities below.
        for (Row* each : {&h, &q, &p}) each->erase(each->begin());
        qInfo("orders %.2f, %.2f", slope(h, q), slope(h, p));
        QVERIFY(slope(h, q) > (degree == 3 ? 4.5 : 2 * degree - 0.3));
        QVERIFY(slope(h, p) > (degree == 3 ? 3.7 : 2 * degree - 0.4));
    }
    void ordersInTime_data() {
        QTest::addColumn<int>("inTime");
        QTest::addColumn<Settings>("time");
        QTest::addColumn<int>("steps");
        QTest::newRow("1, Gauss 2") << 1 << gauss2() << 32;
        QTest::newRow("1, midpoint") << 1 << midpoint() << 32;
        QTest::newRow("2, Gauss 2") << 2 << gauss2() << 32;
        QTest::newRow("2, Lobatto 3") << 2 << lobattoOf(3) << 32;
        QTest::newRow("3, Gauss 3") << 3 << gaussOf(3) << 16;
        QTest::newRow("3, Lobatto 4") << 3 << lobattoOf(4) << 16;
        QTest::newRow("3, Gauss 2") << 3 << gauss2() << 32;
        QTest::newRow("4, Gauss 4") << 4 << gaussOf(4) << 12;
    }
    /// A nonlinear plane of unlike sides, against degree 4 in time with many steps on the same elements.
    void ordersInTime() {
        QFETCH(int, inTime);
        QFETCH(Settings, time);
        QFETCH(int, steps);
        const System system = plane("phi4", {0, 2 * pi, 16}, {0, 3 * pi, 20}, {"u"});
        const State start = component_fields::startOf(
            system, {{"u", "0.6 + 0.3*cos(x)*sin(2*y/3)"}, {"u_t", "0.4*sin(x + 2*y/3)"}});
        const Discretization d = tents(gaussOf(3), time, 2, inTime);
        if (!describe(d, system).refusal.empty()) {
            QVERIFY(inTime == 3);  // fewer nodes than unknowns
            return;
        }
        const State known = run(system, tents(gaussOf(3), gaussOf(4), 2, 4), start, 4.0 / 100, 100);
        const int claimed = describe(d, system).claims.order;
        Row h, q, p;
        for (const int count : {steps, 2 * steps, 4 * steps}) {
            const State end = run(system, d, start, 4.0 / count, count);
            double u = 0, v = 0;
            const std::size_t n = start.x.size() / 2;
            for (std::size_t i = 0; i < n; ++i) {
                u = std::max(u, std::abs(end.x[i] - known.x[i]));
                v = std::max(v, std::abs(end.x[n + i] - known.x[n + i]));
            }
            h.push_back(-std::log(count));
            q.push_back(std::log(u));
            p.push_back(std::log(v));
        }
        qInfo("order %.2f, %.2f of %d; %.1e", slope(h, q), slope(h, p), claimed, std::exp(q.back()));
        QVERIFY(std::abs(slope(h, q) - claimed) < 0.3 && std::abs(slope(h, p) - claimed) < 0.3);
    }
    void stepsAreStableUpToTheLimit_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        QTest::addColumn<double>("known");
        QTest::newRow("1, Lobatto") << 1 << false << 1.0;
        QTest::newRow("1, Gauss") << 1 << true << 0.5774;
        QTest::newRow("2, Lobatto") << 2 << false << 0.4082;
        QTest::newRow("2, Gauss") << 2 << true << 0.2582;
        QTest::newRow("3, Lobatto") << 3 << false << 0.2320;
        QTest::newRow("3, Gauss") << 3 << true << 0.1533;
    }
    /// With the trapezoidal rule in time: on square cells the limit of the line over √2.
    void stepsAreStableUpToTheLimit() {
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        QFETCH(double, known);
        const Discretization d =
            tents(isGauss ? gaussOf(degree + 1) : lobattoOf(degree + 1), trapezoid(), degree, 1);
        for (const double ratio : {1.0, 2.5}) {
            const System system = plane("none", {0, 6, 12}, {0, 6 * ratio, 12}, {"u"});
            const State start = random(system, 1, 5);
            const double dx = degree * 0.5, dy = dx * ratio,
                         limit = longestPlaneStep(d, problemOf(system), start.x.data()),
                         expected = known / std::sqrt(1 / (dx * dx) + 1 / (dy * dy));
            const auto grown = [&](double share) { return largestAfter(system, d, start, share * limit); };
            qInfo("%.5f, known %.5f: %.1e, %.1e", limit, expected, grown(0.99), grown(1.01));
            QVERIFY(std::abs(limit / expected - 1) < 5e-4);
            QVERIFY(grown(0.99) < 1e3 && grown(1.01) > 1e6);
        }
    }
    void everyAxisHasItsOwnLimit_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<double>("alongX");
        QTest::addColumn<double>("alongY");
        QTest::newRow("1") << 1 << 1.0 << 0.5774;
        QTest::newRow("2") << 2 << 0.4082 << 0.2582;
        QTest::newRow("3") << 3 << 0.2320 << 0.1533;
    }
    /// Lobatto along x and Gauss along y; and a field that is constant along one axis is that of the line
    /// with the rule of the other.
    void everyAxisHasItsOwnLimit() {
        QFETCH(int, degree);
        QFETCH(double, alongX);
        QFETCH(double, alongY);
        const Discretization lobatto = tents(lobattoOf(degree + 1), trapezoid(), degree, 1),
                             both = withAcross(lobatto, gaussOf(degree + 1)),
                             gauss = tents(gaussOf(degree + 1), trapezoid(), degree, 1);
        const System system = plane("none", {0, 6, 12}, {0, 15, 12}, {"u"});
        const State start = random(system, 1, 5);
        const double dx = degree * 0.5, dy = 2.5 * dx,
                     limit = longestPlaneStep(both, problemOf(system), start.x.data()),
                     expected = 1 / std::hypot(1 / (alongX * dx), 1 / (alongY * dy));
        const auto grown = [&](double share) { return largestAfter(system, both, start, share * limit); };
        qInfo("%.5f, known %.5f: %.1e, %.1e", limit, expected, grown(0.99), grown(1.01));
        QVERIFY(std::abs(limit / expected - 1) < 5e-4);
        QVERIFY(grown(0.99) < 1e3 && grown(1.01) > 1e6);
        for (const bool isAlongX : {true, false}) {
            const State wave = component_fields::startOf(
                system, {{"u", isAlongX ? "exp(cos(pi*x/3))" : "exp(cos(2*pi*y/15))"}});
            const auto distance = [&](const Discretization& d) {
                const State a = run(system, both, wave, 0.05, 20), b = run(system, d, wave, 0.05, 20);
                double most = 0;
                for (std::size_t i = 0; i < a.x.size(); ++i) most = std::max(most, std::abs(a.x[i] - b.x[i]));
                return most;
            };
            const double own = distance(isAlongX ? lobatto : gauss),
                         other = distance(isAlongX ? gauss : lobatto);
            qInfo("%s: %.1e, %.1e", isAlongX ? "x" : "y", own, other);
            QVERIFY(own < 1e-12 && other > 1e-5);
        }
    }
    void anisotropy_data() {
        QTest::addColumn<Settings>("space");
        QTest::addColumn<Settings>("time");
        QTest::addColumn<double>("axis");
        QTest::addColumn<double>("diagonal");
        QTest::newRow("trapezoid") << trapezoid() << trapezoid() << -0.910 << -0.410;
        QTest::newRow("exact") << gauss2() << gauss2() << 0.910 << 0.410;
        QTest::newRow("exact in space") << gauss2() << trapezoid() << 1.091 << 0.590;
        QTest::newRow("1/12 in space") << fourNodes() << trapezoid() << 0.088 << 0.090;
    }
    /// In (k dx)²/24, with c dt = .3 dx; the mean of the trapezoidal rule and Gauss 2 leaves the error of the
    /// time alone, which has no direction.
    void anisotropy() {
        QFETCH(Settings, space);
        QFETCH(Settings, time);
        QFETCH(double, axis);
        QFETCH(double, diagonal);
        const Discretization d = tents(space, time);
        const System system = plane("none", {0, 2 * pi, 64}, {0, 2 * pi, 64}, {"u"});
        const double dx = 2 * pi / 64, dt = 0.3 * dx;
        const auto factor = [&](const char* wave, double k) {
            const State start = component_fields::startOf(system, {{"u", wave}}),
                        end = run(system, d, start, dt, 1);
            const double w = std::acos(end.x[0] / start.x[0]) / dt;
            return (w / k - 1) * 24 / (k * dx * k * dx);
        };
        const double along = factor("cos(x)", 1), across = factor("cos(x + y)", std::sqrt(2.0));
        qInfo("%.4f %.4f", along, across);
        QVERIFY(std::abs(along - axis) < 0.01 && std::abs(across - diagonal) < 0.01);
    }
    void valuesAtEquidistantNodes_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        for (const int degree : {1, 2, 3})
            for (const bool isGauss : {true, false})
                QTest::addRow("%d, %s", degree, isGauss ? "Gauss" : "Lobatto") << degree << isGauss;
    }
    /// Orders in space as a scene sees them, which starts from values at equidistant nodes.
    void valuesAtEquidistantNodes() {
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        const Discretization d =
            tents(isGauss ? gaussOf(degree + 1) : lobattoOf(degree + 1), gaussOf(4), degree, 4);
        Row h, q, p;
        for (const int elements : {8, 16, 32}) {
            const int nodes = degree * elements;
            const System system = plane("none", {0, 2 * pi, nodes}, {0, 2 * pi, nodes}, {"u"});
            const State start =
                component_fields::startOf(system, {{"u", "cos(x + 2*y)"}, {"u_t", "sqrt(5)*sin(x + 2*y)"}});
            const State end = run(system, d, start, 0.05, 40);
            double u = 0, v = 0;
            const std::size_t n = end.x.size() / 2, nx = static_cast<std::size_t>(nodes);
            const PlaneFieldProblem& problem = problemOf(system);
            for (std::size_t i = 0; i < n; ++i) {
                const double w = std::sqrt(5.0),
                             phase = problem.x()[i % nx] + 2 * problem.y()[i / nx] - 2 * w;
                u = std::max(u, std::abs(end.x[i] - std::cos(phase)));
                v = std::max(v, std::abs(end.x[n + i] - w * std::sin(phase)));
            }
            qInfo("%d: %.2e, %.2e", elements, u, v);
            h.push_back(-std::log(elements));
            q.push_back(std::log(u));
            p.push_back(std::log(v));
        }
        qInfo("orders %.2f, %.2f", slope(h, q), slope(h, p));
        // Velocities of higher elements see the modes inside an element that values between nodes start.
        QVERIFY(slope(h, q) > (degree == 1 ? 1.9 : 3.8));
        QVERIFY(slope(h, p) > (degree == 1 ? 1.9 : 2.3));
    }
    void whatDoesNotFitIsRefused() {
        const auto read = [](const std::string& model, const std::string& scheme) {
            const ReadScene scene = readScene(
                R"({"extremal": 1, "model": {"type": "field-2d", "potential": "sine-gordon")" + model +
                R"J(}, "initial": {"u": "exp(-r^2)"}, "time": {"end": 1}, "schemes": [{"step": 0.1, )J" +
                scheme + "}]}");
            return scene.errors.empty() ? std::string()
                                        : scene.errors.front().pointer + ": " + scene.errors.front().message +
                                              " (" + scene.errors.front().hint + ")";
        };
        const std::string third = R"("space": {"type": "tent", "degree": 3})";
        QCOMPARE(read("", R"("space": {"type": "tent", "degree": 2})"), std::string());
        QVERIFY(QString::fromStdString(read("", third)).contains("multiple of it, and cells is 64"));
        QVERIFY(QString::fromStdString(read("", third)).contains("\"cells\": 66"));
        QCOMPARE(read(R"(, "cells": 66, "cells_y": 66)", third), std::string());
        for (const auto& [scheme, part] :
             {std::pair{R"("space": {"type": "tent", "cells": 32})", "nodes of the model"},
              {R"("space": {"type": "tent", "functions": "snapshots"})", "on a line"},
              {R"("space": {"type": "tent"}, "quadrature": {"space": "midpoint", "time": "midpoint"})",
               "mass"},
              {R"("space": {"type": "tent"}, "solver": {"method": "newton"})", "mode"}}) {
            const QString text = QString::fromStdString(read("", scheme));
            qInfo("%s", qPrintable(text));
            QVERIFY(text.contains(part));
        }
    }
};

EXTREMAL_TEST(PlaneTentOrdersTest)

}  // namespace extremal::plane_tent_orders_test

#include "plane_tent_orders_test.moc"
