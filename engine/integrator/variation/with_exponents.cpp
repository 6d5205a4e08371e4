// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/with_exponents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "engine/integrator/variation/accompanied.hpp"

namespace extremal {
namespace {

std::vector<std::string> namesOf(std::size_t n) {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= n; ++i) names.push_back("lyapunov." + std::to_string(i));
    names.emplace_back("lyapunov_sum");
    return names;
}

class WithExponents final : public Accompanied {
public:
    WithExponents(std::unique_ptr<Integrator> scheme, std::size_t n, std::size_t free, TangentBasis basis)
        : Accompanied(std::move(scheme), numbersOf(n, free), namesOf(free)),
          n_(n),
          free_(free),
          basis_(std::move(basis)) {}
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WithExponents>(*this); }

private:
    /// The time of the start, the sums of logarithms, and the frame, column after column.
    static std::size_t numbersOf(std::size_t n, std::size_t free) { return 1 + free + n * free; }
    void startCarrying(const State& state, std::span<double> carried) override {
        carried[0] = state.t;
        double* const frame = carried.data() + 1 + free_;
        for (std::size_t i = 0; i < free_; ++i) frame[i * n_ + i] = 1;
        if (!basis_) return;
        const std::vector<double> basis = basis_(state.t, state.x.data());
        std::copy(basis.begin(), basis.end(), frame);
    }
    void carry(const State& /*before*/, const State& after, const StepReport& report,
               std::span<double> carried) override {
        const std::span<double> sums = carried.subspan(1, free_), frame = carried.subspan(1 + free_);
        if (report.event != StepEvent::none || !applyTangent(frame))
            std::fill(frame.begin(), frame.end(), std::numeric_limits<double>::quiet_NaN());
        orthonormalise(frame, sums);
        const double time = std::abs(after.t - carried[0]);
        for (std::size_t i = 0; i < free_; ++i) values_[i] = sums[i] / time;
        values_[free_] = std::accumulate(sums.begin(), sums.end(), 0.0) / time;
    }
    /// Gram and Schmidt, each column twice, so that the frame is orthogonal to round-off; ln R_ii is added.
    void orthonormalise(std::span<double> frame, std::span<double> sums) const {
        for (std::size_t j = 0; j < free_; ++j) {
            const std::span<double> column = frame.subspan(j * n_, n_);
            for (int again = 0; again < 2; ++again)
                for (std::size_t i = 0; i < j; ++i) {
                    const std::span<double> other = frame.subspan(i * n_, n_);
                    const double along = std::inner_product(column.begin(), column.end(), other.begin(), 0.0);
                    for (std::size_t k = 0; k < n_; ++k) column[k] -= along * other[k];
                }
            const double length =
                std::sqrt(std::inner_product(column.begin(), column.end(), column.begin(), 0.0));
            for (double& value : column) value /= length;
            sums[j] += std::log(length);
        }
    }

    std::size_t n_, free_;  ///< numbers of a variation, and how many are independent
    TangentBasis basis_;
};

}  // namespace

std::unique_ptr<Integrator> withExponents(std::unique_ptr<Integrator> scheme, TangentBasis basis, int free) {
    const std::size_t n = scheme->tangentSize();
    const std::size_t all = basis ? static_cast<std::size_t>(free) : n;
    return std::make_unique<WithExponents>(std::move(scheme), n, all, std::move(basis));
}

}  // namespace extremal
