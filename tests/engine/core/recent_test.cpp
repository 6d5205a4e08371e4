/// The last few things made: made once, forgotten in the order they came, and not kept where making them
/// failed.
#include <QTest>

#include <stdexcept>
#include <string>

#include "engine/core/recent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::recent_test {

class RecentTest : public QObject {
    Q_OBJECT
private slots:
    void isMadeOnceAndForgotten() {
        Recent<std::string, int> recent(2);
        int made = 0;
        const auto get = [&](const char* key) { return recent.get(key, [&] { return ++made; }); };
        QCOMPARE(get("a"), 1);
        QCOMPARE(get("b"), 2);
        QCOMPARE(get("a"), 1);
        QCOMPARE(get("c"), 3);
        QCOMPARE(get("b"), 2);
        QCOMPARE(get("a"), 4);  // the oldest of two went
    }
    void whatFailsIsNotKept() {
        Recent<int, int> recent(2);
        QVERIFY_EXCEPTION_THROWN(recent.get(1, []() -> int { throw std::runtime_error("no"); }),
                                 std::runtime_error);
        QCOMPARE(recent.get(1, [] { return 7; }), 7);
    }
    void sameIsWhatTheCallerSays() {
        Recent<int, int> recent(2);
        const auto lastDigit = [](int a, int b) { return a % 10 == b % 10; };
        QCOMPARE(recent.get(
                     13, [] { return 1; }, lastDigit),
                 1);
        QCOMPARE(recent.get(
                     23, [] { return 2; }, lastDigit),
                 1);
        QCOMPARE(recent.get(
                     24, [] { return 3; }, lastDigit),
                 3);
    }
};

EXTREMAL_TEST(RecentTest)
}  // namespace extremal::recent_test

#include "recent_test.moc"
