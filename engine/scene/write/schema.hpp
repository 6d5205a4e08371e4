// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene format as a JSON Schema (draft 2020-12), for editors; made from the catalogues, so that it
/// cannot lag behind them. presets/scene.schema.json is this text, and a test compares the two.
#pragma once

#include "engine/core/value.hpp"

namespace extremal {

Value sceneSchema();

}  // namespace extremal
