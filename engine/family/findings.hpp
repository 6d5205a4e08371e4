// SPDX-License-Identifier: GPL-3.0-or-later
/// What stands against a scene, or a scheme before it runs: errors refuse it, warnings do not. Pointers of
/// what families and baselines find are relative to the scheme ("/step", "/space/omega").
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
    /// What was found in a part of what this is about, which is at the pointer.
    void add(const std::string& pointer, const Findings& part) {
        for (const Problem& p : part.errors) error(pointer + p.pointer, p.message, p.hint, p.topic);
        for (const Problem& p : part.warnings)
            warning(pointer + p.pointer, p.message, p.hint, p.remedy, p.topic);
    }
};

}  // namespace extremal
