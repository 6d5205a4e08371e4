// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/equation_lines.hpp"

#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/base/card.hpp"

namespace extremal {

EquationLines::EquationLines(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(5);
    lines_ = makeLabel({}, "body");
    lines_->setObjectName("equations");
    lines_->setAccessibleName(tr("Equations of motion"));
    lines_->setWordWrap(true);
    lines_->setTextFormat(Qt::RichText);
    lines_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(lines_);
    copy_ = new QToolButton;
    copy_->setObjectName("copyTex");
    copy_->setText(tr("Copy as LaTeX"));
    copy_->setToolTip(tr("The equations of motion for a document"));
    connect(copy_, &QToolButton::clicked, this,
            [this] { QApplication::clipboard()->setText(QString::fromStdString(tex_)); });
    column->addWidget(copy_, 0, Qt::AlignLeft);
    hide();
}

void EquationLines::setEquations(const std::vector<std::string>& lines, const std::string& tex) {
    QString text;
    for (const std::string& line : lines)
        text += "<p style='margin:2px 0'>" + QString::fromStdString(line) + "</p>";
    if (!lines.empty()) {
        lines_->setText(text);
        tex_ = tex;
    }
    setVisible(!lines.empty());
}

void EquationLines::setTip(const QString& tip) { lines_->setToolTip(tip); }

}  // namespace extremal
