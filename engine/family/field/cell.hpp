// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete action of one cell of space and time, element x slab, as a function of its own degrees of
/// freedom (Leok 2004, sec. 2):
///
///     z = u at the nodes (a, l), a = 0..r along space and l = 0..s along time, entry l (r + 1) + a,
///     S(z) = h L sum_ij w_i b_j (u_t^2 / 2 - a phi(u_x) - W(u)) at (xi_i, tau_j),
/// with its gradient and Hessian. It knows nothing of neighbours, masses or steps: what the schemes of a slab
/// are assembled from, and what their fast ways are tested against.
#pragma once

#include <vector>

#include "engine/model/field/problem.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

class FieldCell {
public:
    FieldCell(const FieldProblem& problem, int timeDegree, const Rule<double>& space,
              const Rule<double>& time);

    int unknowns() const { return (spaceDegree_ + 1) * (timeDegree_ + 1); }
    int spaceDegree() const { return spaceDegree_; }
    int timeDegree() const { return timeDegree_; }
    int unknown(int a, int l) const { return l * (spaceDegree_ + 1) + a; }

    /// Of element e on a slab of length h. gradient: unknowns(); hessian: unknowns()^2; either may be null.
    double evaluate(int e, double h, const double* z, double* gradient, double* hessian) const;

private:
    const FieldProblem* problem_;
    int spaceDegree_, timeDegree_;
    Rule<double> space_, time_;
    /// Of unknown k at point p = i J + j: p unknowns() + k; elements with functions of their own one after
    /// the other.
    std::vector<double> value_, slopeX_, slopeT_;
};

}  // namespace extremal
