// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed systems for the tests: the built-in ones once more, as a user would type them.
#pragma once

#include "tests/laws/laws.hpp"

namespace extremal::laws {

inline System typedSystem(Value::Array coordinates, Value::Object parameters, const std::string& lagrangian) {
    Settings settings;
    settings.type = "lagrangian";
    settings.keys = {{"coordinates", Value(std::move(coordinates))},
                     {"parameters", Value(std::move(parameters))},
                     {"lagrangian", lagrangian}};
    return findModel("lagrangian")->make(settings);
}

inline System typedKepler() {
    return typedSystem({"x", "y"}, {{"mu", 1}}, "(x_t^2 + y_t^2)/2 + mu/sqrt(x^2 + y^2)");
}

inline System typedSpringPendulum() {
    return typedSystem({"a", "theta"}, {{"m", 1}, {"g", 9.81}, {"l", 1}, {"k", 1e4}},
                       "m/2*(a_t^2 + (l + a)^2*theta_t^2) + m*g*(l + a)*cos(theta) - k/2*a^2");
}

inline System typedDoublePendulum() {
    return typedSystem(
        {"theta1", "theta2"}, {{"m1", 1}, {"m2", 1}, {"l1", 1}, {"l2", 1}, {"g", 9.81}},
        "(m1 + m2)/2*l1^2*theta1_t^2 + m2/2*l2^2*theta2_t^2 + m2*l1*l2*theta1_t*theta2_t*cos(theta1 - theta2)"
        " + (m1 + m2)*g*l1*cos(theta1) + m2*g*l2*cos(theta2)");
}

}  // namespace extremal::laws
