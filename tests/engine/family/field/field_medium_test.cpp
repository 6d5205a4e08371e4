// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields in media a(x/epsilon): functions of the elements from a cell problem and from snapshots, and what
/// they gain over linear elements of the same size.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/model/field/element_functions.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/tools/test.hpp"

namespace extremal::field_medium_test {
namespace {

constexpr double epsilon = 1. / 64;

double layered(double x) { return 1 / (1 + 0.9 * std::sin(2 * std::numbers::pi * x / epsilon)); }

/// `functions`: "linear" (with Gauss 4) or those of the element. Quotes are ' here.
std::string quoted(std::string text) {
    for (char& c : text)
        if (c == '\'') c = '"';
    return text;
}

std::string scheme(const std::string& label, int cells, const std::string& functions, double step,
                   const std::string& more = "") {
    const bool isLinear = functions == "linear";
    std::string text =
        "{'label': '" + label + "', 'step': " + std::to_string(step) +
        ", 'space': {'type': 'tent', 'degree': {'space': 1, 'time': 2}, 'cells': " + std::to_string(cells);
    if (!isLinear) text += ", 'functions': '" + functions + "'";
    text += "}";
    if (isLinear)
        text +=
            ", 'quadrature': {'space': {'type': 'gauss', 'nodes': 4}, 'time': {'type': 'gauss', 'nodes': 2}}";
    return text + more + "}";
}

std::string scene(const std::string& schemes, const std::string& a = "1/(1 + 0.9*sin(2*pi*s))",
                  const std::string& initial = "{'u': 'exp(2*cos(2*pi*(x - 0.5)) - 2)'}") {
    return quoted(
        "{'extremal': 1, 'model': {'type': 'field', 'a': '" + a +
        "', 'epsilon': '1/64', 'domain': [0, 1], 'boundary': 'periodic', 'cells': 32}, 'initial': " +
        initial + ", 'time': {'end': 0.5}, 'observe': ['error'], 'schemes': [" + schemes + "]}");
}

std::vector<double> errorsOf(const std::string& json) {
    const ReadScene read = readScene(json);
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    std::vector<double> errors;
    for (const auto& s : run(read.scene).schemes) errors.push_back(s->summary.maxError);
    return errors;
}

}  // namespace

class FieldMediumTest : public QObject {
    Q_OBJECT
private slots:
    void theFluxOfACellFunctionIsConstant() {
        const Mesh mesh = uniformMesh(0, 1, 32, Boundary::periodic);  // two periods in each
        const ElementFunctions f = cellFunctions(mesh, layered, 64);
        const double H = 1. / 32;
        for (int e = 0; e < 32; ++e)
            for (int k = 0; k <= 64; ++k) {
                const double x = H * k / 64,
                             expected =
                                 (x + 0.9 * epsilon * (1 - std::cos(2 * std::numbers::pi * x / epsilon)) /
                                          (2 * std::numbers::pi)) /
                                 H;
                QVERIFY(std::abs(f.at(e, k) - expected) < 1e-8);  // 3e-10, by Gauss 4 on each part
            }
    }
    void inAHomogeneousMediumTheyAreLinear() {
        const Mesh mesh = uniformMesh(0, 1, 8, Boundary::periodic);
        const auto one = [](double) { return 1.0; };
        const ElementFunctions cell = cellFunctions(mesh, one, 16),
                               snapshots = snapshotFunctions(mesh, one, 1, 16);
        double away = 0;
        for (int k = 0; k <= 16; ++k) {
            QVERIFY(std::abs(cell.at(3, k) - k / 16.) < 1e-14);
            away = std::max(away, std::abs(snapshots.at(3, k) - k / 16.));
        }
        QVERIFY2(away < 0.02, qPrintable(QString::number(away)));  // 0.012: waves bend
    }
    void multiscaleElementsGainOverLinearOnes() {
        const auto errors = errorsOf(scene(
            scheme("linear", 32, "linear", 0.005) + "," + scheme("cell", 32, "cell-problem", 0.005) + "," +
            scheme("snapshots", 32, "snapshots", 0.005) + "," + scheme("fine", 512, "linear", 0.005)));
        qInfo("linear %.2e, cell problem %.2e, snapshots %.2e, 16 times as many linear %.2e", errors[0],
              errors[1], errors[2], errors[3]);
        QVERIFY(errors[0] > 20 * errors[1]);  // 35 and 33
        QVERIFY(errors[0] > 18 * errors[2]);
        QVERIFY(errors[3] > errors[1]);
    }
    void theirErrorsFallDownToTheWavesOfThePeriod() {
        const auto errors = errorsOf(scene(scheme("8", 8, "cell-problem", 0.005) + "," +
                                           scheme("16", 16, "cell-problem", 0.005) + "," +
                                           scheme("32", 32, "cell-problem", 0.005)));
        qInfo("%.2e %.2e %.2e", errors[0], errors[1], errors[2]);
        // 8.3e-2, 2.6e-2, 1.1e-2: smooth data start waves of the period as well, of a size of 5e-3.
        QVERIFY(errors[0] / errors[1] > 3);
        QVERIFY(errors[1] / errors[2] > 2);
    }
    void theStepIsTheEquationOfTheSlab() {
        // Banded Newton against the KKT system of all cells.
        const ReadScene read =
            readScene(scene(scheme("a", 8, "cell-problem", 0.01) + "," +
                                scheme("b", 8, "cell-problem", 0.01, ", 'solver': {'method': 'newton'}"),
                            "1/(1 + 0.9*sin(2*pi*s))"));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ResolvedScheme &a = read.resolved->schemes[0], &b = read.resolved->schemes[1];
        State x = a.ownInitial, y = x;
        const auto fast = a.make(*a.ownSystem, 0.01, x), slow = b.make(*b.ownSystem, 0.01, y);
        QVERIFY(fields::go(*fast, x, 5));
        QVERIFY(fields::go(*slow, y, 5));
        double away = 0;
        for (std::size_t i = 0; i < x.x.size() / 2; ++i) away = std::max(away, std::abs(x.x[i] - y.x[i]));
        QVERIFY2(away < 1e-12, qPrintable(QString::number(away)));
    }
    void whatIsWrongIsSaid() {
        const auto first = [](const std::string& json) {
            const ReadScene read = readScene(json);
            return read.errors.empty() ? std::string() : read.errors[0].pointer;
        };
        QCOMPARE(first(scene(scheme("a", 32, "cell-problem", 0.005))), std::string());
        QCOMPARE(first(scene(scheme("a", 32, "cell-problem", 0.005), "sin(2*pi*s)")),
                 std::string("/model/a"));
        QCOMPARE(first(scene(scheme("a", 32, "cell-problem", 0.005), "1 + 0.5*sin(2*pi*s)",
                             "{'profile': 'plane-wave', 'wave_number': 1}")),
                 std::string("/initial/profile"));
        QVERIFY(
            !first(
                 scene("{'step': 0.01, 'space': {'type': 'tent', 'degree': 2, 'functions': 'cell-problem'}}"))
                 .empty());
    }
};

EXTREMAL_TEST(FieldMediumTest)

}  // namespace extremal::field_medium_test

#include "field_medium_test.moc"
