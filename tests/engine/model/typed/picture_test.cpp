// SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of a typed Lagrangian has every body that the names of the coordinates tell of.
#include <QTest>

#include <cmath>

#include "engine/model/typed/parts/typed_parts.hpp"
#include "engine/model/typed/typed_picture.hpp"
#include "tests/tools/test.hpp"

namespace extremal::picture_test {
namespace {

struct Drawn {
    std::vector<Point> bodies, rods;  ///< rods: their far ends
    std::vector<double> lengths;
    Point tracer;
    bool isSpatial;
};

Drawn drawn(const std::vector<std::string>& names, const std::vector<double>& q,
            const std::vector<std::pair<std::string, double>>& parameters = {},
            const Value::Object& constraints = {}) {
    const typed::Formula formula{names, parameters, ""};
    const auto constraint = typed::constraintOf({"lagrangian", {{"constraints", constraints}}, {}}, formula);
    const typed::Picture picture = typed::pictureOf(formula, constraint ? &*constraint : nullptr);
    Drawing drawing;
    picture.draw(q.data(), drawing);
    Drawn all{{}, {}, {}, drawing.tracer, picture.isSpatial};
    for (const Shape& shape : drawing.shapes) {
        if (const Disc* disc = std::get_if<Disc>(&shape); disc && disc->role == ShapeRole::body)
            all.bodies.push_back(disc->centre);
        if (const Segment* rod = std::get_if<Segment>(&shape)) {
            all.rods.push_back(rod->b);
            all.lengths.push_back(std::hypot(rod->b[0] - rod->a[0], rod->b[1] - rod->a[1]));
        }
    }
    return all;
}

bool isNear(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-14;
}

}  // namespace

class PictureTest : public QObject {
    Q_OBJECT
private slots:
    void threeBodiesAreThreeDiscs() {
        const Drawn all = drawn({"x1", "y1", "x2", "y2", "x3", "y3"}, {1, 2, 3, 4, 5, 6});
        QCOMPARE(all.bodies.size(), std::size_t{3});
        QVERIFY(isNear(all.bodies[1], {3, 4, 0}) && isNear(all.bodies[2], {5, 6, 0}));
        QVERIFY(isNear(all.tracer, {1, 2, 0}) && !all.isSpatial);
    }
    /// Distances from a point that is not the origin, and between two bodies; a torus is no distance.
    void constraintsThatKeepADistanceAreRods() {
        const Drawn all =
            drawn({"x1", "y1", "x2", "y2"}, {1, 2, 4, 6}, {{"l", 5}},
                  {{"first", "3*((x1-1)^2+(y1+1)^2-9)"}, {"second", "(x2-x1)^2+(y2-y1)^2-l^2"}});
        QCOMPARE(all.rods.size(), std::size_t{2});
        QVERIFY(isNear(all.rods[0], {1, -1, 0}) && isNear(all.rods[1], {4, 6, 0}));
        QCOMPARE(all.lengths, (std::vector<double>{3, 5}));
        QVERIFY(isNear(all.tracer, {4, 6, 0}));
        QCOMPARE(
            drawn({"x", "y", "z"}, {2.5, 0, 0}, {}, {{"torus", "(sqrt(x^2+y^2)-2)^2+z^2-1/4"}}).rods.size(),
            std::size_t{0});
        QCOMPARE(drawn({"x1", "y1", "x2", "y2"}, {1, 2, 4, 6}, {}, {{"pin", "x1-x2"}}).rods.size(),
                 std::size_t{0});
        QCOMPARE(drawn({"x", "y"}, {1, 2}, {}, {{"ellipse", "x^2+2*y^2-9"}}).rods.size(), std::size_t{0});
    }
    void theOrderOfCoordinatesIsFree() {
        const Drawn all = drawn({"x_a", "x_b", "y_b", "y_a"}, {1, 2, 3, 4});
        QCOMPARE(all.bodies.size(), std::size_t{2});
        QVERIFY(isNear(all.bodies[0], {1, 4, 0}) && isNear(all.bodies[1], {2, 3, 0}));
    }
    void bodiesInSpaceHaveZUp() {
        const Drawn all = drawn({"x", "y", "z"}, {1, 2, 3});
        QVERIFY(all.isSpatial && isNear(all.bodies[0], {1, 3, -2}));
    }
    void bodiesOnALineAndInPolarCoordinates() {
        QCOMPARE(drawn({"x1", "x2", "x3"}, {1, 2, 4}).bodies.size(), std::size_t{3});
        const Drawn polar = drawn({"r", "phi"}, {2, M_PI / 2});
        QVERIFY(isNear(polar.bodies.at(0), {0, 2, 0}));
    }
    void chainsHaveTheLengthsOfTheParameters() {
        const Drawn plain = drawn({"theta", "phi"}, {0, M_PI / 2});
        QVERIFY(isNear(plain.tracer, {1, -1, 0}));
        const Drawn scaled = drawn({"theta1", "theta2"}, {0, 0}, {{"l1", 2}, {"l2", 0.5}, {"g", 9.81}});
        QCOMPARE(scaled.lengths, (std::vector<double>{2, 0.5}));
        QCOMPARE(drawn({"theta"}, {0}, {{"l", 3}}).lengths, std::vector<double>{3});
    }
    void aCartCarriesItsPendulum() {
        const Drawn cart = drawn({"x", "theta"}, {5, 0});
        QVERIFY(isNear(cart.bodies.at(0), {5, 0, 0}) && isNear(cart.tracer, {5, -1, 0}));
    }
    void whatTheNamesDoNotTellIsAPoint() {
        const Drawn other = drawn({"a", "b", "theta"}, {1, 2, 3});
        QCOMPARE(other.bodies.size(), std::size_t{1});
        QVERIFY(isNear(other.bodies[0], {1, 2, 0}));
    }
    /// Balls a, b, c, d of a cradle, or the q_i of a chain: the first two are not the place of one.
    void manyLengthsArePointsOnALine() {
        const Drawn cradle = drawn({"a", "b", "c", "d"}, {-0.5, 0.2, 0.4, 0.6});
        QCOMPARE(cradle.bodies.size(), std::size_t{4});
        QVERIFY(isNear(cradle.bodies[0], {-0.5, 0, 0}) && isNear(cradle.bodies[3], {0.6, 0, 0}));
        QCOMPARE(drawn({"q1", "q2", "q3", "q4", "q5"}, {1, 2, 3, 4, 5}).bodies.size(), std::size_t{5});
        QVERIFY(isNear(drawn({"q1", "q2"}, {1, 2}).bodies.at(0), {1, 2, 0}));
    }
};

EXTREMAL_TEST(PictureTest)
}  // namespace extremal::picture_test

#include "picture_test.moc"
