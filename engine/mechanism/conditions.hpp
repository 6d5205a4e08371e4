// SPDX-License-Identifier: GPL-3.0-or-later
/// The rows that constraints and rolling conditions make together, constraints first:
///     g with 0 for rolling conditions,    [g_q; a],    [g_t; -b].
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>

#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/rolling.hpp"

namespace extremal {

class Conditions {
public:
    using Vector = Eigen::VectorXd;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    Conditions(std::optional<Constraint> holonomicOnes, std::optional<Rolling> rollingOnes, int dimension)
        : constraint(std::move(holonomicOnes)), rolling(std::move(rollingOnes)), d_(dimension) {
        if (!rolling) return;
        rest_ = Vector::Zero(d_);
        value_ = byTime_ = Vector::Zero(rolling->count());
        byState_ = Rows::Zero(rolling->count(), 2 * d_);
    }
    int holonomic() const { return constraint ? constraint->count() : 0; }
    int count() const { return holonomic() + (rolling ? rolling->count() : 0); }
    const std::string& nameOf(int row) const {
        return row < holonomic() ? constraint->names[static_cast<std::size_t>(row)]
                                 : rolling->names[static_cast<std::size_t>(row - holonomic())];
    }

    void evaluate(double t, const double* q, Vector& value, Rows& byPlace, Vector& byTime) {
        if (constraint)
            constraint->first(constraint->model.get(), t, q, value.data(), byPlace.data(), byTime.data());
        if (!rolling) return;
        const int n = rolling->count();
        rolling->first(rolling->model.get(), t, q, rest_.data(), value_.data(), byState_.data(),
                       byTime_.data());
        value.tail(n).setZero();
        byPlace.bottomRows(n) = byState_.rightCols(d_);
        byTime.tail(n) = value_;
    }
    /// v^T g_qq v + 2 g_qt v + g_tt, and what differentiated rolling conditions have besides a times the
    /// acceleration.
    void rates(double t, const double* q, const double* v, Vector& to) {
        if (constraint) constraint->rates(constraint->model.get(), t, q, v, to.data());
        if (!rolling) return;
        rolling->first(rolling->model.get(), t, q, v, value_.data(), byState_.data(), byTime_.data());
        to.tail(rolling->count()) = byState_.leftCols(d_) * Eigen::Map<const Vector>(v, d_) + byTime_;
    }

    std::optional<Constraint> constraint;
    std::optional<Rolling> rolling;

private:
    int d_;
    Vector value_, byTime_, rest_;  ///< of rolling conditions: r and r_t; no velocities
    Rows byState_;
};

}  // namespace extremal
