// SPDX-License-Identifier: GPL-3.0-or-later
/// A finite-dimensional function space on one step, tau in [0, 1]: the span of basis functions phi_a, a =
/// 0..size-1.
///
/// The unknown curve is q(tau) = sum_a z_a phi_a(tau), one coefficient vector z_a in R^d per basis function.
/// A space is data: a size and a function that evaluates the basis anywhere (also outside [0, 1], but for
/// typed functions: the extrapolated curve of a step is the starting value of the next one).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

template <class T>
struct Space {
    int size = 0;    ///< number of basis functions
    int degree = 0;  ///< highest degree of polynomials contained
    /// Fills value[a] = phi_a(tau) and derivative[a] = phi_a'(tau) (derivative by tau, not by t).
    std::function<void(const T& tau, std::span<T> value, std::span<T> derivative)> evaluate;
    bool hasKinks = false;      ///< the derivative jumps inside [0, 1]: rules keep a node on both sides
    bool isSymmetric = true;    ///< with phi(tau) it has phi(1 - tau)
    bool continues = true;      ///< can be evaluated beyond 1, where it then makes starting values
    int equalCells = 1;         ///< where they are equal ones
    std::vector<T> cells = {};  ///< their ends, 0 to 1, where they are not
    /// The basis is that of the table already (action/table.hpp): 1, the interior functions, the last.
    bool isAdapted = false;
    /// The same in quadruple precision, or empty: with it the tables of ill-conditioned bases are computed
    /// without loss of digits (action/table.hpp).
    std::function<void(__float128 tau, std::span<__float128> value, std::span<__float128> derivative)>
        evaluateQuadruple = {};
};

/// The space that a scene's "space" names (space/catalog.hpp); its keys are checked and complete.
Space<double> makeSpace(const Settings& space);

}  // namespace extremal
