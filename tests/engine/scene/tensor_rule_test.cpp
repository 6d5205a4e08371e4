// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules made of rules: read, completed, checked at their places, written back, and refused where one rule is
/// needed.
#include <QTest>

#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/overrides.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/space/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tensor_rule_test {

namespace {

const Settings quadratic{"polynomial", {{"degree", 2.0}}, {}};

std::optional<Settings> ruleOf(Reader& reader, const char* json, const Settings& space = quadratic) {
    const Value value = parseJson(json);
    return readRule(reader, &value, "/quadrature", space);
}

Problem onlyErrorOf(const char* json) {
    Reader reader;
    const auto rule = ruleOf(reader, json);
    return rule || reader.errors.size() != 1 ? Problem{} : reader.errors[0];
}

}  // namespace

class TensorRuleTest : public QObject {
    Q_OBJECT
private slots:
    void partsAreCompletedByTheDegree() {
        Reader reader;
        const auto rule = ruleOf(reader, R"({"space":"lobatto","time":{"type":"radau","end":"left"}})");
        QVERIFY(rule && reader.errors.empty());
        QVERIFY(isTensorRule(*rule));
        QCOMPARE(tensorPart(*rule, "space"), (Settings{"lobatto", {{"nodes", 3.0}, {"panels", 1.0}}, {}}));
        QCOMPARE(tensorPart(*rule, "time"),
                 (Settings{"radau", {{"nodes", 2.0}, {"end", "left"}, {"panels", 1.0}}, {}}));
        QCOMPARE(tensorPart(*rule, "nowhere").type, std::string());
    }
    void degreesOfBothDirectionsAreTheirOwn() {
        Reader reader;
        const Settings tents{"tent", {{"degree", parseJson(R"({"space":1,"time":3})")}}, {}};
        const auto rule = ruleOf(reader, R"({"space":"auto","time":"auto"})", tents);
        QVERIFY(rule);
        QCOMPARE(tensorPart(*rule, "space").integer("nodes"), 1);
        QCOMPARE(tensorPart(*rule, "time").integer("nodes"), 3);
    }
    void readingWhatWasWrittenGivesTheSame() {
        for (const char* json :
             {R"({"space":"gauss","time":"lobatto"})",
              R"({"type":"product","space":{"type":"gauss","nodes":"1+n"},"time":"midpoint"})"}) {
            Reader reader;
            reader.parameters["n"] = 2;
            const auto rule = ruleOf(reader, json);
            QVERIFY(rule);
            const Value written = ruleValue(*rule);
            QVERIFY(!written.find("type"));
            const auto again = readRule(reader, &written, "/quadrature", quadratic);
            QVERIFY(again);
            QCOMPARE(*again, *rule);
            QCOMPARE(ruleValue(*again), written);
        }
        Reader reader;
        reader.parameters["n"] = 2;
        const auto rule = ruleOf(reader, R"({"space":{"type":"gauss","nodes":"1+n"},"time":"gauss"})");
        QVERIFY(rule);
        QCOMPARE(tensorPart(*rule, "space").integer("nodes"), 3);
        QCOMPARE(*ruleValue(*rule).find("space")->find("nodes"), Value("1+n"));
    }
    void errorsNameTheirPlace() {
        QCOMPARE(onlyErrorOf(R"({"space":"gauss"})").pointer, std::string("/quadrature/time"));
        QCOMPARE(onlyErrorOf(R"({"space":"gauss","time":{"type":"gauss","nodes":0}})").pointer,
                 std::string("/quadrature/time/nodes"));
        QCOMPARE(onlyErrorOf(R"({"space":{"type":"gaus"},"time":"gauss"})").pointer,
                 std::string("/quadrature/space/type"));
        QCOMPARE(onlyErrorOf(R"({"space":"gauss","time":"gauss","tim":"gauss"})").pointer,
                 std::string("/quadrature/tim"));
        QVERIFY(!onlyErrorOf(R"({"space":"gauss","time":{"space":"gauss","time":"gauss"}})").message.empty());
    }
    void partsCanBeSetByOverrides() {
        Value document =
            parseJson(R"({"schemes":[{"quadrature":{"space":{"type":"gauss"},"time":"gauss"}}]})");
        std::vector<Change> changes;
        std::vector<Problem> errors;
        applyOverride(document, {"/schemes/0/quadrature/space/nodes", 4}, changes, errors);
        QVERIFY(errors.empty());
        applyOverride(document, {"/schemes/0/quadrature/space/node", 4}, changes, errors);
        QCOMPARE(errors.size(), std::size_t{1});
        applyOverride(document, {"/schemes/0/quadrature/tim", "gauss"}, changes, errors);
        QCOMPARE(errors.size(), std::size_t{2});
        QCOMPARE(document.find("schemes")
                     ->asArray()[0]
                     .find("quadrature")
                     ->find("space")
                     ->find("nodes")
                     ->asNumber(),
                 4.0);
    }
    /// Another rule along y is for rectangles.
    void rulesAlongYAreForRectangles() {
        const auto read = [](const char* model, const char* rule) {
            return readScene(R"J({"extremal":1,"model":{"type":")J" + std::string(model) +
                             R"J(","cells":8},"time":{"end":1},"initial":{"u":"1"},"schemes":)J" +
                             R"J([{"step":0.1,"space":"tent","quadrature":)J" + rule + "}]}");
        };
        const char* const both =
            R"({"space":"trapezoid","space_y":{"type":"gauss","nodes":2},"time":"gauss"})";
        const auto plane = read("field-2d", both);
        QVERIFY2(plane.errors.empty(), plane.errors.empty() ? "" : plane.errors[0].message.c_str());
        const Settings& rule = plane.scene.schemes[0].quadrature;
        QCOMPARE(tensorPartsOf(rule).size(), std::size_t{3});
        QCOMPARE(tensorPart(rule, acrossPart).integer("nodes"), 2);
        QVERIFY(ruleValue(rule).find("space_y"));
        const auto line = read("field", both);
        QCOMPARE(line.errors.size(), std::size_t{1});
        QVERIFY2(line.errors[0].message.find("along y") != std::string::npos, line.errors[0].message.c_str());
        const auto unseen = read("field-2d", R"({"space":"gauss","space_y":"midpoint","time":"gauss"})");
        QCOMPARE(unseen.errors.size(), std::size_t{1});
        const auto missing = read("field-2d", R"({"space_y":"gauss","time":"gauss"})");
        QCOMPARE(missing.errors.size(), std::size_t{1});
        QCOMPARE(missing.errors[0].pointer, std::string("/schemes/0/quadrature/space"));
        QCOMPARE(onlyErrorOf(R"({"space":"gauss","space_y":{"type":"gaus"},"time":"gauss"})").pointer,
                 std::string("/quadrature/space_y/type"));
    }
    void rulesThatASpaceLacksAreErrorsOfTheScene() {
        const auto errors = [](const char* form, const char* rule) {
            return readScene(
                       std::string(
                           R"({"extremal":1,"model":{"type":"schrodinger"},"time":{"end":1},"schemes":)") +
                       R"([{"step":0.1,"space":{"type":"fourier","degree":1,"form":")" + form +
                       R"("},"quadrature":")" + rule + R"("}]})")
                .errors;
        };
        for (const char* form : {"one-step", "three-level"})
            for (const char* rule : {"filon-gauss", "filon-lobatto"})
                QCOMPARE(errors(form, rule).size(), std::size_t{1});
        QCOMPARE(errors("one-step", "exact").size(), std::size_t{1});
    }
    void spacesOfTimeAloneRefuseThem_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("space");
        const auto row = [](const char* model, const char* space) { QTest::newRow(space) << model << space; };
        row(R"({"type":"pendulum"})", R"({"type":"polynomial","degree":2})");
        row(R"({"type":"pendulum"})", R"({"type":"spline","degree":2})");
        row(R"({"type":"spring-pendulum"})", R"({"type":"oscillatory","degree":2})");
        row(R"({"type":"rigid-body"})", R"({"type":"lie-polynomial","degree":2})");
        row(R"({"type":"schrodinger"})", R"({"type":"fourier","degree":2})");
        row(R"({"type":"multiscale-elliptic"})", R"({"type":"elliptic-elements","elements":5})");
    }
    void spacesOfTimeAloneRefuseThem() {
        QFETCH(QString, model);
        QFETCH(QString, space);
        const std::string scene = R"({"extremal":1,"model":)" + model.toStdString() +
                                  R"(,"time":{"end":1},"schemes":[{"step":0.1,"space":)" +
                                  space.toStdString() +
                                  R"(,"quadrature":{"space":"gauss","time":"gauss"}}]})";
        const auto read = readScene(scene);
        QVERIFY2(!read.errors.empty(), qPrintable(space));
        QCOMPARE(read.errors[0].pointer, std::string("/schemes/0"));
        QVERIFY2(read.errors[0].message.find("tensor product") != std::string::npos,
                 read.errors[0].message.c_str());
        QVERIFY(!read.errors[0].hint.empty());
    }
};

EXTREMAL_TEST(TensorRuleTest)
}  // namespace extremal::tensor_rule_test

#include "tensor_rule_test.moc"
