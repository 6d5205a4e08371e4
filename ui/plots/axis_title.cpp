#include "ui/plots/axis_title.hpp"

#include <qcustomplot.h>

#include <QFontMetricsF>
#include <QRegularExpression>

#include <algorithm>
#include <vector>

namespace extremal {
namespace {

constexpr double smaller = 0.78, lowerBy = 0.22;  // of the height of the letters

struct Part {
    QString text;
    bool isLowered;
};

const QRegularExpression& mark() {
    static const QRegularExpression all(QStringLiteral(R"((?<=[^\W_])_([^\W_]+))"),
                                        QRegularExpression::UseUnicodePropertiesOption);
    return all;
}

std::vector<Part> partsOf(const QString& title) {
    std::vector<Part> parts;
    qsizetype from = 0;
    for (auto it = mark().globalMatch(title); it.hasNext();) {
        const QRegularExpressionMatch match = it.next();
        parts.push_back({title.mid(from, match.capturedStart() - from), false});
        parts.push_back({match.captured(1), true});
        from = match.capturedEnd();
    }
    parts.push_back({title.mid(from), false});
    return parts;
}

}  // namespace

QString plainTitle(const QString& title) { return QString(title).replace(mark(), QStringLiteral("\\1")); }

bool hasLoweredPart(const QString& title) { return mark().match(title).hasMatch(); }

void drawAxisTitle(QCPPainter& painter, const QCPAxis& axis, const QString& title) {
    const QFont font = axis.labelFont();
    QFont low = font;
    low.setPixelSize(std::max(6, static_cast<int>(std::lround(smaller * font.pixelSize()))));
    const QFontMetricsF metrics(font), lowMetrics(low);
    const std::vector<Part> parts = partsOf(title);
    double width = 0;
    for (const Part& part : parts)
        width += (part.isLowered ? lowMetrics : metrics).horizontalAdvance(part.text);

    // Where the axis puts its label: beyond the ticks and their texts.
    const QFontMetricsF ticks(axis.tickLabelFont());
    const bool isVertical = axis.orientation() == Qt::Vertical;
    double extent = 0;
    for (const QString& text : axis.tickVectorLabels())
        extent = std::max(extent, isVertical ? ticks.horizontalAdvance(text) : ticks.height());
    const double away =
        axis.tickLengthOut() + axis.tickLabelPadding() + extent + axis.labelPadding() + metrics.height() / 2;
    const QRectF rect(axis.axisRect()->rect());
    painter.save();
    if (isVertical) {
        painter.translate(rect.left() - away, rect.center().y());
        painter.rotate(-90);
    } else {
        painter.translate(rect.center().x(), rect.bottom() + away);
    }
    double x = -width / 2;
    const double baseline = (metrics.ascent() - metrics.descent()) / 2;
    for (const Part& part : parts) {
        painter.setFont(part.isLowered ? low : font);
        painter.drawText(QPointF(x, baseline + (part.isLowered ? lowerBy * metrics.ascent() : 0)), part.text);
        x += (part.isLowered ? lowMetrics : metrics).horizontalAdvance(part.text);
    }
    painter.restore();
}

}  // namespace extremal
