// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/switched_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/mechanism/own_copy.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/event_search.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

constexpr double roundOffOfTime = 4 * std::numeric_limits<double>::epsilon();

class SwitchedStep final : public Integrator, public SwitchesParameters {
public:
    using Setting = SwitchableSystems::Setting;

    SwitchedStep(std::shared_ptr<const SwitchableSystems> systems, const System& first, MakeFrom make,
                 std::unique_ptr<Integrator> scheme)
        : systems_(std::move(systems)),
          make_(std::move(make)),
          first_(std::move(scheme)),
          scheme_(first_),
          setting_(systems_->first()),
          firstSearch_(systems_->events(setting_), first),
          search_(firstSearch_),
          h_(first_->stepSize()) {}

    TimeGrid grid() const override { return first_->grid(); }
    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        first_->setStep(h);
        scheme_->setStep(h);
    }
    std::vector<MemoryPart> memoryParts() const override { return first_->memoryParts(); }
    void begin(State& state) override {
        scheme_ = first_;
        setting_ = systems_->first();
        search_ = firstSearch_;
        hasSwitched_ = false;
        system_.reset();
        pieces_.clear();
        switches_.clear();
        scheme_->begin(state);
        search_.start(state);
    }
    bool checksFinite() const override { return false; }
    std::span<const Quantity> quantities() const override { return first_->quantities(); }
    /// Of the last piece of a step: what is summed up is summed up since the last switch.
    void measure(const State& state, double* values) const override {
        if (pieces_.empty())
            scheme_->measure(state, values);
        else
            std::copy(measured_.begin(), measured_.end(), values);
    }
    std::span<const Impact> impacts() const override { return impacts_; }
    std::span<const ParameterSwitch> switches() const override { return switches_; }
    double periodsPerStep() const override { return scheme_->periodsPerStep(); }
    std::string about() const override { return first_->about(); }
    std::string tangentProblem() const override {
        return "a variation is not known across the switch of a parameter";
    }
    void denseOutput(double tau, std::span<double> x) const override {
        if (pieces_.empty()) return scheme_->denseOutput(tau, x);
        const double start = pieces_.front().from, end = pieces_.back().to, t = start + tau * (end - start);
        const auto isBefore = [&](const Piece& p) { return end > start ? p.to < t : p.to > t; };
        auto piece = std::find_if_not(pieces_.begin(), pieces_.end(), isBefore);
        if (piece == pieces_.end()) --piece;
        piece->scheme->denseOutput(std::clamp((t - piece->start) / (piece->end - piece->start), 0.0, 1.0), x);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<SwitchedStep>(*this); }
    /// Which system moves it now is not written.
    bool checkpoint(Archive& archive) override {
        archive(search_);
        return scheme_->checkpoint(archive) && !hasSwitched_;
    }

    StepReport advance(State& state, double until) override {
        if (state.memory.empty() && !memoryParts().empty()) begin(state);
        pieces_.clear();
        switches_.clear();
        impacts_.clear();
        // At the switch itself sums are 0, and the rest is not known.
        const bool isSum = !quantities().empty() && quantities().front().name == "work";
        measured_.assign(quantities().size(), isSum ? 0 : std::numeric_limits<double>::quiet_NaN());
        scheme_->setStop(stop());
        before_ = state;
        StepReport report = scheme_->advance(state, until);
        if (report.outcome != Outcome::converged) return report;
        std::optional<MetEvent> met = firstMet(before_, state);
        if (!met) {
            impacts_.assign(scheme_->impacts().begin(), scheme_->impacts().end());
            return report;
        }
        const long long node = state.node;
        const Outcome outcome = goThroughSwitches(before_, state, until, *met, report);
        if (outcome != Outcome::converged) {
            report.outcome = outcome;
            if (outcome == Outcome::accumulation) report.step = state.t - before_.t;
            state = before_;
            return report;
        }
        state.node = node;
        report.step = state.t - before_.t;
        return report;
    }

private:
    /// A part of the last step, by the step of an integrator from `start` to `end`. All are times.
    struct Piece {
        double from, to, start, end;
        OwnCopy<Integrator> scheme;
    };

    bool isFixed() const { return grid() == TimeGrid::fixed; }

    /// The first event in the step just taken; the search is then at its start again.
    std::optional<MetEvent> firstMet(const State& before, const State& after) {
        met_.clear();
        search_.look(*scheme_, before, after, met_);
        if (met_.empty()) return {};
        search_.takeBack();
        return *std::min_element(met_.begin(), met_.end(),
                                 [](const MetEvent& a, const MetEvent& b) { return a.tau < b.tau; });
    }

    /// From `before`, whose step to `state` has met an event, to the node; of other grids to the event.
    Outcome goThroughSwitches(const State& before, State& state, double until, MetEvent met,
                              StepReport& report) {
        constexpr int mostSwitches = 1000;
        State from = before;
        for (int count = 0; count < mostSwitches; ++count) {
            State at = state;
            landAt(from, at, met, report);
            if (const Outcome outcome = exchange(at, met); outcome != Outcome::converged) {
                state = at;
                return outcome;
            }
            switches_.back().tau = (at.t - before.t) / (until - before.t);
            if (!isFixed()) {
                switches_.back().tau = 1;
                state = at;
                return Outcome::converged;
            }
            const double rest = until - at.t;
            if (!(std::abs(rest) > roundOffOfTime * std::abs(until))) {
                at.t = until;
                state = at;
                return Outcome::converged;
            }
            from = at;
            state = at;
            scheme_->setStep(rest);
            scheme_->setStop(stop());
            const StepReport step = scheme_->advance(state, until);
            report.cost += step.cost;
            report.residual = step.residual;
            if (step.outcome != Outcome::converged) return step.outcome;
            const std::optional<MetEvent> next = firstMet(from, state);
            if (!next) {
                addPiece({from.t, state.t, from.t, state.t, scheme_});
                scheme_->measure(state, measured_.data());
                scheme_->setStep(h_);
                if (!memoryParts().empty()) {
                    state.memory.clear();
                    scheme_->begin(state);
                }
                return Outcome::converged;
            }
            met = *next;
        }
        return Outcome::accumulation;
    }

    /// Goes to the event that the step from `from` to `at` has met.
    void landAt(const State& from, State& at, MetEvent& met, StepReport& report) {
        const double h = at.t - from.t;
        auto landing = search_.landOn(now(from, h), from, h, met);
        if (!landing) {
            const double end = at.t;
            scheme_->denseOutput(met.tau, at.x);
            at.t = from.t + met.tau * h;
            addPiece({from.t, at.t, from.t, end, scheme_});
            search_.goTo(*scheme_, from, end, at);
            return;
        }
        report.cost += landing->report.cost;
        const double whole = at.t;
        at.t = landing->state.t;
        at.x = landing->state.x;
        // Of several steps of a code the dense output of the last one is known.
        if (landing->from != from.t) addPiece({from.t, landing->from, from.t, whole, scheme_});
        search_.goTo(*scheme_, from, whole, at);
        addPiece({landing->from, at.t, landing->from, at.t, OwnCopy<Integrator>(std::move(landing->scheme))});
    }
    std::unique_ptr<Integrator> now(const State& from, double h) const {
        auto scheme = scheme_->clone();
        if (isFixed()) scheme->setStep(h);
        scheme->setStop(stop());
        State start = from;
        start.memory.clear();
        scheme->begin(start);
        return scheme;
    }
    void addPiece(Piece piece) {
        const auto hits = piece.scheme->impacts();
        impacts_.insert(impacts_.end(), hits.begin(), hits.end());
        pieces_.push_back(std::move(piece));
    }

    /// The other value, at a state of the motion.
    Outcome exchange(State& at, const MetEvent& met) {
        const SwitchableSystems::Switch& of = systems_->all()[met.event];
        setting_[of.parameter] = of.spec.value.value;
        try {
            system_ = systems_->system(setting_);
            putOnConstraints(*system_, at, false);
            requireOutsideWalls(*system_, at);
            at.memory.clear();
            scheme_ = OwnCopy<Integrator>(make_(*system_, at));
            scheme_->begin(at);
            search_.goOnWith(systems_->events(setting_), *system_, at);
        } catch (const InvalidScene&) {
            return Outcome::refused;
        }
        hasSwitched_ = true;
        switches_.push_back(
            {of.event, met.isUpwards, 1, at, of.spec.parameter, of.spec.value.value, system_});
        return Outcome::converged;
    }

    std::shared_ptr<const SwitchableSystems> systems_;
    MakeFrom make_;
    OwnCopy<Integrator> first_, scheme_;  ///< of the first setting, of the present one
    Setting setting_;
    EventSearch firstSearch_, search_;
    double h_;
    std::shared_ptr<const System> system_;  ///< of the present setting; null: the first
    bool hasSwitched_ = false;
    State before_;  ///< of the last step
    std::vector<MetEvent> met_;
    std::vector<Piece> pieces_;
    std::vector<double> measured_;  ///< of the last piece
    std::vector<ParameterSwitch> switches_;
    std::vector<Impact> impacts_;
};

/// A value of the model with the one at the pointer replaced.
void replaceIn(Value& value, const std::vector<std::string>& tokens, std::size_t next, double number) {
    if (next == tokens.size()) {
        value = number;
        return;
    }
    if (Value* const member = value.isObject() ? value.find(tokens[next]) : nullptr)
        replaceIn(*member, tokens, next + 1, number);
}

}  // namespace

SwitchableSystems::SwitchableSystems(const Scene& scene) {
    scene_.model = scene.model;
    scene_.events = scene.events;
    for (std::size_t i = 0; i < scene.events.size(); ++i) {
        const EventSpec& event = scene.events[i];
        if (event.action != EventSpec::Action::change) continue;
        const auto known = std::find(parameters_.begin(), parameters_.end(), event.parameter);
        all_.push_back({i, event, static_cast<std::size_t>(known - parameters_.begin())});
        if (known == parameters_.end()) parameters_.push_back(event.parameter);
    }
    std::erase_if(scene_.events,
                  [](const EventSpec& event) { return event.action != EventSpec::Action::reflect; });
}

std::vector<EventSpec> SwitchableSystems::events(const Setting& setting) const {
    std::vector<EventSpec> events;
    for (const Switch& each : all_) events.push_back(withSetting(each.spec, setting));
    return events;
}

EventSpec SwitchableSystems::withSetting(EventSpec event, const Setting& setting) const {
    for (std::size_t k = 0; k < parameters_.size(); ++k)
        if (setting[k]) event.setParameter(parameters_[k], *setting[k]);
    return event;
}

std::shared_ptr<const System> SwitchableSystems::system(const Setting& setting) const {
    Scene scene = scene_;
    for (EventSpec& event : scene.events) event = withSetting(event, setting);
    for (const ModelParameter& each : parametersOf(scene_))
        for (std::size_t k = 0; k < parameters_.size(); ++k) {
            if (each.name != parameters_[k] || !setting[k]) continue;
            const auto tokens = splitPointer(each.pointer);
            for (auto& [key, value] : scene.model.keys)
                if (key == (*tokens)[1]) replaceIn(value, *tokens, 2, *setting[k]);
        }
    return std::make_shared<const System>(makeSystem(scene));
}

std::unique_ptr<Integrator> makeSwitchedStep(std::shared_ptr<const SwitchableSystems> systems,
                                             const System& first, const State& start, MakeFrom make) {
    auto scheme = make(first, start);
    if (scheme->grid() == TimeGrid::free)
        throw InvalidScene("/space/type",
                           "chooses its own times, and cannot end a step where an event switches a parameter",
                           "a scheme with a given step, or with a tolerance");
    return std::make_unique<SwitchedStep>(std::move(systems), first, std::move(make), std::move(scheme));
}

}  // namespace extremal
