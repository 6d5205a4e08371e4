// SPDX-License-Identifier: GPL-3.0-or-later
/// What "speed against accuracy" shows besides the schemes as they are: other steps, and the wanted error.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/base/format.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/study/background_sweep.hpp"
#include "ui/workspace/run_control.hpp"

namespace extremal {
namespace {

bool isOfCosts(const View& view) { return view.id == "work-precision"; }

}  // namespace

void CompareView::setSweep(const BackgroundSweep& sweep) {
    sweep_ = &sweep;
    connect(&sweep, &BackgroundSweep::changed, this, [this] {
        for (const auto& s : slots_) {
            if (!isOfCosts(s->view) || isEmpty(s->plot->figure())) continue;
            Figure figure = s->plot->figure();
            sweep_->addLines(figure);
            s->plot->setFigure(std::move(figure));
            showWanted();
        }
    });
}

void CompareView::addSweep(const View& view, Figure& figure) const {
    if (sweep_ && isOfCosts(view)) sweep_->addLines(figure);
}

void CompareView::setWanted(double error) {
    wanted_ = error;
    showWanted();
}

void CompareView::showWanted() {
    const auto results = run_.results();
    const bool hasErrors =
        results && std::any_of(results->schemes.begin(), results->schemes.end(),
                               [](const auto& s) { return std::isfinite(s->summary.maxError); });
    for (const auto& s : slots_) {
        if (!isOfCosts(s->view)) continue;
        const bool isKnown = wanted_ > 0 && hasErrors && !isEmpty(s->plot->figure());
        s->plot->setLevel(isKnown ? std::optional(wanted_) : std::nullopt, shortNumber(wanted_, 2));
    }
}

}  // namespace extremal
