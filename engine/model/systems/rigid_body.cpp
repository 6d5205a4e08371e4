/// Free rigid body on SO(3): L = 1/2 eta . I eta, eta the angular velocity in body axes. SI units.
#include <algorithm>

#include "engine/group/so3.hpp"
#include "engine/model/free_body_motion.hpp"
#include "engine/model/rigid.hpp"

namespace extremal::systems {
namespace {

using Three = std::array<double, 3>;

/// The box, and the axis it turns about, up to the plane that the angular velocity never leaves: its tip draws the
/// herpolhode there.
void drawRigidBody(const BodyMechanics<double>& body, const std::array<double, 3>& half, const double* x, Drawing& drawing) {
    drawSpaceAxes(1.5, drawing);
    drawBox(half, {0, 0, 0}, x, drawing);
    const so3::Matrix<double> R = so3::matrix(so3::normalised(so3::Quaternion<double>(x[0], x[1], x[2], x[3])));
    const so3::Vector<double> Pi(x[4], x[5], x[6]);
    const so3::Vector<double> w = R * so3::Vector<double>(Pi(0) / body.inertia[0], Pi(1) / body.inertia[1], Pi(2) / body.inertia[2]);
    const double L = Pi.norm(), alongL = L > 0 ? w.dot(R * Pi) / L : 0;
    if (!(alongL > 0)) return;
    // The plane is at 1.25; an axis that leans far away is cut to the size of the picture.
    const so3::Vector<double> tip = w * std::min(1.25 / alongL, 2.5 / w.norm());
    drawing.tracer = onStage(tip(0), tip(1), tip(2));
    drawing.shapes.push_back(Segment{onStage(0, 0, 0), drawing.tracer, 1.6});
    drawing.shapes.push_back(Disc{drawing.tracer, 4});
    const so3::Vector<double> axis = R * Pi * (1.25 / L);
    drawing.shapes.push_back(Segment{onStage(0, 0, 0), onStage(axis(0), axis(1), axis(2)), 1.4, ShapeRole::scenery});
}

System makeRigidBody(const Settings& settings) {
    System s;
    s.id = "rigid-body";
    s.body.dimension = 3;
    const std::vector<double> inertia = settings.numbers("inertia");
    std::copy(inertia.begin(), inertia.end(), s.body.inertia.begin());
    describeBody(s);
    addPolhode(s);
    const char* names[] = {"space.x", "space.y", "space.z"};
    const char* symbols[] = {"π_x", "π_y", "π_z"};
    for (int i = 0; i < 3; ++i)
        s.momenta.push_back({names[i], symbols[i], "kg m²/s", [i](const double* x, const double*) { return x[7 + i]; }});
    s.exact = [I = Three{inertia[0], inertia[1], inertia[2]}](const State& initial) { return freeBodyMotion(I, initial); };
    s.casimir = [](double, const double* x) { return x[4] * x[4] + x[5] * x[5] + x[6] * x[6]; };
    s.draw = [half = boxOf(s.body), body = s.body](const double* x, Drawing& drawing) { drawRigidBody(body, half, x, drawing); };
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
    e.make = makeRigidBody;
    return e;
}

}  // namespace extremal::systems
