// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of ad_xi on vectors and momenta, by sweeps of brackets: no matrix is made.
///
///     A = phi(-ad_xi),  phi(z) = (e^z - 1)/z = sum z^n / (n+1)!,   eta = A xi'  along g_0 exp(xi)
///     w_0 = xi', w_{n+1} = -[xi, w_n];                             eta = sum_n w_n / (n+1)!
///     lambda_n = m/(n+1)! - ad_xi^T lambda_{n+1};                  A^T m = lambda_0,
///                                                (D_xi eta)^T m = sum_n ad_{w_n}^T lambda_{n+1}
/// for n < N, where |ad_xi|^N / (N+1)! is below round-off. No sweep stops at a small w_n: of a straight curve
/// w_1 is 0, and D_xi eta is not. The series lose e^|ad xi| in round-off: 20 units at a norm of 3.
/// (Leok 2004, sec. 3.2, prints dexp_{ad}: the sign of ad is wrong.)
#pragma once

#include <cmath>
#include <vector>

#include "engine/group/structure_constants.hpp"

namespace extremal::series {

inline constexpr int mostTerms = 48;

/// N with norm^N / (N+1)! < accuracy.
inline int termsFor(double norm, double accuracy) {
    double size = 1;
    int n = 0;
    while (n < mostTerms && !(size < accuracy)) {
        ++n;
        size *= norm / (n + 1);
    }
    return n + 1 < mostTerms ? n + 1 : mostTerms;
}

/// sum_n step^n(v) / n!, where step is +-ad_xi or +-ad_xi^T.
template <class V, class Step>
V exponential(const V& v, int terms, Step&& step) {
    V sum = v, term = v;
    for (int n = 1; n <= terms; ++n) {
        term = step(term) / n;
        sum += term;
    }
    return sum;
}
/// sum_n step^n(v) / (n+1)!.
template <class V, class Step>
V phi(const V& v, int terms, Step&& step) {
    V sum = v, term = v;
    for (int n = 1; n < terms; ++n) {
        term = step(term) / (n + 1);
        sum += term;
    }
    return sum;
}

/// A^-1 eta, to the fourth power of ad_xi: z/(1 - e^-z) = 1 + z/2 + z^2/12 - z^4/720. For guesses.
template <class V>
V inverseOfDexp(const StructureConstants& algebra, const V& xi, const V& eta) {
    const V first = algebra.bracket(xi, eta), second = algebra.bracket(xi, first);
    return eta + first / 2 + second / 12 - algebra.bracket(xi, V(algebra.bracket(xi, second))) / 720;
}

}  // namespace extremal::series
