// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON pointers: RFC 6901, sections 3 and 4.
#include <QTest>

#include "engine/scene/read/pointer.hpp"
#include "tests/tools/test.hpp"

namespace extremal::pointer_test {

class PointerTest : public QObject {
    Q_OBJECT
private slots:
    void tokensAreEscaped() {
        QCOMPARE(childPointer("/a", "b/c~d"), std::string("/a/b~1c~0d"));
        QCOMPARE(childPointer("", "~1"), std::string("/~01"));
        QCOMPARE(childPointer("/schemes", std::size_t{3}), std::string("/schemes/3"));
    }
    void splittingUndoesIt() {
        QCOMPARE(*splitPointer("/a/b~1c~0d/~01"), (std::vector<std::string>{"a", "b/c~d", "~1"}));
        QVERIFY(splitPointer("")->empty());
        QVERIFY(!splitPointer("a"));
    }
    void anIndexIsDigits() {
        QCOMPARE(*arrayIndex("10"), std::size_t{10});
        QVERIFY(!arrayIndex("01") && !arrayIndex("-1") && !arrayIndex("") && !arrayIndex("1e1"));
    }
};

EXTREMAL_TEST(PointerTest)

}  // namespace extremal::pointer_test

#include "pointer_test.moc"
