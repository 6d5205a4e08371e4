// SPDX-License-Identifier: GPL-3.0-or-later
/// The look of the program as one value: colours, fonts, series styles, and the style sheet made from them.
///
/// Everything that draws takes a `const Theme&`: the window, the plots, the stage and the exports. Two values
/// exist, Theme::light() and Theme::dark(). Lengths are in device-independent pixels (12 px is 9 pt), so that
/// pictures do not depend on the resolution of a screen. All text colours reach a contrast of 4.5 : 1 on the
/// grounds they are used on, all series colours 3 : 1.
///
/// The style sheet uses these dynamic properties; nothing else needs a separate style:
/// - QFrame card = true: panel ground, hairline, rounded corners; selected = true: accent line
/// - QFrame banner = "information", "warning" or "error"
/// - QLabel role = "heading", "title", "strong" or "caption"; none: body text
/// - QPushButton kind = "primary", "flat" or "chip"; none: outlined
/// - QWidget ground = "window" or "panel": plain grounds
/// - room = "name", "value", "step", "play", "mark" or "side": widths that grow with the letters
///
/// After changing a property of a visible widget call repolish(widget).
#pragma once

#include <array>
#include <QColor>
#include <QFont>
#include <QList>
#include <QPalette>
#include <QString>

class QApplication;
class QWidget;

namespace extremal {

/// The share of its colour that a second curve of a scheme has, in percent.
inline constexpr int paleLine = 50;
/// The same of the other schemes while one is selected.
inline constexpr int fadedLine = 28;

/// How a scheme is drawn everywhere. The dash is in units of the pen's width, as QPen wants it; empty is
/// solid.
struct SeriesStyle {
    QColor color;
    QList<qreal> dash;
};

struct Theme {
    bool isDark = false;
    QColor window, panel, field;  ///< grounds: behind the cards, of cards and plots, of inputs
    QColor text, muted;
    QColor grid, line;                   ///< grid of plots; hairlines of cards and axes
    QColor accent, onAccent, selection;  ///< selection: ground of chosen rows and text
    QColor warning, warningGround, warningLine;
    QColor error, errorGround, errorLine;
    QColor good;
    std::array<QColor, 8> seriesColors;
    double fontScale = 1;  ///< the user's setting
    QString family = {};   ///< of all letters; empty: the bundled one
    double lineWidth = 1;  ///< of curves, in units of their usual width

    static Theme light();
    static Theme dark();

    /// Colour and dash of the scheme with this place in the scene (0, 1, ...). Eight colours, each with its
    /// own dash; from the ninth scheme on the colours return with other dashes.
    SeriesStyle series(int style) const;  ///< of a scheme, or of a curve of no scheme

    /// Between a colour and the ground of plots: so many percent of the colour.
    QColor pale(const QColor& color, int percent) const;

    /// The colour of a scheme as a ground for text in onAccent: as much darker (in the dark theme lighter) as
    /// a contrast of 4.5 : 1 asks for.
    QColor ground(QColor color) const;

    QFont body() const;     ///< 12 px
    QFont strong() const;   ///< 12 px semi-bold: values, axis titles
    QFont caption() const;  ///< 11 px: muted notes, tick labels
    QFont title() const;    ///< 13 px semi-bold: of cards
    QFont heading() const;  ///< 14 px semi-bold: of the window

    QPalette palette() const;
    QString styleSheet() const;
};

/// Registers the bundled fonts (once) and returns the family's name.
QString loadFonts();

/// Fusion, the palette, the font and the one style sheet.
void applyTheme(QApplication& application, const Theme& theme);

/// Lets the style sheet see a changed dynamic property.
void repolish(QWidget& widget);

/// Contrast of two opaque colours, 1 to 21 (WCAG 2.1: (L1 + 0.05) / (L2 + 0.05), L the relative luminance).
double contrast(const QColor& a, const QColor& b);

}  // namespace extremal
