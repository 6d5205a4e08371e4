// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/export_folder.hpp"

#include <QBuffer>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/base/format.hpp"
#include "ui/pictures/playing_page.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/text/foreign_text.hpp"

namespace extremal {
namespace {

constexpr QSize figureSize(720, 440);

QString escaped(const std::string& text) { return QString::fromStdString(markupText(text)); }
QString escaped(const QString& text) { return escaped(text.toStdString()); }

QString embedded(const QByteArray& bytes, const char* kind, long width, const QString& what) {
    // All at once, as a title may have "%2" in it.
    return QStringLiteral("<img alt=\"%1\" width=\"%2\" src=\"data:image/%3;base64,%4\">")
        .arg(escaped(what), QString::number(width), QLatin1String(kind),
             QString::fromLatin1(bytes.toBase64()));
}

QString embedded(const QImage& image, const QString& what) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    image.save(&buffer, "PNG");
    return embedded(bytes, "png", std::lround(image.width() / image.devicePixelRatio()), what);
}

/// Notes with their formulas: what stands between the tags of the body. Tags in the notes are text.
QString notesHtml(const std::string& notes) {
    ForeignDocument document;
    document.read(QString::fromStdString(visibleText(notes)));
    document.keepOutsideLinks();
    const QString html = document.toHtml();
    const qsizetype from = html.indexOf('>', html.indexOf(QLatin1String("<body"))) + 1;
    return html.mid(from, html.lastIndexOf(QLatin1String("</body>")) - from);
}

QString schemeRow(const SchemeResult& result) {
    const Summary& s = result.summary;
    const QString order = s.orderClaimed > 0 ? QString::number(s.orderClaimed) : QStringLiteral("–");
    const QString measured = std::isfinite(s.orderMeasured) ? QString::number(s.orderMeasured, 'f', 2) : "–";
    QString outcome = QString::fromUtf8(name(s.status));
    if (s.status == RunStatus::failed) outcome += ": " + escaped(s.advice);
    return QStringLiteral(
               "<tr><td>%1</td><td>%2</td><td>%3</td><td class=n>%4</td><td class=n>%5</td>"
               "<td class=n>%6</td><td class=n>%7</td><td class=n>%8</td><td>%9</td></tr>\n")
        .arg(escaped(s.label), escaped(schemeText(result.spec)), escaped(stepText(result.spec)),
             QString::number(s.steps), shortTime(s.cpuSeconds),
             s.steps > 0 ? shortNumber(s.maxError) : QStringLiteral("–"), order + " / " + measured,
             shortNumber(s.energyDrift), outcome);
}

/// What went wrong in writing, empty if nothing did.
QString problemOf(const std::function<void()>& write) {
    try {
        write();
    } catch (const ExportError& e) {
        return QString::fromStdString(e.path.string()) + ": " + e.what();
    }
    return {};
}

/// A PNG picture that is known for our own later.
QString savePicture(QImage picture, const QString& file) {
    const QString problem = problemOf([&] { requireReplaceable(file.toStdString(), {}); });
    if (!problem.isEmpty()) return problem;
    picture.setText(QStringLiteral("Software"), QString::fromLatin1(maker));
    return picture.save(file) ? QString() : file + " cannot be written";
}

}  // namespace

QString figureName(const ExportParts& parts, std::size_t place) {
    return QStringLiteral("%1-%2").arg(place + 1).arg(QString::fromStdString(parts.figures[place].view));
}

QString commandsFor(const ExportParts& parts) {
    QString text = QStringLiteral("extremal run scene.json --out .\n");
    if (!parts.stage.isNull())
        text += QStringLiteral("extremal snapshot scene.json --view stage --out stage.png\n");
    for (std::size_t i = 0; i < parts.figures.size(); ++i)
        if (const std::string& view = parts.figures[i].view; view != "work-precision")
            text += QStringLiteral("extremal snapshot scene.json --view %1 --size %2x%3 --out %4.svg\n")
                        .arg(QString::fromStdString(view))
                        .arg(figureSize.width())
                        .arg(figureSize.height())
                        .arg(figureName(parts, i));
    return text;
}

namespace {

QString pageHead(const Scene& scene) {
    QString html = QStringLiteral(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\">"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"");
    html += pagePolicy() + "\"><title>" + escaped(scene.title) + "</title>\n<style>";
    html +=
        "body{font:15px/1.5 Inter,system-ui,sans-serif;max-width:1040px;margin:2em auto;padding:0 1em;"
        "color:#1f2328}table{border-collapse:collapse;font-size:13px}th,td{text-align:left;"
        "padding:4px 10px;border-bottom:1px solid #dfe3e8}.n{text-align:right}figure{margin:1.5em 0}"
        "figcaption,.m{color:#636c78}img{max-width:100%;height:auto}pre{background:#f3f4f6;"
        "padding:12px;overflow:auto}";
    return html + playStyle() + "</style></head><body>\n<h1>" + escaped(scene.title) + "</h1>\n";
}

QString schemeTable(const Comparison& comparison) {
    QString html =
        "<h2>Schemes</h2>\n<table><tr><th>scheme</th><th>discretization</th><th>step</th><th>steps</th>"
        "<th>CPU time</th><th>largest error</th><th>order, claimed / measured</th><th>energy drift</th>"
        "<th>outcome</th></tr>\n";
    for (const auto& result : comparison.schemes) html += schemeRow(*result);
    html += "</table>\n";
    if (comparison.reference.type != "none")
        html +=
            "<p class=m>Errors are distances from: " + escaped(comparison.reference.description) + ".</p>\n";
    return html;
}

}  // namespace

QString reportPage(const ExportParts& parts) {
    const Comparison& comparison = *parts.comparison;
    const Scene& scene = comparison.scene;
    const Film film = filmOf(parts.comparison, parts.frames);
    QString html = pageHead(scene);
    if (!scene.lesson.empty()) html += "<p><em>" + escaped(scene.lesson) + "</em></p>\n";
    html += filmHtml(film);
    html += notesHtml(scene.notes);
    if (!scene.source.empty()) html += "<p class=m>Source: " + escaped(scene.source) + "</p>\n";
    html += schemeTable(comparison);
    if (!parts.stage.isNull() && film.frames.empty())
        html += "<figure>" + embedded(parts.stage, "Stage") + "<figcaption>Stage</figcaption></figure>\n";
    for (const Figure& figure : parts.figures)
        html += "<figure>" + movingFigureHtml(figure, figureSize.width(), figureSize.height(), film) +
                "<figcaption>" + escaped(figure.summary) + "</figcaption></figure>\n";
    html +=
        "<h2>The same again</h2>\n<pre>" + escaped(commandsFor(parts)) +
        "</pre>\n<p class=m>In the folder of scene.json, which is this text; Extremal also takes it from the "
        "clipboard (Ctrl+Shift+V).</p>\n<details><summary>scene.json</summary><pre>" +
        escaped(writeJson(toValue(scene))) + "</pre></details>\n";
    return html + "<script>" + playScript() + "</script>\n</body></html>\n";
}

std::vector<std::function<QString()>> exportSteps(const ExportParts& parts, const QString& folder) {
    const auto shared = std::make_shared<const ExportParts>(parts);
    const std::filesystem::path path(folder.toStdString());
    std::vector<std::function<QString()>> steps;
    steps.push_back([=] {
        return problemOf([&] {
            exportComparison(*shared->comparison, path);
            writeFile(path / "command.txt", markedAsOwn(commandsFor(*shared).toStdString(), "# "));
            writeFile(path / "report.html",
                      markedAsOwn(reportPage(*shared).toStdString(), "<!-- ", " -->", 1));
        });
    });
    for (std::size_t i = 0; i < parts.figures.size(); ++i) {
        const QString stem = folder + '/' + figureName(parts, i);
        steps.push_back([=] {
            return savePicture(renderFigure(shared->figures[i], figureSize, Theme::light(), 2),
                               stem + ".png");
        });
        for (const char* ending : {".svg", ".pdf"})
            steps.push_back([=] {
                const QString problem =
                    problemOf([&] { requireReplaceable((stem + ending).toStdString(), {}); });
                if (!problem.isEmpty()) return problem;
                return saveFigure(stem + ending, shared->figures[i], figureSize, Theme::light(), 2);
            });
    }
    steps.push_back([=] {
        return shared->stage.isNull() ? QString() : savePicture(shared->stage, folder + "/stage.png");
    });
    return steps;
}

std::vector<std::function<QString()>> frameSteps(const QString& folder, double start, double end, int count,
                                                 const std::function<QImage(double)>& picture) {
    std::vector<std::function<QString()>> steps;
    for (int i = 0; i < count; ++i)
        steps.push_back([=] {
            const QString file = QStringLiteral("%1/frame-%2.png").arg(folder).arg(i + 1, 4, 10, QChar('0'));
            return savePicture(picture(start + (end - start) * i / std::max(1, count - 1)), file);
        });
    return steps;
}

QString exportFolder(const ExportParts& parts, const QString& folder) {
    for (const auto& step : exportSteps(parts, folder))
        if (const QString problem = step(); !problem.isEmpty()) return problem;
    return {};
}

}  // namespace extremal
