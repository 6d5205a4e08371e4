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

private:
    int d_;
    bool hasImpulses_ = false;
    std::vector<Quantity> all_;
};

}  // namespace extremal
