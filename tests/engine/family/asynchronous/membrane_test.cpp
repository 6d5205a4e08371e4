// SPDX-License-Identifier: GPL-3.0-or-later
/// Asynchronous schemes on a triangulated membrane: what they keep, what they save, and their errors against
/// exact modes.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/family/family.hpp"
#include "engine/mesh/levels.hpp"
#include "engine/model/membrane/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::membrane_test {
namespace {

System membrane(int sectors, double core, const char* material = "linear",
                const char* boundary = "dirichlet") {
    return findModel("membrane")
        ->make({"membrane",
                {{"sectors", static_cast<double>(sectors)},
                 {"core", core},
                 {"material", material},
                 {"boundary", boundary}},
                {}});
}

Discretization asynchronous(double courant, const char* levels = "dyadic") {
    return {{"asynchronous", {{"levels", levels}, {"courant", courant}, {"balance", true}}, {}},
            {"auto", {}, {}},
            {}};
}

const MembraneProblem& problemOf(const System& system) { return *system.part<Membrane>().problem; }

Levels levelsOf(const System& system, double courant) {
    const MembraneProblem& problem = problemOf(system);
    std::vector<double> steps;
    for (const auto& element : problem.elements) steps.push_back(courant * problem.criticalStep(element));
    return dyadicLevels(problem.mesh, steps, true);
}

struct Motion {
    double largest = 0, drift = 0, error = 0, momentum = 0;
    long long updates = 0;
};

/// Energies relative to the start; the drift is the mean of the last tenth less that of the first.
Motion moved(const System& system, const Discretization& d, double step, double end,
             const Settings& initial) {
    const auto integrator = makeIntegrator(system, d, {0, step});
    State state;
    state.x = system.start(initial, 0);
    const ExactSolution exact = system.exactFrom(initial, state);
    integrator->begin(state);
    const double energy = system.energy(0, state.x.data());
    const auto momentum = [&] {
        return system.momenta.empty() ? 0 : system.momenta[0].value(state.x.data(), state.x.data());
    };
    const double before = momentum();
    const auto steps = static_cast<long long>(end / step + 1e-9), tenth = std::max(1LL, steps / 10);
    Motion m;
    std::vector<double> reference(state.x.size());
    for (long long k = 1; k <= steps; ++k) {
        const StepReport report = integrator->advance(state, static_cast<double>(k) * step);
        if (report.outcome != Outcome::converged) return {INFINITY, INFINITY, INFINITY, INFINITY, 0};
        m.updates += report.cost.evaluations;
        const double change = system.energy(0, state.x.data()) / energy - 1;
        m.largest = std::max(m.largest, std::abs(change));
        if (k <= tenth) m.drift -= change / static_cast<double>(tenth);
        if (k > steps - tenth) m.drift += change / static_cast<double>(tenth);
        m.momentum = std::max(m.momentum, std::abs(momentum() - before));
        if (!exact) continue;
        double error = 0;
        exact(state.t, reference);
        system.error.evaluate(state.x.data(), reference.data(), &error);
        m.error = std::max(m.error, error);
    }
    return m;
}

Settings mode(double m, double n, double amplitude) {
    return {"", {{"mode", Value::Array{m, n}}, {"amplitude", amplitude}}, {}};
}

}  // namespace

class MembraneTest : public QObject {
    Q_OBJECT
private slots:
    void trianglesCoverTheDisc() {
        for (const int sectors : {6, 24, 60}) {
            const TriangleMesh mesh = discMesh(sectors, 0.01);
            double area = 0, least = INFINITY, most = 0;
            for (int e = 0; e < mesh.elements(); ++e) {
                area += mesh.area(e);
                const auto g = mesh.gradients(e);
                for (int k = 0; k < 2; ++k) {
                    const auto i = static_cast<std::size_t>(k);
                    QVERIFY(std::abs(g[0][i] + g[1][i] + g[2][i]) < 1e-10 / mesh.area(e));
                }
                least = std::min(least, mesh.area(e));
                most = std::max(most, mesh.area(e));
            }
            const double turn = 2 * std::numbers::pi / sectors;
            QVERIFY(least > 0);
            QVERIFY(std::abs(area / (sectors * std::sin(turn) / 2) - 1) < 1e-13);
            QVERIFY(most > 1000 * least);
        }
    }
    void energyHasNoDrift_data() {
        QTest::addColumn<QString>("material");
        for (const char* material : {"linear", "area"}) QTest::newRow(material) << QString(material);
    }
    void energyHasNoDrift() {
        QFETCH(QString, material);
        const System system = membrane(24, 0.02, qPrintable(material));
        const Levels levels = levelsOf(system, 0.5);
        const Settings initial{"", {{"displacement", "0.3*(1 - x^2 - y^2)*(1 + x) "}}, {}};
        const Motion m = moved(system, asynchronous(0.5), levels.largest(), 100, initial);
        qInfo("%lld updates, at most %.1e, drift %.1e", m.updates, m.largest, m.drift);
        QVERIFY(m.updates > 10'000'000);
        QVERIFY(m.largest < 2e-2);          // 8.4e-3 linear, 6.4e-3 area
        QVERIFY(std::abs(m.drift) < 1e-3);  // 1.5e-4, 1.2e-5
    }
    void verticalMomentumIsKept() {
        const System system = membrane(24, 0.02, "area", "neumann");
        const Settings initial{"", {{"displacement", "0.2*cos(3*x) "}, {"velocity", "1 + x - y^2"}}, {}};
        const Motion m = moved(system, asynchronous(0.5), levelsOf(system, 0.5).largest(), 10, initial);
        QVERIFY2(m.momentum < 1e-12, qPrintable(QString::number(m.momentum)));
        const Motion real = moved(system, asynchronous(0.5, "real"), 0.01, 5, initial);
        QVERIFY2(real.momentum < 1e-12, qPrintable(QString::number(real.momentum)));
    }
    void aStepBackReturns() {
        const System system = membrane(12, 0.05, "area");
        const double step = levelsOf(system, 0.4).largest();
        State state;
        state.x = system.start({"", {{"displacement", "0.4*(1 - x^2 - y^2) "}}, {}}, 0);
        const State start = state;
        const auto there = makeIntegrator(system, asynchronous(0.4), {0, step});
        for (int k = 0; k < 20; ++k) QCOMPARE(advance(*there, state).outcome, Outcome::converged);
        state.node = 0;
        const auto back = makeIntegrator(system, asynchronous(0.4), {state.t, -step});
        for (int k = 0; k < 20; ++k) QCOMPARE(advance(*back, state).outcome, Outcome::converged);
        double away = 0;
        for (std::size_t i = 0; i < state.x.size(); ++i)
            away = std::max(away, std::abs(state.x[i] - start.x[i]));
        QVERIFY2(away < 1e-11, qPrintable(QString::number(away)));
    }
    void errorsFallWithTheSquareOfTheSize() {
        std::vector<double> synchronous, dyadic;
        for (const int sectors : {24, 48, 96}) {
            const System system = membrane(sectors, 0.05);
            const double step = levelsOf(system, 0.5).largest();
            dyadic.push_back(moved(system, asynchronous(0.5), step, 2, mode(1, 1, 0.3)).error);
            synchronous.push_back(
                moved(system, asynchronous(0.5, "synchronous"), step, 2, mode(1, 1, 0.3)).error);
            qInfo("%d sectors: %.2e, synchronous %.2e", sectors, dyadic.back(), synchronous.back());
            QVERIFY(dyadic.back() < synchronous.back());
        }
        // 9.1e-3, 3.3e-3, 9.2e-4: slowly towards 4, as the shape of the triangles changes with their number
        QVERIFY(synchronous[0] / synchronous[1] > 2.5);
        QVERIFY(synchronous[1] / synchronous[2] > 3.3);
        QVERIFY(dyadic[1] / dyadic[2] > 3.3);  // 1.7e-3, 2.6e-4
    }
    void dyadicStepsSaveUpdates() {
        const System system = membrane(24, 0.02);
        const Levels levels = levelsOf(system, 0.5);
        const Motion dyadic = moved(system, asynchronous(0.5), levels.largest(), 4, mode(0, 2, 0.3)),
                     synchronous = moved(system, asynchronous(0.5, "synchronous"), levels.largest(), 4,
                                         mode(0, 2, 0.3));
        const double saved = static_cast<double>(synchronous.updates) / static_cast<double>(dyadic.updates);
        qInfo("%.2f times fewer, errors %.2e and %.2e, energies %.1e and %.1e", saved, dyadic.error,
              synchronous.error, dyadic.largest, synchronous.largest);
        QVERIFY(saved > 2.5);  // 2.55
        QVERIFY(dyadic.error < synchronous.error);
        for (int e = 0; e < problemOf(system).mesh.elements(); ++e)
            QVERIFY(levels.step(e) <= 0.5 *
                                          problemOf(system).criticalStep(
                                              problemOf(system).elements[static_cast<std::size_t>(e)]) *
                                          (1 + 1e-9));
    }
    void whatIsWrongIsSaid() {
        const auto read = [](const char* model, const char* initial) {
            return readScene(R"({"extremal": 1, "model": {"type": "membrane")" + std::string(model) +
                             R"(}, "initial": )" + initial +
                             R"(, "time": {"end": 1}, "schemes": [{"space": "asynchronous"}]})");
        };
        QVERIFY(read("", R"({"mode": [0, 1]})").errors.empty());
        QCOMPARE(read(R"(, "sectors": 7)", R"({"mode": [0, 1]})").errors[0].pointer,
                 std::string("/model/sectors"));
        QCOMPARE(read(R"(, "material": "area")", R"({"mode": [0, 1]})").errors[0].pointer,
                 std::string("/initial/mode"));
        QCOMPARE(read("", R"({"mode": [0, 0]})").errors[0].pointer, std::string("/initial/mode"));
        QCOMPARE(read("", R"({"displacement": "1 - r"})").errors[0].pointer,
                 std::string("/initial/displacement"));
    }
};

EXTREMAL_TEST(MembraneTest)

}  // namespace extremal::membrane_test

#include "membrane_test.moc"
