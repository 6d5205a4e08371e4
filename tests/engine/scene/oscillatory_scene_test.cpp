// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/text/text.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::oscillatory_scene_test {
namespace {

std::string scene(const std::string& scheme,
                  const std::string& model = R"({"type":"spring-pendulum","k":1e6})") {
    return R"({"extremal":1,"model":)" + model + R"(,"time":{"end":2},"schemes":[)" + scheme +
           R"(],"reference":"none"})";
}
std::string space(const std::string& keys, const std::string& rule = "") {
    return R"({"step":0.2,"space":{"type":"oscillatory")" + keys + "}" +
           (rule.empty() ? "" : R"(,"quadrature":)" + rule) + "}";
}

/// Of a Lagrangian in x and y, which start at rest at 1/2; not a number where the scene is refused.
double estimateOf(const std::string& lagrangian) {
    const ReadScene read = readScene(
        R"({"extremal":1,"model":{"type":"lagrangian","lagrangian":")" + lagrangian +
        R"(","coordinates":["x","y"]},"initial":{"q":[0.5,0.5],"p":[0,0]},"time":{"end":2},"schemes":[)" +
        R"({"step":0.01,"baseline":"stormer-verlet"}],"reference":"none"})");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return read.resolved ? estimateFrequency(*read.resolved->system, read.resolved->initial) : NAN;
}

}  // namespace

class OscillatorySceneTest : public QObject {
    Q_OBJECT
private slots:
    void whatIsWrongIsSaid_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("start");
        const auto row = [](const char* name, const std::string& scheme, const char* start) {
            QTest::newRow(name) << QString::fromStdString(scheme) << start;
        };
        row("omega", space(R"(,"omega":-3)"), "/schemes/0/space/omega: must be a positive finite number");
        row("omega name", space(R"(,"omega":"fast")"),
            "/schemes/0/space/omega: the expression has an unknown name");
        row("omega list", space(R"(,"omega":[10,20,30])"),
            "/schemes/0/space/omega: must be a positive finite number");
        row("second omega", space(R"(,"omega":[10,-20])"),
            "/schemes/0/space/omega/1: must be a positive finite number, got -20");
        row("combination", space(R"(,"omega":[10,16],"harmonics":[{"of":[0,0]}])"),
            "/schemes/0/space/harmonics/0/of: must be two multiples");
        row("twice", space(R"(,"omega":[10,16],"harmonics":[1,{"of":[-1,0]}])"),
            "/schemes/0/space/harmonics/1: is a harmonic that is there");
        row("of one", space(R"(,"omega":10,"harmonics":[{"of":[1,1]}])"),
            "/schemes/0/space/harmonics/0: the degree of a harmonic");
        row("harmonics", space(R"(,"harmonics":3)"), "/schemes/0/space/harmonics: must be an array");
        row("harmonic", space(R"(,"harmonics":[1,-1])"),
            "/schemes/0/space/harmonics/1: the degree of a harmonic must be an integer from 0 to 24, got -1");
        row("variable", space(R"(,"variables":{"b":{"degree":2}})"),
            "/schemes/0/space/variables/b: spring-pendulum has no coordinate \"b\"");
        row("key", space(R"(,"variables":{"a":{"degre":2}})"),
            "/schemes/0/space/variables/a/degre: unknown key");
        row("degree", space(R"(,"fast":{"degree":0})"),
            "/schemes/0/space/fast/degree: the degree must be an integer from 1 to 24, got 0");
        row("nodes", space("", R"({"type":"filon-lobatto","nodes":4})"),
            "/schemes/0: unsupported combination: 4 nodes do not see");
        row("phases", space("", R"({"type":"filon-lobatto","phases":4})"),
            "/schemes/0: unsupported combination: 4 phases do not see");
        row("unresolved", space("", R"({"type":"gauss","nodes":12})"),
            "/schemes/0/quadrature: 12 nodes do not resolve");
        row("polynomials",
            R"({"step":0.1,"space":{"type":"polynomial","degree":2},"quadrature":"filon-lobatto"})",
            "/schemes/0: unsupported combination: a Filon rule");
        row("solver", R"({"step":0.2,"scheme":"multiscale-r1","solver":{"method":"fixed-point"}})",
            "/schemes/0/solver/method: fixed-point does not solve");
    }
    void whatIsWrongIsSaid() {
        QFETCH(QString, scheme);
        QFETCH(QString, start);
        const ReadScene read = readScene(scene(scheme.toStdString()));
        QVERIFY(!read.errors.empty());
        const std::string error = read.errors[0].pointer + ": " + read.errors[0].message;
        QVERIFY2(error.starts_with(start.toStdString()), error.c_str());
    }
    void modelsThatDoNotKnowTheirFrequencySaySo() {
        const ReadScene read =
            readScene(scene(R"({"step":0.2,"scheme":"multiscale-r1"})", R"({"type":"kepler"})"));
        QVERIFY(!read.errors.empty());
        QCOMPARE(QString::fromStdString(read.errors[0].pointer), QString("/schemes/0/space/omega"));
    }
    void aSceneSurvivesWritingAndReading() {
        const std::string keys =
            R"(,"omega":"estimate","degree":6,"harmonics":[3,1],"variables":{"a":{"degree":4}})";
        const ReadScene read = readScene(scene(space(keys)));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ReadScene again = readScene(writeScene(read.scene));
        QVERIFY(again.errors.empty() && again.scene == read.scene);
    }
    void twoFrequenciesMayBeExpressions() {
        const std::string keys =
            R"_(,"omega":["sqrt(k/m)","0.618*sqrt(k/m)"],"harmonics":[1,{"of":[1,-1],"degree":0}])_";
        const ReadScene read = readScene(scene(space(keys)));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Settings& s = read.scene.schemes[0].space;
        QCOMPARE(s.find("omega")->asArray()[1].asNumber(), 618.0);
        const std::string written = writeScene(read.scene);
        QVERIFY(written.find("0.618*sqrt(k/m)") != std::string::npos);
        QVERIFY(readScene(written).scene == read.scene);
    }
    void resonancesAreWarningsWithARemedy() {
        // h w / pi = 63.9 at h = 0.2008.
        const ReadScene read = readScene(scene(R"({"step":0.2008,"scheme":"multiscale-r1"})"));
        QVERIFY(read.errors.empty());
        const auto about = [](const ReadScene& r) {
            return std::find_if(r.warnings.begin(), r.warnings.end(),
                                [](const Problem& p) { return p.pointer == "/schemes/0/step"; });
        };
        QVERIFY(about(read) != read.warnings.end());
        QVERIFY(about(read)->remedy.isNumber());
        QCOMPARE(handbookPlace(*about(read)), std::string("multiscale#resonances"));
        const std::string remedy = formatNumber(about(read)->remedy.asNumber());
        const ReadScene taken = readScene(scene(R"({"step":)" + remedy + R"(,"scheme":"multiscale-r1"})"));
        QVERIFY(taken.errors.empty() && about(taken) == taken.warnings.end());
        const ReadScene good = readScene(scene(R"({"step":0.2014,"scheme":"multiscale-r1"})"));
        QVERIFY(good.errors.empty() && about(good) == good.warnings.end());
    }
    void typedLagrangiansStepOverTheirOscillation() {
        const std::string typed =
            R"({"type":"lagrangian","coordinates":["a","theta"],"parameters":{"k":1e6},)"
            R"("lagrangian":"a_t^2/2 + (1+a)^2*theta_t^2/2 + 9.81*(1+a)*cos(theta) - k*a^2/2"})";
        const std::string start = R"("initial":{"q":[0.005,1],"p":[0,0]},)";
        const auto last = [&](const std::string& model, const std::string& omega) {
            std::string text = scene(space(R"(,"degree":6,"harmonics":[3,1],"omega":)" + omega), model);
            text.insert(text.find("\"time\""), start);
            const ReadScene read = readScene(text);
            if (!read.errors.empty()) throw std::runtime_error(read.errors[0].message);
            const Comparison c = run(read.scene);
            const auto q = c.schemes[0]->trajectory["q.theta"];
            return q.back();
        };
        const double builtIn = last(R"({"type":"spring-pendulum","k":1e6})", R"("model")");
        const double number = last(typed, "1000"), estimated = last(typed, R"("estimate")");
        qInfo("typed %.1e, with an estimated frequency %.1e off", number - builtIn, estimated - builtIn);
        QVERIFY(std::abs(number - builtIn) < 1e-12);
        QVERIFY(std::abs(estimated - builtIn) < 1e-9);
    }
    /// The frequency is that of the coordinate that is fastest by itself, wherever it stands.
    void theFastestCoordinateIsMeasured() {
        for (const char* const lagrangian :
             {"x_t^2/2+y_t^2/2-x^2/2-5000*y^2", "x_t^2/2+y_t^2/2-5000*x^2-y^2/2"}) {
            const double w = estimateOf(lagrangian);
            qInfo("%s: %.2e off", lagrangian, w / 100 - 1);
            QVERIFY(std::abs(w / 100 - 1) < 1e-9);  // 2.7e-11
        }
    }
    /// A spring that hardens, y'' = -a y - b y^3 from rest at 1/2: its frequency is neither that of small
    /// oscillations nor that of the linearisation at the start, and the slow coordinate does not show it.
    void theFrequencyOfAHardeningSpringIsThatOfItsMotion() {
        const double a = 1e4, b = 1600, force = a + b / 4, modulus = b / 4 / (2 * force);
        const double exact = std::numbers::pi / 2 * std::sqrt(force) / std::comp_ellint_1(std::sqrt(modulus));
        for (const char* const lagrangian :
             {"x_t^2/2+y_t^2/2-x^2/2-5000*y^2-400*y^4", "x_t^2/2+y_t^2/2-5000*x^2-400*x^4-y^2/2"}) {
            const double w = estimateOf(lagrangian);
            qInfo("%s: %.2e off", lagrangian, w / exact - 1);
            QVERIFY(std::abs(w / exact - 1) < 1e-3);
        }
    }
};

EXTREMAL_TEST(OscillatorySceneTest)
}  // namespace extremal::oscillatory_scene_test

#include "oscillatory_scene_test.moc"
