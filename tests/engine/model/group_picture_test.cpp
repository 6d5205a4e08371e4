// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of groups that a scene gives as data.
#include <QTest>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <variant>

#include "engine/model/system.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::group_picture_test {
namespace {

ReadScene sceneOf(const std::string& group, const std::string& lagrangian, const std::string& g) {
    return readScene(R"({"extremal":1,"model":{"type":"group","group":)" + group + R"(,"lagrangian":")" +
                     lagrangian + R"("},"initial":{"g":)" + g +
                     R"(,"xi":[0.1, 0.2, 0.3]},"time":{"end":1},"schemes":[{"step":0.1,"scheme":"lie-2"}]})");
}

Drawing drawingOf(const ReadScene& read) {
    Drawing drawing;
    read.resolved->system->draw(read.resolved->initial.x.data(), drawing);
    return drawing;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

class GroupPictureTest : public QObject {
    Q_OBJECT
private slots:
    /// Which turn the same body by the same angles: g is of half of them, and both signs are one attitude.
    void aUnitaryMatrixTurnsTheBodyThatARotationTurns() {
        const std::string body = "(xi1^2 + 2*xi2^2 + 2.5*xi3^2)/2";
        for (const char* way : {"[0.3, -0.7, 1.1]", "[2.9, 0, 0]", "[0, 4, 1]", "[0, 0, -1.3]"}) {
            const std::string g = std::string(R"({"exp":)") + way + "}";
            const ReadScene unitary = sceneOf(R"("su2")", body, g), rotation = sceneOf(R"("so3")", body, g);
            QVERIFY2(unitary.resolved && rotation.resolved, way);
            QVERIFY(unitary.resolved->system->isSpatial);
            const Drawing a = drawingOf(unitary), b = drawingOf(rotation);
            QVERIFY2(distance(a.tracer, b.tracer) < 1e-14, way);
            QCOMPARE(a.shapes.size(), b.shapes.size());
        }
    }
    /// The area of an ellipse that a matrix of determinant 1 makes of the unit circle.
    void aMatrixOfTwoRowsIsShownByTheCircle() {
        const ReadScene read =
            sceneOf(R"("sl2")", "(xi1^2 + xi2^2 + xi3^2)/2", R"({"exp":[0.4, -0.3, 0.8]})");
        QVERIFY(read.resolved && !read.resolved->system->isSpatial);
        int ellipses = 0;
        for (const Shape& shape : drawingOf(read).shapes) {
            const auto* const curve = std::get_if<Curve>(&shape);
            if (!curve || curve->role != ShapeRole::body) continue;
            double twice = 0;
            for (std::size_t k = 1; k < curve->points.size(); ++k)
                twice += curve->points[k - 1][0] * curve->points[k][1] -
                         curve->points[k - 1][1] * curve->points[k][0];
            const double polygon = 32 * std::sin(std::numbers::pi / 32);  // of 64 corners
            QVERIFY(std::abs(twice / 2 - polygon) < 1e-12);
            ++ellipses;
        }
        QCOMPARE(ellipses, 1);
    }
    /// One rotation in space is a group of one dimension: its solid has the inertia about that axis alone.
    void groupsOfFewDimensionsHaveAPicture() {
        for (const char* group : {R"({"basis":[[[0,-1,0],[1,0,0],[0,0,0]]]})", R"("so4")", R"("heisenberg")",
                                  R"("so21")", R"("u1")", R"({"product":{"a":"u1","b":"su2","c":"sl2"}})"}) {
            const bool isProduct = std::string(group).find("product") != std::string::npos;
            const ReadScene read = readScene(
                R"({"extremal":1,"model":{"type":"group","group":)" + std::string(group) +
                R"(,"lagrangian":")" +
                (isProduct                          ? "(a_xi1^2 + b_xi1^2 + b_xi2^2 + b_xi3^2 + c_xi1^2 + "
                                                      "c_xi2^2 + c_xi3^2)/2"
                 : std::string(group) == R"("so4")" ? "(xi1^2 + xi2^2 + xi3^2 + xi4^2 + xi5^2 + xi6^2)/2"
                 : std::string(group).size() > 12 || std::string(group) == R"("u1")"
                     ? "xi1^2/2"
                     : "(xi1^2 + xi2^2 + xi3^2)/2") +
                R"("},"time":{"end":1},"schemes":[{"step":0.1,"scheme":"lie-2"}]})");
            QVERIFY2(read.resolved, group);
            const Drawing drawing = drawingOf(read);
            QVERIFY2(!drawing.shapes.empty() && std::isfinite(drawing.tracer[0]), group);
        }
    }
    /// What moves has a picture, and what is drawn against what has names that differ.
    void everyMotionOfThePresetsIsShown() {
        for (const Preset& preset : presets()) {
            const ReadScene read = readScene(preset.json);
            if (!read.resolved || read.resolved->system->independent != "t") continue;
            const System& system = *read.resolved->system;
            QVERIFY2(system.draw, std::string(preset.id).c_str());
            std::set<std::string> names;
            for (const Quantity& column : stateColumns(system))
                QVERIFY2(column.symbol.empty() || names.insert(column.symbol).second,
                         (std::string(preset.id) + ": " + column.symbol).c_str());
        }
    }
};

EXTREMAL_TEST(GroupPictureTest)
}  // namespace extremal::group_picture_test

#include "group_picture_test.moc"
