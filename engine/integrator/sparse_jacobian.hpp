// SPDX-License-Identifier: GPL-3.0-or-later
/// The Jacobian dR/dY of the condensed step (galerkin_step.hpp) where few coordinates act on each other: a
/// sum over the entries of the Hessian of L that are not always 0,
///
///     dR_{(k,a)} / dY_{(l,b)} = sum_i w_i sum_{x of k, y of l} xi_a(c_i) L_xy(i) eta_b(c_i),
///
/// x and y a place or a velocity; eta_b is phi_b or its slope, and xi_a the same of phi_a, or of 1 -
/// phi_{m-1} in the last row. The unknowns of a coordinate are a block, factorised in an order in which a
/// chain or a tree makes no other blocks (solve/block_lu.hpp): the work grows with the number of entries.
///
/// Shapes: entry e of the Hessian at node i is at e * nodes + i. Nothing is allocated after the constructor.
/// Internal to integrator/.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/model/parts/entries.hpp"
#include "engine/solve/block_lu.hpp"

namespace extremal {

class SparseJacobian {
public:
    /// The functions of a coordinate at the nodes: (i, a) at a * nodes + i; slopes are by time.
    struct Functions {
        const double *value, *slope;
    };

    /// `unknowns`: how many functions each coordinate has.
    SparseJacobian(LagrangianEntries entries, int nodes, const std::vector<int>& unknowns);

    /// The Hessian at node i.
    void evaluate(int i, double t, const double* q, const double* v);
    /// `weight`: w_i, times h; `functionsOf(k)`: of coordinate k. Singular where a pivot is exactly zero.
    template <class FunctionsOf>
    Outcome factorise(const double* weight, const FunctionsOf& functionsOf) {
        lu_.clear();
        for (std::size_t e = 0; e < terms_.size(); ++e) {
            const Term& term = terms_[e];
            const Functions row = functionsOf(term.row.coordinate),
                            column = functionsOf(term.column.coordinate);
            const double* const H = &hessian_[e * static_cast<std::size_t>(nodes_)];
            add(term.row, row, term.column, column, term.place, H, weight);
            if (!term.isDiagonal) add(term.column, column, term.row, row, term.mirrored, H, weight);
        }
        return lu_.factorise();
    }
    /// Of the factors, the smallest pivot over the largest.
    double pivotRatio() const { return lu_.pivotRatio(); }
    /// Replaces the right-hand side by the solution.
    void solve(double* x) const { lu_.solve(x); }

    /// The largest |L_vv(k, k)| of the nodes.
    double massAt(int k) const;
    /// Multiplications of a factorisation, and whether they are less than those of a full matrix.
    double work() const { return lu_.work(); }
    bool isWorthwhile() const { return lu_.isWorthwhile(); }

private:
    /// A place or a velocity.
    struct Variable {
        int coordinate;
        bool isVelocity;
        int unknowns;
        std::size_t stride;  ///< from column to column of a block in whose rows it is
    };
    struct Term {
        Variable row, column;
        bool isDiagonal;
        std::size_t place, mirrored;  ///< of the blocks (row, column) and (column, row)
    };
    void add(const Variable& test, const Functions& ofTest, const Variable& trial, const Functions& ofTrial,
             std::size_t place, const double* H, const double* weight);

    LagrangianEntries entries_;
    int nodes_;
    BlockLu lu_;
    std::vector<Term> terms_;
    std::vector<int> ofMass_;  ///< the entry L_vv(k, k) of coordinate k; -1: it is always 0
    std::vector<double> hessian_, gradient_, atNode_;
};

}  // namespace extremal
