// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies on the stage: Poinsot's ellipsoid touches its plane where the herpolhode is drawn, in the ring that
/// the energy allows; faces look outwards; the tracer alone is the same tracer.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/group/so3.hpp"
#include "engine/model/body/body_shape.hpp"
#include "tests/tools/test.hpp"

namespace extremal::body_shape_test {
namespace {

using Vector = so3::Vector<double>;

System body(const std::string& shape, std::array<double, 3> I = {1, 2, 3},
            const std::string& model = "rigid-body") {
    Value::Object keys{{"inertia", Value::Array{I[0], I[1], I[2]}}, {"shape", shape}};
    if (model == "heavy-top") {
        keys.push_back({"weight", 1.0});
        keys.push_back({"centre", Value::Array{0.0, 0.0, 1.0}});
    }
    return findModel(model)->make({model, std::move(keys), {}});
}
std::vector<double> startState() { return {0.5, 0.5, -0.5, 0.5, 0.5, 0.3, 0.8, 0, 0, 0}; }

/// The state with its momentum in space.
std::vector<double> whole(std::vector<double> x) {
    const Vector pi = so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3])) * Vector(x[4], x[5], x[6]);
    for (std::size_t i = 0; i < 3; ++i) x[7 + i] = pi(static_cast<int>(i));
    return x;
}
Vector fromStage(const Point& p) { return {p[0], -p[2], p[1]}; }

const Solid& solidOf(const Drawing& drawing) {
    for (const Shape& shape : drawing.shapes)
        if (const auto* solid = std::get_if<Solid>(&shape)) return *solid;
    throw std::runtime_error("no solid");
}

}  // namespace

class BodyShapeTest : public QObject {
    Q_OBJECT
private slots:
    void poinsotsEllipsoidTouchesThePlaneAtTheTracer() {
        for (const std::array<double, 3> I : {std::array<double, 3>{1, 2, 3}, {1, 1, 1.8}, {2, 2, 2}}) {
            const System system = body("ellipsoid", I);
            const std::vector<double> x = whole(startState());
            const BodyShape shape = poinsotEllipsoid(system.body(), x.data(), 1.25);
            Drawing drawing;
            system.draw(x.data(), drawing);
            const Vector tip = fromStage(drawing.tracer), along = Vector(x[7], x[8], x[9]).normalized();
            const so3::Matrix<double> R = so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3]));
            const Vector inBody = R.transpose() * tip, normal = R.transpose() * along;
            double on = 0, support = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const double a = shape.half[i];
                on += inBody(static_cast<int>(i)) * inBody(static_cast<int>(i)) / (a * a);
                support += a * a * normal(static_cast<int>(i)) * normal(static_cast<int>(i));
            }
            qInfo("on the ellipsoid %.1e, on the plane %.1e, farthest point %.1e", on - 1,
                  tip.dot(along) - 1.25, std::sqrt(support) - 1.25);
            QVERIFY(std::abs(on - 1) < 1e-14);
            QVERIFY(std::abs(tip.dot(along) - 1.25) < 1e-14);
            QVERIFY(std::abs(std::sqrt(support) - 1.25) < 1e-14);  // no point of it is beyond the plane
            // The solid has its corners on it.
            double farthest = 0;
            for (const Point& c : solidOf(drawing).corners)
                farthest = std::max(farthest, fromStage(c).dot(along));
            QVERIFY(farthest < 1.25 + 1e-12 && farthest > 1.2);
        }
    }
    void theHerpolhodeStaysInItsRingAndReachesBothSides() {
        const System system = body("box");
        const State start{0, 0, whole(startState())};
        const ExactSolution exact = system.exact(start);
        Drawing drawing;
        system.draw(start.x.data(), drawing);
        const Vector along = Vector(start.x[7], start.x[8], start.x[9]).normalized();
        std::vector<double> radii;
        for (const Shape& shape : drawing.shapes)
            if (const auto* ring = std::get_if<Curve>(&shape)) {
                for (const Point& p : ring->points) QVERIFY(std::abs(fromStage(p).dot(along) - 1.25) < 1e-14);
                radii.push_back((fromStage(ring->points[0]) - 1.25 * along).norm());
            }
        QCOMPARE(radii.size(), std::size_t(2));
        std::sort(radii.begin(), radii.end());
        double least = 1e9, greatest = 0;
        std::vector<double> x(10);
        for (int k = 0; k <= 4000; ++k) {
            exact(0.01 * k, x);
            drawing.clear();
            drawing.isTracerOnly = true;
            system.draw(x.data(), drawing);
            const double r = (fromStage(drawing.tracer) - 1.25 * along).norm();
            least = std::min(least, r);
            greatest = std::max(greatest, r);
        }
        qInfo("from %.9f to %.9f, rings %.9f and %.9f", least, greatest, radii[0], radii[1]);
        QVERIFY(std::abs(least - radii[0]) < 1e-4 && least > radii[0] - 1e-12);
        QVERIFY(std::abs(greatest - radii[1]) < 1e-4 && greatest < radii[1] + 1e-12);
    }
    void facesLookOutwards() {
        for (const char* shape : {"box", "ellipsoid"}) {
            const System system = body(shape);
            Drawing drawing;
            system.draw(whole(startState()).data(), drawing);
            const Solid& solid = solidOf(drawing);
            QCOMPARE(solid.isSmooth, std::string(shape) == "ellipsoid");
            for (const std::vector<int>& face : solid.faces) {
                Vector normal = Vector::Zero(), middle = Vector::Zero();
                for (std::size_t i = 0; i < face.size(); ++i) {
                    const Vector a = fromStage(solid.corners[static_cast<std::size_t>(face[i])]);
                    const Vector b =
                        fromStage(solid.corners[static_cast<std::size_t>(face[(i + 1) % face.size()])]);
                    normal += so3::cross(a, b);
                    middle += a;
                }
                QVERIFY(normal.dot(middle) > 0);
            }
        }
    }
    void theTracerAloneIsTheSame() {
        for (const char* model : {"rigid-body", "heavy-top"})
            for (const char* shape : {"box", "ellipsoid"}) {
                const System system = body(shape, {1, 2, 2.5}, model);
                const std::vector<double> x = whole(startState());
                Drawing all, alone;
                alone.isTracerOnly = true;
                system.draw(x.data(), all);
                system.draw(x.data(), alone);
                QCOMPARE(alone.tracer, all.tracer);
                QVERIFY(alone.shapes.empty() && !all.shapes.empty());
            }
    }
    void thinRodsKeepAVisibleThickness() {
        const System system = body("ellipsoid", {1e-10, 1, 1});
        const std::vector<double> x = whole(startState());
        for (const double a : poinsotEllipsoid(system.body(), x.data(), 1.25).half)
            QVERIFY(a >= 0.07 && a <= 2.5);
        Drawing drawing;
        system.draw(std::vector<double>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}.data(), drawing);  // at rest
        for (const Point& c : solidOf(drawing).corners) QVERIFY(std::isfinite(c[0] + c[1] + c[2]));
    }
};

EXTREMAL_TEST(BodyShapeTest)
}  // namespace extremal::body_shape_test

#include "body_shape_test.moc"
