// SPDX-License-Identifier: GPL-3.0-or-later
/// What is written as JSON reads back as the same value, to the sign of zero and every control character.
#include <QTest>

#include <cmath>
#include <string>

#include "engine/scene/read/json.hpp"
#include "tests/tools/test.hpp"

namespace extremal::json_test {

class JsonTest : public QObject {
    Q_OBJECT
private slots:
    void everyAsciiCharacterReadsBack() {
        std::string all;
        for (char c = 1; c > 0 && c < 0x7f; ++c) all += c;
        all += '\x7f';
        for (const std::string& text : {writeJson(Value(all)), writeCompactJson(Value(all))}) {
            QCOMPARE(parseJson(text).asString(), all);
            for (const char c : text)
                QVERIFY(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f));
        }
    }
    void zeroKeepsItsSign() {
        QVERIFY(std::signbit(parseJson(writeCompactJson(Value(-0.0))).asNumber()));
        QVERIFY(!std::signbit(parseJson(writeCompactJson(Value(0.0))).asNumber()));
    }
};

EXTREMAL_TEST(JsonTest)

}  // namespace extremal::json_test

#include "json_test.moc"
