// SPDX-License-Identifier: GPL-3.0-or-later
/// A case of a map of parameters on the stage, while the pointer rests on its cell: the scheme of the map
/// runs it alone, in the background, and its motion is repeated until the pointer leaves.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <stop_token>

#include "engine/scene/scene.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {

class StageWidget;
class Workspace;

class CasePreview : public QObject {
    Q_OBJECT
public:
    CasePreview(const Workspace& workspace, StageWidget& stage, QObject* parent = nullptr);
    ~CasePreview() override;

    /// After the pointer has rested for a moment. The case that is shown already, or is coming, stays.
    void show(const View& view, double value, double step);
    void hide();
    bool isShown() const { return clock_.isActive(); }

signals:
    void shown();   ///< the stage shows the case
    void hidden();  ///< the stage is free again

private:
    struct Case {
        View view;
        double value = 0, step = 0;
        bool operator==(const Case&) const = default;
    };
    void compute();
    void play(StagePlayer player);
    void tick();

    const Workspace& workspace_;
    StageWidget& stage_;
    std::optional<Case> case_;
    QTimer rest_, clock_;
    QElapsedTimer since_;
    double start_ = 0, end_ = 0;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
