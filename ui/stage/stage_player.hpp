// SPDX-License-Identifier: GPL-3.0-or-later
/// From a comparison and a time to the picture of the stage.
///
///     StagePlayer player(comparison);
///     StageFrame frame = player.frame(6.2, style);
///
/// Between two rows a state is interpolated by the cubic through both rows with the slopes of Hamilton's
/// equations, where the rows are close enough for that; else the nearest row is shown, and the trail is dots
/// at the rows. Bounds come from the whole run but leave out what flies away: the tail of a blow-up, and
/// schemes whose extent is far beyond that of the others.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"
#include "ui/stage/body_drag.hpp"
#include "ui/stage/potential_curves.hpp"
#include "ui/stage/stage_frame.hpp"
#include "ui/stage/stage_look.hpp"

namespace extremal {

class StagePlayer {
public:
    StagePlayer() = default;
    /// The system is made from the scene's model.
    explicit StagePlayer(std::shared_ptr<const Comparison> comparison);
    StagePlayer(std::shared_ptr<const Comparison> comparison, System system);

    /// False if the model has nothing to draw or no scheme has a row yet.
    bool hasStage() const { return !tracks_.empty(); }
    const Bounds& bounds() const { return bounds_; }
    const Comparison* comparison() const { return comparison_.get(); }
    const std::string& timeUnit() const { return system_.timeUnit; }
    double start() const;
    double end() const;  ///< time of the last row of any scheme
    double trailSpan() const { return trace_.span; }
    /// The picture has depth: it can be turned.
    bool isSpatial() const { return system_.isSpatial; }
    /// The camera that shows everything.
    Camera fittedCamera(double width, double height, double margin, const StageLook& look = {}) const;

    StageFrame frame(double t, const StageStyle& style, const StageLook& look = {}) const;

    /// Places beside each other for all schemes, seen from this direction, so that they are as large as a
    /// picture of this size allows.
    StageTiling tilingFor(double width, double height, const Camera& direction) const;
    /// Finds the curves of the potential, which takes some milliseconds.
    void findPotential();
    bool hasPotential() const { return !potential_.curves.empty(); }

    /// A body as a scheme has it at a time: a disc, or a corner of a solid, of the drawing of its state.
    struct Grip {
        std::vector<double> x;
        HeldPoint held;
        Point place{};   ///< in the picture
        Point offset{};  ///< by which its scheme is moved there
    };
    /// The body nearest to a pixel, x right and y up from the middle, and no farther than `reach` from its
    /// rim, of a solid at the corner that is nearest on the face there; none where there is no body or the
    /// bodies of the system cannot be moved.
    std::optional<Grip> gripAt(double t, const Camera& camera, double x, double y, double reach,
                               const StageTiling& tiling = {}) const;
    const System& system() const { return system_; }

private:
    /// The rows of one scheme that can be drawn: those before the first value that is not finite.
    struct Track {
        std::shared_ptr<const SchemeResult> result;
        const System* system = nullptr;  ///< of the scheme, where its mesh is its own; else null
        std::span<const double> t;
        std::vector<std::span<const double>> state;  ///< one per state column
        std::vector<double> frameTimes;              ///< of fields, whose rows are frames: t is a view of it
        bool hasFailed = false;
    };

    struct Extent {
        Bounds bounds;
        Bounds seen;  ///< right, up and towards the viewer, as the fitted camera of a system in space sees it
    };

    /// What leaves a trail: the tracer of the picture, or that of the inset.
    struct Trace {
        bool isInset = false;
        double size = 0;  ///< of the picture
        double span = 0;  ///< time that the trail goes back
    };

    void prepare();
    void prepareInset();
    void addTrack(const std::shared_ptr<const SchemeResult>& result);
    Extent findBounds(const Track& track) const;
    double findTrailSpan(const Trace& trace, double lengths) const;
    void rowState(const Track& track, std::size_t row, std::vector<double>& x) const;
    bool stateBetween(const Track& track, std::size_t row, double t, std::vector<double>& x) const;
    bool isResolved(const Track& track, std::size_t row, const Trace& trace, double& bend) const;
    const System& systemOf(const Track& track) const { return track.system ? *track.system : system_; }
    Point tracer(const Track& track, const std::vector<double>& x, bool isInset) const;
    void addExact(double t, StageFrame& frame) const;
    void makeRoomForClocks();
    void addClocks(const Track& track, double t, StageLayer& layer) const;
    void stateAt(const Track& track, double t, std::vector<double>& x) const;
    std::vector<TrailPoint> trail(const Track& track, const Trace& trace, double t, std::size_t rows) const;
    std::vector<TrailPoint> marks(const Track& track, const Trace& trace, double t) const;
    Trace traceFor(StageTrails trails) const;
    void tile(StageFrame& frame, const StageTiling& tiling) const;
    const Bounds& flatBounds(const StageLook& look, Bounds& whole) const;
    std::string eventNote(const Track& track, const std::string& label, double t) const;
    std::string failureNote(const Track& track, const std::string& label) const;

    std::shared_ptr<const Comparison> comparison_;
    System system_;
    std::vector<Track> tracks_;
    Bounds bounds_, seen_;
    double clockGround_ = 0, clockTop_ = 0;  ///< of the band of the element clocks; equal: there is none
    ExactSolution exact_;                    ///< of a field, drawn behind the schemes
    std::size_t exactWidth_ = 0;
    Trace trace_, insetTrace_{true, 0, 0};
    PotentialCurves potential_;
    std::optional<StageInset> inset_;
};

}  // namespace extremal
