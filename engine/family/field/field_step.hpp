// SPDX-License-Identifier: GPL-3.0-or-later
/// Schemes of hat functions and their likes: the discrete energy, and the integrators that there are.
/// Internal to engine/family/field and the baselines of fields.
#pragma once

#include <memory>
#include <vector>

#include "engine/family/time_table.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/field/spatial_form.hpp"
#include "engine/step/field_march.hpp"

namespace extremal {

/// Schemes that follow from a discrete action. The discrete energy of a slab is -dS/dh of its action S: with
/// the rules of the scheme
///     E = sum_q b_q (|u_t|^2_M / 2 + U(u)).
/// It is computed where a run asks for it.
class FieldStep : public FieldMarch {
public:
    using FieldMarch::FieldMarch;
    std::span<const Quantity> quantities() const final;
    void measure(const State& state, double* values) const final {
        values[0] = slabEnergy(before().data(), state.x.data());
    }

protected:
    /// Of the last slab, whose ends are given.
    virtual double slabEnergy(const double* before, const double* after) const = 0;
};

/// Explicit in time: the trapezoidal rule in time, degree 1. The mass is inverted where it is not diagonal.
std::unique_ptr<Integrator> makeExplicitField(std::shared_ptr<const SpatialForm> form, double step);

/// Any degree and rule in time, by Newton's method with a banded Jacobian.
std::unique_ptr<Integrator> makeImplicitField(std::shared_ptr<const SpatialForm> form, const TimeTable& time,
                                              double step, double tolerance, int maxIterations);

}  // namespace extremal
