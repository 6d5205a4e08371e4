// SPDX-License-Identifier: GPL-3.0-or-later
/// Gram-Schmidt with pivoting, twice, in any precision: what typed functions are made independent with.
/// Internal to engine/space.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/work.hpp"

namespace extremal {

template <class T>
using LongVector = std::vector<T>;

/// Counts as many operations (core/work.hpp).
template <class T>
void spendOn(std::size_t operations) {
    work::spend(static_cast<double>(operations) *
                (std::is_same_v<T, Quad> ? work::quadruple : work::hundredDigits));
}

template <class T>
T dot(const LongVector<T>& a, const LongVector<T>& b) {
    spendOn<T>(a.size());
    T sum(0);
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}
/// a += factor b.
template <class T>
void addTo(LongVector<T>& a, const T& factor, const LongVector<T>& b) {
    spendOn<T>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}
template <class T>
T norm(const LongVector<T>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}

/// Orthonormal vectors q_j = sum_a coefficient[j][a] f_a of given vectors f_a, in the order of the pivots:
/// pivot[j] is what is left of the largest remaining f_a of norm 1.
template <class T>
struct Orthonormal {
    std::vector<LongVector<T>> vector, coefficient;
    std::vector<double> pivot;
    std::vector<std::size_t> order;  ///< f_order[j] gave q_j

    /// Stops where the pivot is at most `least`.
    Orthonormal(const std::vector<LongVector<T>>& given, double least) {
        const std::size_t n = given.size();
        std::vector<LongVector<T>> left = given, made(n, LongVector<T>(n, T(0)));
        for (std::size_t a = 0; a < n; ++a) {
            const T size = norm(left[a]);
            if (size > 0) scale(left[a], T(1) / size);
            if (size > 0) made[a][a] = T(1) / size;
        }
        std::vector<std::size_t> rest;
        for (std::size_t a = 0; a < n; ++a) rest.push_back(a);
        while (!rest.empty()) {
            const auto best = std::max_element(rest.begin(), rest.end(), [&](std::size_t a, std::size_t b) {
                return dot(left[a], left[a]) < dot(left[b], left[b]);
            });
            const std::size_t a = *best;
            rest.erase(best);
            remove(left[a], &made[a]);
            const T size = norm(left[a]);
            if (!(static_cast<double>(size) > least)) {
                pivot.push_back(static_cast<double>(size));
                order.push_back(a);
                return;
            }
            scale(left[a], T(1) / size);
            scale(made[a], T(1) / size);
            pivot.push_back(static_cast<double>(size));
            order.push_back(a);
            vector.push_back(std::move(left[a]));
            coefficient.push_back(std::move(made[a]));
            for (const std::size_t b : rest) {
                const T along = -dot(vector.back(), left[b]);
                addTo(left[b], along, vector.back());
                addTo(made[b], along, coefficient.back());
            }
        }
    }

    std::size_t rank() const { return vector.size(); }

    /// What is left of a vector, twice; `combination` follows it.
    void remove(LongVector<T>& v, LongVector<T>* combination = nullptr) const {
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t j = 0; j < vector.size(); ++j) {
                const T along = -dot(vector[j], v);
                addTo(v, along, vector[j]);
                if (combination) addTo(*combination, along, coefficient[j]);
            }
    }
    /// |v - its projection| / |v|.
    double distance(LongVector<T> v) const {
        const T whole = norm(v);
        remove(v);
        return whole > 0 ? static_cast<double>(norm(v) / whole) : 0;
    }

private:
    static void scale(LongVector<T>& v, const T& factor) {
        for (T& x : v) x *= factor;
    }
};

}  // namespace extremal
