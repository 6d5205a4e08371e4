// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <cmath>

#include "engine/action/table.hpp"
#include "engine/family/scheme.hpp"
#include "engine/space/polynomial.hpp"
#include "engine/space/spline.hpp"
#include "tests/tools/test.hpp"

namespace extremal::pair_test {
namespace {

Settings polynomial(int degree) {
    return {"polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}};
}
Settings spline(int degree, int cells) {
    return {"spline", {{"degree", static_cast<double>(degree)}, {"cells", static_cast<double>(cells)}}, {}};
}
Properties known(const Settings& space, Settings rule) {
    return describe(space, completeQuadrature(space, rule));
}
Settings nodes(const char* rule, int n, int panels = 1) {
    return {rule, {{"nodes", static_cast<double>(n)}, {"panels", static_cast<double>(panels)}}, {}};
}

}  // namespace

class PairTest : public QObject {
    Q_OBJECT
private slots:
    void defaultNodesAndPanelsFollowTheSpace() {
        const Settings rule = completeQuadrature(spline(3, 5), {"lobatto", {}, {}});
        QCOMPARE(rule.integer("nodes"), 4);
        QCOMPARE(rule.integer("panels"), 5);
        QCOMPARE(completeQuadrature(polynomial(3), {"gauss", {}, {}}).integer("panels"), 1);
        QCOMPARE(completeQuadrature(polynomial(3), {"midpoint", {}, {}}).integer("panels"), 1);
    }
    void theRuleCountsTwiceInStationarity() {
        // The measured orders of these are in the handbook; min(2s, order of the rule) would be 6, 4, 8
        // and 6.
        QCOMPARE(known(polynomial(5), nodes("clenshaw-curtis", 6)).claims.order, 4);
        QCOMPARE(known(polynomial(4), nodes("clenshaw-curtis", 4)).claims.order, 2);
        QCOMPARE(known(polynomial(6), nodes("clenshaw-curtis", 7)).claims.order, 6);
        QCOMPARE(known(spline(4, 2), nodes("clenshaw-curtis", 6, 2)).claims.order, 6);
    }
    void tooFewNodesAreRefusedWithTheReason() {
        const Properties few = known(polynomial(4), nodes("gauss", 3));
        QVERIFY2(few.refusal.find("too few nodes (3)") != std::string::npos, few.refusal.c_str());
        QVERIFY(few.hint.find("at least 4 nodes") != std::string::npos);
        const Properties placed = known(spline(1, 8), nodes("gauss", 8));
        QVERIFY2(placed.refusal.find("wrong places") != std::string::npos, placed.refusal.c_str());
    }
    void rulesThatDoNotIntegrateVelocitiesAreRefused() {
        for (const int panels : {4, 5, 9}) {
            const Properties p =
                known(polynomial(4), {"trapezoid", {{"panels", static_cast<double>(panels)}}, {}});
            QVERIFY2(p.refusal.find("free particle") != std::string::npos, p.refusal.c_str());
        }
        // Splines want panels that end at their knots.
        QVERIFY(known(spline(3, 3), nodes("gauss", 6)).refusal.find("free particle") != std::string::npos);
        QVERIFY(known(spline(3, 3), nodes("gauss", 3, 3)).refusal.empty());
    }
    void consistencyOfGaussIsDegreePlusOne() {
        for (int s = 1; s <= 12; ++s) {
            const auto space = polynomialSpace<double>(s, PolynomialBasis::legendre);
            QCOMPARE(makeTable(space, gauss<double>(s)).consistency, s + 1);
            if (s >= 2) QCOMPARE(makeTable(space, lobatto<double>(s)).consistency, s - 1);
        }
    }
    void interiorFunctionsAreOrthonormalWhateverTheBasis() {
        for (const auto basis :
             {PolynomialBasis::lobatto, PolynomialBasis::equispaced, PolynomialBasis::chebyshevModal}) {
            const auto table = makeTable(polynomialSpace<double>(24, basis), gauss<double>(24));
            const Eigen::MatrixXd gram =
                table.derivative.transpose() * table.weight.asDiagonal() * table.derivative;
            const double defect = (gram - Eigen::MatrixXd::Identity(24, 24)).cwiseAbs().maxCoeff();
            qInfo("largest entry of the kinetic matrix minus one: %.2e", defect);
            QVERIFY(defect < 0.02);  // the sum that replaces the integral is that good
        }
    }
};

EXTREMAL_TEST(PairTest)
}  // namespace extremal::pair_test

#include "pair_test.moc"
