// SPDX-License-Identifier: GPL-3.0-or-later
/// Contents that are too high without a bar, and low beside one, do not keep it coming and going.
#include <QScrollBar>
#include <QTest>

#include "tests/tools/test.hpp"
#include "ui/base/steady_scroll_area.hpp"

namespace extremal::steady_scroll_area_test {
namespace {

/// High where there is room for it.
struct Contents : QWidget {
    int wide = 0;
    void resizeEvent(QResizeEvent*) override { setFixedHeight(width() >= wide ? 400 : 50); }
};

}  // namespace

class SteadyScrollAreaTest : public QObject {
    Q_OBJECT
private slots:
    void theBarStopsComingAndGoing() {
        SteadyScrollArea area;
        area.setFrameShape(QFrame::NoFrame);
        area.setWidgetResizable(true);
        area.resize(300, 200);
        auto* const contents = new Contents;
        contents->wide = 295;
        area.setWidget(contents);
        area.show();
        for (const int width : {300, 290, 310, 300}) {
            area.resize(width, 200);
            for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
        }
        QVERIFY(contents->width() > 200);
        area.resize(200, 200);  // low, and without a bar
        QTRY_VERIFY(!area.verticalScrollBar()->isVisible());
    }
};

EXTREMAL_TEST(SteadyScrollAreaTest)

}  // namespace extremal::steady_scroll_area_test

#include "steady_scroll_area_test.moc"
