// SPDX-License-Identifier: GPL-3.0-or-later
/// When the loop of plain corrections ends: at round-off, where corrections stall, where they shrink too
/// slowly, and with what keeps one from being made.
#include <QTest>

#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "engine/core/corrections.hpp"
#include "tests/tools/test.hpp"

namespace extremal::corrections_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Corrections of given sizes, against 1; the last one goes on.
Outcome after(const std::vector<double>& sizes, const CorrectionLimits& limits, StepReport& report) {
    return solveByCorrections(limits, {}, report, [&](int i, double) {
        return Correction{sizes[std::min(static_cast<std::size_t>(i), sizes.size() - 1)], 1};
    });
}

}  // namespace

class CorrectionsTest : public QObject {
    Q_OBJECT
private slots:
    void endsAtRoundOff() {
        StepReport report;
        QVERIFY(after({1e-2, 1e-5, 1e-11, epsilon}, {}, report) == Outcome::converged);
        QCOMPARE(report.cost.iterations, 4LL);
        QCOMPARE(report.residual, epsilon);
    }
    /// Ill-conditioned equations stay at some multiple of round-off.
    void endsWhereCorrectionsStall() {
        StepReport report;
        QVERIFY(after({1e-2, 1e-6, 1e-13, 0.8e-13, 0.7e-13}, {}, report) == Outcome::converged);
        QCOMPARE(report.cost.iterations, 4LL);
        StepReport far;  // as slowly, but far from round-off
        QVERIFY(after({1e-2, 1e-6, 1e-6}, {}, far) == Outcome::diverged);
        QCOMPARE(far.cost.iterations, 50LL);
    }
    void givesUpASlowContraction() {
        StepReport report;
        CorrectionLimits limits;
        limits.slow = 0.7;
        QVERIFY(after({1, 0.9, 0.8, 0.7, 0.6, 0.5}, limits, report) == Outcome::diverged);
        QCOMPARE(report.cost.iterations, 5LL);
    }
    void entriesMustBeSettledToo() {
        StepReport report;
        const Outcome outcome = solveByCorrections({}, {}, report, [](int i, double) {
            return Correction{0, 1, i == 2};
        });
        QVERIFY(outcome == Outcome::converged);
        QCOMPARE(report.cost.iterations, 3LL);
    }
    void troubleEndsIt() {
        StepReport report;
        QVERIFY(after({1e-2, std::nan("")}, {}, report) == Outcome::notFinite);
        const auto singular = [](int, double) { return Correction{.outcome = Outcome::singular}; };
        QVERIFY(solveByCorrections({}, {}, report, singular) == Outcome::singular);
        std::stop_source stop;
        stop.request_stop();
        QVERIFY(solveByCorrections({}, stop.get_token(), report, singular) == Outcome::stopped);
    }
    /// Newton's method keeps its Jacobian while it contracts.
    void saysHowItContracts() {
        StepReport report;
        double x = 1.5, slope = 0;
        int jacobians = 0;
        const Outcome outcome = solveByCorrections({}, {}, report, [&](int i, double ratio) {
            if (i == 0 || ratio > 0.1) slope = 2 * x, ++jacobians;
            const double change = (2 - x * x) / slope;
            x += change;
            return Correction{std::abs(change), x};
        });
        QVERIFY(outcome == Outcome::converged);
        QVERIFY(std::abs(x - std::sqrt(2.0)) < 4e-16);
        QVERIFY(jacobians >= 1 && jacobians < report.cost.iterations);
    }
};

EXTREMAL_TEST(CorrectionsTest)
}  // namespace extremal::corrections_test

#include "corrections_test.moc"
