// SPDX-License-Identifier: GPL-3.0-or-later
/// What errors and costs of any scheme depend on: the scene without what it says, shows and compares. Studies
/// in the background hold while it stays the same.
#pragma once

#include <utility>

#include "ui/workspace/bare_scene.hpp"

namespace extremal {

inline Scene problemOf(Scene scene) {
    scene = bareScene(std::move(scene));
    scene.schemes.clear();
    scene.views.clear();
    scene.observe.clear();
    scene.events.clear();
    return scene;
}

}  // namespace extremal
