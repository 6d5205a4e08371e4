// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines that keep the energy, or choose their steps, without a discrete energy: what they keep,
/// measured.
#include <QTest>

#include <array>
#include <cmath>

#include "tests/laws/laws.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::energy_baselines_test {
namespace {

using namespace extremal::laws;

std::unique_ptr<Integrator> make(const char* id, const System& system, double h, int points = 3) {
    const BaselineEntry* const entry = findBaseline(id);
    Settings keys = defaultsOf(entry->item);
    for (auto& [key, value] : keys.keys)
        if (key == "points") value = static_cast<double>(points);
    return entry->make(system, {h, {}, 0, keys});
}
System duffing() {
    return systemNamed("lagrangian",
                       {{"coordinates", Value::Array{"q"}}, {"lagrangian", "q_t^2/2 - q^2/2 - q^4/4"}});
}

/// The largest change of the energy.
double energyError(Integrator& integrator, const System& system, State state, int steps) {
    const EnergyFunction H = energyOf(system);
    const double start = H(0, state.x.data());
    integrator.begin(state);
    double worst = 0;
    for (int k = 0; k < steps; ++k) {
        if (advance(integrator, state).outcome != Outcome::converged) return 1e300;
        worst = std::max(worst, std::abs(H(state.t, state.x.data()) - start));
    }
    return worst;
}

}  // namespace

class EnergyBaselinesTest : public QObject {
    Q_OBJECT
private slots:
    /// Two points are exact for a quartic, one is the midpoint rule. Kepler is not a polynomial: 2n + 1
    /// orders.
    void theAverageVectorFieldKeepsAQuarticEnergy() {
        const System quartic = duffing(), kepler = systemNamed("kepler");
        const State start{0, 0, {1.5, 0}};
        for (const int points : {1, 2, 3}) {
            const double error =
                energyError(*make("average-vector-field", quartic, 0.1, points), quartic, start, 2000);
            qInfo("%d points: %.1e", points, error);
            if (points == 1)
                QVERIFY(error > 1e-3);
            else
                QVERIFY(error < 2e-13);  // measured: 1.2e-14
        }
        const double coarse =
                         energyError(*make("average-vector-field", kepler, 0.02), kepler, keplerStart, 200),
                     fine =
                         energyError(*make("average-vector-field", kepler, 0.01), kepler, keplerStart, 400);
        qInfo("Kepler: %.1e, with half the step %.1e", coarse, fine);
        QVERIFY(coarse / fine > 40);  // measured: 2^6 and more
    }
    void projectionKeepsTheEnergyAndNotTheAngularMomentum() {
        const System kepler = systemNamed("kepler");
        const auto integrator = make("projected", kepler, 0.05);
        const double energy = energyError(*integrator, kepler, keplerStart, 2000);
        State state = keplerStart;
        integrator->begin(state);
        for (int k = 0; k < 2000; ++k) QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
        const double momentum = std::abs(state.x[0] * state.x[3] - state.x[1] * state.x[2] - 0.8);
        qInfo("energy %.1e, angular momentum %.1e", energy, momentum);
        QVERIFY(energy < 5e-15);   // measured: 1.3e-15
        QVERIFY(momentum > 1e-5);  // measured: 9e-5
    }
    void transformedStepsFollowTheDensity() {
        const System kepler = systemNamed("kepler");
        const auto integrator = make("time-transformed", kepler, 0.05);
        State state = keplerStart;
        integrator->begin(state);
        double shortest = 1e300, longest = 0, momentum = 0;
        for (int k = 0; k < 500; ++k) {
            const StepReport report = integrator->advance(state, 1e9);
            QCOMPARE(report.outcome, Outcome::converged);
            shortest = std::min(shortest, report.step);
            longest = std::max(longest, report.step);
            momentum = std::max(momentum, std::abs(state.x[0] * state.x[3] - state.x[1] * state.x[2] - 0.8));
        }
        qInfo("steps from %.3f to %.3f, angular momentum by %.1e", shortest, longest, momentum);
        QVERIFY(longest / shortest > 5);
        QVERIFY(momentum < 1e-12);
    }
    /// That of the midpoint rule: with the unsigned density its leading error is not constant.
    void transformedStepsHaveOrderTwoOverTheMeanStep() {
        const System kepler = systemNamed("kepler");
        const ExactSolution exact = kepler.exact(keplerStart);
        std::vector<double> x, y, known(4);
        for (const double h : {0.02, 0.01, 0.005}) {
            const auto integrator = make("time-transformed", kepler, h);
            State state = keplerStart;
            integrator->begin(state);
            double error = 0;
            while (state.t < 3) {
                QCOMPARE(integrator->advance(state, 3).outcome, Outcome::converged);
                exact(state.t, known);
                error = std::max(error, distance(state.x, known, 0, 4));
            }
            x.push_back(std::log(state.t / static_cast<double>(state.node)));
            y.push_back(std::log(error));
        }
        const double order = slope(x, y);
        qInfo("order %.3f", order);
        QVERIFY(std::abs(order - 2) < 0.1);
    }
    /// With what it remembers fixed the map of a step is symplectic.
    void theTransformedStepIsSymplectic() {
        const System kepler = systemNamed("kepler");
        State start = keplerStart;
        make("time-transformed", kepler, 0.1)->begin(start);
        const auto step = [&](State from) -> std::optional<State> {
            if (make("time-transformed", kepler, 0.1)->advance(from, 1).outcome != Outcome::converged)
                return std::nullopt;
            return from;
        };
        const Jacobian M = jacobianOf(step, start, 5e-4).value();
        const double defect = symplecticDefect(M), largest = largestEntry(M);
        qInfo("defect %.1e, largest entry %.1f", defect, largest);
        QVERIFY(defect < 1e-8);
    }
    void aDensityThatVanishesIsRefused() {
        const System particle =
            systemNamed("lagrangian", {{"coordinates", Value::Array{"q"}}, {"lagrangian", "q_t^2/2"}});
        State state{0, 0, {0, 1}};
        QCOMPARE(make("time-transformed", particle, 0.1)->advance(state, 1).outcome, Outcome::refused);
    }
};

EXTREMAL_TEST(EnergyBaselinesTest)
}  // namespace extremal::energy_baselines_test

#include "energy_baselines_test.moc"
