// SPDX-License-Identifier: GPL-3.0-or-later
/// Undo and redo: where they lead, what ends them, and which edits merge.
#include <QTest>

#include "tests/tools/test.hpp"
#include "ui/workspace/history.hpp"

namespace extremal::history_test {
namespace {

EditState state(double number) { return {Value(number), {{"/step", Value("typed")}}}; }

}  // namespace

class HistoryTest : public QObject {
    Q_OBJECT
private slots:
    void undoAndRedoLeadBackAndForth() {
        History history;
        history.push(state(1), "first", {});
        history.push(state(2), "second", {});
        QCOMPARE(history.undoText(), QString("second"));
        QVERIFY(history.undo(state(3)) == state(2));
        QCOMPARE(history.redoText(), QString("second"));
        QVERIFY(history.undo(state(2)) == state(1));
        QVERIFY(!history.canUndo() && history.canRedo());
        QVERIFY(history.redo(state(1)) == state(2));
        QVERIFY(history.redo(state(2)) == state(3));
        QVERIFY(history.canUndo() && !history.canRedo());
    }
    void anEditEndsWhatCouldBeDoneAgain() {
        History history;
        history.push(state(1), "first", {});
        history.undo(state(2));
        QVERIFY(history.canRedo());
        history.push(state(1), "another", {});
        QVERIFY(!history.canRedo());
        QVERIFY(history.undo(state(4)) == state(1));
    }
    /// Within a second; a machine that stands still between two of them is given another chance.
    void editsOfOnePlaceInQuickSuccessionMerge() {
        const auto entriesOf = [](const QString& second) {
            History history;
            history.push(state(1), "slider", "/step");
            history.push(state(2), "slider", second);
            int entries = 0;
            for (EditState now = state(3); history.canUndo(); ++entries) now = history.undo(now);
            return entries;
        };
        int merged = 0;
        for (int attempt = 0; attempt < 10; ++attempt) merged += entriesOf("/step") == 1;
        QVERIFY(merged > 0);
        QCOMPARE(entriesOf("/time/end"), 2);
        QCOMPARE(entriesOf({}), 2);
    }
    void anEditAfterUndoDoesNotMergeWithWhatIsBefore() {
        History history;
        history.push(state(1), "slider", "/step");
        history.push(state(2), "other", "/time/end");
        history.undo(state(3));
        history.push(state(2), "slider", "/step");
        QVERIFY(history.undo(state(4)) == state(2));
        QVERIFY(history.undo(state(2)) == state(1));
    }
    void clearForgetsEverything() {
        History history;
        history.push(state(1), "first", {});
        history.push(state(2), "second", {});
        history.undo(state(3));
        history.clear();
        QVERIFY(!history.canUndo() && !history.canRedo());
    }
};

EXTREMAL_TEST(HistoryTest)

}  // namespace extremal::history_test

#include "history_test.moc"
