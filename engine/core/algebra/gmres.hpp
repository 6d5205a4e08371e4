// SPDX-License-Identifier: GPL-3.0-or-later
/// GMRES for complex systems A u = v from u = 0, restarted; A is a callable (const Complex* u, Complex* Au).
///
/// Vectors of length n as contiguous complex numbers; the basis is orthogonalised twice where once loses
/// digits. All memory is taken once. Stops at |v - A u| <= tolerance |v|, with Outcome::diverged after
/// `maxIterations` applications. Source: Saad, Iterative Methods for Sparse Linear Systems (2003), 6.5.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <stop_token>
#include <vector>

#include "engine/core/algebra/complex_vectors.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

class Gmres {
public:
    using Complex = std::complex<double>;

    /// Starts anew after so many steps that the basis takes 64 MB, at most 60 and at least 8.
    explicit Gmres(std::size_t n)
        : Gmres(n, static_cast<int>(std::clamp<std::size_t>(
                       (std::size_t{1} << 22) / std::max<std::size_t>(n, 1), 8, 60))) {}
    Gmres(std::size_t n, int restart)
        : n_(n),
          restart_(restart),
          basis_(std::make_unique_for_overwrite<double[]>(2 * n * static_cast<std::size_t>(restart + 1))),
          residual_(n),
          image_(n) {
        const auto m = static_cast<std::size_t>(restart);
        h_.resize((m + 1) * m);
        sine_.resize(m);
        cosine_.resize(m);
        g_.resize(m + 1);
        y_.resize(m);
    }

    /// A copy has memory of its own, which holds nothing between two solutions.
    Gmres(const Gmres& other) : Gmres(other.n_, other.restart_) {}
    Gmres& operator=(const Gmres&) = delete;

    template <class Apply>
    Outcome solve(Apply&& apply, const Complex* v, Complex* u, double tolerance, int maxIterations,
                  long long& iterations, const std::stop_token& stop) {
        std::fill(u, u + n_, Complex(0));
        const double target = tolerance * norm(v);
        if (!(target > 0)) return std::isfinite(target) ? Outcome::converged : Outcome::notFinite;
        std::copy(v, v + n_, residual_.begin());
        double before = target / tolerance;
        for (int used = 0; used < maxIterations;) {
            const int steps = cycle(apply, u, target, std::min(restart_, maxIterations - used), stop);
            used += steps;
            iterations += steps;
            if (stop.stop_requested()) return Outcome::stopped;
            if (g_[static_cast<std::size_t>(steps)] == Complex(-1)) return Outcome::notFinite;
            if (std::abs(g_[static_cast<std::size_t>(steps)]) <= target) return Outcome::converged;
            apply(u, image_.data());
            ++iterations;
            for (std::size_t i = 0; i < n_; ++i) residual_[i] = v[i] - image_[i];
            const double left = norm(residual_.data());
            if (left <= target) return Outcome::converged;
            if (!(left < 0.9 * before)) return Outcome::diverged;  // a whole cycle without progress
            before = left;
        }
        return Outcome::diverged;
    }

private:
    double norm(const Complex* v) const {
        double square = 0;
        vectors_.square(v, n_, &square);
        return std::sqrt(square);
    }
    Complex& h(int row, int column) {
        return h_[static_cast<std::size_t>(column) * static_cast<std::size_t>(restart_ + 1) +
                  static_cast<std::size_t>(row)];
    }
    Complex* q(int k) { return reinterpret_cast<Complex*>(basis_.get()) + static_cast<std::size_t>(k) * n_; }

    /// Up to `steps` directions from residual_; adds the correction to u. g_[k] of the result k is the
    /// residual left.
    template <class Apply>
    int cycle(Apply&& apply, Complex* u, double target, int steps, const std::stop_token& stop) {
        const double size = norm(residual_.data());
        for (std::size_t i = 0; i < n_; ++i) q(0)[i] = residual_[i] / size;
        std::fill(g_.begin(), g_.end(), Complex(0));
        g_[0] = size;
        int k = 0;
        while (k < steps && std::abs(g_[static_cast<std::size_t>(k)]) > target && !stop.stop_requested()) {
            Complex* next = q(k + 1);
            apply(q(k), next);
            const double before = norm(next);
            if (!std::isfinite(before)) {
                g_[0] = -1;
                return 0;
            }
            for (int i = 0; i <= k; ++i) h(i, k) = 0;
            double after = before;
            for (int pass = 0; pass < 2; ++pass) {
                const double start = after;
                for (int i = 0; i <= k; ++i) {
                    // Vectors of a plane have a megabyte: what is left undone is given up with the rest.
                    if (stop.stop_requested()) return k;
                    Complex along;
                    vectors_.dot(q(i), next, n_, &along);
                    h(i, k) += along;
                    vectors_.add(next, -along, q(i), n_);
                }
                after = norm(next);
                if (after > 0.5 * start) break;
            }
            h(k + 1, k) = after;
            if (after > 0)
                for (std::size_t i = 0; i < n_; ++i) next[i] /= after;
            rotate(k);
            ++k;
            if (!(after > 0)) break;
        }
        for (int i = k - 1; i >= 0; --i) {  // back substitution, in place of g
            Complex sum = g_[static_cast<std::size_t>(i)];
            for (int j = i + 1; j < k; ++j) sum -= h(i, j) * y_[static_cast<std::size_t>(j)];
            y_[static_cast<std::size_t>(i)] = sum / h(i, i);
        }
        for (int i = 0; i < k; ++i) vectors_.add(u, y_[static_cast<std::size_t>(i)], q(i), n_);
        return k;
    }
    /// Givens rotations that make column k of h upper triangular, applied to g as well.
    void rotate(int k) {
        for (int i = 0; i < k; ++i) {
            const auto s = static_cast<std::size_t>(i);
            const Complex a = h(i, k), b = h(i + 1, k);
            h(i, k) = cosine_[s] * a + std::conj(sine_[s]) * b;
            h(i + 1, k) = -sine_[s] * a + cosine_[s] * b;
        }
        const auto s = static_cast<std::size_t>(k);
        const Complex a = h(k, k), b = h(k + 1, k);
        const double length = std::sqrt(std::norm(a) + std::norm(b));
        const Complex phase = std::abs(a) > 0 ? a / std::abs(a) : Complex(1);
        cosine_[s] = std::abs(a) / length;
        sine_[s] = b / (phase * length);
        h(k, k) = phase * length;
        h(k + 1, k) = 0;
        const Complex old = g_[s];
        g_[s] = cosine_[s] * old;
        g_[s + 1] = -sine_[s] * old;
    }

    const ComplexVectors& vectors_ = ComplexVectors::ofThisMachine();
    std::size_t n_;
    int restart_;
    std::unique_ptr<double[]> basis_;  ///< as it comes: what no step reaches is never touched
    std::vector<Complex> residual_, image_, h_, sine_, g_, y_;
    std::vector<double> cosine_;
};

}  // namespace extremal
