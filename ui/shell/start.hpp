// SPDX-License-Identifier: GPL-3.0-or-later
/// Starting the window.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"

namespace extremal {

/// Opens the window on a scene (a path or "preset:NAME"; empty: the start page) and returns the exit code.
///
/// For pictures made by scripts, environment variables ask for one shot instead of a session:
///     EXTREMAL_SHOT=FILE.png [EXTREMAL_SHOT_SIZE=1600x1000] [EXTREMAL_SHOT_THEME=dark] extremal SCENE
/// runs the scene to its end, moves the time to 62 % of it, grabs the window and ends. A display is needed, a
/// virtual one will do.
///
/// A scene that cannot be opened leaves the start page, which says why, as does `tell`.
int runWindow(int& argc, char** argv, const std::string& scene,
              const std::function<void(const std::vector<Problem>&)>& tell = {});

}  // namespace extremal
