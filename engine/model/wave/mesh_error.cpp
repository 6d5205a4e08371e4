// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/start/cloud.hpp"
#include "engine/model/wave/start/packet.hpp"
#include "engine/model/wave/resampling.hpp"

namespace extremal {
namespace {

using Shared = std::shared_ptr<const Hamiltonian>;
using Coefficients = std::vector<Complex>;

constexpr int meshSamples = 101;  ///< of a run

double differenceOf(const Coefficients& a, const Coefficients& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::norm(a[i] - b[i]);
    return std::sqrt(sum);
}

/// The wave function of the scene on another mesh; empty where it is known on its own mesh alone.
Coefficients startOn(const Shared& h, const Settings& given) {
    const Value* const psi = given.find("psi");
    if (!psi || psi->find("values")) return {};
    // A state of a mesh is the function to be followed; that of another one may differ by a phase.
    if (const Value* const name = psi->find("packet");
        name && name->isString() && (name->asString() == "eigenstate" || wave::isAtRest(*psi)))
        return {};
    try {
        return wave::makePacket(*psi, "/psi", given.flag("normalise"), h,
                                {{"hbar", h->hbar()}, {"m", h->mass()}});
    } catch (const InvalidScene&) {
        return {};
    }
}

State stateOf(double t, const Coefficients& c) {
    const double* const numbers = reinterpret_cast<const double*>(c.data());
    return {t, 0, {numbers, numbers + 2 * c.size()}, {}};
}

class Meshes {
public:
    Meshes(const MeshError::Run& run, Shared h, const std::stop_token& stop)
        : run_(run), h_(std::move(h)), initial_(run.initial), stop_(stop) {}

    /// The largest distance of the motions on two meshes, the coarse one first.
    double between(const Shared& coarse, const State& low, const Shared& fine, const State& high) const {
        const WaveResampling embed(*coarse, *fine);
        const ExactSolution a = exactWave(coarse, low), b = exactWave(fine, high);
        std::vector<double> x(low.x.size());
        Coefficients y(static_cast<std::size_t>(fine->size()));
        double most = 0;
        for (int k = 0; k < meshSamples && !stop_.stop_requested(); ++k) {
            a(time(k), x);
            b(time(k), {reinterpret_cast<double*>(y.data()), 2 * y.size()});
            most = std::max(most, differenceOf(embed(coefficients(x.data())), y));
        }
        return most;
    }
    double againstFiner(const Shared& fine) const {
        Coefficients start = startOn(fine, run_.given);
        if (start.empty()) start = WaveResampling(*h_, *fine)(coefficients(initial_.x.data()));
        return between(h_, initial_, fine, stateOf(initial_.t, start));
    }
    double againstCoarser(const Shared& coarse) const {
        const Coefficients start = startOn(coarse, run_.given);
        return start.empty() ? 0 : between(coarse, stateOf(initial_.t, start), h_, initial_);
    }
    /// By the trapezoidal rule over the run.
    double boundBy(const Shared& fine, const ExactSolution& motion) const {
        const WaveResampling embed(*h_, *fine);
        const auto n = static_cast<std::size_t>(h_->size()), m = static_cast<std::size_t>(fine->size());
        Coefficients low(n), high(m), workLow(n), workHigh(m);
        std::vector<double> V(n), fineV(m);
        std::vector<double> x(initial_.x.size());
        const Coefficients start = startOn(fine, run_.given);
        double error = start.empty() ? 0 : differenceOf(embed(coefficients(initial_.x.data())), start);
        const double step = std::abs(run_.end - run_.start) / (meshSamples - 1);
        for (int k = 0; k < meshSamples && !stop_.stop_requested(); ++k) {
            motion(time(k), x);
            h_->potentialAt(time(k), V.data());
            fine->potentialAt(time(k), fineV.data());
            h_->apply(V.data(), coefficients(x.data()), low.data(), workLow.data());
            fine->apply(fineV.data(), embed(coefficients(x.data())).data(), high.data(), workHigh.data());
            const double defect = differenceOf(embed(low.data()), high) / h_->hbar();
            error += defect * step * (k == 0 || k == meshSamples - 1 ? 0.5 : 1);
        }
        return error;
    }

private:
    double time(int k) const { return run_.start + (run_.end - run_.start) * k / (meshSamples - 1); }
    const MeshError::Run& run_;
    Shared h_;
    const State& initial_;
    const std::stop_token& stop_;
};

Shared refined(const Hamiltonian& h) {
    const wave::Grid& grid = h.grid();
    return h.withModes(2 * grid.nx, grid.ny > 1 ? 2 * grid.ny : 1);
}

/// What is said, from what was found in the coefficients.
double asSeenAtNodes(double found, const Hamiltonian& h, const State& initial) {
    // At the nodes of the coarse mesh, where schemes are compared, it may be a little larger than as a
    // function.
    constexpr double atNodes = 1.2;
    // Two unit vectors are not further apart than 2.
    return std::min(atNodes * found, 2 * std::sqrt(squaredNorm(coefficients(initial.x.data()), h.size())));
}

double ofExact(const Shared& h, const MeshError::Run& run, const std::stop_token& stop) {
    const Meshes error(run, h, stop);
    const wave::Grid& grid = h->grid();
    const int ny = grid.ny > 1 ? 2 * grid.ny : 1;
    double found = 0;
    if (2 * grid.nx * ny <= Eigenstates::denseLimit)
        found = error.againstFiner(refined(*h));
    else if (h->isSplit())
        found = error.boundBy(refined(*h), exactWave(h, run.initial));
    else
        found = error.againstCoarser(h->withModes(grid.nx / 2));
    return asSeenAtNodes(found, *h, run.initial);
}

}  // namespace

MeshError waveMeshError(Shared h) {
    return {[h](const MeshError::Run& run, const std::stop_token& stop) { return ofExact(h, run, stop); },
            [h](const MeshError::Run& run, const ExactSolution& motion, const std::stop_token& stop) {
                return asSeenAtNodes(Meshes(run, h, stop).boundBy(refined(*h), motion), *h, run.initial);
            }};
}

}  // namespace extremal
