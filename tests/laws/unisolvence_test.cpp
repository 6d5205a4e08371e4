// SPDX-License-Identifier: GPL-3.0-or-later
/// Which pairs make sense is decided by a table made in quadruple precision; here it is decided again, from
/// scratch: from the rank of what the nodes see of the curve, and from what a step does to a free particle.
#include <QTest>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/dense.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::unisolvence_test {
namespace {

/// Rank of the velocities at the nodes, of monomials t, t^2, ..., t^s: s where no motion inside the step is
/// free of cost.
int rankAtNodes(int degree, const Rule<double>& rule) {
    const int n = std::max(rule.size(), degree);
    Eigen::MatrixXd velocity = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < rule.size(); ++i)
        for (int a = 1; a <= degree; ++a)
            velocity(i, a - 1) = a * std::pow(2 * rule.c[static_cast<std::size_t>(i)] - 1, a - 1);
    const Eigen::VectorXd values = dense::singularValues(velocity);
    return static_cast<int>((values.array() > 1e-10 * values(0)).count());
}

/// The rule on monomials, up to the degree to which it is exact.
int exactness(const Rule<double>& rule) {
    for (int k = 0;; ++k) {
        double sum = 0;
        for (int i = 0; i < rule.size(); ++i)
            sum += rule.b[static_cast<std::size_t>(i)] * std::pow(rule.c[static_cast<std::size_t>(i)], k);
        if (std::abs(sum - 1.0 / (k + 1)) > 1e-12) return k - 1;
    }
}

Settings withNodes(const char* type, int nodes) {
    Settings rule{type, {{"nodes", static_cast<double>(nodes)}, {"panels", 1.0}}, {}};
    if (rule.type == "radau") rule.keys.emplace_back("end", "right");
    return rule;
}

}  // namespace

class UnisolvenceTest : public QObject {
    Q_OBJECT
private slots:
    void refusedAreThosePairsThatCannotBeSolved() {
        int refused = 0, accepted = 0;
        for (int s = 1; s <= 10; ++s)
            for (const char* type : {"gauss", "lobatto", "radau", "clenshaw-curtis"})
                for (int n = std::string(type) == "gauss" || std::string(type) == "radau" ? 1 : 2; n <= 13;
                     ++n) {
                    const Settings rule = withNodes(type, n);
                    const Discretization discretization = polynomialPair(s, rule);
                    const Rule<double> r = makeRule<double>(discretization.quadrature);
                    // Solvable: every motion costs; and a free particle keeps its speed: int phi' = 0 is seen
                    // for all phi that vanish at both ends, which have degree s.
                    const bool isSound = rankAtNodes(s, r) == s && exactness(r) >= s - 1;
                    const bool isRefused =
                        !describe(discretization.space, discretization.quadrature).refusal.empty();
                    QVERIFY2(isSound != isRefused,
                             qPrintable(QString("degree %1, %2 %3").arg(s).arg(type).arg(n)));
                    ++(isRefused ? refused : accepted);
                }
        qInfo("%d refused, %d accepted", refused, accepted);
        QVERIFY(refused > 100 && accepted > 100);
    }
    void aRefusedPairIsSingularIndeed() {
        // Made all the same: the step of degree 3 with two Gauss nodes fails, or the solution is not
        // determined.
        const System kepler = systemNamed("kepler");
        const Discretization discretization = polynomialPair(3, withNodes("gauss", 2));
        QVERIFY(!describe(discretization.space, discretization.quadrature).refusal.empty());
        Outcome outcome = Outcome::singular;
        try {
            State state = keplerStart;
            outcome = advance(*makeIntegrator(kepler, discretization, {0, 0.1}), state).outcome;
        } catch (const InvalidScene&) {
        }
        QVERIFY(outcome != Outcome::converged);
    }
    void acceptedPairsKeepAFreeParticleGoing() {
        Settings free{"lagrangian",
                      {{"coordinates", Value(Value::Array{Value("x")})},
                       {"parameters", Value(Value::Object{})},
                       {"lagrangian", "x_t^2/2"}},
                      {}};
        const System system = findModel("lagrangian")->make(free);
        for (int s = 1; s <= 8; ++s)
            for (const char* type : {"gauss", "lobatto", "radau", "clenshaw-curtis"})
                for (int n = 2; n <= 10; ++n) {
                    const Discretization discretization = polynomialPair(s, withNodes(type, n));
                    if (!describe(discretization.space, discretization.quadrature).refusal.empty()) continue;
                    const auto end =
                        after(*makeIntegrator(system, discretization, {0, 0.5}), {0, 0, {1, 3}}, 4);
                    QVERIFY2(end && std::abs(end->x[0] - 7) < 1e-12 && std::abs(end->x[1] - 3) < 1e-12,
                             qPrintable(QString("degree %1, %2 %3").arg(s).arg(type).arg(n)));
                }
    }
    void degreeZeroIsRefused() {
        const ReadScene read = readScene(std::string_view(
            R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[1,0],"p":[0,1]},"time":{"end":1},"schemes":[{"step":0.1,
                "space":{"type":"polynomial","degree":0},"quadrature":"gauss"}]})"));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(read.errors[0].pointer, std::string("/schemes/0/space/degree"));
    }
    void shortfallsAreSaid() {
        const auto read = [](int degree, const std::string& rule) {
            return readScene(std::string_view(
                R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[1,0],"p":[0,1]},"time":{"end":1},"schemes":[{"step":0.1,
                    "space":{"type":"polynomial","degree":)" +
                std::to_string(degree) + R"(},"quadrature":)" + rule + "}]}"));
        };
        const ReadScene few = read(3, R"({"type":"lobatto","nodes":3})");
        QVERIFY(few.errors.empty());
        QCOMPARE(few.warnings.size(), std::size_t(1));
        QCOMPARE(few.warnings[0].pointer, std::string("/schemes/0/quadrature/nodes"));
        QVERIFY(few.warnings[0].message.find("order 4, not the 6") != std::string::npos);
        QCOMPARE(read(2, R"("trapezoid")").warnings.size(), std::size_t(1));
        QVERIFY(read(3, R"({"type":"lobatto","nodes":4})").warnings.empty());
        QVERIFY(read(3, R"("clenshaw-curtis")").warnings.empty());  // its usual nodes: the claim says it
        for (int s = 1; s <= 8; ++s) {
            const Discretization gauss = polynomialPair(s, {"gauss", {}, {}}),
                                 curtis = polynomialPair(s, {"clenshaw-curtis", {}, {}});
            QVERIFY(describe(gauss.space, gauss.quadrature).shortfall.empty());
            const Properties p = describe(curtis.space, curtis.quadrature);
            QCOMPARE(p.shortfall.empty(), p.claims.order == 2 * s);
        }
    }
};

EXTREMAL_TEST(UnisolvenceTest)
}  // namespace extremal::laws::unisolvence_test

#include "unisolvence_test.moc"
