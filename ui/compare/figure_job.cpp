// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/figure_job.hpp"

#include <QCoreApplication>

#include "engine/scene/bind.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {

FigureSet makeFigures(const FigureJob& job) {
    const Comparison& results = *job.results;
    const std::shared_ptr<const System> system =
        results.system ? results.system : std::make_shared<const System>(makeSystem(results.scene));
    FigureSet made{job, {}, {}};
    for (const auto& [plot, view] : job.views)
        made.figures.push_back(makeFigure(results, view, system.get()));
    if (job.makesStage) made.player.emplace(job.results, *system).findPotential();
    return made;
}

Figure figureToCome(const View& view, RunControl::State state) {
    Figure figure;  // of no view yet: what is asked of the plot waits for the real one
    if (const ViewEntry* entry = findView(view.id)) figure.title = entry->item.title;
    figure.axes = AxisStyle::none;
    const char* words = "Computing ...";
    if (state == RunControl::State::offered) words = "Waiting for Run";
    if (state == RunControl::State::stopped) words = "Stopped before there was anything to draw";
    if (state == RunControl::State::idle) words = "Not computed";
    figure.message = QCoreApplication::translate("extremal", words).toStdString();
    return figure;
}

bool isSameData(const Comparison& a, const Comparison& b) {
    // What a map marks, and where motions start, is in the scene.
    if (hasFurtherProducts(a) || hasFurtherProducts(b)) return &a == &b;
    return a.schemes == b.schemes && a.isFinished == b.isFinished && a.scene.model == b.scene.model &&
           a.scene.start == b.scene.start && a.scene.end == b.scene.end &&
           a.scene.observe == b.scene.observe && a.reference.type == b.reference.type &&
           a.reference.description == b.reference.description;
}

}  // namespace extremal
