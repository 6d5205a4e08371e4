/// Quadrature rules on [0, 1]: integral of f ~ sum_i b_i f(c_i), i = 0..n-1, nodes ascending.
///
/// Nodes and weights are computed (Newton on the orthogonal polynomials), not tabulated, for any number of nodes.
/// `degree` is the highest polynomial degree integrated exactly, so that the rule's order is degree + 1.
/// Double rules are computed in extended precision and rounded: good to 2e-16.
/// Sources: Abramowitz and Stegun 25.4; Waldvogel 2006 for Clenshaw-Curtis.
#pragma once

#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

template <class T>
struct Rule {
    std::vector<T> c;  ///< nodes in [0, 1]
    std::vector<T> b;  ///< weights, sum 1
    int degree = 0;
    bool isSymmetric = true;
    bool isInterpolatory = true;  ///< the weights integrate the polynomial through all nodes
    int size() const { return static_cast<int>(c.size()); }
};

template <class T>
Rule<T> gauss(int n);  ///< n >= 1, degree 2n - 1
template <class T>
Rule<T> lobatto(int n);  ///< n >= 2, both ends are nodes, degree 2n - 3
template <class T>
Rule<T> radau(int n, bool isRight);  ///< n >= 1, one end is a node, degree 2n - 2
template <class T>
Rule<T> clenshawCurtis(int n);  ///< n >= 2, Chebyshev extrema, degree n - 1 (n even) or n (n odd)
template <class T>
Rule<T> midpoint(int panels);  ///< the middles of equal panels, degree 1; one panel is gauss(1)
template <class T>
Rule<T> trapezoid(int panels);  ///< panels + 1 equally spaced nodes, degree 1

/// The rule that a scene's "quadrature" names; its keys are checked and complete.
template <class T>
Rule<T> makeRule(const Settings& quadrature);

}  // namespace extremal
