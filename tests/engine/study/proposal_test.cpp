// SPDX-License-Identifier: GPL-3.0-or-later
/// What is proposed for a wanted error, of points that are made up: errors and costs that are powers of the
/// step, for which the interpolation is exact.
#include <QTest>

#include <cmath>

#include "engine/scene/write/codec.hpp"
#include "engine/study/search/proposal.hpp"
#include "tests/tools/test.hpp"

namespace extremal::proposal_test {
namespace {

Sweep sweepOfTwo() {
    const ReadScene read = readScene(std::string_view(
        R"json({"extremal": 1, "model": {"type": "harmonic-oscillator"}, "initial": {"q": [1]},
                "time": {"end": 1}, "schemes": [{"label": "slow", "scheme": "midpoint", "step": 0.1},
                {"label": "fast", "scheme": "galerkin-gauss-2", "step": 0.1}]})json"));
    SweepOptions options;
    options.ladder.steps = {0.25, 0.125, 0.0625};
    return {*read.resolved, options};
}

/// error = c h^p, cpu = d/h; points of one scheme.
void fill(Sweep& sweep, std::size_t scheme, double c, double p, double d) {
    for (std::size_t i = 0; i < sweep.size(); ++i) {
        if (sweep.rows()[i].point.scheme != scheme) continue;
        PointResult r;
        r.status = RunStatus::done;
        r.step = sweep.rows()[i].point.step;
        r.error = c * std::pow(r.step, p);
        r.cpuSeconds = d / r.step;
        sweep.take(i, r);
    }
}

}  // namespace

class ProposalTest : public QObject {
    Q_OBJECT
private slots:
    void stepsAndCostsAreInterpolated() {
        Sweep sweep = sweepOfTwo();
        fill(sweep, 0, 1, 2, 1e-6);
        fill(sweep, 1, 1, 4, 5e-6);
        const double wanted = 0.01;  // h = 0.1 and 0.316: the second is beyond its ladder
        const std::vector<Proposal> all = proposalsFor(sweep, wanted);
        QCOMPARE(all.size(), std::size_t(2));
        QCOMPARE(all[0].scheme, std::size_t(0));
        QVERIFY(std::abs(all[0].step - 0.1) < 1e-12);
        QVERIFY(std::abs(all[0].predictedSeconds - 1e-5) < 1e-17);
        QVERIFY(sweep.rows()[all[0].row].result.error <= wanted);
        QCOMPARE(all[1].step, 0.25);  // not extrapolated
        QVERIFY(std::abs(all[1].predictedSeconds - 2e-5) < 1e-17);
    }
    void aWholeNumberOfStepsMakesUpTheRun() {
        Sweep sweep = sweepOfTwo();
        fill(sweep, 0, 1, 2, 1e-6);
        const std::vector<Proposal> all = proposalsFor(sweep, 0.012);  // h = 0.1095
        QCOMPARE(all.size(), std::size_t(1));
        QVERIFY(std::abs(all[0].step - 0.1) < 1e-12);
        QVERIFY(std::abs(all[0].predictedSeconds - 1e-6 / std::sqrt(0.012)) < 1e-15);
    }
    void whatDoesNotReachItIsNotProposed() {
        Sweep sweep = sweepOfTwo();
        fill(sweep, 0, 1, 2, 1e-6);
        QVERIFY(proposalsFor(sweep, 1e-3).empty());
        QVERIFY(proposalsFor(sweepOfTwo(), 1).empty());
    }
};

EXTREMAL_TEST(ProposalTest)
}  // namespace extremal::proposal_test

#include "proposal_test.moc"
