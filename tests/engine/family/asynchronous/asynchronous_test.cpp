// SPDX-License-Identifier: GPL-3.0-or-later
/// Asynchronous schemes on graded and notched bars: energies, counts of updates, momentum, order; and that
/// real-valued steps resonate.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/family/family.hpp"
#include "engine/family/parts/element_steps.hpp"
#include "engine/mesh/levels.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::asynchronous_test {
namespace {

System bar(int cells, const char* grading, double ratio, const char* material,
           const char* boundary = "dirichlet") {
    return findModel("elastic-bar")
        ->make({"elastic-bar",
                {{"cells", static_cast<double>(cells)},
                 {"grading", grading},
                 {"ratio", ratio},
                 {"notch", 10.0},
                 {"material", material},
                 {"boundary", boundary}},
                {}});
}

Discretization asynchronous(double courant, const char* levels = "dyadic", bool balance = true) {
    return {{"asynchronous", {{"levels", levels}, {"courant", courant}, {"balance", balance}}, {}},
            {"auto", {}, {}},
            {}};
}

struct Energies {
    double largest = 0, drift = 0;  ///< relative; mean of the last tenth less that of the first
    long long updates = 0;
};

Energies energiesOf(const System& system, const Discretization& d, double step, double end, const char* u) {
    const auto integrator = makeIntegrator(system, d, {0, step});
    State state;
    state.x = system.start({"", {{"displacement", u}}, {}}, 0);
    integrator->begin(state);
    const double start = system.energy(0, state.x.data());
    const auto steps = static_cast<long long>(end / step + 1e-9), tenth = std::max(1LL, steps / 10);
    Energies e;
    for (long long k = 1; k <= steps; ++k) {
        const StepReport report = integrator->advance(state, static_cast<double>(k) * step);
        if (report.outcome != Outcome::converged) {
            e.largest = std::numeric_limits<double>::infinity();
            return e;
        }
        e.updates += report.cost.evaluations;
        const double change = system.energy(0, state.x.data()) / start - 1;
        e.largest = std::max(e.largest, std::abs(change));
        if (k <= tenth) e.drift -= change / static_cast<double>(tenth);
        if (k > steps - tenth) e.drift += change / static_cast<double>(tenth);
    }
    return e;
}

Levels levelsOf(const System& system, double courant, bool balance = true) {
    return dyadicLevels(system.fieldProblem().mesh, courant, 1, balance);
}

constexpr const char* wave = "0.005*sin(pi*X)";

}  // namespace

class AsynchronousTest : public QObject {
    Q_OBJECT
private slots:
    /// Steps of 0, and of numbers that are none: the levels stay within their bounds.
    void levelsOfImpossibleSteps() {
        const Mesh mesh = uniformMesh(0, 1, 4, Boundary::periodic);
        for (const double courant : {0.0, HUGE_VAL, double(NAN)}) {
            const Levels levels = dyadicLevels(mesh, courant, 1, false);
            QCOMPARE(levels.level, std::vector<int>(4, 0));
            QCOMPARE(levels.highest, 0);
        }
    }
    /// A step of all elements is computed as a whole: one that would take too long is refused, and a long run
    /// of long ones is announced.
    void elementsThatAreTooUnequalAreRefused() {
        const auto checked = [](double ratio) {
            return readScene(findPreset("bar-resonance")->json,
                             {{"/model/ratio", ratio}, {"/time/end", 500}});
        };
        const auto has = [](const std::vector<Problem>& problems, const char* pointer, const char* text) {
            return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
                return p.pointer == pointer && p.message.find(text) != std::string::npos;
            });
        };
        const ReadScene slow = checked(1e6);
        QVERIFY(slow.errors.empty());
        QVERIFY(has(slow.warnings, "/schemes/0", "will take about"));
        for (const double ratio : {4e6, 9007199254740992.0})  // 4e6: about twice the limit
            for (const char* scheme : {"/schemes/0/space", "/schemes/1/space"})
                QVERIFY(has(checked(ratio).errors, scheme, "updates of elements"));
        QVERIFY(!has(checked(50).warnings, "/schemes/0", "will take about"));
    }
    void dyadicLevelsKeepEnergyOverTenMillionUpdates_data() {
        QTest::addColumn<QString>("material");
        for (const char* material : {"linear", "fput", "neo-hookean"})
            QTest::newRow(material) << QString(material);
    }
    void dyadicLevelsKeepEnergyOverTenMillionUpdates() {
        QFETCH(QString, material);
        const System system = bar(100, "geometric", 50, qPrintable(material));
        const Levels levels = levelsOf(system, 0.5);
        const Energies e = energiesOf(system, asynchronous(0.5), levels.largest(), 120, wave);
        qInfo("%lld updates, at most %.1e, drift %.1e", e.updates, e.largest, e.drift);
        QVERIFY(e.updates > 10'000'000);
        QVERIFY(e.largest < 2e-2);          // 3.1e-3
        QVERIFY(std::abs(e.drift) < 1e-3);  // 8e-8 linear, 1.5e-4 others
        // Against all elements with the step of the smallest: 2.85 times fewer.
        const double synchronous = 100 / levels.smallest * 120;
        QVERIFY(synchronous > 2.8 * static_cast<double>(e.updates));
    }
    void realStepsResonate() {
        const System system = bar(100, "geometric", 50, "fput");
        const Energies e = energiesOf(system, asynchronous(0.5, "real"), 0.05, 100, wave);
        QVERIFY2(e.drift > 0.4, qPrintable(QString::number(e.drift)));  // 0.50 in the mean, 0.69 at most
    }
    void aNotchIsCheap() {
        const System system = bar(200, "notch", 1000, "linear");
        const Levels levels = levelsOf(system, 0.5);
        double updates = 0, unbalanced = 0;
        for (int e = 0; e < 200; ++e) {
            updates += 1 / levels.step(e);
            unbalanced += 1 / levelsOf(system, 0.5, false).step(e);
        }
        QVERIFY(200 / levels.smallest / updates > 15);     // 16.2
        QVERIFY(200 / levels.smallest / unbalanced > 19);  // 19.3
        const Energies e = energiesOf(system, asynchronous(0.5), levels.largest(), 0.5, wave);
        QVERIFY(e.largest < 1e-4);  // 8e-6
    }
    void neighboursDifferByAFactorOfTwoAtMost() {
        for (const char* grading : {"geometric", "notch"})
            for (const double ratio : {3.0, 50.0, 700.0}) {
                const System system = bar(60, grading, ratio, "linear");
                const Mesh& mesh = system.fieldProblem().mesh;
                const Levels levels = levelsOf(system, 0.4);
                for (int e = 0; e < 60; ++e) {
                    QVERIFY(levels.step(e) <= 0.4 * mesh.size(e) * (1 + 1e-9));
                    if (e > 0)
                        QVERIFY(std::abs(levels.level[static_cast<std::size_t>(e)] -
                                         levels.level[static_cast<std::size_t>(e) - 1]) <= 1);
                }
            }
    }
    void aFreeBarKeepsItsMomentum() {
        for (const char* kind : {"dyadic", "real"}) {
            const System system = bar(100, "geometric", 50, "fput", "neumann");
            const double step = std::string(kind) == "real" ? 0.05 : levelsOf(system, 0.5).largest();
            const auto integrator = makeIntegrator(system, asynchronous(0.5, kind), {0, step});
            State state;
            state.x = system.start({"", {{"displacement", wave}, {"velocity", "0.25 + 0.01*X"}}, {}}, 0);
            const MomentumMap& map = system.momenta.at(0);
            const double before = map.value(state.x.data(), state.x.data());
            for (int k = 0; k < 200; ++k) QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
            const double change = map.value(state.x.data(), state.x.data()) - before;
            QVERIFY2(std::abs(change) < 1e-13, qPrintable(QString::number(change)));  // 2e-15
        }
    }
    void dyadicStepsAreSymmetricAndOfOrderTwo() {
        const System system = bar(40, "geometric", 10, "fput");
        const Levels levels = levelsOf(system, 0.5);
        State start;
        start.x = system.start({"", {{"displacement", "0.05*sin(pi*X)"}}, {}}, 0);
        const auto after = [&](double step, int steps, State state) {
            const auto integrator = makeIntegrator(system, asynchronous(0.5), {state.t, step});
            state.node = 0;
            for (int k = 0; k < steps; ++k) (void)advance(*integrator, state);
            return state;
        };
        const double h = levels.largest();
        const State there = after(h, 20, start), back = after(-h, 20, there);
        double away = 0;
        for (std::size_t i = 0; i < start.x.size(); ++i)
            away = std::max(away, std::abs(back.x[i] - start.x[i]));
        QVERIFY(away < 1e-14);
        // Against steps of a sixteenth, with the same ratios.
        const State exact = after(h / 16, 320, start);
        std::vector<double> errors;
        for (const int parts : {1, 2}) {
            const State coarse = after(h / parts, 20 * parts, start);
            double error = 0;
            for (std::size_t i = 0; i < start.x.size() / 2; ++i)
                error = std::max(error, std::abs(coarse.x[i] - exact.x[i]));
            errors.push_back(error);
        }
        const double order = std::log2(errors[0] / errors[1]);
        QVERIFY2(std::abs(order - 2) < 0.2, qPrintable(QString::number(order)));
    }
    /// Against differences of the step in values and velocities, and against the symplectic form.
    void dyadicStepsHaveTheirTangentMap_data() {
        QTest::addColumn<QString>("material");
        QTest::addColumn<QString>("boundary");
        QTest::newRow("linear") << "linear"
                                << "dirichlet";
        QTest::newRow("FPUT") << "fput"
                              << "dirichlet";
        QTest::newRow("neo-Hookean, free") << "neo-hookean"
                                           << "neumann";
    }
    void dyadicStepsHaveTheirTangentMap() {
        QFETCH(QString, material);
        QFETCH(QString, boundary);
        const System system = bar(12, "geometric", 20, qPrintable(material), qPrintable(boundary));
        const auto integrator = makeIntegrator(system, asynchronous(0.5), {0, 0.02});
        State before;
        before.x = system.start({"", {{"displacement", "0.05*sin(pi*x)"}}, {}}, 0);
        integrator->begin(before);
        State after = before;
        QVERIFY(integrator->advance(after, 0.02).outcome == Outcome::converged);
        const auto M = tangentMap(*integrator);
        QVERIFY(M);
        const SymplecticForm form(system);
        const double defect = formDefect(form, before.x.data(), after.x.data(), *M);
        // dq_1/dq_0 needs no masses: the upper left quarter.
        const auto n = static_cast<Eigen::Index>(integrator->tangentSize() / 2);
        const auto nodes = static_cast<Eigen::Index>(before.x.size() / 2), first = (nodes - n) / 2;
        double worst = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
            Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
            for (int k = 1; k <= 3; ++k)
                for (const int sign : {1, -1}) {
                    State from = before;
                    from.x[static_cast<std::size_t>(first + j)] += sign * k * 1e-4;
                    QVERIFY(integrator->advance(from, 0.02).outcome == Outcome::converged);
                    for (Eigen::Index i = 0; i < n; ++i)
                        column(i) += sign * centralDifferences[static_cast<std::size_t>(k - 1)] *
                                     from.x[static_cast<std::size_t>(first + i)] / 1e-4;
                }
            worst = std::max(worst, (column - M->col(j).head(n)).cwiseAbs().maxCoeff());
        }
        qInfo("M - differences %.1e, defect %.1e", worst, defect);
        QVERIFY(worst < 1e-9);
        QVERIFY(defect < 1e-12 * std::max(1.0, M->cwiseAbs().maxCoeff()));
    }
    void clocksCountWhatHappens() {
        const System system = bar(60, "geometric", 20, "linear");
        for (const char* kind : {"dyadic", "real"}) {
            const Discretization d = asynchronous(0.5, kind);
            const double step = levelsOf(system, 0.5).largest();
            const auto integrator = makeIntegrator(system, d, {0, step});
            State state;
            state.x = system.start({"", {{"displacement", wave}}, {}}, 0);
            long long updates = 0;
            for (int k = 1; k <= 50; ++k) updates += integrator->advance(state, k * step).cost.evaluations;
            const ElementClocks clocks =
                familyPart<ElementSteps>(d.space)->clocks(system, d, step, 50 * step, state.x.data());
            double sum = 0, energy = 0;
            for (const double n : clocks.updates) sum += n;
            for (const double e : clocks.energy) energy += e;
            QCOMPARE(sum, static_cast<double>(updates));
            QVERIFY(std::abs(energy / system.energy(0, state.x.data()) - 1) < 1e-12);
        }
    }
    void aRealRunResumesFromItsState() {
        const System system = bar(30, "geometric", 7, "fput");
        const auto one = makeIntegrator(system, asynchronous(0.5, "real"), {0, 0.013}), two = one->clone();
        State state;
        state.x = system.start({"", {{"displacement", wave}}, {}}, 0);
        one->begin(state);
        for (int k = 0; k < 5; ++k) QVERIFY(advance(*one, state).outcome == Outcome::converged);
        State copy = state;
        for (int k = 0; k < 5; ++k) {
            QVERIFY(advance(*one, state).outcome == Outcome::converged);
            QVERIFY(advance(*two, copy).outcome == Outcome::converged);
        }
        QVERIFY(state.x == copy.x && state.memory == copy.memory);
    }
};

EXTREMAL_TEST(AsynchronousTest)

}  // namespace extremal::asynchronous_test

#include "asynchronous_test.moc"
