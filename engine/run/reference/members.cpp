// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/members.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/parameter_switching.hpp"
#include "engine/model/conservative.hpp"
#include "engine/run/reference/force_pulses.hpp"
#include "engine/run/reference/landed_solution.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

/// One route to the solution.
struct Member {
    std::string name;
    std::function<ExactSolution()> make;
    std::vector<double> states;  ///< at the times that are compared; empty: it did not get there
    double energyError = 0;      ///< the largest; 0 where no energy is conserved
    double tolerance = 0;        ///< of a code with error control
};

/// How far two members are apart at the times, without those behind the first that is not known.
struct Distance {
    std::vector<double> upTo;  ///< d(t)
    double end() const { return upTo.empty() ? HUGE_VAL : upTo.back(); }
};

class Members {
public:
    Members(const ResolvedScene& scene, const std::stop_token& stop)
        : scene_(scene),
          system_(*scene.system),
          measure_(errorMeasure(system_, scene.initial)),
          energy_(conservesEnergy(system_) ? energyOf(system_) : EnergyFunction{}),
          width_(scene.initial.x.size()),
          end_(scene.scene.end.value),
          stop_(stop) {}

    const System& system() const { return system_; }
    const std::vector<double>& times() const { return times_; }
    std::size_t width() const { return width_; }
    /// The size of the motion, in which an angle counts as 1 rad at most, however often it turns.
    double size() const { return size_ > 0 ? size_ : measure_.scale; }

    /// A code with error control; empty where it is not there, or does not take the system.
    std::optional<Member> controlled(std::initializer_list<const char*> ids, const std::vector<double>& ends,
                                     double tolerance = 1e-13) {
        for (const char* id : ids) {
            const BaselineEntry* const entry = findBaseline(id);
            if (!entry || !canIntegrate(*entry, system_)) continue;
            MakeStepper make = [entry, system = system_, start = scene_.initial, stop = stop_, tolerance] {
                const auto made = [entry, tolerance](const System& present, const State& from) {
                    BaselineOptions options;
                    options.start = from;
                    options.tolerance = tolerance;
                    return entry->make(present, options);
                };
                auto integrator = withSwitchedParameters(system, start, made);
                integrator->setStop(stop);
                return integrator;
            };
            try {
                (void)make();
            } catch (const InvalidScene&) {
                continue;  // its library is not there
            }
            Member member{id, landed(make, scene_.initial, ends), {}, 0, tolerance};
            if (times_.empty()) {
                if (!march(make, ends, member)) continue;
            } else {
                follow(member);
            }
            return member;
        }
        return {};
    }

    /// Its states at the times that are compared.
    void follow(Member& member) {
        constexpr double tooLong = 0.5;
        const double begin = threadSeconds();
        if (times_.empty()) useEvenTimes();
        const ExactSolution solution = member.make();
        std::vector<double> x(width_);
        member.states.assign(times_.size() * width_, std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < times_.size(); ++i) {
            if (stop_.stop_requested() || threadSeconds() - begin > tooLong) break;
            solution(times_[i], x);
            if (!std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) break;
            std::copy(x.begin(), x.end(), member.states.begin() + static_cast<std::ptrdiff_t>(i * width_));
        }
        measureEnergy(member);
    }

    Distance between(const Member& a, const Member& b) const {
        Distance d;
        double most = 0;
        std::vector<double> values(measure_.columns.size());
        for (std::size_t i = 0; i < times_.size(); ++i) {
            measure_.evaluate(a.states.data() + i * width_, b.states.data() + i * width_, values.data());
            const double now = std::isfinite(values.front()) ? values.front() : HUGE_VAL;
            d.upTo.push_back(most = std::max(most, now));
        }
        return d;
    }

private:
    void useEvenTimes() {
        constexpr int fewTimes = 400;
        for (int i = 1; i <= fewTimes; ++i)
            times_.push_back(scene_.initial.t + (end_ - scene_.initial.t) * i / fewTimes);
    }

    /// The steps of the code are the times: many where the motion is fast. False: it did not get to the end.
    bool march(const MakeStepper& make, const std::vector<double>& ends, Member& member) {
        constexpr std::size_t most = 1000, mostNumbers = 20'000'000;
        constexpr double tooLong = 0.5;
        const double begin = threadSeconds();
        const auto integrator = make();
        State state = scene_.initial;
        integrator->begin(state);
        std::vector<double> t, x;
        while (state.t < end_) {
            const auto next = std::upper_bound(ends.begin(), ends.end(), state.t);
            const double until = next == ends.end() ? end_ : std::min(end_, *next);
            if (integrator->advance(state, until).outcome != Outcome::converged) return false;
            t.push_back(state.t);
            x.insert(x.end(), state.x.begin(), state.x.end());
            const bool isTooLong = threadSeconds() - begin > tooLong || x.size() > mostNumbers;
            if (stop_.stop_requested() || isTooLong) return false;
        }
        const std::size_t every = (t.size() + most - 1) / most;
        for (std::size_t i = (t.size() - 1) % every; i < t.size(); i += every) {
            times_.push_back(t[i]);
            const auto from = x.begin() + static_cast<std::ptrdiff_t>(i * width_);
            member.states.insert(member.states.end(), from, from + static_cast<std::ptrdiff_t>(width_));
        }
        measureEnergy(member);
        return true;
    }

    void measureEnergy(Member& member) {
        const auto d = system_.coordinates.size();
        double first = 0;
        if (energy_) first = energy_(scene_.initial.t, scene_.initial.x.data());
        for (std::size_t i = 0; i < times_.size(); ++i) {
            const double* const x = member.states.data() + i * width_;
            if (!std::isfinite(*x)) {
                member.energyError = HUGE_VAL;
                return;
            }
            double norm = 0;
            for (std::size_t k = 0; k < d; ++k) {
                const bool isAngle = system_.coordinates[k].unit == "rad";
                norm = std::hypot(norm, isAngle ? std::min(std::abs(x[k]), 1.0) : x[k]);
            }
            size_ = std::max(size_, norm);
            if (!energy_) continue;
            const double off = std::abs(energy_(times_[i], x) - first);
            member.energyError = std::max(member.energyError, std::isfinite(off) ? off : HUGE_VAL);
        }
    }

    const ResolvedScene& scene_;
    const System& system_;
    ErrorMeasure measure_;
    EnergyFunction energy_;
    std::size_t width_;
    double end_, size_ = 0;
    std::stop_token stop_;
    std::vector<double> times_;
};

/// "reference: Gauss(12) and rk8pd part at t = 14.4: errors are judged to there".
std::string textOfHorizon(const ReferenceInfo& info, double size) {
    constexpr double part = 1e-3;
    return info.confirmedBy.empty()
               ? std::string()
               : "the two routes to the reference (" + info.chosen + ", " + info.confirmedBy +
                     ") part at t = " + formatNumber(info.horizon, 4) + " (bound " +
                     formatNumber(part * size, 2) + "; " + formatNumber(info.bound, 2) +
                     " at the end): errors are judged to there";
}

struct Pair {
    const Member *chosen, *other;
    Distance distance;
};

/// The nearest of all pairs; where the user has chosen the reference, which is the first of all, of those
/// that it is in.
std::optional<Pair> nearestOf(const Members& members, const std::vector<const Member*>& all, bool isGiven) {
    constexpr double muchSmaller = 0.1;
    std::optional<Pair> best;
    for (std::size_t i = 0; i < (isGiven ? 1 : all.size()); ++i)
        for (std::size_t k = i + 1; k < all.size(); ++k) {
            Distance d = members.between(*all[i], *all[k]);
            if (best && !(d.end() < best->distance.end())) continue;
            const bool isSecondBetter = !isGiven && all[k]->energyError < muchSmaller * all[i]->energyError;
            best = isSecondBetter ? Pair{all[k], all[i], std::move(d)} : Pair{all[i], all[k], std::move(d)};
        }
    return best;
}

void tell(Reference& reference, const Members& members, const Pair& pair) {
    constexpr double part = 1e-3, doubtful = 1e-6;
    ReferenceInfo& info = reference.info;
    info.chosen = pair.chosen->name;
    info.confirmedBy = pair.other->name;
    info.agreed = pair.distance.end();
    info.bound = Confirmation::safety * info.agreed;
    const double size = members.size();
    if (info.bound <= doubtful * size) return;
    info.estimatedError = std::max(info.estimatedError, info.bound);
    constexpr std::size_t fewPlaces = 200;
    const std::size_t every = 1 + members.times().size() / fewPlaces;
    for (std::size_t i = 0; i < members.times().size(); i += every)
        info.boundAlong.push_back({members.times()[i], Confirmation::safety * pair.distance.upTo[i]});
    info.boundAlong.push_back({members.times().back(), info.bound});
    if (info.bound <= part * size) return;
    info.horizon = members.times().front();
    for (std::size_t i = 0; i < members.times().size(); ++i) {
        if (Confirmation::safety * pair.distance.upTo[i] > part * size) break;
        info.horizon = members.times()[i];
    }
    info.caution = textOfHorizon(info, size);
}

}  // namespace

Confirmation confirmation(const ReferencePair& pair, const ResolvedScene& scene, const DistanceOf& distance) {
    const ErrorMeasure measure = errorMeasure(*scene.system, scene.initial);
    Confirmation found{pair.by, {{scene.initial.t, 0}}};
    std::vector<double> values(measure.columns.size());
    double most = 0;
    for (std::size_t i = 0; i < pair.times.size(); ++i) {
        measure.evaluate(pair.secondAt(i).data(), pair.firstAt(i).data(), values.data());
        const double d = distance(values);
        if (!(d <= most)) most = std::isfinite(d) ? d : HUGE_VAL;
        found.parts.push_back({pair.times[i], most});
    }
    return found;
}

void confirmReference(Reference& reference, const ResolvedScene& scene, const std::stop_token& stop) {
    constexpr double doubtful = 1e-6, coarse = 1e-12, finest = 1e-15;
    const System& system = *scene.system;
    const bool isForwards = scene.scene.end.value > scene.scene.start.value;
    if (!system.hasCoordinates() || system.error.evaluate || !isForwards) return;
    // Codes that resolve the fastest motion would take longer than a user waits for.
    constexpr double mostRadians = 3e5;
    const double length = scene.scene.end.value - scene.scene.start.value;
    if (highestFrequency(system, scene.initial) * length > mostRadians) return;
    const bool isMissing = !reference.make, isGiven = reference.info.type == "scheme";
    if (isMissing && isGiven) return;
    const ForcePulses pulses = forcePulses(system, scene.initial, scene.scene.end.value,
                                           isMissing ? ExactSolution{} : reference.make());
    Members members(scene, stop);
    const std::optional<Member> b = members.controlled({"rk8pd", "fehlberg78"}, pulses.ends);
    if (stop.stop_requested()) return;
    reference.info.pulses = pulses.pulses;
    if (!b) return;  // there is nothing to confirm it
    Member a{isMissing ? "" : reference.info.description, reference.make, {}, 0};
    if (!isMissing) members.follow(a);
    std::vector<const Member*> all;
    if (!isMissing) all.push_back(&a);
    all.push_back(&*b);
    std::optional<Pair> best = nearestOf(members, all, isGiven);
    // Most of the distance is the error of B where that is not round-off yet.
    std::optional<Member> finer;
    if (best && !isMissing && Confirmation::safety * best->distance.end() > coarse * members.size() &&
        !stop.stop_requested()) {
        finer = members.controlled({b->name.c_str()}, pulses.ends, finest);
        const bool isThere =
            finer && std::isfinite(finer->energyError) && std::isfinite(finer->states.back());
        if (isThere && members.between(a, *finer).end() < best->distance.end()) {
            all.back() = &*finer;
            best = nearestOf(members, all, isGiven);
        }
    }
    std::optional<Member> c;
    const bool isDoubtful = !best || Confirmation::safety * best->distance.end() > doubtful * members.size();
    if (isDoubtful && !stop.stop_requested()) {
        c = members.controlled({"bulirsch-stoer"}, pulses.ends);
        if (c) all.push_back(&*c);
        best = nearestOf(members, all, isGiven);
    }
    if (stop.stop_requested()) return;
    if (!best || !std::isfinite(best->distance.upTo.front())) return;
    if (best->chosen != &a) {
        reference.make = best->chosen->make;
        reference.info.type = "computed";
        reference.info.description =
            best->chosen->name + ", tolerance " + formatNumber(best->chosen->tolerance);
        reference.info.estimatedError = Confirmation::safety * best->distance.end();
        reference.info.problems.clear();
    }
    tell(reference, members, *best);
    reference.pair = std::make_shared<const ReferencePair>(
        ReferencePair{best->chosen->name, best->other->name, members.width(), members.times(),
                      best->chosen->states, best->other->states});
}

}  // namespace extremal
