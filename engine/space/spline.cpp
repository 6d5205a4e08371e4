// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/space/spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/work.hpp"
#include "engine/space/quadruple.hpp"

namespace extremal {
namespace {

/// The clamped knots of a degree: i = 0..2 s + cells.
template <class T>
struct Knots {
    int degree;
    std::vector<T> ends;  ///< of the cells, 0 to 1
    const T& operator()(int i) const {
        return ends[static_cast<std::size_t>(std::clamp(i - degree, 0, static_cast<int>(ends.size()) - 1))];
    }
};

/// Ends of equal cells, rounded to R: those of a twin in quadruple precision are the ones of its double, as
/// rules place their nodes at them.
template <class R, class T>
Knots<T> equalCells(int degree, int cells) {
    Knots<T> knots{degree, {}};
    for (int j = 0; j <= cells; ++j) knots.ends.push_back(T(R(j) / R(cells)));
    return knots;
}

/// The degree + 1 B-splines that are not 0 in the cell [knot(span), knot(span + 1)), and those of one degree
/// less.
template <class T>
struct Local {
    std::vector<T> N, lower;
    Local(const T& tau, int span, const Knots<T>& knot) : N(static_cast<std::size_t>(knot.degree) + 1) {
        const int degree = knot.degree;
        N[0] = T(1);
        for (int p = 1; p <= degree; ++p) {
            if (p == degree) lower.assign(N.begin(), N.begin() + p);
            T saved(0);
            for (int r = 0; r < p; ++r) {
                const auto k = static_cast<std::size_t>(r);
                const T left = knot(span + 1 - p + r), right = knot(span + 1 + r);
                const T share = N[k] / (right - left);
                N[k] = saved + (right - tau) * share;
                saved = (tau - left) * share;
            }
            N[static_cast<std::size_t>(p)] = saved;
        }
    }
};

template <class T>
Space<T> bSplines(Knots<T> knots) {
    const int degree = knots.degree, cells = static_cast<int>(knots.ends.size()) - 1;
    Space<T> space;
    space.size = degree + cells;
    space.degree = degree;
    space.equalCells = cells;
    space.hasKinks = degree == 1 && cells > 1;
    space.evaluate = [degree, cells, knot = std::move(knots)](const T& tau, std::span<T> value,
                                                              std::span<T> derivative) {
        // Cox and de Boor's triangle, and two quotients per function.
        work::spend((std::is_same_v<T, double> ? 1 : work::quadruple) * 3 * (degree + 1) * (degree + 4));
        int span = degree;
        while (span < degree + cells - 1 && tau >= knot(span + 1)) ++span;
        const Local<T> local(tau, span, knot);
        std::fill(value.begin(), value.end(), T(0));
        std::fill(derivative.begin(), derivative.end(), T(0));
        for (int r = 0; r <= degree; ++r) {
            const int a = span - degree + r;
            const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(r);
            value[i] = local.N[k];
            // N_a' = s (M_a / (knot a+s - knot a) - M_{a+1} / (knot a+s+1 - knot a+1)), M of degree s - 1.
            if (r > 0) derivative[i] += T(degree) * local.lower[k - 1] / (knot(a + degree) - knot(a));
            if (r < degree)
                derivative[i] -= T(degree) * local.lower[k] / (knot(a + degree + 1) - knot(a + 1));
        }
    };
    return space;
}

}  // namespace

template <class T>
Space<T> splineSpace(int degree, int cells) {
    if constexpr (std::is_same_v<T, double>)
        return withQuadruple(bSplines(equalCells<double, double>(degree, cells)),
                             bSplines(equalCells<double, Quad>(degree, cells)));
    else
        return bSplines(equalCells<T, T>(degree, cells));
}

Space<double> splineSpace(int degree, const std::vector<double>& cells) {
    Space<double> space =
        withQuadruple(bSplines(Knots<double>{degree, cells}),
                      bSplines(Knots<Quad>{degree, std::vector<Quad>(cells.begin(), cells.end())}));
    space.cells = cells;
    for (std::size_t j = 0; j < cells.size(); ++j)
        space.isSymmetric = space.isSymmetric && std::abs(cells[j] + cells[cells.size() - 1 - j] - 1) < 1e-14;
    return space;
}

template Space<double> splineSpace<double>(int, int);
template Space<Quad> splineSpace<Quad>(int, int);

}  // namespace extremal
