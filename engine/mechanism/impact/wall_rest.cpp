// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/impact/wall_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/mechanism/joined_constraints.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/model/parts/wall_contact.hpp"

namespace extremal {
namespace {

/// The parts with the gaps of these walls among the constraints.
Parts resting(const Parts& parts, const std::vector<int>& walls) {
    Parts with = parts;
    with.set(joinedConstraints(parts.find<Constraint>(), parts.find<WallContact>()->gaps, walls,
                               parts.find<Mechanics<double>>()->dimension));
    return with;
}

}  // namespace

bool WallRest::holds(int wall) const {
    const auto isIn = [wall](const std::vector<int>& all) {
        return std::find(all.begin(), all.end(), wall) != all.end();
    };
    return isIn(walls_) || isIn(alike_);
}

void WallRest::hold(const std::vector<int>& walls) {
    walls_ = walls;
    if (walls.empty()) return;
    const Parts with = resting(parts_, walls);
    mechanism_.emplace(with);
    scheme_ = OwnCopy<Integrator>(make_(with));
}

bool WallRest::settle(State& state, std::vector<int> touched, double h) {
    if (!parts_.find<WallContact>()) return false;
    const auto d = static_cast<std::size_t>(parts_.find<Mechanics<double>>()->dimension);
    const State given = state;
    alike_.clear();
    while (!touched.empty()) {
        walls_ = touched;
        mechanism_.emplace(resting(parts_, touched));
        state = given;
        Eigen::VectorXd v, kappa;
        std::optional<Weakest> found;
        const Mechanism::Rank rank = mechanism_->rank(state.t, state.x.data());
        if (rank.ratio > 1e-10 && mechanism_->project(state.t, state.x.data(), state.x.data() + d, v, kappa))
            found = weakestFor(state, h);
        if (found && found->pushes) {
            hold(touched);
            return true;
        }
        if (found) {
            std::erase(touched, found->wall);
            continue;
        }
        // Where walls say the same of a body (three legs on a table) it rests on the others.
        const int own = mechanism_->holonomic() - static_cast<int>(touched.size()),
                  row = rank.dependent - own;
        const bool isWall = row >= 0 && row < static_cast<int>(touched.size());
        const int left = isWall ? touched[static_cast<std::size_t>(row)] : touched.back();
        alike_.push_back(left);
        std::erase(touched, left);
    }
    leave();
    state = given;
    return false;
}

std::optional<WallRest::Weakest> WallRest::weakestFor(const State& state, double h) {
    const auto lambda = multipliers(state.t, state.x.data());
    if (!lambda) return {};
    const Wall& wall = *parts_.find<Wall>();
    const int d = mechanism_->dimension(), n = wall.count();
    std::vector<double> gap(static_cast<std::size_t>(n)), byPlace(static_cast<std::size_t>(n * d)),
        byTime(gap);
    wall.first(wall.model.get(), state.t, state.x.data(), gap.data(), byPlace.data(), byTime.data());
    Weakest found{walls_.front(), false};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < walls_.size(); ++i) {
        const double* const normal = byPlace.data() + walls_[i] * d;
        double mobility = 0;
        for (int k = 0; k < d; ++k) mobility += normal[k] * normal[k] / mechanism_->mass(k);
        const double entered = (*lambda)(static_cast<Eigen::Index>(i)) * mobility * h * h / 2,
                     rounding = Wall::rounding * Wall::terms(normal, state.x.data(), d);
        if (entered - rounding < least) {
            least = entered - rounding;
            found = {walls_[i], entered > rounding};
        }
    }
    return found;
}

std::optional<Eigen::VectorXd> WallRest::multipliers(double t, const double* x) {
    const auto& L = mechanism_->mechanics();
    std::vector<double> v(static_cast<std::size_t>(L.dimension));
    Eigen::VectorXd acceleration, lambda;
    if (!L.velocity(L.model.get(), t, x, x + L.dimension, v.data()) ||
        !mechanism_->accelerate(t, x, v.data(), acceleration, lambda))
        return {};
    // Behind the constraints of the system, in front of its rolling conditions.
    const auto own = static_cast<Eigen::Index>(walls_.size());
    return lambda.segment(mechanism_->holonomic() - own, own).eval();
}

std::optional<WallCrossing> WallRest::lift(const State& start, double h, int places) {
    at_.resize(start.x.size());
    for (int i = 0; i <= places; ++i) {
        const double tau = static_cast<double>(i) / places;
        scheme_->denseOutput(tau, at_);
        if (!(push(start.t + tau * h, at_.data()) >= 0))
            return WallCrossing{walls_.front(), std::max(0.0, static_cast<double>(i - 1) / places), tau};
    }
    return {};
}

int WallRest::weakest(const State& state) {
    const auto lambda = multipliers(state.t, state.x.data());
    Eigen::Index least = 0;
    if (lambda) lambda->minCoeff(&least);
    return walls_[static_cast<std::size_t>(least)];
}

double WallRest::push(double t, const double* x) {
    const auto lambda = multipliers(t, x);
    return lambda ? lambda->minCoeff() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace extremal
