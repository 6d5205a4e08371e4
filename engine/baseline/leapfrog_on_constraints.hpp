// SPDX-License-Identifier: GPL-3.0-or-later
/// Störmer-Verlet with constraints, L = 1/2 v . M v - V(q) with constant masses, f = -V_q:
///     p' = p_0 + h/2 (f(q_0) + g_q(q_0)^T lambda),   q_1 = q_0 + h M^-1 p',   g(q_1) = 0,
///     p_1 = p' + h/2 (f(q_1) + g_q(q_1)^T mu),       g_q(q_1) M^-1 p_1 + g_t = 0.
/// With the second line this is RATTLE (Andersen 1983), with mu = 0 SHAKE (Ryckaert, Ciccotti, Berendsen
/// 1977) in its form with velocities: the same places to round-off, but momenta off the constraint. lambda by
/// Newton's method on all constraints together.
#pragma once

#include "engine/baseline/constrained_method.hpp"

namespace extremal {

class LeapfrogOnConstraints final : public ConstrainedMethod {
public:
    enum class End { projected, free };

    /// Throws InvalidScene where the masses are not constant.
    LeapfrogOnConstraints(const System& system, const BaselineOptions& options, End end);
    std::unique_ptr<Integrator> clone() const override {
        return std::make_unique<LeapfrogOnConstraints>(*this);
    }
    void begin(State& state) override {
        state.memory.clear();
        lambda_.setZero();
    }
    bool checkpoint(Archive& archive) override {
        archive(lambda_);
        return true;
    }

private:
    Outcome step() override;
    Outcome findPlace(double t);

    using Rows = Mechanism::Rows;
    End kind_;
    Vector masses_, force_, half_, lambda_, kappa_, velocity_, value_, byTime_, free_;
    Rows before_, after_;
    Eigen::MatrixXd matrix_;
};

/// Whether a system has constraints, and a Lagrangian that is kinetic energy of constant masses minus a
/// potential.
bool hasConstraintsAndConstantMasses(const System& system);

}  // namespace extremal
