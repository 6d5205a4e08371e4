// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/inspector_window.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPointer>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/inspect/step_inspection.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/text/text_view.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr int plotsInRow = 2, plotHeight = 230, pauseMs = 150;

}  // namespace

InspectorWindow::InspectorWindow(Workspace& workspace, RunControl& run, Playback& playback,
                                 const Theme& theme, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), run_(run), playback_(playback), theme_(theme) {
    setUpToolWindow(*this, "inspector", tr("One step"), "framework#element-by-element-or-node-by-node",
                    {1280, 820});
    closeOnEscape(*this);
    auto* layout = new QVBoxLayout(this);
    title_ = makeLabel({}, "heading", this);
    layout->addWidget(title_);
    auto* splitter = new QSplitter;
    splitter->setChildrenCollapsible(false);
    auto* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("Step"));
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    auto* inside = new QWidget;
    inside->setProperty("ground", "window");
    grid_ = new QGridLayout(inside);
    grid_->setContentsMargins(0, 0, 2, 0);
    grid_->setSpacing(10);
    scroll->setWidget(inside);
    text_ = new TextView;
    text_->setAccessibleName(tr("Equations of the step"));
    splitter->addWidget(scroll);
    splitter->addWidget(text_);
    splitter->setStretchFactor(0, 3);
    splitter->setStretchFactor(1, 2);
    splitter->setSizes({760, 500});
    layout->addWidget(splitter, 1);
    timer_.setSingleShot(true);
    timer_.setInterval(pauseMs);
    connect(&timer_, &QTimer::timeout, this, &InspectorWindow::inspect);
    const auto later = [this] {
        if (isVisible()) timer_.start();
    };
    connect(&workspace_, &Workspace::selectionChanged, this, later);
    connect(&run_, &RunControl::resultsChanged, this, later);
    connect(&playback_, &Playback::timeChanged, this, later);
}

InspectorWindow::~InspectorWindow() { stop_.request_stop(); }

void InspectorWindow::open() {
    bringToFront(*this);
    inspect();
}

void InspectorWindow::setTheme(const Theme& theme) {
    theme_ = theme;
    for (PlotWidget* plot : plots_) plot->setTheme(theme);
}

void InspectorWindow::inspect() {
    stop_.request_stop();
    stop_ = std::stop_source();
    const auto results = run_.results();
    const SchemeResult* chosen = nullptr;
    if (results && workspace_.hasScene()) {
        const auto& schemes = workspace_.scene().schemes;
        const int selected = workspace_.selectedScheme();
        for (const auto& s : results->schemes)
            if (!chosen || (selected >= 0 && static_cast<std::size_t>(selected) < schemes.size() &&
                            s->spec.label == schemes[static_cast<std::size_t>(selected)].label))
                chosen = s.get();
    }
    if (!chosen) return say(tr("There are no results yet: run the scene first."));
    isWaiting_ = true;
    runInBackground([self = QPointer(this), results, chosen, t = playback_.time(), stop = stop_.get_token()] {
        auto step = std::make_shared<StepInspection>();
        QString problem;
        try {
            const ResolvedScene scene = resolve(results->scene);
            const auto place =
                std::find_if(scene.schemes.begin(), scene.schemes.end(),
                             [&](const ResolvedScheme& s) { return s.spec.label == chosen->spec.label; });
            if (place == scene.schemes.end()) return;
            *step = inspectStep(scene, static_cast<std::size_t>(place - scene.schemes.begin()),
                                stateBefore(scene, *chosen, t), stop);
        } catch (const std::exception& e) {
            problem = QString::fromUtf8(e.what());
        }
        sendToWindow([self, step, problem, stop] {
            if (!self || stop.stop_requested()) return;
            self->isWaiting_ = false;
            if (problem.isEmpty())
                self->show(*step);
            else
                self->say(problem);
        });
    });
}

void InspectorWindow::say(const QString& text) {
    isWaiting_ = false;
    title_->setText(text);
    text_->clear();
    for (PlotWidget* plot : plots_) plot->parentWidget()->deleteLater();
    plots_.clear();
    emit shown();
}

/// Plots stay where they are, with their zoom, while the step has as many.
void InspectorWindow::show(const StepInspection& step) {
    setWindowTitle(tr("One step: %1").arg(QString::fromStdString(step.page.title)));
    title_->setText(tr("One step of %1, from t = %2")
                        .arg(QString::fromStdString(step.page.title),
                             QString::fromStdString(formatNumber(step.from.t, 6))));
    while (plots_.size() > step.figures.size()) {
        plots_.back()->parentWidget()->deleteLater();
        plots_.pop_back();
    }
    while (plots_.size() < step.figures.size()) {
        auto* card = new Card({}, grid_->parentWidget());
        auto* plot = new PlotWidget(theme_, card);
        plot->setMinimumHeight(plotHeight);
        card->body()->addWidget(plot, 1);
        const int place = static_cast<int>(plots_.size());
        grid_->addWidget(card, place / plotsInRow, place % plotsInRow);
        plots_.push_back(plot);
    }
    for (std::size_t i = 0; i < plots_.size(); ++i) {
        auto* card = qobject_cast<Card*>(plots_[i]->parentWidget());
        card->setTitle(QString::fromStdString(step.figures[i].title));
        card->setSubtitle(QString::fromStdString(step.figures[i].subtitle));
        plots_[i]->setFigure(step.figures[i]);
    }
    const int place = text_->verticalScrollBar()->value();
    text_->showPage(step.page);
    text_->verticalScrollBar()->setValue(place);
    emit shown();
}

}  // namespace extremal
