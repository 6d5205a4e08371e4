// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/rotation.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "engine/model/wave/start/vortices.hpp"

namespace extremal {
namespace {

using Shared = std::shared_ptr<const Hamiltonian>;

Measure normMeasure(const Shared& h) {
    return {"norm",
            {{"norm", "", "‖ψ‖", ""}, {"norm_error", "", "‖ψ‖ − ‖ψ(0)‖", ""}},
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

Measure widthMeasure(const Shared& h) {
    Measure m{"width", {{"x_square", "", "⟨x²⟩", ""}}, -1, {}};
    if (h->dimension() == 2) m.columns.push_back({"y_square", "", "⟨y²⟩", ""});
    m.bind = [h](const State&) {
        return [h, work = std::vector<Complex>(static_cast<std::size_t>(h->size()))](double, const double* x,
                                                                                     double* values) mutable {
            const MeanSquares squares = meanSquares(*h, coefficients(x), work.data());
            values[0] = squares.x;
            if (h->dimension() == 2) values[1] = squares.y;
        };
    };
    return m;
}

/// Of periodic domains, whose copies a wave meets beyond its edges.
Measure edgeMeasure(const Shared& h) {
    return {"edge", {{"edge", "", "|ψ| at the edges / max |ψ|", ""}}, -1, [h](const State&) {
                return [h, work = std::vector<Complex>(static_cast<std::size_t>(h->size()))](
                           double, const double* x, double* values) mutable {
                    h->toNodes(coefficients(x), work.data());
                    const std::size_t nx = h->x().size(), ny = work.size() / nx;
                    double edge = 0, most = 0;
                    for (std::size_t j = 0; j < work.size(); ++j) {
                        const double density = std::norm(work[j]);
                        const bool isAcross = ny > 1 && (j / nx == 0 || j / nx + 1 == ny);
                        most = std::max(most, density);
                        if (isAcross || j % nx == 0 || j % nx + 1 == nx) edge = std::max(edge, density);
                    }
                    values[0] = std::sqrt(edge / most);
                };
            }};
}

Measure angularMomentumMeasure(const Shared& h) {
    return {"angular-momentum", {{"angular_momentum", "", "⟨L⟩", ""}}, -1, [h](const State&) {
                return [L = AngularMomentum(h)](double, const double* x, double* values) mutable {
                    values[0] = L.mean(coefficients(x));
                };
            }};
}

Measure vorticesMeasure(const Shared& h) {
    return {"vortices",
            {{"vortices", "", "vortices", ""}, {"antivortices", "", "antivortices", ""}},
            -1,
            [h](const State&) {
                return [h, psi = std::vector<Complex>(static_cast<std::size_t>(h->size()))](
                           double, const double* x, double* values) mutable {
                    h->toNodes(coefficients(x), psi.data());
                    const VortexCount count = countVortices(h->grid(), psi.data());
                    values[0] = count.positive;
                    values[1] = count.negative;
                };
            }};
}

}  // namespace

std::vector<Measure> waveMeasures(const Shared& h) {
    std::vector<Measure> all{normMeasure(h), momentumMeasure(h), positionMeasure(h), currentMeasure(h),
                             tailMeasure(h)};
    if (h->isPeriodic()) {
        all.push_back(widthMeasure(h));
        all.push_back(edgeMeasure(h));
    }
    if (h->dimension() == 2) {
        all.push_back(angularMomentumMeasure(h));
        all.push_back(vorticesMeasure(h));
    }
    return all;
}

MeanSquares meanSquares(const Hamiltonian& h, const Complex* c, Complex* work) {
    h.toNodes(c, work);
    const std::size_t nx = h.x().size();
    const double x0 = h.grid().x.left + h.grid().x.length / 2, y0 = h.grid().y.left + h.grid().y.length / 2;
    double all = 0;
    MeanSquares squares;
    for (std::size_t j = 0; j < static_cast<std::size_t>(h.size()); ++j) {
        const double weight = std::norm(work[j]), x = h.x()[j % nx] - x0, y = h.y()[j / nx] - y0;
        all += weight;
        squares.x += weight * x * x;
        squares.y += weight * y * y;
    }
    squares.x /= all;
    squares.y = h.dimension() == 2 ? squares.y / all : 0;
    return squares;
}

double meanSquareRadius(const Hamiltonian& h, const Complex* c) {
    std::vector<Complex> work(static_cast<std::size_t>(h.size()));
    const MeanSquares squares = meanSquares(h, c, work.data());
    return squares.x + squares.y;
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
