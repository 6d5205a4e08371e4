// SPDX-License-Identifier: GPL-3.0-or-later
/// A field u(x, y, t) over a rectangle, periodic in both directions:
///
///     L = integral of u_t^2/2 - c^2 |grad u|^2/2 - W(u),    u_tt = c^2 (u_xx + u_yy) - W'(u).
///
/// The state is x = (u at the nodes, x first, then u_t). Energy, momentum and tail are those of the
/// trigonometric polynomial through the values, of |k| < N/2 along both axes: quadratic terms are exact, the
/// integral of W is a sum over twice as many nodes along each axis.
#pragma once

#include <array>
#include <vector>

#include "engine/model/field/potential.hpp"
#include "engine/model/field/spectral_grid.hpp"
#include "engine/model/wave/basis/grid.hpp"

namespace extremal {

class PlaneFieldProblem {
public:
    PlaneFieldProblem(const wave::Grid& grid, double speed, FieldPotential potential);

    const wave::Grid& grid() const { return grid_; }
    std::size_t size() const { return static_cast<std::size_t>(grid_.size()); }
    double speed() const { return speed_; }
    double stiffness() const { return speed_ * speed_; }  ///< c^2
    const FieldPotential& potential() const { return potential_; }
    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& y() const { return y_; }

    double energy(const double* state) const;
    /// -integral of u_t u_x, and of u_t u_y.
    std::array<double, 2> momentum(const double* state) const;
    /// The root of the share of the modes in the upper eighth along either axis in the square of u.
    double tail(const double* state) const;
    /// Removes the waves (-1)^j along either axis, which are not a part of the space, from u and u_t.
    void removeAlternation(std::vector<double>& state) const;

private:
    /// f(k, l, c_u, c_v, weight) of every mode, weight 2 where it stands for its conjugate as well.
    template <class F>
    void forModes(const double* u, const double* v, F&& f) const;

    wave::Grid grid_;
    double speed_;
    FieldPotential potential_;
    std::vector<double> x_, y_;
};

}  // namespace extremal
