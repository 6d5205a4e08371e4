// SPDX-License-Identifier: GPL-3.0-or-later
/// Events that switch a parameter of the model: the order of the scheme stays, in q and p, for fixed steps
/// and under error control; what cannot change is refused; and stops of error-controlled codes are their own.
#include <QTest>

#include <cmath>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::switches_test {
namespace {

std::string scene(const std::string& model, const std::string& initial, const std::string& scheme, double end,
                  const std::string& events, const std::string& more = "") {
    return "{\"extremal\":1,\"model\":" + model + ",\"initial\":" + initial +
           ",\"time\":{\"end\":" + std::to_string(end) + "},\"schemes\":[" + scheme +
           "],\"events\":" + events + more + "}";
}
ReadScene readGood(const std::string& text) {
    ReadScene read = readScene(text);
    if (!read.errors.empty()) qFatal("%s %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return read;
}
std::string errorsOf(const std::string& text) {
    std::string all;
    for (const Problem& p : readScene(text).errors)
        all += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return all;
}

/// A pendulum whose gravity is another below a height, and a damper that works below another.
const std::string pendulum = R"json({"type":"lagrangian","coordinates":["a"],"parameters":{"g":1,"c":0},
    "lagrangian":"a_t^2/2 + g*cos(a)","forces":{"a":"-c*a_t"}})json";
const std::string start = R"({"q":[1.2],"v":[0]})";
const std::string events = R"json([
    {"expression":"a - 0.3","direction":"down","action":"switch","parameter":"g","value":3},
    {"expression":"a + 0.2","direction":"down","action":"switch","parameter":"c","value":0.4},
    {"expression":"a - 0.1","direction":"up","action":"switch","parameter":"g","value":0.5}])json";

/// The same by hand: the scheme for each setting, in short steps to each place, which is bisected.
State byHand(double end) {
    State s{0, 0, {1.2, 0}};
    const auto systemOf = [](double g, double c) {
        std::string model = pendulum;
        model.replace(model.find("\"g\":1"), 5, "\"g\":" + std::to_string(g));
        model.replace(model.find("\"c\":0"), 5, "\"c\":" + std::to_string(c));
        return *readGood(scene(model, start, R"({"scheme":"galerkin-gauss-6","step":0.01})", 1, "[]"))
                    .resolved->system;
    };
    struct Stage {
        double g, c;
        double (*place)(const State&);
    };
    const Stage stages[] = {{1, 0, [](const State& x) { return 0.3 - x.x[0]; }},
                            {3, 0, [](const State& x) { return -0.2 - x.x[0]; }},
                            {3, 0.4, [](const State& x) { return x.x[0] - 0.1; }},
                            {0.5, 0.4, [](const State&) { return -1.0; }}};
    for (const Stage& stage : stages) {
        const System system = systemOf(stage.g, stage.c);
        const auto step = [&](State from, double length) {
            from.node = 0;
            const auto scheme = makeIntegrator(system, *namedScheme("galerkin-gauss-6"), {0, length});
            if (scheme->advance(from, from.t + length).outcome != Outcome::converged) qFatal("no step");
            return from;
        };
        while (s.t < end - 1e-13) {
            const double length = std::min(0.02, end - s.t);
            // Only from before the place: at the start of a stage the one before has just been passed.
            const State next = step(s, length);
            if (!(stage.place(s) < 0 && stage.place(next) >= 0)) {
                s = next;
                continue;
            }
            double low = 0, high = 1;
            for (int i = 0; i < 60; ++i) {
                const double middle = (low + high) / 2;
                (stage.place(step(s, middle * length)) < 0 ? low : high) = middle;
            }
            s = step(s, high * length);
            break;
        }
    }
    return s;
}

struct Errors {
    double q, p;
};
Errors errorsAfter(const std::string& scheme, const State& exact, double end) {
    const Comparison c = run(readGood(scene(pendulum, start, scheme, end, events)).scene);
    const SchemeResult& r = *c.schemes.at(0);
    if (r.summary.status != RunStatus::done) qFatal("not done");
    return {std::abs(r.trajectory["q.a"].back() - exact.x[0]),
            std::abs(r.trajectory["p.a"].back() - exact.x[1])};
}

}  // namespace

class SwitchesTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::newRow("midpoint") << R"("scheme":"galerkin-gauss-1")" << 2 << 200;
        QTest::newRow("Gauss 2") << R"("scheme":"galerkin-gauss-2")" << 4 << 50;
        QTest::newRow("Gauss 3") << R"("scheme":"galerkin-gauss-3")" << 6 << 48;
        QTest::newRow("Lobatto 2") << R"("scheme":"galerkin-lobatto-2")" << 4 << 120;
        QTest::newRow("RK4") << R"("baseline":"rk4")" << 4 << 100;
    }
    /// Errors over seven grids, as their constant depends on where in a step the switches are.
    void orders() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        constexpr double end = 5;
        const State exact = byHand(end);
        Errors coarse{0, 0}, fine{0, 0};
        for (const double many : {1.0, 1.06, 1.13, 1.19, 1.27, 1.33, 1.41})
            for (const int halvings : {0, 1}) {
                const int n = static_cast<int>(steps * many) << halvings;
                const Errors e = errorsAfter(
                    "{" + scheme.toStdString() + ",\"step\":\"5/" + std::to_string(n) + "\"}", exact, end);
                Errors& sum = halvings ? fine : coarse;
                sum = {std::hypot(sum.q, e.q), std::hypot(sum.p, e.p)};
            }
        const double q = std::log2(coarse.q / fine.q), p = std::log2(coarse.p / fine.p);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f", fine.q, fine.p, q, p);
        QVERIFY(std::abs(q - order) < 0.4 && std::abs(p - order) < 0.4);
    }
    /// A code ends its steps at the switches.
    void underErrorControl() {
        const std::string free = R"json({"type":"lagrangian","coordinates":["a"],"parameters":{"g":1},
            "lagrangian":"a_t^2/2 + g*cos(a)"})json";
        const std::string once =
            R"json([{"expression":"a - 0.3","direction":"down","action":"switch","parameter":"g","value":3}])json";
        const auto last = [&](const std::string& scheme) {
            const Comparison r = run(readGood(scene(free, start, scheme, 5, once)).scene);
            return r.schemes[0]->trajectory["q.a"].back();
        };
        const double best = last(R"({"scheme":"galerkin-gauss-6","step":0.02})");
        for (const char* code : {"dopri5", "fehlberg78", "bulirsch-stoer"}) {
            const double error =
                std::abs(last(R"({"baseline":")" + std::string(code) + R"(","tolerance":1e-11})") - best);
            qInfo("%s: %.1e", code, error);
            QVERIFY(error < 1e-9);
        }
    }
    /// The energy error is that since the last switch, and each switch is an event of the run.
    void whatIsMeasured() {
        const Comparison c =
            run(readGood(scene(pendulum, start, R"({"scheme":"galerkin-gauss-4","step":0.05})", 5, events,
                               R"(,"observe":["energy","balance"])"))
                    .scene);
        const SchemeResult& r = *c.schemes.at(0);
        const auto balance = r.trajectory["balance"];
        double worst = 0;
        for (const double each : balance) worst = std::max(worst, std::abs(each));
        qInfo("balance %.1e", worst);
        QVERIFY(worst < 1e-9);
        const FoundEvents& found = *r.products.find<FoundEvents>();
        QVERIFY(found.all[0].count >= 1 && found.all[1].count >= 1 && found.all[2].count >= 1);
        QVERIFY(std::abs(found.rows["q.a"][0] - 0.3) < 1e-12);
    }
    /// The place where a code is stopped is the end of a step of the code: as good as its tolerance.
    void aCodeStopsByItself() {
        const std::string oscillator = R"({"type":"lagrangian","coordinates":["x"],
            "lagrangian":"x_t^2/2-x^2/2"})";
        const Comparison c = run(readGood(scene(oscillator, R"({"q":[1],"v":[0]})",
                                                R"({"baseline":"fehlberg78","tolerance":1e-12})", 4,
                                                R"json([{"expression":"x + 0.3","action":"stop"}])json"))
                                     .scene);
        const auto& t = c.schemes[0]->trajectory;
        qInfo("x %.1e, t %.1e", t["q.x"].back() + 0.3, t["t"].back() - std::acos(-0.3));
        QVERIFY(std::abs(t["q.x"].back() + 0.3) < 1e-14);
        QVERIFY(std::abs(t["t"].back() - std::acos(-0.3)) < 1e-11);
        QVERIFY(std::abs(t["p.x"].back() + std::sqrt(1 - 0.09)) < 1e-11);
    }
    void whatCannotChangeIsRefused_data() {
        QTest::addColumn<QString>("event");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* what, const char* event, const char* words,
                            const char* scheme = R"({"scheme":"galerkin-gauss-2","step":0.1})") {
            QTest::newRow(what) << event << scheme << words;
        };
        row("unknown", R"json("parameter":"k","value":1)json", "/events/0/parameter: is k");
        row("no parameter", R"json("value":1)json", "/events/0/parameter: is required");
        row("no value", R"json("parameter":"g")json", "/events/0/value: is required");
        row("constraint", R"json("parameter":"l","value":2)json",
            "the constraint rod would no longer be met");
        row("wall", R"json("parameter":"w","value":-3)json", "the wall floor would jump");
        row("restitution", R"json("parameter":"g","value":2,"restitution":1)json",
            "/events/0/restitution: is for events that reflect");
    }
    void whatCannotChangeIsRefused() {
        QFETCH(QString, event);
        QFETCH(QString, scheme);
        QFETCH(QString, words);
        const std::string model = R"({"type":"lagrangian","coordinates":["x","y"],
            "parameters":{"l":1,"g":9.81,"w":-2},"lagrangian":"(x_t^2+y_t^2)/2-g*y",
            "constraints":{"rod":"x^2+y^2-l^2"},"walls":{"floor":"y-w"}})";
        const std::string said =
            errorsOf(scene(model, R"({"q":[1,0],"v":[0,0]})", scheme.toStdString(), 1,
                           R"json([{"expression":"x","action":"switch",)json" + event.toStdString() + "}]"));
        QVERIFY2(QString::fromStdString(said).contains(words), said.c_str());
    }
    void whoChoosesItsTimesIsRefused() {
        const std::string plain = R"({"type":"lagrangian","coordinates":["x"],"parameters":{"k":1},
            "lagrangian":"x_t^2/2-k*x^2/2"})";
        const std::string said =
            errorsOf(scene(plain, R"({"q":[1],"v":[0]})", R"({"scheme":"sem-2","step":0.1})", 1,
                           R"json([{"expression":"x","action":"switch","parameter":"k","value":2}])json"));
        QVERIFY2(QString::fromStdString(said).contains("chooses its own times"), said.c_str());
    }
    /// A motion that a switch turns back at the place has not passed it: it goes on with the new value.
    void whatTurnsBackHasNotPassed() {
        const std::string plain = R"({"type":"lagrangian","coordinates":["x"],"parameters":{"f":-1},
            "lagrangian":"x_t^2/2+f*x"})";
        const Comparison c = run(
            readGood(scene(plain, R"({"q":[0.5],"v":[0]})", R"({"scheme":"galerkin-gauss-2","step":0.1})", 3,
                           R"json([
            {"expression":"x + x_t/2","direction":"down","action":"switch","parameter":"f","value":2},
            {"expression":"x + x_t/2","direction":"up","action":"switch","parameter":"f","value":-1}])json"))
                .scene);
        QVERIFY(c.schemes[0]->summary.status == RunStatus::done);
        const FoundEvents& found = *c.schemes[0]->products.find<FoundEvents>();
        QCOMPARE(found.all[0].count, 1LL);
        QCOMPARE(found.all[1].count, 0LL);
        // 1/2 - t^2/2 - t/2 = 0
        QVERIFY(std::abs(found.all[0].first - (std::sqrt(5.0) - 1) / 2) < 1e-14);
    }
    /// What is written is read again.
    void thereAndBack() {
        const ReadScene read =
            readGood(scene(pendulum, start, R"({"scheme":"galerkin-gauss-2","step":0.1})", 1, events));
        const ReadScene again = readScene(toValue(read.scene));
        QVERIFY(again.errors.empty() && again.scene.events == read.scene.events);
    }
};

EXTREMAL_TEST(SwitchesTest)
}  // namespace extremal::switches_test
#include "switches_test.moc"
