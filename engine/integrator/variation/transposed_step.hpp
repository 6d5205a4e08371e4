// SPDX-License-Identifier: GPL-3.0-or-later
/// Tangent maps the other way: derivatives l of a number by the state after a step become those by the state
/// before it,
///
///     l <- M^T l,    M = dx_1/dx_0,
///
/// so that the gradient of one number by everything that a run begins with costs one product per step. Where
/// M is the solution of linear equations, K dY = -R, so is M^T, with the same K transposed (Lions 1971;
/// discrete adjoint). A step that solves them itself is a TransposedStep; of others M is made column by
/// column.
#pragma once

#include <span>

#include "engine/integrator/integrator.hpp"

namespace extremal {

class TransposedStep {
public:
    virtual ~TransposedStep() = default;
    /// W <- M^T W, column after column, as Integrator::applyTangent() for M W.
    virtual bool applyTransposed(std::span<double> W) = 0;
};

/// The same for any integrator with a tangentSize(), after a converged advance(). False where M does not
/// exist; W is then of no use.
bool applyTransposed(Integrator& integrator, std::span<double> W);

}  // namespace extremal
