// SPDX-License-Identifier: GPL-3.0-or-later
/// Equidistribution as a holonomic constraint on values and places of the nodes,
///
///     g_i(z) = m_i - m_{i-1} = 0,  i = 1 .. N,    m_e = (M h)^2 of element e:
/// every element has the same share of a monitor M. For the arclength m_e = h^2 + alpha^2 (y_R - y_L)^2, a
/// polynomial, so that g is defined for any z and does not know in which order the nodes stand.
///
/// z: (y_i, X_i) of nodes i = 0 .. N + 1, one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/family/moving_mesh/monitor.hpp"

namespace extremal {

class MeshConstraint {
public:
    /// g_i depends on the nodes i - width .. i + width.
    static constexpr std::size_t mostWidth = 2;
    using Row = std::array<double, 2 * (2 * mostWidth + 1)>;  ///< of node i - width + k: entries 2 k, 2 k + 1

    MeshConstraint(const Monitor& monitor, std::size_t nodes);

    std::size_t width() const { return width_; }
    /// g: one entry per node, 0 at both ends.
    void evaluate(const double* z, std::vector<double>& g);
    void evaluate(const double* z, std::vector<double>& g, std::vector<Row>& Dg);

    /// to_j += factor sum_i (Dg_i)_j lambda_i.
    void addTransposed(const std::vector<Row>& Dg, const std::vector<double>& lambda, double factor,
                       std::vector<double>& to) const;
    /// The largest |g_i| over the mean of m_e.
    double residual(const double* z);

private:
    void measure(const double* z);

    Monitor monitor_;
    std::size_t n_, width_;
    std::vector<double> m_;
    /// Of element e by the nodes e - 1 .. e + 2 (those that its measure depends on).
    std::vector<std::array<double, 8>> slope_;
};

}  // namespace extremal
