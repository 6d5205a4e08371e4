// SPDX-License-Identifier: GPL-3.0-or-later
/// Collocation in time for wave functions with any nodes, and with potentials that depend on time: all stages
/// together by GMRES, preconditioned mode by mode with the kinetic part and the middle of the potential,
///     P_k = 1 + i dt (T_k + Vmid - Ec)/hbar A,   an s x s matrix for each wave number, inverted once.
/// Two transforms an iteration and stage.
#include <Eigen/Core>

#include <algorithm>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/gmres.hpp"
#include "engine/family/wave/wave_collocation.hpp"
#include "engine/quadrature/collocation.hpp"

namespace extremal {
namespace {

class CollocationWave final : public WaveStep {
public:
    CollocationWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift,
                    const Rule<double>& rule, double tolerance, int maxIterations)
        : WaveStep(std::move(hamiltonian), step, shift),
          rule_(rule),
          tolerance_(tolerance),
          maxIterations_(maxIterations),
          size_(static_cast<std::size_t>(n())),
          stages_(static_cast<std::size_t>(rule.size())),
          gmres_(size_ * stages_) {
        for (auto* v : {&rhs_, &z_, &u_, &image_}) v->resize(size_ * stages_);
        psi_.resize(size_);
        V_.resize(size_ * stages_);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<CollocationWave>(*this); }

private:
    void prepare() override {
        const auto s = static_cast<Eigen::Index>(stages_);
        const double factor = dt() / hamiltonian().hbar();
        A_ = collocationMatrix(rule_);
        std::vector<double> share(stages_);
        // v(t + dt) = v + sum_i d_i (U_i - v), d A = b: no product with H once more.
        partialWeights<double>(rule_, 1.0, share);
        const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(share.data(), s);
        const Eigen::VectorXd d = dense::solve<double>(A_.transpose(), b);
        weights_.assign(d.data(), d.data() + s);
        rest_ = 1 - d.sum();
        const auto& V = hamiltonian().potential();
        const auto [low, high] = std::minmax_element(V.begin(), V.end());
        middle_ = (*low + *high) / 2;
        inverse_.resize(stages_ * stages_ * size_);
        for (std::size_t k = 0; k < size_; ++k) {
            if (k % 512 == 0 && stop().stop_requested()) return;
            const Complex y(0, factor * (hamiltonian().kinetic()[k] + middle_ - shift()));
            const Eigen::MatrixXcd P = Eigen::MatrixXcd::Identity(s, s) + y * A_.cast<Complex>();
            Eigen::Map<Eigen::MatrixXcd>(inverse_.data() + k * stages_ * stages_, s, s) =
                dense::inverse<Complex>(P);
        }
    }
    /// u <- P^{-1} z; stage after stage.
    void precondition(const Complex* z, Complex* u) const {
        for (std::size_t k = 0; k < size_; ++k) {
            const Complex* inverse = inverse_.data() + k * stages_ * stages_;
            for (std::size_t i = 0; i < stages_; ++i) {
                double re = 0, im = 0;
                for (std::size_t j = 0; j < stages_; ++j) {
                    const Complex p = inverse[j * stages_ + i], x = z[j * size_ + k];
                    re += p.real() * x.real() - p.imag() * x.imag();
                    im += p.real() * x.imag() + p.imag() * x.real();
                }
                u[i * size_ + k] = {re, im};
            }
        }
    }
    void step(double t, Complex* v, std::vector<double>&, StepReport& report) override {
        const double factor = dt() / hamiltonian().hbar();
        for (std::size_t j = 0; j < stages_; ++j) {
            hamiltonian().potentialAt(t + rule_.c[j] * dt(), V_.data() + j * size_);
            for (std::size_t x = 0; x < size_; ++x)
                V_[j * size_ + x] = factor * (V_[j * size_ + x] - middle_) / static_cast<double>(size_);
            std::copy(v, v + size_, rhs_.begin() + static_cast<std::ptrdiff_t>(j * size_));
        }
        const auto apply = [&](const Complex* z, Complex* out) {
            precondition(z, u_.data());
            for (std::size_t j = 0; j < stages_; ++j) {
                if (stop().stop_requested()) return;  // and so does the solver
                hamiltonian().fourier().rawToNodes(u_.data() + j * size_, psi_.data());
                const double* kick = V_.data() + j * size_;
                for (std::size_t x = 0; x < size_; ++x)
                    psi_[x] = {-kick[x] * psi_[x].imag(), kick[x] * psi_[x].real()};
                hamiltonian().fourier().rawToCoefficients(psi_.data(), image_.data() + j * size_);
                ++report.cost.evaluations;
            }
            std::copy(z, z + size_ * stages_, out);
            for (std::size_t i = 0; i < stages_; ++i)
                for (std::size_t j = 0; j < stages_; ++j) {
                    const double a = A_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                    const Complex* from = image_.data() + j * size_;
                    Complex* to = out + i * size_;
                    for (std::size_t k = 0; k < size_; ++k) to[k] += a * from[k];
                }
        };
        report.outcome = gmres_.solve(apply, rhs_.data(), z_.data(), tolerance_, maxIterations_,
                                      report.cost.iterations, stop());
        if (report.outcome != Outcome::converged) return;
        ++report.cost.linearSolves;
        precondition(z_.data(), u_.data());
        for (std::size_t k = 0; k < size_; ++k) {
            Complex sum = rest_ * v[k];
            for (std::size_t i = 0; i < stages_; ++i) sum += weights_[i] * u_[i * size_ + k];
            v[k] = sum;
        }
    }

    Rule<double> rule_;
    double tolerance_;
    int maxIterations_;
    std::size_t size_, stages_;
    Gmres gmres_;
    Eigen::MatrixXd A_;
    std::vector<double> weights_, V_;
    double rest_ = 0, middle_ = 0;
    std::vector<Complex> inverse_, rhs_, z_, u_, image_, psi_;
};

}  // namespace

Claims collocationClaims(int degree) {
    // The interpolatory rule of symmetric nodes; as a space it is tested at its own nodes, whatever the rule.
    const int order = degree + degree % 2;
    if (degree == 1) return {order, true, true, {"norm", "energy"}};
    return {order, true, false, {"norm if H is constant", "energy"}};
}

std::unique_ptr<WaveStep> makeCollocationWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                              double shift, const Rule<double>& rule, double tolerance,
                                              int maxIterations) {
    return std::make_unique<CollocationWave>(std::move(hamiltonian), step, shift, rule, tolerance,
                                             maxIterations);
}

}  // namespace extremal
