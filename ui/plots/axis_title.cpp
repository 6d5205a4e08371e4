// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/axis_title.hpp"

#include <qcustomplot.h>

#include <QFontMetricsF>
#include <QRegularExpression>

#include <algorithm>
#include <vector>

namespace extremal {
namespace {

constexpr double smaller = 0.78, lowerBy = 0.22, higherBy = 0.4;  // of the height of the letters
constexpr double normWidth = 6;  // pixels, of the bars of a norm with what is around them

struct Part {
    enum class Kind { plain, lowered, raised, norm } kind;
    QString text;
};

const QRegularExpression& mark() {
    // An index of letters and digits, a norm, and an exponent in brackets, which may hold brackets.
    static const QRegularExpression all(
        QStringLiteral("(?<=[^\\W_])_([^\\W_]+)|(\u2016)|\\^\\(((?:[^()]|\\([^()]*\\))+)\\)"),
        QRegularExpression::UseUnicodePropertiesOption);
    return all;
}

std::vector<Part> partsOf(const QString& title) {
    std::vector<Part> parts;
    qsizetype from = 0;
    for (auto it = mark().globalMatch(title); it.hasNext();) {
        const QRegularExpressionMatch match = it.next();
        parts.push_back({Part::Kind::plain, title.mid(from, match.capturedStart() - from)});
        parts.push_back(match.hasCaptured(1)   ? Part{Part::Kind::lowered, match.captured(1)}
                        : match.hasCaptured(3) ? Part{Part::Kind::raised, match.captured(3)}
                                               : Part{Part::Kind::norm, {}});
        from = match.capturedEnd();
    }
    parts.push_back({Part::Kind::plain, title.mid(from)});
    return parts;
}

QFont smallerFont(QFont font) {
    font.setPixelSize(std::max(6, static_cast<int>(std::lround(smaller * font.pixelSize()))));
    return font;
}

double widthOf(const Part& part, const QFont& font) {
    if (part.kind == Part::Kind::norm) return normWidth;
    return QFontMetricsF(part.kind == Part::Kind::plain ? font : smallerFont(font))
        .horizontalAdvance(part.text);
}

}  // namespace

QString plainTitle(const QString& title) {
    QString plain;
    for (const Part& part : partsOf(title))
        plain += part.kind == Part::Kind::norm ? QStringLiteral("||") : part.text;
    return plain;
}

bool hasOwnParts(const QString& title) { return mark().match(title).hasMatch(); }

void drawTitle(QPainter& painter, const QFont& font, QPointF at, const QString& title) {
    const QFontMetricsF metrics(font);
    for (const Part& part : partsOf(title)) {
        const double width = widthOf(part, font);
        if (part.kind == Part::Kind::norm) {
            const QPen pen = painter.pen();
            painter.setPen(QPen(pen.color(), 1.1));
            for (const double x : {1.6, 4.2})
                painter.drawLine(QPointF(at.x() + x, at.y() - metrics.capHeight() - 1.5),
                                 QPointF(at.x() + x, at.y() + 2));
            painter.setPen(pen);
        } else {
            const double down = part.kind == Part::Kind::lowered  ? lowerBy
                                : part.kind == Part::Kind::raised ? -higherBy
                                                                  : 0;
            painter.setFont(part.kind == Part::Kind::plain ? font : smallerFont(font));
            painter.drawText(at + QPointF(0, down * metrics.ascent()), part.text);
        }
        at.rx() += width;
    }
}

void drawAxisTitle(QCPPainter& painter, const QCPAxis& axis, const QString& title) {
    const QFont font = axis.labelFont();
    const QFontMetricsF metrics(font);
    double width = 0, below = 0;  // what a lowered part takes below the other letters
    for (const Part& part : partsOf(title)) {
        width += widthOf(part, font);
        if (part.kind == Part::Kind::lowered)
            below = std::max(0.0, lowerBy * metrics.ascent() + QFontMetricsF(smallerFont(font)).descent() -
                                      metrics.descent());
    }

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
        painter.translate(rect.left() - away - below, rect.center().y());
        painter.rotate(-90);
    } else {
        painter.translate(rect.center().x(), rect.bottom() + away);
    }
    drawTitle(painter, font, {-width / 2, (metrics.ascent() - metrics.descent()) / 2}, title);
    painter.restore();
}

}  // namespace extremal
