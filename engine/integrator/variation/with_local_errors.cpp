// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/with_local_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/integrator/variation/accompanied.hpp"

namespace extremal {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

double lengthOf(std::span<const double> x) {
    double sum = 0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum);
}

class WithLocalErrors final : public Accompanied {
public:
    WithLocalErrors(std::unique_ptr<Integrator> scheme, std::unique_ptr<Integrator> better, bool halves,
                    int order, std::size_t n)
        : Accompanied(std::move(scheme), n + 1,
                      {"local_error", "transported_error", "local_error_sum", "amplification"}),
          better_(std::move(better)),
          isHalved_(halves),
          factor_(halves ? 1 / (1 - std::exp2(-order)) : 1),
          moved_(n) {}
    WithLocalErrors(const WithLocalErrors& other)
        : Accompanied(other),
          better_(other.better_->clone()),
          isHalved_(other.isHalved_),
          factor_(other.factor_),
          moved_(other.moved_),
          trial_(other.trial_) {}
    WithLocalErrors& operator=(const WithLocalErrors&) = delete;
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithLocalErrors>(*this); }
    bool checkpoint(Archive& archive) override {
        return Accompanied::checkpoint(archive) && better_->checkpoint(archive);
    }
    void setStep(double h) override {
        Accompanied::setStep(h);
        better_->setStep(isHalved_ ? h / 2 : h);
    }

private:
    /// A better step from where the scheme began, into trial_; false where it does not succeed.
    bool tryBetter(const State& from, double until) {
        trial_.t = from.t;
        trial_.node = isHalved_ ? 2 * from.node : from.node;
        trial_.x.assign(from.x.begin(), from.x.end());
        trial_.memory.clear();
        better_->setStop(stop());
        better_->begin(trial_);
        if (isHalved_ &&
            better_->advance(trial_, from.t + (until - from.t) / 2).outcome != Outcome::converged)
            return false;
        return better_->advance(trial_, until).outcome == Outcome::converged;
    }
    /// Carried: e, and the sum of all |d_k|.
    void carry(const State& before, const State& after, const StepReport& report,
               std::span<double> carried) override {
        const std::span<double> e = carried.first(moved_.size());
        const double size = lengthOf(e);
        std::copy(e.begin(), e.end(), moved_.begin());
        if (report.event != StepEvent::none || !applyTangent(moved_) || !tryBetter(before, after.t)) {
            std::fill(carried.begin(), carried.end(), notKnown);
            std::fill(values_.begin(), values_.end(), notKnown);
            return;
        }
        double local = 0;
        for (std::size_t i = 0; i < e.size(); ++i) {
            const double d = factor_ * (after.x[i] - trial_.x[i]);
            e[i] = moved_[i] + d;
            if (i < e.size() / 2) local += d * d;
        }
        values_[0] = std::sqrt(local);
        values_[1] = lengthOf(e.first(e.size() / 2));
        values_[2] = carried.back() += values_[0];
        values_[3] = size > 0 ? lengthOf(moved_) / size : notKnown;
    }

    std::unique_ptr<Integrator> better_;
    bool isHalved_;
    double factor_;
    std::vector<double> moved_;  ///< M e
    State trial_;
};

}  // namespace

std::unique_ptr<Integrator> withLocalErrors(std::unique_ptr<Integrator> scheme,
                                            std::unique_ptr<Integrator> better, bool halves, int order) {
    const std::size_t n = scheme->tangentSize();
    return std::make_unique<WithLocalErrors>(std::move(scheme), std::move(better), halves, order, n);
}

}  // namespace extremal
