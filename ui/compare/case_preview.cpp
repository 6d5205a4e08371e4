// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/case_preview.hpp"

#include <QPointer>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "engine/run/run.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/base/background.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/document.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

using namespace std::chrono_literals;

constexpr int restMs = 200, frameMs = 33;
constexpr double secondsOfMotion = 5;  ///< that one repetition takes

/// The scheme of the map alone, in this case, over the time that the runs of the map take; null: there is
/// none.
Value documentOf(const Scene& scene, const View& view, double value, double step) {
    const std::vector<Edit> edits = editsForCase(scene, view, value, step);
    const auto own = std::find_if(scene.schemes.begin(), scene.schemes.end(),
                                  [&](const SchemeSpec& s) { return s.label == view.scheme; });
    if (edits.empty() || own == scene.schemes.end()) return {};
    Value document = withEdits(toValue(scene), edits);
    const auto place = static_cast<std::size_t>(own - scene.schemes.begin());
    keepAlone(document, place);
    document.find("schemes")->asArray()[0].set("style", styleOf(*own, place) + 1);
    document.set("reference", "none");
    document.set("events", Value::Array{});
    document.set("views", Value::Array{"stage"});
    const double duration = mapGridOf(scene, view).duration;
    document.set("time",
                 Value(Value::Object{{"start", scene.start.value}, {"end", scene.start.value + duration}}));
    return document;
}

/// What there is of its motion after two seconds at most; empty where it cannot be run, or was stopped.
std::optional<StagePlayer> playerOf(const Value& document, const std::stop_token& stop) {
    const ReadScene read = readScene(document);
    if (!read.resolved) return {};
    Run run(*read.resolved, {.threads = 1, .products = {Product::denseOutput}, .isTimed = false});
    run.start();
    for (int i = 0; i < 100 && !stop.stop_requested() && !run.waitFor(20ms); ++i) continue;
    run.stop();
    run.wait();
    if (stop.stop_requested()) return {};
    StagePlayer player(std::make_shared<const Comparison>(run.latest()));
    return player.hasStage() ? std::optional(std::move(player)) : std::nullopt;
}

}  // namespace

CasePreview::CasePreview(const Workspace& workspace, StageWidget& stage, QObject* parent)
    : QObject(parent), workspace_(workspace), stage_(stage) {
    rest_.setSingleShot(true);
    rest_.setInterval(restMs);
    clock_.setInterval(frameMs);
    connect(&rest_, &QTimer::timeout, this, &CasePreview::compute);
    connect(&clock_, &QTimer::timeout, this, &CasePreview::tick);
}

CasePreview::~CasePreview() { stop_.request_stop(); }

void CasePreview::show(const View& view, double value, double step) {
    const Case wanted{view, value, step};
    if (case_ == wanted) return;
    case_ = wanted;
    rest_.start();
}

void CasePreview::hide() {
    rest_.stop();
    stop_.request_stop();
    case_.reset();
    if (!isShown()) return;
    clock_.stop();
    emit hidden();
}

void CasePreview::compute() {
    stop_.request_stop();
    stop_ = std::stop_source();
    if (!case_ || !workspace_.hasScene()) return;
    Value document = documentOf(workspace_.scene(), case_->view, case_->value, case_->step);
    if (!document.isObject()) return;
    runInBackground([self = QPointer(this), document = std::move(document), stop = stop_.get_token()] {
        std::shared_ptr<StagePlayer> made;
        try {
            if (auto player = playerOf(document, stop))
                made = std::make_shared<StagePlayer>(std::move(*player));
        } catch (const std::exception&) {
            return;  // what cannot be run is said where the case is loaded
        }
        if (!made) return;
        sendToWindow([self, made, stop] {
            if (self && !stop.stop_requested()) self->play(std::move(*made));
        });
    });
}

void CasePreview::play(StagePlayer player) {
    start_ = player.start();
    end_ = player.end();
    stage_.setPlayer(std::move(player));
    since_.start();
    clock_.start();
    tick();
    emit shown();
}

void CasePreview::tick() {
    const double part = std::fmod(1e-3 * static_cast<double>(since_.elapsed()) / secondsOfMotion, 1.0);
    stage_.setTime(start_ + part * (end_ - start_));
}

}  // namespace extremal
