// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/family/asynchronous/steps.hpp"

namespace extremal {
namespace {

template <class Elements>
class DyadicSteps final : public Integrator {
public:
    DyadicSteps(Elements elements, const Levels& levels, double step)
        : elements_(std::move(elements)),
          ticks_(2LL << levels.highest),
          byLevel_(static_cast<std::size_t>(levels.highest) + 1),
          h_(step),
          clock_(static_cast<std::size_t>(elements_.nodes())),
          x_(2 * clock_.size()) {
        for (int e = 0; e < elements_.elements(); ++e)
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
        const bool isWhole = sweep([&](std::size_t a, double time) { u[a] += time * v[a]; },
                                   [&](int e, double time) { elements_.kick(e, time, u, v); });
        if (!isWhole) {
            report.outcome = Outcome::stopped;
            return report;
        }
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
            advanceForDenseOutput(shorter, state, 0);
        }
        std::copy(state.x.begin(), state.x.end(), x.begin());
    }
    /// Of the values at nodes that are not fixed, and of their momenta m v.
    std::size_t tangentSize() const override {
        std::size_t free = 0;
        for (std::size_t a = 0; a < clock_.size(); ++a) free += elements_.inverseMass(a) > 0;
        return 2 * free;
    }
    /// The drifts and kicks once more, with the variations.
    bool applyTangent(std::span<double> W) override {
        const std::size_t n = clock_.size(), size = tangentSize();
        std::vector<double> x = x_, all(W.size() / size * 2 * n, 0.0);  // x_: the state before
        const auto exchange = [&](bool isIn) {
            for (std::size_t c = 0; c < W.size() / size; ++c)
                for (std::size_t a = 0, i = 0; a < n; ++a) {
                    const double inverse = elements_.inverseMass(a);
                    if (!(inverse > 0)) continue;
                    double *w = W.data() + c * size + i++, *own = all.data() + c * 2 * n + a;
                    if (isIn)
                        own[0] = w[0], own[n] = w[size / 2] * inverse;
                    else
                        w[0] = own[0], w[size / 2] = own[n] / inverse;
                }
        };
        exchange(true);
        const auto drift = [&](std::size_t a, double time) {
            x[a] += time * x[n + a];
            for (std::size_t c = 0; c < all.size(); c += 2 * n) all[c + a] += time * all[c + n + a];
        };
        const auto kick = [&](int e, double time) {
            for (std::size_t c = 0; c < all.size(); c += 2 * n)
                elements_.vary(e, time, x.data(), all.data() + c, all.data() + c + n);
            elements_.kick(e, time, x.data(), x.data() + n);
        };
        if (!sweep(drift, kick)) return false;
        exchange(false);
        return true;
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<DyadicSteps>(*this); }

private:
    /// One step: each element in its turn, after drift(a, time) of its nodes up to then, is kicked by kick(e,
    /// time). False where it was stopped.
    template <class Drift, class Kick>
    bool sweep(const Drift& drift, const Kick& kick) {
        std::fill(clock_.begin(), clock_.end(), 0);
        const double tick = h_ / static_cast<double>(ticks_);
        const auto driftTo = [&](std::size_t a, long long tau) {
            drift(a, static_cast<double>(tau - clock_[a]) * tick);
            clock_[a] = tau;
        };
        for (long long tau = 1; tau < ticks_; ++tau) {
            const int level = __builtin_ctzll(static_cast<unsigned long long>(tau));
            const double step = tick * static_cast<double>(2LL << level);
            for (const int e : byLevel_[static_cast<std::size_t>(level)]) {
                for (const int a : elements_.nodesOf(e)) driftTo(static_cast<std::size_t>(a), tau);
                kick(e, step);
            }
            if ((tau & 0xfff) == 0 && stop().stop_requested()) return false;
        }
        for (std::size_t a = 0; a < clock_.size(); ++a) driftTo(a, ticks_);
        return true;
    }

    Elements elements_;
    long long ticks_;  ///< of half the smallest step, in one step of the highest level
    std::vector<std::vector<int>> byLevel_;
    double h_;
    long long updates_ = 0;         ///< in one step
    std::vector<long long> clock_;  ///< of the nodes, in ticks
    std::vector<double> x_;
};

}  // namespace

template <class Elements>
std::unique_ptr<Integrator> makeDyadicSteps(Elements elements, const Levels& levels, double step) {
    return std::make_unique<DyadicSteps<Elements>>(std::move(elements), levels, step);
}
template std::unique_ptr<Integrator> makeDyadicSteps(BarElements, const Levels&, double);
template std::unique_ptr<Integrator> makeDyadicSteps(MembraneElements, const Levels&, double);

}  // namespace extremal
