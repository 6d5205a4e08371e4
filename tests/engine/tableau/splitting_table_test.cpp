// SPDX-License-Identifier: GPL-3.0-or-later
/// The coefficients of the splittings against the order conditions themselves: the logarithm of the product
/// of exponentials in words of A and B, degree by degree; and their orders in quadruple precision.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/tableau/splitting_table.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::splitting_table_test {
namespace {

constexpr int highest = 9;

/// A polynomial in words of A (0) and B (1), by degree: degree n has 2^n words, the first letter in the
/// highest bit.
using Words = std::vector<Eigen::VectorXd>;

Words zero() {
    Words w;
    for (int n = 0; n <= highest; ++n) w.push_back(Eigen::VectorXd::Zero(1 << n));
    return w;
}
Words letter(int bit, double factor = 1) {
    Words w = zero();
    w[1](bit) = factor;
    return w;
}
Words times(const Words& x, const Words& y) {
    Words z = zero();
    for (int m = 0; m <= highest; ++m)
        for (int n = 0; m + n <= highest; ++n)
            for (int i = 0; i < 1 << m; ++i)
                for (int j = 0; j < 1 << n; ++j)
                    z[static_cast<std::size_t>(m + n)]((i << n) + j) +=
                        x[static_cast<std::size_t>(m)](i) * y[static_cast<std::size_t>(n)](j);
    return z;
}
Words plus(Words x, const Words& y, double factor = 1) {
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += factor * y[n];
    return x;
}
Words bracket(const Words& x, const Words& y) { return plus(times(x, y), times(y, x), -1); }

/// Logarithm of the product of the stages' exponentials.
Words logarithm(const std::vector<SplittingStage>& stages) {
    Words product = zero();
    product[0](0) = 1;
    for (const SplittingStage& s : stages) {
        const Words x = letter(s.isKick ? 1 : 0, s.fraction);
        Words power = product;
        for (int k = 1; k <= highest; ++k) {
            power = times(power, x);
            for (auto& degree : power) degree /= k;
            product = plus(product, power);
        }
    }
    product[0](0) = 0;
    Words log = product, power = product;
    for (int k = 2; k <= highest; ++k) {
        power = times(power, product);
        log = plus(log, power, (k % 2 == 0 ? -1.0 : 1.0) / k);
    }
    return log;
}

/// The ideal of [B, [B, [B, A]]] in one degree from 4 on, as columns.
Eigen::MatrixXd ideal(int degree) {
    const Words A = letter(0), B = letter(1);
    std::vector<Words> span = {bracket(B, bracket(B, bracket(B, A)))};
    for (int n = 5; n <= degree; ++n) {
        std::vector<Words> next;
        for (const Words& w : span) {
            next.push_back(bracket(A, w));
            next.push_back(bracket(B, w));
        }
        span = std::move(next);
    }
    Eigen::MatrixXd columns(1 << degree, static_cast<Eigen::Index>(span.size()));
    for (std::size_t i = 0; i < span.size(); ++i)
        columns.col(static_cast<Eigen::Index>(i)) = span[i][static_cast<std::size_t>(degree)];
    return columns;
}

/// Largest violation of the order conditions up to `order`, in the quotient by the ideal for Nystrom methods.
double violation(const Splitting& s, int order, bool isNystrom) {
    Words log = logarithm(s.stages);
    log[1] -= Eigen::VectorXd::Ones(2);
    double worst = 0;
    for (int n = 1; n <= order; ++n) {
        Eigen::VectorXd rest = log[static_cast<std::size_t>(n)];
        if (isNystrom && n >= 4) {
            const Eigen::MatrixXd span = ideal(n);
            rest -= span * span.colPivHouseholderQr().solve(rest);
        }
        if (!(rest.lpNorm<Eigen::Infinity>() <= worst)) worst = rest.lpNorm<Eigen::Infinity>();
    }
    return worst;
}

struct Named {
    const char* name;
    Splitting splitting;
    std::size_t kicks;
};
std::vector<Named> all() {
    return {{"S6", blanesMoanS6(), 6},   {"S10", blanesMoanS10(), 10}, {"SRKN 6b", srkn6b(), 6},
            {"SRKN 11b", srkn11b(), 11}, {"SRKN 14a", srkn14a(), 14},  {"SRKN 19a", srkn19a(), 19},
            {"SRKN 19b", srkn19b(), 19}};
}

/// Splittings of A + e B: the degrees up to which the logarithm has no words with one B, two, and three.
struct OfWeakKicks {
    const char* name;
    Splitting splitting;
    std::size_t kicks;
    int one, two, three;
};
std::vector<OfWeakKicks> ofWeakKicks() {
    return {{"Gauss 1", gaussKicks(1), 1, 2, 2, 2},     {"Gauss 2", gaussKicks(2), 2, 4, 2, 2},
            {"Gauss 5", gaussKicks(5), 5, 10, 2, 2},    {"Lobatto 2", lobattoKicks(2), 1, 2, 2, 2},
            {"Lobatto 4", lobattoKicks(4), 3, 6, 2, 2}, {"ABA(10,4)", aba104(), 7, 10, 4, 4},
            {"ABA(8,6,4)", aba864(), 7, 8, 6, 4},       {"ABA(10,6,4)", aba1064(), 8, 10, 6, 4}};
}
/// How far the kicks are from a rule that is exact for t^(degree - 1): what words with one B are of.
double ofOneKick(const Splitting& s, int degree) {
    double sum = 0, node = 0;
    for (const SplittingStage& stage : s.stages) {
        if (stage.isKick)
            sum += stage.fraction * std::pow(node, degree - 1);
        else
            node += stage.fraction;
    }
    return std::abs(sum - 1.0 / degree);
}
/// The largest coefficient of words of a degree with so many Bs.
double ofKicks(const Splitting& s, int degree, int kicks) {
    const Eigen::VectorXd log = logarithm(s.stages)[static_cast<std::size_t>(degree)];
    double most = 0;
    for (Eigen::Index word = 0; word < log.size(); ++word)
        if (std::popcount(static_cast<unsigned>(word)) == kicks) most = std::max(most, std::abs(log(word)));
    return most;
}

using Quad = boost::multiprecision::float128;

struct Orders {
    double q, p;
};

/// Slopes over the step of the errors of q and p at t = 3, on the orbit with a = 1, e = 3/5.
Orders orderOnKepler(const Splitting& s) {
    const Quad e = Quad(3) / 5, T(3), b = Quad(4) / 5;
    Quad E = T;
    for (int i = 0; i < 60; ++i) E -= (E - e * sin(E) - T) / (1 - e * cos(E));
    const Quad rate = 1 / (1 - e * cos(E));
    std::vector<double> h, eq, ep;
    // From where the slope is constant to where the digits of the coefficients are felt.
    for (const int n : s.order == 4   ? std::array{300, 450, 675}
                       : s.order == 6 ? std::array{90, 135, 200}
                                      : std::array{60, 80, 105}) {
        Quad q0 = Quad(2) / 5, q1 = 0, p0 = 0, p1 = 2;
        const Quad step = T / n;
        for (int k = 0; k < n; ++k)
            for (const SplittingStage& stage : s.stages) {
                const Quad f = step * stage.fraction;
                if (stage.isKick) {
                    const Quad r2 = q0 * q0 + q1 * q1, w = f / (r2 * sqrt(r2));
                    p0 -= w * q0;
                    p1 -= w * q1;
                } else {
                    q0 += f * p0;
                    q1 += f * p1;
                }
            }
        const Quad dq0 = q0 - (cos(E) - e), dq1 = q1 - b * sin(E);
        const Quad dp0 = p0 + sin(E) * rate, dp1 = p1 - b * cos(E) * rate;
        h.push_back(std::log(3.0 / n));
        eq.push_back(static_cast<double>(log(dq0 * dq0 + dq1 * dq1)) / 2);
        ep.push_back(static_cast<double>(log(dp0 * dp0 + dp1 * dp1)) / 2);
    }
    return {slope(h, eq), slope(h, ep)};
}

/// The pendulum q'' = -g sin q after n steps to t = 3.
std::array<Quad, 2> pendulum(const Splitting& s, int n) {
    const Quad step = Quad(3) / n, g = Quad(981) / 100;
    Quad q = 1, p = Quad(7) / 10;
    for (int k = 0; k < n; ++k)
        for (const SplittingStage& stage : s.stages) {
            if (stage.isKick)
                p -= step * stage.fraction * g * sin(q);
            else
                q += step * stage.fraction * p;
        }
    return {q, p};
}

/// The same on the pendulum, against a run of S10 whose error is 3e-19.
Orders orderOnThePendulum(const Splitting& s) {
    const std::array<Quad, 2> fine = pendulum(blanesMoanS10(), 4000);
    std::vector<double> h, eq, ep;
    for (const int n : s.order == 8 ? std::array{40, 50, 60} : std::array{60, 85, 120}) {
        const std::array<Quad, 2> x = pendulum(s, n);
        h.push_back(std::log(3.0 / n));
        eq.push_back(static_cast<double>(log(abs(x[0] - fine[0]))));
        ep.push_back(static_cast<double>(log(abs(x[1] - fine[1]))));
    }
    return {slope(h, eq), slope(h, ep)};
}

}  // namespace

class SplittingTableTest : public QObject {
    Q_OBJECT
private slots:
    void everyTableIsAPalindrome() {
        for (const Named& n : all()) {
            const auto& s = n.splitting.stages;
            std::size_t kicks = 0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                QCOMPARE(s[i].isKick, s[s.size() - 1 - i].isKick);
                QCOMPARE(s[i].fraction, s[s.size() - 1 - i].fraction);
                kicks += s[i].isKick;
            }
            // A last kick is the first one of the next step.
            QCOMPARE(kicks - (s[0].isKick ? 1 : 0), n.kicks);
        }
    }
    void theOrderConditionsHold() {
        for (const Named& n : all()) {
            const double v = violation(n.splitting, n.splitting.order, n.splitting.isNystrom);
            qInfo("%s: order %d to %.1e", n.name, n.splitting.order, v);
            QVERIFY(v < 2e-15);  // measured: at most 2e-16
        }
    }
    void theyHaveNoHigherOrder() {
        for (const Named& n : all())
            // The smallest: SRKN 14a, 5e-8.
            QVERIFY2(violation(n.splitting, n.splitting.order + 1, n.splitting.isNystrom) > 1e-8, n.name);
    }
    void nystromMethodsOfHighOrderNeedTheirStructure() {
        for (const Named& n : all())
            if (n.splitting.isNystrom && n.splitting.order >= 6)
                QVERIFY(violation(n.splitting, n.splitting.order, false) > 1e-5);
    }
    void swappedCoefficientsBreakTheConditions() {
        for (Named n : all()) {
            auto& s = n.splitting.stages;
            const std::size_t last = s.size() - 1;
            std::swap(s[0].fraction, s[2].fraction);
            std::swap(s[last].fraction, s[last - 2].fraction);
            QVERIFY2(violation(n.splitting, n.splitting.order, n.splitting.isNystrom) > 1e-3, n.name);
        }
    }
    void theOrderIsSeenInQuadruplePrecision_data() {
        QTest::addColumn<std::size_t>("index");
        for (std::size_t i = 0; i < all().size(); ++i) QTest::newRow(all()[i].name) << i;
    }
    void theOrderIsSeenInQuadruplePrecision() {
        QFETCH(std::size_t, index);
        const Splitting s = all()[index].splitting;
        for (const Orders& o : {orderOnKepler(s), orderOnThePendulum(s)}) {
            qInfo("claimed %d, measured q %.3f, p %.3f", s.order, o.q, o.p);
            QVERIFY(std::abs(o.q - s.order) < 0.15);
            QVERIFY(std::abs(o.p - s.order) < 0.15);
        }
    }
    void weakKicksHaveTheirDegrees() {
        for (const OfWeakKicks& n : ofWeakKicks()) {
            const auto& s = n.splitting.stages;
            std::size_t kicks = 0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                QCOMPARE(s[i].fraction, s[s.size() - 1 - i].fraction);
                kicks += s[i].isKick;
            }
            QCOMPARE(kicks - (s[0].isKick ? 1 : 0), n.kicks);
            QCOMPARE(n.splitting.order, std::min({n.one, n.two, n.three}));
            double most = violation(n.splitting, n.splitting.order, false);
            for (int degree = 1; degree <= n.one; ++degree)
                most = std::max(most, ofOneKick(n.splitting, degree));
            QVERIFY(ofOneKick(n.splitting, n.one + 1) > 1e-8);
            for (const auto& [bs, upTo] : {std::pair{2, n.two}, {3, n.three}}) {
                for (int degree = bs + 1; degree <= upTo; ++degree)
                    most = std::max(most, ofKicks(n.splitting, degree, bs));
                QVERIFY2(ofKicks(n.splitting, upTo + 1, bs) > 1e-8 || (bs == 3 && upTo == 2), n.name);
            }
            qInfo("%s: %.1e", n.name, most);
            QVERIFY(most < 1e-15);
        }
    }
    void anErrorInTheNinthPlaceIsSeen() {
        Splitting s = srkn11b();
        s.stages[3].fraction += 1e-9;
        s.stages[s.stages.size() - 4].fraction += 1e-9;
        QVERIFY(std::abs(orderOnKepler(s).q - 6) > 1);  // its error no longer falls: 2e-8
        QVERIFY(violation(s, 6, true) > 1e-9);
    }
};

EXTREMAL_TEST(SplittingTableTest)
}  // namespace extremal::splitting_table_test

#include "splitting_table_test.moc"
