// SPDX-License-Identifier: GPL-3.0-or-later
/// Long formulas as groups of instructions that are alike: the bits of the instructions one by one, the
/// derivatives by hand, and what makes them fast: operands side by side, few registers, sums that do not
/// wait.
#include <QTest>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "engine/model/typed/tape/free_registers.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_line.hpp"
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

constexpr const char* springs =
    "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4)";
constexpr const char* star = "sum(i, 1..n, x[i]_t^2/2) - sum(i, 2..n, (x[i]-x[1])^4/(4*i))";

bool isSame(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool isSideBySide(const typed::TapeGroup& g) {
    constexpr auto scattered = typed::TapeGroup::Operand::scattered;
    return g.isLoop && g.a != scattered && g.b != scattered && g.c != scattered;
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
        row("a star", "sum(i, 2..n, (x[i]-x[1])^2/2 + (x[i]-x[1])^4/(4*i))");
        row("rows of eleven", "sum(i, 1..n-1, (x[i+1]-x[i])^4) + sum(i, 1..n-11, (x[i+11]-x[i])^4)");
        row("pairs", "sum(i, 1..19, sum(j, i+1..20, 1/sqrt(1 + (x[i]-x[j])^2))) + sum(i, 1..n, x[i]^4)");
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
                    compare(*tape, together);
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
                for (const std::uint32_t read : {code[k].a, code[k].b, g.isLoop ? code[k].c : 0})
                    QVERIFY(read < code[0].to || read >= code[0].to + g.count);
            }
        }
        QCOMPARE(next, tape.length());
    }
    void forcesOfSpringsByHand() {
        constexpr int n = 150;
        const System system = chainOf(n, springs);
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
    /// What a spring does to both of its ends is computed once: its stretch, the square of that, the force,
    /// and one difference for each mass. Also where stiffnesses are not multiples of each other, so that what
    /// is taken from a coefficient leaves round-off alone.
    void whatIsOfOneFormIsAddedFirst() {
        constexpr int n = 90;
        const auto lengthOf = [](const std::string& potential, int each) {
            const System system = chainOf(n, "sum(i, 1..n, x[i]_t^2/2) - (" + potential + ")");
            const auto& m = system.mechanics();
            const std::size_t length = typed::gradientTapeOf(m)->length();
            qInfo("%zu", length);
            return length < static_cast<std::size_t>(each * n + 12);
        };
        QVERIFY(lengthOf("sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4)", 4));
        QVERIFY(lengthOf("sum(i, 1..n-1, (x[i+1]-x[i])^2/(6+2*i) + (x[i+1]-x[i])^4/4)", 5));
        QVERIFY(
            lengthOf("sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4) + sum(i, 1..n, x[i]^2/7)", 5));
    }
    void forcesOfUnequalSpringsByHand() {
        constexpr int n = 40;
        const System system =
            chainOf(n,
                    "sum(i, 1..n, x[i]_t^2/2 - x[i]^2/14) - sum(i, 1..n-1, (x[i+1]-x[i]-0.3)^2/(6+2*i) + "
                    "cosh(x[i+1]-x[i]-0.3))");
        const auto& m = system.mechanics();
        std::vector<double> q(n), f(n);
        for (int i = 0; i < n; ++i) q[static_cast<std::size_t>(i)] = std::sin(1.0 + i * i);
        m.force(m.model.get(), 0, q.data(), f.data());
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto pull = [&](std::size_t k) {
                const double r = q[k + 1] - q[k] - 0.3;
                return r / (4 + static_cast<double>(k)) + std::sinh(r);
            };
            const double force = (i + 1 < n ? pull(i) : 0) - (i > 0 ? pull(i - 1) : 0) - q[i] / 7;
            most = std::max(most, std::abs(f[i] - force));
        }
        qInfo("%.1e", most);
        QVERIFY(most < 1e-14);
    }
    void operandsOfAChainAreSideBySide() {
        const System system = chainOf(90, springs);
        const typed::Tape& tape = *typed::gradientTapeOf(system.mechanics());
        std::size_t count = 0;
        for (const typed::TapeGroup& g : tape.groups()) count += isSideBySide(g) ? g.count : 0;
        QVERIFY(count > tape.length() * 9 / 10);
        // Those of a star have an operand in common.
        const System other = chainOf(90, star);
        const typed::Tape& starTape = *typed::gradientTapeOf(other.mechanics());
        count = 0;
        for (const typed::TapeGroup& g : starTape.groups()) count += isSideBySide(g) ? g.count : 0;
        QVERIFY(count > starTape.length() * 8 / 10);
    }
    void registersAreUsedAgain() {
        constexpr std::size_t n = 90;
        const System system = chainOf(n, springs);
        const typed::Tape& tape = *typed::gradientTapeOf(system.mechanics());
        QVERIFY(tape.length() > 3 * n);
        QVERIFY(tape.registers() < tape.inputs() + tape.constants().size() + 5 * n);
    }
    /// What holds on to the centre of a star is one sum of many terms.
    void longSumsAreAddedByHalves() {
        const System system = chainOf(250, star);
        QVERIFY(typed::gradientTapeOf(system.mechanics())->groups().size() < 60);
    }
    void outputsAreCopied() {
        for (const char* lagrangian : {springs, star}) {
            const System system = chainOf(90, lagrangian);
            for (const typed::Tape* tape :
                 {typed::gradientTapeOf(system.mechanics()), typed::jetTapeOf(system.mechanics())}) {
                std::vector<double> r = valuesFor(*tape, 3), some(tape->outputs());
                tape->run(r.data());
                for (const std::size_t first : {0, 1, 88, 89, 179}) {
                    const std::size_t count = std::min(tape->outputs() - first, 91 + first / 2);
                    tape->copyOutputs(first, count, r.data(), some.data());
                    for (std::size_t k = 0; k < count; ++k)
                        QVERIFY(isSame(some[k], tape->output(first + k, r.data())));
                }
            }
        }
    }
    void freeRegistersAreGivenOutOnce() {
        typed::FreeRegisters free(3);
        std::mt19937 generator(7);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> taken;
        std::vector<int> owners(2000, 0);
        for (int i = 0; i < 400; ++i) {
            if (generator() % 5 < 3) {
                const std::uint32_t count = 1 + generator() % 20, first = free.take(count);
                QVERIFY(first >= 3 && first + count <= free.end());
                QVERIFY(count < 8 || first % 8 == 0);
                for (std::uint32_t k = first; k < first + count; ++k) QCOMPARE(++owners.at(k), 1);
                taken.emplace_back(first, count);
            } else if (!taken.empty()) {
                std::swap(taken[generator() % taken.size()], taken.back());
                const auto [first, count] = taken.back();
                taken.pop_back();
                for (std::uint32_t k = first; k < first + count; ++k) {
                    free.release(k);
                    --owners[k];
                }
            }
        }
        for (const auto& [first, count] : taken)
            for (std::uint32_t k = first; k < first + count; ++k) free.release(k);
        const std::uint32_t end = free.end();
        QCOMPARE(free.take(end - 8), 8U);
        QCOMPARE(free.end(), end);
    }
    /// Short formulas stay as they are, and reuse their registers.
    void shortOnesAreNotGrouped() {
        const System system = chainOf(4, "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, (x[i+1]-x[i])^4)");
        QVERIFY(typed::gradientTapeOf(system.mechanics())->groups().empty());
    }
    /// What an instruction reads was made some instructions before it, where there are others to do.
    void shortOnesDoNotWait() {
        const System system = chainOf(
            5, "sum(i, 1..n, x[i]_t^2/2) + sum(i, 1..n-1, sum(j, i+1..n, 1/sqrt(1 + (x[i]-x[j])^2)))");
        const typed::Tape& tape = *typed::gradientTapeOf(system.mechanics());
        QVERIFY(tape.groups().empty());
        constexpr int near = 4;
        int at = 0, waiting = 0;
        std::vector<int> made(tape.registers(), -near - 1);
        for (const typed::Instruction& i : tape.code()) {
            int last = -near - 1;
            typed::forOperands(i, [&](std::uint32_t r) { last = std::max(last, made[r]); });
            if (last >= at - near) ++waiting;
            made[i.to] = at++;
        }
        qInfo("%d of %d", waiting, at);
        QVERIFY(waiting < at / 10);
    }

private:
    /// In groups, as machine code and one by one: of numbers, and of eight of them together.
    static void compare(const typed::Tape& tape, std::vector<double> r) {
        std::vector<Lanes> lanes(tape.registers()), lanesApart(tape.registers());
        for (std::size_t i = 0; i < tape.inputs(); ++i)
            for (std::size_t k = 0; k < Lanes::size; ++k)
                lanes[i].lane[k] = lanesApart[i].lane[k] = r[i] * (1 + static_cast<double>(k));
        std::vector<double> apart = r, byCode;
        const std::vector<double> inputs = r;
        tape.withoutCode().run(r.data());
        for (int k = 0; k < 3; ++k) {
            byCode = inputs;
            tape.run(byCode.data());
        }
        typed::detail::run(tape, apart.data());
        typed::detail::runInGroups(tape, lanes.data());
        typed::detail::run(tape, lanesApart.data());
        for (std::size_t i = 0; i < tape.outputs(); ++i) {
            QVERIFY(isSame(tape.output(i, r.data()), tape.output(i, apart.data())));
            QVERIFY(isSame(tape.output(i, byCode.data()), tape.output(i, apart.data())));
            for (std::size_t k = 0; k < Lanes::size; ++k)
                QVERIFY(
                    isSame(tape.output(i, lanes.data()).lane[k], tape.output(i, lanesApart.data()).lane[k]));
        }
    }
};

EXTREMAL_TEST(TapeGroupsTest)

}  // namespace extremal::tape_groups_test

#include "tape_groups_test.moc"
