// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/copies_window.hpp"

#include <QLabel>
#include <QPointer>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "engine/inspect/separation.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

CopiesWindow::CopiesWindow(Workspace& workspace, Playback& playback, const Theme& theme, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), playback_(playback) {
    setUpToolWindow(*this, "copies", tr("Perturb and watch"), "structure#regular-or-chaotic", {900, 820});
    closeOnEscape(*this);
    auto* column = new QVBoxLayout(this);
    auto* row = new QHBoxLayout;
    title_ = makeElidedLabel({}, "heading", this);
    row->addWidget(title_, 1);
    row->addWidget(makeLabel(tr("first coordinate moved by 10 to the power of"), "caption", this));
    digits_ = new QSpinBox(this);
    digits_->setRange(-14, 0);
    digits_->setValue(-6);
    digits_->setAccessibleName(tr("Exponent of the shift"));
    connect(digits_, &QSpinBox::valueChanged, this, &CopiesWindow::compute);
    row->addWidget(digits_);
    column->addLayout(row);
    auto* stageCard = new Card(tr("Stage"), this);
    stage_ = new StageWidget(stageCard);
    stage_->setTheme(theme);
    stageCard->body()->addWidget(stage_, 1);
    column->addWidget(stageCard, 3);
    auto* plotCard = new Card(tr("Distance"), this);
    plot_ = new PlotWidget(theme, plotCard);
    plotCard->body()->addWidget(plot_, 1);
    column->addWidget(plotCard, 2);
    connect(&playback_, &Playback::timeChanged, this, [this](double t) {
        stage_->setTime(t);
        plot_->setCursor(t);
    });
    connect(plot_, &PlotWidget::cursorMoved, &playback_, &Playback::setTime);
    const auto again = [this] {
        if (isVisible()) compute();
    };
    connect(&workspace_, &Workspace::sceneChanged, this, again);
    connect(&workspace_, &Workspace::selectionChanged, this, again);
}

void CopiesWindow::open() {
    bringToFront(*this);
    compute();
}

void CopiesWindow::setTheme(const Theme& theme) {
    stage_->setTheme(theme);
    plot_->setTheme(theme);
}

void CopiesWindow::compute() {
    if (!workspace_.hasScene() || workspace_.scene().schemes.empty()) return;
    isWaiting_ = true;
    runInBackground([self = QPointer(this), scene = workspace_.scene(), number = ++asked_,
                     scheme = static_cast<std::size_t>(std::max(0, workspace_.selectedScheme())),
                     shift = std::pow(10.0, digits_->value())] {
        auto separation = std::make_shared<Separation>();
        QString problem;
        try {
            *separation = separationOf(scene, scheme, shift);
        } catch (const std::exception& e) {
            problem = QString::fromUtf8(e.what());
        }
        sendToWindow([self, separation, problem, number] {
            if (!self || self->asked_ != number) return;
            self->isWaiting_ = false;
            if (problem.isEmpty()) return self->show(*separation);
            self->title_->setText(problem);
            self->stage_->setComparison({});
            self->plot_->setFigure({});
        });
    });
}

void CopiesWindow::show(const Separation& separation) {
    title_->setText(QString::fromStdString(separation.pair.schemes.front()->spec.label) + "  ·  " +
                    QString::fromStdString(separation.distance.subtitle));
    stage_->setComparison(std::make_shared<const Comparison>(separation.pair));
    stage_->setTime(playback_.time());
    plot_->setFigure(separation.distance);
    plot_->setCursor(playback_.time());
}

}  // namespace extremal
