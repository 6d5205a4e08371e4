// SPDX-License-Identifier: GPL-3.0-or-later
/// The elliptic problem with a fast coefficient, (a(x/epsilon) u')' = f on (0, 1), u(0) = u(1) = 0, and its
/// finite elements.
///
/// Exact solution, from R(x) = int_0^x ds / a(s/epsilon), F(x) = int_0^x f and G(x) = int_0^x F / a:
///     u = G - (G(1) / R(1)) R.
/// Elements: hat functions (`linear`), or the solutions of (a phi')' = 0 with the same nodal values
/// (`multiscale`),
///     phi_i(x) = (R(x) - R(x_{i-1})) / (R(x_i) - R(x_{i-1})) on the left of x_i, likewise on the right,
/// with which the nodal values are exact, however coarse the mesh; stiffness 1 / (R(x_{i+1}) - R(x_i)), load
/// int f phi_i. Linear ones see the mean of a in place of its harmonic mean until the mesh resolves epsilon.
///
/// All integrals go over panels that end at the nodes, each at most epsilon/4 wide, by Gauss' rule with 12
/// nodes; R and G are sums of panels in extended precision. `a` has period 1 or any other scale of order 1 in
/// s = x/epsilon, and must be positive. Throws InvalidScene (pointers below /model) where it is not, or where
/// the panels would be too many. Source: Leok 2004, sec. 7.1.
#pragma once

#include <functional>
#include <vector>

namespace extremal {

struct EllipticProblem {
    std::function<double(double s)> a;  ///< a(s), s = x/epsilon
    double epsilon = 0.025;
    std::function<double(double x)> f;
};

enum class EllipticElements { multiscale, linear };

/// The shape function of a node over the two elements it belongs to, at places dense enough for its
/// oscillation to be seen (40 for each epsilon, at most 4000 an element). 0 < node < elements.
struct EllipticHat {
    std::vector<double> x, phi;
};
EllipticHat ellipticHat(const EllipticProblem& problem, EllipticElements kind, int elements, int node);

/// u and R anywhere, by one sweep of panels.
class EllipticSolution {
public:
    /// `elements`: panels end at the nodes i / elements.
    EllipticSolution(EllipticProblem problem, int elements);

    double u(double x) const;           ///< the exact solution
    double resistance(double x) const;  ///< R(x)
    int elements() const { return elements_; }

    /// Nodal values u_0..u_elements of the discrete solution.
    std::vector<double> nodal(EllipticElements kind) const;
    /// The discrete solution at x from its nodal values.
    double between(EllipticElements kind, const std::vector<double>& nodal, double x) const;

private:
    using Wide = long double;
    struct Sums {
        Wide R = 0, F = 0, G = 0;
    };
    Sums at(double x) const;
    Wide resistance(Wide from, double x0, double x1) const;
    Sums added(Sums from, double x0, double x1) const;
    double start(int panel) const;

    EllipticProblem problem_;
    int elements_, perElement_;
    std::vector<Sums> ends_;  ///< at the end of each panel, 0 first
    std::vector<double> c_, b_;
};

}  // namespace extremal
