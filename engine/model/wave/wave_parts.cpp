// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/wave_parts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/model/parts/coefficient_sizes.hpp"
#include "engine/model/parts/on_other_mesh.hpp"
#include "engine/model/parts/potential_levels.hpp"
#include "engine/model/parts/premise_check.hpp"
#include "engine/model/wave/levels.hpp"
#include "engine/model/wave/mesh_error.hpp"
#include "engine/model/wave/resampling.hpp"
#include "engine/model/wave/start/packet.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal {
namespace {

using SharedHamiltonian = std::shared_ptr<const Hamiltonian>;
using SizesLine = CoefficientSizes::Line;

/// psi at the walls, as a part of its largest value. What is given on the nodes or as a state of the mesh
/// vanishes there.
ExactPremise premiseAtWalls(const SharedHamiltonian& hamiltonian, const Settings& given) {
    const Hamiltonian& h = *hamiltonian;
    ExactPremise premise;
    const Value* const psi = given.find("psi");
    if (!psi || h.isPeriodic()) return premise;
    const double left = h.domain().left, right = left + h.domain().length;
    std::vector<double> places{left, right};
    places.insert(places.end(), h.x().begin(), h.x().end());
    const std::vector<Complex> values =
        wave::valuesAt(*psi, "/psi", hamiltonian, {{"hbar", h.hbar()}, {"m", h.mass()}}, places);
    if (values.empty()) return premise;
    double most = 0;
    for (const Complex& v : values) most = std::max(most, std::abs(v));
    const std::size_t worse = std::abs(values[1]) > std::abs(values[0]) ? 1 : 0;
    const double part = std::abs(values[worse]) / most;
    premise.isViolated = part > 1e-6;
    if (premise.isViolated)
        premise.text = "does not hold at x = " + formatNumber(places[worse], 6) + " (" +
                       formatNumber(part, 2) + " of the largest |ψ| at the start, where ψ = 0 is asked for)";
    premise.pointer = "/initial/psi";
    premise.consequence = "no number of modes resolves it";
    premise.remedy = "a narrower packet, or one further inside";
    return premise;
}

std::vector<Complex> coefficientsOf(const Hamiltonian& h, const std::vector<double>& sample) {
    const auto n = static_cast<std::size_t>(h.size());
    std::vector<Complex> psi(n), c(n);
    for (std::size_t j = 0; j < n; ++j) psi[j] = {sample[j], sample[n + j]};
    h.toCoefficients(psi.data(), c.data());
    return c;
}

/// The largest coefficient with each wave number along x, or along y.
SizesLine largestAlong(const Hamiltonian& h, const std::vector<Complex>& c, bool isAlongY) {
    const int modes = isAlongY ? h.grid().ny : h.grid().nx;
    SizesLine line;
    line.part = isAlongY ? "along y" : "along x";
    line.sizes.assign(static_cast<std::size_t>(modes), 0);
    for (int a = -modes / 2; a < modes / 2; ++a) line.x.push_back(a);
    for (int i = 0; i < h.size(); ++i) {
        const int number = isAlongY ? h.fourier().numberY(i) : h.fourier().number(i);
        double& most = line.sizes[static_cast<std::size_t>(number + modes / 2)];
        most = std::max(most, std::abs(c[static_cast<std::size_t>(i)]));
    }
    return line;
}

SizesLine overInterval(const Hamiltonian& h, const std::vector<Complex>& c) {
    const std::size_t n = c.size();
    SizesLine line;
    for (int k = 0; !h.isPeriodic() && k <= h.size() + 1; ++k) {
        line.x.push_back(k);
        line.sizes.push_back(std::abs(chebyshevCoefficient(h, c.data(), k)));
    }
    for (std::size_t a = 0; h.isPeriodic() && a < n; ++a) {
        const auto i = static_cast<int>((a + n / 2) % n);
        line.x.push_back(h.fourier().number(i));
        line.sizes.push_back(std::abs(c[static_cast<std::size_t>(i)]));
    }
    return line;
}

/// Of Fourier coefficients, with a Dirichlet boundary of Chebyshev coefficients; over a rectangle the largest
/// with each wave number along x, and with each along y.
CoefficientSizes sizesOf(const SharedHamiltonian& h) {
    const wave::Grid& grid = h->grid();
    const bool isRectangle = h->dimension() == 2;
    const double half = (isRectangle ? std::max(grid.nx, grid.ny) : grid.nx) / 2.0;
    CoefficientSizes sizes;
    sizes.title = h->isPeriodic() ? "wave number" : "degree";
    sizes.low = h->isPeriodic() ? -half : 0;
    sizes.high = h->isPeriodic() ? half : 2 * half + 1;
    if (isRectangle) sizes.remark = "the largest along x; along y pale";
    sizes.lines = [h, isRectangle](const std::vector<double>& sample) -> std::vector<SizesLine> {
        const std::vector<Complex> c = coefficientsOf(*h, sample);
        if (!isRectangle) return {overInterval(*h, c)};
        return {largestAlong(*h, c, false), largestAlong(*h, c, true)};
    };
    return sizes;
}

PotentialLevels levelsOf(const SharedHamiltonian& h) {
    PotentialLevels levels;
    levels.x = {h, &h->x()};
    levels.V = {h, &h->potential()};
    levels.end = h->domain().left + h->domain().length;
    levels.isPeriodic = h->isPeriodic();
    levels.problem = levelsProblem(*h);
    levels.lowest = [h] { return lowestLevels(h); };
    return levels;
}

}  // namespace

void addWaveParts(System& system, const SharedHamiltonian& h) {
    system.parts.set(sizesOf(h));
    system.parts.set(OnOtherMesh{[h](const System& other) -> OnOtherMesh::Map {
        return [to = WaveResampling(*h, *other.hamiltonian())](const double* x, double* own) {
            to.write(coefficients(x), coefficients(own));
        };
    }});
}

void addLinearWaveParts(System& system, const SharedHamiltonian& h) {
    system.parts.set(levelsOf(h));
    system.parts.set(waveMeshError(h));
    system.parts.set(PremiseCheck{[h](const PremiseCheck::Run& run, const std::function<ExactSolution()>&) {
        return premiseAtWalls(h, run.given);
    }});
}

}  // namespace extremal
