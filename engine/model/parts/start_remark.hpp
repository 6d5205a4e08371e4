// SPDX-License-Identifier: GPL-3.0-or-later
/// What a start makes of the initial data that are given, where that is not what they say.
#pragma once

#include <functional>
#include <string>

#include "engine/core/settings.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct StartRemark {
    static constexpr PartInfo part{"start-remark", "what becomes of initial data", false};
    struct Remark {
        std::string pointer, message, hint;  ///< a warning below /initial; no message: nothing to say
    };
    std::function<Remark(const Settings& initial)> of;
};

}  // namespace extremal
