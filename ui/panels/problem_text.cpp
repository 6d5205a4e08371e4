#include "ui/panels/problem_text.hpp"

#include <QCoreApplication>
#include <QLabel>
#include <QVariant>

#include "engine/scene/topics.hpp"
#include "ui/panels/card.hpp"

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

QLabel* makeLinkLabel(const char* role, QWidget* parent) {
    QLabel* label = makeLabel({}, role, parent);
    label->setTextFormat(Qt::RichText);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard |
                                   Qt::TextSelectableByMouse);
    label->setOpenExternalLinks(true);  // "handbook:" is the window's
    return label;
}

void setHelp(QWidget& widget, const std::string& place) {
    widget.setProperty("help", place.empty() ? QVariant() : QVariant(QString::fromStdString(place)));
}

}  // namespace extremal
