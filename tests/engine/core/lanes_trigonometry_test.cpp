// SPDX-License-Identifier: GPL-3.0-or-later
/// sin and cos of eight numbers: against quadruple precision, with the same bits in every instruction set.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "tests/tools/test.hpp"

namespace extremal::lanes_trigonometry_test {

using Quadruple = boost::multiprecision::float128;

void evaluate(const double* x, double* s, double* c, int n) {
    for (int i = 0; i < n; i += 8) {
        sin(Lanes::load(x + i)).store(s + i);
        cos(Lanes::load(x + i)).store(c + i);
    }
}

struct Values {
    std::vector<double> x, s, c;
    explicit Values(std::vector<double> at) : x(std::move(at)), s(x.size()), c(x.size()) {
        ForThisMachine<&evaluate>::call()(x.data(), s.data(), c.data(), static_cast<int>(x.size()));
    }
};

/// Error in units of the last place of what is right.
double units(double value, const Quadruple& right) {
    using std::abs;
    const double rounded = std::abs(static_cast<double>(right));
    const double unit = std::nextafter(rounded, HUGE_VAL) - rounded;
    return static_cast<double>(abs(Quadruple(value) - right)) / unit;
}

class LanesTrigonometryTest : public QObject {
    Q_OBJECT
private slots:
    void isWithinOneUnitOfTheLastPlace() {
        std::mt19937_64 generator(1);
        double worst = 0;
        for (const double range : {1e-8, 1.0, 10.0, 1e3, 1e5}) {
            std::uniform_real_distribution<double> any(-range, range);
            std::vector<double> at(4096);
            for (double& x : at) x = any(generator);
            const Values v(at);
            for (std::size_t i = 0; i < at.size(); ++i)
                worst = std::max(
                    {worst, units(v.s[i], sin(Quadruple(at[i]))), units(v.c[i], cos(Quadruple(at[i])))});
        }
        QVERIFY2(worst < 0.9, qPrintable(QString::number(worst)));  // 0.72
    }
    void quadrantsHaveTheirSigns() {
        std::vector<double> at(64);
        for (std::size_t i = 0; i < at.size(); ++i)
            at[i] = (static_cast<double>(i) - 32) * std::numbers::pi / 2;
        const Values v(at);
        for (std::size_t i = 0; i < at.size(); ++i) {
            // Near their zeros only the reduction in three parts has any digit right.
            QVERIFY(units(v.s[i], sin(Quadruple(at[i]))) < 0.9);
            QVERIFY(units(v.c[i], cos(Quadruple(at[i]))) < 0.9);
        }
    }
    void largeNumbersAreThoseOfTheLibrary() {
        const Values v({1e5, 1.1e5, -3e7, 1e22, 0, -0.0, 1, 2});
        for (std::size_t i = 0; i < v.x.size(); ++i) {
            QCOMPARE(v.s[i], std::sin(v.x[i]));
            QCOMPARE(v.c[i], std::cos(v.x[i]));
        }
        QVERIFY(std::signbit(v.s[5]));
        const Values odd({0, 1, HUGE_VAL, std::numeric_limits<double>::quiet_NaN(), 2, 3, 4, 5});
        QVERIFY(std::isnan(odd.s[2]) && std::isnan(odd.c[3]));
        QCOMPARE(odd.c[0], 1.0);
    }
    void everyInstructionSetGivesTheSameBits() {
        std::vector<double> at(800), s(800), c(800);
        for (std::size_t i = 0; i < at.size(); ++i) at[i] = 0.37 * static_cast<double>(i) - 100;
        const Values v(at);
        evaluate(at.data(), s.data(), c.data(), 800);
        QVERIFY(s == v.s && c == v.c);
    }
};

EXTREMAL_TEST(LanesTrigonometryTest)

}  // namespace extremal::lanes_trigonometry_test

#include "lanes_trigonometry_test.moc"
