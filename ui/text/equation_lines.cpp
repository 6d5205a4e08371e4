// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/equation_lines.hpp"

#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QPointer>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"

namespace extremal {

EquationLines::EquationLines(const QString& tip, QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(5);
    lines_ = makeLabel({}, "body");
    lines_->setObjectName("equations");
    lines_->setAccessibleName(tr("Equations of motion"));
    lines_->setToolTip(tip);
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

void EquationLines::follow(const Settings& model) {
    if (model == followed_) return;
    followed_ = model;
    if (!typed::hasMotionLines(model)) return hide();
    runInBackground([self = QPointer(this), model] {
        std::vector<std::string> lines;
        std::string tex;
        try {
            lines = typed::motionLines(model, typed::TextForm::rich);
            tex = typed::texOfMotion(model);
        } catch (const InvalidScene&) {
        } catch (const ExpressionError&) {
        }
        sendToWindow([self, model, lines = std::move(lines), tex = std::move(tex)] {
            if (self && self->followed_ == model) self->setEquations(lines, tex);
        });
    });
}

}  // namespace extremal
