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

/// How a factor of the group is shown.
enum class Look {
    body,      ///< rotations: a solid
    unitBody,  ///< SU(2): the solid that it turns
    image,     ///< matrices of two rows: what they make of the unit circle
    frame      ///< others: their columns, as arrows, by the first three entries
};

struct Drawn {
    Look look = Look::frame;
    int entry = 0, n = 0;
    std::array<double, 3> centre{};
    BodyShape shape;
};

/// w, x, y, z of g = w - i (x sigma_1 + y sigma_2 + z sigma_3), which is stored as (re -im; im re).
so3::Quaternion<double> unitQuaternion(const double* g) {
    return so3::Quaternion<double>(g[0], -g[9], g[4], -g[8]);
}

void drawSolidOf(const Drawn& drawn, const double* x, Drawing& drawing) {
    using Square = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    const double* const g = x + drawn.entry;
    const so3::Quaternion<double> q =
        drawn.look == Look::body ? so3::quaternion(so3::Matrix<double>(Square(g))) : unitQuaternion(g);
    const so3::Matrix<double> R = so3::matrix(q);
    drawing.tracer = onStage(drawn.centre[0] + 1.5 * R(0, 2), 1.5 * R(1, 2), 1.5 * R(2, 2));
    if (!drawing.isTracerOnly) drawBody(drawn.shape, drawn.centre, q.data(), drawing);
}

void drawArrows(const Drawn& drawn, bool isSpatial, const double* x, Drawing& drawing) {
    const auto at = [&](const std::array<double, 3>& p) {
        return isSpatial ? onStage(drawn.centre[0] + p[0], p[1], p[2])
                         : Point{drawn.centre[0] + p[0], p[1], 0};
    };
    const double* const g = x + drawn.entry;
    const auto column = [&](int j) {
        std::array<double, 3> c{};
        for (int i = 0; i < std::min(drawn.n, 3); ++i) c[static_cast<std::size_t>(i)] = g[drawn.n * i + j];
        return at(c);
    };
    drawing.tracer = column(0);
    if (drawing.isTracerOnly) return;
    for (int j = 0; j < drawn.n; ++j) {
        drawing.shapes.push_back(Segment{at({}), column(j), 1.5});
        if (j > 0) drawing.shapes.push_back(Disc{column(j), 3});
    }
    if (drawn.look != Look::image) return;
    for (const bool isMoved : {false, true}) {
        Curve circle{{}, 2, 1, isMoved ? ShapeRole::body : ShapeRole::scenery};
        for (int k = 0; k <= 64; ++k) {
            const double c = std::cos(k * std::numbers::pi / 32), s = std::sin(k * std::numbers::pi / 32);
            circle.points.push_back(isMoved ? at({g[0] * c + g[1] * s, g[2] * c + g[3] * s, 0})
                                            : at({c, s, 0}));
        }
        drawing.shapes.push_back(std::move(circle));
    }
}

bool isSolid(const Drawn& drawn) { return drawn.look == Look::body || drawn.look == Look::unitBody; }

/// In a row; the last solid leaves the trail, or else the last of the others.
void drawFactors(const std::vector<Drawn>& row, bool isSpatial, const double* x, Drawing& drawing) {
    if (isSpatial && !drawing.isTracerOnly) drawSpaceAxes(1.9, drawing);
    for (const Drawn& drawn : row)
        if (!isSolid(drawn)) drawArrows(drawn, isSpatial, x, drawing);
    for (const Drawn& drawn : row)
        if (isSolid(drawn)) drawSolidOf(drawn, x, drawing);
    if (!drawing.isTracerOnly) drawing.shapes.push_back(Disc{drawing.tracer, 4});
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

/// Whether a factor has the basis of a named group.
bool isNamed(const Factor& factor, const char* name) {
    const std::vector<MatrixGroup::Square> basis = basisOf(name);
    return factor.basis.size() == basis.size() && factor.n == basis[0].rows() &&
           std::equal(basis.begin(), basis.end(), factor.basis.begin(),
                      [](const auto& a, const auto& b) { return a == b; });
}

}  // namespace

void describePicture(System& system, const GroupMechanics& on) {
    const auto& factors = on.group->factors();
    if (factors.size() == 1 && isNamed(factors[0], "se3")) {
        system.isSpatial = true;
        system.draw = [entry = factors[0].entry](const double* x, Drawing& drawing) {
            drawSection(entry, x, drawing);
        };
        return;
    }
    if (factors.size() == 1 && isNamed(factors[0], "se2")) {
        system.draw = [entry = factors[0].entry](const double* x, Drawing& drawing) {
            drawPlate(entry, x, drawing);
        };
        system.hasPlanarTrajectory = true;
        system.trajectoryX = "g.13";
        system.trajectoryY = "g.23";
        return;
    }
    const std::vector<double> inertia = inertiaOf(on);
    std::vector<Drawn> row;
    const auto count = static_cast<double>(factors.size());
    bool isSpatial = false;
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const Factor& f = factors[k];
        Drawn drawn{
            Look::frame, f.entry, f.n, {apart * (static_cast<double>(k) - (count - 1) / 2), 0, 0}, {}};
        if (f.n == 2) drawn.look = Look::image;
        if (f.n == 3 && on.invariants->isOrthogonal(k)) drawn.look = Look::body;
        if (isNamed(f, "su2")) drawn.look = Look::unitBody;
        if (isSolid(drawn)) {
            BodyMechanics<double> body;
            body.dimension = 3;
            body.inertia.fill(1);
            std::copy_n(inertia.begin() + f.coordinate, std::min(f.d, 3), body.inertia.begin());
            drawn.shape = shapeOf(body, Settings{"", {{"shape", "box"}}, {}});
        }
        isSpatial = isSpatial || drawn.look != Look::image;
        row.push_back(drawn);
    }
    system.isSpatial = isSpatial;
    system.draw = [row, isSpatial](const double* x, Drawing& drawing) {
        drawFactors(row, isSpatial, x, drawing);
    };
}

}  // namespace extremal::groups
