// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/explain.hpp"

#include <QCoreApplication>
#include <QTableWidget>
#include <QToolTip>

#include <cmath>

#include "engine/view/catalog.hpp"
#include "ui/base/format.hpp"
#include "ui/base/plain_tips.hpp"

namespace extremal {
namespace {

QString say(const char* text) { return QCoreApplication::translate("explain", text); }

QString inUnit(const std::string& unit) {
    return unit.empty() ? say("without a unit") : say("in %1").arg(QString::fromStdString(unit));
}

/// How an error stands to what the reference itself is good to.
QString trustIn(double error, const ReferenceInfo& reference) {
    const double floor = reference.estimatedError;
    if (!std::isfinite(floor)) return say("How good the reference is, is not known.");
    if (!std::isfinite(error) || error <= 0)
        return say("The reference is good to %1.").arg(shortNumber(floor));
    if (error > 10 * floor)
        return say("The reference is good to %1: the number is right to %2 %.")
            .arg(shortNumber(floor), shortNumber(100 * floor / error));
    return say("The reference is good to %1: the number is an upper bound at best.").arg(shortNumber(floor));
}

}  // namespace

QString explainCost(const Summary& s) {
    QString text =
        say("CPU time, in seconds and their parts, of the thread in the steps of this scheme alone: neither "
            "plots, nor files, nor the "
            "reference. Short runs are repeated.");
    if (s.steps > 0 && s.cpuSeconds > 0)
        text += '\n' + say("%1 per step.").arg(shortTime(s.cpuSeconds / static_cast<double>(s.steps)));
    if (s.cost.evaluations > 0 && s.steps > 0)
        text += '\n' +
                say("%1 evaluations per step, on average.")
                    .arg(shortNumber(static_cast<double>(s.cost.evaluations) / static_cast<double>(s.steps)));
    return text;
}

QString explainError(const Summary& s, const ReferenceInfo& reference, const std::string& unit) {
    if (reference.type == "none")
        return say("There is no reference, so the error is not known. The button above computes one.");
    const bool isOver = s.status == RunStatus::done || s.status == RunStatus::failed;
    if (isOver && s.steps == 0) return say("No step was taken: there is nothing to measure.");
    QString text = say("Largest distance from the reference over all nodes of the run, %1.\nReference: %2.")
                       .arg(inUnit(unit), QString::fromStdString(reference.description));
    text += '\n' + trustIn(s.maxError, reference);
    if (std::isfinite(s.finalError)) text += '\n' + say("At the end: %1.").arg(shortNumber(s.finalError));
    if (std::isfinite(s.opensAt))
        text +=
            '\n' + say("From t = %1 on this estimate is not to be trusted.").arg(shortNumber(s.opensAt, 3));
    return text;
}

QString explainOrder(const Summary& s) {
    QString text =
        s.orderClaimed > 0
            ? say("The scheme claims the order %1: its error falls as h to this power.").arg(s.orderClaimed)
            : say("The scheme claims no order.");
    if (std::isfinite(s.orderMeasured))
        text += '\n' + say("Measured on this scene: %1.").arg(s.orderMeasured, 0, 'f', 2);
    return text;
}

QString explainSteps(const Summary& s, bool areElements) {
    if (areElements) return say("Number of elements, all of the same length; the problem is solved at once.");
    QString text = say("Number of steps of the run.");
    if (std::isfinite(s.tEnd) && s.steps > 0)
        text += '\n' + say("It has come to t = %1.").arg(shortNumber(s.tEnd, 4));
    return text;
}

QString explainValue(const Figure& figure, const QString& scheme, double t) {
    const QString axis = QString::fromStdString(figure.y.title);
    const std::string unit = axis.section('[', 1).section(']', 0, 0).toStdString();
    QString text = say("%1 of %2 at t = %3, %4.")
                       .arg(axis.section('[', 0, 0).trimmed(), scheme, shortNumber(t, 6), inUnit(unit));
    if (const ViewEntry* view = findView(figure.view))
        text += '\n' + say("Plot: %1.").arg(QString::fromStdString(view->item.description));
    return text + '\n' + say("Between the rows of the run it is read off a straight line.");
}

void explainCellsOf(QTableWidget& table) {
    constexpr int readMs = 15000;
    QObject::connect(&table, &QTableWidget::cellClicked, &table, [&table](int row, int column) {
        const QTableWidgetItem* const item = table.item(row, column);
        if (!item || item->toolTip().isEmpty()) return;
        const QPoint below = table.visualItemRect(item).bottomLeft();
        QToolTip::showText(table.viewport()->mapToGlobal(below), plainTip(item->toolTip()), &table, {},
                           readMs);
    });
}

}  // namespace extremal
