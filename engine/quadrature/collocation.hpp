// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of collocation at the nodes c_i of a rule with one panel.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/quadrature/rule.hpp"

namespace extremal {

/// a_ij, the integral from 0 to c_i of the Lagrange polynomial j: the matrix of the Runge-Kutta method.
template <class T>
Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> collocationMatrix(const Rule<T>& rule) {
    const auto s = static_cast<Eigen::Index>(rule.size());
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> A(s, s);
    std::vector<T> share(static_cast<std::size_t>(s));
    for (Eigen::Index i = 0; i < s; ++i) {
        partialWeights<T>(rule, rule.c[static_cast<std::size_t>(i)], share);
        for (Eigen::Index j = 0; j < s; ++j) A(i, j) = share[static_cast<std::size_t>(j)];
    }
    return A;
}

/// The Lagrange polynomial j of the nodes c at the place x_i, at the place i s + j of the result.
inline std::vector<double> lagrangeTable(const std::vector<double>& c, const std::vector<double>& x) {
    std::vector<double> table;
    for (const double at : x)
        for (std::size_t j = 0; j < c.size(); ++j) {
            double product = 1;
            for (std::size_t k = 0; k < c.size(); ++k)
                if (k != j) product *= (at - c[k]) / (c[j] - c[k]);
            table.push_back(product);
        }
    return table;
}

/// The Lagrange polynomials at 1 + c_i: values at the nodes of the next step, of the same length, by the
/// polynomial through those of this one.
inline std::vector<double> extrapolationTable(const Rule<double>& rule) {
    std::vector<double> ahead = rule.c;
    for (double& c : ahead) c += 1;
    return lagrangeTable(rule.c, ahead);
}

}  // namespace extremal
