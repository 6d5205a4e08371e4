// SPDX-License-Identifier: GPL-3.0-or-later
/// A field u = (u_1, .., u_m)(x, y, t) over a rectangle, periodic in both directions:
///
///     L = integral of sum over c of [ u_c,t^2/2 - c_c^2 |grad u_c|^2/2 ] - W(u_1, .., u_m),
///     u_c,tt = c_c^2 (u_c,xx + u_c,yy) - dW/du_c.
///
/// The state is x = (u_1 at the nodes, x first, .., u_m, then u_1,t, .., u_m,t). Energy, momenta and tail are
/// those of the trigonometric polynomials through the values, of |k| < N/2 along both axes: quadratic terms
/// are exact, the integral of W is a sum over twice as many nodes along each axis. An interval is a rectangle
/// with one node along y, as wave::Grid has it.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/field/spectral_grid.hpp"
#include "engine/model/plane_field/joint_potential.hpp"
#include "engine/model/wave/basis/grid.hpp"

namespace extremal {

/// A component of a field.
struct FieldComponent {
    std::string name;  ///< "u"
    double speed = 1;  ///< c of its waves
};

class PlaneFieldProblem {
public:
    /// One component of the field for each of the potential.
    PlaneFieldProblem(const wave::Grid& grid, std::vector<FieldComponent> components,
                      JointPotential potential);

    const wave::Grid& grid() const { return grid_; }
    std::size_t nodes() const { return static_cast<std::size_t>(grid_.size()); }
    std::size_t components() const { return components_.size(); }
    /// Numbers in u: components() times nodes().
    std::size_t size() const { return components() * nodes(); }
    const std::string& name(std::size_t c) const { return components_[c].name; }
    double speed(std::size_t c = 0) const { return components_[c].speed; }
    double stiffness(std::size_t c = 0) const { return speed(c) * speed(c); }  ///< c^2
    const JointPotential& potential() const { return potential_; }
    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& y() const { return y_; }
    /// Pairs of components that the Lagrangian does not tell from each other when they are turned.
    const std::vector<std::pair<std::size_t, std::size_t>>& turns() const { return turns_; }
    /// Two such components: real and imaginary part of one function.
    bool isComplex() const { return components() == 2 && !turns_.empty(); }

    double energy(const double* state) const;
    /// -integral of u_t . u_x, and of u_t . u_y.
    std::array<double, 2> momentum(const double* state) const;
    /// -integral of u_t . (x u_y - y u_x) about the middle of the rectangle.
    double angularMomentum(const double* state) const;
    /// integral of u_a u_b,t - u_b u_a,t for each pair of turns().
    std::vector<double> charges(const double* state) const;
    /// The root of the share of the modes in the upper eighth along either axis in the square of u.
    double tail(const double* state) const;
    /// Removes the waves (-1)^j along either axis, which are not a part of the space, from u and u_t.
    void removeAlternation(std::vector<double>& state) const;

private:
    /// Of all components, one after the other, as rows of SpectralGrid.
    std::vector<double> modesOf(const double* u, SpectralGrid& ways) const;
    /// f(c, k, l, c_u, c_v, weight) of every mode of every component, weight 2 where it stands for its
    /// conjugate as well.
    template <class F>
    void forModes(const std::vector<double>& U, const std::vector<double>& V, F&& f) const;
    /// The mean of W over twice as many places along each axis: those of the nodes, and between them.
    double meanPotential(const std::vector<double>& U, SpectralGrid& ways) const;

    wave::Grid grid_;
    std::vector<FieldComponent> components_;
    JointPotential potential_;
    std::vector<std::pair<std::size_t, std::size_t>> turns_;
    std::vector<double> x_, y_;
};

}  // namespace extremal
