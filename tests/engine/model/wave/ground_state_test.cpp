// SPDX-License-Identifier: GPL-3.0-or-later
/// States of least energy with an interaction, and clouds without kinetic energy: against identities and
/// exact states, at rest in runs, and where there is none.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/wave/collapse.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/model/wave/start/ground_state.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::ground_state_test {
namespace {

System wave(int dimension, double half, int modes, double g, const char* potential) {
    Value::Object keys{{"domain", Value::Array{-half, half}},
                       {"modes", static_cast<double>(modes)},
                       {"potential", potential},
                       {"interaction", g}};
    if (dimension == 2) {
        keys.push_back({"domain_y", Value::Array{-half, half}});
        keys.push_back({"modes_y", static_cast<double>(modes)});
    }
    return laws::systemNamed(dimension == 2 ? "schrodinger-2d" : "schrodinger", keys);
}

State startOf(const System& system, const char* packet, double norm = 1) {
    const Value psi = Value::Object{{"packet", packet}, {"norm", norm}};
    return {0, 0, system.start({"", {{"psi", psi}, {"normalise", true}}, {}}, 0)};
}

/// <T>, <V> and g/2 integral |psi|^4, per norm.
struct Shares {
    double kinetic = 0, potential = 0, interaction = 0;
};
Shares sharesOf(const Hamiltonian& h, double g, const State& state) {
    const Complex* const c = coefficients(state.x.data());
    Shares s;
    const double norm = squaredNorm(c, h.size());
    for (int i = 0; i < h.size(); ++i)
        s.kinetic += h.kinetic()[static_cast<std::size_t>(i)] * std::norm(c[i]) / norm;
    s.potential = h.energy(0, c) - s.kinetic;
    s.interaction = g / 2 * quarticIntegral(h, c) / norm;
    return s;
}

std::string refusal(const System& system, const char* packet, double norm = 1) {
    try {
        startOf(system, packet, norm);
    } catch (const InvalidScene& e) {
        return e.problems().front().pointer + " " + e.problems().front().message;
    }
    return {};
}

}  // namespace

class GroundStateTest : public QObject {
    Q_OBJECT
private slots:
    void harmonicTrapsHaveTheirVirial() {
        // 2 <T> - 2 <V> + d <g/2 |psi|^4> = 0, and dE/dg = integral |psi|^4 / 2. Energies on the line: Bao,
        // Jaksch and Markowich 2003, J. Comput. Phys. 187, 318.
        struct Row {
            int dimension, modes;
            double half, g, energy;
        };
        for (const Row& row : {Row{1, 128, 12, 3.1371, 1.0441},
                               {1, 256, 12, 31.371, 3.9810},
                               {1, 256, 12, -3, 0},
                               {2, 64, 8, 20, 0},
                               {2, 96, 8, 100, 0},
                               {2, 96, 8, -3, 0}}) {
            const auto energyAt = [&](double g) {
                const System system = wave(row.dimension, row.half, row.modes, g, "harmonic");
                return system.energy(0, startOf(system, "ground-state").x.data());
            };
            const System system = wave(row.dimension, row.half, row.modes, row.g, "harmonic");
            const State state = startOf(system, "ground-state");
            const Shares s = sharesOf(*system.parts.find<Wave>()->hamiltonian, row.g, state);
            const double virial = 2 * s.kinetic - 2 * s.potential + row.dimension * s.interaction,
                         E = s.kinetic + s.potential + s.interaction, dg = 1e-4 * std::abs(row.g),
                         slope = (energyAt(row.g + dg) - energyAt(row.g - dg)) / (2 * dg);
            qInfo("d = %d, g = %g: E %.6f, virial %.1e, dE/dg %.10f, %.10f", row.dimension, row.g, E, virial,
                  slope, s.interaction / row.g);
            if (row.energy > 0) QVERIFY(std::abs(E - row.energy) < 6e-5);
            QVERIFY(std::abs(virial) < 1e-9);
            QVERIFY(std::abs(slope / (s.interaction / row.g) - 1) < 1e-7);
        }
    }
    void withAttractionItIsASoliton() {
        // sqrt(k/2) sech k x with k = |g|/2, mu = -k^2/2; the norm N acts as g N does.
        for (const double norm : {1.0, 2.0}) {
            const double g = -2 / norm, k = 1;
            const System system = wave(1, 20, 256, g, "free");
            const State state = startOf(system, "ground-state", norm);
            const auto& h = system.parts.find<Wave>()->hamiltonian;
            const double mu = chemicalPotential(h, {g, 0}, 0, coefficients(state.x.data()));
            std::vector<Complex> psi(256);
            h->toNodes(coefficients(state.x.data()), psi.data());
            double most = 0;
            for (std::size_t j = 0; j < 256; ++j)
                most = std::max(
                    most, std::abs(std::abs(psi[j]) - std::sqrt(norm * k / 2) / std::cosh(k * h->x()[j])));
            qInfo("norm %g: mu %.14f, psi off by %.1e", norm, mu, most);
            QVERIFY(std::abs(mu + k * k / 2) < 1e-11);
            QVERIFY(most < 1e-7);  // 4e-9: what e^-20 leaves at the ends
        }
    }
    void itRestsInRuns() {
        const System system = wave(1, 12, 256, 31.371, "harmonic");
        const State start = startOf(system, "ground-state");
        const ExactSolution exact =
            system.exactFrom({"", {{"psi", Value::Object{{"packet", "ground-state"}}}}, {}}, start);
        QVERIFY(exact);
        std::vector<double> known(start.x.size()), steps, errors;
        for (const int n : {100, 200, 400}) {
            State state = start;
            const auto strang =
                findBaseline("strang")->make(system, {.step = 2.0 / n, .settings = {"strang", {}, {}}});
            for (int k = 0; k < n; ++k) QCOMPARE(advance(*strang, state).outcome, Outcome::converged);
            exact(2, known);
            double sum = 0;
            for (std::size_t i = 0; i < known.size(); ++i)
                sum += (state.x[i] - known[i]) * (state.x[i] - known[i]);
            steps.push_back(-std::log(n));
            errors.push_back(std::log(std::sqrt(sum)));
        }
        const double order = slope(steps, errors);
        qInfo("Strang %.2e .. %.2e, order %.3f", std::exp(errors.front()), std::exp(errors.back()), order);
        QVERIFY(std::abs(order - 2) < 0.05);
    }
    void withoutKineticEnergyThereIsACloudWithAnEdge() {
        // mu = (3 g/(4 sqrt 2))^{2/3} on the line, sqrt(g/pi) in the plane, with g times the norm.
        for (const int d : {1, 2}) {
            const double g = d == 1 ? 100 : 50, norm = 2;
            const System system = wave(d, d == 1 ? 12 : 8, d == 1 ? 512 : 128, g, "harmonic");
            const auto& h = system.parts.find<Wave>()->hamiltonian;
            const double mu = thomasFermi(*h, g * norm).mu, G = g * norm,
                         known = d == 1 ? std::pow(3 * G / (4 * std::sqrt(2.0)), 2.0 / 3)
                                        : std::sqrt(G / std::numbers::pi);
            const State cloud = startOf(system, "thomas-fermi", norm),
                        rest = startOf(system, "ground-state", norm);
            const double above = system.energy(0, cloud.x.data()) - system.energy(0, rest.x.data());
            qInfo("d = %d: mu %.6f, exact %.6f, energy above the least %.2e", d, mu, known, above);
            QVERIFY(std::abs(mu / known - 1) < 1e-3);
            QVERIFY(above > 0 && above < 0.1 * mu);
            QVERIFY(std::abs(squaredNorm(coefficients(cloud.x.data()), h->size()) - norm) < 1e-12);
            QVERIFY(std::abs(squaredNorm(coefficients(rest.x.data()), h->size()) - norm) < 1e-11);
        }
    }
    void whereThereIsNoneIsSaid() {
        const System falls = wave(2, 8, 64, -6, "harmonic"), holds = wave(2, 8, 64, -4, "harmonic");
        qInfo("%s", refusal(falls, "ground-state").c_str());
        QVERIFY(refusal(falls, "ground-state")
                    .find("/psi/packet has no state of least energy: its norm is 1.03") == 0);
        QCOMPARE(refusal(holds, "ground-state"), std::string());
        QVERIFY(refusal(holds, "ground-state", 1.6).find("1.09 of the critical") != std::string::npos);
        QVERIFY(refusal(wave(1, 12, 32, -80, "harmonic"), "ground-state").find("nodes are too far apart") !=
                std::string::npos);
        QVERIFY(refusal(holds, "thomas-fermi").find("/psi/packet thomas-fermi needs repulsion") == 0);
        QVERIFY(refusal(holds, "ground-state", -1).find("/psi/norm") == 0);
        const System turns = laws::systemNamed("schrodinger-2d", {{"potential", "harmonic"},
                                                                  {"domain", Value::Array{-8.0, 8.0}},
                                                                  {"domain_y", Value::Array{-8.0, 8.0}},
                                                                  {"interaction", 5.0},
                                                                  {"rotation", 0.5}});
        QVERIFY(refusal(turns, "ground-state").find("/psi/packet ground-state is for frames that rest") == 0);
        QCOMPARE(refusal(turns, "thomas-fermi"), std::string());
        // Without an interaction it is the lowest eigenstate.
        const System linear = wave(1, 12, 64, 0, "harmonic");
        QVERIFY(std::abs(linear.energy(0, startOf(linear, "ground-state").x.data()) - 0.5) < 1e-12);
    }
};

EXTREMAL_TEST(GroundStateTest)

}  // namespace extremal::ground_state_test

#include "ground_state_test.moc"
