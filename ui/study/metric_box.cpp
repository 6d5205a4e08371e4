// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/metric_box.hpp"

#include <algorithm>

#include "engine/scene/resolve.hpp"
#include "engine/study/search/metric.hpp"

namespace extremal {

MetricBox::MetricBox(QWidget* parent) : ComboBox(parent) {
    connect(this, &QComboBox::activated, this, [this] { chosen_ = currentText(); });
}

/// An error needs a reference.
void MetricBox::offer(const ResolvedScene& resolved) {
    const bool hasReference = resolved.scene.reference.kind != ReferenceSpec::Kind::none;
    QStringList names, present;
    for (const std::string& name : metricNames(*resolved.system, resolved.initial))
        if (hasReference || !metricOf(name, false, *resolved.system, resolved.initial).needsReference())
            names << QString::fromStdString(name);
    for (int i = 0; i < count(); ++i) present << itemText(i);
    if (names == present) return;
    const QSignalBlocker blocker(this);
    clear();
    addItems(names);
    setCurrentIndex(std::max(0, findText(findText(chosen_) < 0 ? QStringLiteral("error") : chosen_)));
}

}  // namespace extremal
