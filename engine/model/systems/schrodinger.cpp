/// The Schroedinger equation i hbar psi_t = -hbar^2/(2m) psi_xx + V(x, t) psi on a periodic domain, or between
/// walls where psi = 0 (V(x) then).
///
/// The state is the coefficients of the wave function (wave/hamiltonian.hpp): no column of a row, but what fields are
/// sampled from. hbar and m are free; nothing else has a unit.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/model/system.hpp"
#include "engine/wave/eigen.hpp"
#include "engine/wave/hamiltonian.hpp"
#include "engine/wave/packet.hpp"
#include "engine/wave/spectrum.hpp"

namespace extremal::systems {
namespace {

using Shared = std::shared_ptr<const Hamiltonian>;

ErrorMeasure errorOf(int n) {
    ErrorMeasure m;
    m.columns = {{"error", "", "‖ψ - ψ ref‖", ""}};
    m.evaluate = [n](const double* x, const double* reference, double* values) {
        double sum = 0;
        for (int i = 0; i < 2 * n; ++i) sum += (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(sum);
    };
    return m;
}

FieldSampling samplingOf(const Shared& h) {
    FieldSampling f;
    f.x = h->x();
    f.components = {"re", "im"};
    f.sample = [h](const double* x, double* values) {
        const auto n = static_cast<std::size_t>(h->size());
        std::vector<Complex> psi(n);
        h->toNodes(coefficients(x), psi.data());
        for (std::size_t j = 0; j < n; ++j) {
            values[j] = psi[j].real();
            values[n + j] = psi[j].imag();
        }
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

/// |psi| over x as a curtain with the phase as its colour, above the potential. A wave spread over the whole domain stands a
/// tenth of it high.
void drawSchrodinger(const Hamiltonian& h, const double* values, Drawing& drawing) {
    const auto n = static_cast<std::size_t>(h.size());
    const double L = h.domain().length, left = h.domain().left, unit = 0.1 * L * std::sqrt(L);
    const auto& V = h.potential();
    const auto [low, high] = std::minmax_element(V.begin(), V.end());
    // A periodic domain is closed by the first node.
    const auto place = [&](std::size_t j) { return j < n ? h.x()[j] : left + L; };
    if (*high > *low) {
        const std::size_t every = std::max<std::size_t>(1, n / 256), last = h.isPeriodic() ? n : n - 1;
        const auto at = [&](std::size_t j) { return Point{place(j), 0.3 * L * (V[j % n] - *low) / (*high - *low), 0}; };
        for (std::size_t j = 0; j + every <= last; j += every)
            drawing.shapes.push_back(Segment{at(j), at(j + every), 1.2, ShapeRole::scenery});
    }
    drawing.shapes.push_back(Segment{{left, 0, 0}, {left + L, 0, 0}, 1.2, ShapeRole::scenery});
    if (!h.isPeriodic())
        for (const double wall : {left, left + L})
            drawing.shapes.push_back(Segment{{wall, 0, 0}, {wall, 0.3 * L, 0}, 2, ShapeRole::scenery});
    Curtain curtain;
    const auto add = [&](double x, double re, double im) {
        curtain.top.push_back({x, unit * std::hypot(re, im), 0});
        curtain.hues.push_back(std::atan2(im, re) / (2 * std::numbers::pi));
    };
    if (h.isPeriodic()) {
        for (std::size_t j = 0; j <= n; ++j) add(place(j), values[j % n], values[n + j % n]);
    } else {
        const EvenSamples even = evenSamples(h, values, 256);
        for (std::size_t j = 0; j < even.x.size(); ++j) add(even.x[j], even.re[j], even.im[j]);
    }
    drawing.shapes.push_back(std::move(curtain));
}

Shared hamiltonianOf(const Settings& settings) {
    const std::vector<double> domain = settings.numbers("domain");
    if (!(domain[1] > domain[0]))
        throw InvalidScene("/domain", "must go from left to right, got " + formatNumber(domain[0]) + " to " +
                                          formatNumber(domain[1]));
    const int n = settings.integer("modes");
    const bool isPeriodic = settings.text("boundary") != "dirichlet";
    if (isPeriodic && n % 2 != 0)
        throw InvalidScene("/modes", "must be even, got " + std::to_string(n), std::to_string(n + 1));
    if (!isPeriodic && n > Eigenstates::denseLimit)
        throw InvalidScene("/modes",
                           "must be at most " + std::to_string(Eigenstates::denseLimit) + " where the boundary is dirichlet, got " +
                               std::to_string(n),
                           "fewer modes, or the boundary periodic");
    const wave::Domain where{domain[0], domain[1] - domain[0]};
    const double hbar = settings.number("hbar"), m = settings.number("m");
    const Value* potential = settings.find("potential");
    wave::Potential V = wave::makePotential(*potential, "/potential", where, {{"hbar", hbar}, {"m", m}});
    if (!isPeriodic && V.isTimeDependent())
        throw InvalidScene("/potential", "depends on t, which is for the boundary periodic alone",
                           "a potential in x, or the boundary periodic");
    return std::make_shared<const Hamiltonian>(n, where, hbar, m, std::move(V),
                                               isPeriodic ? Boundary::periodic : Boundary::dirichlet);
}

System makeSchrodinger(const Settings& settings) {
    System s;
    s.id = "schrodinger";
    const Shared h = hamiltonianOf(settings);
    s.wave = h;
    s.energy = [h](double t, const double* x) { return h->energy(t, coefficients(x)); };
    s.error = errorOf(h->size());
    s.field = samplingOf(h);
    s.draw = [h](const double* values, Drawing& drawing) { drawSchrodinger(*h, values, drawing); };
    s.frequency = [h](double t, const double* x) { return frequencyOf(*h, t, x); };
    s.caution = [h](const double* x) { return resolutionCaution(*h, coefficients(x)); };
    s.start = [h](const Settings& initial) {
        const std::vector<Complex> c = wave::makePacket(*initial.find("psi"), "/psi", initial.flag("normalise"), h,
                                                        {{"hbar", h->hbar()}, {"m", h->mass()}});
        const double* numbers = reinterpret_cast<const double*>(c.data());
        return std::vector<double>(numbers, numbers + 2 * c.size());
    };
    if (!h->isTimeDependent() && h->size() <= Eigenstates::denseLimit)
        s.exact = [h](const State& initial) { return exactWave(h, initial); };
    return s;
}

std::vector<FieldInfo> parameters() {
    FieldInfo hbar = positive("hbar", "Planck constant", "", 1, "The reduced Planck constant.");
    hbar.symbol = "ħ";
    const FieldInfo potential = jsonField(
        "potential", "potential", "V", "free",
        "An expression in x, t, hbar and m, or a name: free, harmonic, lattice, double-well, barrier, morse, random.");
    FieldInfo domain = numbers("domain", "domain", "", {"left", "right"}, Value::Array{0.0, "2*pi"}, "Ends of the interval.");
    domain.fallback = Value::Array{0.0, 2 * std::numbers::pi};
    return {hbar, positive("m", "mass", "", 1, "The mass."), potential, domain,
            choiceField("boundary", "boundary", {"periodic", "dirichlet"},
                        "What holds at the ends of the interval: periodic, or dirichlet: walls, where psi is zero."),
            integerField("modes", "N", 8, 65536, 128,
                         "Number of modes and of nodes: Fourier modes, even; between walls polynomials, at most 512.")};
}

std::vector<FieldInfo> initialFields() {
    FieldInfo psi = jsonField("psi", "wave function", "ψ", nullptr,
                              "re and im as expressions in x, a packet by name with its keys, or values at the nodes.");
    psi.example = Value::Object{{"packet", "gaussian"}};
    return {psi, flagField("normalise", true, "Scale the wave function to norm 1.")};
}

}  // namespace

ModelEntry schrodinger() {
    ModelEntry e;
    e.item = {"schrodinger", "Schrödinger equation", "A wave function in one dimension, periodic or between walls; potential typed or by name.",
              parameters(), {}, ""};
    e.initial = initialFields();
    e.exampleInitial = {{"psi", Value::Object{{"packet", "gaussian"}, {"wave_number", 5.0}}}, {"normalise", true}};
    e.exampleEnd = 2;
    e.exampleStep = 0.01;
    e.make = makeSchrodinger;
    return e;
}

}  // namespace extremal::systems
