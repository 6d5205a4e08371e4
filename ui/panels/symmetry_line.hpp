// SPDX-License-Identifier: GPL-3.0-or-later
/// The symmetries of the model, as the engine finds them: "Symmetries: rotation in the plane x-y about
/// (5, -3), time (energy)". They are found beside the window when the model has changed.
#pragma once

#include <QLabel>
#include <QTimer>

#include "engine/core/settings.hpp"

namespace extremal {

class Workspace;

class SymmetryLine : public QLabel {
    Q_OBJECT
public:
    explicit SymmetryLine(Workspace& workspace, QWidget* parent = nullptr);

private:
    void search();
    void take(const Settings& model, const QString& text);

    Workspace& workspace_;
    Settings shown_;  ///< the model whose symmetries are shown
    QTimer debounce_;
};

}  // namespace extremal
