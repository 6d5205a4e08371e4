// SPDX-License-Identifier: GPL-3.0-or-later
/// The cursor stays where something has been computed.
#include <QTest>

#include "tests/tools/test.hpp"
#include "ui/workspace/playback.hpp"

namespace extremal::playback_test {

class PlaybackTest : public QObject {
    Q_OBJECT
private slots:
    void theCursorStaysWithinWhatIsComputed() {
        Playback playback;
        playback.setRange(0, 10);
        playback.setComputedEnd(4);
        playback.setTime(7);
        QCOMPARE(playback.time(), 4.0);
        playback.setTime(-1);
        QCOMPARE(playback.time(), 0.0);
        playback.setComputedEnd(12);
        QCOMPARE(playback.computedEnd(), 10.0);
    }
    void atTheEndItFollowsTheComputation() {
        Playback playback;
        playback.setRange(0, 10);
        playback.setComputedEnd(4);
        QCOMPARE(playback.time(), 4.0);
        playback.setTime(2);
        playback.setComputedEnd(5);
        QCOMPARE(playback.time(), 2.0);
        playback.setTime(5);
        playback.setComputedEnd(6);
        QCOMPARE(playback.time(), 6.0);
    }
    void itStopsAtATimeThatIsStillToCome() {
        Playback playback;
        playback.setRange(0, 10);
        playback.stopAt(5);
        playback.setComputedEnd(4);
        QCOMPARE(playback.time(), 4.0);
        playback.setComputedEnd(8);
        QCOMPARE(playback.time(), 5.0);
        playback.setComputedEnd(10);
        QCOMPARE(playback.time(), 5.0);
        playback.setPlaying(true);
        playback.stopAt(3);
        QVERIFY(!playback.isPlaying());
        QCOMPARE(playback.time(), 3.0);
        playback.stopAt(20);  // beyond the end
        QCOMPARE(playback.time(), 10.0);
    }
    void aCursorThatIsMovedStays() {
        Playback playback;
        playback.setRange(0, 10);
        playback.setComputedEnd(2);
        playback.stopAt(5);
        playback.setTime(1);
        playback.setComputedEnd(8);
        QCOMPARE(playback.time(), 1.0);
    }
};

EXTREMAL_TEST(PlaybackTest)

}  // namespace extremal::playback_test

#include "playback_test.moc"
