// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/values_table.hpp"

#include <QHeaderView>

#include <algorithm>

#include "engine/figure/sample.hpp"
#include "ui/base/format.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/explain.hpp"

namespace extremal {
ValuesTable::ValuesTable(QWidget* parent) : QTableWidget(parent) {
    setAccessibleName(tr("Values at the cursor"));
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setFocusPolicy(Qt::NoFocus);
    setSelectionMode(QAbstractItemView::NoSelection);
    verticalHeader()->setDefaultSectionSize(22);
    verticalHeader()->setMinimumSectionSize(18);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    setShowGrid(false);
    explainCellsOf(*this);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
}

QSize ValuesTable::sizeHint() const { return {400, 30 + 22 * std::clamp(rowCount(), 1, 8)}; }

void ValuesTable::show(const std::vector<const Figure*>& figures, double t, const Theme& theme) {
    QStringList schemes, titles;
    std::vector<int> styles;
    std::vector<const Figure*> shown;
    for (const Figure* f : figures) {
        if (!f->x.isTime || f->series().empty()) continue;
        shown.push_back(f);
        titles << QString::fromStdString(f->y.title);
        for (const Series& s : f->series())
            if (const QString label = QString::fromStdString(s.label); !schemes.contains(label)) {
                schemes << label;
                styles.push_back(s.style);
            }
    }
    setColumnCount(static_cast<int>(shown.size()));
    setRowCount(static_cast<int>(schemes.size()));
    setHorizontalHeaderLabels(titles);
    setVerticalHeaderLabels(schemes);
    for (int row = 0; row < rowCount(); ++row) {
        const QColor color = theme.series(styles[static_cast<std::size_t>(row)]).color;
        verticalHeaderItem(row)->setForeground(color);
        for (int column = 0; column < columnCount(); ++column) {
            QString text;
            for (const Series& s : shown[static_cast<std::size_t>(column)]->series())
                if (QString::fromStdString(s.label) == schemes[row])
                    if (const auto p = pointAt(s, t)) text = shortNumber(p->second, 6);
            if (!item(row, column)) setItem(row, column, new QTableWidgetItem);
            item(row, column)->setText(text);
            item(row, column)
                ->setToolTip(explainValue(*shown[static_cast<std::size_t>(column)], schemes[row], t));
            item(row, column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        }
    }
    updateGeometry();
}

}  // namespace extremal
