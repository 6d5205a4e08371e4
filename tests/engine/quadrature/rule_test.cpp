// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include "engine/core/problem.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/rule.hpp"
#include "tests/tools/test.hpp"

namespace extremal::rule_test {

using Quad = boost::multiprecision::float128;

namespace {

/// Every rule of the catalogue that has nodes, with n of them where it says how many, at every choice it
/// offers.
std::vector<Settings> rulesWith(int n) {
    std::vector<Settings> all;
    for (const RuleEntry& entry : ruleEntries()) {
        if (!entry.make) continue;
        std::vector<Settings> variants{{entry.item.id, {}, {}}};
        for (const FieldInfo& field : entry.item.parameters) {
            if (field.key == "nodes" && n < field.min) variants.clear();
            if (field.type == FieldType::formulas) variants.clear();  // typed_rule_test.cpp
            if (field.key == "nodes")
                for (Settings& variant : variants) variant.keys.emplace_back("nodes", n);
            std::vector<Settings> chosen;
            for (const std::string& choice : field.choices)
                for (Settings variant : variants) {
                    variant.keys.emplace_back(field.key, choice);
                    chosen.push_back(variant);
                }
            if (!field.choices.empty()) variants = chosen;
        }
        all.insert(all.end(), variants.begin(), variants.end());
    }
    return all;
}

Problem problemOf(const std::string& rule) {
    try {
        (void)makeRule<double>({rule, {{"nodes", 2}}, {}});
    } catch (const InvalidScene& e) {
        return e.problems().front();
    }
    return {};
}

}  // namespace

class RuleTest : public QObject {
    Q_OBJECT
    template <class F>
    void forAll(F f) {
        for (const int n : {1, 2, 3, 5, 8, 13, 24, 60, 200})
            for (const Settings& rule : rulesWith(n)) {
                const std::string name = rule.type + " " + rule.text("end");
                f(makeRule<double>(rule), makeRule<Quad>(rule), name.c_str());
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
            std::vector<Rule<Quad>> rules = {trapezoid<Quad>(n)};
            for (Settings rule : rulesWith(n))
                for (const int panels : {1, 2}) {
                    Settings repeated = rule;
                    repeated.keys.emplace_back("panels", panels);
                    rules.push_back(makeRule<Quad>(repeated));
                }
            for (const Rule<Quad>& rule : rules)
                for (int degree = 0; degree <= rule.degree + 1; ++degree) {
                    Quad sum = 0;
                    for (std::size_t i = 0; i < rule.c.size(); ++i) sum += rule.b[i] * pow(rule.c[i], degree);
                    const double error = static_cast<double>(abs(sum - Quad(1) / (degree + 1)));
                    if (degree <= rule.degree)
                        QVERIFY(error < 1e-31);
                    else
                        QVERIFY(error > 1e-13);
                }
        }
    }
    void catalogueHasTheRulesOfTheContract() {
        for (const char* id : {"gauss", "lobatto", "radau", "clenshaw-curtis", "midpoint", "trapezoid",
                               "exact", "filon-lobatto", "filon-gauss", "auto"})
            QVERIFY2(findRule(id), id);
        QVERIFY(!findRule("gaus"));
    }
    void unknownRuleIsAnErrorThatNamesTheNearest() {
        const Problem problem = problemOf("gaus");
        QCOMPARE(problem.pointer, std::string("/quadrature/type"));
        QVERIFY2(problem.hint.find("\"gauss\"") != std::string::npos, problem.hint.c_str());
    }
    void ruleWithoutNodesOfItsOwnIsAnErrorWithARemedy() {
        for (const RuleEntry& entry : ruleEntries()) {
            if (entry.make) continue;
            QVERIFY2(!entry.refusal.empty() && !entry.hint.empty(), entry.item.id.c_str());
            QCOMPARE(problemOf(entry.item.id).message, entry.refusal);
        }
    }
    void defaultsOfARuleFollowTheSpace() {
        const auto complete = [](const char* id) { return completeRule({id, {}, {}}, {3, 2, 3}); };
        QCOMPARE(complete("gauss"), (Settings{"gauss", {{"nodes", 3}, {"panels", 2}}, {}}));
        QCOMPARE(complete("lobatto").integer("nodes"), 4);
        QCOMPARE(complete("radau"), (Settings{"radau", {{"nodes", 3}, {"end", "right"}, {"panels", 2}}, {}}));
        QCOMPARE(complete("midpoint"), (Settings{"midpoint", {{"panels", 2}}, {}}));
        QCOMPARE(complete("filon-gauss"), (Settings{"filon-gauss", {{"nodes", 5}, {"phases", 16}}, {}}));
        QCOMPARE(completeRule({"gauss", {{"nodes", 7}}, {}}, {3}).integer("nodes"), 7);
        QCOMPARE(completeRule({"gauss", {{"nodes", nullptr}}, {}}, {3}).integer("nodes"), 3);
        QCOMPARE(completeRule({"gauss", {}, {}}, {3, 1, 1, 12}).integer("nodes"), 12);
    }
    void compositeRulesAreAsExactAsTheirRule() {
        const Rule<double> three = composite(lobatto<double>(3), 3);
        QCOMPARE(three.size(), 9);
        QCOMPARE(merged(three).size(), 7);
        for (const Rule<double>& rule : {three, merged(three), composite(gauss<double>(2), 5),
                                         composite(makeRule<double>({"radau", {{"nodes", 2}}, {}}), 2)})
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
