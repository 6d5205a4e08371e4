// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/quadrature/filon.hpp"
#include "tests/tools/test.hpp"

namespace extremal::filon_test {

using Wide = boost::multiprecision::cpp_bin_float_50;
using Complex = std::complex<double>;
constexpr FilonNodes bothNodes[] = {FilonNodes::gauss, FilonNodes::lobatto};

namespace {

struct WidePair {
    Wide re, im;
};

/// int_0^1 x^j e^{izx} dx, j < count, with 50 digits: the power series for small z (it loses e^z of 1e50),
/// else by parts (it loses j! / z^j).
std::vector<WidePair> monomialMoments(double z, int count) {
    std::vector<WidePair> mu(static_cast<std::size_t>(count));
    const Wide x = z;
    for (int j = 0; j < count; ++j) {
        WidePair& m = mu[static_cast<std::size_t>(j)];
        if (std::abs(z) < 8) {
            Wide term = 1;
            for (int n = 0; n < 90; ++n) {
                const Wide share = term / (n + j + 1);
                if (n % 4 == 0) m.re += share;
                if (n % 4 == 1) m.im += share;
                if (n % 4 == 2) m.re -= share;
                if (n % 4 == 3) m.im -= share;
                term *= x / (n + 1);
            }
            continue;
        }
        // mu_j = (e^{iz} - j mu_{j-1}) / (iz), and e^{iz} - 1 for j = 0.
        Wide re = cos(x), im = sin(x);
        if (j == 0) {
            re -= 1;
        } else {
            re -= j * mu[static_cast<std::size_t>(j) - 1].re;
            im -= j * mu[static_cast<std::size_t>(j) - 1].im;
        }
        m = {im / x, -re / x};
    }
    return mu;
}

/// The integrals of the cardinal polynomials of the given nodes times e^{izx}.
std::vector<Complex> wideWeights(const std::vector<double>& node, double z) {
    const auto mu = monomialMoments(z, static_cast<int>(node.size()));
    std::vector<Complex> all;
    for (std::size_t i = 0; i < node.size(); ++i) {
        std::vector<Wide> c = {1};
        for (std::size_t k = 0; k < node.size(); ++k) {
            if (k == i) continue;
            const Wide scale = 1 / (Wide(node[i]) - Wide(node[k]));
            c.emplace_back(0);
            for (std::size_t n = c.size(); n-- > 0;)
                c[n] = scale *
                       ((n > 0 ? c[n - 1] : Wide(0)) - (n + 1 < c.size() ? c[n] * Wide(node[k]) : Wide(0)));
        }
        WidePair sum;
        for (std::size_t n = 0; n < c.size(); ++n) {
            sum.re += c[n] * mu[n].re;
            sum.im += c[n] * mu[n].im;
        }
        all.emplace_back(static_cast<double>(sum.re), static_cast<double>(sum.im));
    }
    return all;
}

double worst(const std::vector<Complex>& a, const std::vector<Complex>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

/// |Q - I| for f = exp on [0, h] at h w = z.
double errorOfExp(FilonNodes nodes, int count, double h, double z) {
    const FilonRule rule = filonRule(nodes, count, z);
    Complex sum = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) sum += rule.weight[i] * std::exp(h * rule.node[i]);
    const Complex s(h, z);
    return h * std::abs(sum - (std::exp(s) - 1.0) / s);
}

double slope(double large, double small, double ratio) { return std::log(large / small) / std::log(ratio); }

/// Sum of W_im f(c_i, tau_m).
double onGrid(const FilonGrid& grid, const std::function<double(double, double)>& f) {
    double sum = 0;
    for (std::size_t i = 0; i < grid.node.size(); ++i)
        for (std::size_t m = 0; m < grid.phase.size(); ++m)
            sum += grid.weight[i * grid.phase.size() + m] * f(grid.node[i], grid.phase[m][0]);
    return sum;
}

}  // namespace

class FilonTest : public QObject {
    Q_OBJECT

private slots:
    void weightsAreGoodToRoundOffForEveryFrequency() {
        // Measured: 2.9e-16 at most.
        std::vector<double> all = {0};
        for (int e = -12; e <= 12; ++e)
            for (const double digit : {1.0, 2.5, 7.3})
                all.push_back(std::min(1e12, digit * std::pow(10.0, e)));
        for (double z = 1; z < 24; z += 0.25) all.push_back(z);  // where the three routes to j_n meet
        for (const FilonNodes nodes : bothNodes)
            for (const int count : {2, 3, 4, 5, 6, 7, 8, 12, 16})
                for (const double z : all)
                    for (const double sign : {1.0, -1.0}) {
                        const FilonRule rule = filonRule(nodes, count, sign * z);
                        const double error = worst(rule.weight, wideWeights(rule.node, sign * z));
                        QVERIFY2(
                            error <= 1e-15,
                            qPrintable(QString("%1 nodes, z = %2: %3").arg(count).arg(sign * z).arg(error)));
                    }
    }
    void besselFunctionsOfManyOrdersDoNotOverflow() {
        for (const double x : {0.5, 1.0, 20.0, 59.0}) {
            const std::vector<double> j = sphericalBessel(x, 150);
            for (unsigned n = 0; n < 60; ++n) {
                const double exact = std::sph_bessel(n, x);
                QVERIFY2(std::abs(j[n] - exact) <= 1e-12 * std::abs(exact) + 1e-15,
                         qPrintable(QString("j_%1(%2)").arg(n).arg(x)));
            }
        }
    }
    void weightsHaveTheirKnownValues() {
        const auto has = [](const FilonRule& rule, const std::vector<Complex>& exact) {
            QCOMPARE(rule.weight.size(), exact.size());
            QVERIFY(worst(rule.weight, exact) <= 1e-15);
        };
        has(filonRule(FilonNodes::lobatto, 3, 1), {{.1744183666365537, .002680208280455376},
                                                   {.5705586549906132, .3116976138232962},
                                                   {.09649396318072963, .1453198720281087}});
        has(filonRule(FilonNodes::lobatto, 3, 10), {{.02378536915279295, .08720350277480049},
                                                    {-.01078930772405686, .03647341666818641},
                                                    {-.06739817251767308, .06023023346465834}});
        has(filonRule(FilonNodes::lobatto, 4, 1), {{.0834767182550169, -.0003644992523984692},
                                                   {.4004748749224007, .114497050037956},
                                                   {.3127234438158657, .2751249672411643},
                                                   {.04479594781461318, .07044017610513849}});
        has(filonRule(FilonNodes::gauss, 3, 1), {{.2760602609889951, .03125989322325553},
                                                 {.3899504351124243, .2130308936175869},
                                                 {.175460288706477, .2154069072910179}});
        has(filonRule(FilonNodes::lobatto, 3, 1000), {{3.559071558128575e-6, .001000825129056837},
                                                      {-6.242901268838556e-6, -3.304017194738336e-6},
                                                      {.0008295633702427125, -.0005599001881528018}});
    }
    void otherWeightsAreSeenToBeWrong() {
        // Legendre's polynomials in place of the cardinal ones: their integrals do not even sum to that of 1.
        const auto moment = monomialMoments(1, 3);
        const auto at = [&](std::size_t n) {
            return Complex(static_cast<double>(moment[n].re), static_cast<double>(moment[n].im));
        };
        const Complex legendre = at(0) + (2.0 * at(1) - at(0)) + (6.0 * at(2) - 6.0 * at(1) + at(0));
        QVERIFY(std::abs(legendre - at(0)) > 0.1);
        const auto cardinal = filonRule(FilonNodes::gauss, 3, 1).weight;
        QVERIFY(std::abs(cardinal[0] + cardinal[1] + cardinal[2] - at(0)) < 1e-15);
        // Lobatto with gamma = 2n + 1 throughout; only the last term differs.
        const FilonRule rule = filonRule(FilonNodes::lobatto, 3, 1);
        const double last = sphericalBessel(0.5, 3)[2];
        const Complex wrong = rule.weight[0] - std::polar(1.0, 0.5) * (5.0 - 2.0) * (1.0 / 6) * last;
        QVERIFY(std::abs(wrong - wideWeights(rule.node, 1)[0]) > 1e-3);
        // By parts in double: at small z all digits are lost.
        const double z = 1e-2;
        Complex mu = (std::polar(1.0, z) - 1.0) / Complex(0, z);
        for (int j = 1; j < 5; ++j) mu = (std::polar(1.0, z) - static_cast<double>(j) * mu) / Complex(0, z);
        const auto exact = monomialMoments(z, 5)[4];
        QVERIFY(std::abs(mu - Complex(static_cast<double>(exact.re), static_cast<double>(exact.im))) > 1e-7);
    }
    void errorsOfAnExponentialAreThoseMeasured() {
        struct Row {
            double z;
            std::array<double, 6> error;  // Gauss 3, 4, 5, Lobatto 3, 4, 5
        };
        const Row table[] = {{.01, {8.24e-7, 9.33e-10, 6.5e-13, 5.80e-4, 1.10e-6, 1.17e-9}},
                             {.1, {8.48e-7, 9.70e-10, 6.9e-13, 6.24e-4, 1.14e-6, 1.21e-9}},
                             {1, {1.62e-5, 5.97e-8, 1.42e-10, 2.35e-3, 1.66e-5, 6.38e-8}},
                             {10, {3.20e-3, 1.85e-4, 5.87e-6, 1.90e-3, 3.20e-4, 1.85e-5}},
                             {100, {2.78e-4, 2.37e-6, 1.11e-6, 6.68e-6, 2.77e-6, 2.10e-8}},
                             {1e3, {2.47e-5, 9.83e-7, 9.61e-8, 1.37e-7, 2.46e-8, 9.77e-10}},
                             {1e4, {5.56e-7, 1.97e-7, 1.96e-9, 2.78e-9, 5.16e-11, 1.97e-11}},
                             {1e5, {3.52e-8, 1.99e-8, 9.4e-11, 2.82e-11, 2.8e-13, 2.0e-13}},
                             {1e6, {2.76e-8, 4.05e-10, 1.1e-10, 6.1e-14, 2.8e-14, 4e-16}}};
        for (const Row& row : table)
            for (int c = 0; c < 6; ++c) {
                const double error = errorOfExp(bothNodes[c / 3], 3 + c % 3, 1, row.z);
                const double expected = row.error[static_cast<std::size_t>(c)];
                QVERIFY2(error <= 2 * expected + 1e-15 && error >= expected / 2 - 1e-15,
                         qPrintable(QString("z = %1, column %2: %3").arg(row.z).arg(c).arg(error)));
            }
    }
    void errorsFallAsTheyShouldInTheStepAndInTheFrequency() {
        for (const FilonNodes nodes : bothNodes)
            for (int count = 2; count <= 4; ++count)
                for (const double z : {1.0, 1000.0}) {
                    // Measured: 0.036 to 0.037 above count + 1.
                    const double order =
                        slope(errorOfExp(nodes, count, 0.1, z), errorOfExp(nodes, count, 0.05, z), 2);
                    QVERIFY2(std::abs(order - (count + 1)) < 0.05,
                             qPrintable(QString("%1 nodes, z %2: %3").arg(count).arg(z).arg(order)));
                }
        // The largest error of a whole turn of the phase: 1/z inside, 1/z^2 with the ends as nodes.
        const auto envelope = [](FilonNodes nodes, double z) {
            double most = 0;
            for (int i = 0; i < 64; ++i)
                most = std::max(most, errorOfExp(nodes, 3, 1, z + i * std::numbers::pi / 32));
            return most;
        };
        for (const FilonNodes nodes : bothNodes) {
            const double rate = slope(envelope(nodes, 1e3), envelope(nodes, 1e5), 100);
            QVERIFY2(std::abs(rate - (nodes == FilonNodes::gauss ? 1 : 2)) < 0.1,
                     qPrintable(QString::number(rate)));
        }
    }
    void gridsAreExactForHarmonicsOfPolynomials() {
        for (const FilonNodes nodes : bothNodes)
            for (const double z : {0.0, 0.3, 7.0, 25.0, 1e3, 1e6}) {
                const FilonGrid grid = filonGrid(nodes, 6, {8, 1}, {z, 0});
                for (int k = 0; k <= 3; ++k) {
                    const auto mu = monomialMoments(k * z, 6);
                    for (int j = 0; j < 6; ++j) {
                        const auto at = static_cast<std::size_t>(j);
                        const double c = onGrid(
                            grid, [&](double x, double tau) { return std::pow(x, j) * std::cos(k * tau); });
                        const double s = onGrid(
                            grid, [&](double x, double tau) { return std::pow(x, j) * std::sin(k * tau); });
                        QVERIFY(std::abs(c - static_cast<double>(mu[at].re)) < 1e-15);
                        QVERIFY(std::abs(s - static_cast<double>(mu[at].im)) < 1e-15);
                    }
                }
            }
    }
    void gridsOfTwoPhasesAreExactForTheirCombinations() {
        const std::array<double, 2> z{161.8, 61.8};
        const FilonGrid grid = filonGrid(FilonNodes::lobatto, 5, {6, 8}, z);
        double worst = 0;
        for (int k = -2; k <= 2; ++k)
            for (int l = -3; l <= 3; ++l) {
                const double rate = k * z[0] + l * z[1];
                const auto mu = monomialMoments(std::abs(rate), 5);
                for (int j = 0; j < 5; ++j) {
                    Complex sum = 0;
                    for (std::size_t i = 0; i < grid.node.size(); ++i)
                        for (std::size_t m = 0; m < grid.phase.size(); ++m)
                            sum += grid.weight[i * grid.phase.size() + m] * std::pow(grid.node[i], j) *
                                   std::polar(1.0, k * grid.phase[m][0] + l * grid.phase[m][1]);
                    const auto at = static_cast<std::size_t>(j);
                    const Complex exact(static_cast<double>(mu[at].re),
                                        (rate < 0 ? -1 : 1) * static_cast<double>(mu[at].im));
                    worst = std::max(worst, std::abs(sum - exact));
                }
            }
        qInfo("%.1e", worst);
        QVERIFY(worst < 2e-15);
    }
    void gridsWithTooFewPhasesMissTheSquareOfAnOscillation() {
        // cos^2 has the harmonic 2: four phases fold it onto a constant, six see it.
        const double z = 1e3, exact = 0.5 + std::sin(2 * z) / (4 * z);
        const auto square = [](double, double tau) { return std::cos(tau) * std::cos(tau); };
        QVERIFY(std::abs(onGrid(filonGrid(FilonNodes::lobatto, 4, {6, 1}, {z, 0}), square) - exact) < 1e-15);
        QVERIFY(std::abs(onGrid(filonGrid(FilonNodes::lobatto, 4, {4, 1}, {z, 0}), square) - exact) > 1e-4);
    }
};

EXTREMAL_TEST(FilonTest)
}  // namespace extremal::filon_test

#include "filon_test.moc"
