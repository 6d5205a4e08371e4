/// What is typed into fields of lists: separators within brackets belong to the entries.
#include <QTest>

#include "engine/scene/json.hpp"
#include "tests/tools/test.hpp"
#include "ui/panels/format.hpp"

namespace extremal::format_test {

class FormatTest
    : public QObject{Q_OBJECT private slots : void separatorsInBracketsDoNotSeparate(){
          const auto formulas = [](const char* text) { return writeCompactJson(formulasFrom(text)); };
        QCOMPARE(formulas("1; tau; atan2(tau, 2)"), std::string(R"([1,"tau","atan2(tau, 2)"])"));
        QCOMPARE(formulas("1; table(tau; 0, 0; 1, 2)*3; sin((1; 2)); 4"),
                 std::string(R"([1,"table(tau; 0, 0; 1, 2)*3","sin((1; 2))",4])"));
        QCOMPARE(writeCompactJson(definitionsFrom("z = if(h == 1, 2, 3); x = spline(h; 0, 1; 2, 3)")),
                 std::string(R"({"z":"if(h == 1, 2, 3)","x":"spline(h; 0, 1; 2, 3)"
        })"));
        QCOMPARE(writeCompactJson(numbersOrExpressions("1, max(k, 2), 0.5")),
                 std::string(R"([1,"max(k, 2)",0.5])"));
        QCOMPARE(writeCompactJson(constantsFrom("a = 1, b = min(1, 2)")),
                 std::string(R"({"a":1,"b":"min(1, 2)"
        })"));
        // What is not closed is an entry still.
        QCOMPARE(formulas("sin(1; 2"), std::string(R"(["sin(1; 2"])"));
        QCOMPARE(formulas("1); 2"), std::string(R"(["1)",2])"));
        }
        }
        ;

        EXTREMAL_TEST(FormatTest)

        }  // namespace extremal::format_test

#include "format_test.moc"
