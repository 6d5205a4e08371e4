// SPDX-License-Identifier: GPL-3.0-or-later
/// Long formulas as groups of instructions that are alike: the bits of the instructions one by one, and the
/// derivatives by hand.
#include <QTest>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_run.hpp"
#include "engine/model/typed/typed_mechanics.hpp"
#include "tests/engine/model/typed/typed.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tape_groups_test {
namespace {

System chainOf(int n, const std::string& lagrangian) {
    return laws::typedSystem(Value::Array{"x[1..n]"}, {{"n", n}}, lagrangian);
}

std::vector<double> valuesFor(const typed::Tape& tape, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> r(tape.registers());
    std::generate_n(r.begin(), tape.inputs(), [&] { return uniform(generator); });
    return r;
}

}  // namespace

class TapeGroupsTest : public QObject {
    Q_OBJECT
private slots:
    void theBitsAreThoseOneByOne_data() {
        QTest::addColumn<QString>("lagrangian");
        const auto row = [](const char* name, const char* potential) {
            QTest::newRow(name) << QString("sum(i, 1..n, x[i]_t^2/2) - (%1)").arg(potential);
        };
        row("springs", "sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4)");
        row("pendulums", "sum(i, 1..n, 1 - cos(x[i])) + sum(i, 1..n-1, (x[i+1]-x[i])^2)");
        row("roots and powers", "sum(i, 1..n, sqrt(1 + x[i]^2)) + sum(i, 1..n-1, 1/(2 + x[i+1]-x[i]))");
        row("cases", "sum(i, 1..n, if(x[i] > 0, x[i]^3, exp(-x[i]))) + sum(i, 1..n-2, max(x[i], x[i+2]))");
        row("second neighbours", "sum(i, 1..n-2, x[i]*x[i+1]*x[i+2]) + sum(i, 1..n, i*x[i]^2)");
        row("time", "sum(i, 1..n, x[i]*sin(i*t)) + sum(i, 1..n-1, cosh(x[i+1] - x[i]))");
    }
    void theBitsAreThoseOneByOne() {
        QFETCH(QString, lagrangian);
        for (const int n : {77, 130, 200}) {
            const System system = chainOf(n, lagrangian.toStdString());
            for (const typed::Tape* tape :
                 {typed::gradientTapeOf(system.mechanics()), typed::jetTapeOf(system.mechanics())}) {
                QVERIFY(tape && !tape->groups().empty());
                QVERIFY(tape->groups().size() < 2 * tape->length() / 3);
                for (const unsigned seed : {1U, 2U}) {
                    std::vector<double> together = valuesFor(*tape, seed);
                    if (seed == 2) together[3] = std::numeric_limits<double>::quiet_NaN();
                    std::vector<double> apart = together;
                    tape->run(together.data());
                    typed::detail::run(*tape, apart.data());
                    for (std::size_t i = 0; i < tape->outputs(); ++i) {
                        const double a = tape->output(i, together.data()), b = tape->output(i, apart.data());
                        QVERIFY((std::isnan(a) && std::isnan(b)) ||
                                std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b));
                    }
                }
            }
        }
    }
    void groupsReadNothingOfTheirOwn() {
        const System system = chainOf(90, "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, sin(x[i+1]-x[i])^3)");
        const typed::Tape& tape = *typed::jetTapeOf(system.mechanics());
        std::size_t next = 0;
        for (const typed::TapeGroup& g : tape.groups()) {
            QCOMPARE(static_cast<std::size_t>(g.first), next);
            next += g.count;
            if (g.count == 1) continue;
            const typed::Instruction* const code = &tape.code()[g.first];
            for (std::uint32_t k = 0; k < g.count; ++k) {
                QCOMPARE(code[k].to, code[0].to + k);
                QCOMPARE(code[k].op, code[0].op);
                QVERIFY(code[k].a < code[0].to && code[k].b < code[0].to);
            }
        }
        QCOMPARE(next, tape.length());
    }
    void forcesOfSpringsByHand() {
        constexpr int n = 150;
        const System system =
            chainOf(n, "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4)");
        const auto& m = system.mechanics();
        std::mt19937 generator(5);
        std::uniform_real_distribution<double> uniform(-1, 1);
        std::vector<double> q(n), f(n);
        for (double& each : q) each = uniform(generator);
        m.force(m.model.get(), 0, q.data(), f.data());
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double right = i + 1 < n ? q[i + 1] - q[i] : 0, left = i > 0 ? q[i] - q[i - 1] : 0;
            most =
                std::max(most, std::abs(f[i] - (right + right * right * right - left - left * left * left)));
        }
        qInfo("%.1e", most);
        QVERIFY(most < 1e-14);
    }
    /// Short formulas stay as they are, and reuse their registers.
    void shortOnesAreNotGrouped() {
        const System system = chainOf(4, "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, (x[i+1]-x[i])^4)");
        QVERIFY(typed::gradientTapeOf(system.mechanics())->groups().empty());
    }
};

EXTREMAL_TEST(TapeGroupsTest)

}  // namespace extremal::tape_groups_test

#include "tape_groups_test.moc"
