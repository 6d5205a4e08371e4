// SPDX-License-Identifier: GPL-3.0-or-later
/// What steps say of the forces and impacts in them, as quantities of an integrator, each a sum over the
/// step:
///     work           h sum_i beta_i F . v, and what constraints that move with time and impacts do
///     expansion      h sum_i beta_i tr(F_v L_vv^-1), and ln e^2 of each impact: by how much, as a logarithm,
///                    volumes of phase space change
///     impulse.i      J_i = h sum_i beta_i F_i,   moment.i.j = sum J_i q_j,   impulse_time.i = sum J_i t:
///                    sum J . xi of each affine displacement xi = A q + b + c t (Noether)
/// Impulses of up to 16 coordinates, where forces or walls give some.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/core/quantity.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {

class SaidOfForces {
public:
    static constexpr std::size_t work = 0, expansion = 1, impulses = 2;
    static constexpr int mostCoordinates = 16;

    SaidOfForces(const Parts& parts, int dimension) : d_(dimension) {
        all_ = {{"work", "", "W", ""}, {"expansion", "", "", ""}};
        if ((!parts.find<Force>() && !parts.find<Wall>()) || d_ > mostCoordinates) return;
        hasImpulses_ = true;
        const auto add = [&](std::string name) { all_.push_back({std::move(name), "", "", ""}); };
        for (int i = 0; i < d_; ++i) add("impulse." + std::to_string(i));
        for (int i = 0; i < d_; ++i) add("impulse_time." + std::to_string(i));
        for (int i = 0; i < d_; ++i)
            for (int j = 0; j < d_; ++j) add("moment." + std::to_string(i) + "." + std::to_string(j));
    }
    std::span<const Quantity> quantities() const { return all_; }

    /// An impulse J at (t, q).
    void addImpulse(double t, const double* q, const double* J, double* values) const {
        if (!hasImpulses_) return;
        double* const to = values + impulses;
        for (int i = 0; i < d_; ++i) {
            to[i] += J[i];
            to[d_ + i] += t * J[i];
            for (int j = 0; j < d_; ++j) to[2 * d_ + i * d_ + j] += J[i] * q[j];
        }
    }

    /// Sums over the rule of the forces, on the curve z of a step of length h from t.
    struct Step {
        double t, h;
        const Eigen::VectorXd& z;
    };
    void addForces(Mechanism& mechanism, const MechanismCurve& curve, const Step& step,
                   double* values) const {
        const Force& force = *mechanism.force();
        Eigen::VectorXd node(2 * d_), F(d_);
        for (int i = 0; i < curve.atForces.nodes(); ++i) {
            curve.motionAt(curve.atForces, step.z, i, step.h, node);
            const double t = step.t + curve.atForces.place(i) * step.h,
                         weight = step.h * curve.atForces.weight(i);
            force.value(force.model.get(), t, node.data(), node.data() + d_, F.data());
            values[work] += weight * F.dot(node.tail(d_));
            values[expansion] += weight * mechanism.expansion(t, node.data(), node.data() + d_);
            F *= weight;
            addImpulse(t, node.data(), F.data(), values);
        }
    }

    /// -sum_{j<m} Lambda_j . g_t at e_j and r_j - kappa . g_t at the end: what constraints that move with
    /// time do, and rolling conditions with a velocity of their own. `kappa`: null where nothing is
    /// projected.
    double workOfConstraints(Mechanism& mechanism, const MechanismCurve& curve, const Step& step,
                             const Eigen::VectorXd& reactions, const Eigen::VectorXd* kappa) const {
        const int m = curve.unknowns(), n = mechanism.constraints(), g = mechanism.holonomic();
        Eigen::VectorXd q(d_);
        double sum = 0;
        const auto byTimeAt = [&](double place, const Eigen::MatrixXd& at, int j) -> const Eigen::VectorXd& {
            curve.placeAt(step.z, at, j, q);
            return mechanism.byTime(step.t + place * step.h, q.data());
        };
        for (int j = 0; j < m; ++j) {
            sum -= byTimeAt(curve.place(j), curve.atPlaces, j).head(g).dot(reactions.segment(j * n, g));
            if (mechanism.rolling())
                sum -= byTimeAt(curve.rolling.c[static_cast<std::size_t>(j)], curve.atRolling, j)
                           .tail(n - g)
                           .dot(reactions.segment(j * n + g, n - g));
        }
        if (kappa) sum -= byTimeAt(1, curve.atPlaces, m).dot(*kappa);
        return sum;
    }

private:
    int d_;
    bool hasImpulses_ = false;
    std::vector<Quantity> all_;
};

}  // namespace extremal
