// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/eigenstate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/start/stationary.hpp"

namespace extremal::wave {
namespace {

/// A state of a grid too fine for all of them at once: from the finest grid that is not, refined by Newton's
/// method. Whether it is the same state is seen by its energy, which may move by a fraction of the distance
/// to the next.
StationaryState refinedState(const Hamiltonian& h, int n) {
    const wave::Grid& fine = h.grid();
    const int limit = Eigenstates::denseLimit, nx = fine.dimension() == 2 ? std::min(fine.nx, 22) : limit,
              ny = fine.dimension() == 2 ? std::min(fine.ny, (limit / nx) & ~1) : 1;
    const auto coarse = h.withModes(nx, ny);
    const auto states = Eigenstates::of(coarse);
    const std::vector<Complex> found = states->coefficients(n);
    std::vector<Complex> c(static_cast<std::size_t>(h.size()));
    for (int i = 0; i < coarse->size(); ++i)
        c[static_cast<std::size_t>(h.fourier().placeOf(
            coarse->fourier().number(i), coarse->fourier().numberY(i)))] = found[static_cast<std::size_t>(i)];
    StationaryState state = refineState(h, std::move(c));
    // Of states of nearly one energy, which are mixed anyhow, the nearest that differs.
    const auto& E = states->energies();
    const double own = E[static_cast<std::size_t>(n)], same = 1e-6 * (1 + std::abs(own));
    double gap = std::numeric_limits<double>::infinity();
    for (const double other : E)
        if (std::abs(other - own) > same) gap = std::min(gap, std::abs(other - own));
    state.isConverged = state.isConverged && std::abs(state.energy - own) < 0.3 * gap;
    return state;
}

/// Remembered: a scene is read more than once.
std::vector<Complex> fineState(const std::shared_ptr<const Hamiltonian>& h, int n,
                               const std::string& pointer) {
    static MemoCache<std::pair<std::shared_ptr<const Hamiltonian>, int>, StationaryState> recent(4);
    StationaryState state = recent.get({h, n}, [&] { return refinedState(*h, n); });
    if (!state.isConverged)
        throw InvalidScene(pointer,
                           "state " + std::to_string(n) + " is not to be had: it is looked for from " +
                               std::to_string(Eigenstates::denseLimit) +
                               " modes or fewer, which do not resolve it",
                           "a lower state, fewer modes, or another packet");
    return std::move(state.c);
}

}  // namespace

std::vector<Complex> eigenstateOf(const std::shared_ptr<const Hamiltonian>& h, double n,
                                  const std::string& pointer) {
    if (h->isTimeDependent())
        throw InvalidScene(pointer, "has no eigenstate: the potential depends on t", "another packet");
    const int limit = std::min(h->size(), Eigenstates::denseLimit);
    if (!(n >= 0 && n < limit / 2 && n == std::floor(n)))
        throw InvalidScene(pointer + "/n", "must be a whole number from 0 to " +
                                               std::to_string(limit / 2 - 1) + ", got " + formatNumber(n));
    if (h->size() <= limit) return Eigenstates::of(h)->coefficients(static_cast<int>(n));
    return fineState(h, static_cast<int>(n), pointer);
}

}  // namespace extremal::wave
