/// What stands against a scheme before it runs: errors refuse it, warnings do not. Pointers are relative to
/// the scheme ("/step", "/space/omega").
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"

namespace extremal {

struct Findings {
    std::vector<Problem> errors, warnings;

    void error(std::string pointer, std::string message, std::string hint = {}, std::string topic = {}) {
        errors.push_back({std::move(pointer), std::move(message), std::move(hint), {}, {}, std::move(topic)});
    }
    /// `remedy`: a value for the pointer that would do, to be offered; null: none. `topic`: that of Problem.
    void warning(std::string pointer, std::string message, std::string hint = {}, Value remedy = {},
                 std::string topic = {}) {
        warnings.push_back({std::move(pointer),
                            std::move(message),
                            std::move(hint),
                            {},
                            std::move(remedy),
                            std::move(topic)});
    }
};

}  // namespace extremal
