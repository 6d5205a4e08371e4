// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid body on SE(3): L = 1/2 eta . I eta + 1/2 m |x'|^2 - U(x, R), U typed by the user in x, y, z,
/// R11..R33. SI units, unless the numbers are meant otherwise.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/free_body_motion.hpp"
#include "engine/model/body/rigid.hpp"
#include "engine/model/typed_potential.hpp"

namespace extremal::systems {
namespace {

/// The homogeneous box of this mass in metres, or an ellipsoid as long.
BodyShape shapeInMetres(const BodyMechanics<double>& body, const Settings& settings) {
    BodyShape shape = shapeOf(body, settings);
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& I = body.inertia;
        largest = std::max(largest, 1.5 * (I[(i + 1) % 3] + I[(i + 2) % 3] - I[i]) / body.inertia[3]);
    }
    for (double& h : shape.half) h *= std::sqrt(largest);
    return shape;
}

/// The free body turns as on SO(3), and its centre of mass moves straight on.
ExactSolution freeMotion(const BodyMechanics<double>& body, const State& initial) {
    const ExactSolution turning =
        freeBodyMotion({body.inertia[0], body.inertia[1], body.inertia[2]}, initial);
    if (!turning) return {};
    return [turning, initial, mass = body.inertia[3]](double t, std::span<double> x) {
        turning(t, x.first(10));
        for (std::size_t i = 0; i < 3; ++i) {
            x[13 + i] = initial.x[13 + i];
            x[10 + i] = initial.x[10 + i] + (t - initial.t) * x[13 + i] / mass;
        }
    };
}

System makeRigidBodySe3(const Settings& settings) {
    System s;
    s.id = "rigid-body-se3";
    Body body;
    body.dimension = 6;
    const std::vector<double> inertia = settings.numbers("inertia");
    std::copy(inertia.begin(), inertia.end(), body.inertia.begin());
    std::fill(body.inertia.begin() + 3, body.inertia.end(), settings.number("mass"));
    s.momenta = setTypedPotential(body, settings);
    describeBody(s, body);
    if (body.isFree()) addPolhode(s);
    if (body.isFree()) s.exact = [body](const State& initial) { return freeMotion(body, initial); };
    s.draw = [shape = shapeInMetres(body, settings), isFree = body.isFree()](const double* x,
                                                                             Drawing& drawing) {
        drawing.tracer = onStage(x[10], x[11], x[12]);
        if (drawing.isTracerOnly) return;
        drawSpaceAxes(1, drawing);
        if (!isFree) drawing.shapes.push_back(Disc{onStage(0, 0, 0), 6, ShapeRole::scenery});
        drawBody(shape, {x[10], x[11], x[12]}, x, drawing);
    };
    s.timePlots.clear();
    s.trajectoryX = "position.x";
    s.trajectoryY = "position.y";
    s.hasPlanarTrajectory = true;
    return s;
}

std::vector<FieldInfo> rigidBodySe3Fields() {
    std::vector<FieldInfo> all{inertiaField({1, 2, 3}),
                               positive("mass", "mass", "kg", 1, "Mass of the body.")};
    for (FieldInfo& f : typedPotentialFields(true)) all.push_back(std::move(f));
    all.push_back(shapeField());
    return all;
}

}  // namespace

ModelEntry rigid_body_se3() {
    ModelEntry e;
    e.item = {
        "rigid-body-se3",
        "rigid body in space",
        "A body that rotates and translates in a potential of position and attitude, typed as a formula.",
        rigidBodySe3Fields(),
        {},
        ""};
    e.initial = bodyInitialFields(true);
    e.exampleInitial = {{"attitude", Value::Array{1.0, 0.0, 0.0, 0.0}},
                        {"momentum", Value::Array{0.45, 0.0, 0.9}},
                        {"position", Value::Array{0.0, 0.0, 0.0}},
                        {"velocity", Value::Array{0.1, 0.0, 0.0}}};
    e.exampleEnd = 50;
    e.exampleStep = 0.2;
    e.make = makeRigidBodySe3;
    return e;
}

}  // namespace extremal::systems
