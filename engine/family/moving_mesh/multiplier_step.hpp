// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the action in values and places of the nodes, on the manifold of equidistributed meshes
/// g(z) = 0:
///
///     p_k + D_1 L_d(z_k, z_{k+1}) + Dg(z_k)^T lambda = 0,   g(z_{k+1}) = 0,
///     p_{k+1} = D_2 L_d(z_k, z_{k+1}) + Dg(z_{k+1})^T mu,   Dg(z_{k+1}) v_{k+1} = 0,  p = M(z) v,
/// L_d = h l((z_0 + z_1)/2, (z_1 - z_0)/h) summed over elements. It is the variational integrator of the
/// N degrees of freedom that equidistribution leaves: symplectic, and without a time in its Lagrangian. The
/// second line only says which of the momenta that differ by the normal space stands for v. Unknowns (y_i,
/// X_i, lambda_i) are taken node by node, so that the Jacobian is banded.
///
/// The mass matrix in (y, X) alone is singular where u is linear across a node: without g there is no step
/// (setFree).
#pragma once

#include <stop_token>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/family/moving_mesh/constraint.hpp"
#include "engine/family/moving_mesh/slab_action.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {

class MultiplierStep {
public:
    MultiplierStep(const NodeSpace& space, const Monitor& monitor, double tolerance, int maxIterations);
    /// Without the constraint: every node is free, and has the mass `meshMass` of its own besides, which adds
    /// meshMass X'^2 / 2 to the Lagrangian. An experiment: singular with 0, and else nodes tangle.
    void setFree(double meshMass) {
        isFree_ = true;
        meshMass_ = meshMass;
    }

    /// From (z, v) over h; z and v are the new ones where it converged, else as they were.
    Outcome advance(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                    const std::stop_token& stop);
    /// The projection of v onto the tangent space of {g = 0} at z, orthogonal in the mass: where the velocity
    /// of the nodes is to be made one.
    Outcome project(const std::vector<double>& z, std::vector<double>& v, Cost& cost);

    /// The smallest eigenvalue of the mass on the tangent space of {g = 0} at z, over the length of the mean
    /// element: how far the nodes are from free ones, whose mass is singular. 0 where it cannot be found.
    double smallestMass(const std::vector<double>& z);

    /// After a step: the largest |lambda_i|, with the multiplier mu of the step before, whose end is the same
    /// node of time. It would vanish if the action were stationary in the places of the nodes as well.
    double largestMultiplier() const { return largestMultiplier_; }
    /// Energy of the slab, -dS/dh.
    double slabEnergy() const { return slabEnergy_; }
    MeshConstraint& constraint() { return constraint_; }
    /// The multipliers that the next step is compared with.
    void checkpoint(Archive& archive) { archive(mu_); }

private:
    Outcome solve(const std::vector<double>& z0, double h, StepReport& report, const std::stop_token& stop);
    Outcome solveFrom(const std::vector<double>& z, const std::vector<double>& v, double h, int halvings,
                      StepReport& report, const std::stop_token& stop);
    void evaluate(const std::vector<double>& z0, double h, bool withJacobian, Cost& cost);
    double correct(const std::vector<double>& z0);
    Outcome tangent(const std::vector<double>& z, const std::vector<double>& p, std::vector<double>& v,
                    Cost& cost);
    std::size_t row(std::size_t i, std::size_t part) const { return 3 * i + part; }
    /// The rows of what does not change: places of the ends, values that are held, multipliers of free nodes.
    template <class Use>
    void forEachHeld(Use&& use) const {
        for (const std::size_t i : {std::size_t{0}, space_.n - 1})
            for (std::size_t part = 0; part < 3; ++part)
                if (part > 0 || space_.holdsValue(i)) use(row(i, part));
        for (std::size_t i = 1; i + 1 < space_.n && isFree_; ++i) use(row(i, 2));
    }
    void fixEnds(BandLu& lu, std::vector<double>& right) const;
    void fixEnds(std::vector<double>& right) const;
    bool isRegular(const BandLu& lu) const;
    void addConstraint(BandLu& lu, const std::vector<MeshConstraint::Row>& columns) const;

    NodeSpace space_;
    MeshConstraint constraint_;
    double tolerance_;
    int maxIterations_;
    bool isFree_ = false;
    double meshMass_ = 0;
    SlabAction action_;
    BandLu lu_, massLu_;
    std::vector<double> z1_, v1_, p0_, p1_, residual_, g_, lambda_, mu_;
    std::vector<MeshConstraint::Row> Dg0_, Dg1_;
    double slabEnergy_ = 0, largestMultiplier_ = 0;
};

}  // namespace extremal
