// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed Hamiltonians A(t, p) + B(t, q) whose A is not quadratic: free motions between kicks, and baselines
/// of kicks and drifts, are explicit; the maps written by hand, orders in q and p, the form, the way back,
/// what they cost, and which knots are refused.
#include <QTest>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/model/symplectic_form.hpp"
#include "engine/step/partitioned.hpp"
#include "engine/core/text/text.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/quoted.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sums_test {
namespace {

using tests::quoted;
using Vector = std::vector<double>;
using Slope = std::function<Vector(double t, const Vector& at)>;

/// dA/dp and -dB/dq by hand.
struct Sum {
    const char* name;
    const char* hamiltonian;
    Vector q, p;
    Slope velocity, force;
};
std::vector<Sum> sums() {
    const auto first = [](double a) { return Vector{a}; };
    return {{"relativistic",
             "sqrt(1+p_x^2) + x^4/4",
             {0.8},
             {0.3},
             [=](double, const Vector& p) { return first(p[0] / std::sqrt(1 + p[0] * p[0])); },
             [=](double, const Vector& x) { return first(-x[0] * x[0] * x[0]); }},
            {"Lotka-Volterra",
             "exp(p_x) - 2*p_x + exp(x) - x",
             {0.4},
             {0.2},
             [=](double, const Vector& p) { return first(std::exp(p[0]) - 2); },
             [=](double, const Vector& x) { return first(1 - std::exp(x[0])); }},
            {"two coordinates",
             "sqrt(1 + p_x^2 + 2*p_y^2) + p_x*p_y/3 + cos(x - 2*y) + x^2 + y^2",
             {0.5, -0.4},
             {0.2, 0.6},
             [](double, const Vector& p) {
                 const double e = std::sqrt(1 + p[0] * p[0] + 2 * p[1] * p[1]);
                 return Vector{p[0] / e + p[1] / 3, 2 * p[1] / e + p[0] / 3};
             },
             [](double, const Vector& x) {
                 const double s = std::sin(x[0] - 2 * x[1]);
                 return Vector{s - 2 * x[0], -2 * s - 2 * x[1]};
             }},
            {"of the time",
             "cosh(p_x)*(1 + sin(t)/4) + x^2*(1 + cos(2*t)/3)",
             {0.5},
             {-0.3},
             [=](double t, const Vector& p) { return first(std::sinh(p[0]) * (1 + std::sin(t) / 4)); },
             [=](double t, const Vector& x) { return first(-2 * x[0] * (1 + std::cos(2 * t) / 3)); }}};
}

std::string listOf(const Vector& numbers) {
    std::string text;
    for (const double each : numbers) text += (text.empty() ? "" : ", ") + formatNumber(each);
    return "[" + text + "]";
}
ReadScene sceneOf(const Sum& sum, const std::string& scheme, double step, double start = 0) {
    return readScene(quoted(
        "{'extremal': 1, 'model': {'type': 'hamiltonian', 'coordinates': " +
        std::string(sum.q.size() == 1 ? "['x']" : "['x', 'y']") + ", 'parameters': {}, 'hamiltonian': '" +
        sum.hamiltonian + "'}, 'initial': {'q': " + listOf(sum.q) + ", 'p': " + listOf(sum.p) +
        "}, 'reference': 'none', 'time': {'start': " + formatNumber(start) + ", 'end': 100}, 'schemes': [{" +
        scheme + ", 'step': " + formatNumber(step) + "}]}"));
}
std::string knots(const std::string& id, const std::string& first = "") {
    return "'space': {'type': 'free-motion', 'knots': '" + id +
           (first.empty() ? "'}" : "', 'first': '" + first + "'}");
}
/// The state at t = 4 after n steps.
Vector endOf(const Sum& sum, const std::string& scheme, int n) {
    return tests::after(sceneOf(sum, scheme, 4.0 / n), n);
}

}  // namespace

class SumsTest : public QObject {
    Q_OBJECT private slots : void aStepIsThatByHand_data() { rows(); }
    /// A kick over h/2 at t, a drift over h at t + h/2, a kick over h/2 at t + h.
    void aStepIsThatByHand() {
        QFETCH(int, sum);
        const Sum of = sums()[static_cast<std::size_t>(sum)];
        const double h = 0.1, start = 0.3;
        Vector q = of.q, p = of.p;
        const auto add = [](Vector& to, double s, const Vector& slope) {
            for (std::size_t k = 0; k < to.size(); ++k) to[k] += s * slope[k];
        };
        add(p, h / 2, of.force(start, q));
        add(q, h, of.velocity(start + h / 2, p));
        add(p, h / 2, of.force(start + h, q));
        q.insert(q.end(), p.begin(), p.end());
        const ReadScene read = sceneOf(of, knots("strang"), h, start);
        const auto integrator = tests::integratorOf(read);
        State state = read.resolved->initial;
        QCOMPARE(integrator->advance(state, start + h).outcome, Outcome::converged);
        qInfo("%.1e", tests::apart(state.x, q));
        QVERIFY(tests::apart(state.x, q) < 1e-15);
    }
    void orders_data() {
        QTest::addColumn<int>("sum");
        QTest::addColumn<QString>("knots");
        QTest::addColumn<QString>("first");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        const struct {
            const char* id;
            int order, steps;
        } all[] = {{"strang", 2, 200},         {"suzuki-4", 4, 60},   {"blanes-moan-s6", 4, 80},
                   {"blanes-moan-s10", 6, 20}, {"kahan-li-6", 6, 30}, {"kahan-li-8", 8, 16}};
        for (std::size_t s = 0; s < sums().size(); ++s)
            for (const auto& [id, order, steps] : all)
                for (const char* first : {"kick", "drift"})
                    QTest::addRow("%s, %s, %s", sums()[s].name, id, first)
                        << static_cast<int>(s) << id << first << order << steps;
    }
    /// In q and in p, against Gauss collocation of order 12 with short steps.
    void orders() {
        QFETCH(int, sum);
        QFETCH(QString, knots);
        QFETCH(QString, first);
        QFETCH(int, order);
        QFETCH(int, steps);
        const Sum of = sums()[static_cast<std::size_t>(sum)];
        const Vector exact = endOf(of, "'scheme': 'galerkin-gauss-6'", 200);
        const std::string scheme = sums_test::knots(knots.toStdString(), first.toStdString());
        const std::size_t d = of.q.size();
        const auto errors = [&](int n) {
            const Vector x = endOf(of, scheme, n);
            Vector e(2);
            for (std::size_t k = 0; k < 2 * d; ++k) e[k / d] = std::hypot(e[k / d], x[k] - exact[k]);
            return e;
        };
        const Vector coarse = errors(steps), fine = errors(2 * steps);
        for (std::size_t k = 0; k < 2; ++k) {
            const double found = std::log2(coarse[k] / fine[k]);
            qInfo("%s: %.1e, %.1e, order %.2f", k == 0 ? "q" : "p", coarse[k], fine[k], found);
            QVERIFY2(fine[k] < 1e-13 || found > order - 0.4, qPrintable(QString::number(found)));
            QVERIFY(fine[k] < 1e-4);
        }
    }
    /// A drift over h/2, a kick over h at the middle, a drift over h/2; of a pendulum as well.
    void driftsMayBeFirst() {
        const double h = 0.1;
        const Sum of = sums().front();
        double q = of.q[0], p = of.p[0];
        q += h / 2 * p / std::sqrt(1 + p * p);
        p -= h * q * q * q;
        q += h / 2 * p / std::sqrt(1 + p * p);
        const Vector found = tests::after(sceneOf(of, knots("strang", "drift"), h), 1);
        QVERIFY(tests::apart(found, {q, p}) < 1e-15);
        QVERIFY(endOf(of, knots("strang", "kick"), 20) == endOf(of, knots("strang"), 20));
        QVERIFY(endOf(of, knots("kahan-li-8", "drift"), 20) == endOf(of, knots("kahan-li-8"), 20));
        const Sum pendulum{"pendulum", "p_x^2/2 - cos(x)", {0.8}, {0.3}, {}, {}};
        q = 0.8;
        p = 0.3;
        q += h / 2 * p;
        p -= h * std::sin(q);
        q += h / 2 * p;
        QVERIFY(tests::apart(tests::after(sceneOf(pendulum, knots("strang", "drift"), h), 1), {q, p}) <
                1e-15);
        for (const auto& [id, first, other] : {std::tuple{"srkn-6b", "drift", "kick"},
                                               {"srkn-11b", "drift", "kick"},
                                               {"srkn-14a", "kick", "drift"},
                                               {"srkn-19a", "kick", "drift"},
                                               {"srkn-19b", "drift", "kick"}}) {
            QVERIFY(sceneOf(pendulum, knots(id, other), h).errors.empty());
            const ReadScene read = sceneOf(pendulum, knots(id, first), h);
            QVERIFY(!read.errors.empty());
            QCOMPARE(tests::unlike(read.errors[0], "/schemes/0/space/first",
                                   QString("only with a %1 first").arg(other), "leave it out"),
                     QString());
        }
    }
    void theFormIsKept_data() { rows(); }
    void theFormIsKept() {
        QFETCH(int, sum);
        const Sum of = sums()[static_cast<std::size_t>(sum)];
        for (const char* id : {"strang", "blanes-moan-s10"}) {
            const ReadScene read = sceneOf(of, knots(id), 0.2);
            const System& system = *read.resolved->system;
            const auto integrator = tests::integratorOf(read);
            State state = read.resolved->initial;
            for (int k = 1; k <= 10; ++k) {
                const State before = state;
                QCOMPARE(integrator->advance(state, k * 0.2).outcome, Outcome::converged);
                const auto M = tangentMap(*integrator);
                QVERIFY(M);
                QVERIFY(formDefect(SymplecticForm(system), before.x.data(), state.x.data(), *M) < 2e-14);
                const auto step = [&](const State& from) -> std::optional<State> {
                    State to = from;
                    const auto other = integrator->clone();
                    if (other->advance(to, k * 0.2).outcome != Outcome::converged) return {};
                    return to;
                };
                const auto byDifferences = differencedMap(system, step, before, 2 * of.q.size(), 1e-3);
                QVERIFY(byDifferences && (*M - *byDifferences).cwiseAbs().maxCoeff() < 1e-10);
            }
        }
    }
    void thereAndBack_data() { rows(); }
    void thereAndBack() {
        QFETCH(int, sum);
        const Sum of = sums()[static_cast<std::size_t>(sum)];
        for (const char* id : {"strang", "blanes-moan-s6", "kahan-li-8"}) {
            const ReadScene read = sceneOf(of, knots(id), 0.2);
            const auto integrator = tests::integratorOf(read);
            State state = read.resolved->initial;
            for (int k = 1; k <= 20; ++k) (void)integrator->advance(state, k * 0.2);
            integrator->setStep(-0.2);
            for (int k = 19; k >= 0; --k) (void)integrator->advance(state, k * 0.2);
            QVERIFY(tests::apart(state.x, read.resolved->initial.x) < 1e-13);
        }
    }
    /// One force a kick, of which the last one of a step is the first one of the next.
    void stepsAreExplicit() {
        const Sum of = sums().front();
        const struct {
            std::string scheme;
            int forces;
        } all[] = {{knots("strang"), 1},
                   {knots("blanes-moan-s10"), 10},
                   {"'baseline': 'stormer-verlet'", 1},
                   {"'baseline': 'symplectic-euler'", 1},
                   {"'baseline': 'blanes-moan-s6'", 6}};
        for (const auto& [scheme, forces] : all) {
            const ReadScene read = sceneOf(of, scheme, 0.1);
            const auto integrator = tests::integratorOf(read);
            State state = read.resolved->initial;
            int found = 0;
            for (int k = 1; k <= 3; ++k)
                found = static_cast<int>(integrator->advance(state, k * 0.1).cost.evaluations);
            QVERIFY2(found == forces, qPrintable(QString::fromStdString(scheme) + QString::number(found)));
        }
    }
    /// The same kicks and drifts by a baseline and by a space. Where the energy knows the time, Verlet's two
    /// drifts are not joined.
    void baselinesHaveTheirBits() {
        for (const Sum& of : sums())
            for (const auto& [baseline, id] : {std::pair{"stormer-verlet", "strang"},
                                               {"blanes-moan-s6", "blanes-moan-s6"},
                                               {"blanes-moan-s10", "blanes-moan-s10"}}) {
                const Vector one = endOf(of, "'baseline': '" + std::string(baseline) + "'", 40),
                             other = endOf(of, knots(id), 40);
                const bool isOfTime = std::string(of.name) == "of the time";
                QVERIFY2(isOfTime ? tests::apart(one, other) < 1e-14 : one == other, of.name);
            }
    }
    /// Kicks and drifts by one call, and by a call for each.
    void oneCallHasTheBitsOfMany() {
        std::vector<Sum> all = sums();
        all.push_back(
            {"separable", "p_x^2/2 + p_y^2/3 + cos(x - y) + x^4/4 + y", {0.5, -0.4}, {0.2, 0.6}, {}, {}});
        for (const Sum& of : all) {
            const ReadScene read = sceneOf(of, knots("strang"), 0.1);
            const auto& H = read.resolved->system->part<PhaseMechanics>();
            QCOMPARE(H.kicksAndDrifts != nullptr, !H.isTimeDependent);
            if (!H.kicksAndDrifts) continue;
            PhaseMechanics slow = H;
            slow.kicksAndDrifts = nullptr;
            for (const Splitting& splitting : {strang(), srkn11b(), srkn14a(), blanesMoanS10()}) {
                const auto stages = partitionedStages(splitting, true);
                const auto byOne = makePartitioned(flowOf(H), 0.1, stages),
                           byMany = makePartitioned(flowOf(slow), 0.1, stages);
                QVERIFY2(tests::areAlike(*byOne, *byMany, read.resolved->initial, 0.1, 20), of.name);
            }
        }
    }
    /// L = T(v) - V(q) whose velocities are found by Newton's method.
    void lagrangiansAreSumsAsWell() {
        Sum of = sums().front();
        const Vector exact = endOf(of, knots("blanes-moan-s10"), 40);
        const ReadScene read = readScene(
            quoted("{'extremal': 1, 'model': {'type': 'lagrangian', 'coordinates': ['x'], 'parameters': {}, "
                   "'lagrangian': '-sqrt(1-x_t^2) - x^4/4'}, 'initial': {'q': [0.8], 'p': [0.3]}, "
                   "'reference': 'none', 'time': {'end': 4}, 'schemes': [{'step': 0.1, " +
                   knots("blanes-moan-s10") + "}]}"));
        qInfo("%.1e", tests::apart(tests::after(read, 40), exact));
        QVERIFY(tests::apart(tests::after(read, 40), exact) < 1e-13);
    }
    /// Of a typed splitting that begins with a drift, which has no implicit form.
    void typedSplittingsMayBeginWithADrift() {
        for (const Sum& of : sums()) {
            const Vector exact = endOf(of, "'scheme': 'galerkin-gauss-6'", 200);
            const char* const drifts =
                "'baseline': {'type': 'splitting', 'kicks': [1], 'drifts': [0.5, 0.5]}";
            const double order = std::log2(tests::apart(endOf(of, drifts, 100), exact) /
                                           tests::apart(endOf(of, drifts, 200), exact));
            QVERIFY2(std::abs(order - 2) < 0.1, qPrintable(QString::number(order)));
        }
    }
    void refusals() {
        for (const char* id : {"srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b"}) {
            const ReadScene read = sceneOf(sums().front(), knots(id), 0.1);
            QVERIFY(!read.errors.empty());
            QCOMPARE(tests::unlike(read.errors[0], "/schemes/0/space/knots", "p^2/(2m) with constant masses",
                                   "blanes-moan-s10"),
                     QString());
            const ReadScene byBaseline =
                sceneOf(sums().front(), "'baseline': '" + std::string(id) + "'", 0.1);
            QVERIFY(!byBaseline.errors.empty());
        }
        // What the hint names is taken.
        QVERIFY(sceneOf(sums().front(), knots("blanes-moan-s10"), 0.1).errors.empty());
        const char* const typed =
            "'baseline': {'type': 'splitting', 'kicks': ['1/6', '2/3', '1/6'], 'drifts': [0.5, 0.5]}";
        QVERIFY(sceneOf(sums().front(), typed, 0.1).errors.empty());
        const Sum mixed{"no sum", "sqrt(1 + p_x^2)*(1 + x^2)", {0.3}, {0.2}, {}, {}};
        const ReadScene read = sceneOf(mixed, knots("strang"), 0.1);
        QVERIFY(!read.errors.empty());
        QVERIFY2(read.errors[0].message.find("a function of the momenta and one of the places") !=
                     std::string::npos,
                 read.errors[0].message.c_str());
    }

private:
    static void rows() {
        QTest::addColumn<int>("sum");
        for (std::size_t s = 0; s < sums().size(); ++s) QTest::newRow(sums()[s].name) << static_cast<int>(s);
    }
};

EXTREMAL_TEST(SumsTest)
}  // namespace extremal::sums_test
#include "sums_test.moc"
