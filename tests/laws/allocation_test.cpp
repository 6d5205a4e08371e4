// SPDX-License-Identifier: GPL-3.0-or-later
/// The step is the hot loop: after the first one it allocates nothing. Counted by replacing operator new.
#include <QTest>

#include "tests/laws/allocations.hpp"
#include "tests/laws/laws.hpp"
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
    void theCounterCounts() {
        const long long before = allocations;
        delete new int(1);
        const std::vector<double> v(100);
        QVERIFY(allocations > before);
    }
};

EXTREMAL_TEST(AllocationTest)
}  // namespace extremal::laws::allocation_test

#include "allocation_test.moc"
