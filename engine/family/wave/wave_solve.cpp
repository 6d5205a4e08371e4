// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave_solve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/family/wave/wave_poles.hpp"
#include "engine/model/wave/basis/eigen.hpp"

namespace extremal {
namespace {

class BandedInverse final : public ShiftedInverse {
public:
    BandedInverse(const Hamiltonian& h, double dt, double shift, Complex zeta)
        : poles_(cyclicBand(h, dt, shift), {zeta}, {Complex(1)}, 0) {}
    Outcome apply(Complex* v, StepReport& report, const std::stop_token&) override {
        poles_.apply(v);
        ++report.cost.linearSolves;
        return Outcome::converged;
    }

private:
    BandedPoles poles_;
};

class KrylovInverse final : public ShiftedInverse {
public:
    KrylovInverse(const std::shared_ptr<const Hamiltonian>& h, double dt, double shift, Complex zeta,
                  double tolerance, int maxIterations)
        : poles_(h, dt, shift, {zeta}, tolerance, maxIterations), w_(static_cast<std::size_t>(h->size())) {}
    Outcome apply(Complex* v, StepReport& report, const std::stop_token& stop) override {
        const Outcome outcome = poles_.solve(0, v, w_.data(), report, stop);
        if (outcome == Outcome::converged) std::copy(w_.begin(), w_.end(), v);
        return outcome;
    }

private:
    WavePoles poles_;
    std::vector<Complex> w_;
};

class DenseInverse final : public ShiftedInverse {
public:
    DenseInverse(const std::shared_ptr<const Hamiltonian>& h, double dt, double shift, Complex zeta)
        : h_(h), states_(Eigenstates::of(h)) {
        const auto n = static_cast<std::size_t>(h->size());
        for (const double E : states_->energies())
            factor_.push_back(1.0 / (zeta + Complex(0, dt * (E - shift) / h->hbar())));
        psi_.resize(n);
        parts_.resize(2 * n);
        d_.resize(2 * n);
    }
    Outcome apply(Complex* v, StepReport& report, const std::stop_token&) override {
        const std::size_t n = psi_.size();
        h_->toReal(v, psi_.data());
        for (std::size_t j = 0; j < n; ++j) {
            parts_[j] = psi_[j].real();
            parts_[n + j] = psi_[j].imag();
        }
        states_->toStates(parts_.data(), d_.data());
        for (std::size_t i = 0; i < n; ++i) {
            const double re = d_[i], im = d_[n + i], fr = factor_[i].real(), fi = factor_[i].imag();
            d_[i] = fr * re - fi * im;
            d_[n + i] = fr * im + fi * re;
        }
        states_->fromStates(d_.data(), parts_.data());
        for (std::size_t j = 0; j < n; ++j) psi_[j] = {parts_[j], parts_[n + j]};
        h_->fromReal(psi_.data(), v);
        ++report.cost.linearSolves;
        return Outcome::converged;
    }

private:
    std::shared_ptr<const Hamiltonian> h_;
    std::shared_ptr<const Eigenstates> states_;
    std::vector<Complex> factor_, psi_;
    std::vector<double> parts_, d_;
};

}  // namespace

CyclicBand cyclicBand(const Hamiltonian& h, double dt, double shift) {
    const double factor = dt / h.hbar();
    const auto& V = h.potentialHarmonics();
    CyclicBand Y;
    for (const double T : h.kinetic()) Y.diagonal.push_back(factor * (T + V[0].real() - shift));
    for (int m = 1; m <= std::max(1, h.harmonics()); ++m)
        Y.offDiagonal.push_back(factor * V[static_cast<std::size_t>(m)]);
    return Y;
}

std::unique_ptr<ShiftedInverse> makeShiftedInverse(WaveSolver solver,
                                                   const std::shared_ptr<const Hamiltonian>& hamiltonian,
                                                   double dt, double shift, Complex zeta, double tolerance,
                                                   int maxIterations) {
    if (solver == WaveSolver::banded) return std::make_unique<BandedInverse>(*hamiltonian, dt, shift, zeta);
    if (solver == WaveSolver::dense) return std::make_unique<DenseInverse>(hamiltonian, dt, shift, zeta);
    return std::make_unique<KrylovInverse>(hamiltonian, dt, shift, zeta, tolerance, maxIterations);
}

}  // namespace extremal
