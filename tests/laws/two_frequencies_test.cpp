// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps over two fast oscillations without a common period, and what is left of round-off in stiff steps.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::two_frequencies_test {
namespace {

/// The preset of two springs, with edits of its text.
Comparison twoSprings(const std::vector<std::pair<std::string, std::string>>& edits = {}) {
    std::string text = std::string(findPreset("two-frequencies")->json);
    for (const auto& [from, to] : edits) {
        std::size_t at = text.find(from);
        if (at == std::string::npos) throw std::runtime_error("no \"" + from + "\" in the preset");
        for (; at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    }
    const ReadScene read = readScene(text);
    if (!read.errors.empty())
        throw std::runtime_error(read.errors[0].pointer + ": " + read.errors[0].message);
    return run(read.scene);
}

double largest(const Comparison& c, std::size_t scheme, const char* column) {
    double worst = 0;
    for (const double x : c.schemes[scheme]->trajectory[column]) worst = std::max(worst, std::abs(x));
    return worst;
}

}  // namespace

class TwoFrequenciesTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { asItIs_ = twoSprings(); }
    void bothAreSteppedOver() {
        // 25 periods of the one and 10 of the other in a step; the reference resolves them.
        const Comparison& c = asItIs_;
        const double rich = largest(c, 0, "error"), plain = largest(c, 1, "error"),
                     polynomial = largest(c, 2, "error");
        qInfo("error: second order %.1e, first %.1e, polynomial %.1e", rich, plain, polynomial);
        QVERIFY(rich < 2e-12);
        QVERIFY(plain < 1e-7 && plain > 1e-9);
        QVERIFY(polynomial > 1e-3);
    }
    void oneFrequencyIsNotEnough() {
        const Comparison c = twoSprings({{"\"enabled\": false, ", ""}});
        QCOMPARE(c.schemes.size(), std::size_t(4));
        const bool isLost =
            c.schemes[2]->summary.status == RunStatus::failed || largest(c, 2, "error") > 1e-2;
        QVERIFY(isLost);
    }
    void theCostDoesNotDependOnTheStiffness() {
        // k = 1e10: 2500 and 1000 periods in a step. No resolved reference: the scheme at half the step.
        const Comparison c = twoSprings(
            {{"\"k\": 1e6", "\"k\": 1e10"},
             {"\"label\": \"resolved\", \"step\": 0.00049, \"scheme\": \"galerkin-gauss-8\"",
              "\"label\": \"half\", \"step\": 0.049, \"space\": { \"type\": \"oscillatory\", \"omega\": "
              "[\"1.618033988749895*sqrt(k/m)\", \"0.618033988749895*sqrt(k/m)\"], \"degree\": 7, "
              "\"harmonics\": [3] }"}});
        const auto evaluations = [](const Comparison& run) {
            return static_cast<double>(run.schemes[0]->summary.cost.evaluations);
        };
        const double soft = evaluations(asItIs_), stiff = evaluations(c);
        qInfo("error %.1e, evaluations %g against %g", largest(c, 0, "error"), stiff, soft);
        QVERIFY(largest(c, 0, "error") < 1e-11);
        // 1.5: four iterations per step in place of three, where a resolved run would take a hundred times
        // the steps.
        QVERIFY(stiff < 2 * soft);
    }
    void energiesOfStiffStepsDoNotDrift() {
        // What 12 starts gain or lose in 4000 steps at k = 1e12: 40,000 fast periods per step.
        const double k = 1e12, h = 0.25;
        const System s = systemNamed("spring-pendulum", {{"k", k}});
        const auto energy = energyOf(s);
        double sum = 0, squares = 0, early = 0;
        const int starts = 12, steps = 4000;
        for (int i = 0; i < starts; ++i) {
            const auto integrator = makeIntegrator(s, *namedScheme("multiscale-r2"), {0, h});
            State state{0, 0, {0.05 * std::sqrt(1e4 / k) * (1 + 1e-3 * i), 1 + 1e-3 * i, 0, 0}};
            const double start = energy(state.t, state.x.data());
            for (int n = 1; n <= steps; ++n) {
                QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
                if (n == steps / 10) early += std::pow(energy(state.t, state.x.data()) - start, 2);
            }
            const double change = energy(state.t, state.x.data()) - start;
            sum += change;
            squares += change * change;
        }
        const double rms = std::sqrt(squares / starts), mean = std::abs(sum / starts),
                     before = std::sqrt(early / starts);
        qInfo("mean %.1e, rms %.1e, at a tenth of the steps %.1e", mean, rms, before);
        // A random walk: its mean is rms / sqrt(12) by chance, and it grows by sqrt(10). Seen failing with
        // slopes of the test functions that are one rounding off those of the trial functions: mean 2.6e-8,
        // rms 3.0e-8, 4.2e-9 at a tenth.
        QVERIFY(mean < 3 * rms / std::sqrt(starts));
        QVERIFY(rms < 6 * before);
        QVERIFY(rms < 1e-7);
    }

private:
    Comparison asItIs_;
};

EXTREMAL_TEST(TwoFrequenciesTest)
}  // namespace extremal::laws::two_frequencies_test

#include "two_frequencies_test.moc"
