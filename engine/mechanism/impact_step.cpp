// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/impact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/mechanism/impact_variation.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/own_copy.hpp"
#include "engine/mechanism/said_of_forces.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {
namespace {

constexpr double unitRoundOff = std::numeric_limits<double>::epsilon();

/// The last impacts on one wall, whose distances in time tell whether they accumulate.
struct Rhythm {
    double last[4] = {};
    int known = 0;

    void add(double t) {
        if (known == 4) {
            std::copy(last + 1, last + 4, last);
            --known;
        }
        last[known++] = t;
    }
    /// Where infinitely many impacts have passed, if their distances shrink by one factor.
    std::optional<double> end() const {
        if (known < 4) return {};
        const double first = last[1] - last[0], second = last[2] - last[1], third = last[3] - last[2];
        const double r = third / second;
        if (!(r > 0 && r < 1) || !(std::abs(second / first / r - 1) < 1e-3)) return {};
        return last[3] + third * r / (1 - r);
    }
};

class ImpactStep final : public Integrator {
public:
    ImpactStep(const Parts& parts, std::unique_ptr<Integrator> inner, int places)
        : mechanism_(parts),
          wall_(*parts.find<Wall>()),
          variation_(parts),
          said_(parts, mechanism_.dimension()),
          inner_(std::move(inner)),
          places_(places) {
        h_ = inner_->stepSize();
        const auto n = static_cast<std::size_t>(wall_.count());
        const auto d = static_cast<std::size_t>(mechanism_.dimension());
        gaps_.resize(n);
        byTime_.resize(n);
        byPlace_.resize(n * d);
        rhythm_.resize(n);
        isGrazed_.assign(n, 0);
        openUntil_.assign(n, 0);
        samples_.resize(n * static_cast<std::size_t>(places_ + 1));
        velocity_.resize(d);
        at_.x.resize(2 * d);
        values_.resize(inner_->quantities().size());
        sums_.resize(values_.size());
        saysForces_ = values_.size() == said_.quantities().size() &&
                      inner_->quantities()[SaidOfForces::work].name == "work";
    }
    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        inner_->setStep(h);
    }
    std::vector<MemoryPart> memoryParts() const override { return inner_->memoryParts(); }
    void begin(State& state) override {
        inner_->begin(state);
        std::fill(rhythm_.begin(), rhythm_.end(), Rhythm{});
        fastest_ = 0;
        std::fill(isGrazed_.begin(), isGrazed_.end(), false);
    }

    StepReport advance(State& state, double until) override {
        inner_->setStop(stop());
        inner_->setStep(h_);
        pieces_.clear();
        impacts_.clear();
        contacts_.clear();
        std::fill(openUntil_.begin(), openUntil_.end(), 0.0);
        before_ = state;
        const bool goesIntoWall = fastestApproach(state) >= 0;
        for (int k = 0; k < wall_.count(); ++k)
            if (gap(k) > roundOff(k, state.x.data())) isGrazed_[static_cast<std::size_t>(k)] = false;
        if (goesIntoWall) return advanceWithImpacts(state, until, StepReport{});
        StepReport report = inner_->advance(state, until);
        if (report.outcome != Outcome::converged || (!firstCrossing(before_, h_) && !isInside(state)))
            return report;
        state = before_;
        return advanceWithImpacts(state, until, report);
    }

    void denseOutput(double tau, std::span<double> x) const override {
        for (const Piece& piece : pieces_)
            if (tau <= piece.to) {
                const double length = piece.to - piece.from;
                piece.step->denseOutput(length > 0 ? std::max(0.0, (tau - piece.from) / length) : 1, x);
                return;
            }
        inner_->denseOutput(tau, x);
    }

    std::size_t tangentSize() const override { return inner_->tangentSize(); }
    std::string tangentProblem() const override { return inner_->tangentProblem(); }
    /// Unknown where a step begins with an impact, or several happen at one time.
    bool applyTangent(std::span<double> W) override {
        if (pieces_.empty()) return impacts_.empty() && inner_->applyTangent(W);
        const Eigen::Index rows = 2 * dimension(), columns = static_cast<Eigen::Index>(W.size()) / rows;
        Eigen::Map<Eigen::MatrixXd> given(W.data(), rows, columns);
        Eigen::MatrixXd moved = given;
        Eigen::RowVectorXd later = Eigen::RowVectorXd::Zero(columns);
        std::size_t next = 0;
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            auto* const step = dynamic_cast<VariedStep*>(&*pieces_[k].step);
            if (!step) return false;
            if (next < contacts_.size() && contacts_[next].pieces <= k) return false;
            if (next < contacts_.size() && contacts_[next].pieces == k + 1) {
                const Contact& contact = contacts_[next++];
                if (!variation_.throughContact(*step, contact.wall, contact.before, moved, later))
                    return false;
                continue;
            }
            const bool isLast = k + 1 == pieces_.size();
            const Eigen::RowVectorXd length = isLast ? -later : Eigen::RowVectorXd::Zero(columns).eval();
            if (!step->vary(moved, later, length)) return false;
            if (isLast) later.setZero();
        }
        if (next < contacts_.size() || !variation_.toNode(end_, moved, later)) return false;
        given = moved;
        return true;
    }

    std::span<const Quantity> quantities() const override { return inner_->quantities(); }
    void measure(const State& state, double* values) const override {
        if (pieces_.empty())
            inner_->measure(state, values);
        else
            std::copy(sums_.begin(), sums_.end(), values);
    }
    std::span<const Impact> impacts() const override { return impacts_; }
    std::string about() const override { return inner_->about(); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ImpactStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(rhythm_, isGrazed_, fastest_);
        return inner_->checkpoint(archive);
    }

private:
    /// A part of the last step between impacts, as parts of the step.
    struct Piece {
        double from, to;
        OwnCopy<Integrator> step;
    };
    /// An impact after so many pieces.
    struct Contact {
        std::size_t pieces;
        int wall;
        State before;
    };
    /// A gap that closes: within (from, to] of the step last taken.
    struct Crossing {
        int wall;
        double from, to;
    };

    int dimension() const { return mechanism_.dimension(); }
    double energyAt(const State& s) const {
        const auto& L = mechanism_.mechanics();
        return L.energy(L.model.get(), s.t, s.x.data(), s.x.data() + dimension());
    }
    void findGaps(double t, const double* q) {
        wall_.first(wall_.model.get(), t, q, gaps_.data(), byPlace_.data(), byTime_.data());
    }
    double gap(int wall) const { return gaps_[static_cast<std::size_t>(wall)]; }
    const double* normal(int wall) const { return byPlace_.data() + wall * dimension(); }
    /// A depth that rounding makes, where findGaps() was called last, at q.
    double roundOff(int wall, const double* q) const { return Wall::rounding * terms(wall, q); }
    double terms(int wall, const double* q) const { return Wall::terms(normal(wall), q, dimension()); }
    /// d gap / dt at a state, where findGaps() was called last.
    struct Speed {
        double value = 0;
        bool isGraze = false;  ///< nothing beside the speeds of the motion
    };
    std::optional<Speed> speed(int wall, const State& s) {
        const auto& L = mechanism_.mechanics();
        if (!L.velocity(L.model.get(), s.t, s.x.data(), s.x.data() + dimension(), velocity_.data()))
            return {};
        double value = byTime_[static_cast<std::size_t>(wall)], size = 0;
        for (int i = 0; i < dimension(); ++i) {
            const double v = velocity_[static_cast<std::size_t>(i)];
            fastest_ = std::max(fastest_, std::abs(v));
            value += normal(wall)[i] * v;
            size += std::abs(normal(wall)[i]);
        }
        return Speed{value, std::abs(value) < 1e-10 * size * fastest_};
    }
    double ahead() const { return h_ < 0 ? -1 : 1; }

    /// The wall that a state is on and goes into, fastest; -1: it goes into none of them. Finds the gaps.
    int fastestApproach(const State& s) {
        findGaps(s.t, s.x.data());
        int found = -1;
        double fastest = 0;
        for (int k = 0; k < wall_.count(); ++k) {
            if (!(gap(k) <= roundOff(k, s.x.data()))) continue;
            const auto r = speed(k, s);
            if (!r || r->isGraze || !(r->value * ahead() < fastest)) continue;
            fastest = r->value * ahead();
            found = k;
        }
        return found;
    }

    /// Whether a state is inside a wall that was touched without an impact: pressed there.
    bool isInside(const State& s) {
        findGaps(s.t, s.x.data());
        for (int k = 0; k < wall_.count(); ++k)
            if (gap(k) < -roundOff(k, s.x.data())) return true;
        return false;
    }

    /// The first gap that closes inside the step that `inner_` has just taken from `start`, of length h.
    std::optional<Crossing> firstCrossing(const State& start, double h) {
        const int n = wall_.count();
        std::optional<Crossing> first;
        findGaps(start.t, start.x.data());
        std::copy(gaps_.begin(), gaps_.end(), samples_.begin());
        for (int i = 1; i <= places_; ++i) {
            const double tau = static_cast<double>(i) / places_;
            inner_->denseOutput(tau, at_.x);
            findGaps(start.t + tau * h, at_.x.data());
            double* const row = samples_.data() + i * n;
            std::copy(gaps_.begin(), gaps_.end(), row);
            for (int k = 0; k < n; ++k) {
                const auto wall = static_cast<std::size_t>(k);
                if (first || isGrazed_[wall] || tau <= openUntil_[wall] ||
                    !(row[k] < -roundOff(k, at_.x.data())))
                    continue;
                first = Crossing{k, static_cast<double>(i - 1) / places_, tau};
            }
            if (first) return earliestOf(*first, start, h, row);
        }
        return first;
    }
    /// Of walls that close between the same two places the one whose gap a straight line closes first; the
    /// lower end of the interval is moved to where the gap is still open.
    std::optional<Crossing> earliestOf(Crossing found, const State& start, double h, const double* row) {
        const int n = wall_.count();
        double least = 2;
        Crossing best = found;
        for (int k = 0; k < n; ++k) {
            const double before = row[k - n], after = row[k];
            const auto wall = static_cast<std::size_t>(k);
            if (isGrazed_[wall] || best.to <= openUntil_[wall] || !(after < -roundOff(k, at_.x.data())))
                continue;
            const double part = before > 0 ? before / (before - after) : 0;
            if (part < least) {
                least = part;
                best.wall = k;
            }
        }
        if (best.from > 0 && best.from <= openUntil_[static_cast<std::size_t>(best.wall)]) return best;
        for (int halvings = 0; halvings < 60; ++halvings) {
            const double tau = halvings == 0 ? best.from : best.from + (best.to - best.from) / 2;
            if (tau > 0) {
                inner_->denseOutput(tau, at_.x);
                findGaps(start.t + tau * h, at_.x.data());
                if (gap(best.wall) > 0) {
                    best.from = tau;
                    return best;
                }
                if (halvings > 0) best.to = tau;
            } else if (samples_[static_cast<std::size_t>(best.wall)] > roundOff(best.wall, start.x.data())) {
                return best;
            }
        }
        best.from = best.to;  // never open: it rests on the wall
        return best;
    }

    /// The step of the scheme of the length alpha h from `start`, in `trial_`.
    Outcome tryStep(const State& start, double alpha, double h, StepReport& report) {
        trial_ = start;
        inner_->setStep(alpha * h);
        const StepReport step = inner_->advance(trial_, start.t + alpha * h);
        report.cost += step.cost;
        report.residual = step.residual;
        trial_.node = start.node;
        return step.outcome;
    }

    /// alpha of the contact, whose step is then the last one taken; NaN where the gap of the scheme's own
    /// steps stays open; nothing where a step has failed, as the report says.
    std::optional<double> contact(const State& start, const Crossing& crossing, double h,
                                  StepReport& report) {
        double low = crossing.from, high = crossing.to, alpha = (low + high) / 2;
        bool hasClosed = false, hasOpened = false;
        for (int iteration = 0; iteration < 100; ++iteration) {
            if (report.outcome = tryStep(start, alpha, h, report); report.outcome != Outcome::converged)
                return {};
            findGaps(trial_.t, trial_.x.data());
            const double value = gap(crossing.wall);
            const auto r = speed(crossing.wall, trial_);
            if (!r) {
                report.outcome = Outcome::singular;
                return {};
            }
            if (std::abs(value) <= 2 * unitRoundOff * terms(crossing.wall, trial_.x.data())) return alpha;
            hasClosed = hasClosed || value < 0;
            hasOpened = hasOpened || value > 0;
            (value > 0 ? low : high) = alpha;
            double next = alpha - value / (r->value * h);
            if (!(next > low && next < high)) next = (low + high) / 2;
            const double tiny = 2 * unitRoundOff * std::max(1e-3, std::abs(alpha));
            if (!(std::abs(next - alpha) > tiny)) {
                // Newton's method may come from one side alone.
                const bool isInside = value > 0 ? alpha < high - 2 * tiny : alpha > low + 2 * tiny;
                if (isInside || (hasClosed && hasOpened)) return alpha;
                if (!hasClosed) break;
                if (low == 0) return alpha;
                // Open there on the dense output alone.
                high = low;
                low = low > 1e-6 ? low / 2 : 0;
                next = (low + high) / 2;
            }
            alpha = next;
        }
        return hasClosed ? std::optional(alpha) : std::numeric_limits<double>::quiet_NaN();
    }

    /// One impulse after the other while a wall at the state is approached. False where there is none that
    /// ends it.
    bool strikeAll(State& s) {
        const int most = 100 * wall_.count() * wall_.count();
        for (int count = 0; count < most; ++count) {
            const int k = fastestApproach(s);
            if (k < 0) return true;
            Impact impact;
            impact.wall = k;
            impact.t = s.t;
            const double energy = energyAt(s), before = speed(k, s)->value,
                         after = -wall_.restitution[static_cast<std::size_t>(k)] * before;
            contacts_.push_back({pieces_.size(), k, s});
            const auto impulse = mechanism_.strike(s.t, s.x.data(), s.x.data() + dimension(), normal(k),
                                                   after - byTime_[static_cast<std::size_t>(k)]);
            if (!impulse) return false;
            impact.impulse = *impulse;
            impact.speedBefore = before;
            impact.speedAfter = after;
            impact.energyLoss = energy - energyAt(s);
            impacts_.push_back(impact);
            if (saysForces_) sayImpact(impact, s);
            if (impacts_.size() < 2 || impacts_[impacts_.size() - 2].wall != k ||
                impacts_[impacts_.size() - 2].t != s.t)
                rhythm_[static_cast<std::size_t>(k)].add(s.t);
        }
        return false;
    }

    /// Adds an impact to what is said of the step; the gaps are known at `s`.
    void sayImpact(const Impact& impact, const State& s) {
        sums_[SaidOfForces::work] -= impact.energyLoss;
        sums_[SaidOfForces::expansion] +=
            2 * std::log(wall_.restitution[static_cast<std::size_t>(impact.wall)]);
        for (int i = 0; i < dimension(); ++i)
            velocity_[static_cast<std::size_t>(i)] = impact.impulse * normal(impact.wall)[i];
        said_.addImpulse(s.t, s.x.data(), velocity_.data(), sums_.data());
    }

    void keepPiece(double from, double to, const State& end) {
        if (!values_.empty()) {
            inner_->measure(end, values_.data());
            for (std::size_t i = 0; i < values_.size(); ++i) sums_[i] += values_[i];
        }
        pieces_.push_back({from, to, inner_});
    }

    /// From `state` to the node at `until` through all impacts before it.
    StepReport advanceWithImpacts(State& state, double until, StepReport report) {
        constexpr int mostImpacts = 1000;
        report.outcome = Outcome::converged;
        report.step = h_;
        std::fill(openUntil_.begin(), openUntil_.end(), 0.0);
        std::fill(sums_.begin(), sums_.end(), 0.0);
        const double start = state.t;
        State s = state;
        double from = 0;
        const auto fail = [&](Outcome outcome, double at) {
            report.outcome = outcome;
            if (outcome == Outcome::accumulation) report.step = at - start;
            return report;
        };
        for (int count = 0; count < mostImpacts; ++count) {
            const std::size_t known = impacts_.size();
            if (!strikeAll(s)) return fail(Outcome::accumulation, s.t);
            for (std::size_t i = known; i < impacts_.size(); ++i) {
                const auto end = rhythm_[static_cast<std::size_t>(impacts_[i].wall)].end();
                if (end && (until - *end) * ahead() >= 0) return fail(Outcome::accumulation, *end);
            }
            const double rest = until - s.t;
            if (!(rest * ahead() > 4 * unitRoundOff * std::abs(until))) {
                s.t = until;
                break;
            }
            if (const Outcome outcome = tryStep(s, 1, rest, report); outcome != Outcome::converged)
                return fail(outcome, s.t);
            std::optional<Crossing> crossing = firstCrossing(s, rest);
            double alpha = std::numeric_limits<double>::quiet_NaN();
            if (crossing && crossing->from >= crossing->to) return fail(Outcome::accumulation, s.t);
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
            findGaps(s.t, s.x.data());
            if (const auto r = speed(crossing->wall, s); r && r->isGraze)
                isGrazed_[static_cast<std::size_t>(crossing->wall)] = true;
            if (count + 1 == mostImpacts) return fail(Outcome::accumulation, s.t);
        }
        inner_->setStep(h_);
        s.node = state.node + 1;
        state = s;
        end_ = s;
        return report;
    }

    Mechanism mechanism_;
    Wall wall_;
    ImpactVariation variation_;
    SaidOfForces said_;
    OwnCopy<Integrator> inner_;
    int places_;
    double h_ = 0;
    double fastest_ = 0;       ///< the largest |v_i| that a wall has seen
    bool saysForces_ = false;  ///< its quantities are those of SaidOfForces
    std::vector<double> gaps_, byPlace_, byTime_, samples_, velocity_, values_, sums_;
    std::vector<double>
        openUntil_;  ///< part of the step at hand up to which the scheme's own steps stay outside
    std::vector<char> isGrazed_;  ///< touched without an impact, and not left since
    std::vector<Rhythm> rhythm_;
    std::vector<Impact> impacts_;  ///< of the last step
    std::vector<Piece> pieces_;    ///< of the last step, if it had impacts
    std::vector<Contact> contacts_;
    State before_, at_, trial_, end_;
};

}  // namespace

std::unique_ptr<Integrator> makeImpactStep(const Parts& parts, std::unique_ptr<Integrator> inner,
                                           int places) {
    if (inner->stepSize() < 0 && !parts.find<Wall>()->isElastic())
        throw InvalidScene(
            "/time/end",
            "is before the start, and what came before an impact that is not elastic is not known "
            "from what follows it",
            "a run forwards, or a restitution of 1");
    return std::make_unique<ImpactStep>(parts, std::move(inner), places);
}

}  // namespace extremal
