// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/body_dragging.hpp"

#include <QPointer>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "engine/model/parts/by_hand.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/map_grid.hpp"
#include "ui/base/background.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

using namespace std::chrono_literals;

constexpr auto previewTime = 40ms;
constexpr double secondsOfWholeRun = 12;  ///< that playing it takes

Value numbersFrom(const double* x, std::size_t count, const Value* before, const std::vector<Number>* known) {
    constexpr int digits = 5;  // more than a mouse can set
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(x[i]));
    Value::Array numbers;
    for (std::size_t i = 0; i < count; ++i) {
        const bool isWritten = before && before->isArray() && i < before->asArray().size() && known &&
                               i < known->size() && std::abs((*known)[i].value - x[i]) <= 1e-9 * largest;
        numbers.push_back(isWritten ? before->asArray()[i] : Value(handNumber(x[i], largest, digits)));
    }
    return Value(std::move(numbers));
}

/// A run that is short and has nothing but schemes: no reference, no maps, no further starts.
ResolvedScene shortened(const ResolvedScene& whole, const State& start) {
    ResolvedScene scene = whole;
    scene.initial = start;
    if (scene.system->hasCoordinates()) {
        scene.scene.initial.q.clear();
        scene.scene.initial.pOrV.clear();
        const auto d = static_cast<std::size_t>(scene.system->dimension());
        for (std::size_t i = 0; i < d; ++i) {
            scene.scene.initial.q.push_back(Number{start.x[i], {}});
            scene.scene.initial.pOrV.push_back(Number{start.x[d + i], {}});
        }
        scene.scene.initial.second = Initial::Second::momentum;
    }
    scene.scene.reference.kind = ReferenceSpec::Kind::none;
    scene.reference.clear();
    scene.scene.events.clear();
    std::erase_if(scene.scene.views,
                  [](const View& view) { return view.id == mapView || !view.starts.isEmpty(); });
    return scene;
}

/// What there is after a moment; null: nothing.
std::shared_ptr<const Comparison> previewOf(const ResolvedScene& scene, const std::stop_token& stop) {
    Run run(scene, {.threads = 2, .products = {Product::denseOutput}, .isTimed = false});
    run.start();
    if (!run.waitFor(std::chrono::duration_cast<std::chrono::milliseconds>(previewTime))) run.stop();
    run.wait();
    if (stop.stop_requested()) return {};
    auto result = std::make_shared<Comparison>(run.latest());
    std::erase_if(result->schemes, [](const auto& s) { return !s || s->trajectory.rows() < 2; });
    return result->schemes.empty() ? nullptr : result;
}

/// The start in the model itself, where that says it.
std::vector<Edit> editsForWrittenForm(const Value& document, const System& system, const WrittenForm& form,
                                      const State& state, const std::vector<double>& velocity,
                                      bool keepsMotion) {
    std::vector<double> v = velocity.empty() ? form.v : velocity;
    if (velocity.empty() && !keepsMotion) {
        std::vector<double> rate(state.x.size());
        if (rateOf(system, state.t, state.x.data(), rate.data()))
            v.assign(rate.begin(), rate.begin() + system.dimension());
    }
    std::vector<Edit> edits;
    if (const Value* const model = valueAt(document, "/model"))
        edits.push_back({"/model", form.withStart(form, *model, state.x.data(), v.data())});
    if (const Value* const initial = valueAt(document, "/initial"); initial && initial->isObject())
        for (const char* key : {"q", "p", "v", "q1", "at"})
            if (initial->find(key)) edits.push_back({std::string("/initial/") + key, std::nullopt});
    return edits;
}

}  // namespace

std::vector<Edit> editsForState(const Value& document, const Scene& scene, const System& system,
                                const State& state, const std::vector<double>& velocity, bool keepsMotion) {
    const auto d = static_cast<std::size_t>(system.dimension());
    if (const auto* const form = system.parts.find<WrittenForm>())
        return editsForWrittenForm(document, system, *form, state, velocity, keepsMotion);
    const Value* const now = valueAt(document, "/initial");
    Value initial = now && now->isObject() ? *now : Value(Value::Object{});
    if (const auto* const hand = system.parts.find<ByHand>())
        return {{"/initial", hand->written(std::move(initial), state.x.data(), keepsMotion)}};
    const Value before = initial.find("q") ? *initial.find("q") : Value();
    initial.set("q", numbersFrom(state.x.data(), d, &before, &scene.initial.q));
    if (!velocity.empty()) {
        dropKeys(initial, {"p", "q1", "at"});
        initial.set("v", numbersFrom(velocity.data(), d, nullptr, nullptr));
    } else if (!keepsMotion || initial.find("q1")) {
        dropKeys(initial, {"v", "q1", "at"});
        initial.set("p", numbersFrom(state.x.data() + d, d, nullptr, nullptr));
    }
    // Of rounded numbers places miss the constraints by more than rounding.
    if (system.parts.find<Constraint>()) initial.set("project", true);
    return {{"/initial", initial}};
}

BodyDragging::BodyDragging(Workspace& workspace, RunControl& run, Playback& playback, StageWidget& stage,
                           QObject* parent)
    : QObject(parent), workspace_(workspace), run_(run), playback_(playback), stage_(stage) {
    connect(&stage_, &StageWidget::bodyTaken, this, &BodyDragging::take);
    connect(&stage_, &StageWidget::bodyMoved, this, &BodyDragging::move);
    connect(&stage_, &StageWidget::bodyLet, this, &BodyDragging::let);
    connect(&workspace_, &Workspace::opened, this, &BodyDragging::cancel);
    const auto endWhenComputed = [this] {
        const RunControl::State state = run_.state();
        const bool isOver = state == RunControl::State::offered || state == RunControl::State::stopped ||
                            state == RunControl::State::idle;
        if (waitsForRun_ && (isOver || (run_.results() && !run_.isStale()))) end();
    };
    connect(&run_, &RunControl::resultsChanged, this, endWhenComputed);
    connect(&run_, &RunControl::stateChanged, this, endWhenComputed);
}

BodyDragging::~BodyDragging() { stop_.request_stop(); }

/// The time of the model that passes in a second of playing.
double BodyDragging::timePerSecond() const {
    const double all = playback_.end() - playback_.start();
    return all > 0 ? playback_.speed() * all / secondsOfWholeRun : 1;
}

void BodyDragging::take(const StagePlayer::Grip& grip) {
    resolved_ = workspace_.resolved();
    if (!resolved_ || !hasMovableBodies(*resolved_->system)) return;
    if (grip.x.size() > resolved_->initial.x.size()) return;
    waitsForRun_ = false;
    wasPlaying_ = playback_.isPlaying();
    playback_.setPlaying(false);
    const double start = resolved_->scene.start.value;
    isFromStart_ = !(stage_.time() > start);
    // The start itself, where that is what is seen: its numbers may be written as formulas.
    State state = resolved_->initial;
    if (!isFromStart_) std::copy(grip.x.begin(), grip.x.end(), state.x.begin());
    drag_.emplace(resolved_->system, std::move(state), grip.held);
    isMoved_ = isThrown_ = false;
}

void BodyDragging::move(const Point& target, bool isVelocity) {
    if (!drag_) return;
    const bool isChanged = isVelocity ? drag_->throwWith([&] {
        const Point at = drag_->place();
        const double scale = 1 / timePerSecond();
        return Point{scale * (target[0] - at[0]), scale * (target[1] - at[1]), scale * (target[2] - at[2])};
    }())
                                      : drag_->moveTo(target);
    if (!isChanged) return;
    isThrown_ = isThrown_ || isVelocity;
    if (!isMoved_) playback_.setTime(playback_.start());
    isMoved_ = true;
    stage_.setGhost(drag_->drawing());
    request();
}

/// The latest state is what counts: one run at a time, then that of what came meanwhile.
void BodyDragging::request() {
    isWanted_ = true;
    if (isComputing_ || !drag_) return;
    isWanted_ = false;
    isComputing_ = true;
    stop_ = std::stop_source();
    runInBackground(
        [self = QPointer(this), resolved = resolved_, state = drag_->state(), stop = stop_.get_token()] {
            std::shared_ptr<const Comparison> made;
            try {
                made = previewOf(shortened(*resolved, state), stop);
            } catch (const std::exception&) {
                made.reset();  // what cannot start there is refused when the body is let go
            }
            sendToWindow([self, made, stop] {
                if (!self) return;
                self->isComputing_ = false;
                if (made && !stop.stop_requested() && (self->drag_ || self->waitsForRun_)) {
                    self->preview_ = made;
                    emit self->previewed();
                }
                if (self->isWanted_) self->request();
            });
        });
}

std::vector<Edit> BodyDragging::edits() const {
    return editsForState(workspace_.document(), workspace_.scene(), *resolved_->system, drag_->state(),
                         isThrown_ ? drag_->velocity() : std::vector<double>{}, isFromStart_ && !isThrown_);
}

void BodyDragging::let(const Point& velocityOnScreen) {
    if (!drag_) return;
    if (!isMoved_) {  // a click
        drag_.reset();
        stage_.setGhost({});
        playback_.setPlaying(wasPlaying_);
        return;
    }
    const double scale = 1 / timePerSecond();
    const Point velocity{scale * velocityOnScreen[0], scale * velocityOnScreen[1],
                         scale * velocityOnScreen[2]};
    const bool isFast = velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
    if (isFast && !isThrown_) isThrown_ = drag_->throwWith(velocity);
    const std::vector<Edit> made = edits();
    wasPlaying_ = wasPlaying_ || isThrown_;
    waitsForRun_ = true;
    isWanted_ = false;
    drag_.reset();
    const std::vector<Problem> problems = workspace_.tryEdit(made, tr("Drag a body"));
    if (!problems.empty()) {
        wasPlaying_ = false;
        end();
        emit refused(QString::fromStdString(problems.front().message));
    } else if (run_.results() && !run_.isStale()) {
        end();  // nothing has changed, or it was known
    }
}

void BodyDragging::end() {
    waitsForRun_ = false;
    cancel();
    if (wasPlaying_) {
        playback_.setTime(playback_.start());
        playback_.setPlaying(true);
    }
}

void BodyDragging::cancel() {
    stop_.request_stop();
    waitsForRun_ = false;
    isWanted_ = false;
    drag_.reset();
    stage_.setGhost({});
    const bool had = preview_ != nullptr;
    preview_.reset();
    if (had) emit previewed();
}

}  // namespace extremal
