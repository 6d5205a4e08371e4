// SPDX-License-Identifier: GPL-3.0-or-later
/// A Lagrangian and a force in d + u coordinates, the last u of which are held at given values:
///
///     L(t, q, v) = L'(t, (q, u), (v, 0)),    F(t, q, v) likewise, on the first d coordinates.
///
/// The numbers u stand in the formulas as coordinates, so that derivatives by them are known
/// (scene/outlook/varied_scene.hpp), and are read from memory, so that they may change from step to step. The
/// motion of q is that of a system with d coordinates. Copies share the values; a system with them belongs to
/// one thread.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/force.hpp"

namespace extremal {

class HeldCoordinates {
public:
    /// `whole` in d + u coordinates.
    HeldCoordinates(Mechanics<double> whole, std::optional<Force> force, std::span<const double> values);

    int dimension() const;  ///< d
    int held() const;       ///< u
    std::span<double> values() const;
    const Mechanics<double>& whole() const;
    const std::optional<Force>& wholeForce() const;

    /// Of the first d coordinates.
    Mechanics<double> mechanics() const;
    std::optional<Force> force() const;

    struct Model;

private:
    std::shared_ptr<Model> model_;
};

}  // namespace extremal
