// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of solutions: they read off what the solution says, at any time and in any order, or there is none.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/run/reference/reference.hpp"
#include "engine/run/reference/tabulated_solution.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
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
    /// Of a solution that is stepped along, kinks and jumps are followed inside its steps: it is gone along
    /// once more, and never back beyond the step where it is.
    void stepsWithKinksAreHalved() {
        constexpr double step = 0.2;
        auto before = std::make_shared<double>(0);
        auto back = std::make_shared<int>(0);
        ExactSolution solution = [before, back](double t, std::span<double> x) {
            *back += t < *before * (1 - 1e-15);
            x[0] = std::abs(std::sin(3 * t));
            x[1] = std::cos(3 * t) * (std::sin(3 * t) > 0 ? 1 : -1);  // jumps with the kinks
        };
        solution.setStepAt([before](double t) {
            *before = std::max(*before, step * std::floor(t / step));
            return std::pair{*before, *before + step};
        });
        const auto table = TabulatedSolution::of(solution, 0, end, 2, 2, 1e-12, {});
        QVERIFY(table);
        int far = 0;
        double worst = 0, x[2], y[2];
        for (int i = 0; i < 20000; ++i) {
            const double t = end * (i + 0.5) / 20000;
            table->at(t, x);
            solution(t, y);
            worst = std::max(worst, std::abs(x[0] - y[0]));
            far += std::abs(x[1] - y[1]) > 1e-11;
        }
        qInfo("off by %.1e, jumps apart at %d of 20000", worst, far);
        QVERIFY(worst < 1e-11);
        QCOMPARE(far, 0);
    }
    /// A ball that bounces: the reference of its studies is integrated once.
    void impactsHaveATable() {
        const ReadScene read = readScene(findPreset("bouncing-ball")->json);
        const Reference reference = makeReference(*read.resolved, {});
        const double last = read.resolved->scene.end.value;
        const std::size_t width = read.resolved->initial.x.size();
        const auto table = TabulatedSolution::of(reference.make(), 0, last, width, width / 2, 1e-11, {});
        QVERIFY(table);
        const ExactSolution solution = reference.make();
        std::vector<double> x(width), y(width);
        double worst = 0;
        for (int i = 0; i <= 5000; ++i) {
            const double t = last * i / 5000;
            table->at(t, x.data());
            solution(t, y);
            for (std::size_t k = 0; k < width / 2; ++k) worst = std::max(worst, std::abs(x[k] - y[k]));
        }
        qInfo("%zu of %s: off by %.1e", width, reference.info.description.c_str(), worst);
        QVERIFY(worst < 1e-10);
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
