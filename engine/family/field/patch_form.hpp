// SPDX-License-Identifier: GPL-3.0-or-later
/// The multisymplectic form formula of a scheme, on a patch of cells (Marsden, Patrick, Shkoller 1998):
///
///     Omega_c^l(V, W) = sum_m d2S_c/dz_l dz_m (V_m W_l - W_m V_l),
///     sum over cells c of the patch, sum over their nodes l on its boundary, Omega_c^l(V, W) = 0
/// for any two solutions V, W of the linearised discrete equations along a solution. What a symplectic form
/// is to a step, this is to a patch of space and time. The patch is a range of elements, and all slabs since
/// the start of the run; V and W start at random.
#pragma once

#include <memory>
#include <vector>

#include "engine/family/field/cell.hpp"
#include "engine/family/field/mass_matrix.hpp"

namespace extremal {

class PatchForm {
public:
    /// Elements first .. last - 1, 0 < first < last < all of them; `seed` of the tangents.
    PatchForm(std::shared_ptr<const FieldProblem> problem, int timeDegree, const Rule<double>& space,
              const Rule<double>& time, double h, int first, int last, unsigned seed);

    /// One slab more, between the values at its ends.
    void advance(const double* u0, const double* u1);

    /// A solution of the linearised equations.
    struct Tangent {
        std::vector<double> u, p;    ///< values and momenta at the end of the last slab
        std::vector<double> levels;  ///< at all levels of that slab: l n + i
    };
    const Tangent& first() const { return V_; }

    struct Sum {
        double sum = 0;        ///< over the boundary: 0
        double magnitude = 0;  ///< of its terms
        double relative() const { return magnitude > 0 ? sum / magnitude : 0; }
    };
    /// Of the patch as it is now.
    Sum boundary() const;

private:
    void findLevels(const double* u0, const double* u1);
    void makeHessians();
    void solve(Tangent& tangent);
    void add(Sum& to, int e, int a, int l) const;

    std::shared_ptr<const FieldProblem> problem_;
    FieldCell cell_;
    NodeOrder order_;
    double h_;
    int first_, last_;
    bool hasStarted_ = false;
    std::vector<double> levels_;    ///< the solution at all levels: l n + i
    std::vector<double> hessians_;  ///< of the cells
    Tangent V_, W_;
    Sum fixed_;  ///< of the bottom and both sides
    Sum top_;    ///< of what is the top now
};

}  // namespace extremal
