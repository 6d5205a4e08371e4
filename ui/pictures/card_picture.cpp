// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/card_picture.hpp"

#include <QCoreApplication>
#include <QPainter>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/scene/bind.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {
namespace {

constexpr double part = 0.62;  // of the run
constexpr double cardMargin = 14;

/// Nothing that a run would be needed for besides the schemes.
bool isPlain(const View& view) { return view.starts.isEmpty() && view.keys.keys.empty(); }

}  // namespace

Scene sceneOfPicture(Scene scene) {
    scene.reference = {};
    scene.reference.kind = ReferenceSpec::Kind::none;
    scene.observe.clear();
    std::erase_if(scene.views, [](const View& v) { return !isPlain(v) || v.id == "work-precision"; });
    return scene;
}

QImage cardPicture(std::shared_ptr<const Comparison> comparison, const Theme& theme, double ratio) {
    const StagePlayer player(comparison);
    const System system = comparison->system ? *comparison->system : makeSystem(comparison->scene);
    if (player.hasStage() && system.independent == "t") {  // nothing moves along a place
        const double t = player.start() + part * (player.end() - player.start());
        const StageFrame frame = player.frame(t, stageStyle(theme));
        const QSizeF size(cardPictureSize);
        const Camera camera = player.fittedCamera(size.width(), size.height(), cardMargin);
        QImage image = drawStage(frame, camera, size, ratio).convertToFormat(QImage::Format_RGB32);
        image.setDevicePixelRatio(ratio);
        return image;
    }
    const std::vector<View> views = plotViews(comparison->scene);
    if (views.empty()) return {};
    PlotOptions options;
    options.hasHeader = options.hasLegend = false;
    QImage image =
        renderFigure(makeFigure(*comparison, views.front()), cardPictureSize, theme, ratio, options);
    image.setDevicePixelRatio(ratio);
    return image;
}

QString presetPictureFile(const QString& folder, const QString& preset, bool isDark) {
    return QStringLiteral("%1/%2-%3.png").arg(folder, preset, isDark ? "dark" : "light");
}

QString presetPictureFolder() {
    return QCoreApplication::applicationDirPath() + QStringLiteral("/../share/extremal/pictures");
}

}  // namespace extremal
