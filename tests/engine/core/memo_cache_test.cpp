// SPDX-License-Identifier: GPL-3.0-or-later
/// The last few things made: made once, forgotten in the order they came, and not kept where making them
/// failed.
#include <QTest>

#include <stdexcept>
#include <string>

#include "engine/core/memo_cache.hpp"
#include "tests/tools/test.hpp"

namespace extremal::memo_cache_test {

class MemoCacheTest : public QObject {
    Q_OBJECT
private slots:
    void isMadeOnceAndForgotten() {
        MemoCache<std::string, int> cache(2);
        int made = 0;
        const auto get = [&](const char* key) { return cache.get(key, [&] { return ++made; }); };
        QCOMPARE(get("a"), 1);
        QCOMPARE(get("b"), 2);
        QCOMPARE(get("a"), 1);
        QCOMPARE(get("c"), 3);
        QCOMPARE(get("b"), 2);
        QCOMPARE(get("a"), 4);  // the oldest of two went
    }
    void whatFailsIsNotKept() {
        MemoCache<int, int> cache(2);
        QVERIFY_EXCEPTION_THROWN(cache.get(1, []() -> int { throw std::runtime_error("no"); }),
                                 std::runtime_error);
        QCOMPARE(cache.get(1, [] { return 7; }), 7);
    }
    void sameIsWhatTheCallerSays() {
        MemoCache<int, int> cache(2);
        const auto lastDigit = [](int a, int b) { return a % 10 == b % 10; };
        QCOMPARE(cache.get(
                     13, [] { return 1; }, lastDigit),
                 1);
        QCOMPARE(cache.get(
                     23, [] { return 2; }, lastDigit),
                 1);
        QCOMPARE(cache.get(
                     24, [] { return 3; }, lastDigit),
                 3);
    }
};

EXTREMAL_TEST(MemoCacheTest)
}  // namespace extremal::memo_cache_test

#include "memo_cache_test.moc"
