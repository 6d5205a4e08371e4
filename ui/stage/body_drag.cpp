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

/// What J times the first entries of `rate` lacks of a velocity.
Point missingOf(const std::vector<double>& J, const std::vector<double>& rate, Point velocity) {
    const std::size_t d = J.size() / 3;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < d; ++i) velocity[k] -= J[k * d + i] * rate[i];
    return velocity;
}

}  // namespace

std::optional<Point> HeldPoint::in(const Drawing& drawing) const {
    if (shape >= drawing.shapes.size()) return {};
    if (const auto* disc = std::get_if<Disc>(&drawing.shapes[shape])) return disc->centre;
    const auto* solid = std::get_if<Solid>(&drawing.shapes[shape]);
    if (!solid || corner >= solid->corners.size()) return {};
    return solid->corners[corner];
}

bool hasMovableBodies(const System& system) {
    constexpr int most = 60;  // displacements, each of which is tried
    const Mechanical* const lagrangian = system.parts.find<Mechanical>();  // of a velocity given by hand
    const ByHand* const hand = system.parts.find<ByHand>();
    return system.draw && (lagrangian || (hand && hand->freedoms <= most));
}

BodyDrag::BodyDrag(std::shared_ptr<const System> system, State state, HeldPoint held)
    : system_(std::move(system)),
      hand_(system_->parts.find<ByHand>()),
      state_(std::move(state)),
      held_(held) {}

Point BodyDrag::placeOf(const std::vector<double>& x) const {
    Drawing drawing;
    system_->draw(x.data(), drawing);
    return held_.in(drawing).value_or(Point{});
}

std::size_t BodyDrag::freedoms() const {
    return static_cast<std::size_t>(hand_ ? hand_->freedoms : system_->dimension());
}

std::vector<double> BodyDrag::displaced(std::vector<double> x, const std::vector<double>& by) const {
    if (hand_)
        hand_->move(x.data(), by.data());
    else
        for (std::size_t i = 0; i < by.size(); ++i) x[i] += by[i];
    return x;
}

Drawing BodyDrag::drawing() const {
    Drawing drawing;
    system_->draw(state_.x.data(), drawing);
    return drawing;
}

std::vector<double> BodyDrag::slope() const {
    const std::size_t d = freedoms();
    std::vector<double> rows(3 * d), by(d);
    for (std::size_t i = 0; i < d; ++i) {
        const double step = 1e-6 * (hand_ ? 1 : 1 + std::abs(state_.x[i]));
        by[i] = step;
        const Point after = placeOf(displaced(state_.x, by));
        by[i] = -step;
        const Point ahead = placeOf(displaced(state_.x, by));
        by[i] = 0;
        for (std::size_t k = 0; k < 3; ++k) rows[k * d + i] = (after[k] - ahead[k]) / (2 * step);
    }
    return rows;
}

bool BodyDrag::moveTo(const Point& target) {
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
            std::vector<double> by = change;
            for (double& each : by) each *= part;
            state_.x = displaced(here.x, by);
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

bool BodyDrag::throwByHand(const Point& velocity) {
    const State before = state_;
    const std::size_t d = freedoms();
    const std::vector<double> J = slope();
    std::vector<double> rate(d);
    for (int correction = 0; correction < 3; ++correction) {
        if (!hand_->velocity(state_.x.data(), rate.data())) break;
        hand_->push(state_.x.data(), leastChange(J, missingOf(J, rate, velocity)).data());
    }
    const bool isSound =
        std::all_of(state_.x.begin(), state_.x.end(), [](double v) { return std::isfinite(v); });
    if (!isSound) state_ = before;
    return isSound && state_.x != before.x;
}

bool BodyDrag::throwWith(const Point& velocity) {
    if (hand_) return throwByHand(velocity);
    const auto d = static_cast<std::size_t>(system_->dimension());
    std::vector<double> rate(state_.x.size());
    if (!rateOf(*system_, state_.t, state_.x.data(), rate.data())) return false;
    const std::vector<double> J = slope();
    for (int correction = 0; correction < 3; ++correction) {
        const std::vector<double> change = leastChange(J, missingOf(J, rate, velocity));
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
