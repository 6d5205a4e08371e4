// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/phase_cell.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

/// psi_a at the nodes of the next step; empty where the space ends with the step.
Eigen::MatrixXd slopesAhead(const Table<double>& table) {
    if (table.extrapolation.size() == 0) return {};
    const auto size = static_cast<std::size_t>(table.space.size);
    std::vector<double> value(size), slope(size);
    Eigen::MatrixXd ahead(table.nodes(), table.unknowns());
    for (int i = 0; i < table.nodes(); ++i) {
        table.space.evaluate(1 + table.node(i), value, slope);
        ahead.row(i) =
            Eigen::Map<const Eigen::VectorXd>(slope.data(), table.space.size).transpose() * table.change;
    }
    return ahead;
}

/// Numbers that are 1 but for rounding.
void roundToOne(Eigen::VectorXd& values) {
    constexpr double roundOff = 1e-12;
    for (double& v : values)
        if (std::abs(v - 1) < roundOff) v = 1;
}

}  // namespace

PhaseCell::PhaseCell(const Table<double>& ofStep)
    : table(ofStep),
      place(ofStep.node),
      weight(ofStep.weight),
      value(ofStep.value),
      slope(ofStep.derivative) {
    const int m = unknowns();
    const Matrix weighted = weight.asDiagonal() * slope,
                 inverse = dense::inverse<double>(slope.transpose() * weighted);
    ofRates = inverse * weighted.transpose();
    ofMomentum = inverse.col(m - 1);
    Matrix tests = -value;
    tests.col(m - 1).array() += 1;
    ofForces = inverse * (weight.asDiagonal() * tests).transpose();
    A = value * ofRates;
    B = slope * ofForces;
    fromStart = slope * ofMomentum;
    roundToOne(fromStart);
    endRates = ofRates.row(m - 1).transpose();
    if (const Matrix next = slopesAhead(table); next.size() > 0) ahead = next * ofRates;
}

}  // namespace extremal
