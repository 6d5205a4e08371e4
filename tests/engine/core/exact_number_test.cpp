// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers in quadruple precision: every function to all digits, and names refused at their place.
#include <QTest>

#include <boost/math/constants/constants.hpp>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/exact_number.hpp"
#include "tests/tools/test.hpp"

namespace extremal::exact_number_test {

class ExactNumberTest : public QObject {
    Q_OBJECT
private slots:
    void hasAllDigits() {
        const auto isClose = [](const char* text, const Quad& value) {
            return abs(exactNumber(Value(text), "/b", "") - value) <= Quad(1e-33) * abs(value);
        };
        QVERIFY(isClose("1/3", Quad(1) / 3));
        QVERIFY(isClose("(3-sqrt(3))/6", (3 - sqrt(Quad(3))) / 6));
        QVERIFY(isClose("2^(1/3)", cbrt(Quad(2))));
        QVERIFY(isClose("pi", boost::math::constants::pi<Quad>()));
        QVERIFY(isClose("exp(1)", boost::math::constants::e<Quad>()));
        QVERIFY(isClose("tan(pi/8)", sqrt(Quad(2)) - 1));
        QVERIFY(isClose("log(2)", boost::math::constants::ln_two<Quad>()));
        QVERIFY(abs(exactNumber(Value(0.1), "/b", "") - Quad("0.1")) == 0);  // the decimal that was written
    }
    void whatIsWrongHasItsPlace_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("part");
        QTest::newRow("a function's variable") << "1/2+0*tau"
                                               << "unknown name \"tau\"";
        QTest::newRow("any name") << "1/2*x"
                                  << "unknown name \"x\"";
        QTest::newRow("a bracket") << "(1/2"
                                   << "the expression ";
        QTest::newRow("infinite") << "1/0"
                                  << "is not finite: 1/0";
    }
    void whatIsWrongHasItsPlace() {
        QFETCH(QString, text);
        QFETCH(QString, part);
        try {
            (void)exactNumber(Value(text.toStdString()), "/schemes/0/baseline/b/1", "\"1/6\"");
            QFAIL("is taken");
        } catch (const InvalidScene& e) {
            QCOMPARE(e.problems().front().pointer, std::string("/schemes/0/baseline/b/1"));
            const QString message = QString::fromStdString(e.problems().front().message);
            QVERIFY2(message.contains(part), qPrintable(message));
            QVERIFY2(text == "1/0" || (message.contains(text) && message.endsWith('^')), qPrintable(message));
        }
    }
};

EXTREMAL_TEST(ExactNumberTest)
}  // namespace extremal::exact_number_test

#include "exact_number_test.moc"
