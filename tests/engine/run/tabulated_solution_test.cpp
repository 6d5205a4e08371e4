// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of solutions: they read off what the solution says, at any time and in any order, or there is none.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/run/reference/tabulated_solution.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tabulated_solution_test {
namespace {

constexpr double end = 20;

/// Of an oscillation; the second entry has kinks, as momenta inside steps have them.
ExactSolution oscillation(double omega, double ends = end) {
    return [=](double t, std::span<double> x) {
        x[0] = t > ends ? std::numeric_limits<double>::quiet_NaN() : std::exp(std::sin(omega * t));
        x[1] = std::abs(std::sin(3 * t));
    };
}

}  // namespace

class TabulatedSolutionTest : public QObject {
    Q_OBJECT
private slots:
    void aTableSaysWhatTheSolutionSays() {
        const ExactSolution solution = oscillation(2);
        const auto table = TabulatedSolution::of(solution, 0, end, 2, 1, 1e-12, {});
        QVERIFY(table);
        const ExactSolution read = TabulatedSolution::reader(table);
        double worst = 0;
        std::vector<double> x(2), y(2);
        for (int i = 1000; i >= 0; --i) {  // from the end to the start
            const double t = end * i / 1000;
            read(t, x);
            solution(t, y);
            worst = std::max(worst, std::abs(x[0] - y[0]));
        }
        qInfo("off by %.1e", worst);
        QVERIFY(worst < 2e-12);      // measured: 4e-15
        read(end * (1 + 1e-12), x);  // a node that lies behind the end by round-off
        QVERIFY(std::abs(x[0] - std::exp(std::sin(2 * end))) < 1e-9);
    }
    void backwardsAsWell() {
        const ExactSolution solution = [](double t, std::span<double> x) { x[0] = std::cos(t); };
        const auto table = TabulatedSolution::of(solution, 1, -5, 1, 1, 1e-12, {});
        QVERIFY(table);
        double x = 0;
        table->at(-2.3, &x);
        QVERIFY(std::abs(x - std::cos(2.3)) < 1e-12);
    }
    /// No table is better than one that is wrong.
    void whatATableCannotHoldHasNone() {
        QVERIFY(!TabulatedSolution::of(oscillation(2), 0, end, 2, 2, 1e-12, {}));      // kinks, if they count
        QVERIFY(!TabulatedSolution::of(oscillation(1e7), 0, end, 2, 1, 1e-12, {}));    // too fast
        QVERIFY(!TabulatedSolution::of(oscillation(2, 10), 0, end, 2, 1, 1e-12, {}));  // ends early
    }
};

EXTREMAL_TEST(TabulatedSolutionTest)
}  // namespace extremal::tabulated_solution_test
#include "tabulated_solution_test.moc"
