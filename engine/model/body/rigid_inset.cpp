// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/body/rigid.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "engine/model/energy_curves.hpp"

namespace extremal {

void addPolhode(System& system) {
    Inset inset;
    inset.title = "polhode";
    const auto& I = system.part<Body>().inertia;
    for (EnergyCurve& curve : energyCurves({I[0], I[1], I[2]}, 96)) {
        Curve shape;
        for (const auto& n : curve.points) shape.points.push_back(onStage(n[0], n[1], n[2]));
        shape.strength = curve.isSeparatrix ? 0.9 : 0.4;
        inset.backdrop.push_back(std::move(shape));
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (const double side : {1.0, -1.0}) {
            std::array<double, 3> from{}, to{}, word{};
            from[i] = side;
            to[i] = 1.13 * side;
            word[i] = 1.28 * side;
            inset.backdrop.push_back(Segment{onStage(from[0], from[1], from[2]), onStage(to[0], to[1], to[2]),
                                             1, ShapeRole::scenery});
            if (side > 0)
                inset.backdrop.push_back(Word{onStage(word[0], word[1], word[2]), std::to_string(i + 1)});
        }
    inset.reach = [](const double* x) { return std::hypot(x[4], x[5], x[6]); };
    inset.tracer = [](const double* x) { return onStage(x[4], x[5], x[6]); };
    system.inset = std::move(inset);
}

}  // namespace extremal
