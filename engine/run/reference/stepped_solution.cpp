// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/stepped_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace extremal {
namespace {

/// Takes an integrator as far as it is asked, and answers from its dense output. Going back in time starts
/// anew.
class SteppedSolution {
public:
    /// `counts`: what happens in its steps; null: they are not counted. `failure`: where it says that it
    /// ended early; null: nowhere.
    SteppedSolution(MakeStepper make, State initial, double end, std::shared_ptr<StepCounts> counts,
                    std::shared_ptr<StepFailure> failure)
        : make_(std::move(make)),
          initial_(std::move(initial)),
          end_(end),
          counts_(std::move(counts)),
          failure_(std::move(failure)) {
        rewind();
    }
    void operator()(double t, std::span<double> x) {
        goTo(t);
        if (hasFailed_)
            std::fill(x.begin(), x.end(), std::numeric_limits<double>::quiet_NaN());
        else if (t == state_.t)
            std::copy(state_.x.begin(), state_.x.end(), x.begin());
        else
            integrator_->denseOutput((t - before_) / (state_.t - before_), x);
    }
    std::pair<double, double> stepAt(double t) {
        goTo(t);
        constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
        return hasFailed_ ? std::pair{nowhere, nowhere} : std::pair{before_, state_.t};
    }

    /// Where it is, without the dense output of its last step.
    void checkpoint(Archive& archive) {
        Place here;
        bool isKnown = false;
        if (!archive.isReading()) {
            Archive own;
            isKnown = !hasFailed_ && integrator_->checkpoint(own);
            here = {state_, own.bytes(), own_};
        }
        archive(isKnown);
        if (isKnown) archive(here);
        if (isKnown && archive.isReading()) read_ = std::move(here);
    }

private:
    void goTo(double t) {
        if (read_) resume(t);
        if (t < before_) rewind();
        while (!hasFailed_ && state_.t < t) {
            before_ = state_.t;
            const bool isFixed = integrator_->grid() == TimeGrid::fixed;
            const StepReport report =
                integrator_->advance(state_, isFixed ? clock_.at(state_.node + 1) : std::max(end_, t));
            hasFailed_ = report.outcome != Outcome::converged;
            if (hasFailed_ && failure_) *failure_ = {report.outcome, state_.t};
            count({1, report.event != StepEvent::none});
        }
    }
    struct Place {
        State state = {};
        std::string integrator = {};
        StepCounts counts = {};
        void checkpoint(Archive& archive) { archive(state, integrator, counts); }
    };
    /// Goes to the place that was read, if the time is not before it.
    void resume(double t) {
        const std::optional<Place> place = std::exchange(read_, std::nullopt);
        if (!place || t < place->state.t) return;
        state_ = place->state;
        before_ = state_.t;
        Archive archive(place->integrator);
        (void)integrator_->checkpoint(archive);
        count(place->counts);
    }
    void count(const StepCounts& more) {
        own_ += more;
        if (counts_) *counts_ += more;
    }

    void rewind() {
        integrator_ = make_();
        clock_ = {initial_.t, integrator_->stepSize()};
        state_ = initial_;
        integrator_->begin(state_);
        before_ = initial_.t;
        hasFailed_ = false;
    }
    MakeStepper make_;
    State initial_, state_;
    double end_;
    Clock clock_;
    std::unique_ptr<Integrator> integrator_;
    double before_ = 0;
    bool hasFailed_ = false;
    std::shared_ptr<StepCounts> counts_;
    std::shared_ptr<StepFailure> failure_;
    StepCounts own_ = {};        ///< of this solution alone
    std::optional<Place> read_;  ///< from a checkpoint, until a time is asked for
};

}  // namespace

std::function<ExactSolution()> stepped(MakeStepper make, const State& initial, double end,
                                       const std::shared_ptr<StepCounts>& counts,
                                       const std::shared_ptr<StepFailure>& failure) {
    return [make = std::move(make), initial, end, counts, failure]() -> ExactSolution {
        const auto solution = std::make_shared<SteppedSolution>(make, initial, end, counts, failure);
        ExactSolution along = [solution](double t, std::span<double> x) { (*solution)(t, x); };
        along.setCheckpoint([solution](Archive& archive) { solution->checkpoint(archive); });
        along.setStepAt([solution](double t) { return solution->stepAt(t); });
        return along;
    };
}

double solutionDistance(const ExactSolution& a, const ExactSolution& b, double step, bool atNodes,
                        const Scene& scene, const System& system, const State& initial,
                        const std::stop_token& stop) {
    constexpr int most = 997;  // a prime: not in step with the nodes of either
    const double length = scene.end.value - scene.start.value;
    const ErrorMeasure measure = errorMeasure(system, initial);
    const long long nodes = std::max(1LL, static_cast<long long>(length / step * (1 + 1e-12)));
    const auto samples = atNodes ? static_cast<int>(std::min<long long>(most, nodes)) : most;
    std::vector<double> x(initial.x.size()), y(x), values(measure.columns.size());
    double worst = 0;
    for (int i = 1; i <= samples && !stop.stop_requested(); ++i) {
        const double t = atNodes ? Clock{initial.t, step}.at(nodes * i / samples)
                                 : scene.start.value + length * i / samples;
        a(t, x);
        b(t, y);
        measure.evaluate(x.data(), y.data(), values.data());
        worst =
            std::max(worst, std::isfinite(values[0]) ? values[0] : std::numeric_limits<double>::infinity());
        // Further on, a motion that forgets its start takes as long again and says nothing more.
        if (worst > std::max(measure.scale, 1.0)) break;
    }
    return worst;
}

}  // namespace extremal
