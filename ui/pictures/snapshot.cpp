// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/snapshot.hpp"

#include <QBuffer>
#include <QFileInfo>
#include <QImageReader>
#include <QSaveFile>

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/figure/figure.hpp"
#include "engine/model/system.hpp"
#include "engine/view/catalog.hpp"
#include "ui/base/theme.hpp"
#include "ui/pictures/image_compare.hpp"
#include "ui/pictures/snapshot_page.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/stage/gl/surface.hpp"

namespace extremal {
namespace {

using Kind = SnapshotError::Kind;
constexpr int smallestSide = 64, largestSide = 8192;

bool hasPicture(const Scene& scene) {
    const ModelEntry* model = findModel(scene.model.type);
    return model && model->make(scene.model).draw;
}

/// The views of the page, in the order of the scene.
std::vector<View> chooseViews(const Scene& scene, const std::string& name) {
    if (name == "stage") return {{"stage", "", ""}};
    std::vector<View> plots = plotViews(scene);
    if (name != "all") {
        std::erase_if(plots, [&](const View& v) { return v.id != name; });
        if (plots.empty()) plots.push_back({name, "", ""});
        return plots;
    }
    const bool isStageWanted =
        scene.views.empty() ||
        std::any_of(scene.views.begin(), scene.views.end(), [](const View& v) { return v.id == "stage"; });
    std::vector<View> views;
    if (isStageWanted && hasPicture(scene)) views.push_back({"stage", "", ""});
    for (const View& v : plots)
        if (v.id != "work-precision") views.push_back(v);
    if (views.empty()) views = plots;
    return views;
}

QImage readBase(const QString& file) {
    QImageReader reader(file);
    reader.setAllocationLimit(1024);
    QImage base = reader.read();
    if (base.isNull())
        throw SnapshotError(Kind::unusable, file.toStdString(),
                            "cannot be read as a picture: " + reader.errorString().toLower().toStdString(),
                            "--compare takes a PNG file made by extremal snapshot");
    return base;
}

double nearestRow(const Comparison& comparison, double t) {
    double last = comparison.scene.start.value;
    for (const auto& scheme : comparison.schemes) {
        if (scheme->trajectory.rows() == 0) continue;
        const auto& rows = scheme->trajectory.columns[0].values;
        const auto after = std::lower_bound(rows.begin(), rows.end(), t);
        if (after == rows.end()) {
            last = std::max(last, rows.back());
            continue;
        }
        return after != rows.begin() && t - *(after - 1) <= *after - t ? *(after - 1) : *after;
    }
    return last;
}

SnapshotPage pageOf(std::shared_ptr<const Comparison> comparison, const SnapshotRequest& request,
                    bool isVector) {
    SnapshotPage page;
    page.views = chooseViews(comparison->scene, request.view);
    page.isSingle = page.views.size() == 1;
    page.isVector = isVector;
    const auto& shown = comparison->scene.shown.time;
    const auto time = request.time ? request.time : shown ? std::optional(shown->value) : std::nullopt;
    page.time = nearestRow(*comparison, time.value_or(comparison->scene.end.value));
    if (time) page.cursor = page.time;
    page.comparison = std::move(comparison);
    return page;
}

/// A page of messages is not a picture, unless they tell of a failure.
void checkThatSomethingIsDrawn(const Comparison& comparison, const std::vector<View>& views) {
    for (const auto& scheme : comparison.schemes)
        if (scheme->summary.status != RunStatus::done) return;
    const ModelEntry* model = findModel(comparison.scene.model.type);
    const System system = model ? model->make(comparison.scene.model) : System{};
    std::string messages;
    for (const View& view : views) {
        if (view.id == "stage" && !comparison.schemes.empty()) return;
        if (view.id == "stage") continue;
        const Figure figure = makeFigure(comparison, view, &system);
        if (!isEmpty(figure)) return;
        messages += (messages.empty() ? "" : "; ") + view.id + ": " + figure.message;
    }
    throw SnapshotError(Kind::unusable, "--view", "nothing of what was asked for can be drawn",
                        comparison.schemes.empty() ? "no scheme is switched on" : messages);
}

void writePng(QImage image, const QString& file) {
    image.setText(QStringLiteral("Software"), QString::fromLatin1(maker));
    QSaveFile target(file);
    QByteArray bytes;
    QBuffer buffer(&bytes);
    image.save(&buffer, "PNG");
    if (!target.open(QIODevice::WriteOnly) || target.write(bytes) != bytes.size() || !target.commit())
        throw SnapshotError(Kind::unwritable, file.toStdString(),
                            "cannot be written: " + target.errorString().toStdString());
}

QString differenceFileOf(const SnapshotRequest& request) {
    return request.file + QStringLiteral(".diff.png");
}

/// What the request writes takes the place of nothing that it reads, nor of files of the user.
void checkWhatIsReplaced(const SnapshotRequest& request) {
    Replacing replacing = request.replacing;
    std::vector<QString> files{request.file};
    if (!request.compareWith.isEmpty()) {
        replacing.read.emplace_back(request.compareWith.toStdString());
        files.push_back(differenceFileOf(request));
    }
    for (const QString& file : files) requireReplaceable(file.toStdString(), replacing);
}

void compareWithBase(const QImage& picture, const SnapshotRequest& request, SnapshotResult& result) {
    const QImage base = readBase(request.compareWith);
    const ImageDifference difference = compareImages(picture, base);
    result.isCompared = true;
    result.differingPercent = difference.differingPercent;
    const double tileTolerance = std::min(100.0, 50 * request.tolerance);  // by default 12 of 256 pixels
    result.isEqual = difference.hasSameSize && difference.differingPercent <= request.tolerance &&
                     difference.worstTilePercent <= tileTolerance;
    result.differenceFile = differenceFileOf(request);
    if (difference.hasSameSize)
        result.verdict = formatNumber(difference.differingPercent, 4) + " % of the pixels differ, " +
                         formatNumber(request.tolerance) + " % may; " +
                         formatNumber(difference.worstTilePercent, 4) + " % of the worst tile, " +
                         formatNumber(tileTolerance) + " % may";
    else
        result.verdict = "the sizes differ: " + std::to_string(picture.width()) + "x" +
                         std::to_string(picture.height()) + " and " + std::to_string(base.width()) + "x" +
                         std::to_string(base.height());
    writePng(difference.hasSameSize ? difference.picture : sideBySide(picture, base, difference),
             result.differenceFile);
}

}  // namespace

void checkSnapshotView(const Scene& scene, const std::string& name) {
    if (name == "all") {
        if (chooseViews(scene, name).empty())
            throw SnapshotError(Kind::unusable, "--view", "the scene has no view that can be drawn",
                                "name one with --view; extremal list views shows them");
        return;
    }
    std::vector<std::string> names = {"all"};
    for (const ViewEntry& entry : viewEntries()) names.push_back(entry.item.id);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw SnapshotError(Kind::unusable, "--view", "there is no view \"" + name + "\"",
                            suggestName(name, names));
    }
    const System system = findModel(scene.model.type)->make(scene.model);
    const bool isInScene =
        std::any_of(scene.views.begin(), scene.views.end(), [&](const View& v) { return v.id == name; });
    if (const std::string missing = isInScene ? "" : missingFor({name, "", ""}, system); !missing.empty())
        throw SnapshotError(
            Kind::unusable, "--view", name + " is not defined for " + scene.model.type,
            "it needs " + missing + "; " + scene.model.type + " has " + joinNames(viewsOf(system)));
    const ViewEntry* entry = findView(name);
    if (entry && !entry->observable.empty() &&
        std::find(scene.observe.begin(), scene.observe.end(), entry->observable) == scene.observe.end())
        throw SnapshotError(Kind::unusable, "--view",
                            "the scene does not observe what the view " + name + " shows",
                            "add --set /observe/-=" + entry->observable);
}

void checkSnapshot(const Scene& scene, const SnapshotRequest& request) {
    const QFileInfo file(request.file);
    const QString kind = file.suffix().toLower();
    if (kind != QLatin1String("png") && kind != QLatin1String("pdf") && kind != QLatin1String("svg"))
        throw SnapshotError(Kind::unusable, "--out",
                            "pictures end in .png, .pdf or .svg, got \"" + request.file.toStdString() + "\"");
    for (const int side : {request.width, request.height})
        if (side < smallestSide || side > largestSide)
            throw SnapshotError(Kind::unusable, "--size",
                                "sides must be 64 to 8192 pixels, got " + std::to_string(request.width) +
                                    "x" + std::to_string(request.height));
    if (request.time && !std::isfinite(*request.time))
        throw SnapshotError(Kind::unusable, "--time", "must be a finite number");
    if (!(request.tolerance >= 0) || request.tolerance > 100)
        throw SnapshotError(Kind::unusable, "--tolerance",
                            "must be 0 to 100 percent, got " + formatNumber(request.tolerance));
    checkSnapshotView(scene, request.view);
    if (!request.compareWith.isEmpty()) readBase(request.compareWith);
    const auto views = chooseViews(scene, request.view);
    if (std::any_of(views.begin(), views.end(), [](const View& v) { return v.id == "stage"; })) {
        try {
            makeHeadlessSurface();
        } catch (const OpenGlUnavailable& e) {
            throw SnapshotError(Kind::noOpenGl, "stage", e.what());
        }
    }
    const QFileInfo folder(file.absolutePath());
    if (!folder.isDir() || !folder.isWritable() || file.isDir())
        throw SnapshotError(Kind::unwritable, request.file.toStdString(), "cannot be written",
                            folder.isDir() ? "check the permissions" : "the folder does not exist");
    checkWhatIsReplaced(request);
}

SnapshotResult makeSnapshot(std::shared_ptr<const Comparison> comparison, const SnapshotRequest& request) {
    checkSnapshot(comparison->scene, request);
    const bool isVector = !request.file.endsWith(QLatin1String(".png"), Qt::CaseInsensitive);
    const QString title = QString::fromStdString(comparison->scene.title);
    const SnapshotPage page = pageOf(comparison, request, isVector);
    checkThatSomethingIsDrawn(*comparison, page.views);
    SnapshotResult result;
    result.time = page.time;
    try {
        const Theme theme = Theme::light();
        const QString problem = savePage(
            request.file, QSize(request.width, request.height), 1, title,
            [&](FigurePainter& painter, QRectF area) { drawSnapshotPage(painter, area, page, theme); });
        if (!problem.isEmpty())
            throw SnapshotError(Kind::unwritable, request.file.toStdString(),
                                "cannot be written: " + problem.toStdString());
    } catch (const OpenGlUnavailable& e) {
        throw SnapshotError(Kind::noOpenGl, "stage", e.what());
    }
    if (!request.compareWith.isEmpty())
        compareWithBase(isVector ? snapshotImage(comparison, request) : QImage(request.file), request,
                        result);
    return result;
}

QImage snapshotImage(std::shared_ptr<const Comparison> comparison, const SnapshotRequest& request) {
    QImage image(request.width, request.height, QImage::Format_RGB32);
    if (image.isNull())
        throw SnapshotError(Kind::unusable, "--size", "there is not enough memory for this picture");
    image.fill(Qt::white);
    image.setDotsPerMeterX(3780);
    image.setDotsPerMeterY(3780);
    try {
        FigurePainter painter(image, false);
        drawSnapshotPage(painter, QRectF(image.rect()), pageOf(std::move(comparison), request, false),
                         Theme::light());
    } catch (const OpenGlUnavailable& e) {
        throw SnapshotError(Kind::noOpenGl, "stage", e.what());
    }
    return image;
}

}  // namespace extremal
