// SPDX-License-Identifier: GPL-3.0-or-later
/// Heavy top on SO(3): L = 1/2 eta . I eta - weight * centre . R^T e_3, turning about a fixed point.
///
/// I: moments of inertia about the fixed point; `weight` * `centre`: weight times the body vector from the
/// fixed point to the centre of mass. The vertical momentum e_3 . pi is kept, and with it the Casimir Pi .
/// R^T e_3.
#include <cmath>
#include <memory>

#include "engine/group/so3.hpp"
#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/rigid.hpp"

namespace extremal::systems {
namespace {

using Vector = so3::Vector<double>;

struct Top {
    double weight = 1;
    std::array<double, 3> centre{0, 0, 1};
};

/// U = w chi . gamma, gamma = R^T e_3; the torque is -w chi x gamma and turns with gamma, gamma' = gamma x
/// zeta.
void potential(const void* model, const double* R, const double*, double* value, double* force,
               double* slope) {
    const Top& top = *static_cast<const Top*>(model);
    const Vector gamma(R[2], R[5], R[8]);
    const Vector arm = Vector(top.centre[0], top.centre[1], top.centre[2]) * top.weight;
    const double U = so3::dot(arm, gamma);
    if (value) *value = U;
    const Vector torque = so3::cross(gamma, arm);
    if (force)
        for (int i = 0; i < 3; ++i) force[i] = torque(i);
    if (!slope) return;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            slope[3 * column + row] = (row == column ? U : 0.0) - gamma(row) * arm(column);
}

void drawHeavyTop(const Top& top, const BodyShape& shape, const double* x, Drawing& drawing) {
    const so3::Matrix<double> R = so3::matrixAt(x);
    Vector arm(top.centre[0], top.centre[1], top.centre[2]);
    arm *= arm.norm() > 0 ? 1.6 / arm.norm() : 0;
    const Vector c = R * arm;
    drawing.tracer = onStage(c(0), c(1), c(2));
    if (drawing.isTracerOnly) return;
    drawSpaceAxes(2.2, drawing);
    drawing.shapes.push_back(Segment{onStage(0, 0, 0), onStage(c(0), c(1), c(2)), 3});
    drawing.shapes.push_back(Disc{onStage(0, 0, 0), 5, ShapeRole::scenery});
    drawBody(shape, {c(0), c(1), c(2)}, x, drawing);
}

System makeHeavyTop(const Settings& settings) {
    System s;
    s.id = "heavy-top";
    Body body;
    body.dimension = 3;
    const std::vector<double> inertia = settings.numbers("inertia"), centre = settings.numbers("centre");
    std::copy(inertia.begin(), inertia.end(), body.inertia.begin());
    auto top = std::make_shared<Top>();
    top->weight = settings.number("weight");
    std::copy(centre.begin(), centre.end(), top->centre.begin());
    body.potential = potential;
    body.model = top;
    describeBody(s, body);
    s.momenta = {{"vertical", "π_z", "kg m²/s", [](const double* x, const double*) { return x[9]; }}};
    addCasimir(s, [](double, const double* x) {
        const so3::Matrix<double> R = so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3]));
        return R(2, 0) * x[4] + R(2, 1) * x[5] + R(2, 2) * x[6];
    });
    BodyShape shape = shapeOf(body, settings);
    for (double& h : shape.half) h *= 0.6;
    s.draw = [top = *top, shape](const double* x, Drawing& drawing) { drawHeavyTop(top, shape, x, drawing); };
    return s;
}

FieldInfo weightField() {
    FieldInfo f;
    f.key = f.title = "weight";
    f.symbol = "w";
    f.unit = "N";
    f.fallback = 1;
    f.description = "Weight of the body; with centre, the torque of gravity.";
    return f;
}

}  // namespace

ModelEntry heavy_top() {
    ModelEntry e;
    FieldInfo centre = numbers("centre", "centre of mass", "m", {"1", "2", "3"}, Value::Array{0.0, 0.0, 1.0},
                               "From the fixed point to the centre of mass, in body axes.");
    centre.symbol = "χ";
    e.item = {"heavy-top",
              "heavy top",
              "A body that turns about a fixed point under its weight.",
              {inertiaField({1, 1, 0.5}), weightField(), centre, shapeField()},
              {},
              ""};
    e.initial = bodyInitialFields(false);
    e.exampleInitial = {{"attitude", Value::Array{Value("cos(0.2)"), Value("sin(0.2)"), 0.0, 0.0}},
                        {"momentum", Value::Array{0.0, 0.0, 2.0}}};
    e.exampleEnd = 40;
    e.exampleStep = 0.1;
    e.make = makeHeavyTop;
    return e;
}

}  // namespace extremal::systems
