/// What the numbers of a scheme's row are: how they are measured, against what, and how far they can be
/// trusted. Plain text of some lines.
#pragma once

#include <QString>

#include "engine/run/comparison.hpp"

namespace extremal {

QString explainCost(const Summary& summary);
QString explainError(const Summary& summary, const ReferenceInfo& reference);
QString explainOrder(const Summary& summary);
QString explainSteps(const Summary& summary);

}  // namespace extremal
