// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "engine/core/text/text.hpp"
#include "tests/tools/test.hpp"

namespace extremal::text_test {

class TextTest : public QObject {
    Q_OBJECT
private slots:
    void numbersReadBackTheSame() {
        std::mt19937_64 random(1);
        for (int i = 0; i < 20000; ++i) {
            const double x = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
            if (!std::isfinite(x)) continue;
            QCOMPARE(std::bit_cast<std::uint64_t>(*parseNumber(formatNumber(x))),
                     std::bit_cast<std::uint64_t>(x));
        }
        QCOMPARE(formatNumber(0.1), std::string("0.1"));
        QCOMPARE(formatNumber(1e-12), std::string("1e-12"));
        QCOMPARE(formatNumber(10000), std::string("10000"));
        QVERIFY(!parseNumber("1,5") && !parseNumber("") && !parseNumber("1 ") && !parseNumber("x"));
    }

    void theNearestNameIsTheOneMeant() {
        const std::vector<std::string> names = {"gauss", "lobatto", "radau", "clenshaw-curtis", "midpoint"};
        QCOMPARE(nearestName("gaus", names), std::string("gauss"));
        QCOMPARE(nearestName("Lobato", names), std::string("lobatto"));
        QCOMPARE(nearestName("guass", names), std::string("gauss"));  // a swap is one edit
        QCOMPARE(nearestName("curtis", names), std::string("clenshaw-curtis"));
        QCOMPARE(nearestName("simpson", names), std::string());
        QCOMPARE(suggestName("simpson", {"a", "b", "c"}), std::string("known: a, b and c"));
    }

    void slugsAreUniqueAndNeverEmpty() {
        QCOMPARE(slug("Galerkin 4, h = 0.1"), std::string("galerkin-4-h-0-1"));
        QCOMPARE(slug("  Störmer--Verlet! "), std::string("stoermer-verlet"));
        QCOMPARE(slug("Kötter–Straße, É 2ω"), std::string("koetter-strasse-e-2omega"));
        QCOMPARE(slug("h²\xC3"), std::string("h"));
        const auto slugs = uniqueSlugs({"RK4", "rk4", "rk4-2", "\u65e5", "Summary"}, {"summary"});
        QCOMPARE(slugs, (std::vector<std::string>{"rk4", "rk4-2", "rk4-2-2", "scheme", "summary-2"}));
    }

    void badUtf8IsFound() {
        QCOMPARE(firstInvalidUtf8("a\u03b8\u20ac\U0001F600"), std::string_view::npos);
        for (const char* bad : {"\xff", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80"})
            QCOMPARE(firstInvalidUtf8(std::string("ab") + bad), std::size_t{2});
        QCOMPARE(codePoints("a\u03b8\u20ac"), std::size_t{3});
    }
};

EXTREMAL_TEST(TextTest)
}  // namespace extremal::text_test

#include "text_test.moc"
