// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include "engine/family/family.hpp"
#include "engine/family/scheme_claims.hpp"
#include "tests/tools/test.hpp"

namespace extremal::scheme_claims_test {
namespace {

/// The rule with its defaults, as every user of a named scheme gets it.
Settings ruleOf(const Discretization& d) { return completeQuadrature(d.space, d.quadrature); }

}  // namespace

class SchemeClaimsTest : public QObject {
    Q_OBJECT
private slots:
    void claimsAreThoseOfTheDiscretization() {
        for (const SchemeEntry& entry : schemeCatalog()) {
            const auto all = claimsByDegree(entry, 5);
            QCOMPARE(all.size(),
                     static_cast<std::size_t>(std::min(5, entry.maxDegree - entry.minDegree + 1)));
            QVERIFY2(!entry.item.claims,
                     entry.item.id.c_str());  // written by hand, they would be a second source
            for (const DegreeClaims& c : all) {
                const Discretization discretization = entry.make(c.degree);
                QCOMPARE(c.claims, describe(discretization.space, ruleOf(discretization)).claims);
            }
            // A formula found at low degrees holds at a high one.
            if (orderFormula(all).empty()) continue;
            const int high = std::min(12, entry.maxDegree);
            const Discretization discretization = entry.make(high);
            QCOMPARE(
                describe(discretization.space, ruleOf(discretization)).claims.order,
                all[0].claims.order + (high - all[0].degree) * (all[1].claims.order - all[0].claims.order));
        }
    }
    void ordersThatFollowAFormulaHaveOne() {
        const auto claims = [](std::vector<int> orders, int from = 1) {
            std::vector<DegreeClaims> all;
            for (const int order : orders) all.push_back({from++, {order, true, true, {}}});
            return all;
        };
        QCOMPARE(orderFormula(claims({2, 4, 6})), std::string("2s"));
        QCOMPARE(orderFormula(claims({2, 3, 4})), std::string("s + 1"));
        QCOMPARE(orderFormula(claims({2, 4, 6}, 2)), std::string("2s - 2"));
        QCOMPARE(orderFormula(claims({2, 4, 4})), std::string());
        QCOMPARE(orderFormula(claims({2, 2, 2})), std::string());
        QCOMPARE(orderFormula(claims({2})), std::string());
    }
};

EXTREMAL_TEST(SchemeClaimsTest)
}  // namespace extremal::scheme_claims_test

#include "scheme_claims_test.moc"
