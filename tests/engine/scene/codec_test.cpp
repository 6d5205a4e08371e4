// SPDX-License-Identifier: GPL-3.0-or-later
#include <QDir>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/schema.hpp"
#include "tests/tools/test.hpp"

namespace extremal::codec_test {

namespace {

/// A valid scene to spoil.
const std::string good = R"({
  "extremal": 1,
  "model": { "type": "kepler", "mu": 1 },
  "initial": { "q": [0.4, 0], "p": [0, 2] },
  "time": { "end": 3 },
  "schemes": [
    { "step": 0.1, "space": { "type": "polynomial", "degree": 2 }, "quadrature": { "type": "gauss" } },
    { "label": "SV", "step": 0.01, "baseline": "stormer-verlet" }
  ]
})";

Problem firstError(const ReadScene& read) {
    return read.errors.empty() ? Problem{"none", "no error", ""} : read.errors[0];
}

std::string textOf(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& p : problems) text += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return text;
}

}  // namespace

class CodecTest : public QObject {
    Q_OBJECT
private slots:
    /// A plane by directions is the one by keys, and what is wrong in it is named by these.
    void planesByDirections() {
        const auto withModel = [](const std::string& model) {
            return readScene(R"({"extremal":1,"model":)" + model +
                             R"(,"time":{"end":1},"schemes":[{"baseline":"rk4","step":0.01}]})");
        };
        const ReadScene byKeys = withModel(R"({"type":"field-2d","potential":"phi4","domain":[-1,1],)"
                                           R"("domain_y":[0,"4/2"],"cells":8,"cells_y":16})");
        const auto ofModel = [](const ReadScene& read) {  // the scheme is another matter
            return std::count_if(read.errors.begin(), read.errors.end(),
                                 [](const Problem& p) { return p.pointer.starts_with("/model"); });
        };
        QCOMPARE(ofModel(byKeys), 0);
        for (const char* type : {"field", "field-2d"}) {
            const ReadScene read =
                withModel(R"({"type":")" + std::string(type) +
                          R"(","potential":"phi4","domain":{"x":[-1,1],"y":[0,"4/2"]},"cells":[8,16]})");
            QCOMPARE(ofModel(read), 0);
            QVERIFY(read.scene.model == byKeys.scene.model);
        }
        QCOMPARE(withModel(R"({"type":"schrodinger","domain":{"x":[0,1],"y":[0,2]},"modes":[8,16]})")
                     .scene.model.type,
                 std::string("schrodinger-2d"));
        QVERIFY(ofModel(withModel(R"({"type":"field","domain":{"x":[0,1]},"cells":[8,8]})")) > 0);
        QVERIFY(ofModel(withModel(R"({"type":"pendulum","domain":{"x":[0,1],"y":[0,1]}})")) > 0);
        const ReadScene odd = withModel(R"({"type":"field","domain":{"x":[0,1],"y":[2,1]},"cells":[8,8]})");
        QVERIFY(!odd.errors.empty() && odd.errors[0].pointer.starts_with("/model/domain_y"));
    }
    void everyMistakeIsNamedWhereItStands_data() {
        QTest::addColumn<QString>("set");  // an override that spoils the good scene
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("message");  // parts of message and hint
        QTest::addColumn<QString>("hint");
        const auto row = [](const char* set, const char* pointer, const char* message,
                            const char* hint = "") {
            QTest::newRow(set) << set << pointer << message << hint;
        };
        row("/extremal=2", "/extremal", "must be 1, got 2");
        row("/model/type=keppler", "/model/type", "unknown model \"keppler\"", "kepler");
        row("/model={}", "/model/type", "is required");
        row("/model=[]", "/model", "must be an object");
        row("/model/mu=0", "/model/mu", "must be a positive finite number, got 0");
        row("/model/mu=-1", "/model/mu", "got -1");
        row("/model/mu=1e999", "/model/mu", "does not fit a double");
        row("/model/mu=NaN", "/model/mu", "unknown name \"NaN\"", "mu");
        row("/model/mu=1\\/0", "/model/mu", "has \"\\\"");
        row("/model/mu=1/0", "/model/mu", "is not finite: inf");
        row("/model/mu=true", "/model/mu", "must be a positive finite number, got true");
        row("/model/mu=mu", "/model/mu", "depends on itself: mu -> mu");
        row("/model/nu=1", "/model/nu", "unknown key \"nu\"", "mu");
        row("/initial/q=[1]", "/initial/q", "must have 2 numbers (x and y), got 1");
        row("/initial/q={\"x\":1}", "/initial/q/y", "is required");
        row("/initial/q={\"x\":1,\"y\":0,\"z\":0}", "/initial/q/z", "unknown key \"z\"", "");
        row("/initial/q=[1,\"2*\"]", "/initial/q/1", "ends where a number", "");
        row("/initial/q=[1,null]", "/initial/q/1", "must be a finite number, got null");
        row("/initial/v=[0,0]", "/initial", "has both p and v");
        row("/time/end=0", "/time/end", "must differ from the start 0, got 0");
        row("/time/start=abc", "/time/start", "unknown name \"abc\"");
        row("/time=3", "/time", "must be an object");
        row("/schemes=[]", "/schemes", "must have at least one scheme");
        row("/schemes={}", "/schemes", "must be an array");
        row("/schemes/1/step=-0.1", "/schemes/1/step", "must be a positive finite number, got -0.1");
        row("/schemes/1/step=0", "/schemes/1/step", "got 0");
        row("/schemes/1/step=\"0.1\"x", "/schemes/1/step", "has \"\"\" where a number");
        row("/schemes/1/step=1e-12", "/schemes/1/step", "needs 3e+12 steps from 0 to 3, the limit is 1e+11",
            "/limits/steps");
        row("/time/start=2.9999999999999996", "/schemes/0/step", "is longer than the run");
        row("/schemes/1/stepp=1", "/schemes/1/stepp", "unknown key \"stepp\"", "step");
        row("/schemes/1/space={\"type\":\"polynomial\",\"degree\":1}", "/schemes/1",
            "has space and baseline at once");
        row("/schemes/1/quadrature=gauss", "/schemes/1/quadrature", "requires a space");
        row("/schemes/1={\"step\":1}", "/schemes/1", "names neither a space, a baseline nor a scheme");
        row("/schemes/1/baseline=rk5", "/schemes/1/baseline", "unknown baseline \"rk5\"", "rk4");
        row("/schemes/1/baseline=dopri5", "/schemes/1/step", "is not used: dopri5 chooses its steps");
        row("/schemes/1/tolerance=1", "/schemes/1/tolerance", "is not used: the scheme has a step");
        row("/schemes/1={\"baseline\":\"dopri5\"}", "/schemes/1/tolerance", "is required");
        row("/schemes/1={\"baseline\":\"rk4\"}", "/schemes/1/step", "is required");
        row("/schemes/1={\"scheme\":\"galerkin-gaus-2\",\"step\":1}", "/schemes/1/scheme", "unknown scheme",
            "galerkin-gauss-2");
        row("/schemes/0/label=SV", "/schemes/1/label", "is the label of /schemes/0 already");
        row("/schemes/0/label=", "/schemes/0/label", "is empty");
        row("/schemes/0/label==1+1", "/schemes/0/label",
            "begins with =, which a spreadsheet takes for a formula");
        row("/schemes/0/label=@SUM(A1)", "/schemes/0/label", "begins with @");
        row("/schemes/0/label=\"-1\"", "/schemes/0/label", "begins with -");
        row("/schemes/0/label=\"+1\"", "/schemes/0/label", "begins with +");
        row("/schemes/0/label=\"a\\u001b[2J\"", "/schemes/0/label", "without control characters");
        row("/schemes/0/enabled=1", "/schemes/0/enabled", "must be true or false, got 1");
        row("/schemes/0/space/degree=25", "/schemes/0/space/degree",
            "must be an integer from 1 to 24, got 25");
        row("/schemes/0/space/degree=2.5", "/schemes/0/space/degree",
            "must be an integer from 1 to 24, got 2.5");
        row("/schemes/0/space/basis=legender", "/schemes/0/space/basis", "must be one of", "legendre");
        row("/schemes/0/space/type=polynom", "/schemes/0/space/type", "unknown space", "polynomial");
        row("/schemes/0/quadrature/nodes=0", "/schemes/0/quadrature/nodes", "must be an integer from 1");
        row("/schemes/0/quadrature/type=gaus", "/schemes/0/quadrature/type", "unknown quadrature", "gauss");
        row("/schemes/0/quadrature/nodes=1", "/schemes/0", "");
        row("/schemes/0/solver/method=newtn", "/schemes/0/solver/method", "unknown method", "newton");
        row("/schemes/0/solver/tolerance=0", "/schemes/0/solver/tolerance", "above 0 and at most 1, got 0");
        row("/observe=[\"eror\"]", "/observe/0", "unknown observable \"eror\"", "error");
        row("/observe=[\"energy\",\"energy\"]", "/observe/1", "is listed twice");
        row("/observe=energy", "/observe", "must be an array");
        row("/views=[\"fase\"]", "/views/0", "unknown view \"fase\"", "phase");
        row("/views=[{\"view\":\"phase\",\"x\":\"q.z\"}]", "/views/0/x", "unknown column \"q.z\"", "q.x");
        row("/views=[{\"view\":\"energy\",\"y\":\"q.x\"}]", "/views/0/y",
            "is only for phase portraits, trajectories");
        row("/views=[{\"view\":\"phase\",\"range\":[0,1]}]", "/views/0/range", "must be an object");
        row("/views=[{\"view\":\"phase\",\"range\":{\"z\":[0,1]}}]", "/views/0/range/z", "unknown key \"z\"");
        row("/views=[{\"view\":\"phase\",\"range\":{\"x\":3}}]", "/views/0/range/x",
            "must be an array of two numbers");
        row("/views=[{\"view\":\"phase\",\"range\":{\"x\":[1]}}]", "/views/0/range/x",
            "must have two numbers");
        row("/views=[{\"view\":\"phase\",\"range\":{\"y\":[\"2*mu\",1]}}]", "/views/0/range/y",
            "must be two increasing numbers, got 2 and 1");
        row("/views=[{\"view\":\"phase\",\"range\":{\"y\":[1,\"mi\"]}}]", "/views/0/range/y/1",
            "unknown name \"mi\"", "did you mean");
        row("/views=[{\"view\":\"phase\",\"range\":{\"x\":[1,1.0000000000001]}}]", "/views/0/range/x",
            "too close together");
        row("/views=[{\"view\":\"energy\",\"range\":{\"y\":[0,1]}}]", "/views/0/range/y/0",
            "must be a positive finite number, got 0", "logarithmic");
        row("/views=[{\"view\":\"work-precision\",\"range\":{\"x\":[-1,1]}}]", "/views/0/range/x/0", "got -1",
            "logarithmic");
        row("/views=[{\"view\":\"stage\",\"range\":{\"x\":[0,1]}}]", "/views/0/range", "stage has no axes",
            "leave it out");
        row("/views=[{\"view\":\"sparsity\",\"range\":{}}]", "/views/0/range", "sparsity has no axes");
        row("/views=[{\"view\":\"energy\",\"log\":1}]", "/views/0/log", "must be true or false");
        row("/views=[{\"view\":\"stage\",\"log\":true}]", "/views/0/log", "stage has no axes",
            "leave it out");
        row("/views=[{\"view\":\"phase\",\"log\":true,\"range\":{\"y\":[-1,1]}}]", "/views/0/range/y/0",
            "must be a positive finite number", "logarithmic");
        row("/views=[{\"view\":\"energy\",\"size\":300}]", "/views/0/size", "must be an object");
        row("/views=[{\"view\":\"energy\",\"size\":{\"hight\":300}}]", "/views/0/size/hight", "unknown key",
            "height");
        row("/views=[{\"view\":\"stage\",\"size\":{\"height\":10}}]", "/views/0/size/height",
            "must be an integer from 110 to 4000, got 10", "pixels");
        row("/show=3", "/show", "must be an object");
        row("/show={\"tme\":3}", "/show/tme", "unknown key \"tme\"", "time");
        row("/show={\"time\":\"s\"}", "/show/time", "unknown name \"s\"");
        row("/show={\"pinned\":true}", "/show/pinned", "");
        row("/show={\"layout\":\"two-colums\"}", "/show/layout", "unknown layout", "two-columns");
        row("/views=[{\"view\":\"energy\",\"curve\":3}]", "/views/0/curve", "must be a text in quotes");
        row("/views=[{\"view\":\"energy\",\"curve\":\"sin(t\"}]", "/views/0/curve", "    sin(t\n       ^");
        row("/views=[{\"view\":\"energy\",\"curve\":\"mu*sin(s)\"}]", "/views/0/curve",
            "unknown name \"s\"\n    mu*sin(s)\n           ^");
        row("/views=[{\"view\":\"phase\",\"curve\":\"t\"}]", "/views/0/curve",
            "is for plots against time or a place", "\"x\": \"t\"");
        row("/views=[{\"view\":\"trajectory\",\"curve\":\"t\"}]", "/views/0/curve",
            "is for plots against time or a place");
        row("/views=[{\"view\":\"stage\",\"curve\":\"t\"}]", "/views/0/curve",
            "is for plots against time or a place");
        row("/views=[{\"view\":\"energy\",\"node\":1}]", "/views/0/node",
            "is only for the view shape-function");
        row("/views=[{\"view\":\"shape-function\",\"node\":1.5}]", "/views/0/node",
            "must be an integer from 1");
        row("/output/every=0", "/output/every", "must be a positive finite number");
        row("/output/every=1e-12", "/output/every", "asks for 3e+12 rows");
        row("/output/dense=true", "/output/dense", "needs an interval");
        row("/reference=exakt", "/reference", "unknown reference \"exakt\"", "exact");
        row("/reference={\"type\":\"file\",\"path\":\"nowhere.csv\"}", "/reference/path", "cannot be read");
        row("/limits/steps=0", "/limits/steps", "must be a finite number from 1");
        row("/tittle=a", "/tittle", "unknown key \"tittle\"", "title");
        row("/schemes/5/step=1", "/schemes/5/step", "there is no element \"5\": /schemes has 2, 0 to 1");
        row("/time/end/x=1", "/time/end/x", "there is no \"x\": /time/end is 3");
    }
    void everyMistakeIsNamedWhereItStands() {
        QFETCH(QString, set);
        QFETCH(QString, pointer);
        QFETCH(QString, message);
        QFETCH(QString, hint);
        const ReadScene read = readScene(good, {parseOverride(set.toStdString())});
        // What is merely not used is a warning.
        std::vector<Problem> found = read.errors;
        found.insert(found.end(), read.warnings.begin(), read.warnings.end());
        QVERIFY2(!found.empty(), "nothing was found");
        QVERIFY2(std::any_of(found.begin(), found.end(),
                             [&](const Problem& p) {
                                 return QString::fromStdString(p.pointer) == pointer &&
                                        QString::fromStdString(p.message).contains(message) &&
                                        QString::fromStdString(p.hint).contains(hint);
                             }),
                 textOf(found).c_str());
        if (!pointer.startsWith(set.left(set.indexOf('=')))) return;
        QVERIFY2(std::all_of(found.begin(), found.end(), [](const Problem& p) { return !p.origin.empty(); }),
                 "the override is the place of the error");
    }

    void badTextIsAnErrorWithItsPlace_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("message");
        QTest::newRow("empty") << QByteArray("") << "is empty";
        QTest::newRow("blank") << QByteArray(" \n") << "is empty";
        QTest::newRow("cut off") << QByteArray("{\"a\": [1,\n2") << "at line 2, column 2";
        QTest::newRow("comma") << QByteArray("{\"a\": 1,}") << "at line 1, column 9";
        QTest::newRow("trailing") << QByteArray("{} {}") << "is not JSON: value";
        QTest::newRow("comment") << QByteArray("{} // x") << "is not JSON";
        QTest::newRow("twice") << QByteArray("{\"a\": {\"b\": 1, \"b\": 2}}")
                               << "the key \"b\" appears twice";
        QTest::newRow("overflow") << QByteArray("{\"a\": [1e999]}") << "1e999 is too large";
        QTest::newRow("NaN") << QByteArray("{\"a\": NaN}") << "is not JSON";
        QTest::newRow("not UTF-8") << QByteArray("{\"a\": \"\xff\"}")
                                   << "is not UTF-8 text: bad byte at line 1, column 8";
        QTest::newRow("zero byte") << QByteArray("{}\0garbage", 10)
                                   << "is not UTF-8 text: bad byte at line 1, column 3";
        QTest::newRow("no object") << QByteArray("[1]") << "must be an object";
        QTest::newRow("a million brackets") << QByteArray(1000000, '[') << "nested deeper than 200";
        QTest::newRow("a million braces")
            << QByteArray("{\"a\":").repeated(200000) << "nested deeper than 200";
    }
    void badTextIsAnErrorWithItsPlace() {
        QFETCH(QByteArray, text);
        QFETCH(QString, message);
        const Problem error = firstError(readScene(text.toStdString()));
        QVERIFY2(QString::fromStdString(error.message).contains(message), error.message.c_str());
    }

    void pointersOfDuplicatesAndOverflowsAreKnown() {
        QCOMPARE(firstError(readScene(std::string("{\"a\": [0, {\"b/c\": 1, \"b/c\": 2}]}"))).pointer,
                 std::string("/a/1/b~1c"));
        QCOMPARE(firstError(readScene(std::string("{\"a\": [0, 1e999]}"))).pointer, std::string("/a/1"));
    }

    void allErrorsAreReported() {
        const ReadScene read =
            readScene(good, {parseOverride("/schemes/*/step=-1"), parseOverride("/model/mu=0"),
                             parseOverride("/modle/mu=0"), parseOverride("/time/end=x")});
        QCOMPARE(read.errors.size(), std::size_t{5});
        QCOMPARE(read.errors[0].origin, std::string("/modle/mu"));
        QCOMPARE(std::count_if(read.errors.begin(), read.errors.end(),
                               [](const Problem& p) { return p.origin == "/schemes/*/step"; }),
                 2);
    }

    void overridesApplyFromLeftToRight() {
        const ReadScene read =
            readScene(good, {parseOverride("/title=a = b"),
                             parseOverride("/schemes/-={\"baseline\":\"rk4\",\"step\":1}"),
                             parseOverride("/schemes/*/step=0.25"), parseOverride("/schemes/2/step=mu/8"),
                             parseOverride("/model/mu=2"), parseOverride("/output/every=0.5"),
                             parseOverride("/schemes/0/solver/method=newton")});
        QVERIFY2(read.errors.empty(), textOf(read.errors).c_str());
        QCOMPARE(read.scene.title, std::string("a = b"));
        QCOMPARE(read.scene.schemes.size(), std::size_t{3});
        QCOMPARE(read.scene.schemes[1].step.value, 0.25);
        QCOMPARE(read.scene.schemes[2].step.value,
                 0.25);  // 2/8: expressions see the parameters after all overrides
        QCOMPARE(read.scene.schemes[2].step.expression, std::string("mu/8"));
        QCOMPARE(read.scene.every->value, 0.5);
        QVERIFY_EXCEPTION_THROWN(parseOverride("no pointer=1"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN(parseOverride("/a"), InvalidScene);
    }

    void defaultsAreFilledIn() {
        const ReadScene read =
            readScene(good, {parseOverride("/schemes/-={\"space\":{\"type\":\"polynomial\",\"degree\":3},"
                                           "\"quadrature\":\"lobatto\",\"step\":0.1}"),
                             parseOverride("/schemes/-={\"space\":{\"type\":\"polynomial\",\"degree\":3},"
                                           "\"step\":0.1}")});
        QVERIFY2(read.errors.empty(), textOf(read.errors).c_str());
        const auto& schemes = read.scene.schemes;
        QCOMPARE(schemes[0].quadrature.integer("nodes"), 2);
        QCOMPARE(schemes[0].space.text("basis"), std::string("lobatto"));
        QCOMPARE(schemes[0].label, std::string("polynomial 2, gauss 2"));
        QCOMPARE(schemes[2].quadrature.integer("nodes"), 4);
        QCOMPARE(schemes[3].quadrature.type, std::string("gauss"));
        QCOMPARE(schemes[3].quadrature.integer("nodes"), 3);
        QCOMPARE(read.scene.observe, (std::vector<std::string>{"energy", "error"}));
        QVERIFY(read.warnings.empty());
    }

    void parametersMayUseEachOther() {
        const std::string text =
            R"({"extremal":1,"model":{"type":"spring-pendulum","k":"m*100","m":"l+1","l":1},
            "initial":{"q":{"theta":"pi/4","a":"1/k"},"v":[0,1]},"time":{"end":1},"schemes":[{"scheme":"midpoint","step":"1/k"}]})";
        const ReadScene read = readScene(text);
        QVERIFY2(read.errors.empty(), textOf(read.errors).c_str());
        QCOMPARE(read.scene.model.number("k"), 200.0);
        QCOMPARE(read.scene.initial.q[0].value, 0.005);
        QCOMPARE(read.scene.schemes[0].step.value, 0.005);
        const ReadScene cycle = readScene(text, {parseOverride("/model/l=k")});
        QCOMPARE(cycle.errors.size(), std::size_t{1});
        QVERIFY(firstError(cycle).message.find("depends on itself: ") == 0);
    }

    void savingLoadingAndSavingGivesTheSameBytes() {
        std::vector<std::string> texts{good};
        for (const Preset& preset : presets()) texts.emplace_back(preset.json);
        for (const std::string& text : texts) {
            const ReadScene first = readScene(text);
            QVERIFY2(first.errors.empty(), textOf(first.errors).c_str());
            const std::string saved = writeScene(first.scene);
            const ReadScene second = readScene(saved);
            QVERIFY2(second.errors.empty(), textOf(second.errors).c_str());
            QVERIFY(second.scene == first.scene);
            QCOMPARE(writeScene(second.scene), saved);
        }
    }

    void thePartAndTheCurveOfAViewAreKeptAsTheyWereWritten() {
        const std::string views =
            R"(/views=[{"view":"trajectory","y":"q.y","range":{"x":[1,"1+mu"]},"curve":"mu*cos(t)+pi"},
                                    {"view":"error","range":{"y":["mu/1e6",1]},"curve":"1e-6*t^2"},"phase"])";
        const ReadScene first = readScene(good, {parseOverride(views), parseOverride("/model/mu=2"),
                                                 parseOverride("/views/0/range/y=[0,\"mu^3\"]")});
        QVERIFY2(first.errors.empty(), textOf(first.errors).c_str());
        const View &a = first.scene.views[0], &b = first.scene.views[1];
        QCOMPARE(a.xRange->high.value, 3.0);
        QCOMPARE(a.xRange->high.expression, std::string("1+mu"));
        QCOMPARE(a.yRange->high.value, 8.0);
        QVERIFY(!b.xRange && b.yRange->low.value == 2e-6);
        QVERIFY((a.curve == ViewCurve{"mu*cos(t)+pi", {{"mu", 2.0}}}) && b.curve.values.empty());
        const std::string saved = writeScene(first.scene);
        QVERIFY(saved.find("\"mu^3\"") != std::string::npos &&
                saved.find("\"mu*cos(t)+pi\"") != std::string::npos);
        QVERIFY(readScene(saved).scene == first.scene);
    }

    void howTheWindowShowsASceneIsKept() {
        const ReadScene first =
            readScene(good, {parseOverride(R"(/views=[{"view":"stage","size":{"width":700,"height":420}},
                       {"view":"energy","log":false,"range":{"y":[-1,1]},"size":{"height":300}},"phase"])"),
                             parseOverride("/show/time=mu/2"), parseOverride("/show/pinned=0.25"),
                             parseOverride("/show/layout=plots-only")});
        QVERIFY2(first.errors.empty(), textOf(first.errors).c_str());
        const std::vector<View>& views = first.scene.views;
        QVERIFY((views[0].size == CardSize{700, 420} && views[1].size == CardSize{0, 300}));
        QVERIFY(views[1].isLog == std::optional(false) && !views[2].isLog && views[2].size == CardSize());
        QCOMPARE(first.scene.shown.time->expression, std::string("mu/2"));
        QCOMPARE(first.scene.shown.pinned->value, 0.25);
        QVERIFY(first.scene.shown.layout == PageLayout::plotsOnly);
        const std::string saved = writeScene(first.scene);
        QVERIFY(readScene(saved).scene == first.scene);
        QCOMPARE(writeScene(readScene(saved).scene), saved);
    }

    void aCursorBesideTheIntervalIsWarnedOf() {
        const auto warnings = [](const char* time) {
            const ReadScene read = readScene(good, {parseOverride(std::string("/show/time=") + time)});
            return read.errors.empty()
                       ? std::count_if(read.warnings.begin(), read.warnings.end(),
                                       [](const Problem& p) { return p.pointer == "/show/time"; })
                       : -1;
        };
        QCOMPARE(warnings("0"), 0);
        QCOMPARE(warnings("1e6"), 1);
        QCOMPARE(warnings("-1"), 1);
    }

    void aNodeIsOneOfTheNodesInside() {
        const std::string text =
            R"({"extremal":1,"model":{"type":"multiscale-elliptic","elements":10},"schemes":[
            {"scheme":"elliptic-multiscale"},{"scheme":"elliptic-linear","step":0.2}],"views":[{"view":"shape-function","node":4}]})";
        const ReadScene read = readScene(text);
        QVERIFY2(read.errors.empty(), textOf(read.errors).c_str());
        QCOMPARE(read.scene.views[0].node->value, 4.0);
        QCOMPARE(read.scene.observe, std::vector<std::string>{"error"});  // it has no energy
        QVERIFY(readScene(writeScene(read.scene)).scene == read.scene);
        for (const char* node : {"0", "5", "-1"}) {
            const Problem error =
                firstError(readScene(text, {parseOverride(std::string("/views/0/node=") + node)}));
            QCOMPARE(error.pointer, std::string("/views/0/node"));
            QVERIFY2(error.message.find("must be an integer from 1 to 4") != std::string::npos,
                     error.message.c_str());
        }
    }

    void theNumberOfElementsGivesTheStep() {
        const std::string text =
            R"({"extremal":1,"model":{"type":"multiscale-elliptic","elements":10},"schemes":[
            {"scheme":"elliptic-multiscale"},{"space":{"type":"elliptic-elements","elements":5},"quadrature":"auto"}]})";
        const auto steps = [](const ReadScene& read) {
            return std::pair{read.scene.schemes.at(0).step.value, read.scene.schemes.at(1).step.value};
        };
        const ReadScene read = readScene(text);
        QVERIFY2(read.errors.empty() && read.warnings.empty(), textOf(read.errors).c_str());
        QCOMPARE(steps(read), (std::pair{0.1, 0.2}));
        // What was saved still follows the model and the space.
        const std::string saved = writeScene(read.scene);
        QCOMPARE(steps(readScene(saved, {parseOverride("/model/elements=20")})), (std::pair{0.05, 0.2}));
        const ReadScene changed = readScene(saved, {parseOverride("/schemes/1/space/elements=8")});
        QCOMPARE(steps(changed), (std::pair{0.1, 0.125}));
        QVERIFY(changed.warnings.size() == 1 && changed.warnings[0].pointer == "/schemes/1/step");
        QVERIFY(readScene(writeScene(changed.scene)).warnings.empty());
    }

    void jsonTextIsByteStable() {
        for (const char* text :
             {"[-0.0, 0, 1e-300, 5e-324, 0.1, 123456789012345680, -1.7976931348623157e308]",
              "{ \"a\\\"\\\\\\n\\u0001/\u00e9\": [[1, 2], { \"b\": null }], \"c\": {}, \"d\": [], \"e\": "
              "true }"}) {
            const Value value = parseJson(text);
            const std::string written = writeJson(value);
            QVERIFY(parseJson(written) == value);
            QCOMPARE(writeJson(parseJson(written)), written);
        }
        QVERIFY(std::signbit(parseJson(writeJson(parseJson("-0.0"))).asNumber()));
    }

    void thePresetsTellWhatTheyTeach() {
        QVERIFY(presets().size() >= 9);
        for (const char* id :
             {"spring-pendulum", "spring-pendulum-stiff", "harmonic-oscillator", "pendulum", "kepler"})
            QVERIFY2(findPreset(id), id);
        for (const Preset& preset : presets()) {
            const Scene scene = readScene(preset.json).scene;
            QVERIFY2(!scene.title.empty() && !scene.source.empty() && !scene.lesson.empty() &&
                         !scene.notes.empty(),
                     std::string(preset.id).c_str());
            QVERIFY(codePoints(scene.lesson) <= 120);
        }
    }

    void theSchemaFileMatchesTheCatalogues() {
        const QString path = QStringLiteral(EXTREMAL_SOURCE_DIR "/presets/scene.schema.json");
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const std::string expected = writeJson(sceneSchema());
        if (file.readAll().toStdString() == expected) return;
        QDir().mkpath(QStringLiteral(EXTREMAL_TEST_OUTPUT));
        QFile actual(QStringLiteral(EXTREMAL_TEST_OUTPUT "/scene.schema.json"));
        QVERIFY(actual.open(QIODevice::WriteOnly));
        actual.write(expected.c_str());
        QFAIL(qPrintable("presets/scene.schema.json is out of date: copy " + actual.fileName()));
    }
};

EXTREMAL_TEST(CodecTest)
}  // namespace extremal::codec_test

#include "codec_test.moc"
