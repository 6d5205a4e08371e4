// SPDX-License-Identifier: GPL-3.0-or-later
/// The last few things made: made once, forgotten where they were asked for longest ago, and not kept where
/// making them failed.
#include <QTest>

#include <stdexcept>
#include <string>
#include <thread>

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
        QCOMPARE(get("a"), 1);
        QCOMPARE(get("b"), 4);  // was asked for before a
    }
    void largeValuesMakeRoom() {
        MemoCache<int, std::string> cache(10, 8, [](const std::string& s) { return double(s.size()); });
        int made = 0;
        const auto get = [&](int length) {
            return cache.get(length, [&] { return ++made, std::string(std::size_t(length), 'x'); }).size();
        };
        QCOMPARE(get(3), std::size_t(3));
        QCOMPARE(get(4), std::size_t(4));
        QCOMPARE(get(3), std::size_t(3));
        QCOMPARE(made, 2);
        QCOMPARE(get(5), std::size_t(5));  // 4 goes, and 3 stays
        QCOMPARE(get(3), std::size_t(3));
        QCOMPARE(made, 3);
        QCOMPARE(get(9), std::size_t(9));  // more than all, and the last one all the same
        QCOMPARE(get(9), std::size_t(9));
        QCOMPARE(made, 4);
    }
    void onlyWhatIsWorthKeepingIsKept() {
        MemoCache<int, int> cache(2);
        int made = 0;
        const auto get = [&] {
            return cache.getIf(
                1, [&] { return ++made; }, [](int value) { return value > 1; });
        };
        QCOMPARE(get(), 1);
        QCOMPARE(get(), 2);
        QCOMPARE(get(), 2);
    }
    /// A value that is made from another one, and one that is had while another is being made.
    void makingDoesNotBlock() {
        MemoCache<int, int> cache(4);
        QCOMPARE(cache.get(1, [&] { return cache.get(2, [] { return 2; }) - 1; }), 1);
        int seen = 0;
        cache.get(3, [&] {
            std::thread([&] { seen = cache.get(1, [] { return -1; }); }).join();
            return 3;
        });
        QCOMPARE(seen, 1);
    }
    void countedWorkIsChargedToEveryAccountOnce() {
        CountedCache<int, int> cache(2);
        const auto get = [&] {
            return cache.get(1, "one", [] {
                work::spend(100);
                return 7;
            });
        };
        for (int i = 0; i < 2; ++i) {
            const work::Account account(1e6);
            QCOMPARE(get(), 7);
            QCOMPARE(get(), 7);
            QCOMPARE(account.spent(), 100.0);
        }
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
