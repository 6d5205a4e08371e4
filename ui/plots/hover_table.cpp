// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/hover_table.hpp"

#include <algorithm>
#include <cmath>

#include "engine/figure/sample.hpp"
#include "ui/base/theme.hpp"

namespace extremal {
namespace {

constexpr int mostRows = 12, fromPointer = 14;

QString sixDigits(double value) { return QString::number(value, 'g', 6).replace('-', QChar(0x2212)); }

std::optional<double> seriesValueAt(const Series& series, double t) {
    const auto point = pointAt(series, t);
    return point && std::isfinite(point->second) ? std::optional(point->second) : std::nullopt;
}

}  // namespace

QString valuesAt(const Figure& figure, double t, std::optional<double> pinned, const std::string& nearest,
                 const Theme& theme) {
    const QString unit = QString::fromStdString(figure.x.title).section('[', 1).section(']', 0, 0);
    QString text =
        QStringLiteral("<table cellspacing='0' cellpadding='1'><tr><td><b>t = %1%2</b></td><td></td>")
            .arg(sixDigits(t), unit.isEmpty() ? QString() : " " + unit.toHtmlEscaped());
    if (pinned)
        text += QStringLiteral("<td align='right'>&nbsp;&nbsp;<b>%1</b></td>")
                    .arg(HoverTable::tr("from t = %1").arg(sixDigits(*pinned)));
    text += "</tr>";
    int rows = 0, left = 0;
    bool isSparse = false;
    for (const Series& series : figure.series()) {
        const auto value = seriesValueAt(series, t);
        if (!value) continue;
        if (++rows > mostRows) {
            ++left;
            continue;
        }
        isSparse = isSparse || series.isSparse;
        const bool isNearest = !nearest.empty() && series.label == nearest;
        const QString open = isNearest ? QStringLiteral("<b>") : QString(),
                      close = isNearest ? QStringLiteral("</b>") : QString();
        text +=
            QStringLiteral(
                "<tr><td><span style='color:%1'>●</span> %2%3%4&nbsp;&nbsp;</td>"
                "<td align='right'>%2%5%4</td>")
                .arg(theme.series(series.style).color.name(), open,
                     QString::fromStdString(seriesName(series)).toHtmlEscaped(), close, sixDigits(*value));
        if (pinned) {
            const auto before = seriesValueAt(series, *pinned);
            text += QStringLiteral("<td align='right'>&nbsp;&nbsp;%1</td>")
                        .arg(before ? (*value >= *before ? "+" : "") + sixDigits(*value - *before) : "–");
        }
        text += "</tr>";
    }
    text += "</table>";
    if (rows == 0) return {};
    if (left > 0) text += HoverTable::tr("and %n more", nullptr, left) + "<br>";
    return text + QStringLiteral("<span style='color:%1'>%2</span>")
                      .arg(theme.muted.name(), isSparse ? HoverTable::tr("the nearest sample")
                                                        : HoverTable::tr("between samples: a straight line"));
}

HoverTable::HoverTable(QWidget* plot) : QLabel(plot), plot_(plot) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setTextFormat(Qt::RichText);
    setObjectName("hoverTable");
    setFocusPolicy(Qt::NoFocus);
    hide();
}

void HoverTable::show(const Figure& figure, double t, std::optional<double> pinned,
                      const std::string& nearest, const Theme& theme) {
    const QString text = valuesAt(figure, t, pinned, nearest, theme);
    if (text.isEmpty()) return hide();
    if (parentWidget() != plot_->window()) setParent(plot_->window());
    setFont(theme.caption());
    setStyleSheet(QStringLiteral("QLabel#hoverTable { background: %1; color: %2; border: 1px solid %3; "
                                 "border-radius: 5px; padding: 3px 6px; }")
                      .arg(theme.panel.name(), theme.text.name(), theme.line.name()));
    setText(text);
    adjustSize();
    setVisible(true);
    raise();
}

/// To the right of the pointer if there is room, and never under it.
void HoverTable::placeBeside(QPoint pointer) {
    const QSize room = parentWidget()->size();
    const int right = pointer.x() + fromPointer, left = pointer.x() - fromPointer - width();
    const int x = right + width() <= room.width() || left < 0 ? right : left;
    move(x, std::clamp(pointer.y() - height() / 2, 0, std::max(0, room.height() - height())));
}

}  // namespace extremal
