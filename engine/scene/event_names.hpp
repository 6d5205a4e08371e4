/// The names of the state in the expressions of events: t, every column with its dots as underscores
/// (q_theta, p_theta, attitude_w), and coordinates by their own names (theta) where no parameter of the model
/// has that name.
#pragma once

#include <string>
#include <vector>

#include "engine/core/expression.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

struct StateName {
    std::string name;
    int column = -1;  ///< of the state; -1: t
};
std::vector<StateName> stateNames(const System& system, const std::vector<std::string>& parameters);

/// The value of an event's expression at (t, x); the expression has been checked.
class EventFunction {
public:
    EventFunction(const EventSpec& event, const System& system);
    double operator()(double t, const double* x) const;

private:
    struct Name {
        std::string name;
        int column;  ///< -1: t; -2: a number
        double value;
    };
    Expression expression_;
    std::vector<Name> names_;
};

}  // namespace extremal
