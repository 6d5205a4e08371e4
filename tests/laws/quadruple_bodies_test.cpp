// SPDX-License-Identifier: GPL-3.0-or-later
/// Orders 8 to 16 of Lie group integrators in quadruple precision: double has no window between truncation
/// and round-off.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include "engine/action/table.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/quadruple_top.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::quadruple_bodies_test {
namespace {

using Group = RotationGroup<Quad>;

Pose<Quad> run(bool isTop, int degree, bool isGauss, int n) {
    const BodyMechanics<Quad> body = isTop ? quadrupleTop() : quadrupleBody();
    const Table<Quad> table = makeTable(polynomialSpace<Quad>(degree, PolynomialBasis::lobatto),
                                        isGauss ? gauss<Quad>(degree) : lobatto<Quad>(degree + 1));
    LieStep<Quad, Group> step(body, table, Quad(2) / n, true, Quad(0), {});
    Pose<Quad> pose;
    pose.momentum << Quad(1) / 10, Quad(1) / 5, isTop ? Quad(1) / 2 : Quad(1);
    for (int k = 0; k < n; ++k) {
        StepReport report;
        if (step.advance(pose, report, {}) != Outcome::converged) throw std::runtime_error("the step failed");
    }
    return pose;
}

double angle(const Pose<Quad>& a, const Pose<Quad>& b) {
    const auto d = so3::product(so3::conjugate(a.attitude), b.attitude);
    return static_cast<double>(2 * sqrt(d(1) * d(1) + d(2) * d(2) + d(3) * d(3)));
}

}  // namespace

class QuadrupleBodiesTest : public QObject {
    Q_OBJECT
private slots:
    void degreesUpToEightHaveTwiceTheirOrder_data() {
        QTest::addColumn<bool>("isTop");
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        for (const bool isTop : {false, true})
            for (const int degree : {4, 5, 6, 8})
                for (const bool isGauss : {true, false})
                    QTest::addRow("%s, degree %d, %s", isTop ? "top" : "free", degree,
                                  isGauss ? "Gauss" : "Lobatto")
                        << isTop << degree << isGauss;
    }
    void degreesUpToEightHaveTwiceTheirOrder() {
        QFETCH(bool, isTop);
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        const Pose<Quad> reference = run(isTop, 8, true, isTop ? 80 : 24);
        std::vector<double> h, error;
        const int first = isTop ? (degree == 8 ? 12 : 20) : (degree == 8 ? 2 : 8);
        for (const int n : {first, first * 3 / 2, first * 2}) {
            h.push_back(-std::log(static_cast<double>(n)));
            error.push_back(std::log(angle(reference, run(isTop, degree, isGauss, n))));
        }
        const double order = slope(h, error);
        qInfo("claimed %d, measured %.2f, errors %.1e to %.1e", 2 * degree, order, std::exp(error.front()),
              std::exp(error.back()));
        QVERIFY(std::abs(order - 2 * degree) < 0.35);
    }
};

EXTREMAL_TEST(QuadrupleBodiesTest)
}  // namespace extremal::laws::quadruple_bodies_test

#include "quadruple_bodies_test.moc"
