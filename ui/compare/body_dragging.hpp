// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies dragged on the stage: where they are let go the motion starts.
///
/// While a body is dragged, short runs from where it is are made beside the window, the latest place first,
/// and shown by the plots and on the stage (preview()); one that would take longer is stopped and shown as
/// far as it came. When the body is let go the scene gets its initial data, as one step of undo, and the
/// preview stays until the whole run has results. A body that was taken at a later time starts with the
/// momenta that it had there.
#pragma once

#include <QObject>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/run/comparison.hpp"
#include "engine/scene/resolve.hpp"
#include "ui/stage/body_drag.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

class Playback;
class RunControl;
class StageWidget;
class Workspace;

class BodyDragging : public QObject {
    Q_OBJECT
public:
    BodyDragging(Workspace& workspace, RunControl& run, Playback& playback, StageWidget& stage,
                 QObject* parent);
    ~BodyDragging() override;

    /// What is shown in place of the results; null: nothing is dragged.
    std::shared_ptr<const Comparison> preview() const { return preview_; }
    bool isDragging() const { return drag_.has_value(); }
    /// Forgets what is dragged.
    void cancel();

signals:
    void previewed();  ///< preview() is another one, or null
    void refused(const QString& reason);

private:
    void take(const StagePlayer::Grip& grip);
    void move(const Point& target, bool isVelocity);
    void let(const Point& velocityOnScreen);
    void request();
    void end();
    double timePerSecond() const;
    std::vector<Edit> edits() const;

    Workspace& workspace_;
    RunControl& run_;
    Playback& playback_;
    StageWidget& stage_;
    std::optional<BodyDrag> drag_;
    std::shared_ptr<const ResolvedScene> resolved_;  ///< of the scene when the body was taken
    bool isMoved_ = false, isThrown_ = false, isFromStart_ = true, wasPlaying_ = false;
    bool isComputing_ = false, isWanted_ = false;  ///< a preview; another one after it
    bool waitsForRun_ = false;
    std::stop_source stop_;
    std::shared_ptr<const Comparison> preview_;
};

/// The initial data of a scene with the places, and the momenta or velocities, of a state; what is the same
/// as before stays as it is written. Empty `velocity`: the momenta, and with `keepsMotion` what the scene
/// has.
std::vector<Edit> editsForState(const Value& document, const Scene& scene, const System& system,
                                const State& state, const std::vector<double>& velocity, bool keepsMotion);

}  // namespace extremal
