// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdicts of the Newton policy on made-up sequences of corrections, and the ladder of starting values.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/solve/contraction.hpp"
#include "engine/solve/newton_policy.hpp"
#include "tests/tools/test.hpp"

namespace extremal::newton_policy_test {
namespace {

using Limits = NewtonLimits<double>;
using Policy = NewtonPolicy<double>;
using Verdict = Policy::Verdict;

/// The verdict on the last of the corrections; all before it go on.
Verdict lastOf(Limits limits, const std::vector<double>& sizes) {
    Policy policy(limits);
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
        const Verdict verdict = policy.judge(sizes[i]);
        if (verdict == Verdict::slow) policy.jacobianIsNew();
        if (verdict != Verdict::proceed && verdict != Verdict::slow) return Verdict::notFinite;
    }
    return policy.judge(sizes.back());
}

}  // namespace

class NewtonPolicyTest : public QObject {
    Q_OBJECT
    const double eps_ = std::numeric_limits<double>::epsilon();

private slots:
    void itEndsAtTheTolerance() {
        const Limits limits = Limits::condensedStep(1e-8, true);
        QCOMPARE(lastOf(limits, {1e-3, 1e-6}), Verdict::proceed);
        QCOMPARE(lastOf(limits, {1e-3, 1e-6, 1e-8}), Verdict::converged);
        QCOMPARE(toleranceOf<double>({SolverMethod::automatic, 0, 50}), eps_);
        QCOMPARE(toleranceOf<double>({SolverMethod::automatic, 1e-20, 50}), eps_);
        QCOMPARE(toleranceOf<double>({SolverMethod::automatic, 1e-8, 50}), 1e-8);
    }
    void aCorrectionThatNoLongerShrinksNearRoundOffIsTheLast() {
        const Limits limits = Limits::condensedStep(eps_, true);
        QCOMPARE(lastOf(limits, {1e-3, 1e-13, 0.5e-13}), Verdict::converged);
        QCOMPARE(lastOf(limits, {1e-3, 1e-13, 0.2e-13}), Verdict::proceed);
        QCOMPARE(lastOf(limits, {1e-3, 1e-9, 0.5e-9}), Verdict::slow);
        // Two digits further away only at the third time.
        QCOMPARE(lastOf(limits, {1e-3, 1e-11, 0.9e-11, 0.8e-11}), Verdict::proceed);
        QCOMPARE(lastOf(limits, {1e-3, 1e-11, 0.9e-11, 0.8e-11, 0.7e-11}), Verdict::converged);
    }
    void theJacobianIsRenewedWhereItContractsSlowlyOrWasMadeElsewhere() {
        const Limits limits = Limits::condensedStep(eps_, true);
        QCOMPARE(lastOf(limits, {0.2}), Verdict::slow);
        QCOMPARE(lastOf(limits, {0.05}), Verdict::proceed);
        QCOMPARE(lastOf(limits, {0.05, 0.01}), Verdict::slow);
        QCOMPARE(lastOf(limits, {0.05, 0.004}), Verdict::proceed);
        QCOMPARE(lastOf(Limits::lieStep(eps_), {0.2}), Verdict::proceed);
    }
    void growingAndPoorStartsAreGivenUp() {
        QCOMPARE(lastOf(Limits::condensedStep(eps_, true), {1.5}), Verdict::slow);
        QCOMPARE(lastOf(Limits::condensedStep(eps_, false), {1.5}), Verdict::diverged);
        QCOMPARE(lastOf(Limits::condensedStep(eps_, true), {0.1, 0.2, 0.3, 0.4}), Verdict::slow);
        QCOMPARE(lastOf(Limits::condensedStep(eps_, true), {0.1, 0.2, 0.3, 0.4, 0.5}), Verdict::diverged);
        QCOMPARE(lastOf(Limits::productStep(), {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}), Verdict::slow);
        QCOMPARE(lastOf(Limits::dense(), {0.1, std::nan("")}), Verdict::notFinite);
        QCOMPARE(lastOf(Limits::dense(), {0.1, std::numeric_limits<double>::infinity()}), Verdict::notFinite);
    }
    void correctionsForetellTheNext() {
        const auto after = [](double tolerance, const std::vector<std::pair<double, double>>& sizes) {
            Contraction<double> contraction(Limits::mechanismStep(tolerance));
            for (const auto& [size, nonlinear] : sizes) contraction.take(size, nonlinear, 7 * nonlinear);
            return contraction;
        };
        // The first correction says nothing; the second one how much smaller the third would be.
        QVERIFY(!after(1e-9, {{1e-12, 1e-12}}).isLast());
        QVERIFY(!after(1e-9, {{1e-2, 1e-2}, {1e-5, 1e-5}}).isLast());
        QVERIFY(after(1e-7, {{1e-2, 1e-2}, {1e-5, 1e-5}}).isLast());
        QCOMPARE(after(4e-17, {{1e-2, 1e-2}, {1e-5, 1e-5}}).left(), 3.0);  // to 1e-17 from 1e-8
        // A linear part that was far away is no sign of a small ratio.
        QVERIFY(after(1e-9, {{1, 1}, {1e-6, 1e-6}}).isLast());
        QVERIFY(!after(1e-9, {{1, 1e-4}, {1e-6, 1e-6}}).isLast());
        // Round-off does not shrink: the ratio is that of the corrections above it.
        QVERIFY(after(eps_, {{1e-2, 1e-2}, {1e-7, 1e-7}, {1e-12, 1e-12}}).isLast());
        QVERIFY(after(eps_, {{1e-2, 1e-2}, {1e-6, 1e-6}, {1e-10, 1e-10}, {5e-13, 5e-13}}).isLast());
        // A coordinate at rest has relative corrections of any size.
        Contraction<double> contraction(Limits::mechanismStep(1e-9));
        contraction.take(1e8, 1e8, 1e-2);
        contraction.take(1e-6, 1e-6, 1e-4);
        QVERIFY(!contraction.isLast());
        // Where nothing shrinks there is nothing to foretell.
        QCOMPARE(after(eps_, {{1e-2, 1e-2}, {1e-2, 1e-2}}).left(), 0.0);
    }
    void lightAxesEndAtTheirFloorWithANewJacobian() {
        Policy policy(Limits::lieStep(eps_));
        QCOMPARE(policy.judge(1e-8), Verdict::proceed);
        QVERIFY(!policy.isJacobianNew());
        policy.jacobianIsNew();
        QCOMPARE(policy.judge(0.9e-8, 1e-7), Verdict::converged);
    }
    void correctionsAreMeasuredAgainstIncrementsAndRoundOff() {
        QCOMPARE(relativeCorrection(1e-3, 1e-1, 5.0), 1e-2);
        QCOMPARE(relativeCorrection(eps_, 0.0, 1.0), 1.0);        // a unit of the last place of the value
        QCOMPARE(relativeCorrection(eps_ / 200, 0.0, 1.0), 0.0);  // below a hundredth of it
        QCOMPARE(relativeCorrection(1e-300, 0.0, 0.0), 1.0);
        QVERIFY(std::isinf(relativeCorrection(std::nan(""), 1.0, 1.0)));
    }
    /// The third coordinate is kept at rest by a symmetry; the metric is that of the kinetic energy.
    void smallCoordinatesAreBuriedByTheMetric() {
        const auto sizeOf = [](double change, double mass, double impulse) {
            const CoordinateCorrection<double> all[] = {
                {1e-20, 0.1, 1, 1, 0.1}, {1e-20, 3e-3, 1, 100, impulse}, {change, 2 * change, 0, mass, 0}};
            return measureCorrection<double>(3, [&](int k) { return all[k]; });
        };
        // Below 100 eps of 10 |q_2|, and above it.
        QCOMPARE(sizeOf(200 * eps_, 1, 0).buried, 0.5);
        QCOMPARE(sizeOf(200 * eps_, 1, 0).size, 0.0);
        QCOMPARE(sizeOf(2000 * eps_, 1, 0).size, 0.5);
        // The same length is more for a heavier body, and less beside a larger momentum.
        QCOMPARE(sizeOf(200 * eps_, 1e4, 0).size, 0.5);
        QCOMPARE(sizeOf(2000 * eps_, 1, 1e4).buried, 0.5);
        QCOMPARE(sizeOf(200 * eps_, 0, 0).size, 0.5);  // a mass that is not known
    }
    void buriedCoordinatesEndWithANewJacobianOnceTheyStall() {
        Policy policy(Limits::condensedStep(eps_, true));
        const auto judge = [&](double size, double buried) {
            return policy.judge(std::max(size, buried), [&] { return CorrectionSize<double>{size, buried}; });
        };
        QCOMPARE(judge(1e-2, 0.9), Verdict::slow);
        policy.jacobianIsNew();
        QCOMPARE(judge(1e-6, 0.7), Verdict::proceed);   // stalled: from here on apart
        QCOMPARE(judge(1e-16, 0.1), Verdict::proceed);  // still shrinks
        QCOMPARE(judge(1e-16, 0.08), Verdict::slow);    // does not, but the Jacobian is old
        policy.jacobianIsNew();
        QCOMPARE(judge(1e-16, 0.01), Verdict::proceed);
        policy.jacobianIsNew();
        QCOMPARE(judge(1e-16, 0.012), Verdict::converged);
    }
    void startingValuesGoDownTheLadderAndBack() {
        StartingLadder ladder;
        QCOMPARE(ladder.begin(false), StartingValue::fallback);
        QCOMPARE(ladder.begin(true), StartingValue::extrapolated);
        QCOMPARE(ladder.below(StartingValue::extrapolated, true), StartingValue::previous);
        QCOMPARE(ladder.below(StartingValue::previous, true), StartingValue::fallback);
        QCOMPARE(ladder.below(StartingValue::extrapolated, false), StartingValue::fallback);
        for (int i = 0; i < 15; ++i) QCOMPARE(ladder.begin(true), StartingValue::fallback);
        QCOMPARE(ladder.begin(true), StartingValue::extrapolated);
    }
};

EXTREMAL_TEST(NewtonPolicyTest)
}  // namespace extremal::newton_policy_test

#include "newton_policy_test.moc"
