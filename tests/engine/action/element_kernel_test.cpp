// SPDX-License-Identifier: GPL-3.0-or-later
/// The element kernel against differences of itself in quadruple precision, and its dS/dh against energies
/// that were computed independently.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <array>
#include <cmath>
#include <functional>

#include "engine/action/element_kernel.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/model/bind.hpp"
#include "engine/solve/discrete_lagrangian.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/tools/pendulum_model.hpp"
#include "tests/tools/quadruple_kepler.hpp"
#include "tests/tools/test.hpp"

namespace extremal::element_kernel_test {
namespace {

/// A spring pendulum in polar coordinates: the mass matrix depends on q, and L_qv is not 0.
struct SpringModel {
    static constexpr int dimension = 2;
    template <class T, class S>
    S lagrangian(const T&, const std::array<S, 2>& q, const std::array<S, 2>& v) const {
        const S r = q[0] + T(1), stretch = q[0];
        return (square(v[0]) + square(r * v[1])) * T(0.5) + r * cos(q[1]) * T(9) - square(stretch) * T(20);
    }
};
struct DuffingModel {
    static constexpr int dimension = 1;
    template <class T>
    std::array<T, 1> masses() const {
        return {T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        return square(q[0]) * T(0.5) + square(square(q[0])) * T(0.25);
    }
};

Table<Quad> tableOf(int degree, const Rule<Quad>& rule) {
    return makeTable(polynomialSpace<Quad>(degree, PolynomialBasis::lobatto), rule);
}

using Kernel = ElementKernel<Quad>;
using Vector = Kernel::Vector;
using Derivatives = ElementDerivatives<Quad>;

/// Unknowns of a smooth curve with some motion in every function.
Vector someUnknowns(const Kernel& kernel) {
    Vector z(kernel.size());
    for (int k = 0; k < kernel.dimension(); ++k)
        for (int a = 0; a < kernel.functions(k); ++a)
            z(kernel.index(k, a)) = Quad(3 + k) / 10 + Quad(a * a + k) / 17 - Quad(a) / 5;
    return z;
}

double distance(const Quad& a, const Quad& b) { return static_cast<double>(abs(a - b)); }

}  // namespace

class ElementKernelTest : public QObject {
    Q_OBJECT

    /// All derivatives against central differences with the step e: its square is the error.
    void compareWithDifferences(const Kernel& kernel, const char* name) {
        const Quad e = Quad(1) / 1000000000, h = Quad(3) / 10, t = Quad(1) / 7;
        const Vector z = someUnknowns(kernel);
        const auto at = [&](const Vector& point, const Quad& step) {
            Derivatives r;
            if (!kernel.evaluate(t, step, point, DerivativeOrder::second, r)) qFatal("not finite");
            return r;
        };
        const Derivatives here = at(z, h);
        double first = 0, second = 0, mixed = 0;
        for (int i = 0; i < kernel.size(); ++i) {
            Vector up = z, down = z;
            up(i) += e;
            down(i) -= e;
            const Derivatives high = at(up, h), low = at(down, h);
            first = std::max(first, distance((high.action - low.action) / (2 * e), here.gradient(i)));
            for (int j = 0; j < kernel.size(); ++j)
                second = std::max(
                    second, distance((high.gradient(j) - low.gradient(j)) / (2 * e), here.hessian(j, i)));
            mixed = std::max(mixed, distance((high.byStep - low.byStep) / (2 * e), here.gradientByStep(i)));
        }
        const Derivatives high = at(z, h + e), low = at(z, h - e);
        const double byStep = distance((high.action - low.action) / (2 * e), here.byStep);
        const double twice = distance((high.byStep - low.byStep) / (2 * e), here.byStepTwice);
        for (int j = 0; j < kernel.size(); ++j)
            mixed = std::max(
                mixed, distance((high.gradient(j) - low.gradient(j)) / (2 * e), here.gradientByStep(j)));
        const double size = static_cast<double>(here.hessian.cwiseAbs().maxCoeff());
        qInfo("%s: dS/dz %.1e, d2S/dz2 %.1e, dS/dh %.1e, d2S/dzdh %.1e, d2S/dh2 %.1e, size %.1e", name, first,
              second, byStep, mixed, twice, size);
        // measured: at most 3e-16 of the size of the Hessian; e^2 is 1e-18
        QVERIFY(std::max({first, second, byStep, mixed, twice}) < 1e-13 * (1 + size));
        QVERIFY(size > 1);
    }

private slots:
    void derivativesAreThoseOfTheAction() {
        const Mechanics<Quad> spring = bindMechanics<Quad>(SpringModel{}),
                              kepler = bindMechanics<Quad>(KeplerModel{});
        for (const ElementBasis basis : {ElementBasis::ends, ElementBasis::space}) {
            compareWithDifferences(Kernel(spring, tableOf(3, gauss<Quad>(3)), basis), "spring, one table");
            compareWithDifferences(Kernel(kepler, tableOf(2, lobatto<Quad>(4)), basis), "kepler");
            // A table for each coordinate, of different degrees on the same nodes.
            compareWithDifferences(
                Kernel(spring, {tableOf(2, gauss<Quad>(4)), tableOf(4, gauss<Quad>(4))}, basis),
                "spring, two tables");
        }
    }
    void bothParametrisationsHaveTheSameAction() {
        const Mechanics<Quad> spring = bindMechanics<Quad>(SpringModel{});
        const Table<Quad> table = tableOf(3, gauss<Quad>(3));
        const Kernel ends(spring, table), space(spring, table, ElementBasis::space);
        const Vector z = someUnknowns(ends);
        const int m = table.unknowns();
        Vector c(space.size());
        for (int k = 0; k < 2; ++k) {
            // q = q_0 + sum_a phi_a Y_a with Y_{m-1} = q_1 - q_0.
            Vector Y(m);
            for (int a = 0; a < m; ++a) Y(a) = z(ends.index(k, a + 1));
            Y(m - 1) -= z(ends.index(k, 0));
            const Vector own = table.lift * z(ends.index(k, 0)) + table.change * Y;
            for (int a = 0; a < space.functions(); ++a) c(space.index(k, a)) = own(a);
        }
        Derivatives one, other;
        QVERIFY(ends.evaluate(0, Quad(3) / 10, z, DerivativeOrder::first, one));
        QVERIFY(space.evaluate(0, Quad(3) / 10, c, DerivativeOrder::first, other));
        QVERIFY(distance(one.action, other.action) < 1e-30);
        QVERIFY(distance(one.byStep, other.byStep) < 1e-30);
    }
    void minusTheDerivativeByTheStepIsTheDiscreteEnergy_data() {
        QTest::addColumn<int>("system");
        QTest::addColumn<int>("degree");
        QTest::addColumn<double>("h");
        QTest::addColumn<double>("energy");
        // First steps of Gauss(s), E_d as of an independent prototype (symplectic-energy-momentum).
        QTest::addRow("kepler, s = 1") << 0 << 1 << 0.05 << -0.5316796975189941;
        QTest::addRow("kepler, s = 2") << 0 << 2 << 0.05 << -0.5000204585055568;
        QTest::addRow("pendulum, s = 1") << 1 << 1 << 0.1 << -0.5411862024109492;
        QTest::addRow("pendulum, s = 2") << 1 << 2 << 0.1 << -0.5403024394185507;
        QTest::addRow("duffing, s = 1") << 2 << 1 << 0.1 << 2.36148004380172;
    }
    void minusTheDerivativeByTheStepIsTheDiscreteEnergy() {
        QFETCH(int, system);
        QFETCH(int, degree);
        QFETCH(double, h);
        QFETCH(double, energy);
        const Mechanics<Quad> mechanics = system == 0   ? bindMechanics<Quad>(KeplerModel{})
                                          : system == 1 ? bindMechanics<Quad>(PendulumModel{})
                                                        : bindMechanics<Quad>(DuffingModel{});
        Vector q0(mechanics.dimension), p0(mechanics.dimension);
        if (system == 0) {
            q0 << Quad(2) / 5, 0;
            p0 << 0, 2;
        } else {
            q0 << (system == 1 ? Quad(1) : Quad(3) / 2);
            p0 << 0;
        }
        // -D_1 L_d(q_0, q_1) = p_0 for q_1, by Newton's method on the discrete Lagrangian.
        const DiscreteLagrangian<Quad> Ld(mechanics, tableOf(degree, gauss<Quad>(degree)));
        const int d = mechanics.dimension;
        const Quad step = Quad(static_cast<long long>(std::llround(h * 100))) / 100;
        Vector q1 = q0 + step * p0;
        ActionBetween<Quad> found;
        for (int i = 0; i < 8; ++i) {
            found = Ld(0, step, q0, q1);
            QVERIFY(found.outcome == Outcome::converged);
            q1 += dense::solve<Quad>(found.hessian.topRightCorner(d, d), found.startMomentum - p0);
        }
        found = Ld(0, step, q0, q1);
        Vector z(Ld.kernel().size());
        z << q0, found.interior, q1;
        Derivatives r;
        QVERIFY(Ld.kernel().hasStepDerivatives());
        QVERIFY(Ld.kernel().evaluate(0, step, z, DerivativeOrder::first, r));
        const double measured = -static_cast<double>(r.byStep);
        qInfo("E_d = %.16g", measured);
        QVERIFY(std::abs(measured - energy) < 4e-15 * (1 + std::abs(energy)));
    }
    void whatIsNotKnownByTheStepIsNotANumber() {
        Mechanics<Quad> forced = bindMechanics<Quad>(PendulumModel{});
        forced.isTimeDependent = true;
        const Kernel kernel(forced, tableOf(2, gauss<Quad>(2)));
        Derivatives r;
        QVERIFY(!kernel.hasStepDerivatives());
        QVERIFY(kernel.evaluate(0, Quad(1) / 10, someUnknowns(kernel), DerivativeOrder::second, r));
        QVERIFY(std::isnan(static_cast<double>(r.byStep)));
        QVERIFY(std::isnan(static_cast<double>(r.byStepTwice)));
        QVERIFY(std::isnan(static_cast<double>(r.gradientByStep(0))));
        QVERIFY(std::isfinite(static_cast<double>(r.action)));
    }
};

EXTREMAL_TEST(ElementKernelTest)
}  // namespace extremal::element_kernel_test

#include "element_kernel_test.moc"
