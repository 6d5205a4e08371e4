// SPDX-License-Identifier: GPL-3.0-or-later
/// Splittings on a system whose kicks and drifts are not explicit: Euler maps and adjoints with the same
/// coefficients.
#include <QTest>

#include <cmath>

#include "engine/baseline/parts.hpp"
#include "engine/step/partitioned.hpp"
#include "tests/engine/model/typed/typed.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::partitioned_test {

class PartitionedTest : public QObject {
    Q_OBJECT
    const System polar_ = laws::systemNamed("spring-pendulum", {{"k", 40.0}});
    const State start_{0, 0, {0.1, 0.8, 0, 0.3}};

    State fine() const {
        const auto discretization =
            makeIntegrator(polar_, laws::polynomialPair(8, {"gauss", {}, {}}), {0, 1. / 64});
        return laws::after(*discretization, start_, 128).value();
    }
    struct Slopes {
        double q, p;
    };
    static void compareWithSingleForces(const System& system, std::vector<double> from) {
        const Mechanics<double>& own = system.mechanics();
        QVERIFY(own.kicksAndDrifts);
        Mechanics<double> slow = own;
        slow.kicksAndDrifts = nullptr;
        const State start{0, 0, std::move(from)};
        const std::vector<PartitionedStage> driftFirst{{HalfMap::driftExplicit, 0.3},
                                                       {HalfMap::kickExplicit, 0.6},
                                                       {HalfMap::driftExplicit, 0.7},
                                                       {HalfMap::kickExplicit, 0.4}};
        for (const auto& stages : {partitionedStages(strang(), true), partitionedStages(srkn14a(), true),
                                   partitionedStages(srkn19b(), true), driftFirst}) {
            const auto a = makePartitioned(own, 0.01, stages), b = makePartitioned(slow, 0.01, stages);
            State x = start, y = start;
            for (int step = 0; step < 20; ++step) {
                // Another step in between: durations of kicks follow it.
                for (auto* each : {&a, &b}) (*each)->setStep(step == 10 ? 0.02 : 0.01);
                const StepReport one = advance(*a, x), other = advance(*b, y);
                QCOMPARE(one.outcome, Outcome::converged);
                QCOMPARE(one.cost.evaluations, other.cost.evaluations);
                QVERIFY(x.x == y.x);
            }
            QVERIFY(laws::distance(x.x, start.x, 0, start.x.size()) > 0.01);
            // Many steps by one call.
            NodeBlock nodes(x.x.size(), 7);
            const Clock clock{x.t - 20 * 0.01, 0.01};
            QCOMPARE(a->advanceBlock(x, nodes, 9, clock).outcome, Outcome::converged);
            QCOMPARE(nodes.size(), std::size_t{7});
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const StepReport other = b->advance(y, clock.at(y.node + 1));
                QVERIFY(std::equal(y.x.begin(), y.x.end(), nodes.x(i)));
                QVERIFY(nodes.t(i) == y.t && nodes.node(i) == y.node);
                QCOMPARE(nodes.report(i).cost.evaluations, other.cost.evaluations);
            }
            QVERIFY(x.x == y.x);
        }
    }
    Slopes orders(const std::vector<PartitionedStage>& stages) const {
        const State exact = fine();
        std::vector<double> h, q, p;
        for (const int n : {40, 60, 90}) {
            const auto method = makePartitioned(polar_.mechanics(), 2.0 / n, stages);
            const State end = laws::after(*method, start_, n).value();
            h.push_back(std::log(2.0 / n));
            q.push_back(std::log(laws::distance(end.x, exact.x, 0, 2)));
            p.push_back(std::log(laws::distance(end.x, exact.x, 2, 4)));
        }
        return {slope(h, q), slope(h, p)};
    }

private slots:
    void splittingsKeepTheirOrderForAnyHamiltonian() {
        for (const Splitting& s : {blanesMoanS6(), blanesMoanS10()}) {
            const Slopes measured = orders(partitionedStages(s, false));
            qInfo("claimed %d, measured q %.3f, p %.3f", s.order, measured.q, measured.p);
            QVERIFY(std::abs(measured.q - s.order) < 0.15);
            QVERIFY(std::abs(measured.p - s.order) < 0.15);
        }
    }
    void kicksAndDriftsAloneDoNot() {
        // Teeth: explicit kicks and drifts are not the flows of a splitting here.
        const Slopes measured = orders(partitionedStages(blanesMoanS6(), true));
        QVERIFY(measured.q < 2);
    }
    void bothFormsAreTheSameWhereSeparable() {
        const System kepler = laws::systemNamed("kepler");
        const auto a = makePartitioned(kepler.mechanics(), 0.05, partitionedStages(blanesMoanS10(), true));
        const auto b = makePartitioned(kepler.mechanics(), 0.05, partitionedStages(blanesMoanS10(), false));
        const State x = laws::after(*a, laws::keplerStart, 20).value(),
                    y = laws::after(*b, laws::keplerStart, 20).value();
        QVERIFY(laws::distance(x.x, y.x, 0, 4) < 1e-13);  // measured: 4e-15
    }
    /// Systems that take kicks and drifts by one call have the bits of a call for each force, and count as
    /// many.
    void kicksAndDriftsByOneCall() {
        for (const char* name : {"pendulum", "harmonic-oscillator", "kepler", "henon-heiles"}) {
            const System system = laws::systemNamed(name);
            const bool isSingle = system.mechanics().dimension == 1;
            compareWithSingleForces(system,
                                    isSingle ? std::vector{0.7, 0.3} : std::vector{0.5, 0.1, 0.2, 0.9});
        }
    }
    void kicksAndDriftsOfTypedOnes() {
        const auto chain = [](int n, const std::string& potential) {
            return laws::typedSystem(Value::Array{"x[1..n]"}, {{"n", n}},
                                     "sum(i, 1..n, x[i]_t^2/2) - (" + potential + ")");
        };
        const std::string springs = "sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4)";
        for (const System& system :
             {laws::typedKepler(),
              laws::typedSystem({"x", "y"}, {{"m", 3}},
                                "m/2*x_t^2 + y_t^2/2 - x^2/2 - y^2/2 - x^2*y + y^3/3"),
              laws::typedSystem({"x", "y"}, {{"k", 1}}, "x_t^2/2 + y_t^2/2 + k*x*y"),  // a force is y
              chain(4, springs), chain(64, springs + " + x[1]^2/2 + x[1]^4/4 + x[n]^2/2 + x[n]^4/4"),
              chain(77, springs + " + sum(i, 1..n, 1 - cos(x[i]))"),
              chain(70, "sum(i, 2..n, (x[i]-x[1])^4/(4*i))"), chain(66, "-sum(i, 1..n-1, x[i]*x[i+1])"),
              chain(130, "sum(i, 1..n, sqrt(1 + x[i]^2)) + sum(i, 1..n-1, 1/(3 + x[i+1]-x[i]))")}) {
            const auto d = static_cast<std::size_t>(system.mechanics().dimension);
            std::vector<double> start(2 * d);
            for (std::size_t k = 0; k < 2 * d; ++k) start[k] = std::sin(1.0 + static_cast<double>(k * k));
            compareWithSingleForces(system, start);
        }
    }
    void aStepWithoutAnEndLeavesTheState() {
        const System system = laws::systemNamed("henon-heiles");
        const State start{0, 0, {1e200, 1, 2, 3}};
        State state = start;
        const auto method = makePartitioned(system.mechanics(), 0.1, partitionedStages(strang(), true));
        QCOMPARE(advance(*method, state).outcome, Outcome::notFinite);
        QVERIFY(state.x == start.x);
        QCOMPARE(state.node, start.node);
        QCOMPARE(state.t, start.t);
    }
    void nystromMethodsAreForSeparableSystems() {
        const System kepler = laws::systemNamed("kepler");
        for (const char* id : {"srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b"}) {
            QVERIFY(appliesTo(*findBaseline(id), kepler));
            QVERIFY(!appliesTo(*findBaseline(id), polar_));
        }
    }
    void theStabilityLimitIsThatOfTheStep() {
        const System oscillator = laws::systemNamed("harmonic-oscillator");
        for (const BaselineEntry& e : baselineCatalog()) {
            if (e.isAdaptive() || !appliesTo(e, oscillator)) continue;
            if (!e.item.claims->isSymplectic) continue;
            const auto* const limitOf = e.parts.find<OscillatorLimit>();
            const double limit = limitOf ? limitOf->of({}) : 0;
            if (std::isinf(limit)) continue;
            const auto largest = [&](double h) {
                const auto integrator = e.make(oscillator, {h, {}, 0, laws::defaultsOf(e.item)});
                State s{0, 0, {1, 0.3}};
                double size = 0;
                for (int k = 0; k < 200000; ++k) {
                    (void)advance(*integrator, s);
                    size = std::max(size, std::abs(s.x[0]));
                }
                return size;
            };
            const double below = largest(0.99 * limit), above = largest(1.0001 * limit);
            qInfo("%s: limit %.4f, largest %.3g below and %.3g above", e.item.id.c_str(), limit, below,
                  above);
            QVERIFY(below < 100);
            QVERIFY(!(above < 1e6));  // the weakest: SRKN 11b, which grows by 3e-4 a step
        }
    }
};

EXTREMAL_TEST(PartitionedTest)
}  // namespace extremal::partitioned_test

#include "partitioned_test.moc"
