// SPDX-License-Identifier: GPL-3.0-or-later
/// Work is asked to stop once it has used its processor time, and at the request of others.
#include "engine/core/processor_watch.hpp"

#include <QTest>

#include <chrono>
#include <cmath>

#include "engine/core/thread_clock.hpp"
#include "tests/tools/test.hpp"

namespace extremal::processor_watch_test {
namespace {

constexpr double tooLong = 30;  ///< seconds: without a request to stop the test ends all the same

/// Works until it is asked to stop.
double workUntil(const std::stop_token& stop) {
    const double begin = threadSeconds();
    while (!stop.stop_requested() && threadSeconds() - begin < tooLong) {
    }
    return threadSeconds() - begin;
}

}  // namespace

class ProcessorWatchTest : public QObject {
    Q_OBJECT
private slots:
    void aLimitEndsTheWork() {
        ProcessorWatch watch;
        for (const double limit : {0.0, 0.01, 0.05}) {
            double used = 0;
            QVERIFY(watch.run(limit, {}, [&](const std::stop_token& stop) { used = workUntil(stop); }));
            QVERIFY(used >= 0.99 * limit && used < tooLong);
        }
    }
    /// Waiting is no work.
    void onlyItsOwnTimeCounts() {
        ProcessorWatch watch;
        QVERIFY(!watch.run(0.05, {}, [](const std::stop_token&) {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }));
        bool isStopped = true;
        QVERIFY(!watch.run(INFINITY, {},
                           [&](const std::stop_token& stop) { isStopped = stop.stop_requested(); }));
        QVERIFY(!isStopped);
    }
    void whatIsDoneInAPauseIsNotCounted() {
        ProcessorWatch watch;
        double after = 0;
        QVERIFY(watch.run(0.03, {}, [&](const std::stop_token& stop) {
            {
                const ProcessorWatch::Pause pause(&watch);
                const double begin = threadSeconds();
                while (threadSeconds() - begin < 0.1) {
                }
                QVERIFY(!stop.stop_requested());
            }
            after = workUntil(stop);
        }));
        QVERIFY(after > 0.02 && after < tooLong);
        const ProcessorWatch::Pause nothing(nullptr);
    }
    void othersMayEndItAsWell() {
        ProcessorWatch watch;
        std::stop_source outer;
        QVERIFY(!watch.run(20, outer.get_token(), [&](const std::stop_token& stop) {
            QVERIFY(!stop.stop_requested());
            outer.request_stop();
            QVERIFY(stop.stop_requested());
        }));
    }
};

EXTREMAL_TEST(ProcessorWatchTest)
}  // namespace extremal::processor_watch_test

#include "processor_watch_test.moc"
