// SPDX-License-Identifier: GPL-3.0-or-later
/// P5 of the table of peers by the best that is known for i c' = H c with an H that does not change:
/// Chebyshev and Lanczos (exponential_peers.hpp). H is applied by two transforms, or, since the potential is
/// a cosine, as a matrix of Fourier coefficients with three diagonals; its spectrum is as it is, or with
/// kinetic energies above `most` made that, which no packet of much less energy feels (Kosloff 1988, J. Phys.
/// Chem. 92, 2087).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/bench/exponential_peers.hpp"
#include "tests/bench/wave_costs.hpp"

namespace extremal::bench {

inline void scaleParts(double* to, const double* from, const double* by, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) to[i] = from[i] * by[i];
}
inline void addScaledParts(double* to, const double* from, const double* by, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) to[i] += from[i] * by[i];
}
/// Three diagonals on a ring of real and imaginary parts.
inline void applyRing(const double* v, double* Hv, const double* diagonal, double beside, std::size_t size) {
    for (std::size_t i = 2; i + 2 < size; ++i) Hv[i] = diagonal[i] * v[i] + beside * (v[i - 2] + v[i + 2]);
    for (const std::size_t i : {std::size_t(0), std::size_t(1), size - 2, size - 1})
        Hv[i] = diagonal[i] * v[i] + beside * (v[(i + size - 2) % size] + v[(i + 2) % size]);
}

class WaveByHand {
public:
    explicit WaveByHand(const WaveProblem& p, double most = std::numeric_limits<double>::infinity())
        : h_(*p.system.hamiltonian()), size_(2 * static_cast<std::size_t>(h_.size())) {
        const std::vector<double>& V = h_.potential();
        const double mean = h_.potentialHarmonics()[0].real();
        beside_ = h_.harmonics() == 1 ? h_.potentialHarmonics()[1].real() : std::nan("");
        lowest_ = *std::min_element(V.begin(), V.end());
        highest_ = *std::max_element(V.begin(), V.end());
        double kinetic = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const double T = std::min(h_.kinetic()[i / 2], most);
            kinetic = std::max(kinetic, T);
            kinetic_.push_back(T);
            diagonal_.push_back(T + mean);
            potential_.push_back(V[i / 2] / (static_cast<double>(size_) / 2));
        }
        highest_ += kinetic;
        psi_.resize(size_ / 2);
    }
    void byTransforms(const double* v, double* Hv) {
        h_.fourier().rawToNodes(coefficients(v), psi_.data());
        double* const psi = reinterpret_cast<double*>(psi_.data());
        ForThisMachine<&scaleParts>::call()(psi, psi, potential_.data(), size_);
        h_.fourier().rawToCoefficients(psi_.data(), coefficients(Hv));
        ForThisMachine<&addScaledParts>::call()(Hv, v, kinetic_.data(), size_);
    }
    void byDiagonals(const double* v, double* Hv) const {
        ForThisMachine<&applyRing>::call()(v, Hv, diagonal_.data(), beside_, size_);
    }
    std::vector<double> chebyshev(const WaveProblem& p, double tolerance, bool isByDiagonals) {
        std::vector<double> c = p.start.x;
        propagateByChebyshev(
            c, p.T / h_.hbar(), lowest_, highest_, tolerance,
            [&](const double* v, double* Hv) { isByDiagonals ? byDiagonals(v, Hv) : byTransforms(v, Hv); });
        return c;
    }
    std::vector<double> lanczos(const WaveProblem& p, int dimension, int n, bool isByDiagonals) {
        std::vector<double> c = p.start.x;
        LanczosPropagation(size_, static_cast<std::size_t>(dimension))
            .run(c, p.T / h_.hbar(), n, [&](const double* v, double* Hv) {
                isByDiagonals ? byDiagonals(v, Hv) : byTransforms(v, Hv);
            });
        return c;
    }

private:
    const Hamiltonian& h_;
    std::size_t size_;
    double beside_ = 0, lowest_ = 0, highest_ = 0;
    std::vector<double> kinetic_, diagonal_, potential_;
    std::vector<Complex> psi_;
};

/// Names of those that cut the spectrum begin with "cut".
inline void addWavesByHand(std::vector<Curve>& curves, const WaveProblem& p) {
    for (const bool isByDiagonals : {false, true}) {
        const std::string how = isByDiagonals ? ", three diagonals" : " with FFTW";
        curves.push_back(measure("Chebyshev" + how, true, ratios(1e-3, 1e-17, 0.1), 0.2, [&](double e) {
            return std::vector<double>{errorOf(p, WaveByHand(p).chebyshev(p, e, isByDiagonals))};
        }));
        for (const double most : {200.0, 300.0, 400.0, 500.0, 650.0, 800.0, 1200.0})
            curves.push_back(measure("cut at " + std::to_string(static_cast<int>(most)) + ", Chebyshev" + how,
                                     true, ratios(1e-3, 1e-17, 0.1), 0.2, [&](double e) {
                                         return std::vector<double>{
                                             errorOf(p, WaveByHand(p, most).chebyshev(p, e, isByDiagonals))};
                                     }));
        for (const int dimension : {12, 24, 48})
            curves.push_back(
                measure("Lanczos " + std::to_string(dimension) + how, true, counts(2, 2000, 1.25), 0.03,
                        [&](double n) {
                            return std::vector<double>{errorOf(
                                p, WaveByHand(p).lanczos(p, dimension, static_cast<int>(n), isByDiagonals))};
                        }));
    }
}

}  // namespace extremal::bench
