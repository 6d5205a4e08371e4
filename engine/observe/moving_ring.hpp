// SPDX-License-Identifier: GPL-3.0-or-later
/// A ring of 64 starts around the start of a run, which moves with the scheme, and the integral of the
/// one-form over it, int p dq or int theta (Poincaré): a symplectic step keeps it, whatever becomes of the
/// shape of the ring. Others do not, however well they keep the energy.
///
/// The ring is an ellipse in the plane of the first coordinate and its momentum (of a one-form its first q
/// and y), a twentieth of the state wide. Along it x is the trigonometric polynomial through the points, so
/// that the integral is exact as long as 64 points resolve the shape of the ring.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/clock.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal {

class MovingRing {
public:
    static constexpr int size = 64;
    /// The entries of the state that span the plane of the ring at the start.
    using Plane = std::array<std::size_t, 2>;
    static Plane planeOf(const System& system);

    /// The context has an integrator with a fixed step.
    explicit MovingRing(const ObserveContext& context);
    MovingRing(const MovingRing& other);
    MovingRing& operator=(const MovingRing&) = delete;

    /// Moves it to a node, which is not before the last one that was asked for. False where a point is lost.
    bool moveTo(long long node);
    double time() const { return states_.front().t; }
    /// At the node that it was moved to last.
    double integral() const;
    /// x, then y of the points in the plane, each `size` numbers.
    std::vector<double> points() const;
    void checkpoint(Archive& archive);

private:
    void coefficients(const std::vector<double>& x, std::vector<double>& theta) const;

    Clock clock_;
    int dimension_;
    std::optional<OneForm> form_;
    Plane plane_;
    std::array<State, size> states_;
    std::vector<std::unique_ptr<Integrator>> schemes_;
    bool isLost_ = false;
};

}  // namespace extremal
