// SPDX-License-Identifier: GPL-3.0-or-later
/// The words on the stage, drawn over its picture: the time shown, the length of the trail, failures so far
/// and, if there is no list of schemes beside it, a legend.
#pragma once

#include <QRectF>
#include <QString>

#include "ui/stage/stage_frame.hpp"

#include <optional>

class QPainter;

namespace extremal {

class StagePlayer;
struct Theme;

/// The stage's colours in this theme.
StageStyle stageStyle(const Theme& theme);

struct OverlayOptions {
    bool hasLegend = false;
    /// The camera of the picture, for words at places of the model; without it they are left out.
    std::optional<Camera> camera = {};
};

/// Logical pixels kept free around the bodies for these words.
inline constexpr double stageMargin = 34;

void paintOverlay(QPainter& painter, const QRectF& area, const StageFrame& frame, const StagePlayer& player,
                  const Theme& theme, const OverlayOptions& options = {});

/// "t = 6.20 s": with as many digits as the length of the run asks for.
QString timeText(double t, const StagePlayer& player);

/// One or two sentences for screen readers.
QString stageSummary(const StagePlayer& player);

}  // namespace extremal
