// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdicts of the fixed-point policy on sequences of corrections, most of them seen in steps of a stiff
/// spring.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/solve/fixed_point_policy.hpp"
#include "tests/tools/test.hpp"

namespace extremal::fixed_point_policy_test {
namespace {

using Policy = FixedPointPolicy<double>;
using Verdict = Policy::Verdict;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// The verdict on the last of the corrections, if all before it go on; else that which does not.
Verdict lastOf(double tolerance, const std::vector<double>& sizes, double noise = 0) {
    Policy policy(tolerance, 21, noise);
    Verdict verdict = Verdict::proceed;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        verdict = policy.judge(sizes[i]);
        if (verdict != Verdict::proceed && i + 1 < sizes.size()) return Verdict::notFinite;
    }
    return verdict;
}

}  // namespace

class FixedPointPolicyTest : public QObject {
    Q_OBJECT

private slots:
    void itEndsWhereTheNextSweepWouldChangeNothing() {
        QCOMPARE(lastOf(eps, {1e-4, 1e-9}), Verdict::proceed);
        // 1e-14 after 1e-9: the next would be 1e-19, a thousandth of the last place.
        QCOMPARE(lastOf(eps, {1e-4, 1e-9, 1e-14}), Verdict::converged);
        QCOMPARE(lastOf(eps, {1e-8, 1e-10, 1e-12, 1e-14}), Verdict::proceed);
        // One sweep that contracts far better than the one before promises nothing of the next.
        QCOMPARE(lastOf(eps, {1e-4, 1e-10, 5e-11, 1e-15}), Verdict::proceed);
        QCOMPARE(lastOf(eps, {0.0}), Verdict::converged);
        QCOMPARE(lastOf(eps, {1e-17}), Verdict::proceed);
    }
    void aToleranceEndsItEarlier() {
        QCOMPARE(lastOf(1e-12, {1e-4, 1e-8}), Verdict::proceed);
        QCOMPARE(lastOf(1e-12, {1e-4, 1e-8, 1e-12}), Verdict::converged);
        QCOMPARE(lastOf(1e-6, {0.1, 0.05, 0.025, 0.012, 0.006}), Verdict::proceed);
    }
    void sweepsThatShrinkByTurnsGoOnToRoundOff() {
        QCOMPARE(lastOf(eps, {0.12, 1.3e-2, 9.4e-4, 5.2e-5, 2.2e-6, 7.4e-8, 1.9e-9, 1.4e-11, 6.4e-12}),
                 Verdict::proceed);
        QCOMPARE(lastOf(eps, {0.35, 4.6e-2, 4.3e-3, 3.0e-4, 1.6e-5, 7.0e-7, 2.3e-8, 4.5e-10, 2.4e-10, 5.4e-11,
                              8.4e-12}),
                 Verdict::proceed);
        QCOMPARE(lastOf(eps, {4.8, 1.9, 0.75, 0.13, 1.5e-2}), Verdict::proceed);
    }
    void itIsSlowWhereRoundOffIsMoreThanTwentySweepsAway() {
        QCOMPARE(lastOf(eps, {0.1, 0.05, 0.02, 0.01}), Verdict::proceed);
        QCOMPARE(lastOf(eps, {0.1, 0.05, 0.02, 0.01, 0.005}), Verdict::slow);
        QCOMPARE(lastOf(eps, {0.1, 0.02, 4e-3, 8e-4, 1.6e-4}), Verdict::proceed);
        QCOMPARE(lastOf(eps, {0.1, 0.03, 9e-3, 3e-3, 9e-4}), Verdict::slow);
        QCOMPARE(lastOf(eps, {0.1, 0.2, 0.4, 0.8, 1.6}), Verdict::slow);
    }
    /// Where sweeps are cheap.
    void itIsSlowLaterWhereNewtonsMethodIsWorthMoreSweeps() {
        for (const double contraction : {0.2, 0.4, 0.5, 0.6, 1.5}) {
            Policy policy(eps, 60);
            Verdict verdict = Verdict::proceed;
            for (int sweep = 0; sweep < 5; ++sweep)
                verdict = policy.judge(0.1 * std::pow(contraction, sweep));
            QCOMPARE(verdict, contraction < 0.55 ? Verdict::proceed : Verdict::slow);
        }
    }
    void roundOffIsASuddenStallOrNoProgressInThreeSweeps() {
        QCOMPARE(lastOf(eps, {1e-11, 1e-13, 1.7e-15, 1.2e-15}), Verdict::converged);
        QCOMPARE(lastOf(eps, {1e-8, 4e-13, 2e-13}), Verdict::proceed);          // not so far above it
        QCOMPARE(lastOf(eps, {6e-15, 4e-15, 9e-16, 6e-16}), Verdict::proceed);  // nor where it was slow
        QCOMPARE(lastOf(eps, {1e-8, 4e-13, 3e-13, 2e-13, 1.5e-13}), Verdict::converged);
        // A contraction of 0.4 goes on.
        QCOMPARE(lastOf(eps, {1e-12, 4e-13, 1.6e-13, 6.4e-14, 2.6e-14, 1e-14, 4e-15, 1.6e-15}),
                 Verdict::proceed);
    }
    /// Where round-off leaves more than the last place, corrections end that twice do not halve, and none
    /// that contract by a third: seen in steps of a mechanism.
    void aKnownNoiseIsNotWaitedFor() {
        const double noise = 1e3 * eps;
        QCOMPARE(lastOf(eps, {1.5e-10, 6.1e-14, 6.6e-14, 7e-14}, noise), Verdict::converged);
        QCOMPARE(lastOf(eps, {1.5e-10, 6.1e-14, 6.6e-14, 7e-14}), Verdict::proceed);
        QCOMPARE(lastOf(eps, {1.5e-10, 6.1e-14, 6.6e-14}, noise), Verdict::proceed);
        QCOMPARE(lastOf(eps, {1e-12, 2e-13, 6e-14, 1.9e-14, 6e-15, 2e-15}, noise), Verdict::proceed);
        QCOMPARE(lastOf(eps, {1e-10, 5e-12, 4e-12, 3.5e-12}, noise), Verdict::proceed);  // too far above it
    }
    void whatIsOneRootIsNearOrContracts() {
        QVERIFY(isOneRoot(0.2, 0.1, 0) && !isOneRoot(0.3, 0.1, 0));
        QVERIFY(isOneRoot(2, 1e-4, 4) && !isOneRoot(2, 1e-4, 5));
        QVERIFY(!isOneRoot(2, 1e-3, 5, 0.1) && isOneRoot(2, 1e-3, 5, 0.25));
    }
    void pausesGrowWhereSweepsGoOnFailing() {
        SweepPause pause;
        const auto leftOut = [&] {
            pause.after(Outcome::diverged);
            int steps = 0;
            while (!pause.isOver()) ++steps;
            return steps;
        };
        for (const int expected : {0, 1, 2, 4, 8, 16, 32, 32}) QCOMPARE(leftOut(), expected);
        pause.after(Outcome::stopped);  // says nothing of the steps
        QCOMPARE(leftOut(), 32);
        pause.after(Outcome::converged);
        QCOMPARE(leftOut(), 0);
    }
    void aCorrectionBeyondTheIncrementsPromisesNothing() {
        QCOMPARE(lastOf(eps, {7e17, 1.3}), Verdict::proceed);
        QCOMPARE(lastOf(eps, {0.9, 1e-18}), Verdict::converged);
    }
    void buriedCoordinatesEndOnceTheyNoLongerHalve() {
        const auto sweepsOf = [](double contraction, bool areNegligible = false) {
            Policy policy(eps);
            double buried = 1;
            for (int sweep = 1; sweep <= 200; ++sweep, buried *= contraction) {
                const double size = std::pow(0.05, sweep);
                const Verdict verdict = policy.judge(std::max(size, buried), [&] {
                    return CorrectionSize<double>{size, buried, areNegligible};
                });
                if (verdict == Verdict::converged) return sweep;
                if (verdict != Verdict::proceed) return -sweep;
            }
            return 0;
        };
        QVERIFY(sweepsOf(1) > 5 && sweepsOf(1) < 20);
        QVERIFY(sweepsOf(0.8) > 150);  // a light body that converges slowly goes on to round-off
        // One that would be at round-off with the largest mass is not waited for.
        QVERIFY(sweepsOf(0.8, true) > 5 && sweepsOf(0.8, true) <= sweepsOf(1));
    }
    void whatIsNotFiniteIsSaid() {
        QCOMPARE(lastOf(eps, {0.1, std::nan("")}), Verdict::notFinite);
        QCOMPARE(lastOf(eps, {0.1, std::numeric_limits<double>::infinity()}), Verdict::notFinite);
    }
};

EXTREMAL_TEST(FixedPointPolicyTest)
}  // namespace extremal::fixed_point_policy_test

#include "fixed_point_policy_test.moc"
