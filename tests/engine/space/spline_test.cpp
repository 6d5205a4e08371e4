// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <cmath>

#include "engine/space/polynomial.hpp"
#include "engine/space/spline.hpp"
#include "tests/tools/test.hpp"

namespace extremal::spline_test {
namespace {

struct Values {
    std::vector<double> value, slope;
    Values(const Space<double>& space, double tau)
        : value(static_cast<std::size_t>(space.size)), slope(value.size()) {
        space.evaluate(tau, value, slope);
    }
};

}  // namespace

class SplineTest : public QObject {
    Q_OBJECT
    template <class F>
    void forAll(F f) {
        for (const int degree : {1, 2, 3, 5, 8})
            for (const int cells : {1, 2, 3, 7}) f(splineSpace<double>(degree, cells), degree, cells);
    }

private slots:
    void theyAreNotNegativeAndSumToOne() {
        forAll([](const Space<double>& space, int degree, int cells) {
            QCOMPARE(space.size, degree + cells);
            for (double tau = 0; tau <= 1; tau += 0.037) {
                const Values v(space, tau);
                double sum = 0, slopes = 0;
                for (std::size_t a = 0; a < v.value.size(); ++a) {
                    QVERIFY(v.value[a] >= 0);
                    sum += v.value[a];
                    slopes += v.slope[a];
                }
                QVERIFY(std::abs(sum - 1) < 1e-15 && std::abs(slopes) < 1e-12);
            }
        });
    }
    void onlyTheOuterOnesAreNotZeroAtTheEnds() {
        forAll([](const Space<double>& space, int, int) {
            const Values start(space, 0), end(space, 1);
            const auto last = start.value.size() - 1;
            for (std::size_t a = 0; a <= last; ++a) {
                QCOMPARE(start.value[a], a == 0 ? 1.0 : 0.0);
                QCOMPARE(end.value[a], a == last ? 1.0 : 0.0);
            }
        });
    }
    void slopesAreDerivatives() {
        forAll([](const Space<double>& space, int, int) {
            const double delta = 1e-5, tau = 0.4321;
            const Values low(space, tau - delta), high(space, tau + delta), here(space, tau);
            for (std::size_t a = 0; a < here.value.size();
                 ++a)  // measured: below 3e-7, from the third derivative
                QVERIFY(std::abs((high.value[a] - low.value[a]) / (2 * delta) - here.slope[a]) < 1e-6);
        });
    }
    /// Jump of the derivative of order k across a knot, by one-sided differences of the slopes' polynomials.
    void theSlopeIsContinuousFromDegreeTwo() {
        forAll([](const Space<double>& space, int degree, int cells) {
            double jump = 0;
            for (int j = 1; j < cells; ++j) {
                const double knot = static_cast<double>(j) / cells;
                const Values left(space, std::nextafter(knot, 0)), right(space, knot);
                for (std::size_t a = 0; a < left.value.size(); ++a) {
                    QVERIFY(std::abs(left.value[a] - right.value[a]) < 1e-14);
                    jump = std::max(jump, std::abs(left.slope[a] - right.slope[a]));
                }
            }
            QCOMPARE(space.hasKinks, degree == 1 && cells > 1);
            if (space.hasKinks)
                QVERIFY(jump > 1);
            else
                QVERIFY(jump < 1e-12);
        });
    }
    void oneCellSpansThePolynomials() {
        // Every cardinal polynomial is a combination of the B-splines: interpolate at the control points.
        const int degree = 4;
        const Space<double> spline = splineSpace<double>(degree, 1);
        for (const double tau : {0.1, 0.7, 1.3}) {
            const double x = tau;
            const Values v(spline, tau);
            // Marsden's identity with all inner knots gone: tau^2 = sum_a a (a - 1) / (s (s - 1)) N_a.
            double square = 0;
            for (int a = 0; a <= degree; ++a)
                square += a * (a - 1) / static_cast<double>(degree * (degree - 1)) *
                          v.value[static_cast<std::size_t>(a)];
            QVERIFY(std::abs(square - x * x) < 1e-14);
        }
    }
};

EXTREMAL_TEST(SplineTest)
}  // namespace extremal::spline_test

#include "spline_test.moc"
