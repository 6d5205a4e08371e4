// SPDX-License-Identifier: GPL-3.0-or-later
/// write_pictures FOLDER: the pictures of the presets on the start page, light and dark, made by the
/// program's own parts when it is built.
#include <QApplication>
#include <QDir>

#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/pictures/card_picture.hpp"

namespace {

using namespace extremal;

constexpr std::chrono::seconds longest{20};  // of a preset: what there is by then is drawn

/// False if there is nothing to draw.
bool write(const Preset& preset, const QString& folder) {
    const ReadScene read = readScene(preset.json);
    if (!read.errors.empty()) return false;
    RunOptions options{.products = {Product::denseOutput}};
    options.isTimed = false;
    Run run(sceneOfPicture(read.scene), options);
    run.start();
    if (!run.waitFor(longest)) run.stop();
    run.wait();
    const auto result = std::make_shared<const Comparison>(run.latest());
    const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
    for (const Theme& theme : {Theme::light(), Theme::dark()}) {
        const QImage image = cardPicture(result, theme, cardPictureRatio);
        if (image.isNull() || !image.save(presetPictureFile(folder, id, theme.isDark))) return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    const QApplication application(argc, argv);
    if (argc != 2) return 2;
    loadFonts();
    QDir().mkpath(argv[1]);
    for (const Preset& preset : presets()) {
        try {
            if (write(preset, argv[1])) continue;
            std::fprintf(stderr, "no picture of %s\n", std::string(preset.id).c_str());
        } catch (const std::exception& error) {
            std::fprintf(stderr, "no picture of %s: %s\n", std::string(preset.id).c_str(), error.what());
        }
    }
    return 0;
}
