// SPDX-License-Identifier: GPL-3.0-or-later
/// What equidistribution does for a function that does not move: the best approximation by linear elements on
/// meshes that equidistribute a monitor, against equal cells.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/family/moving_mesh/monitor.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/band_lu.hpp"
#include "tests/tools/test.hpp"

namespace extremal::equidistribution_test {
namespace {

using Function = std::function<double(double)>;

/// L2 distance of f from its best approximation that is linear between the nodes, by 16 Gauss points on parts
/// of elements that end at `cuts` as well.
double bestError(const Function& f, const std::vector<double>& x, const std::vector<double>& cuts = {}) {
    const Rule<double> rule = gauss<double>(16);
    const auto n = static_cast<int>(x.size());
    BandLu mass(n, 1);
    mass.clear();
    std::vector<double> load(x.size(), 0);
    double square = 0;
    for (std::size_t e = 0; e + 1 < x.size(); ++e) {
        std::vector<double> ends{x[e]};
        for (int k = 1; k < 40; ++k) ends.push_back(x[e] + (x[e + 1] - x[e]) * k / 40);
        for (const double cut : cuts)
            if (cut > x[e] && cut < x[e + 1]) ends.push_back(cut);
        ends.push_back(x[e + 1]);
        std::sort(ends.begin(), ends.end());
        const double h = x[e + 1] - x[e];
        for (std::size_t k = 0; k + 1 < ends.size(); ++k)
            for (std::size_t q = 0; q < rule.c.size(); ++q) {
                const double d = ends[k + 1] - ends[k], at = ends[k] + rule.c[q] * d, value = f(at),
                             xi = (at - x[e]) / h, w = rule.b[q] * d;
                square += w * value * value;
                load[e] += w * value * (1 - xi);
                load[e + 1] += w * value * xi;
            }
        const auto i = static_cast<int>(e);
        mass.add(i, i, h / 3);
        mass.add(i + 1, i + 1, h / 3);
        mass.add(i, i + 1, h / 6);
        mass.add(i + 1, i, h / 6);
    }
    std::vector<double> u = load;
    if (!mass.factorise()) return NAN;
    mass.solve(u.data());
    double projected = 0;
    for (std::size_t i = 0; i < x.size(); ++i) projected += load[i] * u[i];
    return std::sqrt(std::max(0.0, square - projected));
}

std::vector<double> equalCells(int n) {
    std::vector<double> x;
    for (int i = 0; i <= n; ++i) x.push_back(static_cast<double>(i) / n);
    return x;
}

/// n cells that equidistribute a density, known at a fine table.
std::vector<double> cellsOf(const Function& density, int n) {
    const std::vector<double> fine = equalCells(200000);
    std::vector<double> M, x(static_cast<std::size_t>(n) + 1);
    for (std::size_t e = 0; e + 1 < fine.size(); ++e) M.push_back(density((fine[e] + fine[e + 1]) / 2));
    equidistribute(fine, M, x);
    return x;
}

constexpr double centre = 0.3337, width = 0.01;
double front(double x) { return std::tanh((x - centre) / width); }
double slope(double x) {
    const double s = 1 / std::cosh((x - centre) / width);
    return s * s / width;
}
double bend(double x) { return -2 * front(x) * slope(x) / width; }

}  // namespace

class EquidistributionTest : public QObject {
    Q_OBJECT
private slots:
    void steepProfileIsThatOfTheTable_data() {
        QTest::addColumn<int>("cells");
        QTest::addColumn<double>("equal");
        QTest::addColumn<double>("arclength");
        QTest::addColumn<double>("density");
        QTest::newRow("4") << 4 << 2.668e-1 << 2.855e-2 << 1.374e-2;
        QTest::newRow("8") << 8 << 1.679e-1 << 7.007e-3 << 2.684e-3;
        QTest::newRow("16") << 16 << 8.973e-2 << 6.093e-3 << 5.549e-4;
        QTest::newRow("32") << 32 << 3.901e-2 << 2.660e-3 << 1.261e-4;
        QTest::newRow("64") << 64 << 1.046e-2 << 7.801e-4 << 3.049e-5;
        QTest::newRow("128") << 128 << 2.859e-3 << 2.895e-4 << 7.510e-6;
    }
    /// tanh((x - 0.3337)/0.01) on [0, 1]: equal cells, arclength, and |u_xx|^(2/5), the density of the best
    /// knots, with a floor of 2 % of its mean.
    void steepProfileIsThatOfTheTable() {
        QFETCH(int, cells);
        QFETCH(double, equal);
        QFETCH(double, arclength);
        QFETCH(double, density);
        const double a = bestError(front, equalCells(cells)),
                     b = bestError(front, cellsOf([](double x) { return std::hypot(1, slope(x)); }, cells));
        double mean = 0;
        for (int i = 0; i < 20000; ++i) mean += std::pow(std::abs(bend((i + 0.5) / 20000)), 0.4) / 20000;
        const double c = bestError(
            front, cellsOf([&](double x) { return std::pow(std::abs(bend(x)), 0.4) + 0.02 * mean; }, cells));
        qInfo("%.3e %.3e %.3e", a, b, c);
        QVERIFY(std::abs(a / equal - 1) < 0.1);
        QVERIFY(std::abs(b / arclength - 1) < 0.1);
        QVERIFY(std::abs(c / density - 1) < 0.1);
    }
    /// A jump on n equal cells, root mean square over its place: 0.33 / sqrt(n). With two knots at distance d
    /// about it the error is sqrt(d / 12), as small as one likes.
    void jumpIsOfOrderOneHalfOnEqualCells() {
        for (const int n : {8, 16, 32, 64}) {
            double square = 0;
            constexpr int places = 40;
            for (int k = 0; k < places; ++k) {
                const double at = 0.5 + (k + 0.5) / places / n;
                const double error =
                    bestError([at](double x) { return x < at ? 0.0 : 1.0; }, equalCells(n), {at});
                square += error * error / places;
            }
            const double scaled = std::sqrt(square * n);
            qInfo("%d cells: %.3f", n, scaled);
            QVERIFY(scaled > 0.30 && scaled < 0.36);
        }
        for (const double d : {1e-2, 1e-4}) {
            const double error = bestError([](double x) { return x < 0.4 ? 0.0 : 1.0; },
                                           {0, 0.4 - d / 2, 0.4 + d / 2, 1}, {0.4});
            QVERIFY(std::abs(error / std::sqrt(d / 12) - 1) < 0.02);
        }
    }
    /// The trapezoidal rule for the integral of u_x^2 of a front: on the image of an equidistributed mesh it
    /// is more accurate as long as equal cells do not resolve the front. Once they do, its error on equal
    /// cells is smaller than any power of their size, as the integrand vanishes at both ends with all
    /// derivatives.
    void quadratureOnTheComputationalDomainIsMoreAccurateWhileCellsAreFew() {
        const auto errorOn = [](const std::vector<double>& x) {
            double sum = 0;
            for (std::size_t e = 0; e + 1 < x.size(); ++e) {
                const double l = slope(x[e]), r = slope(x[e + 1]);
                sum += (x[e + 1] - x[e]) * (l * l + r * r) / 2;
            }
            return std::abs(sum * width * 3 / 4 - 1);
        };
        const auto arclength = [](double x) { return std::hypot(1, slope(x)); };
        for (const int n : {16, 32, 64, 128}) {
            const double atRest = errorOn(equalCells(n)), moved = errorOn(cellsOf(arclength, n));
            qInfo("%d cells: %.2e at rest, %.2e equidistributed", n, atRest, moved);
            // 0.98 and 0.23, 0.59 and 0.039, 0.14 and 0.0075; 6e-4 and 2e-3
            if (n < 128)
                QVERIFY(moved < 0.3 * atRest);
            else
                QVERIFY(atRest < 0.5 * moved);
        }
    }
};

EXTREMAL_TEST(EquidistributionTest)
}  // namespace extremal::equidistribution_test

#include "equidistribution_test.moc"
