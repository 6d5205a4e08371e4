// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/start.hpp"

#include <QApplication>
#include <QIcon>
#include <QPixmap>
#include <QScreen>
#include <QSettings>
#include <QTimer>

#include <algorithm>
#include <functional>

#include "ui/compare/compare_view.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/termination.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

Theme rememberedTheme() {
    const QSettings settings;
    Theme theme = settings.value("window/dark").toBool() ? Theme::dark() : Theme::light();
    theme.fontScale = std::clamp(settings.value("window/fontScale", 1.0).toDouble(), 0.7, 2.0);
    return theme;
}

int takePicture(QApplication& application, const QString& file, const std::string& scene) {
    const Theme theme =
        qEnvironmentVariable("EXTREMAL_SHOT_THEME") == "dark" ? Theme::dark() : Theme::light();
    applyTheme(application, theme);
    MainWindow window(theme, false);
    const QStringList size = qEnvironmentVariable("EXTREMAL_SHOT_SIZE", "1600x1000").split('x');
    if (size.size() == 2) window.resize(size[0].toInt(), size[1].toInt());
    if (!scene.empty()) window.open(QString::fromStdString(scene));
    window.show();
    int code = 1, waits = 0;
    // Plots follow a run in the background, on a busy machine some time later.
    const std::function<void()> grab = [&] {
        constexpr int most = 30;
        if (!window.compareView().isCurrent() && ++waits < most) {
            QTimer::singleShot(300, &window, grab);
            return;
        }
        QTimer::singleShot(900, &window, [&] {
            code = window.grab().save(file) ? 0 : 3;
            application.quit();
        });
    };
    if (scene.empty()) {
        QTimer::singleShot(4000, &window, grab);
    } else {
        QObject::connect(&window.runControl(), &RunControl::finished, &window, [&] {
            Playback& p = window.playback();
            if (!window.workspace().scene().shown.time) p.setTime(p.start() + 0.62 * (p.end() - p.start()));
            grab();
        });
        QTimer::singleShot(60000, &window, grab);
    }
    application.exec();
    return code;
}

}  // namespace

int runWindow(int& argc, char** argv, const std::string& scene,
              const std::function<void(const std::vector<Problem>&)>& tell) {
    QApplication application(argc, argv);
    QApplication::setApplicationName("Extremal");
    QApplication::setOrganizationName("Extremal");
    QApplication::setDesktopFileName("org.extremal.Extremal");
    loadFonts();
    QApplication::setWindowIcon(QIcon(":/icons/extremal.svg"));
    KeyGuard guard;
    application.installEventFilter(&guard);
    if (const QString shot = qEnvironmentVariable("EXTREMAL_SHOT"); !shot.isEmpty())
        return takePicture(application, shot, scene);
    const Theme theme = rememberedTheme();
    applyTheme(application, theme);
    MainWindow window(theme);
    constexpr QSize frame(16, 48);  // what window managers put around it
    window.resize(window.size().boundedTo(window.screen()->availableSize() - frame));
    const Termination termination([&] {
        if (auto* const autosave = window.findChild<Autosave*>()) autosave->writeNow();
    });
    window.show();  // at once: a scene may take seconds to be read
    if (!scene.empty() && !window.open(QString::fromStdString(scene)) && tell)
        tell(window.workspace().openProblems());
    return application.exec();
}

}  // namespace extremal
