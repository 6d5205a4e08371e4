// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything of a comparison in a folder: the files of `extremal run`, the figures as PNG, SVG and PDF, the
/// stage, a page that can be read in any browser, and the commands that make files and figures again.
#pragma once

#include <QImage>
#include <QString>

#include <functional>
#include <memory>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

struct ExportParts {
    std::shared_ptr<const Comparison> comparison;
    std::vector<Figure> figures;
    QImage stage;     ///< null: there is none
    int frames = 90;  ///< of the page that plays; 0: it stands still
};

/// An export in steps, each of a tenth of a second or so, which return what went wrong, empty if nothing did.
/// The first, which writes the files of the run and the page, may be made in any thread; the others draw, in
/// that of the window.
std::vector<std::function<QString()>> exportSteps(const ExportParts& parts, const QString& folder);

/// All steps at once.
QString exportFolder(const ExportParts& parts, const QString& folder);

/// One file of HTML with everything in it: notes, schemes with their errors and costs, pictures as SVG, the
/// scene as text, and the motion, which plays (playing_page.hpp). Any thread may make it.
QString reportPage(const ExportParts& parts);

/// The stage at evenly spaced times, one picture "frame-0001.png" per step. `picture`: of the stage
/// at a time.
std::vector<std::function<QString()>> frameSteps(const QString& folder, double start, double end, int count,
                                                 const std::function<QImage(double)>& picture);

/// The commands, one per line, to be run in the folder.
QString commandsFor(const ExportParts& parts);

/// The name of the figure at a place, without an ending: "2-energy".
QString figureName(const ExportParts& parts, std::size_t place);

}  // namespace extremal
