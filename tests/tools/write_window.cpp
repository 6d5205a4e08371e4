// SPDX-License-Identifier: GPL-3.0-or-later
/// tool.window FOLDER [WIDTHxHEIGHT [light|dark [LETTERS [RATIO [PRESET...]]]]]: pictures of the whole window
/// on each preset, or on those that are named, with its results, as PRESET.png. LETTERS is the scale of the
/// text, RATIO that of the screen. Needs no display.
#include <QApplication>
#include <QDir>

#include <cstdio>

#include "engine/scene/preset.hpp"
#include "tests/ui/window.hpp"
#include "ui/study/background_sweep.hpp"
#include "ui/workspace/playback.hpp"

namespace {

using namespace extremal;

/// False where the results do not come; the picture shows what there is by then.
bool writePicture(MainWindow& window, const QString& preset, const QString& file) {
    if (!window.open("preset:" + preset)) return false;
    bool isDone = waitForResults(window);
    // The lines of speed against accuracy are measured in the background, where errors are known.
    const auto* sweep = window.findChild<BackgroundSweep*>();
    const auto results = window.runControl().results();
    const bool hasErrors = results && results->reference.type != "none";
    isDone = isDone && (!hasErrors || QTest::qWaitFor([&] { return !sweep->known().empty(); }, 8000));
    Playback& playback = window.playback();
    playback.setTime(playback.start() + 0.62 * (playback.end() - playback.start()));
    for (int i = 0; i < 100; ++i) QCoreApplication::processEvents();
    return window.grab().save(file) && isDone;
}

}  // namespace

int main(int argc, char** argv) {
    const auto argument = [&](int i, const char* otherwise) {
        return QString::fromUtf8(i < argc ? argv[i] : otherwise);
    };
    const QStringList size = argument(2, "1600x1000").split('x');
    const double letters = argument(4, "1").toDouble(), ratio = argument(5, "1").toDouble();
    if (argc < 2 || size.size() != 2 || !(letters > 0) || !(ratio > 0)) {
        std::fprintf(stderr,
                     "usage: tool.window FOLDER [WIDTHxHEIGHT [light|dark [LETTERS [RATIO [PRESET...]]]]]\n");
        return 2;
    }
    qputenv("QT_QPA_PLATFORM", "offscreen");
    qputenv("QT_SCALE_FACTOR", QByteArray::number(ratio));
    QApplication application(argc, argv);
    loadFonts();
    Theme theme = argument(3, "light") == "dark" ? Theme::dark() : Theme::light();
    theme.fontScale = letters;
    applyTheme(application, theme);
    QStringList names;
    for (int i = 6; i < argc; ++i) names << QString::fromUtf8(argv[i]);
    if (names.isEmpty())
        for (const Preset& preset : presets())
            names << QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
    const QDir folder(argument(1, ""));
    folder.mkpath(".");
    MainWindow window(theme, false);
    window.resize(size[0].toInt(), size[1].toInt());
    window.show();
    bool isComplete = true;
    for (const QString& name : names) {
        if (writePicture(window, name, folder.filePath(name + ".png"))) continue;
        std::fprintf(stderr, "%s: not everything was there in time\n", qPrintable(name));
        isComplete = false;
    }
    return isComplete ? 0 : 1;
}
