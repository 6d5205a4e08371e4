// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/theme.hpp"

#include <algorithm>
#include <cmath>
#include <QApplication>
#include <QFontDatabase>
#include <QStyle>
#include <QStyleFactory>
#include <QWidget>

#include "engine/figure/figure.hpp"
#include "engine/figure/image/palette.hpp"

// The resources live in a static library: the linker keeps them only if somebody asks. Must be outside
// namespaces.
static void initResources() { Q_INIT_RESOURCE(resources); }

namespace extremal {

Theme Theme::light() {
    Theme t;
    t.window = "#F3F4F6";
    t.panel = "#FFFFFF";
    t.field = "#EEF1F6";
    t.text = "#1F2328";
    t.muted = "#636C78";
    t.grid = "#ECEEF1";
    t.line = "#C6CBD2";
    t.accent = "#0B62D6";
    t.onAccent = "#FFFFFF";
    t.selection = "#DCE8FA";
    t.warning = "#7A4B00";
    t.warningGround = "#FFF8E6";
    t.warningLine = "#EBCB7F";
    t.error = "#B42318";
    t.errorGround = "#FEF1EF";
    t.errorLine = "#F0B5AE";
    t.good = "#0A7F5E";
    std::copy(lightSeries.begin(), lightSeries.end(), t.seriesColors.begin());
    return t;
}

Theme Theme::dark() {
    Theme t;
    t.isDark = true;
    t.window = "#14171C";
    t.panel = "#1B1F26";
    t.field = "#262B34";
    t.text = "#E6E9EE";
    t.muted = "#98A2AE";
    t.grid = "#2A303A";
    t.line = "#3A424E";
    t.accent = "#4C9AFF";
    t.onAccent = "#0B1526";
    t.selection = "#22406B";
    t.warning = "#F2C879";
    t.warningGround = "#2A2113";
    t.warningLine = "#6E5523";
    t.error = "#FF8A80";
    t.errorGround = "#2D1A1A";
    t.errorLine = "#7A3B36";
    t.good = "#3FC79A";
    std::copy(darkSeries.begin(), darkSeries.end(), t.seriesColors.begin());
    return t;
}

QColor Theme::pale(const QColor& color, int percent) const {
    const auto mix = [percent](int a, int b) { return (percent * a + (100 - percent) * b) / 100; };
    return {mix(color.red(), panel.red()), mix(color.green(), panel.green()),
            mix(color.blue(), panel.blue())};
}

QColor Theme::ground(QColor color) const {
    constexpr int most = 100;  // black does not become lighter
    for (int i = 0; i < most && contrast(color, onAccent) < 4.5; ++i)
        color = isDark ? color.lighter(103) : color.darker(103);
    return color;
}

SeriesStyle Theme::series(int style) const {
    static const std::array<QList<qreal>, 8> dashes = {{
        {},                      // solid
        {7, 2.5},                // long
        {7, 2.2, 1.6, 2.2},      // dash dot
        {2.6, 2},                // short
        {1.2, 1.8},              // dots
        {12, 2.5},               // very long
        {7, 2, 1.6, 2, 1.6, 2},  // dash dot dot
        {7, 2, 2.6, 2},          // long short
    }};
    if (style == formulaStyle) return {muted, {4.5, 3.5}};
    if (style == exactStyle) return {text, {}};
    const int count = static_cast<int>(dashes.size());
    const int i = std::max(0, style);
    const int turn = i / count;
    return {seriesColors[static_cast<std::size_t>(i % count)],
            dashes[static_cast<std::size_t>((i + 3 * turn) % count)]};
}

namespace {

QFont fontOf(const Theme& theme, double pixels, QFont::Weight weight) {
    QFont font(theme.family.isEmpty() ? loadFonts() : theme.family);
    font.setPixelSize(std::max(6, static_cast<int>(std::lround(pixels))));
    font.setWeight(weight);
    font.setHintingPreference(QFont::PreferNoHinting);
    font.setStyleStrategy(QFont::PreferAntialias);
    return font;
}

}  // namespace

QFont Theme::body() const { return fontOf(*this, 12 * fontScale, QFont::Normal); }
QFont Theme::strong() const { return fontOf(*this, 12 * fontScale, QFont::DemiBold); }
QFont Theme::caption() const { return fontOf(*this, 11 * fontScale, QFont::Normal); }
QFont Theme::title() const { return fontOf(*this, 13 * fontScale, QFont::DemiBold); }
QFont Theme::heading() const { return fontOf(*this, 14 * fontScale, QFont::DemiBold); }

QPalette Theme::palette() const {
    QPalette p;
    p.setColor(QPalette::Window, window);
    p.setColor(QPalette::WindowText, text);
    p.setColor(QPalette::Base, panel);
    p.setColor(QPalette::AlternateBase, field);
    p.setColor(QPalette::Text, text);
    p.setColor(QPalette::PlaceholderText, muted);
    p.setColor(QPalette::Button, panel);
    p.setColor(QPalette::ButtonText, text);
    p.setColor(QPalette::BrightText, error);
    p.setColor(QPalette::ToolTipBase, panel);
    p.setColor(QPalette::ToolTipText, text);
    p.setColor(QPalette::Highlight, accent);
    p.setColor(QPalette::HighlightedText, onAccent);
    p.setColor(QPalette::Link, accent);
    p.setColor(QPalette::LinkVisited, accent);
    p.setColor(QPalette::Light, isDark ? line : panel);
    p.setColor(QPalette::Midlight, grid);
    p.setColor(QPalette::Mid, line);
    p.setColor(QPalette::Dark, isDark ? window : muted);
    p.setColor(QPalette::Shadow, isDark ? QColor("#000000") : line);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        p.setColor(QPalette::Disabled, role, muted);
    p.setColor(QPalette::Disabled, QPalette::Highlight, line);
    return p;
}

QString loadFonts() {
    static const QString family = [] {
        initResources();
        QString name;
        for (const char* file : {"Regular", "Medium", "SemiBold", "Bold"}) {
            const int id =
                QFontDatabase::addApplicationFont(QStringLiteral(":/fonts/Inter-%1.otf").arg(file));
            const QStringList families = QFontDatabase::applicationFontFamilies(id);
            if (name.isEmpty() && !families.isEmpty()) name = families.front();
        }
        return name;
    }();
    return family;
}

void applyTheme(QApplication& application, const Theme& theme) {
    // With a style sheet the style that the application names is not the one that was set.
    constexpr const char* isSet = "hasFusion";
    if (!application.property(isSet).toBool())
        QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    application.setProperty(isSet, true);
    // Qt replaces a sheet by one for each widget and again for each of its parents; taken away and set, it
    // is a fifth of the work.
    application.setStyleSheet(QString());
    QApplication::setPalette(theme.palette());
    QApplication::setFont(theme.body());
    application.setStyleSheet(theme.styleSheet());
}

void repolish(QWidget& widget) {
    widget.style()->unpolish(&widget);
    widget.style()->polish(&widget);
    widget.update();
}

double contrast(const QColor& a, const QColor& b) {
    const auto luminance = [](const QColor& c) {
        const auto linear = [](double s) {
            return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
    };
    const double la = luminance(a), lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

}  // namespace extremal
