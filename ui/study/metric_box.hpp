// SPDX-License-Identifier: GPL-3.0-or-later
/// The choice of what is measured of each run, among what the scene has.
#pragma once

#include "ui/base/combo_box.hpp"

namespace extremal {

struct ResolvedScene;

/// Stands at the error, or where the scene has no reference at the first of the others, until another metric
/// is chosen by hand; that one stays as long as the scene has it.
class MetricBox : public ComboBox {
    Q_OBJECT
public:
    explicit MetricBox(QWidget* parent = nullptr);

    void offer(const ResolvedScene& resolved);

private:
    QString chosen_;  ///< by hand; empty: none was
};

}  // namespace extremal
