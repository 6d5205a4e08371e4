// SPDX-License-Identifier: GPL-3.0-or-later
/// The modified energy of symplectic schemes: constant far beyond the energy; of others not.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/integrator/composition.hpp"
#include "engine/observe/modified_energy.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::modified_energy_test {
namespace {

using Form = ModifiedEnergyForm;

struct Values {
    std::vector<double> all;
    double range() const {
        const auto [low, high] = std::minmax_element(all.begin(), all.end());
        return *high - *low;
    }
    /// Difference of the medians of the halves.
    double drift() const {
        const auto median = [](std::vector<double> part) {
            std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2),
                             part.end());
            return part[part.size() / 2];
        };
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        return std::abs(median({middle, all.end()}) - median({all.begin(), middle}));
    }
};

/// H_h along a run; r = 0: the energy itself.
Values along(const System& system, Integrator& integrator, std::vector<double> x, double end, Form form,
             int r, int order = 0) {
    const auto d = static_cast<std::size_t>(system.dimension());
    const auto said = integrator.quantities();
    const auto action = indexOf(said, "action"), discrete = indexOf(said, "discrete_energy");
    std::vector<double> values(said.size());
    const EnergyFunction energy = energyOf(system);
    ModifiedEnergyWindow window(form, r, system.dimension(), integrator.stepSize());
    State state{0, 0, std::move(x), {}};
    double last = energy(0, state.x.data());
    Values found;
    if (r > 0) (void)window.next(state.x.data(), state.x.data() + d, 0);
    while (state.t < end - 1e-9) {
        if (advance(integrator, state).outcome != Outcome::converged) throw std::logic_error("a step failed");
        integrator.measure(state, values.data());
        const double now = energy(0, state.x.data()), before = std::exchange(last, now);
        double value = now;
        if (form == Form::local && order > 0)
            value = localModifiedEnergy(order, before, now, values.at(*discrete));
        else if (r > 0)
            value = window.next(state.x.data(), state.x.data() + d, values.at(*action));
        if (std::isfinite(value)) found.all.push_back(value);
    }
    return found;
}
std::unique_ptr<Integrator> baseline(const char* id, const System& system, double step) {
    return findBaseline(id)->make(system, {step, {0, 0, {}, {}}, 0, {}});
}
std::unique_ptr<Integrator> scheme(const char* id, const System& system, double step) {
    return makeIntegrator(system, *namedScheme(id), {0, step});
}
const std::vector<double> keplerX = laws::keplerStart.x;

}  // namespace

class ModifiedEnergyTest : public QObject {
    Q_OBJECT
private slots:
    void verletKeepsItOnAPlanetsOrbit() {
        const System kepler = laws::systemNamed("kepler");
        const auto values = [&](const char* id, int r) {
            return along(kepler, *baseline(id, kepler, 0.025), keplerX, 200, Form::legendre, r);
        };
        const Values H = values("stormer-verlet", 0), four = values("stormer-verlet", 2),
                     eight = values("stormer-verlet", 4), most = values("stormer-verlet", 12);
        QVERIFY(H.range() > 1e-3);       // measured: 2.3e-3
        QVERIFY(most.range() <= 2e-11);  // measured: 4.4e-12
        // Round-off, 2e-15 to 2e-14 as the start has it: the middle one of five.
        std::vector<double> drifts;
        for (int i = 0; i < 5; ++i) {
            std::vector<double> x = keplerX;
            x[3] += 1e-4 * i;
            drifts.push_back(
                along(kepler, *baseline("stormer-verlet", kepler, 0.025), x, 200, Form::legendre, 12)
                    .drift());
        }
        std::nth_element(drifts.begin(), drifts.begin() + 2, drifts.end());
        QVERIFY(drifts[2] <= 1e-14);                   // measured: 3.9e-15
        QVERIFY(eight.range() < 1e-2 * four.range());  // measured: 8.9e-8 and 2.4e-5
        // Without a generating function there is no such energy.
        const Values rk4 = values("rk4", 12);
        QVERIFY(rk4.drift() > 1e-6);  // measured: 1.7e-5
    }
    void theGalerkinFormOfVerletSaysTheSame() {
        const System kepler = laws::systemNamed("kepler");
        for (const Form form : {Form::legendre, Form::homogeneous}) {
            const Values a = along(kepler, *baseline("stormer-verlet", kepler, 0.025), keplerX, 10, form, 6);
            const Values b =
                along(kepler,
                      *makeIntegrator(kepler, laws::polynomialPair(1, {"lobatto", {{"nodes", 2.0}}, {}}),
                                      {0, 0.025}),
                      keplerX, 10, form, 6);
            QCOMPARE(a.all.size(), b.all.size());
            double worst = 0;
            for (std::size_t k = 0; k < a.all.size(); ++k)
                worst = std::max(worst, std::abs(a.all[k] - b.all[k]));
            QVERIFY(worst < 1e-13);  // measured: 1.2e-14
        }
    }
    void actionsOfCompositionsAdd() {
        const System kepler = laws::systemNamed("kepler");
        const Settings yoshida{"yoshida", {{"order", 4.0}}, {}};
        const auto composition =
            composed(compositionParts(yoshida, 2), *baseline("stormer-verlet", kepler, 0.025));
        const Values H = along(kepler, *composition->clone(), keplerX, 100, Form::legendre, 0),
                     Hh = along(kepler, *composition->clone(), keplerX, 100, Form::legendre, 12);
        QVERIFY(H.range() > 1e-6);    // measured: 2.0e-5
        QVERIFY(Hh.range() < 1e-11);  // measured: 2.9e-12
    }
    void theHomogeneousFormIsTheNarrowerOneOfOscillations() {
        const System henonHeiles = laws::systemNamed("henon-heiles");
        const std::vector<double> x{0, -0.25, 0.42081, 0};
        const auto values = [&](Form form, int r) {
            return along(henonHeiles, *baseline("stormer-verlet", henonHeiles, 0.25), x, 300, form, r)
                .range();
        };
        QVERIFY(values(Form::legendre, 0) > 1e-3);
        QVERIFY(values(Form::homogeneous, 12) < 1e-8);  // measured: 2.2e-9, Legendre 1.5e-8
        QVERIFY(values(Form::homogeneous, 12) < 0.5 * values(Form::legendre, 12));
    }
    void insideLongStepsItGainsTwoOrders_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("step");
        QTest::newRow("Verlet, pendulum") << "pendulum"
                                          << "galerkin-lobatto-1" << 2 << 0.1;
        QTest::newRow("midpoint, pendulum") << "pendulum"
                                            << "midpoint" << 2 << 0.1;
        QTest::newRow("Gauss 2, pendulum") << "pendulum"
                                           << "galerkin-gauss-2" << 4 << 0.1;
        QTest::newRow("Gauss 2, Kepler") << "kepler"
                                         << "galerkin-gauss-2" << 4 << 0.05;
    }
    void insideLongStepsItGainsTwoOrders() {
        QFETCH(QString, model);
        QFETCH(QString, id);
        QFETCH(int, order);
        QFETCH(double, step);
        const System system = laws::systemNamed(model.toStdString());
        const std::vector<double> x = model == "kepler" ? keplerX : std::vector<double>{2, 0};
        const auto range = [&](double h) {
            return along(system, *scheme(id.toUtf8().constData(), system, h), x, 40, Form::local, 0, order)
                .range();
        };
        const double coarse = range(step), fine = range(step / 2), slope = std::log2(coarse / fine);
        const double plain =
            along(system, *scheme(id.toUtf8().constData(), system, step), x, 40, Form::legendre, 0).range();
        QVERIFY(std::abs(slope - (order + 2)) < 0.3);  // measured: 4.00, 3.96, 6.01, 6.01
        QVERIFY(coarse < 0.25 * plain);
    }

    void theColumnsAreThoseOfTheRowsTime() {
        const Comparison result = run(readScene(std::string(R"({"extremal": 1, "model": {"type": "kepler"},
          "initial": {"q": [0.4, 0], "p": [0, 2]}, "time": {"end": 10},
          "schemes": [{"label": "a", "step": 0.025, "baseline": "stormer-verlet"},
                      {"label": "b", "step": 0.025, "baseline": "symplectic-euler"},
                      {"label": "c", "step": 0.4, "scheme": "galerkin-gauss-6"}],
          "observe": ["energy", "modified-energy"]})"))
                                          .scene);
        const Trajectory& rows = result.schemes.at(0)->trajectory;
        const auto H = rows["modified_energy"], change = rows["modified_energy_error"];
        QCOMPARE(H.size(), std::size_t(401));
        for (std::size_t k = 0; k < H.size(); ++k)
            QCOMPARE(std::isfinite(H[k]), k >= 12 && k + 12 < H.size());
        QCOMPARE(change[12], 0.0);
        const Summary& summary = result.schemes.at(0)->summary;
        QVERIFY2(summary.about.find("Legendre form of order 24") != std::string::npos, summary.about.c_str());
        QCOMPARE(summary.extremes.back().column, std::string("modified_energy_error"));
        QVERIFY(summary.extremes.back().value < 1e-11);
        QVERIFY(summary.maxEnergyError > 1e-3);
        // Steps too few for a window, and one whose action is not known.
        const Trajectory& few = result.schemes.at(2)->trajectory;
        QVERIFY(std::isfinite(few["modified_energy"].back()));
        QVERIFY(std::isnan(result.schemes.at(1)->summary.extremes.back().value) ||
                result.schemes.at(1)->summary.extremes.back().value < 1e-9);
    }
};

EXTREMAL_TEST(ModifiedEnergyTest)

}  // namespace extremal::modified_energy_test

#include "modified_energy_test.moc"
