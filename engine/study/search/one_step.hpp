// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of a given size from any state: what the linear stability of a scheme is measured with. Internal
/// to engine/study.
#pragma once

#include <memory>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// Of schemes with an error control the formula alone: their tolerance accepts every step.
class OneStep {
public:
    /// Throws InvalidScene where the scheme has no step that is the same for all states.
    OneStep(ResolvedScheme scheme, const System& system, double step, const State& start);

    /// Only on fixed grids is it cheap.
    void setStep(double step);
    /// A run begins at the state. Throws InvalidScene as the constructor.
    void begin(State& state);
    /// False: the step has no solution.
    bool take(State& state);

private:
    ResolvedScheme scheme_;
    double step_;
    std::unique_ptr<Integrator> integrator_;
};

}  // namespace extremal
