// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene without what it says of itself and how the window shows it, which no number depends on.
#pragma once

#include "engine/scene/scene.hpp"

namespace extremal {

inline Scene bareScene(Scene scene) {
    scene.title = scene.source = scene.lesson = scene.notes = {};
    scene.shown = {};
    return scene;
}

}  // namespace extremal
