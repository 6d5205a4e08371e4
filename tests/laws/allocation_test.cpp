// SPDX-License-Identifier: GPL-3.0-or-later
/// The step is the hot loop: after the first one it allocates nothing. Counted by replacing operator new, and
/// malloc where the library lets that be done.
#include <QTest>

#include <Eigen/Core>

#include "tests/laws/allocations.hpp"
#include "tests/laws/laws.hpp"
#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::allocation_test {

class AllocationTest : public QObject {
    Q_OBJECT
private slots:
    void aStepAllocatesNothing() {
        for (const char* id : {"kepler", "spring-pendulum"}) {
            const System s = systemNamed(id);
            const State start = s.id == "kepler" ? keplerStart : State{0, 0, {0.01, 1, 0, 0}};
            for (const Case& c : everyScheme(8, s)) {
                const auto integrator = c.make(s, {0, 0.005});
                State state = start;
                for (int i = 0; i < 3; ++i) (void)advance(*integrator, state);
                const long long before = allocations;
                for (int i = 0; i < 100; ++i) (void)advance(*integrator, state);
                QVERIFY2(allocations == before, (c.name + " on " + id).c_str());
            }
        }
    }
    void aStepOfAHamiltonianAllocatesNothing() {
        const System s =
            systemNamed("hamiltonian", {{"coordinates", Value(Value::Array{"x", "y"})},
                                        {"parameters", Value(Value::Object{})},
                                        {"hamiltonian", "(p_x^2 + p_y^2)*(1 + x^2/2)/2 + x^2/2 + y^4/4"}});
        const State start{0, 0, {0.4, -0.3, 0.2, 0.5}};
        for (const Case& c : everyScheme(8, s)) {
            const auto integrator = c.make(s, {0, 0.02});
            State state = start;
            for (int i = 0; i < 3; ++i) (void)advance(*integrator, state);
            const long long before = allocations;
            for (int i = 0; i < 100; ++i) QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
            QVERIFY2(allocations == before, c.name.c_str());
        }
    }
    void aStepOfABodyAllocatesNothing() {
        const std::vector<double> turning{1, 0, 0, 0, 0.4, 0.1, 0.9, 0.4, 0.1, 0.9};
        std::vector<double> moving = turning;
        moving.insert(moving.end(), {0.8, 0, 0.2, 0.1, 1.1, 0});
        const char* const pull = "-1/sqrt(x^2+y^2+z^2) + R33*z/10";
        for (const System& s :
             {systemNamed("rigid-body"), systemNamed("heavy-top"), systemNamed("body-in-potential"),
              systemNamed("rigid-body-se3"), systemNamed("rigid-body-se3", {{"potential", pull}})}) {
            const State start{0, 0, s.body().dimension == 3 ? turning : moving};
            for (const Case& c : everyScheme(8, s)) {
                const auto integrator = c.make(s, {0, 0.02});
                State state = start;
                for (int i = 0; i < 3; ++i) (void)advance(*integrator, state);
                const long long before = allocations;
                for (int i = 0; i < 100; ++i)
                    QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                QVERIFY2(allocations == before, (c.name + " on " + s.id).c_str());
            }
        }
    }
    /// Groups by basis, one of each kind of chart, with and without a force; products that are coupled by
    /// forces, by masses and by neither; many bodies; points on spheres.
    void aStepOnAGroupAllocatesNothing() {
        std::vector<std::pair<System, State>> problems;
        for (const GroupCase& each : groupCases()) {
            const System system = each.system();
            problems.emplace_back(system, each.start(system));
        }
        for (const int count : {2, 4, 12})
            for (const bool hasHinges : {false, true}) {
                const GroupCase each = chainOfBodies(count, hasHinges);
                const System system = each.system();
                problems.emplace_back(system, each.start(system));
            }
        const System spheres = systemNamed("spheres", {{"spheres", Value::Array{"a", "b"}},
                                                       {"lagrangian",
                                                        "(a_1_t^2 + a_2_t^2 + a_3_t^2 + b_1_t^2 + b_2_t^2 + "
                                                        "b_3_t^2)/2 - a_3 - b_3 - a_1*b_1"},
                                                       {"parameters", Value::Object{}}});
        problems.emplace_back(spheres, State{0, 0, spheres.start(Settings{"", {}, {}}, 0)});
        for (const auto& [system, start] : problems)
            for (const Case& c : everyScheme(4, system)) {
                const auto integrator = c.make(system, {0, 0.02});
                State state = start;
                for (int i = 0; i < 3; ++i) (void)advance(*integrator, state);
                const long long before = allocations;
                // The group's distance is cured every hundred steps.
                for (int i = 0; i < 120; ++i)
                    QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                const long long found = allocations - before;
                QVERIFY2(found == 0, (c.name + " on " + system.id + " in " + std::to_string(state.x.size()) +
                                      " columns: " + std::to_string(found))
                                         .c_str());
            }
    }
    void theCounterCounts() {
        long long before = allocations;
        delete new int(1);
        const std::vector<double> v(100);
        QVERIFY(allocations > before);
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        before = allocations;
        const Eigen::VectorXd matrix = Eigen::VectorXd::Zero(100);
        QVERIFY(allocations > before && matrix.isZero(0));
#endif
    }
};

EXTREMAL_TEST(AllocationTest)
}  // namespace extremal::laws::allocation_test

#include "allocation_test.moc"
