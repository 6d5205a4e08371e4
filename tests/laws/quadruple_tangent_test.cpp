// SPDX-License-Identifier: GPL-3.0-or-later
/// Tangent maps in quadruple precision, against differences of the step: no digit of double hides anything.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <array>
#include <cmath>

#include "engine/action/table.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/model/bind.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/quadruple_kepler.hpp"
#include "tests/tools/quadruple_top.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::quadruple_tangent_test {
namespace {

template <int n>
using Map = Eigen::Matrix<Quad, n, n>;
template <int n>
using Point = Eigen::Matrix<Quad, n, 1>;

/// A kinetic energy that depends on the place, and forces that depend on velocity and time.
struct Coupled {
    static constexpr int dimension = 2;
    template <class T, class S>
    S lagrangian(const T& t, const std::array<S, 2>& q, const std::array<S, 2>& v) const {
        using std::cos;
        using std::sin;
        return square(v[0]) * (square(q[1]) * T(0.25) + T(1)) + square(v[1]) +
               v[0] * v[1] * cos(q[0] - q[1]) + v[0] * sin(q[1]) - square(square(q[0])) * T(0.25) +
               cos(q[1]) * T(2) + q[0] * sin(t);
    }
};

/// By central differences of order 6 of `to`, a function of a displacement.
template <int n, class F>
Map<n> differenced(const F& to) {
    const Quad delta = Quad(1) / 10000, weights[] = {Quad(45) / 60, Quad(-9) / 60, Quad(1) / 60};
    Map<n> D;
    for (int j = 0; j < n; ++j) {
        D.col(j).setZero();
        for (int k = 1; k <= 3; ++k)
            D.col(j) += (to(Point<n>(Point<n>::Unit(j) * (k * delta))) -
                         to(Point<n>(Point<n>::Unit(j) * (-k * delta)))) *
                        (weights[k - 1] / delta);
    }
    return D;
}

Table<Quad> tableOf(int degree, bool isGauss) {
    return makeTable(polynomialSpace<Quad>(degree, PolynomialBasis::lobatto),
                     isGauss ? gauss<Quad>(degree) : lobatto<Quad>(degree + 1));
}

/// The largest entries of M - D, M^T J M - J and of D^T less what transposed solves give.
template <class Model>
std::array<double, 3> condensed(const Model& model, int degree, bool isGauss, const Quad& h,
                                const std::array<Quad, 4>& start) {
    const Mechanics<Quad> mechanics = bindMechanics<Quad>(model);
    const Quad t = Quad(3) / 10;
    const auto to = [&](const Point<4>& by) {
        GalerkinStep<Quad, 2> step(mechanics, tableOf(degree, isGauss), h, {});
        Point<4> x = Eigen::Map<const Point<4>>(start.data()) + by;
        if (step.advance(t, x.data(), x.data() + 2, {}).outcome != Outcome::converged)
            throw std::runtime_error("the step failed");
        return x;
    };
    GalerkinStep<Quad, 2> step(mechanics, tableOf(degree, isGauss), h, {});
    std::array<Quad, 4> x = start;
    (void)step.advance(t, x.data(), x.data() + 2, {});
    Map<4> M = Map<4>::Identity(), J = Map<4>::Zero();
    if (!step.applyTangent(t, M.data(), 4)) throw std::runtime_error("no tangent map");
    J.topRightCorner(2, 2).setIdentity();
    J.bottomLeftCorner(2, 2) = -Map<2>::Identity();
    Map<4> T = Map<4>::Identity();
    if (!step.applyTransposed(t, T.data(), 4)) throw std::runtime_error("no tangent map");
    const Map<4> D = differenced<4>(to);
    return {static_cast<double>((M - D).cwiseAbs().maxCoeff()),
            static_cast<double>((M.transpose() * J * M - J).cwiseAbs().maxCoeff()),
            static_cast<double>((T - D.transpose()).cwiseAbs().maxCoeff())};
}

}  // namespace

class QuadrupleTangentTest : public QObject {
    Q_OBJECT
private slots:
    void condensedSteps_data() {
        QTest::addColumn<bool>("isKepler");
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        for (const bool isKepler : {true, false})
            for (const int degree : {1, 2, 3, 4})
                for (const bool isGauss : {true, false})
                    QTest::addRow("%s, degree %d, %s", isKepler ? "Kepler" : "coupled", degree,
                                  isGauss ? "Gauss" : "Lobatto")
                        << isKepler << degree << isGauss;
    }
    void condensedSteps() {
        QFETCH(bool, isKepler);
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        const auto [off, defect, transposed] =
            isKepler ? condensed(KeplerModel{}, degree, isGauss, Quad(1) / 20, {Quad(2) / 5, 0, 0, 2})
                     : condensed(Coupled{}, degree, isGauss, Quad(1) / 10,
                                 {Quad(7) / 10, Quad(3) / 10, Quad(2) / 5, Quad(-1) / 2});
        qInfo("M - differences %.1e, defect %.1e, transposed - differences %.1e", off, defect, transposed);
        QVERIFY(off < 1e-12);  // 1e-20 to 1e-18
        QVERIFY(transposed < 1e-12);
        QVERIFY(defect < 1e-28);
    }
    void bodies_data() {
        QTest::addColumn<bool>("isTop");
        QTest::addColumn<int>("degree");
        QTest::addColumn<double>("base");
        for (const bool isTop : {false, true})
            for (const int degree : {1, 2, 3})
                for (const double base : {0.0, 1.0, 0.5, 0.25})
                    QTest::addRow("%s, degree %d, chart at %g", isTop ? "top" : "free", degree, base)
                        << isTop << degree << base;
    }
    void bodies() {
        QFETCH(bool, isTop);
        QFETCH(int, degree);
        QFETCH(double, base);
        using Group = RotationGroup<Quad>;
        const BodyMechanics<Quad> body = isTop ? quadrupleTop() : quadrupleBody();
        const auto make = [&] {
            return LieStep<Quad, Group>(body, tableOf(degree, true), Quad(1) / 5, true, Quad(base), {});
        };
        Pose<Quad> start;
        start.momentum << Quad(1) / 2, Quad(1) / 5, Quad(4) / 5;
        const auto stepOf = [&](Pose<Quad> pose) {
            auto step = make();
            StepReport report;
            if (step.advance(pose, report, {}) != Outcome::converged)
                throw std::runtime_error("the step failed");
            return pose;
        };
        const Pose<Quad> end = stepOf(start);
        const auto momentum = [](const Pose<Quad>& p) { return Group::bodyMomentum(Group::element(p), p); };
        const auto to = [&](const Point<6>& by) {
            Pose<Quad> moved = Group::place(start, Group::element(start), by.head<3>());
            moved.momentum = Group::element(moved) * (momentum(start) + by.tail<3>());
            const Pose<Quad> there = stepOf(moved);
            const auto turn = so3::product(so3::conjugate(end.attitude), there.attitude);
            // 2 asin(|q|) q/|q|, to the fifth order.
            const Quad s = turn.tail<3>().squaredNorm();
            Point<6> v;
            v << turn.tail<3>() * (2 * (1 + s / 6 + 3 * s * s / 40)), momentum(there) - momentum(end);
            return v;
        };
        auto step = make();
        Pose<Quad> pose = start;
        StepReport report;
        QCOMPARE(step.advance(pose, report, {}), Outcome::converged);
        Map<6> M = Map<6>::Identity();
        QVERIFY(step.applyTangent(M.data(), 6));
        const auto form = [&](const Pose<Quad>& p) {
            Map<6> Om = Map<6>::Zero();
            Om.topLeftCorner(3, 3) = -so3::hat(momentum(p));
            Om.topRightCorner(3, 3).setIdentity();
            Om.bottomLeftCorner(3, 3) = -Map<3>::Identity();
            return Om;
        };
        const auto off = static_cast<double>((M - differenced<6>(to)).cwiseAbs().maxCoeff()),
                   defect = static_cast<double>(
                       (M.transpose() * form(end) * M - form(start)).cwiseAbs().maxCoeff()),
                   constant = static_cast<double>(
                       (M.transpose() * form(Pose<Quad>()) * M - form(Pose<Quad>())).cwiseAbs().maxCoeff());
        qInfo("M - differences %.1e, defect %.1e, with the constant form %.2f", off, defect, constant);
        QVERIFY(off < 1e-12);
        QVERIFY(defect < 1e-28);
        QVERIFY(constant > 0.1);
    }
};

EXTREMAL_TEST(QuadrupleTangentTest)
}  // namespace extremal::laws::quadruple_tangent_test

#include "quadruple_tangent_test.moc"
