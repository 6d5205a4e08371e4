// SPDX-License-Identifier: GPL-3.0-or-later
/// How long the window does not answer: the longest event of its thread during what a user does, in
/// milliseconds of wall-clock and of processor time. To be measured on an idle machine.
#include <qcustomplot.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QTemporaryDir>
#include <QTest>

#include <cstdio>
#include <ctime>
#include <functional>
#include <string>

#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

double threadMs() {
    timespec ts{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ts);
    return 1e3 * static_cast<double>(ts.tv_sec) + 1e-6 * static_cast<double>(ts.tv_nsec);
}

/// Measures each event that is not sent while another one is handled.
class TimedApplication : public QApplication {
public:
    using QApplication::QApplication;
    bool notify(QObject* receiver, QEvent* event) override {
        if (depth_ > 0 || isActing) return QApplication::notify(receiver, event);
        ++depth_;
        const int type = event->type();
        const std::string name = receiver->metaObject()->className();
        QElapsedTimer clock;
        clock.start();
        const double before = threadMs();
        const bool result = QApplication::notify(receiver, event);
        const double cpu = threadMs() - before, wall = 1e-6 * static_cast<double>(clock.nsecsElapsed());
        --depth_;
        allCpu += cpu;
        if (cpu > longestCpu) {
            longestCpu = cpu;
            longestWall = wall;
            where = name + " " + std::to_string(type);
        }
        return result;
    }
    void reset() {
        longestCpu = longestWall = allCpu = 0;
        where.clear();
    }
    bool isActing = false;
    double longestCpu = 0, longestWall = 0, allCpu = 0;
    std::string where;

private:
    int depth_ = 0;
};

}  // namespace
}  // namespace extremal

int main(int argc, char** argv) {
    using namespace extremal;
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && !qEnvironmentVariableIsSet("DISPLAY"))
        qputenv("QT_QPA_PLATFORM", "offscreen");
    TimedApplication application(argc, argv);
    loadFonts();
    applyTheme(application, Theme::light());
    MainWindow window(Theme::light(), false);
    window.resize(1600, 1000);
    if (!qEnvironmentVariableIsSet("EXTREMAL_OPENED_FIRST")) window.show();
    const auto settle = [&] {
        waitForResults(window);
        QTest::qWait(400);  // what is painted after the last result
    };
    const auto measure = [&](const char* what, const std::function<void()>& act, bool isWaiting = false) {
        application.reset();
        const double before = threadMs();
        application.isActing = !isWaiting;  // counted as a whole
        act();
        application.isActing = false;
        const double own = threadMs() - before;
        settle();
        std::printf("%-34s %8.1f ms CPU %8.1f ms wall in %-36s act %7.1f  all %8.1f\n", what,
                    application.longestCpu, application.longestWall, application.where.c_str(), own,
                    application.allCpu);
        std::fflush(stdout);
    };
    const std::string preset = argc > 1 ? argv[1] : "spring-pendulum";
    const auto edit = [&](const char* pointer, const Value& value) {
        window.workspace().edit({{pointer, value}}, "edit");
    };
    const bool isFile = preset.find('/') != std::string::npos;
    measure("open", [&] {
        window.open(QString::fromStdString((isFile ? "" : "preset:") + preset));
        if (isFile) window.runControl().start();  // a long one waits to be asked for
    });
    window.show();
    settle();
    std::printf("    %d widgets\n", static_cast<int>(QApplication::allWidgets().size()));
    for (const PlotWidget* plot : window.compareView().plots()) {
        const double before = threadMs();
        plot->findChild<QCustomPlot*>()->replot();
        std::printf("    painting %-25s %8.1f ms CPU\n", plot->figure().title.c_str(), threadMs() - before);
    }
    measure("switch a scheme off", [&] { window.actions().find("toggle2")->trigger(); });
    measure("switch it on", [&] { window.actions().find("toggle2")->trigger(); });
    if (preset == "spring-pendulum") measure("change k", [&] { edit("/model/k", 9000.0); });
    measure("select another scheme", [&] { window.workspace().selectScheme(3); });
    measure("rename", [&] { edit("/schemes/0/label", "renamed"); });
    measure("theme", [&] { window.actions().find("theme")->trigger(); });
    measure("resize", [&] { window.resize(1400, 900); });
    int frames = 0;
    QObject::connect(&window.playback(), &Playback::timeChanged, [&frames] { ++frames; });
    measure(
        "play a second",
        [&] {
            frames = 0;
            window.playback().setPlaying(true);
            QTest::qWait(1000);
            window.playback().setPlaying(false);
        },
        true);
    std::printf("    %d frames\n", frames);
    measure("undo", [&] { window.actions().find("undo")->trigger(); });
    QTemporaryDir folder;
    QFile file(folder.filePath("long.json"));
    if (file.open(QIODevice::WriteOnly)) {
        std::string schemes;
        for (int i = 0; i < 8; ++i)
            schemes += std::string(i ? "," : "") + R"({"label":")" + char('a' + i) +
                       R"(","step":0.01,"baseline":")" + (i % 2 ? "rk4" : "stormer-verlet") + R"("})";
        file.write(
            (R"({"extremal":1,"model":{"type":"kepler"},"time":{"end":10000},"schemes":[)" + schemes +
             R"(],"observe":["energy","error"],"views":["stage","energy","error","trajectory","phase"]})")
                .c_str());
        file.close();
        measure("eight schemes x 1e6 steps", [&] {
            if (!window.open(file.fileName())) std::printf("cannot be opened\n");
            window.runControl().start();
        });
    }
    return 0;
}
