// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the selected scheme, which follows the cursor and the selection.
#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QTextBrowser>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/windows/inspector_window.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::inspector_window_test {

class InspectorWindowTest : public QObject {
    Q_OBJECT

private slots:
    void itFollowsTimeAndSelection() {
        loadFonts();
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        const auto& schemes = window.workspace().scene().schemes;
        window.workspace().selectScheme(0);
        window.playback().setTime(0);
        window.actions().find("inspect")->trigger();
        auto* const inspector = window.findChild<InspectorWindow*>();
        QVERIFY(inspector);
        QTRY_VERIFY(inspector->isCurrent() && !inspector->plots().empty());
        const PlotWidget& motion = *inspector->plots().front();
        QVERIFY(motion.figure().title.find(schemes[0].label) != std::string::npos);
        QCOMPARE(motion.figure().series().front().x.front(), 0.0);

        window.playback().setTime(1);
        QTRY_VERIFY(inspector->isCurrent() && motion.figure().series().front().x.front() > 0.5);
        QVERIFY(motion.figure().series().front().x.front() <= 1);

        window.workspace().selectScheme(1);
        QTRY_VERIFY(inspector->isCurrent() &&
                    inspector->plots().front()->figure().title.find(schemes[1].label) != std::string::npos);
        QVERIFY(
            inspector->findChild<QTextBrowser*>()->toPlainText().contains("The Lagrangian of this scene"));
    }
};

EXTREMAL_TEST(InspectorWindowTest)

}  // namespace extremal::inspector_window_test

#include "inspector_window_test.moc"
