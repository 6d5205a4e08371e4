// SPDX-License-Identifier: GPL-3.0-or-later
/// The curve of a step of a mechanism, at the nodes of its two rules.
///
/// z = (q_0, Y_0, .., Y_{m-1}) with the functions phi_a of a table; Lobatto nodes (e_j, w_j), j = 0..m, for
/// the constraints, places r_j, j < m, for the multipliers of rolling conditions, which are the e_j or the m
/// Gauss nodes, and a rule (f_i, beta_i) for the forces, mostly that of the table:
///     q(tau) = q_0 + sum_a phi_a(tau) Y_a,    v = q' / h.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

/// What a step of a mechanism has rules for besides the Lagrangian.
struct MechanismRules {
    std::optional<Rule<double>> forces;  ///< empty: that of the Lagrangian
    bool isRollingAtGauss = false;       ///< multipliers of rolling conditions at the m Gauss nodes
};

struct MechanismCurve {
    /// The functions at some places: row j at tau_j, column a.
    struct Samples {
        Eigen::MatrixXd value, slope;
    };
    /// A rule, with the functions at its nodes.
    struct Nodes {
        Rule<double> rule;
        Samples at;
        int nodes() const { return static_cast<int>(rule.size()); }
        double place(int i) const { return rule.c[static_cast<std::size_t>(i)]; }
        double weight(int i) const { return rule.b[static_cast<std::size_t>(i)]; }
    };

    /// Throws InvalidScene where the space has functions that the Lobatto nodes do not tell apart.
    MechanismCurve(const Table<double>& table, const MechanismRules& rules, int dimension);

    int unknowns() const { return table.unknowns(); }
    /// e_j and w_j.
    double place(int j) const { return places[static_cast<std::size_t>(j)]; }
    double weight(int j) const { return weights[static_cast<std::size_t>(j)]; }
    /// q where the functions have the values of row j of `at` (atPlaces, atRolling), into the front of
    /// `node`.
    void placeAt(const Eigen::VectorXd& z, const Eigen::MatrixXd& at, int j, Eigen::VectorXd& node) const;
    /// (q, v) where the functions are those of row i of `at`, or at node i of a rule, in a step of length h.
    void motionAt(const Samples& at, int i, const Eigen::VectorXd& z, double h, Eigen::VectorXd& node) const;
    void motionAt(const Nodes& nodes, const Eigen::VectorXd& z, int i, double h,
                  Eigen::VectorXd& node) const {
        motionAt(nodes.at, i, z, h, node);
    }
    Samples samples(const std::vector<double>& at) const;

    Table<double> table;
    int d;
    std::vector<double> places, weights;
    Eigen::MatrixXd atPlaces;  ///< (j, a): phi_a(e_j)
    bool isRollingAtGauss;
    Rule<double> rolling;       ///< r_j and their weights
    Eigen::MatrixXd atRolling;  ///< (j, a): phi_a(r_j)
    Eigen::MatrixXd fit;        ///< the inverse of its rows j = 1..m
    Eigen::MatrixXd endSlope;   ///< (0, a): phi_a'(1)
    /// Places that are looked at in every step (gaps of walls): k / (8 m), k = 0..8 m.
    static constexpr int partsPerFunction = 8;
    Samples atParts() const;
    /// Which of them tau is; -1: another one.
    int partOf(double tau) const {
        const int parts = partsPerFunction * unknowns(), k = static_cast<int>(tau * parts + 0.5);
        return k >= 0 && k <= parts && static_cast<double>(k) / parts == tau ? k : -1;
    }
    Nodes atLagrangian;  ///< those of the table
    Nodes atForces;      ///< of the forces
    /// Whether forces act at the nodes of L.
    bool areForcesInside() const {
        return atForces.rule.c == atLagrangian.rule.c && atForces.rule.b == atLagrangian.rule.b;
    }
    Nodes atGauss;  ///< the m Gauss nodes, where rolling conditions hold
};

/// One curve for all that a step is made of, and for its copies: it never changes.
using SharedCurve = std::shared_ptr<const MechanismCurve>;

}  // namespace extremal
