// SPDX-License-Identifier: GPL-3.0-or-later
/// A signal that ends the program keeps the edits that were made since the last backup.
#include <QCoreApplication>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <vector>

#include "tests/tools/test.hpp"
#include "ui/base/notices.hpp"
#include "ui/shell/termination.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::termination_test {

class TerminationTest : public QObject {
    Q_OBJECT
private slots:
    void theLastEditsAreKept_data() {
        QTest::addColumn<int>("signal");
        QTest::newRow("SIGTERM") << SIGTERM;
        QTest::newRow("SIGINT") << SIGINT;
        QTest::newRow("SIGHUP") << SIGHUP;
    }
    void theLastEditsAreKept() {
        QFETCH(int, signal);
        const QTemporaryDir folder;
        Notices notices;
        Workspace workspace(notices);
        Autosave autosave(workspace, notices, folder.path());
        std::vector<int> ended;
        const Termination termination([&] { autosave.writeNow(); },
                                      [&](int number) { ended.push_back(number); });
        QVERIFY(workspace.open("preset:pendulum"));
        QVERIFY(workspace.edit({{"/time/end", Value(7.25)}}, "end"));
        std::raise(signal);
        QVERIFY(ended.empty());  // nothing is done in the handler
        QTRY_COMPARE(ended, std::vector<int>{signal});
        // Another session finds them, once the lock is free.
        const QStringList copies = QDir(folder.path()).entryList({"*.json"}, QDir::Files);
        QCOMPARE(copies.size(), 1);
        QFile copy(folder.filePath(copies.first()));
        QVERIFY(copy.open(QIODevice::ReadOnly));
        QVERIFY(copy.readAll().contains("\"end\": 7.25"));
    }

    void whatWasIgnoredStaysSo() {
        struct sigaction before {};
        sigaction(SIGHUP, nullptr, &before);
        std::signal(SIGHUP, SIG_IGN);
        {
            bool isCalled = false;
            const Termination termination([&] { isCalled = true; }, [](int) {});
            std::raise(SIGHUP);
            QCoreApplication::processEvents();
            QVERIFY(!isCalled);
        }
        sigaction(SIGHUP, &before, nullptr);
    }

    void theSignalsHaveTheirEffectAgainAfterwards() {
        struct sigaction before {
        }, now{};
        sigaction(SIGTERM, nullptr, &before);
        {
            const Termination termination([] {}, [](int) {});
            sigaction(SIGTERM, nullptr, &now);
            QVERIFY(now.sa_handler != before.sa_handler);
        }
        sigaction(SIGTERM, nullptr, &now);
        QVERIFY(now.sa_handler == before.sa_handler);
    }
};

EXTREMAL_TEST(TerminationTest)

}  // namespace extremal::termination_test

#include "termination_test.moc"
