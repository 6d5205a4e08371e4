// SPDX-License-Identifier: GPL-3.0-or-later
/// The presets, compiled into the program: one scene per figure and claim of the theory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace extremal {

struct Preset {
    std::string_view id;    ///< file stem: "spring-pendulum"
    std::string_view json;  ///< the scene file
};

const std::vector<Preset>& presets();
const Preset* findPreset(std::string_view id);
/// The axes of the study of extremes (study/stability/extremes.hpp).
const std::vector<Preset>& extremeScenes();

}  // namespace extremal
