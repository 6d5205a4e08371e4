// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/plane_start.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

/// The least H along p_i, where there is one, and steps away from it that change H.
struct Bottom {
    double p = 0, H = 0, reach = 1;
};
template <class Energy>
std::optional<Bottom> bottomOf(const Energy& H, double E, double scale) {
    constexpr int mostScalings = 400, mostSteps = 30;
    constexpr double enough = 1e-2;
    // H(p + s) - 2 H(p) + H(p - s) is 2 a s^2 of a quadratic, for every s; s is so large that it is seen.
    double p = 0, s = scale > 0 ? scale : 1;
    const auto second = [&] { return H(p + s) - 2 * H(p) + H(p - s); };
    const double size = std::max(std::abs(H(0)), std::abs(E));
    for (int i = 0; i < mostScalings && std::abs(second()) < enough * size; ++i) s *= 4;
    for (int i = 0; i < mostSteps; ++i) {
        const double curvature = second() / (s * s);
        if (!(curvature > 0) || !std::isfinite(curvature)) return {};
        const double move = -(H(p + s) - H(p - s)) / (2 * s * curvature);
        p += move;
        if (std::abs(move) <= 1e-14 * (std::abs(p) + s)) break;
    }
    const double least = H(p);
    if (!std::isfinite(least)) return {};
    return Bottom{p, least, s};
}

bool reaches(const Bottom& bottom, double E) {
    return bottom.H <= E + 1e-14 * std::max(std::abs(bottom.H), std::abs(E));
}

/// The momentum above the bottom with H = E, which is reached.
template <class Energy>
std::optional<double> momentumWith(const Energy& H, double E, const Bottom& bottom) {
    constexpr int mostDoublings = 1000;
    if (bottom.H >= E) return bottom.p;
    double reach = bottom.reach;
    for (int i = 0; i < mostDoublings && !(H(bottom.p + reach) >= E); ++i) reach *= 2;
    const double above = H(bottom.p + reach) - E;
    if (!(above >= 0) || !std::isfinite(above)) return {};
    if (above == 0) return bottom.p + reach;
    std::uintmax_t evaluations = 200;
    const auto found = boost::math::tools::toms748_solve(
        [&](double p) { return H(p) - E; }, bottom.p, bottom.p + reach, bottom.H - E, above,
        boost::math::tools::eps_tolerance<double>(), evaluations);
    return (found.first + found.second) / 2;
}

}  // namespace

/// The places of a section that the energy admits, joined with one of them.
struct StartPlane::Region {
    const StartPlane& plane;
    double x, y;  ///< where it begins

    bool admits(double u, double v) const { return plane.admits(u, v); }
    bool isJoined(double u, double v) const {
        constexpr int places = 8;
        for (int k = places; k >= 1; --k)
            if (!admits(x + (u - x) * k / places, y + (v - y) * k / places)) return false;
        return true;
    }
    /// How far it goes in a direction; none where that has no end.
    std::optional<double> reach(double dx, double dy) const {
        constexpr int mostDoublings = 60, bisections = 40;
        double low = 0, high = 1e-6;
        for (int i = 0; admits(x + high * dx, y + high * dy); ++i) {
            if (i == mostDoublings) return {};
            low = high;
            high *= 1.5;
        }
        for (int i = 0; i < bisections; ++i) {
            const double middle = (low + high) / 2;
            (admits(x + middle * dx, y + middle * dy) ? low : high) = middle;
        }
        return low;
    }
    /// A rectangle around it, from rays in many directions.
    std::optional<PlaneBox> box() const {
        constexpr int rays = 32;
        std::array<double, 2> unit{};
        for (const bool isX : {true, false}) {
            const double dx = isX ? 1 : 0, dy = isX ? 0 : 1;
            const auto ahead = reach(dx, dy), behind = reach(-dx, -dy);
            if (!ahead || !behind) return {};
            unit[isX ? 0 : 1] = std::max(*ahead, *behind);
        }
        PlaneBox all{x, x, y, y};
        for (int k = 0; k < rays; ++k) {
            const double angle = 2 * std::numbers::pi * k / rays, dx = unit[0] * std::cos(angle),
                         dy = unit[1] * std::sin(angle);
            const auto length = reach(dx, dy);
            if (!length) return {};
            all.left = std::min(all.left, x + *length * dx);
            all.right = std::max(all.right, x + *length * dx);
            all.bottom = std::min(all.bottom, y + *length * dy);
            all.top = std::max(all.top, y + *length * dy);
        }
        return all;
    }
};

std::string startProblem(const System& system, const ViewPlane& plane) {
    if (!system.hasCoordinates()) return "need a system with coordinates";
    const std::vector<Quantity> columns = stateColumns(system);
    const auto x = indexOf(columns, plane.x), y = indexOf(columns, plane.y);
    for (const auto& [place, name] : {std::pair{x, plane.x}, std::pair{y, plane.y}})
        if (!place) return "need state columns along both axes, and " + name + " is not one";
    if (*x == *y) return "need two different columns along the axes";
    if (plane.at.empty()) return {};
    const auto d = static_cast<std::size_t>(system.dimension());
    const auto at = indexOf(columns, plane.at);
    if (!at || *at >= d) return "need a section of a coordinate, and " + plane.at + " is not one";
    for (const std::size_t column : {*x, *y})
        if (column == *at || column == *at + d)
            return "need other axes than " + plane.at +
                   " and its momentum, which the section and the energy "
                   "give";
    return {};
}

StartPlane::StartPlane(const System& system, State initial, const ViewPlane& plane)
    : initial_(std::move(initial)),
      energy_(energyOf(system)),
      x_(*indexOf(stateColumns(system), plane.x)),
      y_(*indexOf(stateColumns(system), plane.y)),
      isSection_(!plane.at.empty()) {
    if (!isSection_) return;
    const auto d = static_cast<std::size_t>(system.dimension());
    at_ = *indexOf(stateColumns(system), plane.at);
    momentum_ = at_ + d;
    E_ = energy_(initial_.t, initial_.x.data());
    momentumName_ = stateColumns(system)[momentum_].name;
    scale_ = std::abs(initial_.x[momentum_]);
    if (scale_ == 0)
        for (std::size_t i = d; i < 2 * d; ++i) scale_ = std::max(scale_, std::abs(initial_.x[i]));
}

std::vector<double> StartPlane::stateAt(double x, double y) const {
    std::vector<double> state = initial_.x;
    if (isSection_) state[at_] = 0;
    state[x_] = x;
    state[y_] = y;
    return state;
}

double StartPlane::energyWith(std::vector<double>& state, double p) const {
    state[momentum_] = p;
    return energy_(initial_.t, state.data());
}

bool StartPlane::admits(double x, double y) const {
    std::vector<double> state = stateAt(x, y);
    const auto bottom = bottomOf([&](double p) { return energyWith(state, p); }, E_, scale_);
    return bottom && reaches(*bottom, E_);
}

PlaneStart StartPlane::at(double x, double y) const {
    std::vector<double> state = stateAt(x, y);
    if (!isSection_) return {std::move(state), {}};
    const auto H = [&](double p) { return energyWith(state, p); };
    const auto bottom = bottomOf(H, E_, scale_);
    const std::string none =
        "no " + momentumName_ + " gives the energy " + formatNumber(E_, 4) + " of the start";
    if (bottom && !reaches(*bottom, E_))
        return {{}, none + ": it is at least " + formatNumber(bottom->H, 4) + " here"};
    const auto p = bottom ? momentumWith(H, E_, *bottom) : std::nullopt;
    if (!p) return {{}, none};
    state[momentum_] = *p;
    return {std::move(state), {}};
}

std::vector<std::pair<double, double>> StartPlane::spread(int count, const PlaneBox* box) const {
    constexpr int triesPerStart = 40;
    std::vector<std::pair<double, double>> places;
    Region region{*this, initial_.x[x_], initial_.x[y_]};
    std::optional<PlaneBox> around;
    if (box) {
        around = *box;
    } else if (isSection_) {
        if (!admits(region.x, region.y)) region.x = region.y = 0;
        if (admits(region.x, region.y)) around = region.box();
    }
    if (!around) return places;
    constexpr double plastic = 1.32471795724474602596;
    for (int k = 1; k <= triesPerStart * count && static_cast<int>(places.size()) < count; ++k) {
        const double a = std::fmod(0.5 + k / plastic, 1.0), b = std::fmod(0.5 + k / (plastic * plastic), 1.0);
        const double x = around->left + a * (around->right - around->left),
                     y = around->bottom + b * (around->top - around->bottom);
        if (!isSection_ || (box ? admits(x, y) : region.isJoined(x, y))) places.emplace_back(x, y);
    }
    return places;
}

std::vector<std::pair<double, double>> startsOf(const StartPlane& plane, const View& view) {
    std::vector<std::pair<double, double>> places;
    for (const auto& [x, y] : view.starts.points) places.emplace_back(x.value, y.value);
    if (view.starts.spread == 0) return places;
    std::optional<PlaneBox> box;
    if (view.xRange && view.yRange)
        box = PlaneBox{view.xRange->low.value, view.xRange->high.value, view.yRange->low.value,
                       view.yRange->high.value};
    const auto more = plane.spread(view.starts.spread, box ? &*box : nullptr);
    places.insert(places.end(), more.begin(), more.end());
    return places;
}

}  // namespace extremal
