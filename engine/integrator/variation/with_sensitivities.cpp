// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/with_sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/integrator/variation/accompanied.hpp"

namespace extremal {
namespace {

std::vector<std::string> namesOf(const std::vector<SensitivityColumn>& numbers,
                                 const std::vector<std::string>& entries) {
    std::vector<std::string> names;
    for (const SensitivityColumn& number : numbers)
        for (const std::string& entry : entries) names.push_back("sensitivity." + number.name + "." + entry);
    return names;
}

class WithSensitivities final : public Accompanied {
public:
    WithSensitivities(std::unique_ptr<Integrator> scheme, std::unique_ptr<Integrator> along,
                      std::vector<double> parameters, std::vector<SensitivityColumn> numbers,
                      const std::vector<std::string>& entries)
        : Accompanied(std::move(scheme), numbers.size() * entries.size(), namesOf(numbers, entries)),
          along_(std::move(along)),
          parameters_(std::move(parameters)),
          numbers_(std::move(numbers)),
          d_(entries.size() / 2) {
        const std::size_t all = d_ + parameters_.size();
        at_.x.resize(2 * all);
        varied_.resize(along_ ? numbers_.size() * 2 * all : 0);
    }
    WithSensitivities(const WithSensitivities& other)
        : Accompanied(other),
          along_(other.along_ ? other.along_->clone() : nullptr),
          parameters_(other.parameters_),
          numbers_(other.numbers_),
          d_(other.d_),
          at_(other.at_),
          varied_(other.varied_) {}
    WithSensitivities& operator=(const WithSensitivities&) = delete;
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithSensitivities>(*this); }
    void setStep(double h) override {
        Accompanied::setStep(h);
        if (along_) along_->setStep(h);
    }
    bool checkpoint(Archive& archive) override {
        return Accompanied::checkpoint(archive) && (!along_ || along_->checkpoint(archive));
    }

private:
    void startCarrying(const State& /*state*/, std::span<double> carried) override {
        auto place = carried.begin();
        for (const SensitivityColumn& number : numbers_)
            place = std::copy(number.start.begin(), number.start.end(), place);
        std::copy(carried.begin(), carried.end(), values_.begin());
    }

    void carry(const State& before, const State& after, const StepReport& report,
               std::span<double> carried) override {
        const bool isKnown = report.event == StepEvent::none &&
                             (along_ ? moveAlong(before, after, carried) : applyTangent(carried));
        if (!isKnown) std::fill(carried.begin(), carried.end(), std::numeric_limits<double>::quiet_NaN());
        std::copy(carried.begin(), carried.end(), values_.begin());
    }

    /// The step from `before` once more, with the parameters as coordinates, and its tangent map on the
    /// columns. A code that chooses its steps is given that of the scheme, and takes it.
    bool moveAlong(const State& before, const State& after, std::span<double> carried) {
        const std::size_t u = parameters_.size(), all = d_ + u;
        at_.t = before.t;
        at_.node = before.node;
        std::copy_n(before.x.data(), d_, at_.x.data());
        std::copy(parameters_.begin(), parameters_.end(), at_.x.begin() + static_cast<std::ptrdiff_t>(d_));
        std::copy_n(before.x.data() + d_, d_, at_.x.data() + all);
        std::fill_n(at_.x.data() + all + d_, u, 0.0);
        if (along_->grid() == TimeGrid::landing) at_.memory.assign(1, std::abs(after.t - before.t));
        along_->setStop(stop());
        if (along_->advance(at_, after.t).outcome != Outcome::converged || at_.t != after.t ||
            !isSameState(after))
            return false;
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            const double* const column = carried.data() + i * 2 * d_;
            double* const w = varied_.data() + i * 2 * all;
            std::copy_n(column, d_, w);
            std::copy(numbers_[i].parameters.begin(), numbers_[i].parameters.end(), w + d_);
            std::copy_n(column + d_, d_, w + all);
            std::fill_n(w + all + d_, u, 0.0);
        }
        if (!along_->applyTangent(varied_)) return false;
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            double* const column = carried.data() + i * 2 * d_;
            const double* const w = varied_.data() + i * 2 * all;
            std::copy_n(w, d_, column);
            std::copy_n(w + all, d_, column + d_);
        }
        return true;
    }
    /// Iterations end at different round-off; another root of the equations of a step is far away.
    bool isSameState(const State& after) const {
        constexpr double same = 1e-6;
        const std::size_t all = d_ + parameters_.size();
        double largest = 0, apart = 0;
        for (std::size_t i = 0; i < 2 * d_; ++i) {
            const double x = after.x[i];
            largest = std::max(largest, std::abs(x));
            apart = std::max(apart, std::abs(at_.x[i < d_ ? i : i + all - d_] - x));
        }
        return apart <= same * largest;
    }

    std::unique_ptr<Integrator> along_;
    std::vector<double> parameters_;
    std::vector<SensitivityColumn> numbers_;
    std::size_t d_;               ///< coordinates of the scheme
    State at_;                    ///< of `along`
    std::vector<double> varied_;  ///< columns of its variations
};

}  // namespace

std::unique_ptr<Integrator> withSensitivities(std::unique_ptr<Integrator> scheme,
                                              std::unique_ptr<Integrator> along,
                                              std::vector<double> parameters,
                                              std::vector<SensitivityColumn> numbers,
                                              const std::vector<std::string>& entries) {
    return std::make_unique<WithSensitivities>(std::move(scheme), std::move(along), std::move(parameters),
                                               std::move(numbers), entries);
}

}  // namespace extremal
