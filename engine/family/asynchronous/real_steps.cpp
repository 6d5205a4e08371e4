// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/family/asynchronous/steps.hpp"

namespace extremal {
namespace {

/// memory: positions and velocities of the nodes at their own times, these times, and the next time of each
/// element.
template <class Elements>
class RealSteps final : public Integrator {
public:
    RealSteps(Elements elements, double courant, double step) : elements_(std::move(elements)), h_(step) {
        for (int e = 0; e < elements_.elements(); ++e) step_.push_back(courant * elements_.criticalStep(e));
        queue_.reserve(step_.size());
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }
    bool checksFinite() const override { return true; }
    std::vector<MemoryPart> memoryParts() const override {
        const auto n = static_cast<std::size_t>(elements_.nodes());
        return {{"positions", n}, {"velocities", n}, {"times of the nodes", n}, {"next times", step_.size()}};
    }
    void begin(State& state) override {
        const auto n = static_cast<std::size_t>(elements_.nodes());
        state.memory.assign(state.x.begin(), state.x.end());
        state.memory.insert(state.memory.end(), n, state.t);
        for (const double h : step_) state.memory.push_back(state.t + h / 2);
    }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        if (state.memory.empty()) begin(state);
        before_ = state;
        const auto n = static_cast<std::size_t>(elements_.nodes());
        double *u = state.memory.data(), *v = u + n, *t = v + n, *next = t + n;
        // The times of the elements are all there is to know of the queue: a heap over them is made anew.
        queue_.clear();
        for (int e = 0; e < elements_.elements(); ++e) queue_.push_back({next[e], e});
        std::make_heap(queue_.begin(), queue_.end());
        const auto drift = [&](int node, double time) {
            const auto a = static_cast<std::size_t>(node);
            u[a] += (time - t[a]) * v[a];
            t[a] = time;
        };
        while (queue_.front().time <= until) {
            std::pop_heap(queue_.begin(), queue_.end());
            auto& [time, e] = queue_.back();
            const double h = step_[static_cast<std::size_t>(e)];
            for (const int a : elements_.nodesOf(e)) drift(a, time);
            elements_.kick(e, h, u, v);
            time = next[e] = time + h;
            std::push_heap(queue_.begin(), queue_.end());
            if ((++report.cost.evaluations & 0xfff) == 0 && stop().stop_requested()) {
                state = before_;
                report.outcome = Outcome::stopped;
                return report;
            }
        }
        synchronise(until, u, state.x.data());
        double sum = 0;
        for (const double value : state.x) sum += 0 * value;
        if (sum != 0) {
            state = before_;
            report.outcome = Outcome::notFinite;
            return report;
        }
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        State state = before_;
        RealSteps shorter = *this;
        if (tau > 0) advanceForDenseOutput(shorter, state, before_.t + tau * h_);
        std::copy(state.x.begin(), state.x.end(), x.begin());
    }
    std::string tangentProblem() const override {
        return "its elements and nodes have times of their own, which no step brings together";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<RealSteps>(*this); }

private:
    struct Event {
        double time;
        int element;
        /// For a heap whose front is the earliest; ties go by the number of the element.
        bool operator<(const Event& other) const {
            return time != other.time ? time > other.time : element > other.element;
        }
    };
    /// All nodes at time `now`; the last kick of element e stood for the times up to next - h/2.
    void synchronise(double now, const double* memory, double* x) const {
        const auto n = static_cast<std::size_t>(elements_.nodes());
        const double *u = memory, *v = u + n, *t = v + n, *next = t + n;
        for (std::size_t a = 0; a < n; ++a) {
            x[a] = u[a] + (now - t[a]) * v[a];
            x[n + a] = v[a];
        }
        for (int e = 0; e < elements_.elements(); ++e)
            elements_.kick(e, now - (next[e] - step_[static_cast<std::size_t>(e)] / 2), x, x + n);
    }

    Elements elements_;
    double h_;
    std::vector<double> step_;
    std::vector<Event> queue_;
    State before_;
};

}  // namespace

template <class Elements>
std::unique_ptr<Integrator> makeRealSteps(Elements elements, double courant, double step) {
    return std::make_unique<RealSteps<Elements>>(std::move(elements), courant, step);
}
template std::unique_ptr<Integrator> makeRealSteps(BarElements, double, double);
template std::unique_ptr<Integrator> makeRealSteps(MembraneElements, double, double);

}  // namespace extremal
