// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/run_control.hpp"

#include <QPointer>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/run/reuse.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "ui/base/background.hpp"
#include "ui/base/notices.hpp"
#include "ui/workspace/bare_scene.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

constexpr int debounceMs = 150, pollMs = 33;

/// Views that are computed besides the schemes: maps, and starts.
bool hasFurtherViews(const Scene& scene) {
    return std::any_of(scene.views.begin(), scene.views.end(),
                       [](const View& v) { return v.id == mapView || !v.starts.isEmpty(); });
}

/// The schemes that are not known, as a scene.
Scene unknownPart(Scene scene, const ResultStore& store) {
    const Scene whole = scene;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        if (store.find(whole, i)) scene.schemes[i].isEnabled = false;
    return scene;
}

double stepsOf(const Scene& scene, const SchemeSpec& spec) {
    const double span = scene.end.value - scene.start.value;
    return spec.step.value > 0 ? std::abs(span) / spec.step.value : 1000;
}

/// Steps of each scheme in the cells of the scene's maps.
double mapStepsOf(const Scene& scene) {
    double steps = 0;
    for (const View& view : scene.views) {
        if (view.id != mapView || view.keys.keys.empty()) continue;
        const MapGrid grid = mapGridOf(scene, view);
        for (const double step : grid.steps)
            steps += static_cast<double>(grid.values.size()) * grid.duration / step;
    }
    return steps;
}

/// Steps from the starts of views, each with its own scheme, on one of the cores that share them.
double startStepsOf(const Scene& scene, const SchemeSpec& spec) {
    double motions = 0;
    for (const View& view : scene.views) {
        const auto first = std::find_if(scene.schemes.begin(), scene.schemes.end(), [&](const SchemeSpec& s) {
            return s.isEnabled && (view.scheme.empty() || s.label == view.scheme);
        });
        if (first != scene.schemes.end() && first->label == spec.label)
            motions += static_cast<double>(view.starts.points.size()) + view.starts.spread;
    }
    return motions * stepsOf(scene, spec) / std::max(1u, std::thread::hardware_concurrency());
}

/// The size that determines the cost of a step: the nodes of a wave function, relative to 64 modes.
double sizeOf(const Settings& model) {
    const double modes = model.number("modes"), across = model.number("modes_y");
    return modes > 0 ? modes * std::max(1.0, across) / 64 : 1;
}

bool isSameMethod(const SchemeSpec& a, const SchemeSpec& b) {
    return a.kind == b.kind && a.space == b.space && a.quadrature == b.quadrature &&
           a.baseline == b.baseline && a.named == b.named && a.solver == b.solver;
}

/// Before anything is measured: about a microsecond for an explicit step, several for an implicit one.
double guessPerStep(const SchemeSpec& spec) {
    if (spec.kind == SchemeSpec::Kind::baseline) return 1e-6;
    return 4e-6 * std::max(1.0, spec.space.number("degree"));
}

/// A scheme that is not known from before has rows.
bool hasNewSamples(const Comparison& comparison, const Scene& scene, const ResultStore& store) {
    return std::any_of(comparison.schemes.begin(), comparison.schemes.end(), [&](const auto& s) {
        if (!s || s->trajectory.rows() <= 1) return false;
        for (std::size_t i = 0; i < scene.schemes.size(); ++i)
            if (scene.schemes[i].label == s->spec.label) return !store.find(scene, i);
        return true;
    });
}

bool isSame(const Comparison& a, const Comparison& b) {
    return a.schemes == b.schemes && a.isFinished == b.isFinished && a.scene == b.scene &&
           !hasFurtherProducts(a) && !hasFurtherProducts(b);
}

}  // namespace

void CostModel::keep(Known known) {
    constexpr std::size_t maxKnown = 200;
    std::erase_if(known_,
                  [&](const Known& k) { return k.model == known.model && isSameMethod(k.spec, known.spec); });
    known_.push_back(std::move(known));
    if (known_.size() > maxKnown) known_.erase(known_.begin(), known_.end() - maxKnown);
}

void CostModel::learn(const Comparison& comparison) {
    for (const auto& scheme : comparison.schemes)
        if (scheme->summary.steps >= 10 && scheme->summary.cpuSeconds > 0)
            keep({scheme->spec, comparison.scene.model,
                  scheme->summary.cpuSeconds / static_cast<double>(scheme->summary.steps)});
}

void CostModel::learn(const Scene& scene, const TrialCosts& trial) {
    for (const auto& [spec, seconds] : trial.seconds)
        keep({spec, scene.model, seconds / stepsOf(scene, spec)});
}

const CostModel::Known* CostModel::find(const Scene& scene, const SchemeSpec& spec) const {
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& k) {
        return k.model.type == scene.model.type && isSameMethod(k.spec, spec);
    });
    return found == known_.end() ? nullptr : &*found;
}

bool CostModel::knows(const Scene& scene) const {
    return std::all_of(scene.schemes.begin(), scene.schemes.end(),
                       [&](const SchemeSpec& spec) { return !spec.isEnabled || find(scene, spec); });
}

double CostModel::secondsOf(const Scene& scene, const SchemeSpec& spec, double stepsInMaps) const {
    if (!spec.isEnabled) return 0;
    const double steps =
        stepsOf(scene, spec) + (spec.step.value > 0 ? stepsInMaps : 0) + startStepsOf(scene, spec);
    const Known* const known = find(scene, spec);
    return steps * sizeOf(scene.model) *
           (known ? known->secondsPerStep / sizeOf(known->model) : guessPerStep(spec));
}

double CostModel::predict(const Scene& scene) const {
    double seconds = 0;
    const double inMaps = mapStepsOf(scene);
    for (const SchemeSpec& spec : scene.schemes) seconds += secondsOf(scene, spec, inMaps);
    return seconds;
}

std::pair<std::string, double> CostModel::largestPart(const Scene& scene) const {
    std::pair<std::string, double> largest;
    const double inMaps = mapStepsOf(scene);
    for (const SchemeSpec& spec : scene.schemes)
        if (const double seconds = secondsOf(scene, spec, inMaps); seconds > largest.second)
            largest = {spec.label, seconds};
    return largest;
}

RunControl::RunControl(Workspace& workspace, Notices& notices, QObject* parent)
    : QObject(parent), workspace_(workspace), notices_(notices) {
    debounce_.setSingleShot(true);
    debounce_.setInterval(debounceMs);
    pollTimer_.setInterval(pollMs);
    connect(&debounce_, &QTimer::timeout, this, &RunControl::decide);
    connect(&pollTimer_, &QTimer::timeout, this, &RunControl::poll);
    connect(&workspace_, &Workspace::sceneChanged, this, &RunControl::sceneChanged);
    connect(&workspace_, &Workspace::opened, this, [this] {
        retire();
        store_.clear();
        results_.reset();
        lastScene_.reset();
        isStale_ = false;
        debounce_.setInterval(0);  // a scene that was just opened runs at once
        emit resultsChanged();
    });
}

RunControl::~RunControl() {
    trial_.request_stop();
    if (run_) run_->stop();
    for (const auto& run : stopping_) run->stop();
}

double RunControl::fraction() const {
    if (state_ == State::finished) return 1;
    return run_ ? run_->fraction() : 0;
}

void RunControl::setState(State state) {
    if (state == state_) return;
    state_ = state;
    emit stateChanged();
}

/// All results of a scene, if none is missing.
std::optional<Comparison> RunControl::known(const Scene& scene) const {
    if (!results_ || hasFurtherViews(scene)) return {};
    Comparison comparison;
    comparison.scene = scene;
    comparison.reference = results_->reference;
    comparison.isFinished = true;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        if (!scene.schemes[i].isEnabled) continue;
        const ResultStore::Entry* entry = store_.find(scene, i);
        if (!entry) return {};
        comparison.reference = entry->reference;
        comparison.schemes.push_back(
            resultFor(entry->result, scene.schemes[i], styleOf(scene.schemes[i], i)));
    }
    comparison.system = results_->system && results_->scene.model == scene.model
                            ? results_->system
                            : std::make_shared<const System>(makeSystem(scene));
    return comparison;
}

/// Whether the run that goes on computes what is missing.
bool RunControl::isCoveredByRun(const Scene& scene) const {
    if (!run_ || hasFurtherViews(scene) || hasFurtherViews(runScene_)) return false;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const SchemeSpec& spec = scene.schemes[i];
        if (!spec.isEnabled || store_.find(scene, i)) continue;
        const bool isComputed =
            std::any_of(runScene_.schemes.begin(), runScene_.schemes.end(), [&](const SchemeSpec& other) {
                return other.isEnabled && coversRun(runScene_, other, scene, spec);
            });
        if (!isComputed) return false;
    }
    return true;
}

void RunControl::sceneChanged() {
    const Scene& scene = workspace_.scene();
    if (lastScene_ && *lastScene_ == bareScene(scene)) return;
    lastScene_ = bareScene(scene);
    notices_.dismiss("offer");
    trial_.request_stop();
    if (run_) store_.keep(run_->latest());
    if (auto all = known(scene)) {
        debounce_.stop();
        retire();
        results_ = std::make_shared<const Comparison>(std::move(*all));
        isStale_ = false;
        setState(State::finished);
        emit resultsChanged();
        emit finished();
        return;
    }
    if (isCoveredByRun(scene)) return poll();
    if (results_ && !isStale_) {
        isStale_ = true;
        emit resultsChanged();
    }
    setState(State::scheduled);
    retire();
    debounce_.start();
    debounce_.setInterval(debounceMs);
}

/// Starts the run, or offers it where it would take long. Of large models estimates tell nothing: a step on a
/// plane takes a thousand times as long as one of a pendulum. Trial steps beside the window do.
void RunControl::decide() {
    constexpr double surelyCheap = 0.3;
    const Scene wanted = unknownPart(workspace_.scene(), store_);
    const auto resolved = workspace_.resolved();
    const bool isEstimated = !resolved || cost_.knows(wanted) ||
                             (resolved->system->hasCoordinates() && cost_.predict(wanted) < surelyCheap);
    if (isEstimated) return decideWith(wanted, 0);
    trial_ = std::stop_source();
    runInBackground([self = QPointer(this), wanted, resolved, cost = cost_, stop = trial_.get_token()] {
        const auto isWanted = [&](const SchemeSpec& spec) {
            const auto there = std::find_if(wanted.schemes.begin(), wanted.schemes.end(),
                                            [&](const SchemeSpec& s) { return s.label == spec.label; });
            return there != wanted.schemes.end() && there->isEnabled && !cost.knows(wanted, spec);
        };
        const TrialCosts trial = tryCosts(*resolved, isWanted, stop);
        sendToWindow([self, wanted, trial, stop] {
            if (!self || stop.stop_requested()) return;
            self->cost_.learn(wanted, trial);
            self->decideWith(wanted, trial.reference);
        });
    });
}

void RunControl::decideWith(const Scene& wanted, double referenceSeconds) {
    const double seconds = cost_.predict(wanted) + referenceSeconds;
    if (seconds <= askAboveSeconds) return compute(true);
    const auto [label, ofScheme] = cost_.largestPart(wanted);
    const bool isReference = referenceSeconds > ofScheme;
    offer(seconds, isReference ? tr("the reference").toStdString() : label,
          isReference ? referenceSeconds : ofScheme);
}

void RunControl::offer(double seconds, const std::string& largest, double ofLargest) {
    const auto time = [](double s) {
        return s < 120 ? tr("%1 s").arg(s, 0, 'f', s < 10 ? 1 : 0) : tr("%1 min").arg(s / 60, 0, 'f', 0);
    };
    notices_.post({Notice::Kind::information,
                   "offer",
                   tr("This run waits for you, as it will take about %1 of processor time, %2 of it for %3.")
                       .arg(time(seconds), time(ofLargest), QString::fromStdString(largest)),
                   tr("press Run, take larger steps, or switch schemes off"),
                   {{tr("Run"), [this] { start(); }}}});
    setState(State::offered);
}

void RunControl::retire() {
    if (!run_) return;
    run_->stop();
    stopping_.push_back(std::move(run_));
    pollTimer_.start();
}

void RunControl::start() {
    store_.clear();
    compute(false);
}

void RunControl::compute(bool usesKnown) {
    if (!workspace_.hasScene()) return;
    debounce_.stop();
    trial_.request_stop();
    retire();
    notices_.dismiss("offer");
    RunOptions options{.products = {Product::denseOutput}};  // of the stage
    const Scene& scene = workspace_.scene();
    for (std::size_t i = 0; usesKnown && i < scene.schemes.size(); ++i) {
        const ResultStore::Entry* entry = store_.find(scene, i);
        options.known.push_back(entry ? entry->result : nullptr);
        if (entry) options.reference = entry->reference;
    }
    try {
        run_ = std::make_unique<Run>(*workspace_.resolved(), options);
        runScene_ = scene;
        wasStopped_ = false;
        run_->start();
        notices_.dismiss("run");
    } catch (const InvalidScene& error) {
        run_.reset();
        const Problem& first = error.problems().front();
        notices_.post({Notice::Kind::error,
                       "run",
                       QString::fromStdString(first.pointer.empty() ? first.message
                                                                    : first.pointer + ": " + first.message),
                       QString::fromStdString(first.hint),
                       {},
                       handbookPlace(first)});
        setState(State::idle);
        return;
    }
    isStale_ = results_ != nullptr;
    pollTimer_.start();
    setState(State::running);
}

void RunControl::stop() {
    debounce_.stop();
    trial_.request_stop();
    if (run_) {
        run_->stop();
        wasStopped_ = true;
    }
    if (state_ == State::scheduled) setState(State::stopped);
}

void RunControl::poll() {
    std::erase_if(stopping_, [](const auto& run) { return run->isFinished(); });
    if (!run_) {
        if (stopping_.empty()) pollTimer_.stop();
        return;
    }
    if (const long percent = isPreparing() ? -1 : std::lround(100 * run_->fraction());
        percent != shownPercent_) {
        shownPercent_ = percent;
        emit progressed();
    }
    auto next = std::make_shared<Comparison>(run_->latest());
    const bool isNew = next->isFinished || hasNewSamples(*next, runScene_, store_);
    if (next->isFinished) {
        cost_.learn(*next);
        notices_.dismiss("reference");
        for (const Problem& p : next->reference.problems)
            notices_.post({Notice::Kind::warning,
                           "reference",
                           tr("There is no reference, so errors are unknown: %1")
                               .arg(QString::fromStdString(p.message)),
                           QString::fromStdString(p.hint),
                           {},
                           handbookPlace(p)});
    }
    if (next->isFinished) store_.keep(*next);
    const bool isDone = takeNames(*next);
    const bool isChanged = (isNew || isDone) && (!results_ || isStale_ || !isSame(*results_, *next));
    if (isChanged) {
        results_ = std::move(next);
        isStale_ = false;
    }
    if (isDone) {
        retire();
        setState(wasStopped_ ? State::stopped : State::finished);
    }
    if (isChanged || isDone) emit resultsChanged();
    if (isDone) emit finished();
}

/// The results of a run by the names that its schemes have now, without those that are off. True if all of
/// them have come to their end.
bool RunControl::takeNames(Comparison& latest) const {
    const Scene& scene = workspace_.scene();
    if (runScene_ == scene) return latest.isFinished;
    std::vector<std::shared_ptr<const SchemeResult>> named;
    bool isComplete = true;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const SchemeSpec& spec = scene.schemes[i];
        if (!spec.isEnabled) continue;
        const auto computed = std::find_if(latest.schemes.begin(), latest.schemes.end(), [&](const auto& r) {
            return coversRun(runScene_, r->spec, scene, spec);
        });
        const ResultStore::Entry* entry = store_.find(scene, i);
        if (computed == latest.schemes.end() && !entry) continue;
        const auto& result = computed != latest.schemes.end() ? *computed : entry->result;
        named.push_back(resultFor(result, spec, styleOf(spec, i)));
        isComplete = isComplete && result->summary.status != RunStatus::running &&
                     result->summary.status != RunStatus::waiting;
    }
    latest.scene = scene;
    latest.schemes = std::move(named);
    latest.isFinished = latest.isFinished || isComplete;
    return latest.isFinished;
}

}  // namespace extremal
