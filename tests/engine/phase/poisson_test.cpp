// SPDX-License-Identifier: GPL-3.0-or-later
/// Motions by a bracket and a Hamiltonian: orders, Casimirs and energies by scheme and by the variables that
/// are chosen, the defect of the bracket, and what is refused.
#include <QTest>

#include <cmath>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/phase/invariants.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/other_routes.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::poisson_test {
namespace {

struct Motion {
    System system;
    State start;
};

System typedBracket(Value::Array names, Value::Object bracket, const char* hamiltonian,
                    Value::Object casimirs) {
    return laws::systemNamed("poisson", {{"variables", Value(std::move(names))},
                                         {"parameters", Value(Value::Object{})},
                                         {"bracket", Value(std::move(bracket))},
                                         {"hamiltonian", hamiltonian},
                                         {"casimirs", Value(std::move(casimirs))}});
}

/// An odd number of variables: the state has a fourth, which is 0.
Motion body() {
    return {typedBracket({"a", "b", "c"}, {{"a,b", "-c"}, {"b,c", "-a"}, {"c,a", "-b"}},
                         "a^2/2 + b^2/4 + c^2/6", {{"square", "a^2 + b^2 + c^2"}}),
            {0, 0, {0.6, 0.7, -0.4, 0}}};
}
/// Three species, {y_i, y_j} = B_ij y_i y_j, and in logarithms, where the bracket is constant.
Motion species() {
    return {typedBracket({"x", "y", "z"}, {{"x,y", "x*y"}, {"y,z", "y*z"}, {"z,x", "z*x"}}, "x + 2*y + z",
                         {{"sum", "log(x) + log(y) + log(z)"}}),
            {0, 0, {1, 0.5, 0.8, 0}}};
}
Motion logarithms() {
    return {typedBracket({"u", "v", "w"}, {{"u,v", "1"}, {"v,w", "1"}, {"w,u", "1"}},
                         "exp(u) + 2*exp(v) + exp(w)", {{"sum", "u + v + w"}}),
            {0, 0, {0, std::log(0.5), std::log(0.8), 0}}};
}
/// Toda's chain of three in a ring, in Flaschka's variables: an even number of variables, two Casimirs, and
/// tr L^2 = 2 H.
Motion toda() {
    return {typedBracket({"a1", "a2", "a3", "b1", "b2", "b3"},
                         {{"a1,b2", "a1"},
                          {"a1,b1", "-a1"},
                          {"a2,b3", "a2"},
                          {"a2,b2", "-a2"},
                          {"a3,b1", "a3"},
                          {"a3,b3", "-a3"}},
                         "(b1^2 + b2^2 + b3^2)/2 + a1^2 + a2^2 + a3^2",
                         {{"trace", "b1 + b2 + b3"}, {"product", "a1*a2*a3"}}),
            {0, 0, {0.6, 0.4, 0.5, 0.3, -0.5, 0.1}}};
}

Discretization gaussOf(int s) {
    return laws::polynomialPair(s, {"gauss", {{"nodes", static_cast<double>(s)}}, {}});
}
std::unique_ptr<Integrator> collocation(const Motion& of, int s, double h) {
    return makeIntegrator(of.system, gaussOf(s), {0, h});
}
std::unique_ptr<Integrator> keeping(const Motion& of, int s, double h,
                                    const std::vector<KeptQuantity>& kept) {
    const Discretization d = gaussOf(s);
    return familyOf(d.space)->parts.find<TestSpace>()->make(of.system, d, h,
                                                            invariantsOf(kept, of.system, of.start));
}

/// The largest changes of the energy and of each Casimir on the way.
struct Changes {
    double energy = 0;
    std::vector<double> casimirs;
};
Changes changes(const Motion& of, Integrator& integrator, int steps) {
    const auto& structure = of.system.part<PoissonStructure>();
    Changes worst;
    worst.casimirs.assign(structure.casimirs.size(), 0);
    State s = of.start;
    integrator.begin(s);
    for (int k = 0; k < steps; ++k) {
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        worst.energy = std::max(
            worst.energy, std::abs(of.system.energy(0, s.x.data()) - of.system.energy(0, of.start.x.data())));
        for (std::size_t c = 0; c < worst.casimirs.size(); ++c)
            worst.casimirs[c] = std::max(worst.casimirs[c],
                                         std::abs(structure.casimirs[c].value(s.x.data(), nullptr) -
                                                  structure.casimirs[c].value(of.start.x.data(), nullptr)));
    }
    return worst;
}

State byRungeKutta(const Motion& of, double end) { return endByRungeKutta(of.system, of.start, end); }

/// max |M J_0 M^T - J_1| over some steps, from the tangent map of the step or from differences of it.
double bracketDefect(const Motion& of, Integrator& integrator, int steps) {
    PoissonEquations equations(of.system.part<PoissonStructure>());
    const auto n = static_cast<Eigen::Index>(of.start.x.size());
    double worst = 0;
    State s = of.start;
    integrator.begin(s);
    for (int k = 0; k < steps; ++k) {
        const Eigen::MatrixXd before = equations.structure(s.x.data());
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
        if (!integrator.applyTangent({M.data(), static_cast<std::size_t>(M.size())}))
            qFatal("no tangent map");
        worst = std::max(
            worst, (M * before * M.transpose() - equations.structure(s.x.data())).cwiseAbs().maxCoeff());
    }
    return worst;
}

std::string problemOf(const std::function<void()>& make) {
    try {
        make();
    } catch (const InvalidScene& e) {
        return e.problems().front().pointer + ": " + e.problems().front().message;
    }
    return "";
}

}  // namespace

class PoissonTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<int>("which");
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("keepsEnergy");
        const char* const names[] = {"body", "species", "logarithms", "toda"};
        for (int which = 0; which < 4; ++which)
            for (int s = 1; s <= 3; ++s)
                for (const bool keeps : {false, true})
                    QTest::addRow("%s, %s %d", names[which], keeps ? "energy" : "Gauss", s)
                        << which << s << keeps;
    }
    void orders() {
        QFETCH(int, which);
        QFETCH(int, degree);
        QFETCH(bool, keepsEnergy);
        const Motion of = which == 0 ? body() : which == 1 ? species() : which == 2 ? logarithms() : toda();
        constexpr double end = 6;
        const State reference = byRungeKutta(of, end);
        const auto errorWith = [&](int n) {
            const auto integrator = keepsEnergy ? keeping(of, degree, end / n, {{"energy", "energy"}})
                                                : collocation(of, degree, end / n);
            State s = of.start;
            integrator->begin(s);
            const auto found = laws::after(*integrator, s, n);
            if (!found) qFatal("a step failed");
            return largestDifference(*found, reference);
        };
        const int steps = degree == 3 ? 18 : 36;
        const double fine = errorWith(2 * steps), order = std::log2(errorWith(steps) / fine);
        qInfo("error %.1e, order %.2f", fine, order);
        QVERIFY(std::abs(order - 2 * degree) < 0.25);
    }

    /// Linear and quadratic ones are kept by Gauss, others in the variables in which they are linear.
    void casimirsAndEnergies() {
        constexpr int steps = 2000;
        constexpr double h = 0.1, roundOff = 1e-12;
        for (int s = 1; s <= 3; ++s) {
            const Changes b = changes(body(), *collocation(body(), s, h), steps);
            const Changes y = changes(species(), *collocation(species(), s, h), steps);
            const Changes log = changes(logarithms(), *collocation(logarithms(), s, h), steps);
            const Changes both =
                changes(logarithms(), *keeping(logarithms(), s, h, {{"energy", "energy"}}), steps);
            const Changes t = changes(toda(), *collocation(toda(), s, h), steps);
            qInfo(
                "s = %d: body %.0e %.0e; species %.0e %.0e, in logarithms %.0e %.0e, with energy %.0e %.0e; "
                "Toda %.0e, %.0e %.0e",
                s, b.energy, b.casimirs[0], y.energy, y.casimirs[0], log.energy, log.casimirs[0], both.energy,
                both.casimirs[0], t.energy, t.casimirs[1], t.casimirs[0]);
            QVERIFY(b.energy < roundOff && b.casimirs[0] < roundOff);
            QVERIFY(y.energy < roundOff);
            QVERIFY(log.casimirs[0] < roundOff);
            QVERIFY(both.energy < roundOff && both.casimirs[0] < roundOff);
            QVERIFY(t.energy < roundOff);
            // What must be lost.
            QVERIFY(y.casimirs[0] > 1e3 * roundOff || s == 3);
            QVERIFY(log.energy > 1e3 * roundOff || s == 3);
            const auto product = t.casimirs[0] > t.casimirs[1] ? t.casimirs[0] : t.casimirs[1];
            QVERIFY(product > 1e3 * roundOff || s == 3);
        }
    }
    /// All of a list, where the energy alone loses the Casimir.
    void aListIsKept() {
        const Motion of = body();
        const Changes alone = changes(of, *keeping(of, 2, 0.2, {{"energy", "energy"}}), 500);
        const Changes all = changes(
            of, *keeping(of, 2, 0.2, {{"energy", "energy"}, {"casimir.square", "casimir.square"}}), 500);
        const Changes typed =
            changes(of, *keeping(of, 2, 0.2, {{"energy", "energy"}, {"a^2+b^2+c^2", "a^2+b^2+c^2"}}), 500);
        QVERIFY(alone.energy < 1e-13 && alone.casimirs[0] > 1e-10);
        QVERIFY(all.energy < 1e-13 && all.casimirs[0] < 1e-13);
        QVERIFY(typed.energy < 1e-13 && typed.casimirs[0] < 1e-13);
    }

    /// A constant bracket is kept by Gauss and lost by Runge and Kutta; another one is lost by Gauss, with a
    /// slope of the order.
    void theBracketIsKeptWhereItIsConstant() {
        const Motion constant = logarithms(), varying = species();
        QVERIFY(constant.system.part<PoissonStructure>().isConstant);
        QVERIFY(!varying.system.part<PoissonStructure>().isConstant);
        const auto rk4 = findBaseline("rk4")->make(constant.system, {0.2, constant.start, 0, {}});
        QVERIFY(bracketDefect(constant, *rk4, 10) > 1e-7);
        for (int s = 1; s <= 3; ++s) {
            QVERIFY(bracketDefect(constant, *collocation(constant, s, 0.2), 10) < 1e-14);
            const double lost = bracketDefect(varying, *collocation(varying, s, 0.2), 1),
                         less = bracketDefect(varying, *collocation(varying, s, 0.1), 1);
            qInfo("s = %d: defect %.1e, slope %.2f", s, lost, std::log2(lost / less));
            QVERIFY(lost > 1e-12);
            QVERIFY(std::log2(lost / less) > 2 * s + 0.5);
        }
    }
    void theTangentMapIsThatOfTheStep() {
        const Motion of = toda();
        const auto step = [&](State from) {
            const auto integrator = collocation(of, 2, 0.3);
            integrator->begin(from);
            return laws::after(*integrator, from, 1);
        };
        const auto integrator = collocation(of, 2, 0.3);
        State s = of.start;
        integrator->begin(s);
        (void)advance(*integrator, s);
        Eigen::MatrixXd M = Eigen::MatrixXd::Identity(6, 6);
        QVERIFY(integrator->applyTangent({M.data(), 36}));
        constexpr double shift = 1e-4;
        for (int k = 0; k < 6; ++k) {
            State up = of.start, down = of.start;
            up.x[static_cast<std::size_t>(k)] += shift;
            down.x[static_cast<std::size_t>(k)] -= shift;
            const auto a = step(up), b = step(down);
            QVERIFY(a && b);
            for (int i = 0; i < 6; ++i) {
                const auto at = static_cast<std::size_t>(i);
                QVERIFY(std::abs((a->x[at] - b->x[at]) / (2 * shift) - M(i, k)) < 1e-8);
            }
        }
    }

    void whatIsRefused() {
        const auto bracket = [](Value::Object of, Value::Object casimirs = {}) {
            return problemOf([&] {
                typedBracket({"x", "y", "z"}, std::move(of), "x^2 + z^2", std::move(casimirs));
            });
        };
        QCOMPARE(bracket({{"x,y", "z"}, {"y,z", "x*y"}, {"z,x", "z"}}),
                 std::string("/bracket: does not obey Jacobi's identity for x, y, z"));
        QCOMPARE(bracket({{"x,q", "z"}}), std::string("/bracket/x,q: there is no variable \"q\""));
        QCOMPARE(bracket({{"x", "z"}}), std::string("/bracket/x: must name two variables"));
        QCOMPARE(bracket({{"x,x", "z"}}),
                 std::string("/bracket/x,x: is the bracket of a variable with itself, which is 0"));
        QCOMPARE(bracket({{"x,y", "z"}, {"y, x", "z"}}), std::string("/bracket/y, x: {y, x} is given twice"));
        QCOMPARE(bracket({{"x,y", "1"}}, {{"c", "x + z"}}),
                 std::string("/casimirs/c: is not a Casimir: its bracket with y is not 0"));
        QCOMPARE(bracket({{"x,y", "1"}}, {{"c", "z^2"}}), std::string());
        const Motion of = body();
        QCOMPARE(problemOf([&] {
                     invariantsOf({{"casimir.other", ""}}, of.system, of.start);
                 }),
                 std::string("/keep/0: there is no \"casimir.other\""));
        QCOMPARE(problemOf([&] {
                     invariantsOf({{"a*b", "a*b"}}, of.system, of.start);
                 }),
                 std::string("/keep/0: is not constant along the motion: a*b changes with it"));
        // Half of the variables being free of nothing, schemes of other kinds are not for it.
        QVERIFY(!appliesTo(*findBaseline("splitting"), of.system));
        QVERIFY(appliesTo(*findBaseline("rk4"), of.system));
    }
    void startsMayBeTypedInParameters() {
        const auto startOf = [](const char* x) {
            const ReadScene read = readScene(
                std::string(R"json({"extremal": 1, "model": {"type": "poisson", "variables": ["u", "v", "w"],
                    "parameters": {"k": 2}, "bracket": {"u,v": "1", "v,w": "1", "w,u": "1"},
                    "hamiltonian": "exp(u) + k*exp(v) + exp(w)"}, "time": {"end": 1},
                    "schemes": [{"scheme": "midpoint", "step": 0.1}], "initial": {"x": )json") +
                x + "}}");
            if (!read.errors.empty())
                return read.errors[0].pointer + ": " + read.errors[0].message.substr(0, 38);
            const State start = initialState(read.scene, makeSystem(read.scene));
            return formatNumber(start.x[0]) + " " + formatNumber(start.x[1]) + " " + formatNumber(start.x[2]);
        };
        QCOMPARE(startOf(R"x(["log(k/2)", -0.5, "-1/k"])x"), std::string("0 -0.5 -0.5"));
        QCOMPARE(startOf(R"({"w": "k^2", "u": 1, "v": "pi/pi"})"), std::string("1 1 4"));
        QCOMPARE(startOf(R"([0, "m", 0])"),
                 std::string("/initial/x/1: the expression has an unknown name \"m\""));
        QCOMPARE(startOf(R"([0, true, 0])"), std::string("/initial/x/1: must be a number or an expression"));
        QCOMPARE(startOf(R"({"u": "1/0", "v": 0, "w": 0})"),
                 std::string("/initial/x/u: must be finite, got inf"));
    }
};

EXTREMAL_TEST(PoissonTest)
}  // namespace extremal::poisson_test

#include "poisson_test.moc"
