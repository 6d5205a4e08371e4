/// What an integrator remembers is in the state and nowhere else: every scheme of the catalogues, on systems
/// of every kind.
#include <QTest>

#include <cmath>

#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::contract_test {
namespace {

struct Run {
    std::string name;
    System system;
    SchemeSpec scheme;
    State start;
    double end;

    std::unique_ptr<Integrator> make() const {
        return resolve(scheme).make(system, scheme.step.value, start);
    }
};

/// A scene without schemes, and the step and tolerance of those it is given.
struct Ground {
    const char* scene;
    double step;
};
const Ground grounds[] = {
    {R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":2})", 0.02},
    {R"({"extremal":1,"model":{"type":"spring-pendulum"},"initial":{"q":[0.1,1],"p":[0,0]},"time":{"end":2})",
     0.02},
    {R"({"extremal":1,"model":{"type":"rigid-body"},"initial":{"attitude":[1,0,0,0],"momentum":[0.5,0.2,0.8]},"time":{"end":2})",
     0.05},
    {R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x) "},"initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}},"time":{"end":0.1})",
     0.002},
    {R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x - t) "},"initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}},"time":{"end":0.1})",
     0.002},
    {R"({"extremal":1,"model":{"type":"multiscale-elliptic","a":"10/(1+0.95*sin(2*pi*s)) ","epsilon":0.025,"f":"x^2","elements":50})",
     0.02},
};

/// Every named scheme of low degree and every baseline that a scene of these grounds may have; with
/// compositions of those that can be composed.
std::vector<Run> everyRun() {
    std::vector<Run> runs;
    for (const Ground& ground : grounds) {
        std::vector<std::string> schemes;
        for (const SchemeEntry& e : schemeCatalog())
            for (int degree = e.maxDegree == 0 ? 0 : e.minDegree; degree <= std::min(3, e.maxDegree);
                 ++degree) {
                std::string id = e.item.id;
                if (const auto at = id.find('<'); at != std::string::npos)
                    id = id.substr(0, at) + std::to_string(degree);
                schemes.push_back("\"scheme\":\"" + id + "\",\"step\":" + std::to_string(ground.step));
            }
        for (const BaselineEntry& e : baselineCatalog())
            schemes.push_back(
                "\"baseline\":\"" + e.item.id + "\"," +
                (e.isAdaptive ? "\"tolerance\":1e-9" : "\"step\":" + std::to_string(ground.step)));
        for (const std::string& scheme : std::vector(schemes))
            schemes.push_back(scheme + ",\"composition\":\"suzuki\"");
        for (const std::string& scheme : schemes) {
            const ReadScene read = readScene(std::string(ground.scene) + ",\"schemes\":[{" + scheme +
                                             ",\"allow_unstable\":true}],\"reference\":\"none\"}");
            if (!read.errors.empty()) continue;  // not for this system
            const System system = makeSystem(read.scene);
            const SchemeSpec& spec = read.scene.schemes.front();
            // An experiment whose steps have no solution from most starts.
            if (!resolve(spec).properties.caution.empty()) continue;
            runs.push_back({system.id + ": " + spec.label, system, spec, initialState(read.scene, system),
                            read.scene.end.value});
        }
    }
    return runs;
}

StepReport step(const Run& run, Integrator& integrator, State& state) {
    if (integrator.grid() == TimeGrid::landing) return integrator.advance(state, run.end);
    return advance(integrator, state);
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
        int composed = 0, adaptive = 0, withMemory = 0, waves = 0, bodies = 0;
        for (const Run& run : runs_) {
            composed += !run.scheme.composition.type.empty();
            adaptive += resolve(run.scheme).isAdaptive();
            withMemory += !resolve(run.scheme).claims.isOneStep;
            waves += run.system.id == "schrodinger";
            bodies += run.system.id == "rigid-body";
        }
        qInfo("%zu runs: %d composed, %d adaptive, %d with memory, %d waves, %d bodies", runs_.size(),
              composed, adaptive, withMemory, waves, bodies);
        QVERIFY(composed > 20 && adaptive >= 6 && withMemory >= 2 && waves > 20 && bodies >= 8);
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
            const bool isLibrary = run.scheme.baseline.type == "stiff" && k > 0;
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
        const std::string& code = run.scheme.baseline.type;
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
            QCOMPARE(resolve(run.scheme).claims.isOneStep, state.memory.empty());
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
        QCOMPARE(integrator->stepSize(), run.scheme.step.value);
        const double until = std::nextafter(run.scheme.step.value, 1);
        QCOMPARE(integrator->advance(state, until).outcome, Outcome::converged);
        QVERIFY(state.t == until && state.node == 1);
    }
    void anotherStepSizeIsThatOfAnotherScheme_data() { addRuns(); }
    void anotherStepSizeIsThatOfAnotherScheme() {
        const Run& run = current();
        const auto integrator = run.make();
        if (integrator->grid() != TimeGrid::fixed || run.system.id == "multiscale-elliptic") return;
        const double h = run.scheme.step.value / 2;
        const auto other = resolve(run.scheme).make(run.system, h, run.start);
        State a = run.start, b = run.start;
        QCOMPARE(advance(*integrator, a).outcome, Outcome::converged);
        integrator->setStep(h);
        QCOMPARE(integrator->stepSize(), h);
        a = run.start;
        integrator->begin(a);
        for (int k = 0; k < 3; ++k) {
            QCOMPARE(advance(*integrator, a).outcome, Outcome::converged);
            QCOMPARE(advance(*other, b).outcome, Outcome::converged);
        }
        QVERIFY(a.x == b.x && a.t == b.t);
    }
};

EXTREMAL_TEST(ContractTest)
}  // namespace extremal::laws::contract_test

#include "contract_test.moc"
