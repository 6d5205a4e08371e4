// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves A + B cos z tau + C sin z tau on one step: a space fitted to one frequency,
/// z = frequency * step.
#include <cmath>

#include "engine/space/catalog.hpp"

namespace extremal::spaces {

SpaceEntry trigonometric() {
    FieldInfo z = positive("z", "frequency times step", "", 1, "The space has cos, sin of z tau.");
    SpaceEntry e;
    e.item = {"trigonometric", "trigonometric", "A constant and one oscillation.", {z}, {}, ""};
    e.make = [](const Settings& settings) {
        Space<double> space;
        space.size = 3;    // 1, cos z tau, sin z tau; none of them belongs to an end point
        space.degree = 0;  // constants are the only polynomials in it
        const double f = settings.number("z");
        space.evaluate = [f](const double& tau, std::span<double> value, std::span<double> derivative) {
            value[0] = 1;
            value[1] = std::cos(f * tau);
            value[2] = std::sin(f * tau);
            derivative[0] = 0;
            derivative[1] = -f * value[2];
            derivative[2] = f * value[1];
        };
        return space;
    };
    return e;
}

}  // namespace extremal::spaces
