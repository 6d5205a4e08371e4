// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of a finished comparison without a display: the stage through OSMesa, the plots through
/// QCustomPlot, in the look of the window's cards and the light theme. The same comparison gives the same
/// bytes.
///
///     SnapshotRequest request{.file = "pendulum.png"};
///     checkSnapshot(scene, request);               // before the run: nothing is half done
///     SnapshotResult result = makeSnapshot(comparison, request);
///
/// Needs a QApplication on any platform, "offscreen" included; call it from its thread.
#pragma once

#include <QImage>
#include <QString>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "engine/run/comparison.hpp"
#include "engine/run/files/replacing.hpp"

namespace extremal {

struct SnapshotRequest {
    QString file;                    ///< .png, .pdf or .svg
    int width = 1200, height = 800;  ///< pixels, 64..8192; 96 to the inch in PDF and SVG
    /// A view, or "all": those of the scene but for what depends on the clock (speed against accuracy), so
    /// that two pictures of one scene are equal.
    std::string view = "all";
    std::optional<double>
        time;             ///< the nearest row is shown; default: that of the scene, or the end of the run
    QString compareWith;  ///< a picture to compare with; empty: none
    /// Percent of the pixels that may differ by more than 8 of 255; of any tile of 16 x 16 pixels, 50 times
    /// as many.
    double tolerance = 0.1;
    Replacing replacing = {};  ///< besides, the picture to compare with is never replaced
};

struct SnapshotResult {
    double time = 0;  ///< of the row shown
    bool isCompared = false, isEqual = true;
    double differingPercent = 0;
    std::string verdict;     ///< of the comparison, one line
    QString differenceFile;  ///< FILE.diff.png, written by every comparison
};

class SnapshotError : public std::runtime_error {
public:
    enum class Kind {
        unusable,    ///< wrong request: size, view, ending, picture to compare with
        noOpenGl,    ///< OSMesa is missing; the hint names the package
        unwritable,  ///< the file cannot be written
    };
    SnapshotError(Kind itsKind, std::string place, const std::string& message, std::string remedy = {})
        : std::runtime_error(message), kind(itsKind), where(std::move(place)), hint(std::move(remedy)) {}
    Kind kind;
    std::string where, hint;  ///< as in `extremal: WHERE: WHAT (HINT)`
};

/// Throws SnapshotError if the request cannot be fulfilled, as far as that can be known without running the
/// scene, and what requireReplaceable does.
void checkSnapshot(const Scene& scene, const SnapshotRequest& request);

/// Throws SnapshotError if a view, or "all", cannot be drawn for the scene.
void checkSnapshotView(const Scene& scene, const std::string& view);

/// Draws, writes and compares. Throws SnapshotError.
SnapshotResult makeSnapshot(std::shared_ptr<const Comparison> comparison, const SnapshotRequest& request);

/// The picture alone, as a PNG would show it. Throws SnapshotError.
QImage snapshotImage(std::shared_ptr<const Comparison> comparison, const SnapshotRequest& request);

}  // namespace extremal
