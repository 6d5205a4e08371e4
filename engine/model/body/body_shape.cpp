// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/body/body_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/group/so3.hpp"
#include "engine/model/body/rigid.hpp"

namespace extremal {
namespace {

constexpr double thinnest = 0.06;
constexpr int meridians = 36, parallels = 18;  // of an ellipsoid's faces

std::array<double, 3> boxOf(const BodyMechanics<double>& body) {
    const auto& I = body.inertia;
    std::array<double, 3> half{};
    for (std::size_t i = 0; i < 3; ++i)
        half[i] = std::sqrt(std::max(0.0, I[(i + 1) % 3] + I[(i + 2) % 3] - I[i]));
    return half;
}

/// Faces and corners of a body centred at 0 whose points `at` places.
template <class Place>
Solid boxSolid(const std::array<double, 3>& half, const Place& at) {
    Solid box;
    for (int corner = 0; corner < 8; ++corner)
        box.corners.push_back(at(corner & 1 ? half[0] : -half[0], corner & 2 ? half[1] : -half[1],
                                 corner & 4 ? half[2] : -half[2]));
    box.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
    return box;
}

/// Rings of corners from pole to pole along axis 3; the poles come last.
template <class Place>
Solid ellipsoidSolid(const std::array<double, 3>& half, const Place& at) {
    Solid solid;
    solid.isSmooth = true;
    for (int p = 1; p < parallels; ++p)
        for (int m = 0; m < meridians; ++m) {
            const double theta = std::numbers::pi * p / parallels, phi = 2 * std::numbers::pi * m / meridians;
            solid.corners.push_back(at(half[0] * std::sin(theta) * std::cos(phi),
                                       half[1] * std::sin(theta) * std::sin(phi), half[2] * std::cos(theta)));
        }
    const int top = static_cast<int>(solid.corners.size()), bottom = top + 1;
    solid.corners.push_back(at(0, 0, half[2]));
    solid.corners.push_back(at(0, 0, -half[2]));
    const auto index = [](int p, int m) { return (p - 1) * meridians + m % meridians; };
    for (int m = 0; m < meridians; ++m) {
        solid.faces.push_back({top, index(1, m), index(1, m + 1)});
        for (int p = 1; p + 1 < parallels; ++p)
            solid.faces.push_back({index(p, m), index(p + 1, m), index(p + 1, m + 1), index(p, m + 1)});
        solid.faces.push_back({bottom, index(parallels - 1, m + 1), index(parallels - 1, m)});
    }
    return solid;
}

/// The three principal sections, which show how a smooth body turns.
template <class Place>
void addSections(const std::array<double, 3>& half, const Place& at, Drawing& drawing) {
    for (std::size_t normal = 0; normal < 3; ++normal) {
        Curve section;
        section.role = ShapeRole::body;
        section.strength = 0.55;
        for (int k = 0; k <= 48; ++k) {
            std::array<double, 3> r{};
            r[(normal + 1) % 3] = half[(normal + 1) % 3] * std::cos(k * std::numbers::pi / 24);
            r[(normal + 2) % 3] = half[(normal + 2) % 3] * std::sin(k * std::numbers::pi / 24);
            section.points.push_back(at(r[0], r[1], r[2]));
        }
        drawing.shapes.push_back(std::move(section));
    }
}

}  // namespace

FieldInfo shapeField() {
    return choiceField(
        "shape", "drawn as", {"box", "ellipsoid"},
        "What the stage shows: the box with these moments of inertia, or the ellipsoid of inertia.");
}

BodyShape shapeOf(const BodyMechanics<double>& body, const Settings& settings) {
    BodyShape shape;
    shape.isEllipsoid = settings.text("shape") == "ellipsoid";
    shape.half = boxOf(body);
    if (shape.isEllipsoid)
        for (std::size_t i = 0; i < 3; ++i) shape.half[i] = 1 / std::sqrt(body.inertia[i]);
    const double longest = *std::max_element(shape.half.begin(), shape.half.end());
    for (double& h : shape.half) h = std::max(h / longest, thinnest);
    return shape;
}

BodyShape poinsotEllipsoid(const BodyMechanics<double>& body, const double* x, double distance) {
    const double L = std::hypot(x[4], x[5], x[6]);
    double twiceEnergy = 0;
    for (std::size_t i = 0; i < 3; ++i) twiceEnergy += x[4 + i] * x[4 + i] / body.inertia[i];
    BodyShape shape;
    shape.isEllipsoid = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const double a = distance * L / std::sqrt(twiceEnergy * body.inertia[i]);
        shape.half[i] = std::clamp(a, thinnest * distance, 2 * distance);
    }
    return shape;
}

namespace {

/// The way from body axes to the stage; R column after column.
auto placing(const std::array<double, 3>& centre, const double* R) {
    return [centre, R](double a, double b, double c) {
        std::array<double, 3> x = centre;
        for (std::size_t i = 0; i < 3; ++i) x[i] += R[i] * a + R[3 + i] * b + R[6 + i] * c;
        return onStage(x[0], x[1], x[2]);
    };
}

}  // namespace

void drawSolid(const BodyShape& shape, const std::array<double, 3>& centre, const double* R,
               Drawing& drawing) {
    const auto at = placing(centre, R);
    drawing.shapes.push_back(shape.isEllipsoid ? ellipsoidSolid(shape.half, at) : boxSolid(shape.half, at));
    if (shape.isEllipsoid) addSections(shape.half, at, drawing);
}

void drawBody(const BodyShape& shape, const std::array<double, 3>& centre, const double* x,
              Drawing& drawing) {
    const so3::Matrix<double> R = so3::matrixAt(x);
    const auto at = placing(centre, R.data());
    drawSolid(shape, centre, R.data(), drawing);
    const auto& half = shape.half;
    const double size = std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        std::array<double, 3> from{}, to{}, word{};
        from[i] = half[i];
        to[i] = half[i] + (shape.isEllipsoid ? 0.16 : 0.3) * size;
        word[i] = half[i] + (shape.isEllipsoid ? 0.22 : 0.38) * size;
        drawing.shapes.push_back(Segment{at(from[0], from[1], from[2]), at(to[0], to[1], to[2]), 1.2});
        drawing.shapes.push_back(Word{at(word[0], word[1], word[2]), std::to_string(i + 1), ShapeRole::body});
    }
}

}  // namespace extremal
