// SPDX-License-Identifier: GPL-3.0-or-later
/// The ways between a field made of tensor elements on a periodic rectangle, its modes, and its values at the
/// points of a quadrature rule.
///
/// Along one axis of N nodes at equal distances the functions are polynomials of degree r on each of N/r
/// elements, and continuous. With one rule of points x_q and weights w_q for all integrals along the axis,
///
///     M = B^T w B,   K = D^T w D,   B_qi = phi_i(x_q),   D_qi = phi_i'(x_q),
///     K U = M U diag(lambda),   U^T M U = 1.
/// Over the rectangle the mass is M_x (x) M_y, the integral of |grad u|^2 K_x (x) M_y + M_x (x) K_y, and the
/// columns of U_x (x) U_y are the modes, with |grad|^2 = lambda_i + mu_j. A row of modes is that of their
/// coefficients, those along x next to each other, as nodes and points are. Momenta are M u_t at the nodes.
///
/// Every way is two products of matrices, 2 N^3 operations each.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/quadrature/rule.hpp"

namespace extremal {

/// One axis of a mesh: N nodes around a circle.
struct ElementAxis {
    int nodes = 1, degree = 1;
    double length = 1;
};

class ElementGrid {
public:
    /// Along each axis the nodes are a multiple of its degree, and its rule sees the mass of every function.
    /// One node along y makes it a line.
    ElementGrid(const ElementAxis& x, const ElementAxis& y, const Rule<double>& alongX,
                const Rule<double>& alongY);

    std::size_t nodes() const;
    std::size_t points() const;
    std::size_t numbers() const { return nodes(); }  ///< in a row of modes
    /// |grad|^2 of each mode.
    std::vector<double> gradients() const;
    void toModes(const double* nodes, double* row);
    void toNodes(const double* row, double* nodes);
    void toPoints(const double* row, double* values);
    double pointShare() const { return 1; }  ///< what values are to be multiplied with before fromPoints()
    /// The integrals of the modes times a function with these values.
    void fromPoints(const double* values, double* row);
    void fromMomenta(const double* momenta, double* row);
    void toMomenta(const double* row, double* momenta);
    /// The mean of u^2.
    double squareOf(const double* row) const;

private:
    /// A matrix as the left factor of a product, and its transpose as the right one.
    struct Way {
        int rows = 0, columns = 0, stride = 0;
        std::vector<double> left, right;
    };
    struct Axis;
    static std::shared_ptr<const Axis> axisOf(const ElementAxis& axis, const Rule<double>& rule);
    /// to = X from Y^T.
    void apply(const Way& X, const Way& Y, const double* from, double* to);

    std::shared_ptr<const Axis> x_, y_;
    double measure_;
    std::vector<double> between_;
};

}  // namespace extremal
