// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables and splittings that a user types: they are the methods that they say, promise what their
/// coefficients allow, and are refused with the place and the remedy where they make no method.
#include <QTest>

#include <cmath>

#include "engine/baseline/parts.hpp"
#include "engine/baseline/typed_tableau.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/tableau/tableau.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_tableau_test {
namespace {

using laws::keplerStart;

Settings settingsOf(const std::string& json) {
    const Value value = parseJson(json);
    Settings settings{value.find("type")->asString(), {}, {}};
    for (const auto& [key, entry] : value.asObject())
        if (key != "type") settings.keys.emplace_back(key, entry);
    return settings;
}

const char* const kutta =
    R"~({"type":"runge-kutta","a":[[],["1/2"],[0,"1/2"],[0,0,1]],"b":["1/6","1/3","1/3","1/6"]})~";
const char* const gauss2 =
    R"~({"type":"runge-kutta","a":[["1/4","1/4-sqrt(3)/6"],["1/4+sqrt(3)/6","1/4"]],"b":[0.5,0.5]})~";
const char* const lobatto3 =
    R"~({"type":"runge-kutta","b":["1/6","2/3","1/6"],
        "a":[[0,0,0],["5/24","1/3","-1/24"],["1/6","2/3","1/6"]],
        "a_hat":[["1/6","-1/6",0],["1/6","1/3",0],["1/6","5/6",0]]})~";
const char* const verlet = R"~({"type":"splitting","kicks":["1/2","1/2"],"drifts":[1]})~";
const char* const forestRuth =
    R"~({"type":"splitting","first":"drift",
        "drifts":["1/(2*(2-2^(1/3)))","(1-2^(1/3))/(2*(2-2^(1/3)))","(1-2^(1/3))/(2*(2-2^(1/3)))","1/(2*(2-2^(1/3)))"],
        "kicks":["1/(2-2^(1/3))","-2^(1/3)/(2-2^(1/3))","1/(2-2^(1/3))"]
})~";

std::unique_ptr<Integrator> made(const System& system, const Settings& settings, double step) {
    return findBaseline(settings.type)->make(system, {step, {}, 0, settings});
}

State after(const System& system, const Settings& settings, double step, int n, const State& start) {
    return laws::after(*made(system, settings, step), start, n).value();
}

double distance(const State& a, const State& b) { return laws::distance(a.x, b.x, 0, a.x.size()); }

ReadScene sceneWith(const std::string& baseline, const std::string& model = R"~({"type":"kepler"})~",
                    const std::string& initial = R"~({"q":[0.4,0],"p":[0,2]})~") {
    return readScene(R"~({"extremal":1,"model":)~" + model + R"~(,"initial":)~" + initial +
                     R"~(,"time":{"end":1},"schemes":[{"step":0.05,"baseline":)~" + baseline + "}]}");
}

}  // namespace

class TypedTableauTest : public QObject {
    Q_OBJECT
    const System kepler_ = laws::systemNamed("kepler");
    const System pendulum_ = laws::systemNamed("double-pendulum");
    const State swing_{0, 0, {0.3, 0.2, 0.1, 0}};

private slots:
    void retypedMethodsAreTheBuiltInOnes() {
        const Settings four{"gauss-collocation", {{"stages", 2.0}}, {}};
        // measured: 0, 3e-15, 9e-16, 0
        QVERIFY(distance(after(kepler_, settingsOf(kutta), 0.05, 20, keplerStart),
                         after(kepler_, {"rk4", {}, {}}, 0.05, 20, keplerStart)) < 1e-14);
        QVERIFY(distance(after(kepler_, settingsOf(gauss2), 0.05, 20, keplerStart),
                         after(kepler_, four, 0.05, 20, keplerStart)) < 1e-13);
        QVERIFY(distance(after(pendulum_, settingsOf(gauss2), 0.05, 20, swing_),
                         after(pendulum_, four, 0.05, 20, swing_)) < 1e-13);
        QVERIFY(distance(after(kepler_, settingsOf(verlet), 0.05, 20, keplerStart),
                         after(kepler_, {"stormer-verlet", {}, {}}, 0.05, 20, keplerStart)) < 1e-14);
        const auto galerkin = makeIntegrator(kepler_, *namedScheme("galerkin-lobatto-2"), {0, 0.05});
        QVERIFY(distance(after(kepler_, settingsOf(lobatto3), 0.05, 20, keplerStart),
                         laws::after(*galerkin, keplerStart, 20).value()) < 1e-13);
    }

    void claimsFollowFromTheCoefficients_data() {
        QTest::addColumn<QString>("keys");
        QTest::addColumn<int>("order");
        QTest::addColumn<bool>("isSymmetric");
        QTest::addColumn<bool>("isSymplectic");
        QTest::newRow("Kutta") << kutta << 4 << false << false;
        QTest::newRow("Gauss") << gauss2 << 4 << true << true;
        QTest::newRow("Lobatto IIIA-IIIB") << lobatto3 << 4 << true << true;
        QTest::newRow("Verlet") << verlet << 2 << true << true;
        QTest::newRow("Forest-Ruth") << forestRuth << 4 << true << true;
        QTest::newRow("Ruth") << R"~({"type":"splitting","first":"kick","kicks":["7/24","3/4","-1/24"],
                                      "drifts":["2/3","-2/3",1]})~"
                              << 3 << false << true;
        QTest::newRow("Heun") << R"~({"type":"runge-kutta","a":[[],[1]],"b":["1/2","1/2"]})~" << 2 << false
                              << false;
        QTest::newRow("Radau IIA")
            << R"~({"type":"runge-kutta","a":[["5/12","-1/12"],["3/4","1/4"]],"b":["3/4","1/4"]})~" << 3
            << false << false;
    }
    void claimsFollowFromTheCoefficients() {
        QFETCH(QString, keys);
        QFETCH(int, order);
        QFETCH(bool, isSymmetric);
        QFETCH(bool, isSymplectic);
        const Settings settings = settingsOf(keys.toStdString());
        const Claims claims = claimsOf(*findBaseline(settings.type), settings);
        QCOMPARE(claims.order, order);
        QCOMPARE(claims.isSymmetric, isSymmetric);
        QCOMPARE(claims.isSymplectic, isSymplectic);
        // Measured on Kepler's problem.
        const auto fine = makeIntegrator(kepler_, *namedScheme("galerkin-gauss-8"), {0, 1. / 64});
        const State exact = laws::after(*fine, keplerStart, 64).value();
        std::vector<double> h, error;
        for (const int n : {320, 640, 1280}) {
            h.push_back(std::log(1.0 / n));
            error.push_back(std::log(distance(after(kepler_, settings, 1.0 / n, n, keplerStart), exact)));
        }
        const double measured = slope(h, error);
        QVERIFY2(std::abs(measured - order) < 0.25, qPrintable(QString::number(measured)));
    }

    void stiffStepsAreSolvedByNewton() {
        const System stiff = laws::systemNamed("harmonic-oscillator", {{"k", 1e6}});
        const State start{0, 0, {1, 0}};
        const State end = after(stiff, settingsOf(gauss2), 0.1, 5, start);  // h omega = 100
        QVERIFY(std::abs(0.5e6 * end.x[0] * end.x[0] + 0.5 * end.x[1] * end.x[1] - 0.5e6) < 1e-6);
    }

    void tangentMapsAreThoseOfTheStep_data() {
        QTest::addColumn<QString>("keys");
        for (const char* keys : {kutta, gauss2, lobatto3}) QTest::newRow(keys) << keys;
    }
    void tangentMapsAreThoseOfTheStep() {
        QFETCH(QString, keys);
        const auto method = made(pendulum_, settingsOf(keys.toStdString()), 0.1);
        State state = swing_;
        method->begin(state);
        QVERIFY(advance(*method, state).outcome == Outcome::converged);
        std::vector<double> W(16);
        for (std::size_t i = 0; i < 4; ++i) W[5 * i] = 1;
        QVERIFY(method->applyTangent(W));
        for (std::size_t j = 0; j < 4; ++j) {
            constexpr double e = 1e-4;
            const auto moved = [&](double by) {
                State x = swing_;
                x.x[j] += by;
                return after(pendulum_, settingsOf(keys.toStdString()), 0.1, 1, x).x;
            };
            const auto right = moved(e), left = moved(-e), right2 = moved(2 * e), left2 = moved(-2 * e);
            for (std::size_t i = 0; i < 4; ++i) {
                const double slope = (8 * (right[i] - left[i]) - (right2[i] - left2[i])) / (12 * e);
                QVERIFY(std::abs(W[4 * j + i] - slope) < 1e-10);  // measured: 2e-12
            }
        }
    }

    void stabilityLimitsAreKnown() {
        const auto limit = [](const char* keys) {
            const Settings s = settingsOf(keys);
            return findBaseline(s.type)->parts.find<OscillatorLimit>()->of(s);
        };
        QVERIFY(std::abs(limit(kutta) - 2 * std::sqrt(2.0)) < 1e-3);
        QVERIFY(std::abs(limit(verlet) - 2) < 1e-3);
        QVERIFY(std::isinf(limit(gauss2)));
        QCOMPARE(limit(R"~({"type":"runge-kutta","a":[[],[1]],"b":["1/2","1/2"]})~"), 0.0);
    }

    void misuseIsRefusedWithItsPlace_data() {
        QTest::addColumn<QString>("keys");
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* name, const char* keys, const char* place, const char* said) {
            QTest::newRow(name) << keys << place << said;
        };
        row("sum", R"~({"type":"runge-kutta","a":[[],[1]],"b":["1/2","1/3"]})~", "/b", "sum to 0.8333333333");
        row("rows", R"~({"type":"runge-kutta","a":[[]],"b":["1/2","1/2"]})~", "/a", "as many rows");
        row("row", R"~({"type":"runge-kutta","a":[[],[1,2,3]],"b":["1/2","1/2"]})~", "/a/1", "at most 2");
        row("no row", R"~({"type":"runge-kutta","a":[[],1],"b":["1/2","1/2"]})~", "/a/1", "array");
        row("name", R"~({"type":"runge-kutta","a":[[],["g"]],"b":["1/2","1/2"]})~", "/a/1/0", "expression");
        row("variable", R"~({"type":"runge-kutta","a":[[],["1/2+0*tau"]],"b":["1/2","1/2"]})~", "/a/1/0",
            "unknown name");
        row("syntax", R"~({"type":"runge-kutta","a":[[],["1/"]],"b":["1/2","1/2"]})~", "/a/1/0",
            "expression");
        row("infinite", R"~({"type":"runge-kutta","a":[[],["1/0"]],"b":["1/2","1/2"]})~", "/a/1/0",
            "not finite");
        row("flag", R"~({"type":"runge-kutta","a":[[],[true]],"b":["1/2","1/2"]})~", "/a/1/0",
            "number or an expression");
        row("nodes", R"~({"type":"runge-kutta","a":[[],[1]],"b":["1/2","1/2"],"c":[0]})~", "/c",
            "as many nodes");
        row("hat", R"~({"type":"runge-kutta","a":[[],[1]],"b":["1/2","1/2"],"b_hat":[1,0]})~", "/b_hat",
            "requires a_hat");
        row("empty", R"~({"type":"runge-kutta","a":[],"b":[]})~", "/b", "must be an array of numbers");
        row("missing", R"~({"type":"runge-kutta","b":[1]})~", "/a", "is required");
        row("kicks", R"~({"type":"splitting","kicks":["1/4","1/4","1/4","1/4"],"drifts":["1/2","1/2"]})~",
            "/drifts", "do not");
        row("drifts", R"~({"type":"splitting","kicks":["1/2","1/2"],"drifts":[0.9]})~", "/drifts",
            "sum to 0.9");
    }
    void misuseIsRefusedWithItsPlace() {
        QFETCH(QString, keys);
        QFETCH(QString, place);
        QFETCH(QString, said);
        const ReadScene read = sceneWith(keys.toStdString());
        QVERIFY(!read.errors.empty());
        const Problem& first = read.errors.front();
        QCOMPARE(QString::fromStdString(first.pointer), "/schemes/0/baseline" + place);
        QVERIFY2(QString::fromStdString(first.message).contains(said), first.message.c_str());
    }

    void doubtfulCoefficientsAreWarnedOf() {
        const auto warnings = [](const std::string& keys) {
            QString text;
            for (const Problem& p : sceneWith(keys).warnings)
                text += QString::fromStdString(p.pointer + ": " + p.message + "\n");
            return text;
        };
        const QString digits = warnings(
            R"~({"type":"runge-kutta","a":[[],[0.5],[0,0.5],[0,0,1]],"b":[0.16667,0.33333,0.33333,0.16667]})~");
        QVERIFY2(digits.contains("/schemes/0/baseline/a: has order") || digits.contains("order 0"),
                 qPrintable(digits));
        const QString nodes =
            warnings(R"~({"type":"runge-kutta","a":[[],["2/3"]],"b":["1/4","3/4"],"c":[0,0.6]})~");
        QVERIFY2(nodes.contains("/schemes/0/baseline/c/1: is 0.6"), qPrintable(nodes));
        QVERIFY(!warnings(kutta).contains("baseline"));
    }

    /// Kicks and drifts are explicit for separable systems; else they need the form of Euler maps.
    void splittingsOnOtherSystemsAreRefusedWhereTheyLoseTheirOrder() {
        const std::string model = R"~({"type":"double-pendulum"})~",
                          initial = R"~({"q":[0.3,0.2],"p":[0,0]})~";
        QVERIFY(sceneWith(verlet, model, initial).errors.empty());
        const ReadScene refused = sceneWith(forestRuth, model, initial);
        QVERIFY(!refused.errors.empty());
        QVERIFY(QString::fromStdString(refused.errors.front().message).contains("begin and end with a kick"));
    }

    void scenesKeepWhatIsTyped() {
        const ReadScene read = sceneWith(kutta);
        QVERIFY(read.errors.empty());
        const std::string text = writeScene(read.scene);
        QVERIFY(text.find("\"1/6\"") != std::string::npos);
        QCOMPARE(writeScene(readScene(text).scene), text);
    }
};

EXTREMAL_TEST(TypedTableauTest)

}  // namespace extremal::typed_tableau_test

#include "typed_tableau_test.moc"
