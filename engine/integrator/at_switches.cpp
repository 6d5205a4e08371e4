// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/at_switches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "engine/integrator/crossing.hpp"
#include "engine/integrator/switch_values.hpp"

namespace extremal {
namespace {

constexpr int mostSwitches = 1000, mostShortPieces = 50, mostStuckSteps = 1000;
constexpr double shortPiece = 1e-9;     ///< of a step
constexpr std::size_t mostSides = 256;  ///< that are kept
constexpr int mostSidesMade = 2000;     ///< in a run: each takes the time of some hundred steps
constexpr double landingRoundOff = std::numeric_limits<double>::epsilon();

using Cells = typed::Branches::Cells;

/// The scheme on one side of the switches.
struct Side {
    Mechanics<double> mechanics;
    std::unique_ptr<Integrator> integrator;
};

/// A switch that ends a step, and the limit of its cell that is passed.
struct Limit {
    std::size_t k;
    bool isUpper;
    double place;
    double tau;  ///< of the step that was tried
};

/// What a variation takes up where the branch is exchanged.
struct Kick {
    Eigen::VectorXd jump, slope;  ///< (f+ - f-) / (ds/dt)-, ds/dx
};

/// A part of the last step.
struct Piece {
    double from, to;
    Integrator* integrator;
    std::unique_ptr<Integrator> own = {};  ///< a copy that it may refer to
    std::vector<Kick> kicksBefore = {};
};

class AtSwitches final : public Integrator {
public:
    AtSwitches(const System& system, MakeIntegrator make, std::shared_ptr<const typed::Branches> branches,
               std::unique_ptr<Integrator> plain)
        : system_(system), make_(std::move(make)), values_(std::move(branches)), plain_(std::move(plain)) {}

    TimeGrid grid() const override { return plain_->grid(); }
    double stepSize() const override { return plain_->stepSize(); }
    void setStep(double h) override {
        plain_->setStep(h);
        forget();
    }
    std::vector<MemoryPart> memoryParts() const override { return plain_->memoryParts(); }
    void begin(State& state) override {
        plain_->begin(state);
        forget();
    }
    std::span<const Quantity> quantities() const override { return plain_->quantities(); }
    void measure(const State& state, double* values) const override {
        (pieces_.empty() ? plain_.get() : pieces_.back().integrator)->measure(state, values);
    }
    double periodsPerStep() const override { return plain_->periodsPerStep(); }
    std::string about() const override { return plain_->about(); }
    std::size_t tangentSize() const override { return plain_->tangentSize(); }
    std::string tangentProblem() const override { return plain_->tangentProblem(); }

    StepReport advance(State& state, double until) override;
    void denseOutput(double tau, std::span<double> x) const override;
    bool applyTangent(std::span<double> W) override;
    std::unique_ptr<Integrator> clone() const override;
    bool checkpoint(Archive& archive) override;

private:
    bool isFixed() const { return grid() == TimeGrid::fixed; }
    void forget() {
        pieces_.clear();
        isContinued_ = false;
        stuckSteps_ = sidesMade_ = 0;
        wasPlain_ = false;
        sides_.clear();
        side_ = nullptr;
    }
    Side& sideOf(const Cells& cells);
    void enter(const Cells& cells);
    /// Decides the cells of a state that is not where the last step ended.
    void settle(const State& state, double time);
    /// The cell of a switch on a limit, by the direction of the motion.
    double cellAt(std::size_t k, double limit, const State& state, double time);
    StepReport plainStep(State& state, double until);
    StepReport attempt(State& state, double until);
    /// One piece; false where the motion cannot be followed in this way.
    bool piece(State& state, double until, StepReport& report);
    std::vector<Limit> limitsPassed(const State& before, const State& after, bool& isInside);
    enum class Landing { onLimit, before, failed };
    Landing land(State& state, const State& before, double length, const Limit& limit, StepReport& report);
    void exchange(const Limit& limit, const State& state, double time);
    double argument(std::size_t k, double t, const double* x) {
        return values_.at(k, t, x, side_->mechanics, cells_);
    }

    System system_;
    MakeIntegrator make_;
    SwitchValues values_;
    std::unique_ptr<Integrator> plain_;
    std::map<Cells, Side> sides_;
    Side* side_ = nullptr;  ///< of the present cells
    Cells cells_;
    std::vector<double> noise_;  ///< of the arguments, near the last switch
    bool isContinued_ = false;
    double endTime_ = 0;
    std::vector<double> end_;  ///< state at the end of the last step
    std::vector<Piece> pieces_;
    std::vector<Kick> kicks_;  ///< at the start of the next piece
    int shortPieces_ = 0, stuckSteps_ = 0, sidesMade_ = 0;
    bool wasPlain_ = false;  ///< the last step
    StepSamples samples_;
    CrossingFinder finder_;
};

Side& AtSwitches::sideOf(const Cells& cells) {
    const auto found = sides_.find(cells);
    if (found != sides_.end()) return found->second;
    if (++sidesMade_ > mostSidesMade) throw std::length_error("too many branches");
    Side side;
    side.mechanics = values_.branches().in(cells);
    System system = system_;
    system.parts.set(side.mechanics);
    side.integrator = make_(system);
    if (isFixed()) side.integrator->setStep(plain_->stepSize());
    return sides_.emplace(cells, std::move(side)).first->second;
}

void AtSwitches::enter(const Cells& cells) {
    cells_ = cells;
    side_ = &sideOf(cells);
}

double AtSwitches::cellAt(std::size_t k, double limit, const State& state, double time) {
    const double ahead = time < 0 ? -1 : 1, noise = noise_[k];
    double rate = ahead * values_.rate(k, state.t, state.x.data(), time, side_->mechanics, cells_);
    if (!(std::abs(rate * time) > noise))
        rate = ahead * values_.laterRate(k, state.t, state.x.data(), time, side_->mechanics, cells_);
    const auto [low, high] = values_.branches().limits(k, cells_[k]);
    if (!(std::abs(rate * time) > noise))
        return values_.branches().cellOf(k, argument(k, state.t, state.x.data()));
    if (low == high) return rate > 0 ? 1 : -1;
    if (limit == low) return rate > 0 ? cells_[k] : values_.branches().next(k, cells_[k], false);
    return rate < 0 ? cells_[k] : values_.branches().next(k, cells_[k], true);
}

void AtSwitches::settle(const State& state, double time) {
    const typed::Branches& branches = values_.branches();
    noise_.assign(branches.size(), 0);
    Cells cells(branches.size(), 1);
    const Mechanics<double>& asTyped = system_.mechanics();
    for (std::size_t k = 0; k < branches.size(); ++k)
        cells[k] = branches.cellOf(k, values_.at(k, state.t, state.x.data(), asTyped, cells));
    enter(cells);
    for (std::size_t k = 0; k < branches.size(); ++k) {
        noise_[k] = values_.noise(k, state.t, state.x.data(), side_->mechanics, cells_);
        const double s = argument(k, state.t, state.x.data());
        if (!branches.moves(k)) continue;
        const auto [low, high] = branches.limits(k, cells_[k]);
        for (const double limit : {low, high}) {
            if (!(std::abs(s - limit) <= noise_[k])) continue;
            Cells decided = cells_;
            decided[k] = cellAt(k, limit, state, time);
            if (decided != cells_) enter(decided);
            break;
        }
    }
    kicks_.clear();
    shortPieces_ = 0;
}

StepReport AtSwitches::advance(State& state, double until) {
    if (state.memory.empty() && !memoryParts().empty()) begin(state);
    pieces_.clear();
    if (sidesMade_ > mostSidesMade) return plainStep(state, until);
    const bool goesOn = isContinued_ && endTime_ == state.t && end_ == state.x;
    isContinued_ = false;
    if (sides_.size() > mostSides) {
        sides_.clear();
        if (goesOn) enter(Cells(cells_));
    }
    StepReport report;
    const State before = state;
    bool isFollowed = false;
    try {
        if (!goesOn) settle(state, until - state.t);
        if (isFixed()) {
            report = attempt(state, until);
            isFollowed = report.outcome == Outcome::converged || report.outcome == Outcome::stopped;
        } else {
            isFollowed = piece(state, until, report);
        }
    } catch (const std::exception&) {
        isFollowed = false;  // a branch by itself has no Lagrangian that can be stepped
    }
    if (isFollowed) {
        wasPlain_ = false;
        if (report.outcome != Outcome::converged) return report;
        endTime_ = state.t;
        end_ = state.x;
        isContinued_ = true;
        const bool leadsOn = std::abs(state.t - before.t) >= shortPiece * std::abs(until - before.t);
        stuckSteps_ = leadsOn ? 0 : stuckSteps_ + 1;
        report.step = state.t - before.t;
        state.node = before.node + 1;
    } else {
        const Cost spent = report.cost;
        state = before;
        report = plainStep(state, until);
        report.cost += spent;
        ++stuckSteps_;
    }
    // An error control that finds no step across a limit could go on in steps that lead nowhere.
    if (!isFixed() && stuckSteps_ > mostStuckSteps) report.outcome = Outcome::stepBudget;
    if (report.outcome != Outcome::converged) state = before;
    return report;
}

StepReport AtSwitches::plainStep(State& state, double until) {
    pieces_.clear();
    kicks_.clear();
    plain_->setStop(stop());
    if (!std::exchange(wasPlain_, true)) plain_->begin(*std::make_unique<State>(state));
    const double from = state.t;
    const StepReport report = plain_->advance(state, until);
    if (report.outcome != Outcome::converged) return report;
    pieces_.push_back({from, state.t, plain_.get()});
    return report;
}

/// A step of a fixed grid; `diverged` where it cannot be followed.
StepReport AtSwitches::attempt(State& state, double until) {
    StepReport whole;
    for (int switches = 0; switches < mostSwitches; ++switches) {
        StepReport part;
        const bool isFollowed = piece(state, until, part);
        whole.cost += part.cost;
        whole.residual = std::max(whole.residual, part.residual);
        whole.outcome = isFollowed ? part.outcome : Outcome::diverged;
        if (whole.outcome != Outcome::converged) return whole;
        if (std::abs(until - state.t) <= 2 * landingRoundOff * std::abs(until)) {
            state.t = until;
            return whole;
        }
    }
    whole.outcome = Outcome::diverged;
    return whole;
}

bool AtSwitches::piece(State& state, double until, StepReport& report) {
    const State before = state;
    if (!pieces_.empty() && pieces_.back().integrator != plain_.get() && !pieces_.back().own) {
        // Its integrator may be the one that goes on.
        pieces_.back().own = pieces_.back().integrator->clone();
        pieces_.back().integrator = pieces_.back().own.get();
    }
    for (int again = 0; again < 3; ++again) {
        state = before;
        side_->integrator->setStop(stop());
        const double whole = plain_->stepSize();
        if (isFixed()) {
            // On the nodes of the grid itself the step is that of the grid, to the last bit.
            const bool isWhole =
                pieces_.empty() && std::abs(until - before.t - whole) <=
                                       8 * landingRoundOff * (std::abs(until) + std::abs(whole));
            side_->integrator->setStep(isWhole ? whole : until - before.t);
        }
        const StepReport trial = side_->integrator->advance(state, until);
        report.outcome = trial.outcome;
        report.cost += trial.cost;
        report.residual = trial.residual;
        if (trial.outcome == Outcome::stopped) return true;
        if (trial.outcome != Outcome::converged) return false;
        bool isInside = true;
        const std::vector<Limit> passed = limitsPassed(before, state, isInside);
        const double length = state.t - before.t;
        if (passed.empty() && isInside) {
            shortPieces_ = 0;
            pieces_.push_back(
                {before.t, state.t, side_->integrator.get(), nullptr, std::exchange(kicks_, {})});
            return true;
        }
        if (passed.empty()) {
            // Either it left a state of rest on a limit, or it is pressed against the limit.
            Cells cells = cells_;
            for (std::size_t k = 0; k < cells.size(); ++k)
                if (const auto [low, high] = values_.branches().limits(k, cells[k]); low == high)
                    cells[k] = values_.branches().cellOf(k, argument(k, state.t, state.x.data()));
            if (cells == cells_) return false;
            enter(cells);
            continue;
        }
        const Landing landing = land(state, before, length, passed.front(), report);
        if (landing == Landing::failed) return false;
        if (report.outcome != Outcome::converged) return true;
        pieces_.push_back({before.t, state.t, side_->integrator.get(), nullptr, std::exchange(kicks_, {})});
        shortPieces_ = std::abs(state.t - before.t) < shortPiece * std::abs(length) ? shortPieces_ + 1 : 0;
        if (shortPieces_ > mostShortPieces) return false;
        // An error control may end its step before the limit.
        if (landing == Landing::onLimit) exchange(passed.front(), state, length);
        return true;
    }
    return false;
}

/// The first limit that the step passes, if it passes one. `isInside`: at its end it is in its cells.
std::vector<Limit> AtSwitches::limitsPassed(const State& before, const State& after, bool& isInside) {
    const typed::Branches& branches = values_.branches();
    const double length = after.t - before.t;
    samples_.begin(*side_->integrator, before.x.size());
    std::vector<Limit> first;
    for (std::size_t k = 0; k < branches.size(); ++k) {
        if (!branches.moves(k)) continue;
        const auto [low, high] = branches.limits(k, cells_[k]);
        const double start = argument(k, before.t, before.x.data()),
                     end = argument(k, after.t, after.x.data());
        if (low == high) {
            isInside = isInside && std::abs(end - low) <= noise_[k];
            continue;
        }
        for (const bool isUpper : {false, true}) {
            const double place = isUpper ? high : low, sign = isUpper ? -1 : 1;
            if (!std::isfinite(place)) continue;
            const auto distance = [&](double tau) {
                const double t = before.t + tau * length;
                return sign *
                       (argument(k, t, branches.isOfTime(k) ? before.x.data() : samples_.at(tau)) - place);
            };
            const double noise = noise_[k];
            const bool isAtRest = std::abs(start - place) <= noise && std::abs(end - place) <= noise &&
                                  std::abs(distance(0.5)) <= noise;
            if (isAtRest) continue;
            // At the start it is inside, or on the limit to round-off.
            const double least = std::max(noise, std::numeric_limits<double>::min());
            const auto& found = finder_.find(std::max(sign * (start - place), least), sign * (end - place),
                                             samples_.places(), distance, noise);
            if (!found.empty()) {
                if (first.empty() || found.front().tau < first.front().tau)
                    first.assign(1, {k, isUpper, place, found.front().tau});
            } else if (!(sign * (end - place) >= -noise)) {
                isInside = false;
            }
        }
    }
    return first;
}

/// Newton's method in a bracket for the length of the step at whose end the argument is on the limit.
AtSwitches::Landing AtSwitches::land(State& state, const State& before, double length, const Limit& limit,
                                     StepReport& report) {
    const double sign = limit.isUpper ? -1 : 1;
    double low = 0, high = 1, part = limit.tau;
    for (int iteration = 0; iteration < 100; ++iteration) {
        state = before;
        const double until = before.t + part * length;
        if (until == before.t) return Landing::failed;
        State forgotten = before;
        side_->integrator->begin(forgotten);
        if (isFixed()) side_->integrator->setStep(until - before.t);
        const StepReport step = side_->integrator->advance(state, until);
        report.cost += step.cost;
        report.outcome = step.outcome;
        report.residual = step.residual;
        if (step.outcome == Outcome::stopped) return Landing::onLimit;
        if (step.outcome != Outcome::converged) return Landing::failed;
        if (state.t != until) return Landing::before;
        const double distance = sign * (argument(limit.k, state.t, state.x.data()) - limit.place);
        const double rate =
            sign * length * values_.rate(limit.k, state.t, state.x.data(), length, side_->mechanics, cells_);
        if (!std::isfinite(distance)) return Landing::failed;
        (distance > 0 ? low : high) = part;
        double next = part - distance / rate;
        const double finest =
            2 * landingRoundOff * std::max(std::abs(until), std::abs(length)) / std::abs(length);
        if (distance == 0 || high - low <= finest || std::abs(next - part) <= finest / 2)
            return Landing::onLimit;
        if (!(next > low && next < high)) next = (low + high) / 2;
        part = next;
    }
    return Landing::failed;
}

void AtSwitches::exchange(const Limit& limit, const State& state, double time) {
    const typed::Branches& branches = values_.branches();
    const double* const x = state.x.data();
    for (std::size_t k = 0; k < branches.size(); ++k)
        noise_[k] = values_.noise(k, state.t, x, side_->mechanics, cells_);
    const Eigen::VectorXd flowBefore = values_.flow(state.t, x, side_->mechanics);
    Kick kick;
    if (tangentSize() > 0 && !branches.isOfTime(limit.k)) {
        kick.slope = values_.gradient(limit.k, state.t, x, side_->mechanics, cells_);
        kick.slope /= values_.rate(limit.k, state.t, x, time, side_->mechanics, cells_);
    }
    Cells cells = cells_;
    cells[limit.k] = branches.next(limit.k, cells[limit.k], limit.isUpper);
    enter(cells);
    // What contains this switch may have jumped, and others may be on a limit of theirs at the same place.
    for (std::size_t k = 0; k < branches.size(); ++k) {
        if (k == limit.k) continue;
        const double s = argument(k, state.t, x);
        const auto [low, high] = branches.limits(k, cells_[k]);
        cells = cells_;
        if (!branches.moves(k))
            cells[k] = branches.cellOf(k, s);
        else if (std::abs(s - low) <= noise_[k])
            cells[k] = cellAt(k, low, state, time);
        else if (std::abs(s - high) <= noise_[k])
            cells[k] = cellAt(k, high, state, time);
        else if (s < low || s > high)
            cells[k] = branches.cellOf(k, s);
        if (cells != cells_) enter(cells);
    }
    side_->integrator->begin(*std::make_unique<State>(state));
    if (kick.slope.size() == 0) return;
    kick.jump = values_.flow(state.t, x, side_->mechanics) - flowBefore;
    if (kick.jump.cwiseAbs().maxCoeff() > 0) kicks_.push_back(std::move(kick));
}

void AtSwitches::denseOutput(double tau, std::span<double> x) const {
    const double start = pieces_.front().from, end = pieces_.back().to, t = start + tau * (end - start);
    const auto isBefore = [&](const Piece& p) { return end > start ? p.to < t : p.to > t; };
    auto piece = std::find_if_not(pieces_.begin(), pieces_.end(), isBefore);
    if (piece == pieces_.end()) --piece;
    piece->integrator->denseOutput(std::clamp((t - piece->from) / (piece->to - piece->from), 0.0, 1.0), x);
}

bool AtSwitches::applyTangent(std::span<double> W) {
    const auto rows = static_cast<Eigen::Index>(tangentSize());
    Eigen::Map<Eigen::MatrixXd> columns(W.data(), rows, static_cast<Eigen::Index>(W.size()) / rows);
    for (const Piece& piece : pieces_) {
        for (const Kick& kick : piece.kicksBefore)
            columns += (kick.jump * (kick.slope.transpose() * columns)).eval();
        if (!piece.integrator->applyTangent(W)) return false;
    }
    return true;
}

std::unique_ptr<Integrator> AtSwitches::clone() const {
    auto copy = std::make_unique<AtSwitches>(system_, make_, values_.shared(), plain_->clone());
    copy->cells_ = cells_;
    copy->noise_ = noise_;
    copy->isContinued_ = isContinued_;
    copy->endTime_ = endTime_;
    copy->end_ = end_;
    copy->kicks_ = kicks_;
    copy->shortPieces_ = shortPieces_;
    copy->stuckSteps_ = stuckSteps_;
    copy->sidesMade_ = sidesMade_;
    copy->wasPlain_ = wasPlain_;
    if (side_)
        copy->side_ =
            &copy->sides_.emplace(cells_, Side{side_->mechanics, side_->integrator->clone()}).first->second;
    for (const Piece& p : pieces_) {
        Piece& mine = copy->pieces_.emplace_back(Piece{p.from, p.to, nullptr, nullptr, p.kicksBefore});
        if (side_ && p.integrator == side_->integrator.get())
            mine.integrator = copy->side_->integrator.get();
        else if (p.integrator == plain_.get())
            mine.integrator = copy->plain_.get();
        else
            mine.integrator = (mine.own = p.integrator->clone()).get();
    }
    return copy;
}

bool AtSwitches::checkpoint(Archive& archive) {
    bool hasSide = side_ != nullptr;
    archive(hasSide, cells_, noise_, isContinued_, endTime_, end_, shortPieces_, stuckSteps_, sidesMade_,
            wasPlain_);
    if (archive.isReading() && hasSide) enter(Cells(cells_));
    // A variation that has not yet taken up a kick cannot go on from here.
    const bool isWhole = plain_->checkpoint(archive) && kicks_.empty();
    return (!hasSide || side_->integrator->checkpoint(archive)) && isWhole;
}

}  // namespace

std::unique_ptr<Integrator> landingOnSwitches(const System& system, const MakeIntegrator& make) {
    std::unique_ptr<Integrator> plain = make(system);
    const Mechanical* const mechanics = system.parts.find<Mechanical>();
    auto branches = mechanics ? typed::branchesOf(*mechanics) : nullptr;
    if (!branches || plain->grid() == TimeGrid::free) return plain;
    return std::make_unique<AtSwitches>(system, make, std::move(branches), std::move(plain));
}

}  // namespace extremal
