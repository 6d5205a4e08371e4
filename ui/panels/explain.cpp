#include "ui/panels/explain.hpp"

#include <QCoreApplication>

#include <cmath>

#include "ui/panels/format.hpp"

namespace extremal {
namespace {

QString say(const char* text) { return QCoreApplication::translate("explain", text); }

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
        say("CPU time of the thread in the steps of this scheme alone: neither plots, nor files, nor the "
            "reference. Short runs are repeated.");
    if (s.steps > 0 && s.cpuSeconds > 0)
        text += '\n' + say("%1 per step.").arg(shortTime(s.cpuSeconds / static_cast<double>(s.steps)));
    if (s.cost.evaluations > 0 && s.steps > 0)
        text += '\n' +
                say("%1 evaluations per step, on average.")
                    .arg(shortNumber(static_cast<double>(s.cost.evaluations) / static_cast<double>(s.steps)));
    return text;
}

QString explainError(const Summary& s, const ReferenceInfo& reference) {
    if (reference.type == "none") return say("There is no reference, so the error is not known.");
    const bool isOver = s.status == RunStatus::done || s.status == RunStatus::failed;
    if (isOver && s.steps == 0) return say("No step was taken: there is nothing to measure.");
    QString text = say("Largest distance from the reference over all nodes of the run.\nReference: %1.")
                       .arg(QString::fromStdString(reference.description));
    text += '\n' + trustIn(s.maxError, reference);
    if (std::isfinite(s.finalError)) text += '\n' + say("At the end: %1.").arg(shortNumber(s.finalError));
    if (std::isfinite(s.opensAt))
        text +=
            '\n' +
            say("From t = %1 on the error is too large for this estimate.").arg(shortNumber(s.opensAt, 3));
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

QString explainSteps(const Summary& s) {
    QString text = say("Number of steps of the run.");
    if (std::isfinite(s.tEnd) && s.steps > 0)
        text += '\n' + say("It has come to t = %1.").arg(shortNumber(s.tEnd, 4));
    return text;
}

}  // namespace extremal
