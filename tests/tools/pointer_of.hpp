// SPDX-License-Identifier: GPL-3.0-or-later
/// What an error points at.
#pragma once

#include <string>

#include "engine/core/problem.hpp"

namespace extremal {

/// The pointer of the first problem that `work` throws; "nothing thrown" where it returns.
template <class Work>
std::string pointerOf(Work&& work) {
    try {
        work();
    } catch (const InvalidScene& e) {
        return e.problems().front().pointer;
    }
    return "nothing thrown";
}

}  // namespace extremal
