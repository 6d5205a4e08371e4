// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/core/work.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal {
namespace {

/// The operations of one evaluation of L and its derivatives; an entry each where L is not typed.
double workOf(const Mechanical& mechanics) {
    const double size = 2 * mechanics.dimension;
    const typed::Tape* const tape = typed::jetTapeOf(mechanics);
    return size * size + (tape ? static_cast<double>(tape->length()) : 0);
}

}  // namespace

StateSampler::StateSampler(const Mechanical& mechanics, unsigned seed)
    : mechanics_(&mechanics),
      work_(workOf(mechanics)),
      random_(seed),
      landmarks_(typed::landmarksOf(mechanics)) {
    const auto d = static_cast<std::size_t>(mechanics.dimension);
    gradient_.resize(2 * d);
    hessian_.resize(4 * d * d);
    // The time of a motion across the sampled places, as the median of some.
    std::vector<double> periods;
    SampledState state;
    for (int k = 0; k < 15; ++k) {
        draw(state);
        double q = 0, v = 0;
        for (std::size_t i = 0; i < d; ++i) {
            q = std::max(q, std::abs(state.q[i]));
            v = std::max(v, std::abs(state.v[i]));
        }
        if (v > 0 && std::isfinite(q / v)) periods.push_back(q / v);
    }
    if (periods.empty()) return;
    std::nth_element(periods.begin(), periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2),
                     periods.end());
    period_ = periods[periods.size() / 2];
}

double StateSampler::jet(double t, const double* q, const double* v, double* gradient) const {
    work::spend(work_);
    double L = 0;
    mechanics_->jet(mechanics_->model.get(), t, q, v, &L, gradient, hessian_.data());
    return L;
}

double StateSampler::value(double t, const double* q, const double* v) const {
    return jet(t, q, v, gradient_.data());
}

double StateSampler::timeDerivative(double t, const double* q, const double* v) const {
    if (!mechanics_->isTimeDependent) return 0;
    constexpr std::array<double, 4> weights = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
    double best = 0, least = INFINITY, last = NAN, step = period_;
    for (int k = 0; k < 12; ++k, step /= 2) {
        double sum = 0;
        for (std::size_t j = 0; j < weights.size(); ++j) {
            const double delta = static_cast<double>(j + 1) * step;
            sum += weights[j] * (value(t + delta, q, v) - value(t - delta, q, v));
        }
        const double now = sum / step, change = std::abs(now - last);
        if (change < least) {
            least = change;
            best = now;
        }
        last = now;
    }
    return best;
}

void StateSampler::draw(SampledState& state) {
    const auto d = static_cast<std::size_t>(mechanics_->dimension);
    state.q.resize(d);
    state.v.assign(d, 0);
    state.gradient.resize(2 * d);
    const double size = std::pow(10.0, 0.75 * uniform() + 0.25);
    for (double& q : state.q) q = size * uniform();
    state.t = period_ * uniform();
    value(state.t, state.q.data(), state.v.data());
    double force = 0;
    for (std::size_t i = 0; i < d; ++i) force = std::max(force, std::abs(gradient_[i]));
    const auto alone = static_cast<std::size_t>(random_() % d);
    const bool isSparse = drawn_++ % 2 == 1;
    for (std::size_t i = 0; i < d; ++i) {
        const double mass = std::abs(hessian_[(d + i) * 2 * d + d + i]);
        // A subnormal mass has hardly any digits, and would make the speed huge.
        const bool isHeavy = mass >= std::numeric_limits<double>::min();
        const double speed = force > 0 && isHeavy ? std::sqrt(force * size / mass) : size;
        const double v = speed * uniform();
        if (!isSparse || i == alone) state.v[i] = v;
    }
}

bool StateSampler::evaluate(SampledState& state) {
    state.L = jet(state.t, state.q.data(), state.v.data(), state.gradient.data());
    state.Lt = timeDerivative(state.t, state.q.data(), state.v.data());
    return std::isfinite(state.L) && std::isfinite(state.Lt) &&
           std::all_of(state.gradient.begin(), state.gradient.end(),
                       [](double g) { return std::isfinite(g); });
}

bool StateSampler::next(SampledState& state) {
    for (int attempt = 0; attempt < 50; ++attempt) {
        draw(state);
        if (evaluate(state)) return true;
    }
    return false;
}

int StateSampler::statesAtLandmarks() const {
    constexpr int each = 24, most = 240;
    return landmarks_ ? static_cast<int>(std::min<std::size_t>(most, each * landmarks_->size())) : 0;
}

bool StateSampler::nextAtLandmarks(SampledState& state) {
    draw(state);
    const auto d = static_cast<std::size_t>(mechanics_->dimension);
    std::vector<double> inputs(state.q);
    inputs.insert(inputs.end(), state.v.begin(), state.v.end());
    inputs.push_back(state.t);
    std::vector<std::size_t> order(landmarks_->size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random_);
    // One of them, or all in turn: what lies at x = 50, y = 50 is seen where both sums vanish.
    if (random_() % 2 == 0) order.resize(1);
    for (const std::size_t k : order) {
        const std::vector<int>& symbols = landmarks_->symbols(k);
        double& moved = inputs[static_cast<std::size_t>(symbols[random_() % symbols.size()])];
        moved = typed::nearZero(
            [&](double value) {
                const double before = std::exchange(moved, value),
                             result = landmarks_->value(k, inputs.data());
                moved = before;
                return result;
            },
            moved, random_);
    }
    std::copy_n(inputs.begin(), d, state.q.begin());
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(d), d, state.v.begin());
    state.t = inputs.back();
    return evaluate(state);
}

}  // namespace extremal
