// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_overlay.hpp"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <QStringList>

#include <algorithm>
#include <cmath>
#include <variant>

#include "engine/core/text/text.hpp"
#include "ui/base/theme.hpp"
#include "ui/stage/stage_inset.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {
namespace {

Rgb toRgb(const QColor& c) {
    return {static_cast<float>(c.redF()), static_cast<float>(c.greenF()), static_cast<float>(c.blueF())};
}

QString withUnit(const QString& number, const StagePlayer& player) {
    return player.timeUnit().empty() ? number
                                     : number + QLatin1Char(' ') + QString::fromStdString(player.timeUnit());
}

/// Amber chips at the top, one a failure; those that do not fit are counted.
void paintNotes(QPainter& painter, const QRectF& area, const StageFrame& frame, const Theme& theme) {
    const QFontMetricsF metrics(theme.caption());
    painter.setFont(theme.caption());
    const double lineHeight = metrics.height() + 8;
    double y = area.top() + 8;
    for (std::size_t i = 0; i < frame.notes.size(); ++i) {
        const bool isLast = y + 2 * (lineHeight + 4) > area.center().y() && i + 1 < frame.notes.size();
        QString text = isLast ? QStringLiteral("%1 more").arg(frame.notes.size() - i)
                              : QString::fromStdString(frame.notes[i]);
        text = metrics.elidedText(text, Qt::ElideRight, area.width() - 36);
        const QRectF chip(area.left() + 10, y, metrics.horizontalAdvance(text) + 16, lineHeight);
        painter.setPen(QPen(theme.warningLine, 1));
        painter.setBrush(theme.warningGround);
        painter.drawRoundedRect(chip.adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
        painter.setPen(theme.warning);
        painter.drawText(chip, Qt::AlignCenter, text);
        if (isLast) return;
        y += lineHeight + 4;
    }
}

void paintLegend(QPainter& painter, const QRectF& area, const StageFrame& frame, const Theme& theme) {
    const QFontMetricsF metrics(theme.caption());
    double widest = 0;
    for (const StageLayer& layer : frame.layers)
        widest = std::max(widest, metrics.horizontalAdvance(QString::fromStdString(layer.label)));
    const double row = metrics.height() + 3, text = std::min(widest, area.width() / 2);
    double y = area.top() + 8;
    painter.setFont(theme.caption());
    for (const StageLayer& layer : frame.layers) {
        if (y + row > area.bottom() - row) break;
        const double x = area.right() - 12 - text;
        painter.setPen(Qt::NoPen);
        painter.setBrush(QColor::fromRgbF(layer.colour.r, layer.colour.g, layer.colour.b));
        painter.drawEllipse(QPointF(x - 10, y + row / 2), 4, 4);
        painter.setPen(layer.hasEnded ? theme.muted : theme.text);
        painter.drawText(QRectF(x, y, text + 1, row), Qt::AlignVCenter | Qt::AlignLeft,
                         metrics.elidedText(QString::fromStdString(layer.label), Qt::ElideRight, text));
        y += row;
    }
}

void paintWord(QPainter& painter, const QRectF& area, const Camera& camera, const Word& word,
               const QColor& colour) {
    const Point seen = camera.project(word.centre);
    const QPointF at(area.center().x() + seen[0], area.center().y() - seen[1]);
    if (!area.adjusted(8, 8, -8, -8).contains(at)) return;
    painter.setPen(colour);
    painter.drawText(QRectF(at - QPointF(60, 12), QSizeF(120, 24)), Qt::AlignCenter,
                     QString::fromStdString(word.text));
}

/// Names of axes: space's, and those of the first scheme's body.
void paintWords(QPainter& painter, const QRectF& area, const Camera& camera, const StageFrame& frame,
                const Theme& theme) {
    painter.setFont(theme.caption());
    for (const Shape& shape : frame.scenery)
        if (const auto* word = std::get_if<Word>(&shape))
            paintWord(painter, area, camera, *word, theme.muted);
    if (frame.layers.empty()) return;
    const StageLayer& first = frame.layers.front();
    const QColor colour = QColor::fromRgbF(first.colour.r, first.colour.g, first.colour.b);
    for (const Shape& shape : first.shapes)
        if (const auto* word = std::get_if<Word>(&shape)) paintWord(painter, area, camera, *word, colour);
}

/// The inset's title below it, and the names of its axes.
void paintInsetWords(QPainter& painter, const QRectF& area, const Camera& camera, const StageFrame& frame,
                     const Theme& theme) {
    const InsetPlace place(frame, camera, area.width(), area.height());
    const Point seen = camera.project(place.centre());
    painter.setFont(theme.caption());
    for (const Shape& shape : frame.inset->backdrop)
        if (const auto* word = std::get_if<Word>(&shape)) {
            const Word placed{place.map(word->centre), word->text};
            QColor colour = theme.muted;
            if (camera.project(placed.centre)[2] < seen[2]) colour.setAlphaF(0.45f);
            paintWord(painter, area, camera, placed, colour);
        }
    const double below = InsetPlace::corner(area.width(), area.height()) / 2;
    painter.setPen(theme.muted);
    painter.drawText(
        QRectF(area.center().x() + seen[0] - below, area.center().y() - seen[1] + below - 6, 2 * below, 18),
        Qt::AlignCenter, QString::fromStdString(frame.inset->title));
}

}  // namespace

StageStyle stageStyle(const Theme& theme) {
    StageStyle style;
    style.background = toRgb(theme.panel);
    style.scenery = toRgb(theme.muted);
    style.grid = toRgb(theme.grid);
    for (const QColor& c : theme.seriesColors) style.series.push_back(toRgb(c));
    return style;
}

QString timeText(double t, const StagePlayer& player) {
    const double range = std::max(std::abs(player.end()), std::abs(player.start()));
    const int digits =
        range > 0 ? std::clamp(3 - static_cast<int>(std::ceil(std::log10(range) - 1e-9)), 0, 9) : 2;
    return withUnit(QStringLiteral("t = %1").arg(t, 0, 'f', digits), player);
}

QString stageSummary(const StagePlayer& player) {
    if (!player.hasStage()) return QStringLiteral("Stage: nothing to draw.");
    QStringList labels;
    QStringList failed;
    for (const auto& scheme : player.comparison()->schemes) {
        const QString label = QString::fromStdString(scheme->spec.label);
        labels << label;
        if (scheme->summary.status == RunStatus::failed) failed << label;
    }
    QString text = QStringLiteral("Animated picture of %1 from %2 to %3.")
                       .arg(labels.join(QStringLiteral(", ")), timeText(player.start(), player),
                            timeText(player.end(), player));
    if (!failed.isEmpty()) text += QStringLiteral(" Failed: %1.").arg(failed.join(QStringLiteral(", ")));
    return text;
}

void paintOverlay(QPainter& painter, const QRectF& area, const StageFrame& frame, const StagePlayer& player,
                  const Theme& theme, const OverlayOptions& options) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(theme.caption());
    const QFontMetricsF metrics(theme.caption());
    const double baseline = area.bottom() - 10;
    const QString now = timeText(frame.t, player);
    painter.setPen(theme.text);
    painter.drawText(QPointF(area.left() + 12, baseline), now);
    const QString trail = withUnit(
        QStringLiteral("trail %1").arg(QString::fromStdString(formatNumber(frame.trailSpan, 3))), player);
    const double x = area.left() + 12 + metrics.horizontalAdvance(now) + 16;
    if (frame.trailSpan > 0 && x + metrics.horizontalAdvance(trail) < area.right()) {
        painter.setPen(theme.muted);
        painter.drawText(QPointF(x, baseline), trail);
    }
    if (options.camera) paintWords(painter, area, *options.camera, frame, theme);
    if (options.camera && frame.inset) paintInsetWords(painter, area, *options.camera, frame, theme);
    if (options.hasLegend) paintLegend(painter, area, frame, theme);
    paintNotes(painter, area, frame, theme);
    painter.restore();
}

}  // namespace extremal
