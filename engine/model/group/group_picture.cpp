// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/group/so3.hpp"
#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/rigid.hpp"
#include "engine/model/group/group_system.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/group/second_derivatives.hpp"

namespace extremal::groups {
namespace {

using Factor = MatrixGroup::Factor;

constexpr double apart = 3;  ///< middles of bodies that stand side by side

/// Entries of the inertia at rest at the identity.
std::vector<double> inertiaOf(const GroupMechanics& on) {
    const int d = on.dimension();
    const MatrixGroup::Entries g = on.group->identity();
    const SecondDerivatives second(on, g.data(), MatrixGroup::Vector::Zero(d), false);
    std::vector<double> diagonal;
    for (int i = 0; i < d; ++i) {
        const double own = second.M[on.couplings->place(i, i)];
        diagonal.push_back(own > 0 && std::isfinite(own) ? own : 1);
    }
    return diagonal;
}

struct DrawnBody {
    int entry = 0;
    std::array<double, 3> centre{};
    BodyShape shape;
};

void drawBodies(const std::vector<DrawnBody>& bodies, const double* x, Drawing& drawing) {
    using Square = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    const DrawnBody& last = bodies.back();
    const Square tip(x + last.entry);
    drawing.tracer = onStage(last.centre[0] + 1.5 * tip(0, 2), 1.5 * tip(1, 2), 1.5 * tip(2, 2));
    if (drawing.isTracerOnly) return;
    drawSpaceAxes(1.9, drawing);
    for (const DrawnBody& body : bodies) {
        const so3::Quaternion<double> q = so3::quaternion(so3::Matrix<double>(Square(x + body.entry)));
        drawBody(body.shape, body.centre, q.data(), drawing);
    }
    drawing.shapes.push_back(Disc{drawing.tracer, 4});
}

/// A plate at (g13, g23), turned by the upper left block.
void drawPlate(int entry, const double* x, Drawing& drawing) {
    const double* const g = x + entry;
    const auto at = [&](double a, double b) {
        return Point{g[0] * a + g[1] * b + g[2], g[3] * a + g[4] * b + g[5], 0};
    };
    drawing.tracer = at(0, 0);
    if (drawing.isTracerOnly) return;
    Curve outline;
    outline.role = ShapeRole::body;
    outline.width = 2;
    for (int k = 0; k <= 48; ++k)
        outline.points.push_back(
            at(0.5 * std::cos(k * std::numbers::pi / 24), 0.2 * std::sin(k * std::numbers::pi / 24)));
    drawing.shapes.push_back(std::move(outline));
    drawing.shapes.push_back(Segment{at(0, 0), at(0.5, 0), 1.5});
    drawing.shapes.push_back(Disc{at(0, 0), 4});
}

/// The section of a rod, or a small body, at (g14, g24, g34): three arms along its axes and a ring across the
/// third. Its trail is the rod.
void drawSection(int entry, const double* x, Drawing& drawing) {
    constexpr double size = 0.08;
    const double* const g = x + entry;
    const auto at = [&](double a, double b, double c) {
        const auto row = [&](int i) {
            return g[4 * i] * a + g[4 * i + 1] * b + g[4 * i + 2] * c + g[4 * i + 3];
        };
        return onStage(row(0), row(1), row(2));
    };
    drawing.tracer = at(0, 0, 0);
    if (drawing.isTracerOnly) return;
    drawSpaceAxes(0.6, drawing);
    drawing.shapes.push_back(Disc{onStage(0, 0, 0), 5, ShapeRole::scenery});
    Curve ring{{}, 2, 1, ShapeRole::body};
    for (int k = 0; k <= 36; ++k)
        ring.points.push_back(
            at(size * std::cos(k * std::numbers::pi / 18), size * std::sin(k * std::numbers::pi / 18), 0));
    drawing.shapes.push_back(std::move(ring));
    for (const auto& [a, b, c] : {std::array{size, 0.0, 0.0}, {0.0, size, 0.0}, {0.0, 0.0, 2 * size}})
        drawing.shapes.push_back(Segment{at(0, 0, 0), at(a, b, c), 1.5});
    drawing.shapes.push_back(Disc{drawing.tracer, 4});
}

/// Whether a group is a single factor in the basis of a named one.
bool isOnly(const std::vector<Factor>& factors, const char* name) {
    const std::vector<MatrixGroup::Square> basis = basisOf(name);
    return factors.size() == 1 && factors[0].basis.size() == basis.size() &&
           factors[0].n == basis[0].rows() &&
           std::equal(basis.begin(), basis.end(), factors[0].basis.begin(),
                      [](const auto& a, const auto& b) { return a == b; });
}

}  // namespace

void describePicture(System& system, const GroupMechanics& on) {
    const std::vector<double> inertia = inertiaOf(on);
    std::vector<DrawnBody> bodies;
    const auto& factors = on.group->factors();
    const auto count = static_cast<double>(factors.size());
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const Factor& f = factors[k];
        if (f.n != 3 || !on.invariants->isOrthogonal(k)) continue;
        BodyMechanics<double> body;
        body.dimension = 3;
        std::copy_n(inertia.begin() + f.coordinate, 3, body.inertia.begin());
        const double middle = apart * (static_cast<double>(k) - (count - 1) / 2);
        bodies.push_back({f.entry, {middle, 0, 0}, shapeOf(body, Settings{"", {{"shape", "box"}}, {}})});
    }
    if (!bodies.empty()) {
        system.isSpatial = true;
        system.draw = [bodies](const double* x, Drawing& drawing) { drawBodies(bodies, x, drawing); };
        return;
    }
    if (isOnly(factors, "se3")) {
        system.isSpatial = true;
        system.draw = [entry = factors[0].entry](const double* x, Drawing& drawing) {
            drawSection(entry, x, drawing);
        };
        return;
    }
    if (!isOnly(factors, "se2")) return;
    system.draw = [entry = factors[0].entry](const double* x, Drawing& drawing) {
        drawPlate(entry, x, drawing);
    };
    system.hasPlanarTrajectory = true;
    system.trajectoryX = "g.13";
    system.trajectoryY = "g.23";
}

}  // namespace extremal::groups
