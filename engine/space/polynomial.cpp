// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/space/polynomial.hpp"

#include <cmath>
#include <type_traits>
#include <vector>

#include "engine/quadrature/rule.hpp"
#include "engine/space/quadruple.hpp"

namespace extremal {
namespace {

template <class T>
std::vector<T> controlPoints(int degree, PolynomialBasis basis) {
    if (basis == PolynomialBasis::equispaced) return trapezoid<T>(degree).c;
    if (basis == PolynomialBasis::chebyshev) return clenshawCurtis<T>(degree + 1).c;
    return lobatto<T>(degree + 1).c;
}

/// Cardinal polynomials of the points d: phi_a(tau) = prod_{b != a} (tau - d_b) / (d_a - d_b).
template <class T>
Space<T> nodal(std::vector<T> d) {
    const std::size_t n = d.size();
    std::vector<T> scale(n, T(1));
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
            if (b != a) scale[a] /= d[a] - d[b];
    Space<T> space;
    space.size = static_cast<int>(n);
    space.degree = space.size - 1;
    space.evaluate = [d = std::move(d), scale = std::move(scale), n](const T& tau, std::span<T> value,
                                                                     std::span<T> derivative) {
        for (std::size_t a = 0; a < n; ++a) {
            // Product and its derivative, factor by factor: no division, so tau may be a control point.
            T product(scale[a]), slope(0);
            for (std::size_t b = 0; b < n; ++b) {
                if (b == a) continue;
                slope = slope * (tau - d[b]) + product;
                product *= tau - d[b];
            }
            value[a] = product;
            derivative[a] = slope;
        }
    };
    return space;
}

/// Shifted Legendre or Chebyshev polynomials by their recurrences, differentiated term by term.
template <class T>
Space<T> modal(int degree, bool isLegendre) {
    Space<T> space;
    space.size = degree + 1;
    space.degree = degree;
    space.evaluate = [degree, isLegendre](const T& tau, std::span<T> value, std::span<T> derivative) {
        const T x = 2 * tau - 1;
        value[0] = 1;
        derivative[0] = 0;
        value[1] = x;
        derivative[1] = 2;
        for (int k = 2; k <= degree; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const T a = isLegendre ? T(2 * k - 1) / T(k) : T(2);
            const T b = isLegendre ? T(k - 1) / T(k) : T(1);
            value[i] = a * x * value[i - 1] - b * value[i - 2];
            derivative[i] = a * (x * derivative[i - 1] + 2 * value[i - 1]) - b * derivative[i - 2];
        }
    };
    return space;
}

template <class T>
Space<T> inBasis(int degree, PolynomialBasis basis) {
    if (basis == PolynomialBasis::legendre) return modal<T>(degree, true);
    if (basis == PolynomialBasis::chebyshevModal) return modal<T>(degree, false);
    return nodal(controlPoints<T>(degree, basis));
}

}  // namespace

PolynomialBasis polynomialBasis(std::string_view name) {
    if (name == "chebyshev") return PolynomialBasis::chebyshev;
    if (name == "equispaced") return PolynomialBasis::equispaced;
    if (name == "legendre") return PolynomialBasis::legendre;
    if (name == "chebyshev-modal") return PolynomialBasis::chebyshevModal;
    return PolynomialBasis::lobatto;
}

template <class T>
Space<T> polynomialSpace(int degree, PolynomialBasis basis) {
    if constexpr (std::is_same_v<T, double>)
        return withQuadruple(inBasis<double>(degree, basis), inBasis<Quad>(degree, basis));
    else
        return inBasis<T>(degree, basis);
}

template Space<double> polynomialSpace<double>(int, PolynomialBasis);
template Space<Quad> polynomialSpace<Quad>(int, PolynomialBasis);

}  // namespace extremal
