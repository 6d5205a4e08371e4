// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid body on SO(3) about a fixed point: L = 1/2 eta . I eta - U(R), U typed by the user in R11..R33. SI
/// units, unless the numbers are meant otherwise.
#include <algorithm>
#include <utility>

#include "engine/group/so3.hpp"
#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/free_body_motion.hpp"
#include "engine/model/body/rigid.hpp"
#include "engine/model/typed_potential.hpp"

namespace extremal::systems {
namespace {

/// The body about its fixed point; the tip of its third axis draws the trail.
void drawBodyInPotential(const BodyShape& shape, const double* x, Drawing& drawing) {
    const so3::Matrix<double> R = so3::matrixAt(x);
    drawing.tracer = onStage(1.5 * R(0, 2), 1.5 * R(1, 2), 1.5 * R(2, 2));
    if (drawing.isTracerOnly) return;
    drawSpaceAxes(1.9, drawing);
    drawBody(shape, {0, 0, 0}, x, drawing);
    drawing.shapes.push_back(Disc{onStage(0, 0, 0), 4, ShapeRole::scenery});
    drawing.shapes.push_back(Segment{onStage(0, 0, 0), drawing.tracer, 1.6});
    drawing.shapes.push_back(Disc{drawing.tracer, 4});
}

System makeBodyInPotential(const Settings& settings) {
    System s;
    s.id = "body-in-potential";
    Body body;
    body.dimension = 3;
    const std::vector<double> inertia = settings.numbers("inertia");
    std::copy(inertia.begin(), inertia.end(), body.inertia.begin());
    s.momenta = setTypedPotential(body, settings);
    describeBody(s, body);
    if (body.isFree()) addPolhode(s);
    if (body.isFree())
        s.exact = [I = std::array<double, 3>{inertia[0], inertia[1], inertia[2]}](const State& initial) {
            return freeBodyMotion(I, initial);
        };
    s.draw = [shape = shapeOf(body, settings)](const double* x, Drawing& drawing) {
        drawBodyInPotential(shape, x, drawing);
    };
    return s;
}

std::vector<FieldInfo> bodyInPotentialFields() {
    std::vector<FieldInfo> all{inertiaField({1, 2, 3})};
    for (FieldInfo& f : typedPotentialFields(false)) {
        if (f.key == "potential") f.example = "R33 + R11^2/2";
        all.push_back(std::move(f));
    }
    all.push_back(shapeField());
    return all;
}

}  // namespace

ModelEntry body_in_potential() {
    ModelEntry e;
    e.item = {"body-in-potential",
              "body in a potential",
              "A body that rotates about a fixed point in a potential of its attitude, typed as a formula.",
              bodyInPotentialFields(),
              {},
              ""};
    e.initial = bodyInitialFields(false);
    e.exampleInitial = {{"attitude", Value::Array{1.0, 0.0, 0.0, 0.0}},
                        {"momentum", Value::Array{0.4, 0.2, 1.0}}};
    e.exampleEnd = 30;
    e.exampleStep = 0.1;
    e.make = makeBodyInPotential;
    return e;
}

}  // namespace extremal::systems
