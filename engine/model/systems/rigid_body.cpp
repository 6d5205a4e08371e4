/// Free rigid body on SO(3): L = 1/2 eta . I eta, eta the angular velocity in body axes. SI units.
#include <algorithm>

#include "engine/model/free_body_motion.hpp"
#include "engine/model/rigid.hpp"

namespace extremal::systems {
namespace {

using Three = std::array<double, 3>;

System make(const Settings& settings) {
    System s;
    s.id = "rigid-body";
    s.body.dimension = 3;
    const std::vector<double> inertia = settings.numbers("inertia");
    std::copy(inertia.begin(), inertia.end(), s.body.inertia.begin());
    describeBody(s);
    const char* names[] = {"space.x", "space.y", "space.z"};
    const char* symbols[] = {"π_x", "π_y", "π_z"};
    for (int i = 0; i < 3; ++i)
        s.momenta.push_back({names[i], symbols[i], "kg m²/s", [i](const double* x, const double*) { return x[7 + i]; }});
    s.exact = [I = Three{inertia[0], inertia[1], inertia[2]}](const State& initial) { return freeBodyMotion(I, initial); };
    s.casimir = [](double, const double* x) { return x[4] * x[4] + x[5] * x[5] + x[6] * x[6]; };
    s.draw = [half = boxOf(s.body)](const double* x, Drawing& drawing) { drawBox(half, {0, 0, 0}, x, drawing); };
    return s;
}

}  // namespace

ModelEntry rigid_body() {
    ModelEntry e;
    e.item = {"rigid-body", "free rigid body",
              "A body that turns freely about its centre of mass; attitude and angular momentum.", {inertiaField({1, 2, 3})},
              {}, ""};
    e.initial = bodyInitialFields(false);
    e.exampleInitial = {{"attitude", Value::Array{1.0, 0.0, 0.0, 0.0}}, {"momentum", Value::Array{0.45, 0.0, 0.9}}};
    e.exampleEnd = 50;
    e.exampleStep = 0.2;
    e.make = make;
    return e;
}

}  // namespace extremal::systems
