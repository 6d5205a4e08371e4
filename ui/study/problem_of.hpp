// SPDX-License-Identifier: GPL-3.0-or-later
/// What errors and costs of any scheme depend on: the scene without what it says, shows and compares. Studies
/// in the background hold while it stays the same.
#pragma once

#include "engine/scene/scene.hpp"

namespace extremal {

inline Scene problemOf(Scene scene) {
    scene.title = scene.source = scene.lesson = scene.notes = {};
    scene.schemes.clear();
    scene.views.clear();
    scene.shown = {};
    scene.observe.clear();
    scene.events.clear();
    return scene;
}

}  // namespace extremal
