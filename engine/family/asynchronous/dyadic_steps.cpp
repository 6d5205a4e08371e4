#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/family/asynchronous/steps.hpp"

namespace extremal {
namespace {

template <class Forces>
class DyadicSteps final : public Integrator {
public:
    DyadicSteps(Forces forces, const Levels& levels, double step)
        : forces_(std::move(forces)),
          ticks_(2LL << levels.highest),
          byLevel_(static_cast<std::size_t>(levels.highest) + 1),
          h_(step),
          clock_(static_cast<std::size_t>(forces_.nodes())),
          x_(2 * clock_.size()) {
        for (int e = 0; e < forces_.elements(); ++e)
            byLevel_[static_cast<std::size_t>(levels.level[static_cast<std::size_t>(e)])].push_back(e);
        for (std::size_t l = 0; l < byLevel_.size(); ++l)
            updates_ += static_cast<long long>(byLevel_[l].size()) << (byLevel_.size() - 1 - l);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }
    bool checksFinite() const override { return true; }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        const std::size_t n = clock_.size();
        std::copy(state.x.begin(), state.x.end(), x_.begin());
        double *u = x_.data(), *v = u + n;
        std::fill(clock_.begin(), clock_.end(), 0);
        const double tick = h_ / static_cast<double>(ticks_);
        const auto drift = [&](std::size_t a, long long tau) {
            u[a] += static_cast<double>(tau - clock_[a]) * tick * v[a];
            clock_[a] = tau;
        };
        for (long long tau = 1; tau < ticks_; ++tau) {
            const int level = __builtin_ctzll(static_cast<unsigned long long>(tau));
            const double step = tick * static_cast<double>(2LL << level);
            for (const int e : byLevel_[static_cast<std::size_t>(level)]) {
                for (const int a : forces_.nodesOf(e)) drift(static_cast<std::size_t>(a), tau);
                forces_.kick(e, step, u, v);
            }
            if ((tau & 0xfff) == 0 && stop().stop_requested()) {
                report.outcome = Outcome::stopped;
                return report;
            }
        }
        for (std::size_t a = 0; a < n; ++a) drift(a, ticks_);
        report.cost.evaluations = updates_;
        double sum = 0;
        for (const double value : x_) sum += 0 * value;
        if (sum != 0) {
            report.outcome = Outcome::notFinite;
            return report;
        }
        state.x.swap(x_);
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        State state;
        state.x = x_;  // the state before
        if (tau > 0) {
            DyadicSteps shorter = *this;
            shorter.setStep(tau * h_);
            (void)shorter.advance(state, 0);
        }
        std::copy(state.x.begin(), state.x.end(), x.begin());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<DyadicSteps>(*this); }

private:
    Forces forces_;
    long long ticks_;  ///< of half the smallest step, in one step of the highest level
    std::vector<std::vector<int>> byLevel_;
    double h_;
    long long updates_ = 0;         ///< in one step
    std::vector<long long> clock_;  ///< of the nodes, in ticks
    std::vector<double> x_;
};

}  // namespace

template <class Forces>
std::unique_ptr<Integrator> makeDyadicSteps(Forces forces, const Levels& levels, double step) {
    return std::make_unique<DyadicSteps<Forces>>(std::move(forces), levels, step);
}
template std::unique_ptr<Integrator> makeDyadicSteps(BarForces, const Levels&, double);
template std::unique_ptr<Integrator> makeDyadicSteps(MembraneForces, const Levels&, double);

}  // namespace extremal
