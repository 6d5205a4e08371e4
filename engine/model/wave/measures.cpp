// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/measures.hpp"

#include <cmath>
#include <complex>

#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal {
namespace {

using Shared = std::shared_ptr<const Hamiltonian>;

Measure normMeasure(const Shared& h) {
    return {"norm",
            {{"norm", "", "‖ψ‖", ""}, {"norm_error", "", "‖ψ‖ - ‖ψ(0)‖", ""}},
            1,
            [n = h->size()](const State& initial) {
                const double start = std::sqrt(squaredNorm(coefficients(initial.x.data()), n));
                return [n, start](double, const double* x, double* values) {
                    values[0] = std::sqrt(squaredNorm(coefficients(x), n));
                    values[1] = values[0] - start;
                };
            }};
}

Measure momentumMeasure(const Shared& h) {
    Measure m{"momentum", {{"momentum", "", h->dimension() == 2 ? "⟨p x⟩" : "⟨p⟩", ""}}, -1, {}};
    if (h->dimension() == 2) m.columns.push_back({"momentum_y", "", "⟨p y⟩", ""});
    m.bind = [h](const State&) {
        return [h](double, const double* x, double* values) {
            const MeanMomentum mean = meanMomentum(*h, coefficients(x));
            values[0] = mean.x;
            if (h->dimension() == 2) values[1] = mean.y;
        };
    };
    return m;
}

Measure positionMeasure(const Shared& h) {
    Measure m{"position", {{"position", "", "⟨x⟩", ""}}, -1, {}};
    if (h->dimension() == 2)
        m.columns.push_back({"position_y", "", "⟨y⟩", ""});
    else if (h->isPeriodic())
        m.columns.push_back({"cos_x", "", "⟨cos x⟩", ""});
    m.bind = [h](const State&) {
        return [h, work = std::vector<Complex>(static_cast<std::size_t>(h->size()))](double, const double* x,
                                                                                     double* values) mutable {
            const NodeMeans means = nodeMeans(*h, coefficients(x), work.data());
            values[0] = means.x;
            if (h->isPeriodic()) values[1] = h->dimension() == 2 ? means.y : means.cosine;
        };
    };
    return m;
}

Measure currentMeasure(const Shared& h) {
    return {"current", {{"current", "", "j", ""}}, -1, [h](const State&) {
                const std::vector<Complex> buffer(static_cast<std::size_t>(h->size()));
                return [h, work = buffer, slope = buffer](double, const double* x, double* values) mutable {
                    values[0] = currentInTheMiddle(*h, coefficients(x), work.data(), slope.data());
                };
            }};
}

Measure tailMeasure(const Shared& h) {
    return {"spectrum-tail", {{"spectrum_tail", "", "tail", ""}}, -1, [h](const State&) {
                return [h](double, const double* x, double* values) {
                    values[0] = spectrumTail(*h, coefficients(x));
                };
            }};
}

}  // namespace

std::vector<Measure> waveMeasures(const Shared& h) {
    return {normMeasure(h), momentumMeasure(h), positionMeasure(h), currentMeasure(h), tailMeasure(h)};
}

ErrorMeasure wavePhaseError(int size) {
    ErrorMeasure m;
    m.columns = {{"phase_error", "", "arg⟨ψ ref, ψ⟩", "rad"}};
    m.evaluate = [size](const double* x, const double* reference, double* values) {
        values[0] = std::arg(innerProduct(coefficients(reference), coefficients(x), size));
    };
    return m;
}

}  // namespace extremal
