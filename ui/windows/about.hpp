// SPDX-License-Identifier: GPL-3.0-or-later
/// What the window says about itself: versions, libraries, and what draws the stage.
#pragma once

#include <QString>

#include <utility>
#include <vector>

namespace extremal {

/// What is compiled in or linked, by name, with its licence (SPDX): the page "licences" of the handbook says
/// what for.
const std::vector<std::pair<QString, QString>>& licences();

QString aboutText(const QString& drawingBackend);

}  // namespace extremal
