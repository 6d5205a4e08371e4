// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of a scene that its motions are differentiated by, where that is observed ("sensitivity"):
/// each a pointer into the scene, and what its columns are called. It binds nothing.
#pragma once

#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct VariedNumbers {
    static constexpr PartInfo part{"varied-numbers", "numbers that motions are differentiated by", false};

    struct Each {
        std::string pointer;  ///< "/model/parameters/k", "/initial/q/0", "/model/lagrangian/<term>"
        std::string name;     ///< "k", "initial.q.x", "term.<term>"
    };
    std::vector<Each> all;
};

}  // namespace extremal
