// SPDX-License-Identifier: GPL-3.0-or-later
/// Quadrature rules on [0, 1]: integral of f ~ sum_i b_i f(c_i), i = 0..n-1, nodes ascending.
///
/// Nodes and weights are computed (Newton on the orthogonal polynomials), not tabulated, for any number of
/// nodes. `degree` is the highest polynomial degree integrated exactly, so that the rule's order is degree
/// + 1. A composite rule repeats a rule in equal panels; two panels that share an end both keep their node
/// there, one just inside each, so that a function whose derivative jumps is seen from both sides. For smooth
/// functions `merged` joins them. Double rules are computed in extended precision and rounded: good to 2e-16.
/// Sources: Abramowitz and Stegun 25.4; Waldvogel 2006 for Clenshaw-Curtis.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

template <class T>
struct Rule {
    std::vector<T> c;  ///< nodes in [0, 1]
    std::vector<T> b;  ///< weights, sum 1
    int degree = 0;
    bool isSymmetric = true;
    int panels = 1;            ///< in each panel the weights integrate the polynomial through its nodes
    int perPanel = 0;          ///< nodes of a panel; merged panels share their ends. 0: all, in one panel
    std::vector<T> ends = {};  ///< of the panels, 0 to 1, where they are not equal ones
    std::string caution = {};  ///< what is doubtful in it; may be empty
    int size() const { return static_cast<int>(c.size()); }
};

template <class T>
Rule<T> gauss(int n);  ///< n >= 1, degree 2n - 1
template <class T>
Rule<T> lobatto(int n);  ///< n >= 2, both ends are nodes, degree 2n - 3
template <class T>
Rule<T> clenshawCurtis(int n);  ///< n >= 2, Chebyshev extrema, degree n - 1 (n even) or n (n odd)
template <class T>
Rule<T> trapezoid(int panels);  ///< panels + 1 equally spaced nodes, degree 1

/// The rule in each of equal panels, whose ends are at j / panels.
template <class T>
Rule<T> composite(const Rule<T>& rule, int panels);
/// In each of panels with these ends, 0 to 1, ascending.
template <class T>
Rule<T> composite(const Rule<T>& rule, const std::vector<T>& ends);
/// Neighbouring nodes that differ by round-off only are made one.
template <class T>
Rule<T> merged(const Rule<T>& rule);

/// share[i] such that sum_i share[i] f(c_i) is the integral from 0 to tau of the polynomials that interpolate
/// f at the nodes of each panel; at tau = 1 the weights. share has rule.size() entries.
template <class T>
void partialWeights(const Rule<T>& rule, const T& tau, std::span<T> share);

/// The rule that a scene's "quadrature" names (quadrature/catalog.hpp); its keys are checked and complete.
/// Throws InvalidScene where no rule has the name, or it has no nodes of its own.
template <class T>
Rule<T> makeRule(const Settings& quadrature);

}  // namespace extremal
