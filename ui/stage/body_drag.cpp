// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/body_drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "engine/core/problem.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {
namespace {

constexpr int mostCorrections = 20;

/// The solution of A x = b by elimination, of a symmetric positive definite matrix.
std::array<double, 3> solve(std::array<std::array<double, 3>, 3> A, std::array<double, 3> b) {
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = k + 1; i < 3; ++i) {
            const double factor = A[i][k] / A[k][k];
            for (std::size_t j = k; j < 3; ++j) A[i][j] -= factor * A[k][j];
            b[i] -= factor * b[k];
        }
    for (std::size_t k = 3; k-- > 0;) {
        for (std::size_t j = k + 1; j < 3; ++j) b[k] -= A[k][j] * b[j];
        b[k] /= A[k][k];
    }
    return b;
}

/// The least vector of d numbers whose image under the three rows J is nearly `wanted`.
std::vector<double> leastChange(const std::vector<double>& J, const Point& wanted) {
    const std::size_t d = J.size() / 3;
    std::array<std::array<double, 3>, 3> gram{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
            for (std::size_t i = 0; i < d; ++i) gram[k][l] += J[k * d + i] * J[l * d + i];
    const double scale = gram[0][0] + gram[1][1] + gram[2][2];
    std::vector<double> change(d);
    if (!(scale > 0) || !std::isfinite(scale)) return change;
    for (std::size_t k = 0; k < 3; ++k) gram[k][k] += 1e-6 * scale;
    const std::array<double, 3> weight = solve(gram, wanted);
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t k = 0; k < 3; ++k) change[i] += J[k * d + i] * weight[k];
    return change;
}

}  // namespace

bool hasMovableBodies(const System& system) {
    const Mechanical* const lagrangian = system.parts.find<Mechanical>();  // of a velocity given by hand
    return lagrangian && system.draw;
}

BodyDrag::BodyDrag(std::shared_ptr<const System> system, State state, std::size_t shape)
    : system_(std::move(system)), state_(std::move(state)), shape_(shape) {}

Point BodyDrag::placeOf(const std::vector<double>& x) const {
    Drawing drawing;
    system_->draw(x.data(), drawing);
    if (shape_ >= drawing.shapes.size()) return {};
    const auto* disc = std::get_if<Disc>(&drawing.shapes[shape_]);
    return disc ? disc->centre : Point{};
}

Drawing BodyDrag::drawing() const {
    Drawing drawing;
    system_->draw(state_.x.data(), drawing);
    return drawing;
}

std::vector<double> BodyDrag::slope() const {
    const auto d = static_cast<std::size_t>(system_->dimension());
    std::vector<double> rows(3 * d), x = state_.x;
    for (std::size_t i = 0; i < d; ++i) {
        const double by = 1e-6 * (1 + std::abs(x[i])), before = x[i];
        x[i] = before + by;
        const Point after = placeOf(x);
        x[i] = before - by;
        const Point ahead = placeOf(x);
        x[i] = before;
        for (std::size_t k = 0; k < 3; ++k) rows[k * d + i] = (after[k] - ahead[k]) / (2 * by);
    }
    return rows;
}

bool BodyDrag::moveTo(const Point& target) {
    const auto d = static_cast<std::size_t>(system_->dimension());
    const State before = state_;
    const auto distance = [&](const Point& p) {
        return std::hypot(p[0] - target[0], p[1] - target[1], p[2] - target[2]);
    };
    double best = distance(place());
    for (int k = 0; k < mostCorrections; ++k) {
        const Point at = place();
        const std::vector<double> change =
            leastChange(slope(), {target[0] - at[0], target[1] - at[1], target[2] - at[2]});
        // Shorter where the whole of it leads away, as around a circle.
        const State here = state_;
        bool isNearer = false;
        for (double part = 1; part > 0.05 && !isNearer; part /= 2) {
            for (std::size_t i = 0; i < d; ++i) state_.x[i] = here.x[i] + part * change[i];
            const double away = distance(place());
            isNearer = away < best;
            if (isNearer) best = away;
        }
        if (isNearer) continue;
        state_ = here;
        break;
    }
    try {
        putOnConstraints(*system_, state_, true);
    } catch (const InvalidScene&) {
        state_ = before;  // too far from the constraints
        return false;
    }
    const bool isSound =
        std::all_of(state_.x.begin(), state_.x.end(), [](double v) { return std::isfinite(v); });
    if (!isSound) state_ = before;
    return isSound;
}

bool BodyDrag::throwWith(const Point& velocity) {
    const auto d = static_cast<std::size_t>(system_->dimension());
    std::vector<double> rate(state_.x.size());
    if (!rateOf(*system_, state_.t, state_.x.data(), rate.data())) return false;
    const std::vector<double> J = slope();
    for (int correction = 0; correction < 3; ++correction) {
        Point missing = velocity;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < d; ++i) missing[k] -= J[k * d + i] * rate[i];
        const std::vector<double> change = leastChange(J, missing);
        for (std::size_t i = 0; i < d; ++i) rate[i] += change[i];
    }
    if (!std::all_of(rate.begin(), rate.end(), [](double v) { return std::isfinite(v); })) return false;
    const State before = state_;
    velocity_.assign(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(d));
    std::vector<double> gradient(2 * d);
    const Mechanical& m = system_->mechanics();
    m.gradient(m.model.get(), state_.t, state_.x.data(), velocity_.data(), gradient.data());
    std::copy(gradient.begin() + static_cast<std::ptrdiff_t>(d), gradient.end(),
              state_.x.begin() + static_cast<std::ptrdiff_t>(d));
    try {
        putOnConstraints(*system_, state_, true);
    } catch (const InvalidScene&) {
        state_ = before;
        return false;
    }
    // Of what constraints have left of it.
    if (rateOf(*system_, state_.t, state_.x.data(), rate.data()))
        velocity_.assign(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(d));
    return true;
}

}  // namespace extremal
