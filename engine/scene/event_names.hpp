// SPDX-License-Identifier: GPL-3.0-or-later
/// The names of the state in the expressions of events: t, every column with its dots as underscores
/// (q_theta, p_theta, attitude_w), and coordinates by their own names (theta) where no parameter of the model
/// has that name.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/text/expression.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

struct StateName {
    std::string name;
    int column = -1;  ///< of the state; -1: t
};
std::vector<StateName> stateNames(const System& system, const std::vector<std::string>& parameters);

/// The value of an event's expression at (t, x); the expression has been checked. A comparison, or several
/// with
/// && and ||, is 1 or 0 and has no zero that is passed: it is what is positive where it is true, the
/// difference of its sides, so that it is an event upwards where it becomes true.
///
/// Not to be called by two threads at once.
class EventFunction {
public:
    EventFunction(const EventSpec& event, const System& system);
    double operator()(double t, const double* x) const;
    /// The values of its parts, as the last call found them.
    std::span<const double> parts() const { return values_; }

private:
    static constexpr int time = -1, number = -2, operation = -3;
    struct Place {
        int column = operation;  ///< of the state; or one of the numbers above
        double value = 0;
    };
    void measureTruth(int node);

    Expression expression_;
    std::vector<Place> places_;           ///< of each node
    mutable std::vector<double> values_;  ///< of each node
};

}  // namespace extremal
