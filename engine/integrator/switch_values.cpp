// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/switch_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {
namespace {

constexpr double switchRoundOff = std::numeric_limits<double>::epsilon();
constexpr double partOfTime = 1e-6;  ///< of central differences

}  // namespace

SwitchValues::SwitchValues(std::shared_ptr<const typed::Branches> branches)
    : branches_(std::move(branches)), inputs_(2 * static_cast<std::size_t>(branches_->dimension()) + 1) {}

double SwitchValues::at(std::size_t k, double t, const double* x, const Mechanics<double>& mechanics,
                        const typed::Branches::Cells& cells) {
    const auto d = static_cast<std::size_t>(mechanics.dimension);
    std::copy_n(x, d, inputs_.begin());
    inputs_[2 * d] = t;
    if (branches_->hasVelocities(k) &&
        !mechanics.velocity(mechanics.model.get(), t, x, x + d, inputs_.data() + d))
        return std::numeric_limits<double>::quiet_NaN();
    return branches_->argument(k, inputs_.data(), cells);
}

typed::Branches::Cells SwitchValues::cells(double t, const double* x, const Mechanics<double>& mechanics) {
    typed::Branches::Cells found(branches_->size(), 1);
    for (std::size_t k = 0; k < found.size(); ++k)
        found[k] = branches_->cellOf(k, at(k, t, x, mechanics, found));
    return found;
}

Eigen::VectorXd SwitchValues::flow(double t, const double* x, const Mechanics<double>& mechanics) const {
    const int d = mechanics.dimension;
    Eigen::VectorXd f(2 * d);
    if (!mechanics.flow(mechanics.model.get(), t, x, x + d, f.data(), f.data() + d))
        f.setConstant(std::numeric_limits<double>::quiet_NaN());
    return f;
}

double SwitchValues::rate(std::size_t k, double t, const double* x, double time,
                          const Mechanics<double>& mechanics, const typed::Branches::Cells& cells) {
    const double delta = partOfTime * std::abs(time);
    const Eigen::VectorXd here = Eigen::Map<const Eigen::VectorXd>(x, 2 * mechanics.dimension),
                          change = delta * flow(t, x, mechanics);
    const Eigen::VectorXd later = here + change, earlier = here - change;
    return (at(k, t + delta, later.data(), mechanics, cells) -
            at(k, t - delta, earlier.data(), mechanics, cells)) /
           (2 * delta);
}

double SwitchValues::laterRate(std::size_t k, double t, const double* x, double time,
                               const Mechanics<double>& mechanics, const typed::Branches::Cells& cells) {
    const double delta = std::sqrt(partOfTime) * time;
    const Eigen::VectorXd later =
        Eigen::Map<const Eigen::VectorXd>(x, 2 * mechanics.dimension) + delta * flow(t, x, mechanics);
    return rate(k, t + delta, later.data(), time, mechanics, cells);
}

Eigen::VectorXd SwitchValues::gradient(std::size_t k, double t, const double* x,
                                       const Mechanics<double>& mechanics,
                                       const typed::Branches::Cells& cells) {
    Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(x, 2 * mechanics.dimension), slope(moved);
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
        const double before = moved(i), delta = 1e-6 * std::max(1.0, std::abs(before));
        moved(i) = before + delta;
        const double above = at(k, t, moved.data(), mechanics, cells);
        moved(i) = before - delta;
        slope(i) = (above - at(k, t, moved.data(), mechanics, cells)) / (2 * delta);
        moved(i) = before;
    }
    return slope;
}

double SwitchValues::noise(std::size_t k, double t, const double* x, const Mechanics<double>& mechanics,
                           const typed::Branches::Cells& cells) {
    constexpr double part = 1e-7;
    const double here = at(k, t, x, mechanics, cells);
    double sum = std::abs(here) + std::abs(at(k, t * (1 + part), x, mechanics, cells) - here) / part;
    Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(x, 2 * mechanics.dimension);
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
        const double before = moved(i);
        moved(i) = before * (1 + part);
        sum += std::abs(at(k, t, moved.data(), mechanics, cells) - here) / part;
        moved(i) = before;
    }
    return std::isfinite(sum) ? 16 * switchRoundOff * sum : 0;
}

}  // namespace extremal
