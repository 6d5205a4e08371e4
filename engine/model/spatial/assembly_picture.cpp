// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/assembly_picture.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/model/body/body_shape.hpp"
#include "engine/model/body/rigid.hpp"
#include "engine/model/spatial/assembly_state.hpp"

namespace extremal::spatial {
namespace {

constexpr double largePoint = 8, smallPoint = 4;

Point stage(const Place& p) { return onStage(p(0), p(1), p(2)); }

class AssemblyMade {
public:
    explicit AssemblyMade(Assembly assembly) : all_(std::move(assembly)), at_(all_) {
        for (const BodyElement& b : all_.bodies) addShape(b);
        findSize();
        arms_.resize(all_.bodies.size());
        for (const JointElement& j : all_.joints) {
            addArm(j.body, j);
            if (j.to)
                addArm(*j.to, j);
            else
                addGround(j.at, hasAxis(j) ? j.axis : Place(Place::Zero()));
        }
        for (const PointElement& p : all_.points)
            if (p.isFixed) addGround({p.at[0].value, p.at[1].value, p.at[2].value}, Place::Zero());
        for (const WallElement& w : all_.walls) addWall(w);
    }

    void draw(const double* q, Drawing& drawing) const {
        drawing.tracer = stage(tracer(q));
        if (drawing.isTracerOnly) return;
        drawing.shapes = scenery_;
        for (const RodElement& r : all_.rods)
            drawing.shapes.push_back(Segment{stage(at_.at(q, r.from)), stage(at_.at(q, r.to)), 3});
        for (std::size_t b = 0; b < all_.bodies.size(); ++b) addBody(q, b, drawing);
        for (const SpringElement& s : all_.springs)
            drawing.shapes.push_back(Spring{stage(at_.at(q, s.from)), stage(at_.at(q, s.to)), 10});
        for (const DamperElement& d : all_.dampers)
            if (d.to)
                drawing.shapes.push_back(Segment{stage(at_.at(q, *d.from)), stage(at_.at(q, *d.to)), 1});
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            if (!all_.points[k].isFixed)
                drawing.shapes.push_back(
                    Disc{stage(at_.at(q, k)), all_.points[k].body ? smallPoint : largePoint});
    }
    std::size_t firstRod() const { return scenery_.size(); }

private:
    /// From the centre of mass to a joint, and along its axis, in body axes.
    struct Arm {
        Place to, axis;
    };
    static bool hasAxis(const JointElement& j) {
        return j.kind != JointElement::Kind::ball && j.kind != JointElement::Kind::weld;
    }

    /// The homogeneous solid with the moments of the body, in its principal axes: E_i = m h_i^2 / 3 of a box
    /// with half the edges h, m a_i^2 / 5 of an ellipsoid, m r^2 / 2 across a ring.
    void addShape(const BodyElement& b) {
        constexpr double thinnest = 0.04;
        const Eigen::SelfAdjointEigenSolver<Axes> found(b.spread());
        Axes axes = b.inertia.size() == 3 ? Axes(Axes::Identity()) : Axes(found.eigenvectors());
        if (axes.determinant() < 0) axes.col(0) *= -1;
        BodyShape shape;
        using Kind = BodyElement::Shape;
        shape.isEllipsoid = b.shape == Kind::ellipsoid;
        const double factor = b.shape == Kind::box ? 3 : b.shape == Kind::ring ? 2 : 5;
        for (int i = 0; i < 3; ++i) {
            const double E = b.inertia.size() == 3 ? b.spread()(i, i) : found.eigenvalues()(i);
            shape.half[static_cast<std::size_t>(i)] = std::sqrt(std::max(0.0, E) * factor / b.mass.value);
        }
        const double longest = *std::max_element(shape.half.begin(), shape.half.end());
        for (double& h : shape.half) h = std::max(h, thinnest * longest);
        shapes_.push_back(shape);
        principal_.push_back(axes);
    }
    void findSize() {
        Place low = Place::Constant(1e300), high = -low;
        const auto include = [&](const Place& p, double around) {
            low = low.cwiseMin(p - Place::Constant(around));
            high = high.cwiseMax(p + Place::Constant(around));
        };
        for (std::size_t b = 0; b < all_.bodies.size(); ++b)
            include(all_.bodies[b].at, *std::max_element(shapes_[b].half.begin(), shapes_[b].half.end()));
        for (std::size_t k = 0; k < all_.points.size(); ++k) include(placeAtStart(all_, k), 0);
        for (const JointElement& j : all_.joints) include(j.at, 0);
        const double size = (high - low).norm();
        size_ = size > 0 && std::isfinite(size) ? size : 1;
        middle_ = (low + high) / 2;
    }
    void addArm(std::size_t body, const JointElement& j) {
        const BodyElement& b = all_.bodies[body];
        arms_[body].push_back(
            {b.attitude.transpose() * (j.at - b.at),
             hasAxis(j) && body == j.body ? Place(b.attitude.transpose() * j.axis) : Place(Place::Zero())});
    }
    void addGround(const Place& place, const Place& axis) {
        const double s = 0.03 * size_;
        scenery_.push_back(Disc{stage(place), 5, ShapeRole::scenery});
        scenery_.push_back(
            Segment{stage(place - 2 * s * axis), stage(place + 2 * s * axis), 2, ShapeRole::scenery});
    }
    void addWall(const WallElement& w) {
        const std::array<Place, 2> e = acrossOf(w.normal);
        const Place foot = middle_ - w.normal.dot(middle_ - w.through) * w.normal;
        Curve edge{{}, 2, 1, ShapeRole::scenery};
        for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
            edge.points.push_back(stage(foot + 0.6 * size_ * (a * e[0] + b * e[1])));
        scenery_.push_back(std::move(edge));
    }
    void addBody(const double* q, std::size_t b, Drawing& drawing) const {
        const Place centre = at_.centre(q, b);
        const Axes R = at_.attitude(q, b), own = R * principal_[b];
        const bool isRing = all_.bodies[b].shape == BodyElement::Shape::ring;
        if (isRing)
            addRing(centre, own, shapes_[b].half, drawing);
        else
            drawSolid(shapes_[b], {centre(0), centre(1), centre(2)}, own.data(), drawing);
        for (const Arm& arm : arms_[b]) {
            const Place end = centre + R * arm.to, along = 0.06 * size_ * (R * arm.axis);
            if (!isRing && arm.to.norm() > 1e-9 * size_)
                drawing.shapes.push_back(Segment{stage(centre), stage(end), 2});
            if (arm.axis.norm() > 0)
                drawing.shapes.push_back(Segment{stage(end - along), stage(end + along), 3});
            drawing.shapes.push_back(Disc{stage(end), smallPoint});
        }
    }
    /// Across the axis of least extent.
    static void addRing(const Place& centre, const Axes& R, const std::array<double, 3>& half,
                        Drawing& drawing) {
        constexpr int pieces = 48;
        const auto thin = std::min_element(half.begin(), half.end()) - half.begin();
        const auto a = static_cast<std::size_t>((thin + 1) % 3), b = static_cast<std::size_t>((thin + 2) % 3);
        Curve ring{{}, 4, 1, ShapeRole::body};
        for (int k = 0; k <= pieces; ++k) {
            const double angle = 2 * std::numbers::pi * k / pieces;
            const Place x = R.col(static_cast<Eigen::Index>(a)) * (half[a] * std::cos(angle)) +
                            R.col(static_cast<Eigen::Index>(b)) * (half[b] * std::sin(angle));
            ring.points.push_back(stage(centre + x));
        }
        drawing.shapes.push_back(std::move(ring));
    }
    /// The tip of the last body: the end of what is farthest from its joints, or of its third axis.
    Place tracer(const double* q) const {
        if (all_.bodies.empty()) {
            for (std::size_t k = all_.points.size(); k-- > 0;)
                if (all_.points[k].isFree()) return at_.at(q, k);
            return Place::Zero();
        }
        const std::size_t last = all_.bodies.size() - 1;
        const Place centre = at_.centre(q, last);
        Place tip = Place::Zero();
        for (const Arm& arm : arms_[last]) tip -= arm.to;
        if (tip.norm() > 1e-9 * size_) return centre + at_.attitude(q, last) * tip;
        return centre + 0.25 * size_ * at_.attitude(q, last).col(2);
    }

    Assembly all_;
    Coordinates at_;
    std::vector<BodyShape> shapes_;
    std::vector<Axes> principal_;
    std::vector<std::vector<Arm>> arms_;
    std::vector<Shape> scenery_;
    double size_ = 1;
    Place middle_ = Place::Zero();
};

}  // namespace

cartesian::MechanismPicture pictureOf(Assembly assembly) {
    const auto picture = std::make_shared<const AssemblyMade>(std::move(assembly));
    return {[picture](const double* x, Drawing& drawing) { picture->draw(x, drawing); }, picture->firstRod()};
}

}  // namespace extremal::spatial
