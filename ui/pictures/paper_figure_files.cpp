// SPDX-License-Identifier: GPL-3.0-or-later
/// Styles as words, and what stands beside the picture of a paper: captions, data, LaTeX, the command.
#include <QFileInfo>
#include <QFontDatabase>
#include <QRegularExpression>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/text/markup.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/panels.hpp"
#include "engine/figure/sample.hpp"
#include "engine/run/files/export.hpp"
#include "ui/base/format.hpp"
#include "ui/pictures/paper_figure.hpp"

namespace extremal {
namespace {

constexpr std::array<StyleWord<LegendPlace>, 4> legends{{{LegendPlace::below, "below", "below the panels"},
                                                         {LegendPlace::above, "above", "above the panels"},
                                                         {LegendPlace::right, "right", "at the right"},
                                                         {LegendPlace::none, "none", "none"}}};
constexpr std::array<StyleWord<PaperColours>, 3> colours{
    {{PaperColours::paper, "paper", "of paper: differ in grey"},
     {PaperColours::screen, "screen", "of the window"},
     {PaperColours::grey, "grey", "grey"}}};
constexpr std::array<StyleWord<Portraits>, 3> portraits{
    {{Portraits::beside, "beside", "a panel per scheme"},
     {Portraits::density, "density", "where each scheme stays"},
     {Portraits::over, "over", "all in one panel"}}};
constexpr std::array<StyleWord<double>, 3> widths{{{86, "column", "one column, 86 mm"},
                                                   {178, "page", "two columns, 178 mm"},
                                                   {254, "slide", "slide, 254 mm"}}};

template <class T, std::size_t N>
const char* wordOf(const std::array<StyleWord<T>, N>& words, T value) {
    return std::find_if(words.begin(), words.end(), [&](const StyleWord<T>& w) { return w.value == value; })
        ->word;
}

/// "Energy error" of a title, "Phase portrait of RK4" of one of several portraits, else what is on its axes.
std::string nameOfPanel(const Figure& panel) {
    if (panel.title.empty()) return panel.y.title + " over " + panel.x.title;
    return panel.summary.ends_with(" of " + panel.title) ? panel.summary : panel.title;
}

/// Of the schemes that have curves, in their order.
std::vector<std::string> schemesOf(const PaperFigure& paper) {
    std::vector<std::string> labels;
    for (const Figure& panel : paper.panels)
        for (const std::string& label : schemesIn(panel))
            if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
    return labels;
}

QString besideFile(const QString& file, const char* ending) {
    const QFileInfo info(file);
    return info.path() + '/' + info.completeBaseName() + ending;
}

/// As it stands in a shell.
QString shellWord(const QString& text) {
    static const QRegularExpression plain(QStringLiteral("^[A-Za-z0-9_./:=+-]+$"));
    if (plain.match(text).hasMatch()) return text;
    return '\'' + QString(text).replace('\'', QLatin1String("'\\''")) + '\'';
}

}  // namespace

std::span<const StyleWord<LegendPlace>> legendWords() { return legends; }
std::span<const StyleWord<PaperColours>> colourWords() { return colours; }
std::span<const StyleWord<Portraits>> portraitWords() { return portraits; }
std::span<const StyleWord<double>> widthWords() { return widths; }

QString fontFamily(const QString& font) {
    if (font.isEmpty()) return {};
    loadFonts();  // the bundled one is known by its name as well
    if (QFileInfo(font).isFile()) {
        const QStringList families =
            QFontDatabase::applicationFontFamilies(QFontDatabase::addApplicationFont(font));
        return families.isEmpty() ? QString() : families.front();
    }
    const QStringList known = QFontDatabase::families();
    const auto same = std::find_if(known.begin(), known.end(), [&](const QString& family) {
        return family.compare(font, Qt::CaseInsensitive) == 0;
    });
    return same == known.end() ? QString() : *same;
}

std::optional<StyleProblem> problemOf(const PaperStyle& style) {
    struct Limit {
        const char* where;
        double value, least, most;
    };
    for (const Limit& limit : {Limit{"--width", style.width, 30, 1000},
                               {"--ratio", style.ratio, 0.2, 3},
                               {"--letters", style.letters, 4, 48},
                               {"--lines", style.lines, 0.1, 10},
                               {"--columns", static_cast<double>(style.columns), 0, 12},
                               {"--dpi", static_cast<double>(style.dotsPerInch), 72, 1200}})
        if (!(limit.value >= limit.least && limit.value <= limit.most))
            return StyleProblem{limit.where,
                                "must be " + formatNumber(limit.least) + " to " + formatNumber(limit.most) +
                                    ", got " + formatNumber(limit.value),
                                ""};
    if (style.times && !(style.times->first < style.times->second))
        return StyleProblem{"--times", "must be FROM:TO, FROM below TO", "for example 0:10"};
    if (!style.font.isEmpty() && fontFamily(style.font).isEmpty()) {
        std::vector<std::string> known;
        for (const QString& family : QFontDatabase::families())
            if (!family.contains('['))
                known.push_back(family.toStdString());  // "Name [foundry]" is as well "Name"
        const std::string name = style.font.toStdString(), nearest = suggestName(name, known);
        const bool isLong = nearest.size() > 200;  // the list of all
        return StyleProblem{
            "--font", "there is no font \"" + name + "\" on this machine",
            (isLong ? "fc-list : family lists them" : nearest) + "; the file of a font will do as well"};
    }
    return {};
}

QString panelLetter(std::size_t place) {
    const QString last(QChar(static_cast<char16_t>(u'a' + place % 26)));
    return place < 26 ? last : panelLetter(place / 26 - 1) + last;
}

QString captionOf(const PaperFigure& paper) {
    if (!paper.style.caption.isEmpty()) return paper.style.caption;
    std::string text = paper.title.empty() ? std::string() : paper.title + ". ";
    for (std::size_t i = 0; i < paper.panels.size(); ++i) {
        if (paper.panels.size() > 1) text += "(" + panelLetter(i).toStdString() + ") ";
        text += nameOfPanel(paper.panels[i]) + (i + 1 < paper.panels.size() ? "; " : ".");
    }
    if (const auto labels = schemesOf(paper); !labels.empty()) text += " Schemes: " + joinNames(labels) + ".";
    return QString::fromStdString(visibleLine(text));
}

std::string paperCsv(const PaperFigure& paper) {
    std::string csv = "panel,scheme,x,y,value\n";
    const auto add = [&](const std::string& panel, const std::string& label, double x, double y,
                         double value) {
        csv.append(panel).append(",").append(label);
        for (const double number : {x, y, value}) addNumber(csv, number);
        csv += "\n";
    };
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < paper.panels.size(); ++i) {
        const Figure& panel = paper.panels[i];
        const std::string letter = panelLetter(i).toStdString();
        const auto [from, to] =
            panel.x.isTime && panel.x.range ? *panel.x.range : std::pair(-HUGE_VAL, HUGE_VAL);
        for (const Series& s : panel.series()) {
            const std::string label = csvCell(seriesName(s));
            for (std::size_t k = 0; k < s.x.size(); ++k)
                if (!(s.x[k] < from || s.x[k] > to)) add(letter, label, s.x[k], s.y[k], none);
        }
        if (const HeatMap* heat = panel.heat(); heat && !heat->scale.empty())
            for (std::size_t c = 0; c < heat->xs.size(); ++c)
                for (std::size_t r = 0; r < heat->ys.size(); ++r)
                    add(letter, {}, heat->xs[c], heat->ys[r], heat->values[c * heat->ys.size() + r]);
    }
    return csv;
}

std::string paperTex(const PaperFigure& paper, const QString& file) {
    const bool isWide = paper.style.width > 120;
    const std::string environment = isWide ? "figure*" : "figure";
    const QFileInfo info(file);
    std::string tex;
    for (std::size_t i = 0; i < paper.panels.size(); ++i)
        tex += "% " + panelLetter(i).toStdString() + ": x is " + visibleLine(paper.panels[i].x.title) +
               ", y is " + visibleLine(paper.panels[i].y.title) + "\n";
    return tex + "\\begin{" + environment +
           "}\n  \\centering\n  \\includegraphics[width=" + formatNumber(paper.style.width) + "mm]{" +
           info.completeBaseName().toStdString() + "}\n  \\caption{" +
           latexText(captionOf(paper).toStdString()) +
           "}\n  \\label{fig:" + slug(info.completeBaseName().toStdString()) + "}\n\\end{" + environment +
           "}\n";
}

std::vector<QString> paperFiles(const QString& file) {
    return {file, besideFile(file, ".csv"), besideFile(file, ".tex")};
}

QString savePaper(const QString& file, const PaperFigure& paper, const Replacing& replacing) {
    const std::vector<QString> files = paperFiles(file);
    const std::string csv = paperCsv(paper), tex = markedAsOwn(paperTex(paper, file), "% ");
    requireReplaceable(files[0].toStdString(), replacing);
    requireReplaceable(files[1].toStdString(), replacing, csv);
    requireReplaceable(files[2].toStdString(), replacing, tex);
    if (QString problem = savePaperPicture(file, paper); !problem.isEmpty()) return problem;
    try {
        writeFile(files[1].toStdString(), csv, replacing);
        writeFile(files[2].toStdString(), tex, replacing);
    } catch (const ExportError& e) {
        return QString::fromStdString(e.path.string()) + ": " + e.what();
    }
    return {};
}

QString paperCommand(const PaperStyle& style, const QString& scene, std::span<const std::string> views,
                     const QString& file) {
    const PaperStyle usual;
    QStringList words{"extremal", "figure", scene, "--out", file};
    const auto add = [&](const char* option, const QString& value) { words << option << value; };
    const auto addSize = [&](const char* option, double value, double normal) {
        if (value != normal) add(option, QString::fromStdString(formatNumber(value)));
    };
    for (const std::string& view : views) add("--view", QString::fromStdString(view));
    addSize("--width", style.width, usual.width);
    addSize("--ratio", style.ratio, usual.ratio);
    addSize("--letters", style.letters, usual.letters);
    addSize("--lines", style.lines, usual.lines);
    addSize("--columns", style.columns, usual.columns);
    addSize("--dpi", style.dotsPerInch, usual.dotsPerInch);
    if (!style.font.isEmpty()) add("--font", style.font);
    if (style.legend != usual.legend) add("--legend", wordOf(legends, style.legend));
    if (style.colours != usual.colours) add("--colours", wordOf(colours, style.colours));
    if (style.portraits != usual.portraits) add("--portraits", wordOf(portraits, style.portraits));
    if (!style.hasTitles) words << "--no-titles";
    if (style.isEqual) words << "--equal";
    if (style.isCaptionDrawn) words << "--draw-caption";
    if (style.times)
        add("--times", QString::fromStdString(formatNumber(style.times->first) + ":" +
                                              formatNumber(style.times->second)));
    for (const std::string& label : style.schemes) add("--only", QString::fromStdString(label));
    if (!style.caption.isEmpty()) add("--caption", style.caption);
    for (QString& word : words) word = shellWord(word);
    return words.join(' ');
}

}  // namespace extremal
