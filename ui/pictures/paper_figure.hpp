// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure for a paper: panels beside each other with one legend and one caption, of the width of a column,
/// in the letters of the document; its data and its caption in LaTeX beside it. The window's sheet and
/// `extremal figure` make the same bytes from the same style.
///
///     PaperFigure paper{.style = {.width = 86}, .panels = panelsOf(figures, style), .title = scene.title};
///     savePaper("figure.pdf", paper, {});
#pragma once

#include <QImage>
#include <QString>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/run/files/replacing.hpp"
#include "ui/base/theme.hpp"

namespace extremal {

enum class LegendPlace { below, above, right, none };
enum class PaperColours {
    paper,   ///< differ in grey and for the colour blind
    screen,  ///< those of the window
    grey,
};
enum class Portraits {
    beside,   ///< a panel per scheme
    density,  ///< the same, of where each curve stays
    over,     ///< all in one panel
};

struct PaperStyle {
    double width = 86;      ///< millimetres, 30 to 1000
    double ratio = 0.7;     ///< height of a panel over its width, 0.2 to 3
    double letters = 8;     ///< points of the tick labels, 4 to 48
    double lines = 0.75;    ///< points of the width of curves, 0.1 to 10
    int columns = 0;        ///< of panels, at most 12; 0: as many as have room
    int dotsPerInch = 300;  ///< of pictures in pixels, 72 to 1200
    QString font = {};      ///< family, or a file with a font; empty: the bundled one
    LegendPlace legend = LegendPlace::below;
    PaperColours colours = PaperColours::paper;
    Portraits portraits = Portraits::beside;
    bool hasTitles = true;        ///< above the panels; those that tell schemes apart are always there
    bool isEqual = false;         ///< in portraits one unit is as long on both axes
    bool isCaptionDrawn = false;  ///< below the panels as well, for slides
    QString caption = {};         ///< empty: one that names panels and schemes
    std::vector<std::string> schemes = {};                ///< labels; empty: all
    std::optional<std::pair<double, double>> times = {};  ///< the window of time shown; empty: all
    bool operator==(const PaperStyle&) const = default;
};

struct PaperFigure {
    PaperStyle style;
    std::vector<Figure> panels;  ///< as panelsOf makes them
    std::string title;           ///< of the scene
};

/// A name of a choice: on the command line, and in the window.
template <class T>
struct StyleWord {
    T value;
    const char* word;
    const char* title;
};
std::span<const StyleWord<LegendPlace>> legendWords();
std::span<const StyleWord<PaperColours>> colourWords();
std::span<const StyleWord<Portraits>> portraitWords();
/// Widths that papers and slides have, in millimetres.
std::span<const StyleWord<double>> widthWords();

/// What is wrong with a style: where ("--width"), what, and what would do; empty: it can be drawn.
struct StyleProblem {
    std::string where, what, remedy;
};
std::optional<StyleProblem> problemOf(const PaperStyle& style);

/// The panels that a style makes of figures: the schemes and the time shown, portraits taken apart.
std::vector<Figure> panelsOf(std::span<const Figure> figures, const PaperStyle& style);

/// Letter of a panel: "a", ..., "z", "aa".
QString panelLetter(std::size_t place);

/// The caption of the style, else one that says what each panel shows, of which schemes.
QString captionOf(const PaperFigure& paper);

/// The whole, without its caption, in device-independent pixels (96 to the inch).
QSizeF paperSize(const PaperFigure& paper);

/// As a PNG of this resolution would show it, for previews.
QImage paperImage(const PaperFigure& paper, double dotsPerInch);

/// The family of a font by its name or file, as a style names it. Empty: the bundled one, or that there is
/// no such font.
QString fontFamily(const QString& font);

/// The picture alone (.png, .pdf or .svg); returns what went wrong, empty: nothing did.
QString savePaperPicture(const QString& file, const PaperFigure& paper);

/// Writes FILE (.png, .pdf or .svg), and beside it with the same name the data of all panels as .csv
/// (panel,scheme,x,y,value: curves have no value, maps no scheme) and the figure environment with its
/// caption as .tex. Returns what went wrong, empty: nothing did. Throws what requireReplaceable does.
QString savePaper(const QString& file, const PaperFigure& paper, const Replacing& replacing);

/// The files that savePaper writes, the picture first.
std::vector<QString> paperFiles(const QString& file);

/// Data and LaTeX alone.
std::string paperCsv(const PaperFigure& paper);
std::string paperTex(const PaperFigure& paper, const QString& file);

/// The call of the command line that makes the same figure of a scene file.
QString paperCommand(const PaperStyle& style, const QString& scene, std::span<const std::string> views,
                     const QString& file);

}  // namespace extremal
