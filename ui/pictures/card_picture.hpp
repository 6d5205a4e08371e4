// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of scenes for the start page: the stage part of the way through, or where there is none the first
/// plot. Those of the presets are made when the program is built (app/pictures) and lie beside it.
#pragma once

#include <QImage>
#include <QSize>
#include <QString>

#include <memory>

#include "engine/run/comparison.hpp"
#include "ui/base/theme.hpp"

namespace extremal {

inline constexpr QSize cardPictureSize(300, 170);  ///< logical pixels
inline constexpr double cardPictureRatio = 2;      ///< of pictures in files

/// What has to be run for the picture of a scene: its schemes alone, with nothing to measure them against.
Scene sceneOfPicture(Scene scene);

/// Throws OpenGlUnavailable (a std::runtime_error).
QImage cardPicture(std::shared_ptr<const Comparison> comparison, const Theme& theme, double ratio);

/// Where the picture of a preset lies.
QString presetPictureFile(const QString& folder, const QString& preset, bool isDark);
/// "share/extremal/pictures" beside the folder of the program.
QString presetPictureFolder();

}  // namespace extremal
