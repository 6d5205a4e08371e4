// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/problem_text.hpp"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QLabel>
#include <QUrl>
#include <QVariant>

#include <algorithm>

#include "engine/core/text/expression.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "ui/base/card.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

QString handbookLink(const std::string& place) {
    if (place.empty()) return {};
    return QStringLiteral("<a href=\"handbook:%1\">%2</a>")
        .arg(QString::fromStdString(place).toHtmlEscaped(),
             QCoreApplication::translate("extremal", "Handbook"));
}

QString problemText(const Problem& problem, const QString& lead) {
    QString text = lead + QString::fromStdString(problem.message);
    if (!problem.hint.empty()) text += " (" + QString::fromStdString(problem.hint) + ")";
    return text.toHtmlEscaped() + QStringLiteral(" ") + handbookLink(handbookPlace(problem));
}

QString refusalText(const Workspace& workspace, const std::string& place) {
    const std::vector<Problem> problems = workspace.refusalAt(place);
    if (problems.empty()) return {};
    const Problem& first = problems.front();
    if (first.pointer == place || first.pointer.starts_with(place + "/")) return problemText(first);
    const QString where = workspace.placeName(first.pointer);
    QString text = problemText(first, where.isEmpty() ? QString() : where + ": ");
    if (problems.size() > 1)
        text += QCoreApplication::translate("extremal", " (and %1 more)").arg(problems.size() - 1);
    return text;
}

bool isSentAway(const QWidget& widget) {
    for (const QWidget* w = &widget; w && !w->isWindow(); w = w->parentWidget())
        if (w->testAttribute(Qt::WA_WState_ExplicitShowHide) && w->isHidden()) return true;
    return false;
}

QLabel* makeLinkLabel(const char* role, QWidget* parent) {
    QLabel* label = makeLabel({}, role, parent);
    label->setTextFormat(Qt::RichText);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard |
                                   Qt::TextSelectableByMouse);
    QObject::connect(label, &QLabel::linkActivated, label, [](const QString& link) {
        const QUrl url(link);  // its texts are escaped, so no other link can be in it
        if (url.scheme() == QLatin1String("handbook")) QDesktopServices::openUrl(url);
    });
    return label;
}

QString caretHtml(const QWidget& field, const std::string& text, std::size_t position, int width) {
    const QFontMetrics metrics(field.font());
    const int columns = std::max(16, width / metrics.horizontalAdvance('x'));
    const auto lines =
        caretLines(text, std::min(position, text.size()), static_cast<std::size_t>(columns / 2 - 4), "");
    return "<pre style='font-family:\"" + field.font().family() +
           "\";font-size:" + QString::number(QFontInfo(field.font()).pixelSize()) + "px;margin:0'>" +
           QString::fromStdString(lines).toHtmlEscaped() + "</pre>";
}

void setHelp(QWidget& widget, const std::string& place) {
    widget.setProperty("help", place.empty() ? QVariant() : QVariant(QString::fromStdString(place)));
}

}  // namespace extremal
