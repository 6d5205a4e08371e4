// SPDX-License-Identifier: GPL-3.0-or-later
/// How long a user waits at first, and for each frame while a plot of a million points is panned: processor
/// time of the window's thread, and wall-clock time on an idle machine.
#include <qcustomplot.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <cstdio>

#include "engine/core/thread_clock.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/start_page.hpp"

namespace extremal {
namespace {

class Watch {
public:
    Watch() { wall_.start(); }
    void print(const char* what) const {
        std::printf("%-44s %8.1f ms CPU of the window's thread %8.1f ms wall\n", what,
                    1e3 * (threadSeconds() - cpu_), 1e-6 * static_cast<double>(wall_.nsecsElapsed()));
        std::fflush(stdout);
    }

private:
    double cpu_ = threadSeconds();
    QElapsedTimer wall_;
};

/// Moves the visible part by a fiftieth, again and again, and draws it.
void pan(QCustomPlot& canvas, PlotWidget& plot) {
    constexpr int frames = 40;
    double longest = 0, all = 0;
    for (int i = 0; i < frames; ++i) {
        const PlotRange x = plot.visibleRange(PlotAxis::x);
        const double shift = (x.high - x.low) / 50 * (i < frames / 2 ? 1 : -1);
        const double before = threadSeconds();
        plot.setTimeRange(PlotRange{x.low + shift, x.high + shift});
        canvas.replot();
        const double spent = threadSeconds() - before;
        longest = std::max(longest, spent);
        all += spent;
    }
    std::size_t points = 0;
    for (const Series& s : plot.figure().series()) points += s.x.size();
    std::printf("    panning %-26s %9zu points %8.1f ms CPU a frame, at most %.1f\n",
                plot.figure().title.c_str(), points, 1e3 * all / frames, 1e3 * longest);
    std::fflush(stdout);
}

}  // namespace
}  // namespace extremal

int main(int argc, char** argv) {
    using namespace extremal;
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && !qEnvironmentVariableIsSet("DISPLAY"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    const Watch whole;
    QApplication application(argc, argv);
    loadFonts();
    applyTheme(application, Theme::light());
    MainWindow window(Theme::light(), false);
    window.resize(1600, 1000);
    window.show();
    window.grab();
    whole.print("start page painted");
    auto* const page = window.findChild<StartPage*>();
    const bool isComplete = QTest::qWaitFor([&] {
        const QList<GalleryCard*> cards = page->findChildren<GalleryCard*>();
        return std::all_of(cards.begin(), cards.end(), [](const GalleryCard* c) { return c->hasPicture(); });
    });
    whole.print(isComplete ? "start page with its pictures" : "start page, without all of its pictures");
    {
        const Watch watch;
        window.open("preset:spring-pendulum");
        waitForResults(window);
        for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
        watch.print("default scene finished and painted");
    }
    QTemporaryDir folder;
    QFile file(folder.filePath("long.json"));
    if (!file.open(QIODevice::WriteOnly)) return 1;
    file.write(R"({"extremal":1,"model":{"type":"kepler"},"time":{"end":10000},"output":{"every":0.01},
        "schemes":[{"label":"a","step":0.01,"baseline":"stormer-verlet"}],
        "observe":["energy"],"views":["energy","trajectory","phase"]})");
    file.close();
    const Watch watch;
    window.open(file.fileName());
    window.runControl().start();
    waitForResults(window);
    watch.print("a million rows");
    for (PlotWidget* plot : window.compareView().plots())
        if (plot->figure().view != "work-precision") {
            plot->setTimeRange(PlotRange{100, 5000});
            pan(*plot->findChild<QCustomPlot*>(), *plot);
        }
    return 0;
}
