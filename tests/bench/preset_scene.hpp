// SPDX-License-Identifier: GPL-3.0-or-later
/// A preset as a problem of the table of peers: its system and its start, as a scene has them.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "engine/scene/write/codec.hpp"

namespace extremal::bench {

struct PresetProblem {
    System system;
    State start;
    double end;
};

inline PresetProblem presetProblem(const std::string& name) {
    std::ifstream in(EXTREMAL_SOURCE_DIR "/presets/" + name + ".json");
    std::stringstream text;
    text << in.rdbuf();
    const ReadScene read = readScene(text.str());
    if (!read.resolved) throw std::runtime_error("presets/" + name + ".json cannot be read");
    return {*read.resolved->system, read.resolved->initial, read.scene.end.value};
}

}  // namespace extremal::bench
