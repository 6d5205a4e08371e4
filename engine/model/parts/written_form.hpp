// SPDX-License-Identifier: GPL-3.0-or-later
/// The typed Lagrangian that a model writes, where it has keys of another kind; a part that does not bind the
/// motion.
///
/// The system is that of the typed Lagrangian. A model that says where its parts are says its start as well:
/// initial data of the scene are needed only where they differ from it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct WrittenForm {
    static constexpr PartInfo part{"written-form", "a written form", false};

    Settings settings;         ///< of the model "lagrangian"
    std::vector<double> q, v;  ///< the start that the model says
    /// Keys of the written form and the keys of the model that they come from: "/constraints/crank" and
    /// "/rods/crank".
    std::vector<std::pair<std::string, std::string>> origins;
    /// The model with the places and velocities of a state as its start; what is the same as before stays as
    /// it is written.
    Value (*withStart)(const WrittenForm& form, const Value& model, const double* q,
                       const double* v) = nullptr;

    /// A pointer below /model of the written form, as one of the model.
    std::string originOf(std::string_view pointer) const {
        std::string_view longest, place;
        for (const auto& [key, origin] : origins)
            if (pointer.starts_with(key) && (pointer.size() == key.size() || pointer[key.size()] == '/') &&
                key.size() >= longest.size()) {
                longest = key;
                place = origin;
            }
        return longest.empty() ? std::string(pointer) : std::string(place);
    }
};

/// A pointer "/model/..." of the written form as one of the scene; others, and those of models that write
/// nothing, stay as they are.
inline std::string originIn(const Parts& parts, const std::string& pointer) {
    constexpr std::string_view model = "/model";
    const WrittenForm* const form = parts.find<WrittenForm>();
    if (!form || !pointer.starts_with(model)) return pointer;
    return std::string(model) + form->originOf(std::string_view(pointer).substr(model.size()));
}

}  // namespace extremal
