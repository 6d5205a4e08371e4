// SPDX-License-Identifier: GPL-3.0-or-later
/// Tapes as code of the processor: the bits of the instructions one by one, for all operations and functions,
/// with more values than the machine has registers, for one number and for eight; when code is made, and who
/// shares it.
#include <QTest>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_kicks.hpp"
#include "engine/model/typed/tape/tape_run.hpp"
#include "tests/tools/test.hpp"

namespace extremal::machine_code_test {
namespace {

using typed::Function, typed::Graph, typed::Op, typed::Tape;

constexpr int inputs = 6;

/// Formulas drawn by chance, later ones of earlier ones.
class Formulas {
public:
    explicit Formulas(unsigned seed) : draw_(seed) {
        for (int k = 0; k < inputs; ++k) nodes_.push_back(graph_.symbol(k));
        nodes_.push_back(graph_.number(0.75));
    }
    /// `withCalls`: functions as well.
    void add(int count, bool withCalls) {
        for (int k = 0; k < count; ++k) {
            const int kind = below(withCalls ? 8 : 5);
            if (kind < 3) {
                std::vector<Graph::Operand> terms;
                for (int n = 2 + below(3); n-- > 0;) terms.push_back({node(), factor()});
                nodes_.push_back(graph_.sum(below(3) == 0 ? 0.3 : 0, terms));
            } else if (kind < 5) {
                constexpr double exponents[] = {1, 1, 2, 3, -1, 0.5, -0.5, -2};
                std::vector<Graph::Operand> factors;
                for (int n = 1 + below(3); n-- > 0;) factors.push_back({node(), exponents[below(8)]});
                nodes_.push_back(graph_.product(factors));
            } else if (kind == 5) {
                constexpr Function both[] = {Function::sin, Function::cos};
                const int angle = node();
                for (const Function f : both) nodes_.push_back(graph_.call(f, angle));
            } else {
                addCall();
            }
        }
    }
    int node() { return nodes_[static_cast<std::size_t>(below(static_cast<int>(nodes_.size())))]; }
    int last() const { return nodes_.back(); }
    int symbol() { return nodes_.front(); }
    Graph& graph() { return graph_; }
    Tape tape(const std::vector<int>& roots) const { return Tape::of(graph_, roots, inputs); }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(draw_); }

private:
    double factor() {
        constexpr double factors[] = {1, 1, -1, -1, 2, -0.5, 1.7};
        return factors[below(7)];
    }
    void addCall() {
        const auto f = static_cast<Function>(below(static_cast<int>(Function::choose) + 1));
        switch (f) {
            case Function::choose:
                nodes_.push_back(graph_.call(f, node(), node(), node()));
                break;
            case Function::atan2:
            case Function::power:
            case Function::hypot:
            case Function::max:
            case Function::min:
            case Function::less:
            case Function::lessOrEqual:
            case Function::equal:
            case Function::notEqual:
                nodes_.push_back(graph_.call(f, node(), node()));
                break;
            default:
                nodes_.push_back(graph_.call(f, node()));
        }
    }

    Graph graph_;
    std::vector<int> nodes_;
    std::mt19937 draw_;
};

bool isSame(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Numbers of all sizes and signs, zeros and infinities among them.
double numberBy(std::mt19937& draw) {
    constexpr double special[] = {0, -0.0, 1, -1, std::numeric_limits<double>::infinity()};
    const int kind = std::uniform_int_distribution<int>(0, 19)(draw);
    if (kind < 5) return special[kind];
    return std::normal_distribution<double>(0, kind < 15 ? 1.0 : 50.0)(draw);
}

/// How many numbers differ from those of the instructions one by one, at `places` places.
int differences(const Tape& tape, unsigned seed, int places = 40) {
    std::mt19937 draw(seed);
    const Tape apart = tape.withoutCode();
    int found = 0;
    for (int place = 0; place < places; ++place) {
        std::vector<double> r(tape.registers(), 1e300), alone(r);
        std::vector<Lanes> lanes(tape.registers(), Lanes(1e300)), lanesAlone(lanes);
        for (std::size_t i = 0; i < inputs; ++i) {
            r[i] = alone[i] = numberBy(draw);
            for (double& each : lanes[i].lane) each = numberBy(draw);
            lanesAlone[i] = lanes[i];
        }
        tape.run(r.data());
        typed::detail::run(apart, alone.data());
        typed::detail::run(apart, lanesAlone.data());
        const auto code = tape.forEight();
        if (code) code(lanes.data()->lane.data());
        for (std::size_t k = 0; k < tape.outputs(); ++k) {
            found += !isSame(tape.output(k, r.data()), apart.output(k, alone.data()));
            for (std::size_t i = 0; code && i < Lanes::size; ++i)
                found +=
                    !isSame(tape.output(k, lanes.data()).lane[i], apart.output(k, lanesAlone.data()).lane[i]);
        }
    }
    return found;
}

/// The same for what force and velocity make of places and momenta in steps of two kicks.
int kicksThatDiffer(const Graph& graph, const std::vector<int>& forces, const std::vector<int>& velocities,
                    unsigned seed) {
    const std::size_t d = forces.size();
    std::mt19937 draw(seed);
    const auto together = typed::KickTape::ofSum(graph, forces, velocities);
    const Tape force = Tape::of(graph, forces, static_cast<int>(d)).withoutCode(),
               velocity = Tape::of(graph, velocities, 2 * static_cast<int>(d)).withoutCode();
    std::vector<double> r(force.registers()), s(velocity.registers());
    std::vector<double> q(d), p(d), f(d), Q(d), P(d), F(d);
    const auto drift = [&](double by) {
        std::copy(P.begin(), P.end(), s.begin() + static_cast<std::ptrdiff_t>(d));
        typed::detail::run(velocity, s.data());
        for (std::size_t k = 0; k < d; ++k) Q[k] += by * velocity.output(k, s.data());
    };
    int found = 0;
    for (int start = 0; start < 5; ++start) {
        for (std::size_t k = 0; k < d; ++k) q[k] = Q[k] = numberBy(draw), p[k] = P[k] = numberBy(draw);
        const std::array<KickAndDrift<double>, 2> pairs{{{0.3, -0.2}, {-0.1, 0.4}}};
        KicksAndDrifts<double> steps;
        steps.pairs = pairs;
        steps.firstDrift = 0.25;
        steps.steps = 3;
        together.take(steps, q.data(), p.data(), f.data());
        for (int step = 0; step < 3; ++step) {
            drift(0.25);
            for (const auto& [kick, by] : pairs) {
                std::copy(Q.begin(), Q.end(), r.begin());
                typed::detail::run(force, r.data());
                force.copyOutputs(0, d, r.data(), F.data());
                for (std::size_t k = 0; k < d; ++k) P[k] += kick * F[k];
                drift(by);
            }
        }
        for (std::size_t k = 0; k < d; ++k)
            found += !isSame(q[k], Q[k]) + !isSame(p[k], P[k]) + !isSame(f[k], F[k]);
    }
    return found;
}

bool hasCode() {
#ifdef __x86_64__
    return instructionSet() != InstructionSet::baseline;
#else
    return false;
#endif
}

}  // namespace

class MachineCodeTest : public QObject {
    Q_OBJECT private slots : void bitsOfArithmetic_data() {
        QTest::addColumn<int>("size");
        for (const int size : {1, 3, 10, 40, 150, 600}) QTest::addRow("%d", size) << size;
    }
    void bitsOfArithmetic() {
        QFETCH(int, size);
        for (unsigned seed = 1; seed <= 40; ++seed) {
            Formulas formulas(seed);
            formulas.add(size, false);
            std::vector<int> roots{formulas.last()};
            for (int k = 0; k < 5; ++k) roots.push_back(formulas.node());
            QCOMPARE(differences(formulas.tape(roots), seed), 0);
        }
    }
    void bitsOfFunctions_data() { bitsOfArithmetic_data(); }
    void bitsOfFunctions() {
        QFETCH(int, size);
        for (unsigned seed = 1; seed <= 40; ++seed) {
            Formulas formulas(1000 + seed);
            formulas.add(size, true);
            std::vector<int> roots{formulas.last()};
            for (int k = 0; k < 5; ++k) roots.push_back(formulas.node());
            QCOMPARE(differences(formulas.tape(roots), seed), 0);
        }
    }
    /// Values that all are needed at the end, with a call in the middle of them.
    void moreValuesThanRegisters() {
        for (const int count : {10, 13, 14, 15, 16, 17, 29, 30, 31, 32, 33, 64, 200})
            for (const bool isCalled : {false, true}) {
                Formulas formulas(7);
                Graph& graph = formulas.graph();
                std::vector<int> values, roots;
                for (int k = 0; k < count; ++k)
                    values.push_back(
                        graph.sum(1 + k, {{graph.product({{graph.symbol(0)}, {graph.symbol(1)}}), 0.1 + k}}));
                const int middle = isCalled ? graph.call(Function::exp, values.front()) : values.front();
                for (const int value : values)
                    roots.push_back(graph.product({{value}, {middle}, {values.back()}}));
                QCOMPARE(differences(formulas.tape(roots), 3), 0);
            }
    }
    /// Roots that nothing computes, and equal ones.
    void inputsAndConstantsAsOutputs() {
        Formulas formulas(5);
        Graph& graph = formulas.graph();
        const int square = graph.product({{graph.symbol(2), 2}});
        const Tape tape = formulas.tape({graph.symbol(3), graph.number(-2.5), square, graph.number(0), square,
                                         graph.scaled(graph.symbol(1), -1), graph.number(-2.5)});
        QCOMPARE(differences(tape, 1), 0);
        const Tape none = formulas.tape({graph.number(4), graph.symbol(0)});
        QCOMPARE(none.length(), std::size_t{0});
        QCOMPARE(differences(none, 1), 0);
    }
    void tablesAndChoices() {
        Formulas formulas(9);
        Graph& graph = formulas.graph();
        const std::vector<double> y{1, 0, 2, -1, 5};
        const auto table = std::make_shared<const Interpolant>(Interpolant::Kind::cubic,
                                                               std::vector<double>{-2, -1, 0, 1.5, 3}, y);
        std::vector<int> roots;
        for (int order = 0; order < 3; ++order) {
            const int at = graph.lookUp(table, order, graph.symbol(order));
            roots.push_back(graph.product({{at}, {graph.symbol(3)}}));
            roots.push_back(graph.call(Function::choose, graph.call(Function::less, at, graph.symbol(4)),
                                       graph.scaled(at, 2), graph.symbol(5)));
        }
        QCOMPARE(differences(formulas.tape(roots), 2), 0);
    }
    /// Kicks and drifts whose values go from one to the next, against force and velocity one by one.
    void tapesThatGoOn_data() { bitsOfArithmetic_data(); }
    void tapesThatGoOn() {
        QFETCH(int, size);
        for (unsigned seed = 1; seed <= 40; ++seed) {
            Formulas formulas(2000 + seed);
            formulas.add(size, seed % 2 == 0);
            Graph& graph = formulas.graph();
            std::vector<int> forces, velocities;
            for (int k = 0; k < inputs; ++k) {
                forces.push_back(k == 2 ? graph.symbol(3) : k == 4 ? graph.number(0.5) : formulas.node());
                const int p = graph.symbol(inputs + k), other = graph.symbol(inputs + (k + 1) % inputs);
                velocities.push_back(graph.sum(0.1, {{p, 0.7}, {graph.product({{other, 3}}), -0.2}}));
            }
            QCOMPARE(kicksThatDiffer(graph, forces, velocities, seed), 0);
        }
    }
    /// Loops over forces some of which are known long before others are, which read the same places.
    void loopsThatReadLate() {
        constexpr int half = 32;
        Formulas formulas(11);
        Graph& graph = formulas.graph();
        std::vector<int> forces, velocities;
        for (int k = 0; k < half; ++k) forces.push_back(graph.scaled(graph.symbol(half + k), 2));
        for (int k = 0; k < half; ++k) {
            int deep = graph.symbol(half + k);
            for (int n = 1; n <= 6; ++n) deep = graph.sum(n, {{graph.product({{deep, 2}}), 0.1}});
            forces.push_back(graph.product({{deep, -0.5}, {graph.symbol(k)}}));
        }
        for (int k = 0; k < 2 * half; ++k) velocities.push_back(graph.symbol(2 * half + k));
        QCOMPARE(kicksThatDiffer(graph, forces, velocities, 1), 0);
    }
    /// At the second run, of all copies.
    void codeIsMadeForWhatRunsAgain() {
        Formulas formulas(3);
        formulas.add(20, true);
        const Tape tape = formulas.tape({formulas.last()}), copy = tape;
        QVERIFY(!tape.forEight());
        const auto code = copy.forEight();
        QCOMPARE(code != nullptr, instructionSet() == InstructionSet::avx512);
        QVERIFY(tape.forEight() == code);
        QVERIFY(!tape.withoutCode().forEight());
        typed::MachineCode one(false);
        QVERIFY(!one.of(tape));
        QCOMPARE(one.of(tape) != nullptr, hasCode());
        QVERIFY(one.of(tape) == one.of(copy));
    }
    /// It outlives the tape that it was made from.
    void copiesKeepTheCode() {
        Formulas formulas(4);
        formulas.add(30, true);
        Tape kept;
        {
            const Tape tape = formulas.tape({formulas.last(), formulas.node()});
            QCOMPARE(differences(tape, 1), 0);
            kept = tape;
        }
        QCOMPARE(differences(kept, 2), 0);
    }
    void threadsShareIt() {
        for (unsigned seed = 1; seed <= 20; ++seed) {
            Formulas formulas(100 + seed);
            formulas.add(60, true);
            const Tape tape = formulas.tape({formulas.last(), formulas.node(), formulas.node()});
            std::vector<int> found(4, -1);
            std::vector<std::thread> threads;
            for (unsigned k = 0; k < 4; ++k)
                threads.emplace_back([&, k] { found[k] = differences(tape, 10 * seed + k, 20); });
            for (std::thread& each : threads) each.join();
            QVERIFY(found == std::vector<int>(4, 0));
        }
    }
};

EXTREMAL_TEST(MachineCodeTest)
}  // namespace extremal::machine_code_test

#include "machine_code_test.moc"
