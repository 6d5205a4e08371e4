// SPDX-License-Identifier: GPL-3.0-or-later
/// What an integrator remembers is in the state and nowhere else: every scheme of the catalogues, on systems
/// of every kind.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <stop_token>

#include "engine/core/text/text.hpp"
#include "engine/scene/bind.hpp"
#include "tests/laws/catalogue.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::contract_test {
namespace {

struct Run {
    std::string name;
    System system;
    CatalogueScheme scheme;
    State start;
    double step, end;

    std::unique_ptr<Integrator> make() const { return scheme.make(system, step, start); }
};

StepReport step(const Run& run, Integrator& integrator, State& state) {
    if (integrator.grid() != TimeGrid::fixed) return integrator.advance(state, run.end);
    return advance(integrator, state);
}

bool isFinite(const State& state) {
    return std::all_of(state.x.begin(), state.x.end(), [](double v) { return std::isfinite(v); });
}

bool takesSteps(const Run& run) {
    const auto integrator = run.make();
    State state = run.start;
    for (int k = 0; k < 20 && (integrator->grid() == TimeGrid::fixed || state.t < run.end); ++k)
        if (step(run, *integrator, state).outcome != Outcome::converged) return false;
    return isFinite(state);
}

/// Everything on every ground, where it can take its steps.
std::vector<Run> everyRun() {
    std::vector<Run> runs;
    for (const Scene& scene : everyGround()) {
        const System system = makeSystem(scene);
        const State start = initialState(scene, system);
        const double given = scene.schemes.front().step.value;
        for (CatalogueScheme& c : everythingOn(system, start, given)) {
            // The transformed midpoint rule needs h w below 2.
            const double step = c.scheme.grid == TimeGrid::free && c.scheme.baseline ? given / 4 : given;
            std::string name = system.id + " " + formatNumber(step) + ": " + c.name;
            Run run{std::move(name), system, std::move(c), start, step, scene.end.value};
            // A step without a solution is not a matter of the contract.
            if (takesSteps(run)) runs.push_back(std::move(run));
        }
    }
    return runs;
}

double relativeDistance(const State& a, const State& b) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) {
        difference = std::max(difference, std::abs(a.x[i] - b.x[i]));
        size = std::max(size, std::abs(b.x[i]));
    }
    return difference / size;
}

}  // namespace

class ContractTest : public QObject {
    Q_OBJECT
    const std::vector<Run> runs_ = everyRun();

    void addRuns() {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < runs_.size(); ++i)
            QTest::addRow("%s", runs_[i].name.c_str()) << static_cast<int>(i);
    }
    const Run& current() const {
        QFETCH(int, index);
        return runs_[static_cast<std::size_t>(index)];
    }

private slots:
    void everyKindOfSchemeIsHere() {
        int composed = 0, adaptive = 0, free = 0, withMemory = 0, waves = 0, bodies = 0;
        for (const Run& run : runs_) {
            composed += run.scheme.group == Group::composition;
            adaptive += run.scheme.scheme.isAdaptive();
            free += run.scheme.scheme.grid == TimeGrid::free;
            withMemory += !run.scheme.claims().isOneStep;
            waves += run.system.id == "schrodinger";
            bodies += run.system.id == "rigid-body";
        }
        qInfo("%zu runs: %d composed, %d adaptive, %d with free times, %d with memory, %d waves, %d bodies",
              runs_.size(), composed, adaptive, free, withMemory, waves, bodies);
        // Every scheme that there is for a ground runs on one of them.
        std::set<std::string> running;
        for (const Run& run : runs_) running.insert(run.scheme.name);
        for (const Scene& scene : everyGround()) {
            const System system = makeSystem(scene);
            for (const CatalogueScheme& c :
                 everythingOn(system, initialState(scene, system), scene.schemes.front().step.value))
                // The policy "stop" ends a run where the energy equation has no root, as it does soon here.
                QVERIFY2(running.contains(c.name) || c.name.find(" stop") != std::string::npos,
                         c.name.c_str());
        }
        QVERIFY(composed > 20 && adaptive >= 6 && free >= 6 && withMemory >= 2 && waves > 20 && bodies >= 8);
    }
    void aCloneTakesTheSameStep_data() { addRuns(); }
    void aCloneTakesTheSameStep() {
        const Run& run = current();
        const auto integrator = run.make();
        State state = run.start;
        integrator->begin(state);
        for (int k = 0; k < 4; ++k) {
            State copy = state;
            // The history of CVODE is its own: a clone starts anew, and only its first step is the same.
            const bool isLibrary = run.scheme.scheme.spec.baseline.type == "stiff" && k > 0;
            const auto clone = integrator->clone();
            const StepReport own = step(run, *integrator, state), other = step(run, *clone, copy);
            QCOMPARE(own.outcome, Outcome::converged);
            QCOMPARE(other.outcome, Outcome::converged);
            if (isLibrary) continue;
            QVERIFY(state.x == copy.x && state.memory == copy.memory && state.t == copy.t &&
                    state.node == copy.node);
            std::vector<double> x(state.x.size()), y = x;
            integrator->denseOutput(0.3, x);
            clone->denseOutput(0.3, y);
            QVERIFY(x == y);
        }
    }
    void aRunIsResumedFromItsState_data() { addRuns(); }
    void aRunIsResumedFromItsState() {
        const Run& run = current();
        const auto integrator = run.make(), fresh = run.make();
        State state = run.start;
        integrator->begin(state);
        for (int k = 0; k < 5; ++k) QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
        State resumed = state;
        // What libraries keep of their last steps they do not give away: they go on with their tolerance.
        const std::string& code = run.scheme.scheme.spec.baseline.type;
        const bool isLibrary = code == "stiff" || code == "bulirsch-stoer";
        if (isLibrary) {
            while (state.t < run.end) QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
            while (resumed.t < run.end) QCOMPARE(step(run, *fresh, resumed).outcome, Outcome::converged);
        } else {
            for (int k = 0; k < 10; ++k) {
                QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
                QCOMPARE(step(run, *fresh, resumed).outcome, Outcome::converged);
                QVERIFY(std::abs(resumed.t - state.t) <= 1e-13 * std::abs(state.t));
            }
        }
        const double off = relativeDistance(resumed, state);
        qInfo("off by %.1e", off);
        QVERIFY(off < (isLibrary ? 1e-4 : 1e-13));
    }
    void aCheckpointGoesOnWithTheSameBits_data() { addRuns(); }
    void aCheckpointGoesOnWithTheSameBits() {
        const Run& run = current();
        const auto integrator = run.make(), fresh = run.make();
        State state = run.start;
        integrator->begin(state);
        for (int k = 0; k < 7; ++k) {
            if (integrator->grid() != TimeGrid::fixed && state.t >= run.end) break;
            QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
        }
        Archive written;
        const std::string& code = run.scheme.scheme.spec.baseline.type;
        const bool isLibrary = code == "stiff" || code == "bulirsch-stoer";
        QCOMPARE(integrator->checkpoint(written), !isLibrary);
        if (isLibrary) return;
        Archive read(written.bytes());
        QVERIFY(fresh->checkpoint(read));
        State resumed = state;
        std::vector<double> said(integrator->quantities().size()), saidAgain(said.size());
        for (int k = 0; k < 60; ++k) {
            if (integrator->grid() != TimeGrid::fixed && state.t >= run.end) break;
            const StepReport own = step(run, *integrator, state), other = step(run, *fresh, resumed);
            QCOMPARE(own.outcome, other.outcome);
            QVERIFY(own.cost == other.cost && own.event == other.event);
            if (own.outcome != Outcome::converged) break;
            QVERIFY(state.x == resumed.x && state.memory == resumed.memory && state.t == resumed.t);
            if (said.empty()) continue;
            integrator->measure(state, said.data());
            fresh->measure(resumed, saidAgain.data());
            QVERIFY(std::memcmp(said.data(), saidAgain.data(), said.size() * sizeof(double)) == 0);
        }
    }
    void denseOutputIsWholeAfterAStop_data() { addRuns(); }
    void denseOutputIsWholeAfterAStop() {
        const Run& run = current();
        const auto integrator = run.make();
        std::stop_source source;
        integrator->setStop(source.get_token());
        State state = run.start;
        integrator->begin(state);
        for (int k = 0; k < 3; ++k) QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
        State before = state, after = state;
        integrator->denseOutput(0.3, before.x);
        source.request_stop();
        integrator->denseOutput(0.3, after.x);
        // Not the same bits: iterations of the second may begin with what the first one found.
        QVERIFY(isFinite(before) && isFinite(after) && relativeDistance(after, before) < 1e-9);
    }
    void memoryIsNamed_data() { addRuns(); }
    void memoryIsNamed() {
        const Run& run = current();
        const auto integrator = run.make();
        State state = run.start;
        integrator->begin(state);
        std::size_t named = 0;
        for (const MemoryPart& part : integrator->memoryParts()) {
            QVERIFY(!part.name.empty());
            named += part.size;
        }
        QCOMPARE(named, state.memory.size());
        QCOMPARE(state.memory.empty(), integrator->memoryParts().empty());
        if (integrator->grid() == TimeGrid::fixed)
            QCOMPARE(run.scheme.claims().isOneStep, state.memory.empty());
        QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
        QCOMPARE(named, state.memory.size());
    }
    void timeIsTheRuns_data() { addRuns(); }
    /// A step on a fixed grid ends exactly where the run says.
    void timeIsTheRuns() {
        const Run& run = current();
        const auto integrator = run.make();
        State state = run.start;
        if (integrator->grid() == TimeGrid::landing) {
            while (state.t < run.end) QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
            QCOMPARE(state.t, run.end);
            return;
        }
        if (integrator->grid() == TimeGrid::free) {  // the first step is the one that is given
            const double first = state.t + run.step;
            QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
            const bool isSolvedFor = !run.scheme.scheme.baseline;
            QVERIFY((!isSolvedFor || state.t == first) && state.node == 1);
            for (int k = 0; k < 5; ++k) {
                const double before = state.t;
                QCOMPARE(step(run, *integrator, state).outcome, Outcome::converged);
                QVERIFY(state.t > before);
            }
            return;
        }
        QCOMPARE(integrator->stepSize(), run.step);
        const double until = std::nextafter(run.step, 1);
        QCOMPARE(integrator->advance(state, until).outcome, Outcome::converged);
        QVERIFY(state.t == until && state.node == 1);
    }
    void anotherStepSizeIsThatOfAnotherScheme_data() { addRuns(); }
    void anotherStepSizeIsThatOfAnotherScheme() {
        const Run& run = current();
        const auto integrator = run.make();
        if (integrator->grid() != TimeGrid::fixed || run.system.id == "multiscale-elliptic") return;
        const double h = run.step / 2;
        const auto other = run.scheme.make(run.system, h, run.start);
        State a = run.start, b = run.start;
        QCOMPARE(advance(*integrator, a).outcome, Outcome::converged);
        integrator->setStep(h);
        QCOMPARE(integrator->stepSize(), h);
        a = run.start;
        integrator->begin(a);
        for (int k = 0; k < 3; ++k) {
            const Outcome outcome = advance(*integrator, a).outcome;
            QCOMPARE(outcome, advance(*other, b).outcome);
            if (outcome != Outcome::converged) break;
        }
        QVERIFY(a.x == b.x && a.t == b.t);
    }
};

EXTREMAL_TEST(ContractTest)
}  // namespace extremal::laws::contract_test

#include "contract_test.moc"
