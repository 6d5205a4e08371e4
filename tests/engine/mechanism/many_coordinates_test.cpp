// SPDX-License-Identifier: GPL-3.0-or-later
/// Chains with more coordinates than are differentiated by each other: the same numbers as typed one by one,
/// entries that grow with the number of links, and a run.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace many_coordinates_test {

Value::Object chainKeys(int links, const std::string& lagrangian) {
    return {{"coordinates", Value::Array{"x[1..n]", "y[1..n]"}},
            {"parameters", Value::Object{{"n", links}, {"k", 3}}},
            {"lagrangian", lagrangian},
            {"constraints", Value::Object{{"rod1", "x[1]^2 + y[1]^2 - 1"},
                                          {"rod[i=2..n]", "(x[i]-x[i-1])^2 + (y[i]-y[i-1])^2 - 1"}}}};
}
Mechanical chain(int links, const std::string& lagrangian) {
    std::vector<double> q;
    for (int i = 1; i <= links; ++i) q.push_back(i * std::sin(std::numbers::pi / 6));
    for (int i = 1; i <= links; ++i) q.push_back(-i * std::cos(std::numbers::pi / 6));
    return startAt(laws::systemNamed("lagrangian", chainKeys(links, lagrangian)), q,
                   std::vector<double>(q.size(), 0.0));
}
constexpr const char* plain = "sum(i, 1..n, (x[i]_t^2 + y[i]_t^2)/2 - 9.81*y[i])";
/// A common factor, terms of two bodies, and functions.
constexpr const char* rich =
    "sum(i, 1..n, (x[i]_t^2 + y[i]_t^2)/2 - 9.81*y[i]) - k/2*sum(i, 2..n, "
    "cos(x[i]-x[i-1])*y[i]/(2+sin(y[i-1]))) "
    "+ 0.1*sum(i, 2..n, x[i]*y[i-1]_t)";

class ManyCoordinatesTest : public QObject {
    Q_OBJECT
private slots:
    /// 32 links are differentiated whole and 33 by terms: derivatives by the first coordinates are the same.
    void byTermsIsTheSame() {
        const System few = laws::systemNamed("lagrangian", chainKeys(32, rich)),
                     many = laws::systemNamed("lagrangian", chainKeys(33, rich));
        const auto jet = [](const System& s, int links, std::vector<double>& gradient,
                            std::vector<double>& hessian) {
            const auto d = static_cast<std::size_t>(2 * links);
            std::vector<double> q(d), v(d);
            for (int i = 0; i < links; ++i) {
                const auto x = static_cast<std::size_t>(i), y = static_cast<std::size_t>(links + i);
                q[x] = std::sin(0.3 * i);
                q[y] = std::cos(1.7 * i);
                v[x] = std::sin(2.1 * i);
                v[y] = std::cos(0.4 * i);
            }
            gradient.resize(2 * d);
            hessian.resize(4 * d * d);
            double value = 0;
            const auto& L = s.mechanics();
            L.jet(L.model.get(), 0, q.data(), v.data(), &value, gradient.data(), hessian.data());
        };
        std::vector<double> g32, h32, g33, h33;
        jet(few, 32, g32, h32);
        jet(many, 33, g33, h33);
        // Body 32 has a neighbour more.
        const auto place = [](int block, int body, int links) {
            return static_cast<std::size_t>(block * links + body);
        };
        for (int a = 0; a < 4; ++a)
            for (int i = 0; i < 31; ++i) {
                QVERIFY(std::abs(g32[place(a, i, 32)] - g33[place(a, i, 33)]) < 1e-13);
                for (int b = 0; b < 4; ++b)
                    for (int j = 0; j < 31; ++j) {
                        const double one = h32[place(a, i, 32) * 128 + place(b, j, 32)],
                                     other = h33[place(a, i, 33) * 132 + place(b, j, 33)];
                        QVERIFY(std::abs(one - other) < 1e-13);
                    }
            }
    }

    /// Entries of L'', g_q and g'', and instructions, per link.
    void entriesGrowWithTheLinks() {
        const auto count = [](int links) {
            const System s = laws::systemNamed("lagrangian", chainKeys(links, plain));
            const Constraint& g = *s.parts.find<Constraint>();
            return s.parts.find<LagrangianEntries>()->hessian.size() + g.entries->byPlace.size() +
                   g.entries->curvature.size();
        };
        const std::size_t hundred = count(100), two = count(200), three = count(300);
        QCOMPARE(three - two, two - hundred);
        QCOMPARE(two - hundred, std::size_t{100 * (2 + 4 + 6)});
    }

    /// The constraints of a chain of 200 links hold over a run, and the balance of energy.
    void aLongChainRuns() {
        const Mechanical of = chain(200, plain);
        QVERIFY(Mechanism(of.system.parts).linked());
        const auto end = run(of, "galerkin-gauss-2", 0.2, 40);
        QCOMPARE(end.outcome, Outcome::converged);
        qInfo("|g| %.1e, |dg/dt| %.1e", end.largestValue, end.largestRate);
        QVERIFY(end.largestValue < 1e-12);
        QVERIFY(end.largestRate < 1e-11);
        const auto& L = of.system.mechanics();
        const auto energy = [&](const State& s) {
            return L.energy(L.model.get(), s.t, s.x.data(), s.x.data() + L.dimension);
        };
        QVERIFY(std::abs(energy(end.state) - energy(of.start)) < 1e-6);
    }

    /// Forces and dissipation by index, on many coordinates.
    void forcesByIndex() {
        Value::Object keys = chainKeys(40, plain);
        keys.push_back({"forces", Value::Object{{"x[i=1..n]", "-0.1*i*x[i]_t"}}});
        keys.push_back({"dissipation", "sum(i,1..n, 0.05*y[i]_t^2)"});
        const System s = laws::systemNamed("lagrangian", keys);
        const Force& force = *s.parts.find<Force>();
        std::vector<double> q(80, 0.0), v(80, 1.0), f(80);
        force.value(force.model.get(), 0, q.data(), v.data(), f.data());
        QVERIFY(std::abs(f[0] + 0.1) < 1e-15 && std::abs(f[39] + 4) < 1e-14);
        QVERIFY(std::abs(f[40] + 0.1) < 1e-15 && std::abs(f[79] + 0.1) < 1e-15);
        QCOMPARE(force.entries->first.size(), std::size_t{80});
        QVERIFY(LinkedParts::of(s.parts));
    }

    /// Initial data by index are those by number.
    void initialDataByIndex() {
        const auto read = [](const Value& q) {
            return readScene(Value(Value::Object{
                {"extremal", 1},
                {"model", Value(Value::Object{{"type", "lagrangian"},
                                              {"coordinates", Value::Array{"x[1..n]", "y[1..n]"}},
                                              {"parameters", Value::Object{{"n", 5}, {"l", 0.5}}},
                                              {"lagrangian", "sum(i, 1..n, (x[i]_t^2+y[i]_t^2)/2)"}})},
                {"initial", Value(Value::Object{{"q", q}})},
                {"time", Value::Object{{"end", 1}}},
                {"schemes", Value::Array{Value(Value::Object{{"scheme", "midpoint"}, {"step", 0.1}})}}}));
        };
        const ReadScene scene = read(
            Value(Value::Object{{"x[i = 1..n]", "i*l"}, {"y[1..3]", 2}, {"y4", 7}, {"y[j=5..5]", "j^2"}}));
        QVERIFY2(scene.errors.empty(), scene.errors.empty() ? "" : scene.errors.front().message.c_str());
        const std::vector<double> q(scene.resolved->initial.x.begin(),
                                    scene.resolved->initial.x.begin() + 10);
        QCOMPARE(q, (std::vector<double>{0.5, 1, 1.5, 2, 2.5, 2, 2, 2, 7, 25}));
        const auto errors = [&](const Value& given) {
            std::string all;
            for (const Problem& p : read(given).errors) all += p.pointer + ": " + p.message + "\n";
            return all;
        };
        const std::string twice = errors(Value(Value::Object{{"x[1..n]", 1}, {"y[1..n]", 1}, {"x2", 3}})),
                          far = errors(Value(Value::Object{{"x[1..n+1]", 1}, {"y[1..n]", 1}})),
                          open = errors(Value(Value::Object{{"x[1..m]", 1}, {"y[1..n]", 1}}));
        QVERIFY2(twice.find("x2: has two values") != std::string::npos, twice.c_str());
        QVERIFY2(far.find("x6") != std::string::npos, far.c_str());
        QVERIFY2(open.find("/initial/q/x[1..m]") != std::string::npos, open.c_str());
    }

    void whatIsWrongIsRefused() {
        const auto problem = [](const Value::Object& keys) -> std::string {
            try {
                (void)laws::systemNamed("lagrangian", keys);
            } catch (const InvalidScene& e) {
                return e.what();
            }
            return {};
        };
        const auto many = problem(chainKeys(1500, plain));
        QVERIFY2(many.find("the limit is 2000") != std::string::npos, many.c_str());
        QVERIFY(problem(chainKeys(40, "sum(i, 1..n, x[i]_t^2 + y[i+1]_t^2)")).find("y41") !=
                std::string::npos);
        const auto text = problem(chainKeys(40, "sum(i, 1..100000, x[i]_t^2)"));
        QVERIFY2(text.find("the limit is 10000") != std::string::npos, text.c_str());
    }
};

EXTREMAL_TEST(ManyCoordinatesTest)
}  // namespace many_coordinates_test
}  // namespace extremal::mechanism_test
#include "many_coordinates_test.moc"
