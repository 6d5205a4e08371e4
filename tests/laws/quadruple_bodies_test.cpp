/// Orders 8 to 16 of Lie group integrators in quadruple precision: double has no window between truncation
/// and round-off.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include "engine/action/table.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::quadruple_bodies_test {
namespace {

using Quad = boost::multiprecision::float128;
using Group = RotationGroup<Quad>;

/// Heavy top of weight 1 with its centre of mass at (0.3, 0, 1).
void topPotential(const void*, const Quad* R, const Quad*, Quad* value, Quad* force, Quad* slope) {
    const so3::Vector<Quad> gamma(R[2], R[5], R[8]), arm(Quad(3) / 10, Quad(0), Quad(1));
    const Quad U = so3::dot(arm, gamma);
    if (value) *value = U;
    const so3::Vector<Quad> torque = so3::cross(gamma, arm);
    for (int i = 0; i < 3; ++i) force[i] = torque(i);
    if (!slope) return;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) slope[3 * c + r] = (r == c ? U : Quad(0)) - gamma(r) * arm(c);
}

Pose<Quad> run(bool isTop, int degree, bool isGauss, int n) {
    BodyMechanics<Quad> body;
    body.dimension = 3;
    body.inertia = {Quad(1), Quad(isTop ? 1 : 2), isTop ? Quad(1) / 2 : Quad(3)};
    if (isTop) body.potential = topPotential;
    const Table<Quad> table = makeTable(polynomialSpace<Quad>(degree, PolynomialBasis::lobatto),
                                        isGauss ? gauss<Quad>(degree) : lobatto<Quad>(degree + 1));
    LieStep<Quad, Group> step(body, table, Quad(2) / n, true, false, {});
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
