#include "engine/integrator/with_local_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace extremal {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

double lengthOf(std::span<const double> x) {
    double sum = 0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum);
}

class WithLocalErrors final : public Integrator {
public:
    WithLocalErrors(std::unique_ptr<Integrator> scheme, std::unique_ptr<Integrator> better, bool halves,
                    int order)
        : scheme_(std::move(scheme)),
          better_(std::move(better)),
          isHalved_(halves),
          factor_(halves ? 1 / (1 - std::exp2(-order)) : 1),
          n_(scheme_->tangentSize()),
          moved_(n_),
          quantities_(scheme_->quantities().begin(), scheme_->quantities().end()),
          own_(quantities_.size()) {
        for (const char* name : {"local_error", "transported_error", "local_error_sum", "amplification"})
            quantities_.push_back({name, "", "", ""});
    }
    WithLocalErrors(const WithLocalErrors& other)
        : Integrator(other),
          scheme_(other.scheme_->clone()),
          better_(other.better_->clone()),
          isHalved_(other.isHalved_),
          factor_(other.factor_),
          n_(other.n_),
          inner_(other.inner_),
          moved_(other.moved_),
          quantities_(other.quantities_),
          own_(other.own_),
          values_(other.values_),
          state_(other.state_),
          trial_(other.trial_) {}
    WithLocalErrors& operator=(const WithLocalErrors&) = delete;

    TimeGrid grid() const override { return scheme_->grid(); }
    double stepSize() const override { return scheme_->stepSize(); }
    bool checksFinite() const override { return scheme_->checksFinite(); }
    std::size_t tangentSize() const override { return n_; }
    bool applyTangent(std::span<double> W) override { return scheme_->applyTangent(W); }
    void denseOutput(double tau, std::span<double> x) const override { scheme_->denseOutput(tau, x); }
    double periodsPerStep() const override { return scheme_->periodsPerStep(); }
    std::string about() const override { return scheme_->about(); }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithLocalErrors>(*this); }
    void setStep(double h) override {
        scheme_->setStep(h);
        better_->setStep(isHalved_ ? h / 2 : h);
    }

    std::vector<MemoryPart> memoryParts() const override {
        std::vector<MemoryPart> parts = scheme_->memoryParts();
        parts.push_back({"transported error", n_});
        parts.push_back({"sum of local errors", 1});
        return parts;
    }
    void begin(State& state) override {
        scheme_->begin(state);
        inner_ = state.memory.size();
        state.memory.resize(inner_ + n_ + 1, 0);
    }

    StepReport advance(State& state, double until) override {
        if (state.memory.empty()) begin(state);
        inner_ = state.memory.size() - n_ - 1;
        scheme_->setStop(stop());
        better_->setStop(stop());
        state_.t = state.t;
        state_.node = state.node;
        state_.x.assign(state.x.begin(), state.x.end());
        state_.memory.assign(state.memory.begin(),
                             state.memory.begin() + static_cast<std::ptrdiff_t>(inner_));
        const StepReport report = scheme_->advance(state_, until);
        if (report.outcome != Outcome::converged) return report;
        transport(state, until, report);
        state.t = state_.t;
        state.node = state_.node;
        state.x.swap(state_.x);
        std::copy(state_.memory.begin(), state_.memory.end(), state.memory.begin());
        return report;
    }

    std::span<const Quantity> quantities() const override { return quantities_; }
    void measure(const State& state, double* values) const override {
        if (own_ > 0) {
            State inner = state;
            inner.memory.resize(inner_);
            scheme_->measure(inner, values);
        }
        std::copy(values_.begin(), values_.end(), values + own_);
    }

private:
    /// A better step from where the scheme began, into trial_; false where it does not succeed.
    bool tryBetter(const State& from, double until) {
        trial_.t = from.t;
        trial_.node = isHalved_ ? 2 * from.node : from.node;
        trial_.x.assign(from.x.begin(), from.x.end());
        trial_.memory.clear();
        better_->begin(trial_);
        if (isHalved_ &&
            better_->advance(trial_, from.t + (until - from.t) / 2).outcome != Outcome::converged)
            return false;
        return better_->advance(trial_, until).outcome == Outcome::converged;
    }
    void transport(State& before, double until, const StepReport& report) {
        double* const e = before.memory.data() + inner_;
        double& sum = before.memory.back();
        const double size = lengthOf({e, n_});
        std::copy_n(e, n_, moved_.data());
        if (report.event != StepEvent::none || !scheme_->applyTangent(moved_) || !tryBetter(before, until))
            std::fill(moved_.begin(), moved_.end(), notKnown);
        values_[3] = size > 0 ? lengthOf(moved_) / size : notKnown;
        double local = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double d = factor_ * (state_.x[i] - trial_.x[i]);
            e[i] = moved_[i] + d;
            if (i < n_ / 2) local += d * d;
        }
        values_[0] = std::sqrt(local);
        values_[1] = lengthOf({e, n_ / 2});
        sum += values_[0];
        values_[2] = sum;
    }

    std::unique_ptr<Integrator> scheme_, better_;
    bool isHalved_;
    double factor_;
    std::size_t n_, inner_ = 0;  ///< of variations; memory of the scheme
    std::vector<double> moved_;  ///< M e
    std::vector<Quantity> quantities_;
    std::size_t own_;  ///< quantities of the scheme
    std::array<double, 4> values_{notKnown, notKnown, notKnown, notKnown};
    State state_, trial_;
};

}  // namespace

std::unique_ptr<Integrator> withLocalErrors(std::unique_ptr<Integrator> scheme,
                                            std::unique_ptr<Integrator> better, bool halves, int order) {
    return std::make_unique<WithLocalErrors>(std::move(scheme), std::move(better), halves, order);
}

}  // namespace extremal
