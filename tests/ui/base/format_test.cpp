// SPDX-License-Identifier: GPL-3.0-or-later
/// What is typed into fields of lists: separators within brackets belong to the entries.
#include <QTest>

#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/format.hpp"

namespace extremal::format_test {

class FormatTest : public QObject {
    Q_OBJECT private slots : void separatorsInBracketsDoNotSeparate() {
        const auto formulas = [](const char* text) { return formulasFrom(text); };
        QVERIFY(formulas("1; tau; atan2(tau, 2)") == parseJson(R"~([1,"tau","atan2(tau, 2)"])~"));
        QVERIFY(formulas("1; table(tau; 0, 0; 1, 2)*3; sin((1; 2)); 4") ==
                parseJson(R"~([1,"table(tau; 0, 0; 1, 2)*3","sin((1; 2))",4])~"));
        QVERIFY(definitionsFrom("z = if(h == 1, 2, 3); x = spline(h; 0, 1; 2, 3)") ==
                parseJson(R"~({"z":"if(h == 1, 2, 3)","x":"spline(h; 0, 1; 2, 3)"})~"));
        QVERIFY(numbersOrExpressions("1, max(k, 2), 0.5") == parseJson(R"~([1,"max(k, 2)",0.5])~"));
        QVERIFY(constantsFrom("a = 1, b = min(1, 2)") == parseJson(R"~({"a":1,"b":"min(1, 2)"})~"));
        // What is not closed is an entry still.
        QVERIFY(formulas("sin(1; 2") == parseJson(R"~(["sin(1; 2"])~"));
        QVERIFY(formulas("1); 2") == parseJson(R"~(["1)",2])~"));
    }
    /// Degrees and rules of both directions, under the name of a scheme.
    void tensorElementsSayTheirDegreesAndRules() {
        const auto text = [](const std::string& scheme) {
            const ReadScene read = readScene(
                R"J({"extremal":1,"model":{"type":"field"},"initial":{"u":"exp(-x^2)"},"time":{"end":1},"schemes":[{"step":0.01,)J" +
                scheme + "}]}");
            return schemeText(read.resolved->scene.schemes[0]);
        };
        QCOMPARE(
            text(
                R"("space":{"type":"tent","degree":{"space":2,"time":1}},"quadrature":{"space":{"type":"gauss","nodes":3},"time":"trapezoid"})"),
            ruleTitle("gauss").prepend("tent 2, 1 × ") + " 3, " + ruleTitle("trapezoid"));
        QCOMPARE(text(R"("space":{"type":"tent","degree":{"time":1,"space":2}})").left(9),
                 QString("tent 2, 1"));
        QCOMPARE(text(R"("space":{"type":"tent","degree":2})"),
                 QString("tent 2 × %1 3, %1 2").arg(ruleTitle("gauss")));
    }
};

EXTREMAL_TEST(FormatTest)

}  // namespace extremal::format_test

#include "format_test.moc"
