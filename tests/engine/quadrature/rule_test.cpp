#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include "engine/quadrature/rule.hpp"
#include "tests/tools/test.hpp"

namespace extremal::rule_test {

using Quad = boost::multiprecision::float128;

class RuleTest : public QObject {
    Q_OBJECT
    template <class F>
    void forAll(F f) {
        for (const int n : {1, 2, 3, 5, 8, 13, 24, 60, 200}) {
            f(gauss<double>(n), gauss<Quad>(n), "gauss");
            f(radau<double>(n, true), radau<Quad>(n, true), "radau right");
            f(radau<double>(n, false), radau<Quad>(n, false), "radau left");
            if (n < 2) continue;
            f(lobatto<double>(n), lobatto<Quad>(n), "lobatto");
            f(clenshawCurtis<double>(n), clenshawCurtis<Quad>(n), "clenshaw-curtis");
        }
    }

private slots:
    void nodesAndWeightsAreGoodToRoundOff() {
        forAll([](const Rule<double>& rule, const Rule<Quad>& exact, const char* name) {
            for (int i = 0; i < rule.size(); ++i) {
                const auto k = static_cast<std::size_t>(i);
                const double c = static_cast<double>(abs(rule.c[k] - exact.c[k]));
                const double b = static_cast<double>(abs(rule.b[k] - exact.b[k]));
                QVERIFY2(
                    c <= 2e-16 && b <= 2e-16,
                    qPrintable(
                        QString("%1(%2), node %3: %4 %5").arg(name).arg(rule.size()).arg(i).arg(c).arg(b)));
            }
        });
    }
    void polynomialsAreExactToTheDegreeAndNotBeyond() {
        for (const int n : {1, 2, 3, 4, 5, 6, 7}) {
            std::vector<Rule<Quad>> rules = {gauss<Quad>(n), radau<Quad>(n, true), radau<Quad>(n, false),
                                             midpoint<Quad>(n), trapezoid<Quad>(n)};
            if (n >= 2) rules.insert(rules.end(), {lobatto<Quad>(n), clenshawCurtis<Quad>(n)});
            for (const Rule<Quad>& rule : rules)
                for (int degree = 0; degree <= rule.degree + 1; ++degree) {
                    Quad sum = 0;
                    for (std::size_t i = 0; i < rule.c.size(); ++i) sum += rule.b[i] * pow(rule.c[i], degree);
                    const double error = static_cast<double>(abs(sum - Quad(1) / (degree + 1)));
                    if (degree <= rule.degree)
                        QVERIFY(error < 1e-31);
                    else
                        QVERIFY(error > 1e-12);
                }
        }
    }
    void compositeRulesAreAsExactAsTheirRule() {
        const Rule<double> three = composite(lobatto<double>(3), 3);
        QCOMPARE(three.size(), 9);
        QCOMPARE(merged(three).size(), 7);
        for (const Rule<double>& rule :
             {three, merged(three), composite(gauss<double>(2), 5), composite(radau<double>(2, true), 2)})
            for (int degree = 0; degree <= rule.degree; ++degree) {
                double sum = 0;
                for (std::size_t i = 0; i < rule.c.size(); ++i)
                    sum += rule.b[i] * std::pow(rule.c[i], degree);
                QVERIFY(std::abs(sum - 1.0 / (degree + 1)) < 1e-15);
            }
        // The nodes at a common end are one inside each panel.
        QVERIFY(three.c[2] < three.c[3] && three.c[3] - three.c[2] < 1e-15);
        QCOMPARE(three.c[3], 1.0 / 3);
    }
    void partialWeightsIntegrateThePiecewiseInterpolant() {
        for (const Rule<double>& rule : {gauss<double>(4), composite(lobatto<double>(4), 3),
                                         merged(composite(lobatto<double>(4), 3)), trapezoid<double>(5)})
            for (const double tau : {0.0, 0.1, 0.37, 0.6, 0.99, 1.0}) {
                std::vector<double> share(rule.c.size());
                partialWeights<double>(rule, tau, share);
                const int exact = rule.perPanel > 0 ? rule.perPanel - 1 : rule.size() - 1;
                for (int degree = 0; degree <= exact; ++degree) {
                    double sum = 0;
                    for (std::size_t i = 0; i < rule.c.size(); ++i)
                        sum += share[i] * std::pow(rule.c[i], degree);
                    QVERIFY2(
                        std::abs(sum - std::pow(tau, degree + 1) / (degree + 1)) < 1e-14,
                        qPrintable(
                            QString("%1 nodes, tau %2, degree %3").arg(rule.size()).arg(tau).arg(degree)));
                }
                if (tau == 1)
                    for (std::size_t i = 0; i < share.size(); ++i)
                        QVERIFY(std::abs(share[i] - rule.b[i]) < 1e-15);
            }
    }
    void symmetricRulesAreMirrorImages() {
        forAll([](const Rule<double>& rule, const Rule<Quad>&, const char*) {
            double defect = 0;
            for (std::size_t i = 0; i < rule.c.size(); ++i)
                defect = std::max({defect, std::abs(rule.c[i] + rule.c[rule.c.size() - 1 - i] - 1),
                                   std::abs(rule.b[i] - rule.b[rule.b.size() - 1 - i])});
            QVERIFY(rule.isSymmetric ? defect < 2e-16 : defect > 1e-6);
        });
    }
};

EXTREMAL_TEST(RuleTest)
}  // namespace extremal::rule_test

#include "rule_test.moc"
