/// What the window says about itself: versions, libraries, and what draws the stage.
#pragma once

#include <QString>

namespace extremal {

QString aboutText(const QString& drawingBackend);

}  // namespace extremal
