// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/background.hpp"

#include <QEventLoop>
#include <QPointer>
#include <QTest>

#include <array>
#include <cstddef>

#include "tests/tools/test.hpp"

namespace extremal::background_test {

class BackgroundTest : public QObject {
    Q_OBJECT
private slots:
    void messagesOfAThreadComeInTheirOrder() {
        constexpr int messages = 500;
        std::array<int, 8> last{};
        int disordered = 0;
        for (std::size_t w = 0; w < last.size(); ++w)
            runInBackground([w, self = QPointer(this), &last, &disordered] {
                for (int i = 1; i <= messages; ++i)
                    sendToWindow([i, w, self, &last, &disordered] {
                        if (!self) return;
                        if (last[w] != i - 1) ++disordered;
                        last[w] = i;
                    });
            });
        for (const int& each : last) QTRY_COMPARE(each, messages);
        QCOMPARE(disordered, 0);
    }
    /// As reading a scene does.
    void anEventLoopInsideAMessageRunsThoseThatFollow() {
        QString order;
        runInBackground([&order] {
            sendToWindow([&order] {
                QEventLoop loop;
                order += "a";
                sendToWindow([&order] { order += "b"; });
                sendToWindow([&loop] { loop.quit(); });
                loop.exec();
                order += "c";
            });
        });
        QTRY_COMPARE(order, QStringLiteral("abc"));
    }
    void messagesThatAreHeldComeLaterInTheirOrder() {
        QString order;
        const auto send = [&order](const char* letter) {
            sendToWindow([&order, letter] { order += letter; });
        };
        {
            const HeldMessages outer;
            {
                const HeldMessages inner;
                send("a");
                for (int i = 0; i < 10; ++i) QCoreApplication::processEvents();
            }
            send("b");
            for (int i = 0; i < 10; ++i) QCoreApplication::processEvents();
            QVERIFY(order.isEmpty());
        }
        send("c");
        QTRY_COMPARE(order, QStringLiteral("abc"));
    }
};

EXTREMAL_TEST(BackgroundTest)

}  // namespace extremal::background_test

#include "background_test.moc"
