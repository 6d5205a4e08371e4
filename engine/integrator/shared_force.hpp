// SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that one part of a composition hands to the next.
///
/// A method that ends its step with a kick and begins the next one with a kick needs the force there once. In
/// a composition each part has an integrator of its own, which would not know what the one before it has
/// computed at the place where it begins.
#pragma once

namespace extremal {

class SharesForce {
public:
    virtual ~SharesForce() = default;
    /// The last force of the part before, with the place that it belongs to: used where the next step begins
    /// with exactly that place, so that results keep their bits. `other` is a copy of the same integrator
    /// with another step.
    virtual void takeForce(const SharesForce& other) = 0;
};

}  // namespace extremal
