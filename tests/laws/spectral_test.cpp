// SPDX-License-Identifier: GPL-3.0-or-later
/// Spectral convergence: at a fixed step the error falls by a factor with every degree, whatever the order in
/// the step. That is what spectral variational integrators are for (Hall and Leok 2015).
#include <QTest>

#include <algorithm>
#include <vector>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::spectral_test {
namespace {

/// Largest error over four steps of half a unit each, on Kepler's orbit.
double errorOf(const Discretization& discretization) {
    static const System kepler = systemNamed("kepler");
    const ExactSolution exact = kepler.exact(keplerStart);
    const auto step = makeIntegrator(kepler, discretization, {0, 0.5});
    State state = keplerStart;
    double worst = 0;
    std::vector<double> x(4);
    for (int k = 0; k < 4; ++k) {
        if (advance(*step, state).outcome != Outcome::converged) return 1;
        exact(state.t, x);
        worst = std::max(worst, distance(state.x, x, 0, 4));
    }
    return worst;
}

/// Slope of the logarithm of the error over the degree, while it is above round-off.
double digitsPerDegree(const std::vector<Discretization>& pairs) {
    std::vector<double> degree, digits;
    for (const Discretization& discretization : pairs) {
        const double e = errorOf(discretization);
        if (e < 1e-12) break;
        degree.push_back(discretization.space.number("degree"));
        digits.push_back(-std::log10(e));
    }
    return slope(degree, digits);
}

std::vector<Discretization> family(const std::string& rule, int from, int to) {
    std::vector<Discretization> pairs;
    for (int s = from; s <= to; ++s) pairs.push_back(polynomialPair(s, {rule, {}, {}}));
    return pairs;
}

}  // namespace

class SpectralTest : public QObject {
    Q_OBJECT
private slots:
    void errorsFallWithTheDegree_data() {
        QTest::addColumn<QString>("rule");
        QTest::addColumn<double>("least");
        QTest::newRow("Gauss") << "gauss" << 0.9;      // measured 1.01
        QTest::newRow("Lobatto") << "lobatto" << 0.9;  // 0.99
        QTest::newRow("Clenshaw-Curtis")
            << "clenshaw-curtis" << 0.2;  // 0.27: the rule is exact to degree s alone
    }
    void errorsFallWithTheDegree() {
        QFETCH(QString, rule);
        QFETCH(double, least);
        const double digits = digitsPerDegree(family(rule.toStdString(), 3, 24));
        qInfo("%.3f digits a degree", digits);
        QVERIFY(digits > least);
    }
    void aRuleThatDoesNotGrowStopsIt() {
        // High degrees with a composite rule, two Gauss nodes in as many panels as the degree: its order 4
        // decides.
        std::vector<Discretization> pairs;
        for (int s = 3; s <= 16; ++s) {
            Discretization discretization;
            discretization.space = {
                "polynomial", {{"degree", static_cast<double>(s)}, {"basis", "lobatto"}}, {}};
            discretization.quadrature = {"gauss", {{"nodes", 2.0}, {"panels", static_cast<double>(s)}}, {}};
            pairs.push_back(discretization);
        }
        const double digits = digitsPerDegree(pairs);
        qInfo("%.3f digits a degree", digits);
        QVERIFY(digits < 0.1);  // measured -0.19
    }
};

EXTREMAL_TEST(SpectralTest)
}  // namespace extremal::laws::spectral_test

#include "spectral_test.moc"
