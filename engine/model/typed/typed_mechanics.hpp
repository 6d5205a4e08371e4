// SPDX-License-Identifier: GPL-3.0-or-later
/// The calls of Mechanics for a typed Lagrangian: tapes with the parameters folded in.
///
/// Where L is quadratic in v the Legendre transform is one linear solve, M v = p - L_v(t, q, 0); elsewhere
/// Newton. L = 1/2 sum_i m_i v_i^2 - V(t, q) with constant m_i is recognised symbolically: force and masses
/// are then set.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/entries.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

struct TypedMechanics {
    Mechanics<double> mechanics;
    std::vector<int> cyclic;  ///< coordinates with dL/dq = 0: their momenta are conserved
};

/// Without its terms (makeTerms). Throws ExpressionError.
TypedMechanics makeMechanics(const Formula& formula);

/// The same derivatives by their entries, of mechanics made above.
LagrangianEntries entriesOf(const Mechanics<double>& mechanics);

/// What computes its gradient in (q, v); null where the Lagrangian is not typed.
const Tape* gradientTapeOf(const Mechanics<double>& mechanics);
/// What computes its value, gradient and Hessian; null as above.
const Tape* jetTapeOf(const Mechanics<double>& mechanics);

/// The terms of a Lagrangian that is typed in terms. Throws ExpressionError; `throwing`, where it is not
/// null, is then the name of the term.
std::vector<LagrangianTerm<double>> makeTerms(const Formula& formula, std::string* throwing = nullptr);

/// What is wrong with the Lagrangian at a state (q, p), or with it everywhere if it is degenerate; empty if
/// nothing is.
std::optional<std::string> faultAt(const Formula& formula, const Mechanics<double>& mechanics, double t,
                                   const double* q, const double* p);
std::optional<std::string> degeneracy(const Formula& formula, const Mechanics<double>& mechanics);

}  // namespace extremal::typed
