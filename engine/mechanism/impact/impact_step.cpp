// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/impact/impact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/mechanism/impact/contact_time.hpp"
#include "engine/mechanism/impact/impact_match.hpp"
#include "engine/mechanism/impact/impact_rhythm.hpp"
#include "engine/mechanism/impact/impact_variation.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/own_copy.hpp"
#include "engine/mechanism/said_of_forces.hpp"
#include "engine/mechanism/impact/wall_gaps.hpp"
#include "engine/mechanism/impact/wall_rest.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {
namespace {

constexpr double unitRoundOff = std::numeric_limits<double>::epsilon();

class ImpactStep final : public Integrator {
public:
    ImpactStep(const Parts& parts, MakeOfParts make, int places, ImpactLaw law)
        : mechanism_(parts),
          gaps_(*parts.find<Wall>(), mechanism_.mechanics()),
          variation_(parts),
          said_(parts, mechanism_.dimension()),
          inner_(make(parts)),
          rest_(parts, make),
          places_(places),
          law_(law) {
        h_ = inner_->stepSize();
        const auto n = static_cast<std::size_t>(gaps_.count());
        const auto d = static_cast<std::size_t>(mechanism_.dimension());
        rhythm_.resize(n);
        isGrazed_.assign(n, 0);
        isLeaving_.assign(n, 0);
        openUntil_.assign(n, 0);
        velocity_.resize(d);
        values_.resize(inner_->quantities().size());
        sums_.resize(values_.size());
        saysForces_ = values_.size() == said_.quantities().size() &&
                      inner_->quantities()[SaidOfForces::work].name == "work";
    }
    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        scheme().setStep(h);
    }
    std::vector<MemoryPart> memoryParts() const override { return inner_->memoryParts(); }
    void begin(State& state) override {
        inner_->begin(state);
        std::fill(rhythm_.begin(), rhythm_.end(), ImpactRhythm{});
        gaps_.fastest = 0;
        rest_.leave();
        liftedAt_ = std::numeric_limits<double>::quiet_NaN();
        std::fill(isGrazed_.begin(), isGrazed_.end(), false);
        std::fill(isLeaving_.begin(), isLeaving_.end(), false);
    }

    StepReport advance(State& state, double until) override {
        scheme().setStop(stop());
        scheme().setStep(h_);
        pieces_.clear();
        impacts_.clear();
        contacts_.clear();
        hasSettled_ = false;
        std::fill(openUntil_.begin(), openUntil_.end(), 0.0);
        before_ = state;
        const std::vector<int> restedOn = rest_.walls();
        findReturning(state);
        const bool goesIntoWall = fastestApproach(state) >= 0;
        for (int k = 0; k < gaps_.count(); ++k)
            if (gaps_[k] > gaps_.roundOff(k, state.x.data())) isGrazed_[static_cast<std::size_t>(k)] = false;
        StepReport report;
        if (!goesIntoWall && returning_.empty()) {
            report = scheme().advance(state, until);
            if (report.outcome != Outcome::converged) return report;
            if (!lift(before_, h_) && !firstCrossing(before_, h_) && !isInside(state)) return report;
            state = before_;
        }
        report = advanceWithImpacts(state, until, report);
        if (report.outcome != Outcome::converged && restedOn != rest_.walls()) rest_.hold(restedOn);
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        for (const Piece& piece : pieces_)
            if (tau <= piece.to) {
                const double length = piece.to - piece.from;
                piece.step->denseOutput(length > 0 ? std::max(0.0, (tau - piece.from) / length) : 1, x);
                return;
            }
        scheme().denseOutput(tau, x);
    }

    std::size_t tangentSize() const override {
        return law_ == ImpactLaw::variational ? 0 : inner_->tangentSize();
    }
    std::string tangentProblem() const override {
        return law_ == ImpactLaw::variational
                   ? "the tangent map through impacts with equal discrete energies is not known: with "
                     "\"impact\": \"energy\" it is"
                   : inner_->tangentProblem();
    }
    /// Unknown where a step begins with an impact, or several happen at one time, and where bodies rest.
    bool applyTangent(std::span<double> W) override {
        if (rest_.isOne() || hasSettled_) return false;
        if (pieces_.empty()) return impacts_.empty() && inner_->applyTangent(W);
        std::vector<VariedStep*> steps;
        for (Piece& piece : pieces_) steps.push_back(dynamic_cast<VariedStep*>(&*piece.step));
        return variation_.throughImpacts(steps, contacts_, end_, W);
    }

    std::span<const Quantity> quantities() const override { return inner_->quantities(); }
    void measure(const State& state, double* values) const override {
        if (pieces_.empty())
            scheme().measure(state, values);
        else
            std::copy(sums_.begin(), sums_.end(), values);
    }
    std::span<const Impact> impacts() const override { return impacts_; }
    std::string about() const override { return inner_->about(); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ImpactStep>(*this); }
    bool checkpoint(Archive& archive) override {
        std::vector<int> walls = rest_.walls();
        archive(rhythm_, isGrazed_, isLeaving_, liftedAt_, gaps_.fastest, walls);
        if (archive.isReading()) rest_.hold(walls);
        return scheme().checkpoint(archive);
    }

private:
    /// A part of the last step between impacts, as parts of the step.
    struct Piece {
        double from, to;
        OwnCopy<Integrator> step;
    };
    int dimension() const { return mechanism_.dimension(); }
    double energyAt(const State& s) const {
        const auto& L = mechanism_.mechanics();
        return L.energy(L.model.get(), s.t, s.x.data(), s.x.data() + dimension());
    }
    Integrator& scheme() { return rest_.isOne() ? rest_.scheme() : *inner_; }
    const Integrator& scheme() const { return rest_.isOne() ? rest_.scheme() : *inner_; }
    double restitution(int wall) const { return gaps_.wall().restitution[static_cast<std::size_t>(wall)]; }
    /// Whether a body rests on a wall, or is just leaving it.
    bool isHeld(int wall) const { return rest_.holds(wall) || isLeaving_[static_cast<std::size_t>(wall)]; }
    /// Whether a wall is left alone: touched without an impact, rested on, or just left.
    bool isPassedBy(int wall) const { return isGrazed_[static_cast<std::size_t>(wall)] || isHeld(wall); }
    /// A body leaves a wall with the third power of the time, within the error of a step: it has left it at a
    /// node outside, and comes back where it goes in at one.
    void findReturning(const State& s) {
        returning_.clear();
        if (std::find(isLeaving_.begin(), isLeaving_.end(), true) == isLeaving_.end()) return;
        gaps_.find(s.t, s.x.data());
        for (int k = 0; k < gaps_.count(); ++k) {
            auto& leaves = isLeaving_[static_cast<std::size_t>(k)];
            if (!leaves) continue;
            const auto r = gaps_.speed(k, s);
            const bool isOutside = gaps_[k] > gaps_.roundOff(k, s.x.data());
            if (!isOutside && r && r->value * ahead() < 0) returning_.push_back(k);
            leaves = !isOutside && returning_.empty();
        }
    }
    double ahead() const { return h_ < 0 ? -1 : 1; }

    /// The wall that a state is on and goes into, fastest; -1: it goes into none of them. Finds the gaps.
    int fastestApproach(const State& s) {
        gaps_.find(s.t, s.x.data());
        int found = -1;
        double fastest = 0;
        for (int k = 0; k < gaps_.count(); ++k) {
            if (isHeld(k) || !(gaps_[k] <= gaps_.roundOff(k, s.x.data()))) continue;
            const auto r = gaps_.speed(k, s);
            if (!r || r->isGraze || !(r->value * ahead() < fastest)) continue;
            fastest = r->value * ahead();
            found = k;
        }
        return found;
    }

    /// Whether a state is inside a wall that was touched without an impact: pressed there.
    bool isInside(const State& s) {
        gaps_.find(s.t, s.x.data());
        for (int k = 0; k < gaps_.count(); ++k)
            if (!isHeld(k) && gaps_[k] < -gaps_.roundOff(k, s.x.data())) return true;
        return false;
    }

    std::optional<WallCrossing> lift(const State& start, double h) {
        return rest_.isOne() ? rest_.lift(start, h, places_) : std::nullopt;
    }
    /// Takes the step from `start` at whose end the wall begins to pull.
    Outcome goToLift(const State& start, const WallCrossing& found, double h, StepReport& report) {
        trial_ = start;
        return goToEdge(
            found, [&](double part) { return tryStep(start, part, h, report); },
            [&] { return rest_.push(trial_.t, trial_.x.data()) >= 0; });
    }

    /// Whether what is left of impacts that accumulate in a time is nothing beside a step, or beside the
    /// rounding of the gap, which their heights would soon be.
    bool isNothing(const Impact& last, double time, const State& s) const {
        const double height = std::abs(last.speedAfter * time);
        return std::abs(time) < 1e-8 * std::abs(h_) || height < 1000 * gaps_.roundOff(last.wall, s.x.data());
    }

    /// The walls that impacts since `known` leave a body on before `until`, and those that it returns to.
    std::vector<int> accumulatedOn(std::size_t known, double until, const State& s, bool areMany) {
        std::vector<int> walls = std::exchange(returning_, {});
        for (std::size_t i = known; i < impacts_.size(); ++i) {
            const auto end = rhythm_[static_cast<std::size_t>(impacts_[i].wall)].end();
            if (!end || !((until - *end) * ahead() >= 0)) continue;
            if (areMany || isNothing(impacts_[i], *end - s.t, s)) walls.push_back(impacts_[i].wall);
        }
        return walls;
    }

    /// Lets bodies rest on the walls that they touch at a state without moving into or out of them;
    /// `accumulated`: those on which impacts have become so many that their speeds are nothing.
    bool settle(State& s, const std::vector<int>& accumulated) {
        if (liftedAt_ == s.t) return false;
        gaps_.find(s.t, s.x.data());
        std::vector<int> touched = accumulated;
        for (int k = 0; k < gaps_.count(); ++k) {
            if (std::find(touched.begin(), touched.end(), k) != touched.end()) continue;
            const double rounding =
                gaps_.roundOff(k, s.x.data()) + 4 * unitRoundOff * gaps_.fastest * std::abs(h_);
            const auto r = gaps_.speed(k, s);
            if (gaps_[k] <= rounding && r && (r->isGraze || r->value == 0)) touched.push_back(k);
        }
        std::sort(touched.begin(), touched.end());
        if (touched.empty() || touched == rest_.walls()) return false;
        const State before = s;
        const std::vector<int> known = rest_.walls();
        if (!rest_.settle(s, touched, h_)) return false;
        scheme().setStop(stop());
        const double loss = energyAt(before) - energyAt(s);
        if (saysForces_) sums_[SaidOfForces::work] -= loss;
        for (const int k : rest_.walls())
            if (std::find(known.begin(), known.end(), k) == known.end())
                impacts_.push_back({k, rhythm_[static_cast<std::size_t>(k)].endNear(s.t, 1e-3 * std::abs(h_)),
                                    0, gaps_.speed(k, before)->value, 0, loss});
        hasSettled_ = true;
        return true;
    }

    /// A body leaves the wall that pushes least, and stays on the others.
    void letGo(State& s) {
        const int lifted = rest_.weakest(s);
        std::vector<int> others = rest_.walls();
        std::erase(others, lifted);
        rest_.leave();
        (void)rest_.settle(s, others, h_);
        scheme().setStop(stop());
        impacts_.push_back({lifted, s.t, 0, 0, 0, 0});
        liftedAt_ = s.t;
        isLeaving_[static_cast<std::size_t>(lifted)] = true;
    }

    /// The first gap that closes inside the step just taken from `start`, of length h.
    std::optional<WallCrossing> firstCrossing(const State& start, double h) {
        return gaps_.firstCrossing(scheme(), start, h, places_, [this](int wall, double tau) {
            return isPassedBy(wall) || tau <= openUntil_[static_cast<std::size_t>(wall)];
        });
    }

    /// The step of the scheme of the length alpha h from `start`, in `trial_`.
    Outcome tryStep(const State& start, double alpha, double h, StepReport& report) {
        trial_ = start;
        scheme().setStep(alpha * h);
        const StepReport step = scheme().advance(trial_, start.t + alpha * h);
        report.cost += step.cost;
        report.residual = step.residual;
        trial_.node = start.node;
        return step.outcome;
    }

    /// alpha of the contact, whose step is then the last one taken; NaN where the gap of the scheme's own
    /// steps stays open; nothing where a step has failed, as the report says.
    std::optional<double> contact(const State& start, const WallCrossing& crossing, double h,
                                  StepReport& report) {
        return contactTime(crossing, h, [&](double alpha) -> std::optional<GapAtEnd> {
            if (report.outcome = tryStep(start, alpha, h, report); report.outcome != Outcome::converged)
                return {};
            gaps_.find(trial_.t, trial_.x.data());
            if (const auto r = gaps_.speed(crossing.wall, trial_))
                return GapAtEnd{gaps_[crossing.wall], r->value, gaps_.terms(crossing.wall, trial_.x.data())};
            report.outcome = Outcome::singular;
            return {};
        });
    }

    /// One impulse after the other while a wall at the state is approached. False where there is none that
    /// ends it.
    bool strikeAll(State& s) {
        const int most = 100 * gaps_.count() * gaps_.count();
        for (int count = 0; count < most; ++count) {
            const int k = fastestApproach(s);
            if (k < 0) return true;
            const double energy = energyAt(s), before = gaps_.speed(k, s)->value,
                         after = -restitution(k) * before;
            contacts_.push_back({pieces_.size(), k, s});
            const auto impulse = mechanism_.strike(s.t, s.x.data(), s.x.data() + dimension(), gaps_.normal(k),
                                                   after - gaps_.byTime(k));
            if (!impulse) return false;
            impacts_.push_back({k, s.t, *impulse, before, after, energy - energyAt(s)});
            if (saysForces_) sayImpact(impacts_.back(), s);
            if (impacts_.size() < 2 || impacts_[impacts_.size() - 2].wall != k ||
                impacts_[impacts_.size() - 2].t != s.t)
                rhythm_[static_cast<std::size_t>(k)].add(s.t);
        }
        return false;
    }

    /// The discrete energy of what follows `s` up to `until`, or up to the next contact before it; nothing
    /// where there is no such step, as the report says.
    std::optional<double> energyAhead(const State& s, double until, StepReport& report) {
        const double rest = until - s.t;
        if (report.outcome = tryStep(s, 1, rest, report); report.outcome != Outcome::converged) return {};
        if (const auto crossing = firstCrossing(s, rest); crossing && crossing->from < crossing->to) {
            const auto alpha = contact(s, *crossing, rest, report);
            if (!alpha) return {};
            if (!std::isfinite(*alpha)) {  // only the dense output touches the wall
                report.outcome = tryStep(s, 1, rest, report);
                if (report.outcome != Outcome::converged) return {};
            }
        }
        return discreteEnergy();
    }
    double discreteEnergy() { return dynamic_cast<VariedStep&>(scheme()).discreteEnergy(); }

    /// Gives `s`, just after the last impact, the speed for which the discrete energies of the parts before
    /// and after the contact are equal.
    Outcome matchEnergies(State& s, double until, StepReport& report) {
        Impact& impact = impacts_.back();
        const State& before = contacts_.back().before;
        const auto strike = [&](double speed) {
            s = before;
            gaps_.find(s.t, s.x.data());
            const auto impulse =
                mechanism_.strike(s.t, s.x.data(), s.x.data() + dimension(), gaps_.normal(impact.wall),
                                  speed - gaps_.byTime(impact.wall));
            if (!impulse) return false;
            impact.impulse = *impulse;
            impact.speedAfter = speed;
            return true;
        };
        const auto energy = [&] { return energyAhead(s, until, report); };
        const Outcome outcome = matchEnergiesAtContact(impact, energyBefore_, strike, energy, report.outcome);
        impact.energyLoss = energyAt(before) - energyAt(s);
        return outcome;
    }

    /// Adds an impact to what is said of the step; the gaps are known at `s`.
    void sayImpact(const Impact& impact, const State& s) {
        sums_[SaidOfForces::work] -= impact.energyLoss;
        sums_[SaidOfForces::expansion] += 2 * std::log(restitution(impact.wall));
        for (int i = 0; i < dimension(); ++i)
            velocity_[static_cast<std::size_t>(i)] = impact.impulse * gaps_.normal(impact.wall)[i];
        said_.addImpulse(s.t, s.x.data(), velocity_.data(), sums_.data());
    }

    void keepPiece(double from, double to, const State& end) {
        if (!values_.empty()) {
            scheme().measure(end, values_.data());
            for (std::size_t i = 0; i < values_.size(); ++i) sums_[i] += values_[i];
        }
        if (law_ == ImpactLaw::variational) energyBefore_ = discreteEnergy();
        pieces_.push_back({from, to, OwnCopy<Integrator>(scheme().clone())});
    }

    /// From `state` to the node at `until` through all impacts before it.
    StepReport advanceWithImpacts(State& state, double until, StepReport report) {
        constexpr int mostImpacts = 1000;
        report.outcome = Outcome::converged;
        report.step = h_;
        std::fill(sums_.begin(), sums_.end(), 0.0);
        const double start = state.t;
        State s = state;
        double from = 0;
        const auto fail = [&](Outcome outcome, double at) {
            report.outcome = outcome;
            if (outcome == Outcome::accumulation) report.step = at - start;
            return report;
        };
        for (int count = 0;; ++count) {
            if (count == mostImpacts) return fail(Outcome::accumulation, s.t);
            const std::size_t known = impacts_.size();
            if (fastestApproach(s) >= 0) rest_.leave();
            if (!strikeAll(s)) return fail(Outcome::accumulation, s.t);
            const std::vector<int> accumulated = accumulatedOn(known, until, s, count > mostImpacts / 2);
            if (!settle(s, accumulated) && !accumulated.empty()) return fail(Outcome::accumulation, s.t);
            const double rest = until - s.t;
            if (!(rest * ahead() > 4 * unitRoundOff * std::abs(until))) {
                s.t = until;
                break;
            }
            if (law_ == ImpactLaw::variational && impacts_.size() > known && !pieces_.empty())
                if (const Outcome outcome = matchEnergies(s, until, report); outcome != Outcome::converged)
                    return fail(outcome, s.t);
            if (const Outcome outcome = tryStep(s, 1, rest, report); outcome != Outcome::converged)
                return fail(outcome, s.t);
            std::optional<WallCrossing> crossing = firstCrossing(s, rest);
            if (const auto lifted = lift(s, rest); lifted && (!crossing || lifted->to <= crossing->from)) {
                if (const Outcome outcome = goToLift(s, *lifted, rest, report); outcome != Outcome::converged)
                    return fail(outcome, s.t);
                const double to = (trial_.t - start) / (until - start);
                if (to > from) keepPiece(from, to, trial_);
                from = to;
                s = trial_;
                letGo(s);
                continue;
            }
            double alpha = std::numeric_limits<double>::quiet_NaN();
            if (crossing && crossing->from >= crossing->to) {
                if (settle(s, {crossing->wall})) continue;
                return fail(Outcome::accumulation, s.t);
            }
            if (crossing) {
                const auto found = contact(s, *crossing, rest, report);
                if (!found) return fail(report.outcome, s.t);
                alpha = *found;
                if (!std::isfinite(alpha)) {  // only the dense output touches the wall
                    openUntil_[static_cast<std::size_t>(crossing->wall)] = crossing->to;
                    continue;
                }
            }
            if (!crossing) {
                if (isInside(trial_)) return fail(Outcome::accumulation, s.t);
                trial_.t = until;
                keepPiece(from, 1, trial_);
                s = trial_;
                break;
            }
            std::fill(openUntil_.begin(), openUntil_.end(), 0.0);
            const double to = (trial_.t - start) / (until - start);
            keepPiece(from, to, trial_);
            from = to;
            s = trial_;
            gaps_.find(s.t, s.x.data());
            if (const auto r = gaps_.speed(crossing->wall, s); r && r->isGraze)
                isGrazed_[static_cast<std::size_t>(crossing->wall)] = true;
        }
        scheme().setStep(h_);
        s.node = state.node + 1;
        state = s;
        end_ = s;
        return report;
    }

    Mechanism mechanism_;
    WallGaps gaps_;
    ImpactVariation variation_;
    SaidOfForces said_;
    OwnCopy<Integrator> inner_;  ///< of a motion that touches no wall
    WallRest rest_;
    int places_;
    ImpactLaw law_;
    double h_ = 0, energyBefore_ = 0;                             ///< of the part before the contact at hand
    double liftedAt_ = std::numeric_limits<double>::quiet_NaN();  ///< a body has just left a wall
    bool hasSettled_ = false;                                     ///< in the last step
    bool saysForces_ = false;  ///< its quantities are those of SaidOfForces
    std::vector<double> velocity_, values_, sums_;
    std::vector<double>
        openUntil_;  ///< part of the step at hand up to which the scheme's own steps stay outside
    std::vector<char> isGrazed_;   ///< touched without an impact, and not left since
    std::vector<char> isLeaving_;  ///< rested on, and not outside since
    std::vector<int> returning_;   ///< of those at the start of a step: goes in again
    std::vector<ImpactRhythm> rhythm_;
    std::vector<Impact> impacts_;  ///< of the last step
    std::vector<Piece> pieces_;    ///< of the last step, if it had impacts
    std::vector<ImpactVariation::Contact> contacts_;
    State before_, trial_, end_;
};

}  // namespace

std::unique_ptr<Integrator> makeImpactStep(const Parts& parts, MakeOfParts make, int places, ImpactLaw law) {
    auto step = std::make_unique<ImpactStep>(parts, std::move(make), places, law);
    if (step->stepSize() < 0 && !parts.find<Wall>()->isElastic())
        throw InvalidScene(
            "/time/end",
            "is before the start, and what came before an impact that is not elastic is not known "
            "from what follows it",
            "a run forwards, or a restitution of 1");
    return step;
}

}  // namespace extremal
