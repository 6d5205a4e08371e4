// SPDX-License-Identifier: GPL-3.0-or-later
/// Laws of products of many groups: what a chain costs grows with its length and no faster, counted in
/// multiplications; leaving out the blocks of factors that L does not couple changes nothing; orders of long
/// chains by another route; tangent maps of coupled factors; names by index.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/family/lie/product_blocks.hpp"
#include "engine/family/scheme.hpp"
#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/test.hpp"

namespace extremal::group_products_test {
namespace {

using namespace laws;

/// Couplings of every two factors that are 0 in double precision beside everything else.
std::string allPairs(int count) {
    std::string text;
    for (int i = 1; i <= count; ++i)
        for (int j = 1; j < i; ++j)
            text += " + 1e-200*b" + std::to_string(i) + "_g33*b" + std::to_string(j) + "_g33*b" +
                    std::to_string(i) + "_xi1*b" + std::to_string(j) + "_xi1";
    return text;
}

Couplings chainOf(int count) {
    std::vector<std::pair<int, int>> coupled;
    for (int k = 1; k < count; ++k) coupled.emplace_back(k - 1, k);
    return {std::vector<int>(static_cast<std::size_t>(count), 3), coupled};
}

}  // namespace

class GroupProductsTest : public QObject {
    Q_OBJECT

private slots:
    /// Multiplications of a factorisation and numbers kept, of chains and of all bodies in one block.
    void workGrowsWithLength() {
        for (const int s : {1, 2, 4}) {
            const auto work = [&](int count, bool isJoined) {
                return blocksOf(chainOf(count), s, isJoined).work();
            };
            const auto perBody = [&](int count) { return work(count, false) / count; };
            qInfo("degree %d, per body: 2 %.0f, 4 %.0f, 16 %.0f, 64 %.0f, 256 %.0f; in one block 16 %.0f", s,
                  perBody(2), perBody(4), perBody(16), perBody(64), perBody(256), work(16, true) / 16);
            // So many multiplications for each body more, whatever the length.
            const double each = work(9, false) - work(8, false);
            for (const int count : {16, 64, 256})
                QVERIFY(std::abs(work(count, false) - work(8, false) - (count - 8) * each) <
                        1e-9 * each * count);
            QVERIFY(work(16, true) > 10 * work(16, false));
        }
        for (const int count : {4, 32, 64}) {
            const System system = chainOfBodies(count, true).system();
            const Couplings& on = *system.part<LieGroup>().mechanics->couplings;
            QCOMPARE(static_cast<int>(on.pairs().size()), 3 * count - 2);
            QCOMPARE(static_cast<int>(on.entries()), 9 * (3 * count - 2));
        }
    }

    /// Without the blocks of bodies that are not neighbours, and with all of them.
    void blocksLeaveNothingOut() {
        const int count = 6;
        const GroupCase sparse = chainOfBodies(count, true),
                        full = chainOfBodies(count, true, allPairs(count));
        const System one = sparse.system(), other = full.system();
        QCOMPARE(other.part<LieGroup>().mechanics->couplings->pairs().size(), std::size_t{count * count});
        for (const int s : {1, 2, 3})
            for (const LieForm& form : lieForms) {
                const Discretization scheme = lieFormed(s, form);
                const auto a = after(*makeIntegrator(one, scheme, {0, 0.1}), sparse.start(one), 40),
                           b = after(*makeIntegrator(other, scheme, {0, 0.1}), full.start(other), 40);
                QVERIFY(a && b);
                const double apart = distance(a->x, b->x, 0, 15 * count);
                qInfo("degree %d%s: %.1e", s, form.name, apart);
                QVERIFY(apart < 1e-12);
            }
    }

    void ordersOfLongChains() {
        for (const bool hasHinges : {false, true}) {
            const GroupCase each = chainOfBodies(12, hasHinges);
            const System system = each.system();
            const State start = each.start(system);
            const std::vector<double> reference = referenceOf(system, start, each.duration);
            for (const int s : {1, 2, 3}) {
                const GroupErrors coarse = errorsOf(system, start, reference, liePair(s), each.duration, 10),
                                  fine = errorsOf(system, start, reference, liePair(s), each.duration, 20);
                const double slope = std::log2(coarse.g / fine.g), slopeMu = std::log2(coarse.mu / fine.mu);
                qInfo("hinges %d, s = %d: %.2e %.2e, slopes %.2f, %.2f", hasHinges, s, fine.g, fine.mu, slope,
                      slopeMu);
                QVERIFY(std::abs(slope - 2 * s) < 0.15);
                QVERIFY(slopeMu > 2 * s - 0.15);
            }
        }
    }

    /// The Jacobian of coupled factors is that of the equations: Newton's method with it is quadratic, and
    /// takes no more iterations in a long chain than in a short one.
    void iterationsDoNotGrow() {
        for (const LieForm& form : lieForms) {
            const auto iterations = [&](int count) {
                const GroupCase each = chainOfBodies(count, true);
                const System system = each.system();
                const auto integrator = makeIntegrator(system, lieFormed(2, form), {0, 0.1});
                State state = each.start(system);
                long long all = 0;
                for (int k = 0; k < 20; ++k) {
                    const StepReport report = advance(*integrator, state);
                    if (report.outcome != Outcome::converged) return 1e300;
                    all += report.cost.iterations;
                }
                return static_cast<double>(all) / 20;
            };
            const double few = iterations(2), many = iterations(32);
            qInfo("iterations a step%s: 2 bodies %.2f, 32 bodies %.2f", form.name, few, many);
            QVERIFY(many <= few + 1);
            QVERIFY(many < (form.isSymmetric ? 10 : 6));
        }
    }

    /// Factors, names of parts and the start by index.
    void byIndex() {
        const Value product = Value::Object{{"product", Value::Object{{"b[1..n]", "so3"}}}};
        const System system = systemNamed(
            "group", {{"group", product},
                      {"parameters", Value::Object{{"n", 3.0}}},
                      {"let", Value::Object{{"T[i=1..n]", "(b[i]_xi1^2 + b[i]_xi2^2 + 2*b[i]_xi3^2)/2"}}},
                      {"lagrangian", "sum(i, 1..n, T[i]) - sum(i, 2..n, b[i]_g33*b[i-1]_g33)"}});
        const auto x = system.start(
            Settings{
                "",
                {{"g", Value::Object{{"b[i=1..n]", Value::Object{{"exp", Value::Array{"0.1*i", 0.0, 0.0}}}}}},
                 {"xi", Value::Object{{"b[2..n]", Value::Array{0.0, 0.0, 1.0}}}}},
                {}},
            0);
        for (int k = 0; k < 3; ++k) {
            QVERIFY(std::abs(x[static_cast<std::size_t>(9 * k + 4)] - std::cos(0.1 * (k + 1))) < 1e-15);
            QCOMPARE(x[static_cast<std::size_t>(27 + 3 * k + 2)], k == 0 ? 0.0 : 2.0);
        }
        QCOMPARE(system.columns.front().name, std::string("b1.g.11"));
    }
};

EXTREMAL_TEST(GroupProductsTest)
}  // namespace extremal::group_products_test

#include "group_products_test.moc"
