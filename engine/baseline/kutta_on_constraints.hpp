// SPDX-License-Identifier: GPL-3.0-or-later
/// The classical Runge-Kutta method on constraints that were differentiated twice (index 1), with a remedy
/// for its drift:
///   * a feedback alpha in place of g'' = 0 (Baumgarte 1972): g'' + 2 alpha g' + alpha^2 g = 0, which is a
///     damped oscillator of its own, and stable only for steps with h alpha below some 2;
///   * a projection of place and momentum onto the constraint after each step.
#pragma once

#include "engine/baseline/constrained_method.hpp"

namespace extremal {

class KuttaOnConstraints final : public ConstrainedMethod {
public:
    struct Remedy {
        double feedback = 0;
        bool projects = false;
    };
    KuttaOnConstraints(const System& system, const BaselineOptions& options, Remedy remedy);
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<KuttaOnConstraints>(*this); }

private:
    Outcome step() override;

    Remedy remedy_;
    Vector q_, p_, dq_, dp_, sumQ_, sumP_, velocity_, kappa_;
};

}  // namespace extremal
