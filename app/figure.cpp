// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFileInfo>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/load.hpp"
#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/pictures/paper_figure.hpp"
#include "ui/pictures/snapshot.hpp"

namespace extremal::app {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& what, const std::string& remedy = {}) {
    throw SnapshotError(SnapshotError::Kind::unusable, where, what, remedy);
}

/// The choice that a word names.
template <class T>
T chosen(const char* option, const std::string& word, std::span<const StyleWord<T>> words) {
    std::vector<std::string> known;
    for (const StyleWord<T>& w : words) {
        if (word == w.word) return w.value;
        known.emplace_back(w.word);
    }
    refuse(option, "must be " + joinNames(known) + ", got \"" + word + "\"", suggestName(word, known));
}

double widthOf(const std::string& text) {
    if (const auto number = parseNumber(text)) return *number;
    return chosen("--width", text, widthWords());
}

std::optional<std::pair<double, double>> timesOf(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const std::size_t colon = text.find(':');
    const auto from = parseNumber(text.substr(0, colon)),
               to = colon == std::string::npos ? std::nullopt : parseNumber(text.substr(colon + 1));
    if (!from || !to) refuse("--times", "must be FROM:TO, got \"" + text + "\"", "for example 0:10");
    return std::pair(*from, *to);
}

PaperStyle styleOf(const FigureOptions& options) {
    PaperStyle style;
    style.width = widthOf(options.width);
    style.ratio = options.ratio;
    style.letters = options.letters;
    style.lines = options.lines;
    style.columns = options.columns;
    style.dotsPerInch = options.dotsPerInch;
    style.font = QString::fromStdString(options.font);
    style.legend = chosen("--legend", options.legend, legendWords());
    style.colours = chosen("--colours", options.colours, colourWords());
    style.portraits = chosen("--portraits", options.portraits, portraitWords());
    style.hasTitles = options.hasTitles;
    style.isEqual = options.isEqual;
    style.isCaptionDrawn = options.isCaptionDrawn;
    style.caption = QString::fromStdString(options.caption);
    style.schemes = options.only;
    style.times = timesOf(options.times);
    if (const auto problem = problemOf(style)) refuse(problem->where, problem->what, problem->remedy);
    return style;
}

/// The scene with the views asked for and the schemes asked for alone.
Scene sceneOf(const Scene& scene, const FigureOptions& options) {
    Scene shown = scene;
    for (const std::string& view : options.views) {
        if (view == "all" || view == "stage")
            refuse("--view", "a figure has plots as its panels, got \"" + view + "\"",
                   "extremal snapshot draws the stage, and everything");
        checkSnapshotView(scene, view);
        shown = withView(shown, view);
    }
    std::vector<std::string> labels;
    for (const SchemeSpec& spec : scene.schemes)
        if (spec.isEnabled) labels.push_back(spec.label);
    for (const std::string& label : options.only)
        if (std::find(labels.begin(), labels.end(), label) == labels.end())
            refuse("--only", "no scheme that is on has the label \"" + label + "\"",
                   suggestName(label, labels));
    if (!options.only.empty())
        for (SchemeSpec& spec : shown.schemes)
            spec.isEnabled =
                std::find(options.only.begin(), options.only.end(), spec.label) != options.only.end();
    return shown;
}

/// In the order asked for; a view may stand in the scene several times.
std::vector<Figure> figuresOf(const Comparison& comparison, const std::vector<std::string>& asked) {
    std::vector<Figure> figures;
    const std::vector<View> all = plotViews(comparison.scene);
    const auto add = [&](const View& view) { figures.push_back(makeFigure(comparison, view)); };
    for (const std::string& id : asked)
        for (const View& view : all)
            if (view.id == id) add(view);
    if (asked.empty())
        for (const View& view : all)
            if (view.id != "work-precision") add(view);
    std::erase_if(figures, [](const Figure& figure) { return isEmpty(figure); });
    if (figures.empty()) refuse("--view", "nothing of what was asked for can be drawn");
    return figures;
}

void checkFile(const FigureOptions& options, const Replacing& replacing) {
    const QFileInfo file(QString::fromStdString(options.out));
    const QString kind = file.suffix().toLower();
    if (kind != QLatin1String("png") && kind != QLatin1String("pdf") && kind != QLatin1String("svg"))
        refuse("--out", "figures end in .pdf, .svg or .png, got \"" + options.out + "\"");
    const QFileInfo folder(file.absolutePath());
    if (!folder.isDir() || !folder.isWritable() || file.isDir())
        throw SnapshotError(SnapshotError::Kind::unwritable, options.out, "cannot be written",
                            folder.isDir() ? "check the permissions" : "the folder does not exist");
    for (const QString& written : paperFiles(file.filePath()))
        requireReplaceable(written.toStdString(), replacing);
}

int printFigure(const FigureOptions& figure, const PaperFigure& paper, int code,
                const CommonOptions& options) {
    const QSizeF size = paperSize(paper);
    const double width = size.width() * 25.4 / 96, height = size.height() * 25.4 / 96;
    if (options.isJson) {
        Value document;
        document.set("file", figure.out);
        document.set("width", width);
        document.set("height", height);
        document.set("panels", static_cast<double>(paper.panels.size()));
        document.set("caption", captionOf(paper).toStdString());
        return print(writeJson(document), code);
    }
    if (options.isQuiet) return code;
    return print(figure.out + ": " + formatNumber(width, 4) + " x " + formatNumber(height, 4) + " mm, " +
                     std::to_string(paper.panels.size()) + " panels; data and caption beside it\n",
                 code);
}

}  // namespace

int figureVerb(const std::string& scene, const FigureOptions& figure, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    const Offscreen qt;
    try {
        PaperFigure paper{styleOf(figure), {}, read.scene.title};
        const Replacing replacing = replacingOf(scene, read, options);
        checkFile(figure, replacing);
        const Scene shown = sceneOf(read.scene, figure);
        InterruptWatch watch;
        Run run(shown, {options.threads});
        run.start();
        const bool isInterrupted = waitFor(run, watch, options);
        const Comparison comparison = run.latest();
        printFailures(comparison, sceneName(scene));
        if (isInterrupted) printProblem("", "interrupted: the figure shows partial results");
        paper.panels = panelsOf(figuresOf(comparison, figure.views), paper.style);
        const QString problem = savePaper(QString::fromStdString(figure.out), paper, replacing);
        if (!problem.isEmpty())
            throw SnapshotError(SnapshotError::Kind::unwritable, figure.out,
                                "cannot be written: " + problem.toStdString());
        return printFigure(figure, paper, exitCode(comparison, isInterrupted), options);
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    } catch (const SnapshotError& e) {
        return tellUndrawn(e);
    }
}

}  // namespace extremal::app
