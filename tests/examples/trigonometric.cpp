/// Curves A + B cos z tau + C sin z tau on one step: a space fitted to one frequency, z = frequency * step.
#include <cmath>

#include "engine/space/catalog.hpp"

namespace extremal::spaces {

SpaceEntry trigonometric() {
    FieldInfo z = positive("z", "frequency times step", "", 1, "The space holds cos and sin of z tau, tau from 0 to 1.");
    SpaceEntry e;
    e.item = {"trigonometric", "trigonometric", "A constant and one oscillation.", {z}, {}, ""};
    e.make = [](const Settings& settings) {
        Space<double> space;
        space.size = 3;    // basis functions 1, cos z tau, sin z tau; none of them belongs to an end point
        space.degree = 0;  // constants are the only polynomials in it
        space.evaluate = [f = settings.number("z")](const double& tau, std::span<double> value,
                                                    std::span<double> derivative) {
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
