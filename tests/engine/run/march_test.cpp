// SPDX-License-Identifier: GPL-3.0-or-later
/// The loop of every run, with integrators made by hand: where it ends, what it counts, what sinks are shown.
#include <QTest>

#include <array>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/march/march.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/run/reference/shared_solution.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::march_test {
namespace {

/// x counts steps; its memory too. Every third step resets its energy, and step 50 may end in trouble.
class Counting final : public Integrator {
public:
    TimeGrid grid_ = TimeGrid::fixed;
    double h = 0.5;
    double troubleFrom = 1e300;
    std::vector<Quantity> said = {};
    mutable int measured = 0;  ///< how often it was asked

    TimeGrid grid() const override { return grid_; }
    double stepSize() const override { return grid_ == TimeGrid::fixed ? h : 0; }
    std::vector<MemoryPart> memoryParts() const override { return {{"steps", 1}}; }
    void begin(State& state) override { state.memory.assign(1, 0); }
    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h;
        report.cost = {1, 2, 3, 4};
        state.memory[0] += 1;
        state.x[0] = state.memory[0] >= troubleFrom ? std::nan("") : state.memory[0];
        if (std::fmod(state.memory[0], 3) == 0) report.event = StepEvent::energyUnsolvable;
        state.t = grid_ == TimeGrid::fixed     ? until
                  : grid_ == TimeGrid::landing ? std::min(until, state.t + h)
                                               : state.t + h;
        ++state.node;
        last_ = state.memory[0];
        return report;
    }
    std::span<const Quantity> quantities() const override { return said; }
    void measure(const State& state, double* values) const override {
        values[0] = state.memory[0] == last_ ? 10 * last_ : 0;
        ++measured;
    }
    void denseOutput(double tau, std::span<double> x) const override { x[0] = last_ - 1 + tau; }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Counting>(*this); }

private:
    double last_ = 0;
};

MarchGrid gridTo(double end, double h) {
    MarchGrid grid;
    grid.clock = {0, h};
    grid.steps = std::llround(end / h);
    grid.end = end;
    return grid;
}

}  // namespace

class MarchTest : public QObject {
    Q_OBJECT
private slots:
    void fixedGridsEndAtTheirLastNode() {
        Counting integrator;
        State state{0, 0, {0}, {}};
        long long shown = 0;
        double lastTime = -1;
        const MarchSink sink{[&](const Stretch& s) {
            for (std::size_t i = 0; i < s.nodes.size(); ++i) {
                if (s.nodes.t(i) <= lastTime) return false;
                lastTime = s.nodes.t(i);
                ++shown;
            }
            return true;
        }};
        const MarchReport report = march(integrator, state, gridTo(1000, 0.5), {&sink, 1}, {});
        QCOMPARE(report.outcome, Outcome::converged);
        QCOMPARE(state.node, 2000LL);
        QCOMPARE(state.t, 1000.0);
        QCOMPARE(shown, 2001LL);
        QVERIFY((report.cost == Cost{2000, 4000, 6000, 8000}));
    }
    void otherGridsEndAtTheirTime() {
        for (const TimeGrid kind : {TimeGrid::landing, TimeGrid::free}) {
            Counting integrator;
            integrator.grid_ = kind;
            integrator.h = 0.3;
            State state{0, 0, {0}, {}};
            QCOMPARE(march(integrator, state, gridTo(1, 0.3), {}, {}).outcome, Outcome::converged);
            QCOMPARE(state.node, 4LL);
            if (kind == TimeGrid::landing) QCOMPARE(state.t, 1.0);
            if (kind == TimeGrid::free) QVERIFY(std::abs(state.t - 1.2) < 1e-12);
        }
    }
    void everyRunHasAStepBudget() {
        for (const TimeGrid kind : {TimeGrid::fixed, TimeGrid::landing, TimeGrid::free}) {
            Counting integrator;
            integrator.grid_ = kind;
            State state{0, 0, {0}, {}};
            MarchGrid grid = gridTo(100, 0.5);
            grid.budget = 17;
            QCOMPARE(march(integrator, state, grid, {}, {}).outcome, Outcome::stepBudget);
            QCOMPARE(state.node, 17LL);
            state = {0, 0, {0}, {}};
            grid.budget = 200;
            QCOMPARE(march(integrator, state, grid, {}, {}).outcome, Outcome::converged);
        }
    }
    void aRunGoesOnFromAState() {
        Counting integrator;
        State state{0, 0, {0}, {}};
        (void)march(integrator, state, gridTo(10, 0.5), {}, {});
        State resumed = state;
        Counting fresh;
        (void)march(fresh, resumed, gridTo(20, 0.5), {}, {});
        QCOMPARE(resumed.x[0], 40.0);
        QCOMPARE(resumed.t, 20.0);
    }
    void eventsAreCountedAndKept() {
        Counting integrator;
        State state{0, 0, {0}, {}};
        const MarchReport report = march(integrator, state, gridTo(50, 0.5), {}, {});
        QCOMPARE(report.events.counts[static_cast<std::size_t>(StepEvent::energyUnsolvable)], 33LL);
        QCOMPARE(report.events.counts[0], 67LL);
        QCOMPARE(report.events.marks.size(), std::size_t{33});
        QCOMPARE(report.events.marks[1].node, 6LL);
        QCOMPARE(report.events.marks[1].t, 3.0);
        state = {0, 0, {0}, {}};
        const MarchReport longer = march(integrator, state, gridTo(50000, 0.5), {}, {});
        QCOMPARE(longer.events.marks.size(), StepEvents::mostMarks);
        QCOMPARE(longer.events.counts[1], 33333LL);
    }
    void aStateThatIsNotFiniteIsNotReached() {
        for (const double wide : {1.0, 50000.0}) {
            Counting integrator;
            integrator.troubleFrom = 50;
            State state{0, 0, std::vector<double>(static_cast<std::size_t>(wide), 0.0), {}};
            long long shown = 0;
            const MarchSink sink{[&](const Stretch& s) {
                shown += static_cast<long long>(s.nodes.size());
                return std::isfinite(s.state.x[0]);
            }};
            const MarchReport report = march(integrator, state, gridTo(100, 0.5), {&sink, 1}, {});
            QCOMPARE(report.outcome, Outcome::notFinite);
            QCOMPARE(state.node, 49LL);
            QCOMPARE(state.t, 24.5);
            QCOMPARE(state.x[0], 49.0);
            QCOMPARE(shown, 50LL);
        }
    }
    void wideStatesAreNotCopied() {
        Counting integrator;
        State state{0, 0, std::vector<double>(50000, 0.0), {}};
        const MarchSink sink{[&](const Stretch& s) { return s.nodes.x(0) == s.state.x.data(); }};
        QVERIFY(!march(integrator, state, gridTo(5, 0.5), {&sink, 1}, {}).isEndedBySink);
        QCOMPARE(state.node, 10LL);
    }
    void sinksMayEndAMarchAndLookInsideSteps() {
        Counting integrator;
        State state{0, 0, {0}, {}};
        const MarchSink sink{[&](const Stretch& s) {
                                 if (s.isStart) return true;
                                 double inside = 0;
                                 s.integrator.denseOutput(0.5, {&inside, 1});
                                 return s.nodes.size() == 1 && inside == s.state.x[0] - 0.5 &&
                                        s.before.node + 1 == s.state.node && s.state.node < 7;
                             },
                             true};
        const MarchReport report = march(integrator, state, gridTo(100, 0.5), {&sink, 1}, {});
        QVERIFY(report.isEndedBySink);
        QCOMPARE(report.outcome, Outcome::converged);
        QCOMPARE(state.node, 7LL);
    }
    void whatAnIntegratorSaysOfItsStepIsShownToWhoReadsIt() {
        for (const bool isWide : {false, true}) {
            Counting integrator;
            integrator.said = {{"ten", "", "10 n", ""}};
            State state{0, 0, std::vector<double>(isWide ? 50000 : 1, 0.0), {}};
            bool isRight = true;
            const MarchSink sink{[&](const Stretch& s) {
                                     for (std::size_t i = 0; i < s.nodes.size(); ++i) {
                                         const std::span<const double> said = s.nodes.quantities(i);
                                         const double n = static_cast<double>(s.nodes.node(i));
                                         isRight = isRight && said.size() == 1 &&
                                                   (s.isStart ? std::isnan(said[0]) : said[0] == 10 * n);
                                     }
                                     return true;
                                 },
                                 false, true};
            const MarchReport report = march(integrator, state, gridTo(200, 0.5), {&sink, 1}, {});
            QVERIFY(isRight);
            QCOMPARE(report.lastQuantities, std::vector<double>{4000});
            QCOMPARE(integrator.measured, 400);
        }
    }
    void whatNobodyReadsIsNotMeasured() {
        Counting integrator;
        integrator.said = {{"ten", "", "10 n", ""}};
        State state{0, 0, {0}, {}};
        const MarchSink sink{[](const Stretch& s) { return s.nodes.quantities(0).empty(); }};
        QVERIFY(!march(integrator, state, gridTo(30, 0.5), {&sink, 1}, {}).isEndedBySink);
        QCOMPARE(integrator.measured, 0);
    }
    void whatStepsCostDoesNotDependOnBlocks() {
        const Clock clock{0, 0.01};
        int tried = 0;
        for (const BaselineEntry& entry : baselineCatalog()) {
            const ReadScene read = readScene(std::string(R"({"extremal":1,"model":{"type":"kepler"},
                "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":1},"schemes":[{"step":0.01,"baseline":")") +
                                             entry.item.id + "\"}]}");
            if (entry.isAdaptive() || !read.resolved) continue;
            const auto costIn = [&](std::size_t blockSize) {
                State state = read.resolved->initial;
                const auto integrator =
                    read.resolved->schemes[0].make(*read.resolved->system, clock.step, state);
                integrator->begin(state);
                NodeBlock nodes(state.x.size(), blockSize);
                Cost cost;
                while (state.node < 64) {
                    nodes.clear();
                    (void)integrator->advanceBlock(state, nodes, blockSize, clock);
                    for (std::size_t i = 0; i < nodes.size(); ++i) cost += nodes.report(i).cost;
                }
                return cost;
            };
            ++tried;
            QVERIFY2(costIn(1) == costIn(16) && costIn(1) == costIn(64), entry.item.id.c_str());
        }
        QVERIFY(tried > 8);
    }
    void theOutcomeColumnSaysWhatHappened() {
        const System none;
        const State state{1, 3, {0}, {}};
        const Observer observer = findObservable("step")->bind({none, state, {}, nullptr, 0.5, {}});
        StepReport report;
        report.event = StepEvent::energyUnsolvable;
        std::array<double, 2> values{};
        observer.evaluate(state, report, values.data());
        QCOMPARE(observer.columns[1].words.at(static_cast<std::size_t>(values[1])),
                 std::string("energy-unsolvable"));
        observer.evaluate(state, {}, values.data());
        QCOMPARE(observer.columns[1].words.at(static_cast<std::size_t>(values[1])), std::string("converged"));
    }
    void aSharedSolutionIsComputedOnce() {
        int made = 0, asked = 0;
        const auto make = [&]() -> ExactSolution {
            ++made;
            return [&](double t, std::span<double> x) {
                ++asked;
                x[0] = std::sin(t);
            };
        };
        std::vector<double> times;
        for (const double h : {0.1, 0.05})
            for (int k = 0; k * h <= 1; ++k) times.push_back(k * h);
        const auto shared = std::make_shared<SharedSolution>(make, times, 1);
        for (const double h : {0.05, 0.1, 0.05}) {
            const ExactSolution reader = SharedSolution::reader(shared);
            double x = 0;
            for (int k = 0; k * h <= 1; ++k) {
                reader(k * h, {&x, 1});
                QCOMPARE(x, std::sin(k * h));
            }
            reader(0.3 * h, {&x, 1});  // between the nodes: a solution of its own
            QCOMPARE(x, std::sin(0.3 * h));
            reader(0, {&x, 1});  // back
            QCOMPARE(x, 0.0);
        }
        QCOMPARE(made, 1 + 3);
        QVERIFY(asked <= static_cast<int>(times.size()) + 3);
    }
    /// A solution on a fine mesh that is too large to be kept there is kept where the runs look at it.
    void largeSolutionsAreSharedAtTheNodesOfTheScene() {
        for (const bool isTooLarge : {false, true}) {
            int made = 0;
            Reference reference;
            reference.make = [&made] {
                ++made;
                return ExactSolution([](double t, std::span<double> x) { x[0] = t; });
            };
            reference.onMesh = {std::make_shared<System>(), 1000000, reference.make};
            const std::size_t width = isTooLarge ? 1000000 : 1;
            std::vector<double> times;
            for (int k = 0; k <= 100; ++k) times.push_back(k);
            QCOMPARE(reference.share(times, width, nullptr), !isTooLarge);
            for (int run = 0; run < 2; ++run) {
                double x = 0;
                reference.make()(7, {&x, 1});
                QCOMPARE(x, 7.0);
            }
            QCOMPARE(made, isTooLarge ? 2 : 1);
        }
    }
};

EXTREMAL_TEST(MarchTest)
}  // namespace extremal::march_test

#include "march_test.moc"
