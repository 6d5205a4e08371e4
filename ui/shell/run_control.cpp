#include "ui/shell/run_control.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/map_grid.hpp"
#include "ui/shell/notices.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {

namespace {

constexpr int debounceMs = 150, pollMs = 33;

/// The scene as far as its run depends on it.
Scene computed(Scene scene) {
    scene.title = scene.source = scene.lesson = scene.notes = {};
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

bool hasSamples(const Comparison& comparison) {
    return std::any_of(comparison.schemes.begin(), comparison.schemes.end(),
                       [](const auto& s) { return s && s->trajectory.rows() > 1; });
}

}  // namespace

void CostModel::learn(const Comparison& comparison) {
    constexpr std::size_t maxKnown = 200;
    for (const auto& scheme : comparison.schemes) {
        if (scheme->summary.steps < 10 || scheme->summary.cpuSeconds <= 0) continue;
        std::erase_if(known_, [&](const Known& k) {
            return k.model == comparison.scene.model && isSameMethod(k.spec, scheme->spec);
        });
        known_.push_back({scheme->spec, comparison.scene.model,
                          scheme->summary.cpuSeconds / static_cast<double>(scheme->summary.steps)});
    }
    if (known_.size() > maxKnown) known_.erase(known_.begin(), known_.end() - maxKnown);
}

double CostModel::predict(const Scene& scene) const {
    double seconds = 0;
    const double inMaps = mapStepsOf(scene), size = sizeOf(scene.model);
    for (const SchemeSpec& spec : scene.schemes) {
        if (!spec.isEnabled) continue;
        const double steps = stepsOf(scene, spec) + (spec.step.value > 0 ? inMaps : 0);
        const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& k) {
            return k.model.type == scene.model.type && isSameMethod(k.spec, spec);
        });
        seconds +=
            steps * size *
            (found == known_.end() ? guessPerStep(spec) : found->secondsPerStep / sizeOf(found->model));
    }
    return seconds;
}

RunControl::RunControl(Workspace& workspace, Notices& notices, QObject* parent)
    : QObject(parent), workspace_(workspace), notices_(notices) {
    debounce_.setSingleShot(true);
    debounce_.setInterval(debounceMs);
    pollTimer_.setInterval(pollMs);
    connect(&debounce_, &QTimer::timeout, this, [this] {
        const double seconds = cost_.predict(workspace_.scene());
        seconds > askAboveSeconds ? offer(seconds) : start();
    });
    connect(&pollTimer_, &QTimer::timeout, this, &RunControl::poll);
    connect(&workspace_, &Workspace::sceneChanged, this, &RunControl::sceneChanged);
    connect(&workspace_, &Workspace::opened, this, [this] {
        retire();
        results_.reset();
        lastScene_.reset();
        isStale_ = false;
        debounce_.setInterval(0);  // a scene that was just opened runs at once
        emit resultsChanged();
    });
}

RunControl::~RunControl() {
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

void RunControl::sceneChanged() {
    Scene scene = computed(workspace_.scene());
    if (lastScene_ && *lastScene_ == scene) return;
    lastScene_ = std::move(scene);
    notices_.dismiss("offer");
    if (results_ && !isStale_) {
        isStale_ = true;
        emit resultsChanged();
    }
    setState(State::scheduled);
    retire();
    debounce_.start();
    debounce_.setInterval(debounceMs);
}

void RunControl::offer(double seconds) {
    const QString time =
        seconds < 120 ? tr("%1 s").arg(seconds, 0, 'f', 0) : tr("%1 min").arg(seconds / 60, 0, 'f', 0);
    notices_.post({Notice::Kind::information,
                   "offer",
                   tr("This run will take about %1.").arg(time),
                   tr("press Run, or take larger steps"),
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
    if (!workspace_.hasScene()) return;
    debounce_.stop();
    retire();
    notices_.dismiss("offer");
    try {
        run_ = std::make_unique<Run>(workspace_.scene(),
                                     RunOptions{.products = {Product::denseOutput}});  // of the stage
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
                       {}});
        setState(State::idle);
        return;
    }
    isStale_ = results_ != nullptr;
    pollTimer_.start();
    setState(State::running);
}

void RunControl::stop() {
    debounce_.stop();
    if (run_) run_->stop();
    if (state_ == State::scheduled) setState(State::idle);
}

void RunControl::poll() {
    std::erase_if(stopping_, [](const auto& run) { return run->isFinished(); });
    if (!run_) {
        if (stopping_.empty()) pollTimer_.stop();
        return;
    }
    const bool isDone = run_->isFinished();
    auto latest = std::make_shared<const Comparison>(run_->latest());
    if (hasSamples(*latest) || isDone) {
        results_ = latest;
        isStale_ = false;
    }
    if (isDone) {
        cost_.learn(*latest);
        notices_.dismiss("reference");
        for (const Problem& p : latest->reference.problems)
            notices_.post({Notice::Kind::warning,
                           "reference",
                           tr("There is no reference, so errors are unknown: %1")
                               .arg(QString::fromStdString(p.message)),
                           QString::fromStdString(p.hint),
                           {}});
        run_.reset();
        setState(State::finished);
    }
    emit resultsChanged();
    if (isDone) emit finished();
}

}  // namespace extremal
