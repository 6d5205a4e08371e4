// SPDX-License-Identifier: GPL-3.0-or-later
/// Keys of objects that no descriptor lists.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/value.hpp"

namespace extremal {

/// Throws InvalidScene where an object has a key that is neither `title`, under which it says what it is, nor
/// among the known ones. `of`: what it is, for the message.
inline void allowKeys(const Value& object, const char* title, const std::vector<std::string>& known,
                      const std::string& pointer, const std::string& of) {
    for (const auto& [key, value] : object.asObject())
        if (key != title && std::find(known.begin(), known.end(), key) == known.end())
            throw InvalidScene(pointer + "/" + key, "is not a key of " + of,
                               known.empty() ? "it has none" : joinNames(known));
}

}  // namespace extremal
