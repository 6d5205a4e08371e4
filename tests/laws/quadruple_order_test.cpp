// SPDX-License-Identifier: GPL-3.0-or-later
/// Orders 8 and 10 in quadruple precision: double has no window between truncation and round-off there.
/// The exact solution at T comes from Kepler's equation, solved in quadruple precision.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <array>

#include "engine/action/table.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/model/bind.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/quadruple_kepler.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::quadruple_order_test {
class QuadrupleOrderTest : public QObject {
    Q_OBJECT
private slots:
    void degreesFourAndFiveHaveOrdersEightAndTen_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isGauss");
        for (const int degree : {4, 5})
            for (const bool isGauss : {true, false})
                QTest::addRow("degree %d, %s", degree, isGauss ? "Gauss" : "Lobatto") << degree << isGauss;
    }
    void degreesFourAndFiveHaveOrdersEightAndTen() {
        QFETCH(int, degree);
        QFETCH(bool, isGauss);
        const Mechanics<Quad> mechanics = bindMechanics<Quad>(KeplerModel{});
        const Table<Quad> table = makeTable(polynomialSpace<Quad>(degree, PolynomialBasis::lobatto),
                                            isGauss ? gauss<Quad>(degree) : lobatto<Quad>(degree + 1));
        const Quad T(3);
        const std::vector<Quad> exact = exactKepler(T);
        std::vector<double> h, eq, ep;
        for (const int n : {80, 120, 160, 240, 320}) {
            GalerkinStep<Quad, 2> step(mechanics, table, T / n, {});
            std::array<Quad, 4> x{Quad(2) / 5, 0, 0, 2};
            for (int k = 0; k < n; ++k) {
                const StepReport r = step.advance(T * k / n, x.data(), x.data() + 2, {});
                QVERIFY(r.outcome == Outcome::converged);
            }
            const Quad q =
                sqrt((x[0] - exact[0]) * (x[0] - exact[0]) + (x[1] - exact[1]) * (x[1] - exact[1]));
            const Quad p =
                sqrt((x[2] - exact[2]) * (x[2] - exact[2]) + (x[3] - exact[3]) * (x[3] - exact[3]));
            h.push_back(std::log(3.0 / n));
            eq.push_back(static_cast<double>(log(q)));
            ep.push_back(static_cast<double>(log(p)));
        }
        const double forQ = slope(h, eq), forP = slope(h, ep);
        qInfo("claimed %d, measured q %.3f, p %.3f", 2 * degree, forQ, forP);
        QVERIFY(std::abs(forQ - 2 * degree) < 0.15);
        QVERIFY(std::abs(forP - 2 * degree) < 0.15);
    }
};

EXTREMAL_TEST(QuadrupleOrderTest)
}  // namespace extremal::laws::quadruple_order_test

#include "quadruple_order_test.moc"
