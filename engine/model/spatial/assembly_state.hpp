// SPDX-License-Identifier: GPL-3.0-or-later
/// The bodies and points of a mechanism in space at a state (q, v) of its written Lagrangian.
#pragma once

#include <vector>

#include "engine/core/value.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

/// Which coordinates are whose.
class Coordinates {
public:
    explicit Coordinates(const Assembly& assembly);

    Place centre(const double* q, std::size_t body) const;
    Axes attitude(const double* q, std::size_t body) const;
    /// In space.
    Place angularVelocity(const double* q, const double* v, std::size_t body) const;
    /// The place of a point.
    Place at(const double* q, std::size_t point) const;
    /// The first coordinate of a point that moves by itself; -1 of others.
    int firstOf(std::size_t point) const { return points_[point]; }
    /// The coordinates of each body.
    std::vector<std::vector<int>> groups() const;
    int count() const { return count_; }

private:
    const Assembly& assembly_;
    std::vector<int> bodies_, points_;
    int count_ = 0;
};

/// The model with a state as its start; what is the same as before stays as it is written. Joints go with
/// their bodies.
Value withStart(const WrittenForm& form, const Value& model, const double* q, const double* v);

}  // namespace extremal::spatial
