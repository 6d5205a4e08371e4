// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/wave_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/model/parts/start_remark.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/collapse.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/model/wave/measures.hpp"
#include "engine/model/wave/start/cloud.hpp"
#include "engine/model/wave/start/packet.hpp"
#include "engine/model/wave/start/soliton.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "engine/model/wave/wave_parts.hpp"

namespace extremal {
namespace {

using Shared = std::shared_ptr<const Hamiltonian>;

ErrorMeasure errorOf(int n) {
    ErrorMeasure m;
    m.columns = {{"error", "", "‖ψ - ψ_ref‖", ""}};
    m.isOfPhase = true;
    m.evaluate = [n](const double* x, const double* reference, double* values) {
        double sum = 0;
        for (int i = 0; i < 2 * n; ++i) sum += (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(sum);
    };
    return m;
}

FieldSampling samplingOf(const Shared& h) {
    FieldSampling f;
    const wave::Grid& grid = h->grid();
    f.x = h->x();
    f.along = {grid.x.left, grid.x.length};
    if (h->dimension() == 2) {
        f.y = h->y();
        f.across = {grid.y.left, grid.y.length};
    }
    f.components = {"re", "im"};
    f.isComplex = true;
    if (!h->isPeriodic())
        f.resampling = [h](int rows) -> FieldSampling::Resampling {
            return [to = h->resampling(rows)](const std::vector<double>& sample) -> std::vector<double> {
                const Eigen::MatrixXd parts =
                    to * Eigen::Map<const Eigen::MatrixXd>(sample.data(), to.cols(), 2);
                return {parts.data(), parts.data() + parts.size()};
            };
        };
    f.sample = [h](const double* x, double* values) {
        const auto n = static_cast<std::size_t>(h->size());
        std::vector<Complex> psi(n);
        h->toNodes(coefficients(x), psi.data());
        for (std::size_t j = 0; j < n; ++j) {
            values[j] = psi[j].real();
            values[n + j] = psi[j].imag();
        }
    };
    f.initial = [names = f.components, n = f.places()](std::span<const double> values) {
        const Value psi{Value::Object{{"values", componentValues(names, values, n)}}};
        return Value(Value::Object{{"psi", psi}, {"normalise", false}});
    };
    return f;
}

/// How fast the phases of its parts move apart: six widths of the energy distribution.
double frequencyOf(const Hamiltonian& h, double t, const double* x) {
    const auto n = static_cast<std::size_t>(h.size());
    const Complex* c = coefficients(x);
    std::vector<double> V(n);
    std::vector<Complex> Hc(n), work(n);
    h.potentialAt(t, V.data());
    h.apply(V.data(), c, Hc.data(), work.data());
    const double norm = squaredNorm(c, h.size()), E = innerProduct(c, Hc.data(), h.size()).real() / norm;
    const double width = std::sqrt(std::max(0.0, squaredNorm(Hc.data(), h.size()) / norm - E * E));
    return std::isfinite(width) ? 6 * width / h.hbar() : 0;
}

/// The state of a function at the nodes.
std::vector<double> stateOf(const Hamiltonian& h, const wave::LineSolution& psi, double t) {
    std::vector<Complex> values, c(static_cast<std::size_t>(h.size()));
    for (const double x : h.x()) values.push_back(psi(x, t));
    h.toCoefficients(values.data(), c.data());
    const double* numbers = reinterpret_cast<const double*>(c.data());
    return {numbers, numbers + 2 * c.size()};
}

/// exp(-i mu (t - t0)/hbar) psi0, of a state that rests.
ExactSolution turningState(const Shared& h, Coupling coupling, const State& start) {
    const double mu = chemicalPotential(h, coupling, start.t, coefficients(start.x.data()));
    return [h, mu, start](double t, std::span<double> x) {
        const Complex turn = std::polar(1.0, -mu * (t - start.t) / h->hbar());
        for (int i = 0; i < h->size(); ++i)
            coefficients(x.data())[i] = turn * coefficients(start.x.data())[i];
    };
}

void useCoupling(System& s, const Shared& h, Coupling coupling) {
    if (coupling.g != 0) s.parts.set(Interaction{coupling.g});
    if (coupling.omega != 0) s.parts.set(Rotation{coupling.omega});
    s.energy = [h, coupling](double t, const double* x) {
        return coupledEnergy(h, coupling, t, coefficients(x));
    };
    if (h->dimension() == 2 && coupling.g < 0) s.parts.set(collapseLimit(h, coupling));
    s.exactFrom = [h, coupling](const Settings& initial, const State& start) -> ExactSolution {
        if (wave::isAtRest(*initial.find("psi"))) return turningState(h, coupling, start);
        const auto soliton = wave::solitonOf(*initial.find("psi"), "/psi", *h, coupling.g);
        if (!soliton || coupling.g > 0 || !wave::vanishesAtEnds(*soliton, *h)) return {};
        return [h, psi = *soliton](double t, std::span<double> x) {
            const std::vector<double> state = stateOf(*h, psi, t);
            std::copy(state.begin(), state.end(), x.begin());
        };
    };
}

/// A typed wave function with an interaction, whose norm is that of the cloud, is scaled to 1 by default.
StartRemark::Remark remarkOnNorm(const Shared& h, const Coupling& coupling, const Settings& initial) {
    constexpr double slack = 1e-6;
    const Value* const psi = initial.find("psi");
    if (!psi || !psi->isObject() || psi->find("packet") || !initial.flag("normalise")) return {};
    const auto c =
        wave::makePacket(*psi, "/psi", false, h, {{"hbar", h->hbar()}, {"m", h->mass()}}, coupling);
    const double norm = squaredNorm(c.data(), static_cast<int>(c.size()));
    if (std::abs(norm - 1) <= slack) return {};
    return {"/normalise",
            "scales psi from the norm ∫|ψ|² = " + formatNumber(norm, 4) +
                " to 1, and with an interaction that is another motion",
            "\"normalise\": false, or a psi of norm 1"};
}

}  // namespace

System makeWaveSystem(const Settings& settings, const std::function<Shared(const Settings&)>& make) {
    System s;
    s.id = settings.type;
    static MemoCache<Settings, Shared> recent(6);
    const Shared h = recent.get(settings, [&] { return make(settings); });
    const auto numberAt = [&](const char* key) { return settings.find(key) ? settings.number(key) : 0; };
    const Coupling coupling{numberAt("interaction"), numberAt("rotation")};
    s.parts.set(Wave{h});
    addWaveParts(s, h);
    if (!coupling.isThere()) addLinearWaveParts(s, h);
    s.isUnitary = true;
    s.linearTest = LinearTest::phases;
    s.measures = waveMeasures(h);
    s.phaseError = wavePhaseError(h->size());
    s.energy = [h](double t, const double* x) { return h->energy(t, coefficients(x)); };
    s.error = errorOf(h->size());
    s.field = samplingOf(h);
    s.draw = [h](const double* values, Drawing& drawing) { drawWave(*h, values, drawing); };
    s.frequency = [h](double t, const double* x) { return frequencyOf(*h, t, x); };
    s.caution = [h](const double* x) { return resolutionCaution(*h, coefficients(x)); };
    s.start = [h, coupling](const Settings& initial, double t) {
        const auto soliton = wave::solitonOf(*initial.find("psi"), "/psi", *h, coupling.g);
        if (soliton) return stateOf(*h, *soliton, t);
        const std::vector<Complex> c =
            wave::makePacket(*initial.find("psi"), "/psi", initial.flag("normalise"), h,
                             {{"hbar", h->hbar()}, {"m", h->mass()}}, coupling);
        const double* numbers = reinterpret_cast<const double*>(c.data());
        return std::vector<double>(numbers, numbers + 2 * c.size());
    };
    if (coupling.isThere()) {
        useCoupling(s, h, coupling);
        s.parts.set(StartRemark{
            [h, coupling](const Settings& initial) { return remarkOnNorm(h, coupling, initial); }});
    } else if (!h->isTimeDependent() && h->size() <= Eigenstates::denseLimit) {
        s.exact = [h](const State& initial) { return exactWave(h, initial); };
    }
    return s;
}

std::vector<FieldInfo> waveConstants() {
    FieldInfo hbar = positive("hbar", "Planck constant", "", 1, "The reduced Planck constant.");
    hbar.symbol = "ħ";
    return {hbar, positive("m", "mass", "", 1, "The mass.")};
}

wave::Constants constantsOf(const Settings& settings) {
    return {{"hbar", settings.number("hbar")}, {"m", settings.number("m")}};
}

wave::Domain domainOf(const Settings& settings, const std::string& key) {
    const std::vector<double> domain = settings.numbers(key);
    if (!(domain[1] > domain[0]))
        throw InvalidScene("/" + key, "must go from left to right, got " + formatNumber(domain[0]) + " to " +
                                          formatNumber(domain[1]));
    return {domain[0], domain[1] - domain[0]};
}

int modesOf(const Settings& settings, const std::string& key, bool isEven) {
    const int n = settings.integer(key);
    if (isEven && n % 2 != 0)
        throw InvalidScene("/" + key, "must be even, got " + std::to_string(n), std::to_string(n + 1));
    return n;
}

FieldInfo domainField(const std::string& key, const std::string& title, const std::string& description) {
    FieldInfo domain = numbers(key, title, "", {"left", "right"}, Value::Array{0.0, "2*pi"}, description);
    domain.fallback = Value::Array{0.0, 2 * std::numbers::pi};
    domain.symbol = title;
    return domain;
}

FieldInfo interactionField() {
    FieldInfo interaction = numberField(
        "interaction", "coupling", "", 0,
        "g of g |psi|^2 psi (nonlinear Schroedinger, Gross-Pitaevskii): repulsion where positive, "
        "attraction where negative; periodic domains.");
    interaction.symbol = "g";
    return interaction;
}

std::vector<FieldInfo> waveStartFields(const std::string& places) {
    FieldInfo psi = jsonField("psi", "wave function", "ψ", nullptr,
                              "re and im as expressions in " + places +
                                  ", a packet by name with its keys, or values at the nodes.");
    psi.example = Value::Object{{"packet", "gaussian"}};
    return {psi, flagField("normalise", true, "Scale the wave function to norm 1.")};
}

}  // namespace extremal
