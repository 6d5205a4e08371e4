// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/ground_state.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

using Nodes = std::vector<double>;

/// Real functions at the nodes, of norm 1, and what E is made of.
class Descent {
public:
    Descent(const Hamiltonian& h, double g, Nodes start)
        : h_(h),
          g_(g),
          n_(start.size()),
          weight_(h.grid().measure() / static_cast<double>(n_)),
          least_(*std::min_element(h.potential().begin(), h.potential().end())),
          u_(std::move(start)),
          Tu_(n_),
          r_(n_),
          z_(n_),
          d_(n_),
          Td_(n_),
          c_(n_),
          psi_(n_) {
        scale(u_);
        onModes(u_, Tu_, [&](std::size_t i) { return h_.kinetic()[i]; });
        measure();
    }

    /// Until the residual is below `share` of the energies that are in it.
    void run(double share, int mostSteps) {
        Nodes before;
        double product = 0;
        for (int k = 0; k < mostSteps && norm(r_) > share * (std::abs(mu_ - least_) + above_); ++k) {
            precondition();
            const double own = inner(z_, r_);
            double turn = 0;
            if (k > 0) {
                turn = own;
                for (std::size_t j = 0; j < n_; ++j) turn -= weight_ * z_[j] * before[j];
                turn = std::max(0.0, turn / product);
            }
            product = own;
            before = r_;
            for (std::size_t j = 0; j < n_; ++j) d_[j] = turn * d_[j] - z_[j];
            if (inner(d_, r_) >= 0)
                for (std::size_t j = 0; j < n_; ++j) d_[j] = -z_[j];
            if (!step()) return;
        }
    }
    const Nodes& u() const { return u_; }
    double energy() const { return energy_; }

private:
    double inner(const Nodes& a, const Nodes& b) const {
        double sum = 0;
        for (std::size_t j = 0; j < n_; ++j) sum += a[j] * b[j];
        return sum * weight_;
    }
    double norm(const Nodes& a) const { return std::sqrt(inner(a, a)); }
    double scale(Nodes& a) const {
        const double size = norm(a);
        for (double& v : a) v /= size;
        return size;
    }
    void removeAlong(Nodes& a) const {
        const double part = inner(a, u_);
        for (std::size_t j = 0; j < n_; ++j) a[j] -= part * u_[j];
    }
    /// out = the function whose coefficients are those of `from` times factor(i).
    template <class Factor>
    void onModes(const Nodes& from, Nodes& out, Factor&& factor) {
        std::copy(from.begin(), from.end(), psi_.begin());
        h_.toCoefficients(psi_.data(), c_.data());
        for (std::size_t i = 0; i < n_; ++i) c_[i] *= factor(i);
        h_.toNodes(c_.data(), psi_.data());
        for (std::size_t j = 0; j < n_; ++j) out[j] = psi_[j].real();
    }
    /// E, mu and the residual at u_.
    void measure() {
        double kinetic = 0, potential = 0, quartic = 0;
        for (std::size_t j = 0; j < n_; ++j) {
            const double density = u_[j] * u_[j];
            kinetic += u_[j] * Tu_[j];
            potential += h_.potential()[j] * density;
            quartic += g_ * density * density;
        }
        energy_ = weight_ * (kinetic + potential + quartic / 2);
        mu_ = energy_ + weight_ * quartic / 2;
        above_ =
            std::max(weight_ * (kinetic + potential + std::max(0.0, quartic)) - least_, 1e-3 * kinetic_());
        for (std::size_t j = 0; j < n_; ++j)
            r_[j] = Tu_[j] + (h_.potential()[j] + g_ * u_[j] * u_[j] - mu_) * u_[j];
    }
    /// Of the second mode: what a box without a potential has.
    double kinetic_() const { return h_.kinetic()[1]; }
    void precondition() {
        const auto root = [&](std::size_t j) {
            return std::sqrt(above_ + h_.potential()[j] - least_ + std::max(0.0, g_) * u_[j] * u_[j]);
        };
        for (std::size_t j = 0; j < n_; ++j) z_[j] = r_[j] / root(j);
        onModes(z_, z_, [&](std::size_t i) { return above_ / (h_.kinetic()[i] + above_); });
        for (std::size_t j = 0; j < n_; ++j) z_[j] /= root(j);
        removeAlong(z_);
    }
    /// Along cos(a) u + sin(a) d with the angle of least E to second order, or a smaller one that lowers it.
    bool step() {
        removeAlong(d_);
        Nodes unit = d_;
        if (!(scale(unit) > 0)) return false;
        onModes(unit, Td_, [&](std::size_t i) { return h_.kinetic()[i]; });
        double bend = inner(unit, Td_) - mu_;
        for (std::size_t j = 0; j < n_; ++j)
            bend += weight_ * (h_.potential()[j] + 3 * g_ * u_[j] * u_[j]) * unit[j] * unit[j];
        const double slope = inner(unit, r_);
        double angle = bend > 0 ? std::min(-slope / bend, 1.0) : 0.1;
        const Nodes u = u_, Tu = Tu_;
        const double E = energy_;
        for (int halving = 0; halving < 30; ++halving, angle /= 2) {
            for (std::size_t j = 0; j < n_; ++j) {
                u_[j] = std::cos(angle) * u[j] + std::sin(angle) * unit[j];
                Tu_[j] = std::cos(angle) * Tu[j] + std::sin(angle) * Td_[j];
            }
            measure();
            if (energy_ <= E) return true;
        }
        return false;
    }

    const Hamiltonian& h_;
    double g_;
    std::size_t n_;
    double weight_, least_, energy_ = 0, mu_ = 0, above_ = 0;
    Nodes u_, Tu_, r_, z_, d_, Td_;
    std::vector<Complex> c_, psi_;
};

/// The nearest to the middle of the nodes where V is least.
std::size_t lowestNode(const Hamiltonian& h) {
    const std::vector<double>& V = h.potential();
    const std::size_t nx = h.x().size();
    const double least = *std::min_element(V.begin(), V.end()), same = least + 1e-9 * (h.highest() - least);
    std::size_t best = 0;
    double nearest = HUGE_VAL;
    for (std::size_t j = 0; j < V.size(); ++j) {
        const double dx = (h.x()[j % nx] - h.grid().x.left) / h.grid().x.length - 0.5,
                     dy =
                         h.dimension() == 2 ? (h.y()[j / nx] - h.grid().y.left) / h.grid().y.length - 0.5 : 0;
        if (V[j] > same || !(dx * dx + dy * dy < nearest - 1e-12)) continue;
        nearest = dx * dx + dy * dy;
        best = j;
    }
    return best;
}

/// A cloud of Thomas and Fermi without a corner; with attraction a packet.
Nodes guessOf(const Hamiltonian& h, double g) {
    const auto n = static_cast<std::size_t>(h.size());
    Nodes u(n);
    if (g > 0) {
        const ThomasFermi cloud = thomasFermi(h, g);
        const double softness = 0.1 * *std::max_element(cloud.density.begin(), cloud.density.end());
        for (std::size_t j = 0; j < n; ++j) {
            const double half = (cloud.mu - h.potential()[j]) / (2 * g);
            u[j] = std::sqrt(half > 0 ? half + std::hypot(half, softness)
                                      : softness * softness / (std::hypot(half, softness) - half));
        }
        return u;
    }
    const std::size_t nx = h.x().size(), place = lowestNode(h);
    const double x0 = h.x()[place % nx], y0 = h.dimension() == 2 ? h.y()[place / nx] : 0,
                 lx = h.grid().x.length, ly = h.grid().y.length;
    for (std::size_t j = 0; j < n; ++j) {
        const double dx = std::remainder(h.x()[j % nx] - x0, lx) / (lx / 10),
                     dy = h.dimension() == 2 ? std::remainder(h.y()[j / nx] - y0, ly) / (ly / 10) : 0;
        u[j] = std::exp(-(dx * dx + dy * dy) / 2);
    }
    return u;
}

}  // namespace

ThomasFermi thomasFermi(const Hamiltonian& h, double g) {
    const std::vector<double>& V = h.potential();
    Nodes sorted = V;
    std::sort(sorted.begin(), sorted.end());
    // sum over the lowest k of (mu - V) = g/weight; the cloud has all nodes below mu.
    const double total = g * h.size() / h.grid().measure();
    double sum = 0;
    ThomasFermi cloud;
    for (std::size_t k = 1; k <= sorted.size(); ++k) {
        sum += sorted[k - 1];
        cloud.mu = (total + sum) / static_cast<double>(k);
        if (k == sorted.size() || cloud.mu <= sorted[k]) break;
    }
    for (const double each : V) cloud.density.push_back(std::max(0.0, cloud.mu - each) / g);
    return cloud;
}

StationaryState groundState(const Hamiltonian& h, double g) {
    constexpr double enough = 1e-6;
    Descent descent(h, g, guessOf(h, g));
    descent.run(enough, 2000);
    const auto n = static_cast<std::size_t>(h.size());
    std::vector<Complex> psi(descent.u().begin(), descent.u().end()), c(n);
    h.toCoefficients(psi.data(), c.data());
    StationaryState state = refineState(h, c, g);
    // The same state: Newton's method moves it by what the descent left.
    double moved = 0;
    for (std::size_t i = 0; i < n; ++i) moved += std::norm(state.c[i] - c[i]);
    state.isConverged = state.isConverged && moved < 1e-4;
    return state;
}

}  // namespace extremal
