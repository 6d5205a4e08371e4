// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/eigen.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"

namespace extremal {
namespace {

using Matrix = Eigen::MatrixXd;
using ConstMatrix = Eigen::Map<const Matrix>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;

}  // namespace

Eigenstates::Eigenstates(const Hamiltonian& h) : hamiltonian_(h) {
    const auto n = static_cast<std::size_t>(h.size());
    const auto [values, vectors] = dense::symmetricEigen<double>(h.realMatrix());
    energies_.assign(values.data(), values.data() + n);
    states_.assign(vectors.data(), vectors.data() + n * n);
    for (std::size_t k = 0; k < n; ++k) {
        // A sign that does not depend on the library: the largest entry is positive.
        Vector v(states_.data() + k * n, static_cast<Eigen::Index>(n));
        Eigen::Index largest = 0;
        v.cwiseAbs().maxCoeff(&largest);
        if (v(largest) < 0) v = -v;
    }
    if (!h.isSplit()) return;
    // The eigenvalues of the matrix are off by its round-off, which is that of the highest of them. The mean
    // of the energy is a sum of positive numbers, and the square of what a state is off by.
    for (int k = 0; k < size(); ++k) {
        double& E = energies_[static_cast<std::size_t>(k)];
        E = h.energy(0, coefficients(k).data());
        if (k > 0) E = std::max(E, energies_[static_cast<std::size_t>(k - 1)]);
    }
}

std::shared_ptr<const Eigenstates> Eigenstates::of(const std::shared_ptr<const Hamiltonian>& hamiltonian) {
    static MemoCache<std::shared_ptr<const Hamiltonian>, std::shared_ptr<const Eigenstates>> recent(8);
    return recent.get(
        hamiltonian, [&] { return std::make_shared<const Eigenstates>(*hamiltonian); },
        [](const auto& a, const auto& b) { return a->isSameAs(*b); });
}

std::vector<Complex> Eigenstates::coefficients(int n) const {
    const std::size_t size = energies_.size();
    std::vector<Complex> psi(size), c(size);
    for (std::size_t j = 0; j < size; ++j) psi[j] = states_[static_cast<std::size_t>(n) * size + j];
    if (!hamiltonian_.isPeriodic()) return psi;
    hamiltonian_.fourier().rawToCoefficients(psi.data(), c.data());
    for (Complex& v : c) v /= std::sqrt(static_cast<double>(size));
    return c;
}

void Eigenstates::toStates(const double* psi, double* d) const {
    const auto n = static_cast<Eigen::Index>(size());
    const ConstMatrix U(states_.data(), n, n);
    for (const Eigen::Index part : {Eigen::Index{0}, n})
        Vector(d + part, n).noalias() = U.transpose() * ConstVector(psi + part, n);
}

void Eigenstates::fromStates(const double* d, double* psi) const {
    const auto n = static_cast<Eigen::Index>(size());
    const ConstMatrix U(states_.data(), n, n);
    for (const Eigen::Index part : {Eigen::Index{0}, n})
        Vector(psi + part, n).noalias() = U * ConstVector(d + part, n);
}

ExactSolution exactWave(const std::shared_ptr<const Hamiltonian>& hamiltonian, const State& initial) {
    const auto states = Eigenstates::of(hamiltonian);
    const int n = states->size();
    const auto size = static_cast<std::size_t>(n);
    std::vector<Complex> psi(size);
    hamiltonian->toReal(coefficients(initial.x.data()), psi.data());
    Matrix split(n, 2), d(n, 2);
    for (int j = 0; j < n; ++j) {
        split(j, 0) = psi[static_cast<std::size_t>(j)].real();
        split(j, 1) = psi[static_cast<std::size_t>(j)].imag();
    }
    states->toStates(split.data(), d.data());
    // Many times at once are one matrix product.
    return [states, hamiltonian, d, start = initial.t](std::span<const double> t, double* x) {
        const Eigen::Index N = d.rows();
        const auto columns = static_cast<Eigen::Index>(t.size());
        Matrix turned(N, 2 * columns);
        for (Eigen::Index k = 0; k < columns; ++k)
            for (Eigen::Index i = 0; i < N; ++i) {
                const double angle = -states->energies()[static_cast<std::size_t>(i)] *
                                     (t[static_cast<std::size_t>(k)] - start) / hamiltonian->hbar();
                const Complex value = Complex(d(i, 0), d(i, 1)) * std::polar(1.0, angle);
                turned(i, 2 * k) = value.real();
                turned(i, 2 * k + 1) = value.imag();
            }
        const Matrix nodes = ConstMatrix(states->states().data(), N, N) * turned;
        std::vector<Complex> values(static_cast<std::size_t>(N));
        for (Eigen::Index k = 0; k < columns; ++k) {
            for (Eigen::Index j = 0; j < N; ++j)
                values[static_cast<std::size_t>(j)] = Complex(nodes(j, 2 * k), nodes(j, 2 * k + 1));
            hamiltonian->fromReal(values.data(), extremal::coefficients(x + 2 * N * k));
        }
    };
}

}  // namespace extremal
