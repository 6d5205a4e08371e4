// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields in Fourier modes with Gauss in time: orders of u and u_t on exact solutions, momentum, energy over
/// long times, the symplectic form, and what is refused.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "engine/core/problem.hpp"
#include "engine/family/stage_tables.hpp"
#include "engine/model/field/trigonometric_form.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::spectral_field_test {
using namespace fields;
namespace {

System spectral(const std::string& potential, double left, double length, int modes) {
    Settings model{"field",
                   {{"wave_speed", 1.0},
                    {"potential", potential},
                    {"mass", 1.0},
                    {"domain", Value::Array{left, left + length}},
                    {"boundary", "periodic"},
                    {"cells", static_cast<double>(modes)},
                    {"trigonometric", true}},
                   {}};
    return findModel("field")->make(model);
}

Discretization gaussOf(int degree, const Value& nodes = "same") {
    return {{"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", nodes}}, {}},
            {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}},
            {}};
}

/// The largest errors of u and u_t at the end, with the exact solution at the nodes.
std::pair<double, double> errors(const System& system, const Start& start, const Discretization& d,
                                 double duration, int steps) {
    State state = start.state;
    const auto integrator = makeIntegrator(system, d, {state.t, duration / steps});
    if (!go(*integrator, state, steps)) return {NAN, NAN};
    std::vector<double> exact(state.x.size());
    start.exact(start.state.t + duration, exact);
    double q = 0, p = 0;
    const std::size_t n = exact.size() / 2;
    for (std::size_t i = 0; i < n; ++i) {
        q = std::max(q, std::abs(state.x[i] - exact[i]));
        p = std::max(p, std::abs(state.x[n + i] - exact[n + i]));
    }
    return {q, p};
}

std::pair<double, double> slopes(const System& system, const Start& start, int degree, double duration,
                                 const std::vector<int>& steps) {
    std::vector<double> h, q, p;
    for (const int n : steps) {
        const auto [errorQ, errorP] = errors(system, start, gaussOf(degree), duration, n);
        qInfo("degree %d, %3d steps: u %.3e, u_t %.3e", degree, n, errorQ, errorP);
        h.push_back(-std::log(n));
        q.push_back(std::log(errorQ));
        p.push_back(std::log(errorP));
    }
    return {slope(h, q), slope(h, p)};
}

/// Random u and u_t of all modes but the highest wave of even numbers.
State roughState(const System& system, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    State state;
    for (int i = 0; i < 2 * system.fieldProblem().size(); ++i) state.x.push_back(uniform(random));
    TrigonometricForm::withoutAlternation(state.x);
    return state;
}

double momentumChange(const std::string& potential, int modes, const Value& nodes) {
    const System system = spectral(potential, 0, 2 * pi, modes);
    const TrigonometricForm form(system.part<ScalarField>().problem);
    State state = roughState(system, 3);
    const double before = form.momentum(state.x.data());
    const auto integrator = makeIntegrator(system, gaussOf(2, nodes), {0, 0.1});
    if (!go(*integrator, state, 100)) return NAN;
    return std::abs(form.momentum(state.x.data()) - before);
}

std::string sceneOf(const std::string& model, const std::string& space) {
    return R"({"extremal": 1, "model": {"type": "field", )" + model +
           R"(}, "initial": {"u": "exp(cos(x)) "}, "time": {"end": 1}, "schemes": [{"step": 0.1, "space": )" +
           space + "}]}";
}

std::string refusalOf(const std::string& model, const std::string& space) {
    const ReadScene read = readScene(sceneOf(model, space));
    if (read.errors.empty()) return {};
    return read.errors.front().pointer + ": " + read.errors.front().message + "; " + read.errors.front().hint;
}

}  // namespace

class SpectralFieldTest : public QObject {
    Q_OBJECT
private slots:
    void aBreatherHasTheOrderInBothVariables() {
        // k = 0.87: at the ends it is 1e-15, and so are its modes above 512.
        const System system = spectral("sine-gordon", -40, 80, 512);
        const Start start = startOf(system, {{"profile", "breather"}, {"omega", 0.5}, {"phase", 0.4}});
        const std::vector<std::vector<int>> steps{{80, 160, 320}, {40, 80, 160}, {32, 64, 128}, {24, 48, 96}};
        for (int degree = 1; degree <= 4; ++degree) {
            const auto [q, p] = slopes(system, start, degree, 8, steps[static_cast<std::size_t>(degree - 1)]);
            qInfo("degree %d: order %.2f in u, %.2f in u_t", degree, q, p);
            QVERIFY(std::abs(q - 2 * degree) < 0.25);
            QVERIFY(std::abs(p - 2 * degree) < 0.25);
        }
    }
    void aPlaneWaveOfTheLinearEquationNeedsNoIteration() {
        const System system = spectral("klein-gordon", 0, 2 * pi, 17);
        const Start start = startOf(system, {{"profile", "plane-wave"}, {"wave_number", 2.0}});
        State state = start.state;
        const auto integrator = makeIntegrator(system, gaussOf(4), {0, 0.1});
        long long iterations = 0;
        for (int k = 0; k < 20; ++k) {
            const StepReport report = advance(*integrator, state);
            QCOMPARE(report.outcome, Outcome::converged);
            iterations += report.cost.iterations;
        }
        QVERIFY(iterations <= 40);  // one, and one that finds no change
        const double error = errorOf(system, state, start.exact);
        qInfo("error %.2e", error);
        QVERIFY(error < 1e-11);
    }
    void momentumIsExactWithNodesThatIntegrateThePotential() {
        // Even and odd numbers of modes; of a quartic, and of a typed one of degree 6.
        for (const int modes : {24, 25}) {
            const double exact = momentumChange("phi4", modes, "exact"),
                         twice = momentumChange("phi4", modes, 2.0 * modes),
                         same = momentumChange("phi4", modes, "same"),
                         few = momentumChange("phi4", modes, std::ceil(1.5 * modes));
            const double sixth = momentumChange("u^2/2 + u^6/24", modes, "exact"),
                         quartic = momentumChange("u^2/2 + u^6/24", modes, 2.0 * modes);
            qInfo("%d modes: exact %.1e, 2N %.1e, N %.1e, 3N/2 %.1e; degree 6: exact %.1e, 2N %.1e", modes,
                  exact, twice, same, few, sixth, quartic);
            QVERIFY(exact < 1e-13 && twice < 1e-13 && sixth < 1e-12);
            QVERIFY(same > 1e-3 && few > 1e-9 && quartic > 1e-9);
        }
    }
    void energyOfABreatherStaysOverLongTimes() {
        const System system = spectral("sine-gordon", -20, 40, 96);
        State state = startOf(system, {{"profile", "breather"}, {"omega", 0.5}}).state;
        const auto integrator = makeIntegrator(system, gaussOf(2), {0, 0.25});
        const double first = system.energy(0, state.x.data());
        std::vector<double> means(4), most(4);
        for (std::size_t quarter = 0; quarter < 4; ++quarter)
            for (int k = 0; k < 2500; ++k) {
                QVERIFY(go(*integrator, state, 1));
                const double change = system.energy(state.t, state.x.data()) / first - 1;
                means[quarter] += change / 2500;
                most[quarter] = std::max(most[quarter], std::abs(change));
            }
        for (std::size_t k = 0; k < 4; ++k) qInfo("quarter %zu: mean %.2e, most %.2e", k, means[k], most[k]);
        const auto [low, high] = std::minmax_element(means.begin(), means.end());
        QVERIFY(*std::max_element(most.begin(), most.end()) > 1e-8);  // it oscillates
        QVERIFY(*high - *low < 0.02 * *std::max_element(most.begin(), most.end()));
    }
    void theStepIsSymplectic() {
        for (const auto& [potential, modes, nodes] :
             {std::tuple{"sine-gordon", 12, Value("same")}, std::tuple{"phi4", 9, Value("exact")}}) {
            const System system = spectral(potential, 0, 2 * pi, modes);
            State state = roughState(system, 5);
            const auto integrator = makeIntegrator(system, gaussOf(3, nodes), {0, 0.3});
            const auto half = static_cast<std::size_t>(modes);
            const std::size_t size = integrator->tangentSize();
            QCOMPARE(size, 2 * half);
            for (int k = 0; k < 3; ++k) QVERIFY(go(*integrator, state, 1));
            std::vector<double> M(size * size);
            for (std::size_t i = 0; i < size; ++i) M[i * size + i] = 1;
            QVERIFY(integrator->applyTangent(M));
            double worst = 0;
            for (std::size_t a = 0; a < size; ++a)
                for (std::size_t b = 0; b < size; ++b) {
                    double form = 0;
                    for (std::size_t i = 0; i < half; ++i)
                        form += M[a * size + i] * M[b * size + half + i] -
                                M[a * size + half + i] * M[b * size + i];
                    const double wanted = b == a + half ? 1 : a == b + half ? -1 : 0;
                    worst = std::max(worst, std::abs(form - wanted));
                }
            QVERIFY2(worst < 1e-12, qPrintable(QString::number(worst)));
            // By differences the same map.
            State moved = state, other = state;
            const auto next = integrator->clone();
            QVERIFY(go(*next, moved, 1));
            std::vector<double> w(size);
            w[2] = 1;
            const auto ahead = next->applyTangent(w);
            QVERIFY(ahead);
            other.x[2] += 1e-6;
            const auto beside = integrator->clone();
            QVERIFY(go(*beside, other, 1));
            for (std::size_t i = 0; i < half; ++i)
                QVERIFY(std::abs((other.x[i] - moved.x[i]) / 1e-6 - w[i]) < 1e-5);
        }
    }
    void aStepBackReturns() {
        const System system = spectral("phi4", 0, 2 * pi, 24);
        const State start = roughState(system, 8);
        State state = start;
        QVERIFY(go(*makeIntegrator(system, gaussOf(3), {0, 0.05}), state, 20));
        state.node = 0;
        QVERIFY(go(*makeIntegrator(system, gaussOf(3), {state.t, -0.05}), state, 20));
        for (std::size_t i = 0; i < state.x.size(); ++i) QVERIFY(std::abs(state.x[i] - start.x[i]) < 1e-10);
    }
    void aRunGoesOnWithTheSameBits() {
        const System system = spectral("phi4", 0, 2 * pi, 20);
        State state = roughState(system, 2);
        const auto integrator = makeIntegrator(system, gaussOf(2), {0, 0.1});
        QVERIFY(go(*integrator, state, 5));
        Archive written;
        QVERIFY(integrator->checkpoint(written));
        const auto resumed = makeIntegrator(system, gaussOf(2), {0, 0.1});
        Archive read(written.bytes());
        QVERIFY(resumed->checkpoint(read));
        State other = state;
        QVERIFY(go(*integrator, state, 5) && go(*resumed, other, 5));
        QVERIFY(state.x == other.x);
    }
    void stepsThatAreTooLongEndWithAnOutcome() {
        const System system = spectral("1e4*u^4", 0, 2 * pi, 16);
        State state = roughState(system, 2);
        const State before = state;
        const auto integrator = makeIntegrator(system, gaussOf(2), {0, 1});
        const Outcome outcome = advance(*integrator, state).outcome;
        QVERIFY(outcome == Outcome::diverged || outcome == Outcome::notFinite);
        QVERIFY(state.x == before.x && state.t == before.t);
    }
    void valuesBetweenNodesAreThoseOfThePolynomial() {
        for (const int modes : {15, 16}) {
            const System system = spectral("none", -1, 2 * pi, modes);
            State state = startOf(system, {{"u", "1 + cos(3*x) - 2*sin(5*x)"}, {"u_t", "sin(x)"}}).state;
            const std::vector<double> places{-1, 0.3, 2.7, 5};
            std::vector<double> values(8);
            system.at(state.x.data(), places, values.data());
            for (std::size_t i = 0; i < 4; ++i) {
                const double x = places[i];
                QVERIFY(std::abs(values[i] - (1 + std::cos(3 * x) - 2 * std::sin(5 * x))) < 1e-13);
                QVERIFY(std::abs(values[4 + i] - std::sin(x)) < 1e-13);
            }
            // Integrals of squares by hand.
            const double energy = pi * (0.5 * 1 + 0.5 * (9 + 4 * 25));
            QVERIFY(std::abs(system.energy(0, state.x.data()) - energy) < 1e-11);
        }
    }
    void whatCannotBeIsRefusedWithWhatWouldDo() {
        const char* periodic =
            R"("potential": "phi4", "domain": [0, "2*pi"], "boundary": "periodic", "cells": 16)";
        QCOMPARE(refusalOf(periodic, R"({"type": "fourier-field", "degree": 2})"), std::string());
        QCOMPARE(refusalOf(periodic, R"({"type": "fourier-field", "degree": 2, "modes": 33, "nodes": 80})"),
                 std::string());
        QCOMPARE(refusalOf(periodic, R"({"type": "fourier-field", "degree": 2, "nodes": "exact"})"),
                 std::string());
        const auto holds = [](const std::string& text, const char* part) {
            return text.find(part) != std::string::npos;
        };
        const std::string few = refusalOf(periodic, R"({"type": "fourier-field", "degree": 2, "nodes": 12})"),
                          odd = refusalOf(periodic,
                                          R"({"type": "fourier-field", "degree": 2, "nodes": "all"})"),
                          gordon = refusalOf(
                              R"("potential": "sine-gordon", "domain": [0, 6], "boundary": "periodic")",
                              R"({"type": "fourier-field", "degree": 2, "nodes": "exact"})"),
                          walls = refusalOf(R"("domain": [0, 6], "boundary": "dirichlet")",
                                            R"({"type": "fourier-field", "degree": 2})"),
                          medium = refusalOf(
                              R"("domain": [0, 6], "boundary": "periodic", "a": "2 + sin(2*pi*s) ")",
                              R"({"type": "fourier-field", "degree": 2})");
        for (const auto& each : {few, odd, gordon, walls, medium}) qInfo("%s", each.c_str());
        QVERIFY(holds(few, "must be at least the number of modes, 16"));
        QVERIFY(holds(odd, "nodes must be \"same\", \"exact\" or a whole number"));
        QVERIFY(holds(gordon, "/space/nodes: exact is for W(u) that is a polynomial"));
        QVERIFY(holds(walls, "need a periodic domain, and the boundary of this model is dirichlet"));
        QVERIFY(holds(medium, "need one wave speed"));
    }
};

EXTREMAL_TEST(SpectralFieldTest)

}  // namespace extremal::spectral_field_test

#include "spectral_field_test.moc"
