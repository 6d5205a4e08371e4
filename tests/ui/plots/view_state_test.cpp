// SPDX-License-Identifier: GPL-3.0-or-later
/// What part of a plot is visible, and the way back.
#include <QTest>

#include <cmath>
#include <limits>

#include "tests/tools/test.hpp"
#include "ui/plots/view_state.hpp"

namespace extremal::view_state_test {

class ViewStateTest : public QObject {
    Q_OBJECT
private slots:
    void newDataDoNotMoveAChosenRange() {
        ViewState view;
        view.setFitted(PlotAxis::x, {0, 10});
        view.setFitted(PlotAxis::y, {-1, 1});
        view.zoom(PlotAxis::x, 0.5, 5);
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{2.5, 7.5}));
        view.setFitted(PlotAxis::x, {0, 100});
        view.setFitted(PlotAxis::y, {-3, 3});
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{2.5, 7.5}));
        QCOMPARE(view.range(PlotAxis::y), (PlotRange{-3, 3}));  // not touched: it follows
        view.fit();
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{0, 100}));
    }
    void theAnchorStaysInItsPlaceOnLogAxesToo() {
        ViewState view;
        view.setLog(false, true);
        view.setFitted(PlotAxis::y, {1e-8, 1e4});
        view.zoom(PlotAxis::y, 0.25, 1e-2);
        const PlotRange r = view.range(PlotAxis::y);
        QVERIFY(std::abs(std::log10(r.low) + 3.5) < 1e-12);
        QVERIFY(std::abs(std::log10(r.high) + 0.5) < 1e-12);
        view.pan(PlotAxis::y, 1e-2, 1e-1);
        QVERIFY(std::abs(std::log10(view.range(PlotAxis::y).low) + 4.5) < 1e-12);
    }
    void backUndoesOneGestureAtATime() {
        ViewState view;
        view.setFitted(PlotAxis::x, {0, 8});
        view.remember();
        view.zoom(PlotAxis::x, 0.5, 4);
        view.zoom(PlotAxis::x, 0.5, 4);  // the same gesture
        view.remember();
        view.choose(PlotAxis::x, {3.9, 4.1});
        QVERIFY(view.back());
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{3, 5}));
        QVERIFY(view.back());
        QVERIFY(!view.isUserChosen());
        QVERIFY(!view.back());
    }
    void forwardUndoesBackUntilTheViewIsChanged() {
        ViewState view;
        view.setFitted(PlotAxis::x, {0, 8});
        for (const PlotRange range : {PlotRange{0, 4}, PlotRange{1, 2}}) {
            view.remember();
            view.choose(PlotAxis::x, range);
        }
        QVERIFY(!view.forward());
        QVERIFY(view.back() && view.back());
        view.remember();  // of a gesture that does nothing
        QVERIFY(view.forward());
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{0, 4}));
        QVERIFY(view.forward());
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{1, 2}));
        QVERIFY(!view.forward());
        QVERIFY(view.back());
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{0, 4}));
        view.remember();
        view.choose(PlotAxis::x, {5, 6});
        QVERIFY(!view.forward());
        QCOMPARE(view.range(PlotAxis::x), (PlotRange{5, 6}));
    }
    /// A gesture that changed nothing is not a step back.
    void backSkipsWhatDidNothing() {
        ViewState view;
        view.setFitted(PlotAxis::x, {0, 1});
        view.remember();
        view.choose(PlotAxis::x, {0.25, 0.5});
        view.remember();
        view.remember();
        QVERIFY(view.back());
        QCOMPARE(view.range(PlotAxis::x).high, 1.0);
        QVERIFY(!view.back());
    }
    void rangesStayDrawable() {
        ViewState view;
        view.setFitted(PlotAxis::x, {0, 1});
        constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                         inf = std::numeric_limits<double>::infinity();
        for (const PlotRange bad : {PlotRange{1, 1}, PlotRange{2, 1}, PlotRange{nan, 1}, PlotRange{0, inf},
                                    PlotRange{-1e300, 1e300}}) {
            view.setFitted(PlotAxis::x, bad);
            view.choose(PlotAxis::x, bad);
            QCOMPARE(view.range(PlotAxis::x), (PlotRange{0, 1}));
        }
        for (int i = 0; i < 400; ++i) view.zoom(PlotAxis::x, 0.5, 0.3);
        const PlotRange r = view.range(PlotAxis::x);
        QVERIFY(r.low < r.high && r.low <= 0.3 && r.high >= 0.3);
        view.setLog(true, false);
        view.choose(PlotAxis::x, {-1, 1});  // nothing on a log axis
        QVERIFY(view.range(PlotAxis::x).low > -1);
    }
};

EXTREMAL_TEST(ViewStateTest)
}  // namespace extremal::view_state_test

#include "view_state_test.moc"
