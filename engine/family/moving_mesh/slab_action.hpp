// SPDX-License-Identifier: GPL-3.0-or-later
/// The action of one slab by the midpoint rule in time,
///
///     L_d(z_0, z_1) = h sum_e l_e(z, v),   z = (z_0 + z_1)/2,   v = (z_1 - z_0)/h,
/// in values and places of the nodes z = (y_i, X_i), one after the other: what the steps that move the mesh
/// by constraints and those that prescribe it have in common.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/family/moving_mesh/node_space.hpp"

namespace extremal {

class SlabAction {
public:
    explicit SlabAction(const NodeSpace& space)
        : space_(space), potential_(space.problem->potential, space.elements()), y_(space.n, 0) {
        for (auto* each : {&middle_, &rate_, &gradientZ_, &gradientV_}) each->assign(2 * space.n, 0);
    }

    /// At (z_0, z_1). With the Jacobian, `use(e, a, b, d^2 L_d / dz_0a dz_1b)` is called for the entries a
    /// and b, each 0 to 3, of every element: (y, X) of its left node, then of its right one.
    template <class Use>
    void evaluate(const std::vector<double>& z0, const std::vector<double>& z1, double h, bool withJacobian,
                  Cost& cost, Use&& use) {
        const std::size_t n = space_.n;
        for (std::size_t k = 0; k < 2 * n; ++k) {
            middle_[k] = (z0[k] + z1[k]) / 2;
            rate_[k] = (z1[k] - z0[k]) / h;
        }
        for (std::size_t i = 0; i < n; ++i) y_[i] = middle_[2 * i];
        potential_.evaluate(y_.data(), withJacobian);
        cost.evaluations += potential_.evaluations();
        std::fill(gradientZ_.begin(), gradientZ_.end(), 0.0);
        std::fill(gradientV_.begin(), gradientV_.end(), 0.0);
        ElementDerivatives l;
        for (std::size_t e = 0; e + 1 < n; ++e) {
            const double *z = middle_.data() + 2 * e, *v = rate_.data() + 2 * e;
            if (withJacobian)
                elementDerivatives(z, v, space_.c2, potential_[e], l);
            else
                elementGradient(z, v, space_.c2, potential_[e], l);
            for (std::size_t a = 0; a < 4; ++a) {
                gradientZ_[2 * e + a] += l.z[a];
                gradientV_[2 * e + a] += l.v[a];
            }
            for (std::size_t a = 0; a < 4 && withJacobian; ++a)
                for (std::size_t b = 0; b < 4; ++b)
                    use(e, a, b, h / 4 * l.zz[a][b] + (l.zv[a][b] - l.zv[b][a]) / 2 - l.vv[a][b] / h);
        }
    }
    /// Adds mass X'^2 / 2 of every node to the Lagrangian that was evaluated.
    void addNodeMass(double mass) {
        for (std::size_t i = 0; i < space_.n; ++i) gradientV_[2 * i + 1] += mass * rate_[2 * i + 1];
    }

    /// Entry k of dL_d/dz_0 and of dL_d/dz_1.
    double atStart(std::size_t k, double h) const { return h / 2 * gradientZ_[k] - gradientV_[k]; }
    double atEnd(std::size_t k, double h) const { return h / 2 * gradientZ_[k] + gradientV_[k]; }
    /// -dL_d/dh.
    double energy() const {
        double sum = 0;
        for (std::size_t e = 0; e + 1 < space_.n; ++e) {
            const auto energy =
                elementEnergy(middle_.data() + 2 * e, rate_.data() + 2 * e, space_.c2, potential_[e].W);
            sum += energy.kinetic + energy.potential;
        }
        return sum;
    }

private:
    NodeSpace space_;
    PotentialMomentsOf potential_;
    std::vector<double> middle_, rate_, y_, gradientZ_, gradientV_;
};

}  // namespace extremal
