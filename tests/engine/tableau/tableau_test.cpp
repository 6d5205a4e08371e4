// SPDX-License-Identifier: GPL-3.0-or-later
/// The step as a Runge-Kutta method, against coefficients that are computed here from their definitions with
/// a hundred digits, and against the methods' own steps.
#include <QTest>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <Eigen/LU>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/family/scheme.hpp"
#include "engine/tableau/order_conditions.hpp"
#include "engine/tableau/tableau.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tableau_test {
namespace {

using Long =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

/// P_n and P_n' at x.
std::pair<Long, Long> legendre(int n, const Long& x) {
    Long lower(1), P = n == 0 ? Long(1) : x;
    if (n == 0) return {Long(1), Long(0)};
    for (int k = 1; k < n; ++k) {
        const Long next = (Long(2 * k + 1) * x * P - Long(k) * lower) / Long(k + 1);
        lower = P;
        P = next;
    }
    return {P, Long(n) * (x * P - lower) / (x * x - 1)};
}

Long rootNear(double guess, const std::function<std::pair<Long, Long>(const Long&)>& f) {
    Long x(guess);
    for (int k = 0; k < 12; ++k) {
        const auto [value, slope] = f(x);
        x -= value / slope;
    }
    return x;
}

/// Roots of P_n on [0, 1], ascending.
LongVector gaussNodes(int n) {
    LongVector c(n);
    for (int i = 0; i < n; ++i)
        c(n - 1 - i) = (1 + rootNear(std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)),
                                     [&](const Long& x) { return legendre(n, x); })) /
                       2;
    return c;
}

/// 0, the roots of P_{n-1}', 1.
LongVector lobattoNodes(int n) {
    LongVector c(n);
    c(0) = 0;
    c(n - 1) = 1;
    for (int i = 1; i + 1 < n; ++i)
        c(n - 1 - i) = (1 + rootNear(std::cos(std::numbers::pi * i / (n - 1)),
                                     [&](const Long& x) {
                                         const auto [P, slope] = legendre(n - 1, x);
                                         const Long curvature =
                                             (2 * x * slope - Long((n - 1) * n) * P) / (1 - x * x);
                                         return std::pair{slope, curvature};
                                     })) /
                       2;
    return c;
}

LongVector powers(const LongVector& c, int m) {
    LongVector p = LongVector::Ones(c.size());
    for (int k = 0; k < m; ++k) p = p.cwiseProduct(c).eval();
    return p;
}

struct LongTableau {
    LongMatrix A;
    LongVector b;
};

/// Collocation: sum_j a_ij c_j^(k-1) = c_i^k / k and sum_j b_j c_j^(k-1) = 1/k, k = 1..s.
LongTableau collocation(const LongVector& c) {
    const Eigen::Index s = c.size();
    LongMatrix V(s, s), rightOfA(s, s);
    LongVector rightOfB(s);
    for (Eigen::Index k = 0; k < s; ++k) {
        const int m = static_cast<int>(k);
        V.row(k) = powers(c, m).transpose();
        rightOfA.row(k) = (powers(c, m + 1) / Long(m + 1)).transpose();
        rightOfB(k) = Long(1) / (m + 1);
    }
    const Eigen::FullPivLU<LongMatrix> lu(V);
    return {lu.solve(rightOfA).transpose(), lu.solve(rightOfB)};
}

/// Lobatto IIIB: sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k) / k, k = 1..s.
LongMatrix lobattoB(const LongVector& c, const LongVector& b) {
    const Eigen::Index s = c.size();
    LongMatrix left(s, s), right(s, s);
    for (Eigen::Index k = 0; k < s; ++k) {
        const int m = static_cast<int>(k);
        left.row(k) = b.cwiseProduct(powers(c, m)).transpose();
        right.row(k) = (b.cwiseProduct(LongVector::Ones(s) - powers(c, m + 1)) / Long(m + 1)).transpose();
    }
    return Eigen::FullPivLU<LongMatrix>(left).solve(right);
}

double distance(const Tableau::Matrix& a, const LongMatrix& b) {
    Long worst(0);
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < a.cols(); ++j)
            worst = std::max(worst, Long(abs(Long(a(i, j)) - b(i, j))));
    return static_cast<double>(worst);
}

std::shared_ptr<const Tableau> tableauOf(const std::string& scheme, double step = 0.1) {
    const Discretization d = *namedScheme(scheme);
    return familyPart<StepTableau>(d.space)->of(d, step);
}

std::shared_ptr<const Tableau> baselineTableau(const std::string& id, const Settings& settings = {}) {
    return findBaseline(id)->parts.find<BaselineTableau>()->of(settings);
}

Quad worstOf(const std::vector<OrderCondition>& conditions, int upTo) {
    Quad worst(0);
    for (const OrderCondition& c : conditions)
        if (c.order <= upTo) worst = std::max(worst, Quad(abs(c.residual)));
    return worst;
}

}  // namespace

class TableauTest : public QObject {
    Q_OBJECT
private slots:
    void galerkinGaussIsCollocationTo30Digits_data() {
        QTest::addColumn<int>("s");
        for (int s = 1; s <= 8; ++s) QTest::addRow("%d", s) << s;
    }
    void galerkinGaussIsCollocationTo30Digits() {
        QFETCH(int, s);
        const LongVector c = gaussNodes(s);
        const LongTableau published = collocation(c);
        for (const auto& t :
             {tableauOf("galerkin-gauss-" + std::to_string(s)),
              baselineTableau("gauss-collocation",
                              {"gauss-collocation", {{"stages", static_cast<double>(s)}}, {}})}) {
            QVERIFY(distance(t->c, c) < 1e-31);
            QVERIFY(distance(t->b, published.b) < 1e-31);
            QVERIFY2(distance(t->A, published.A) < 1e-30,
                     qPrintable(QString::number(distance(t->A, published.A))));
            QVERIFY(distance(t->Ahat, published.A) < 1e-30);
            QVERIFY(t->isPlain());
            QVERIFY(!t->isExplicit());
        }
    }

    void galerkinLobattoIsThePairAAndBTo30Digits_data() {
        QTest::addColumn<int>("s");
        for (int s = 1; s <= 8; ++s) QTest::addRow("%d", s) << s;
    }
    void galerkinLobattoIsThePairAAndBTo30Digits() {
        QFETCH(int, s);
        const auto t = tableauOf("galerkin-lobatto-" + std::to_string(s));
        const LongVector c = lobattoNodes(s + 1);
        const LongTableau published = collocation(c);
        QVERIFY(distance(t->c, c) < 1e-31);
        QVERIFY(distance(t->b, published.b) < 1e-31);
        QVERIFY2(distance(t->A, published.A) < 1e-30,
                 qPrintable(QString::number(distance(t->A, published.A))));
        QVERIFY(distance(t->Ahat, lobattoB(c, published.b)) < 1e-30);
        QCOMPARE(t->isExplicit(), s == 1);
    }

    /// Hairer, Lubich, Wanner (2006), II.1.3 and table II.1.2.
    void printedTableausAreFound() {
        const Quad r = sqrt(Quad(15));
        const auto gauss3 = tableauOf("galerkin-gauss-3");
        QVERIFY(abs(gauss3->A(0, 1) - (Quad(2) / 9 - r / 15)) < 1e-30);
        QVERIFY(abs(gauss3->A(2, 0) - (Quad(5) / 36 + r / 30)) < 1e-30);
        const auto lobatto2 = tableauOf("galerkin-lobatto-2");
        QCOMPARE(fractionText(lobatto2->A(1, 0)), std::string("5/24"));
        QCOMPARE(fractionText(lobatto2->A(1, 2)), std::string("-1/24"));
        QCOMPARE(fractionText(lobatto2->Ahat(1, 1)), std::string("1/3"));
        QCOMPARE(fractionText(lobatto2->Ahat(0, 1)), std::string("-1/6"));
        QCOMPARE(numberText(Quad(1) / 3, 30), std::string("1/3"));
        QCOMPARE(numberText(sqrt(Quad(3)) / 6, 30), std::string("0.288675134594812882254574390251"));
    }

    void treesAreCounted() {
        const auto counts = [](TreeKind kind, const Tableau& t) {
            std::vector<int> n(6);
            for (const OrderCondition& c : orderConditions(t, kind, 6))
                ++n[static_cast<std::size_t>(c.order - 1)];
            return n;
        };
        const auto t = tableauOf("galerkin-gauss-2");
        QCOMPARE(counts(TreeKind::plain, *t), (std::vector<int>{1, 1, 2, 4, 9, 20}));
        QCOMPARE(counts(TreeKind::separable, *t), (std::vector<int>{2, 2, 4, 8, 18, 40}));
        QCOMPARE(counts(TreeKind::all, *t), (std::vector<int>{2, 4, 14, 52, 214, 916}));
        // Nystrom: 1, 1, 2, 3, 6, 10 for the velocity (Hairer, Norsett, Wanner, II.14), and q' repeats those
        // before.
        QCOMPARE(counts(TreeKind::quadraticKinetic, *t), (std::vector<int>{2, 2, 3, 5, 9, 16}));
        QCOMPARE(orderConditions(*t, TreeKind::plain, 3).back().tree, std::string("f'(f'(f))"));
    }

    void ordersAreThoseThatAreClaimed_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        for (int s = 1; s <= 3; ++s) {
            QTest::addRow("gauss %d", s) << QString("galerkin-gauss-%1").arg(s) << 2 * s;
            QTest::addRow("lobatto %d", s) << QString("galerkin-lobatto-%1").arg(s) << 2 * s;
        }
        for (const auto& [id, order] : std::vector<std::pair<const char*, int>>{{"rk4", 4},
                                                                                {"dopri5", 5},
                                                                                {"implicit-midpoint", 2},
                                                                                {"symplectic-euler", 1},
                                                                                {"stormer-verlet", 2},
                                                                                {"blanes-moan-s6", 4},
                                                                                {"blanes-moan-s10", 6},
                                                                                {"srkn-6b", 4},
                                                                                {"srkn-11b", 6},
                                                                                {"srkn-14a", 6},
                                                                                {"srkn-19a", 8},
                                                                                {"srkn-19b", 8}})
            QTest::newRow(id) << QString("baseline %1").arg(id) << order;
    }
    void ordersAreThoseThatAreClaimed() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        const bool isBaseline = scheme.startsWith("baseline ");
        const auto t =
            isBaseline ? baselineTableau(scheme.mid(9).toStdString()) : tableauOf(scheme.toStdString());
        const bool isNystrom = scheme.contains("srkn") || t->scope == TableauScope::quadraticKinetic;
        const auto conditions = orderConditions(*t, isNystrom ? TreeKind::quadraticKinetic : treesFor(*t),
                                                order + 1);
        QCOMPARE(orderOf(conditions, t->known), order);
        const bool isVariational = !scheme.contains("rk4") && !scheme.contains("dopri");
        QCOMPARE(symplecticityDefect(*t) < 1e-14, isVariational);
        QCOMPARE(symmetryDefect(*t) < 1e-14, isVariational && order > 1);
    }

    void srknNeedsQuadraticKineticEnergy() {
        const auto t = baselineTableau("srkn-11b");
        QVERIFY(worstOf(orderConditions(*t, TreeKind::quadraticKinetic, 6), 6) < 1e-13);
        const double general = static_cast<double>(worstOf(orderConditions(*t, TreeKind::separable, 6), 6));
        QVERIFY2(general > 1e-6, qPrintable(QString::number(general)));
    }

    void assumptionsOfGaussAreKnown() {
        const auto found = simplifyingAssumptions(*tableauOf("galerkin-gauss-4"));
        QCOMPARE(found.B, 8);
        QCOMPARE(found.C, 4);
        QCOMPARE(found.D, 4);
    }

    /// R(z) of Gauss s is the diagonal Padé quotient of exp; half the trace of Störmer-Verlet is 1 - z^2/2.
    void stabilityFunctionsAreExact() {
        const RationalFunction R = stabilityFunction(*tableauOf("galerkin-gauss-3"));
        const std::vector<std::string> pade{"1", "1/2", "1/10", "1/120"};
        for (std::size_t k = 0; k < 4; ++k) {
            QCOMPARE(fractionText(R.numerator[k]), pade[k]);
            QCOMPARE(fractionText(k % 2 ? Quad(-R.denominator[k]) : R.denominator[k]), pade[k]);
        }
        const RationalFunction verlet = oscillatorTrace(*tableauOf("galerkin-lobatto-1"));
        QCOMPARE(verlet.numerator.size(), std::size_t{2});
        QCOMPARE(fractionText(verlet.numerator[1]), std::string("-1/2"));
        QCOMPARE(verlet.denominator.size(), std::size_t{1});
        const Splitting moan = blanesMoanS10();
        const RationalFunction trace = oscillatorTrace(*baselineTableau("blanes-moan-s10"));
        for (const double z : {0.3, 1.7, 3.1})
            QVERIFY(std::abs(static_cast<double>(trace(Quad(z * z))) - halfTrace(moan.stages, z)) < 1e-12);
    }

    void compositionsHaveTheirOrder() {
        const Quad a = 1 / (2 - cbrt(Quad(2)));
        const Tableau t = composed(*baselineTableau("stormer-verlet"), {a, 1 - 2 * a, a});
        QCOMPARE(orderOf(orderConditions(t, TreeKind::separable, 5), t.known), 4);
        QVERIFY(symplecticityDefect(t) < 1e-30 && symmetryDefect(t) < 1e-30);
    }

    /// Splines and typed functions are Runge-Kutta methods as well; a poor rule is not.
    void otherSpacesHaveTableaus() {
        const auto of = [](const Settings& space, const Settings& rule) {
            const Settings complete = completeQuadrature(space, rule);
            return familyPart<StepTableau>(space)->of({space, complete, {}}, 0.1);
        };
        const Settings spline{"spline", {{"degree", 2.0}, {"cells", 2.0}}, {}};
        const auto t = of(spline, {"gauss", {}, {}});
        QVERIFY(symplecticityDefect(*t) < 1e-30);
        QCOMPARE(orderOf(orderConditions(*t, TreeKind::quadraticKinetic, 5), 1e-30), 4);
        const Settings cubic{"polynomial", {{"degree", 3.0}, {"basis", "lobatto"}}, {}};
        QVERIFY_EXCEPTION_THROWN(of(cubic, {"gauss", {{"nodes", 1.0}, {"panels", 1.0}}, {}}), InvalidScene);
    }

    /// A defect of any coefficient is seen.
    void defectsAreSeen() {
        Tableau t = *tableauOf("galerkin-gauss-2");
        t.A(0, 1) += Quad(1e-20);
        t.Ahat = t.A;
        QVERIFY(symplecticityDefect(t) > 1e-22 && symmetryDefect(t) > 1e-21);
        QVERIFY(orderOf(orderConditions(t, TreeKind::plain, 4), t.known) < 2);
    }
};

EXTREMAL_TEST(TableauTest)

}  // namespace extremal::tableau_test

#include "tableau_test.moc"
