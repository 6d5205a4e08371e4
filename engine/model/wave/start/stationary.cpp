// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/stationary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/algebra/gmres.hpp"

namespace extremal {
namespace {

/// The KKT matrix at (c, E) and its preconditioner; vectors have dc, then dE.
class KktSystem {
public:
    KktSystem(const Hamiltonian& h, const std::vector<Complex>& c)
        : h_(h), c_(c), n_(c.size()), image_(n_), work_(n_), scaled_(n_ + 1) {}

    /// `V`: the potential, with 3 g psi^2 where there is an interaction; it must stay where it is.
    void setState(double E, const std::vector<double>& V) {
        E_ = E;
        V_ = V.data();
        double mean = 0;
        for (const double each : V) mean += each / static_cast<double>(n_);
        mean_ = mean;
        // T + mean - E passes through zero near the state's own wave numbers; what counts is that it is large
        // where T is.
        const double floor = std::max({1e-3 * std::abs(E), std::abs(mean_ - E), 1e-12 * h_.highest()});
        inverse_.clear();
        for (const double T : h_.kinetic()) inverse_.push_back(1 / std::max(T + mean_ - E, floor));
        dividend_ = 0;
        for (std::size_t i = 0; i < n_; ++i) dividend_ += inverse_[i] * std::norm(c_[i]);
    }
    /// out = K P^{-1} u.
    void apply(const Complex* u, Complex* out) {
        precondition(u, scaled_.data());
        h_.apply(V_, scaled_.data(), image_.data(), work_.data());
        const Complex dE = scaled_[n_];
        Complex last = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            out[i] = image_[i] - E_ * scaled_[i] - dE * c_[i];
            last -= std::conj(c_[i]) * scaled_[i];
        }
        out[n_] = last;
    }
    /// out = P^{-1} u, P = [D, -c; -c*, 0] with the diagonal D.
    void precondition(const Complex* u, Complex* out) const {
        Complex sum = u[n_];
        for (std::size_t i = 0; i < n_; ++i) sum += std::conj(c_[i]) * inverse_[i] * u[i];
        const Complex dE = -sum / dividend_;
        for (std::size_t i = 0; i < n_; ++i) out[i] = inverse_[i] * (u[i] + dE * c_[i]);
        out[n_] = dE;
    }

private:
    const Hamiltonian& h_;
    const std::vector<Complex>& c_;
    std::size_t n_;
    double E_ = 0, mean_ = 0, dividend_ = 0;
    const double* V_ = nullptr;
    std::vector<double> inverse_;
    std::vector<Complex> image_, work_, scaled_;
};

/// The potential with that of the interaction at c, and how it changes with a real psi.
class MeanField {
public:
    MeanField(const Hamiltonian& h, double g)
        : h_(h), g_(g), own_(h.potential()), change_(own_), psi_(own_.size()) {}
    void setState(const Complex* c) {
        if (g_ == 0) return;
        h_.toNodes(c, psi_.data());
        for (std::size_t j = 0; j < psi_.size(); ++j) {
            const double density = g_ * psi_[j].real() * psi_[j].real();
            own_[j] = h_.potential()[j] + density;
            change_[j] = own_[j] + 2 * density;
        }
    }
    const std::vector<double>& own() const { return own_; }
    const std::vector<double>& change() const { return change_; }

private:
    const Hamiltonian& h_;
    double g_;
    std::vector<double> own_, change_;
    std::vector<Complex> psi_;
};

}  // namespace

StationaryState refineState(const Hamiltonian& h, std::vector<Complex> guess, double g) {
    constexpr int mostSteps = 12, mostIterations = 600;
    const int n = h.size();
    const auto size = static_cast<std::size_t>(n);
    StationaryState s;
    s.c = std::move(guess);
    KktSystem system(h, s.c);
    MeanField field(h, g);
    Gmres gmres(size + 1);
    std::vector<Complex> image(size), work(size), rhs(size + 1), u(size + 1), step(size + 1);
    const double norm = std::sqrt(squaredNorm(s.c.data(), n));
    for (Complex& v : s.c) v /= norm;
    const double roundOff =
        std::numeric_limits<double>::epsilon() * std::max(std::abs(h.highest()), std::abs(h.lowest()));
    for (int k = 0; k <= mostSteps; ++k) {
        field.setState(s.c.data());
        h.apply(field.own().data(), s.c.data(), image.data(), work.data());
        if (k == 0) s.energy = innerProduct(s.c.data(), image.data(), n).real();
        s.history.push_back(s.energy);
        for (std::size_t i = 0; i < size; ++i) rhs[i] = -(image[i] - s.energy * s.c[i]);
        rhs[size] = -(1 - squaredNorm(s.c.data(), n)) / 2;
        s.residual = std::sqrt(squaredNorm(rhs.data(), n));
        const double moved = k > 0 ? std::abs(s.energy - s.history[s.history.size() - 2]) : 1e300;
        s.isConverged = moved <= std::max(1e-13 * std::abs(s.energy), 4 * roundOff);
        // Around a circle nothing holds a state with attraction in its place: one more step from round-off
        // moves it along.
        if (g != 0) s.isConverged = s.residual <= 10 * roundOff;
        if (s.isConverged || k == mostSteps || !std::isfinite(s.residual)) break;
        system.setState(s.energy, field.change());
        long long iterations = 0;
        // Quadratic convergence asks for a relative error of the size of the residual and no less.
        const double tolerance = std::clamp(0.1 * s.residual / (1 + std::abs(s.energy)), 1e-9, 1e-2);
        const Outcome outcome = gmres.solve([&](const Complex* from, Complex* to) { system.apply(from, to); },
                                            rhs.data(), u.data(), tolerance, mostIterations, iterations, {});
        if (outcome == Outcome::notFinite) break;
        system.precondition(u.data(), step.data());
        for (std::size_t i = 0; i < size; ++i) s.c[i] += step[i];
        s.energy += step[size].real();
    }
    return s;
}

}  // namespace extremal
