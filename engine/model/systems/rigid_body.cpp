// SPDX-License-Identifier: GPL-3.0-or-later
/// Free rigid body on SO(3): L = 1/2 eta . I eta, eta the angular velocity in body axes. SI units.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/group/so3.hpp"
#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/free_body_motion.hpp"
#include "engine/model/body/rigid.hpp"

namespace extremal::systems {
namespace {

using Three = std::array<double, 3>;

constexpr double planeDistance = 1.25;  // of the plane of the herpolhode from the centre

/// The ring in which the herpolhode runs: the curve of the state's energy on the momentum sphere crosses two
/// of the planes n_j = 0, and there |omega| is extreme. `along` is the unit vector of the momentum in space.
void drawHerpolhodeRing(const BodyMechanics<double>& body, const double* x, const so3::Vector<double>& along,
                        Drawing& drawing) {
    const double w[] = {1 / body.inertia[0], 1 / body.inertia[1], 1 / body.inertia[2]};
    double L2 = 0, e = 0;
    for (int i = 0; i < 3; ++i) {
        L2 += x[4 + i] * x[4 + i];
        e += w[i] * x[4 + i] * x[4 + i];
    }
    e /= L2;
    const so3::Vector<double> other =
        std::abs(along(2)) < 0.9 ? so3::Vector<double>(0, 0, 1) : so3::Vector<double>(1, 0, 0);
    const so3::Vector<double> right = so3::cross(other, along).normalized(), up = so3::cross(along, right);
    for (int j = 0; j < 3; ++j) {
        const double a = w[(j + 1) % 3], b = w[(j + 2) % 3], part = (e - b) / (a - b);
        if (!(part >= 0 && part <= 1)) continue;  // also where a = b
        const double r =
            planeDistance * std::sqrt(std::max(0.0, (a * a * part + b * b * (1 - part)) / (e * e) - 1));
        if (!(r > 0.01 && r < 2.1)) continue;
        Curve ring;
        ring.strength = 0.45;
        for (int k = 0; k <= 48; ++k) {
            const double phi = k * std::numbers::pi / 24;
            const so3::Vector<double> p =
                planeDistance * along + r * (std::cos(phi) * right + std::sin(phi) * up);
            ring.points.push_back(onStage(p(0), p(1), p(2)));
        }
        drawing.shapes.push_back(std::move(ring));
    }
}

/// The body, and the axis it turns about, up to the plane that the angular velocity never leaves: its tip
/// draws the herpolhode there. As an ellipsoid of inertia the body touches the plane at this tip.
void drawRigidBody(const BodyMechanics<double>& body, const BodyShape& shape, const double* x,
                   Drawing& drawing) {
    const so3::Matrix<double> R = so3::matrixAt(x);
    const so3::Vector<double> Pi(x[4], x[5], x[6]);
    const so3::Vector<double> w =
        R * so3::Vector<double>(Pi(0) / body.inertia[0], Pi(1) / body.inertia[1], Pi(2) / body.inertia[2]);
    const double L = Pi.norm(), alongL = L > 0 ? w.dot(R * Pi) / L : 0;
    const bool turns = alongL > 0;
    // An axis that leans far away is cut to the size of the picture.
    const so3::Vector<double> tip =
        turns ? w * std::min(planeDistance / alongL, 2 * planeDistance / w.norm()) : w;
    if (turns) drawing.tracer = onStage(tip(0), tip(1), tip(2));
    if (drawing.isTracerOnly) return;
    drawSpaceAxes(1.5, drawing);
    drawBody(turns && shape.isEllipsoid ? poinsotEllipsoid(body, x, planeDistance) : shape, {0, 0, 0}, x,
             drawing);
    if (!turns) return;
    drawing.shapes.push_back(Segment{onStage(0, 0, 0), drawing.tracer, 1.6});
    drawing.shapes.push_back(Disc{drawing.tracer, 4});
    const so3::Vector<double> along = R * Pi / L, axis = planeDistance * along;
    drawing.shapes.push_back(
        Segment{onStage(0, 0, 0), onStage(axis(0), axis(1), axis(2)), 1.4, ShapeRole::scenery});
    drawHerpolhodeRing(body, x, along, drawing);
}

System makeRigidBody(const Settings& settings) {
    System s;
    s.id = "rigid-body";
    Body body;
    body.dimension = 3;
    const std::vector<double> inertia = settings.numbers("inertia");
    std::copy(inertia.begin(), inertia.end(), body.inertia.begin());
    describeBody(s, body);
    addPolhode(s);
    const char* names[] = {"space.x", "space.y", "space.z"};
    const char* symbols[] = {"π_x", "π_y", "π_z"};
    for (int i = 0; i < 3; ++i)
        s.momenta.push_back(
            {names[i], symbols[i], "kg m²/s", [i](const double* x, const double*) { return x[7 + i]; }});
    s.exact = [I = Three{inertia[0], inertia[1], inertia[2]}](const State& initial) {
        return freeBodyMotion(I, initial);
    };
    addCasimir(s, [](double, const double* x) { return x[4] * x[4] + x[5] * x[5] + x[6] * x[6]; });
    s.draw = [shape = shapeOf(body, settings), body](const double* x, Drawing& drawing) {
        drawRigidBody(body, shape, x, drawing);
    };
    return s;
}

}  // namespace

ModelEntry rigid_body() {
    ModelEntry e;
    e.item = {"rigid-body",
              "free rigid body",
              "A body that turns freely about its centre of mass; attitude and angular momentum.",
              {inertiaField({1, 2, 3}), shapeField()},
              {},
              ""};
    e.initial = bodyInitialFields(false);
    e.exampleInitial = {{"attitude", Value::Array{1.0, 0.0, 0.0, 0.0}},
                        {"momentum", Value::Array{0.45, 0.0, 0.9}}};
    e.exampleEnd = 50;
    e.exampleStep = 0.2;
    e.make = makeRigidBody;
    return e;
}

}  // namespace extremal::systems
