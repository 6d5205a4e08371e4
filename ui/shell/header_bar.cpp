#include "ui/shell/header_bar.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include <cmath>

#include "ui/panels/card.hpp"
#include "ui/panels/format.hpp"
#include "ui/panels/seek_slider.hpp"
#include "ui/shell/run_control.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {
namespace {

QPushButton* button(const QString& text, const QString& tip, QWidget* parent) {
    auto* b = new QPushButton(text, parent);
    b->setToolTip(tip);
    b->setFocusPolicy(Qt::TabFocus);
    return b;
}

}  // namespace

HeaderBar::HeaderBar(Workspace& workspace, RunControl& run, QWidget* parent)
    : QWidget(parent), workspace_(workspace), run_(run) {
    setProperty("ground", "panel");
    setAttribute(Qt::WA_StyledBackground);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(18, 9, 14, 9);
    row->setSpacing(8);
    title_ = makeLabel({}, "heading", this);
    file_ = makeLabel({}, "caption", this);
    row->addWidget(title_);
    row->addSpacing(6);
    row->addWidget(file_);
    row->addStretch(1);
    auto* wantedLabel = makeLabel(tr("wanted error"), "caption", this);
    wanted_ = new SeekSlider(Qt::Horizontal, this);
    wanted_->setRange(-14, 0);
    wanted_->setValue(-6);
    wanted_->setMinimumWidth(70);
    wanted_->setMaximumWidth(190);
    wanted_->setAccessibleName(tr("Wanted error"));
    wanted_->setToolTip(
        tr("The largest acceptable error: shows the cheapest scheme measured so far that reaches it"));
    choice_ = makeElidedLabel({}, "strong", this);
    row->addWidget(wantedLabel);
    row->addWidget(wanted_, 1);
    row->addWidget(choice_, 3);
    row->addSpacing(8);
    runButton_ = button(tr("Run"), tr("Compute everything again (R)"), this);
    runButton_->setProperty("kind", "primary");
    runButton_->setObjectName("run");
    auto* step = button(tr("Step"), tr("Next row (Right)"), this);
    auto* save = button(tr("Export"), tr("Export everything into a folder (Ctrl+Shift+E)"), this);
    auto* palette = button(tr("Ctrl+K"), tr("Find an action or a preset"), this);
    for (QPushButton* b : {runButton_, step, save, palette}) row->addWidget(b);
    secondary_ = {step, save};
    connect(runButton_, &QPushButton::clicked, this, [this] {
        if (run_.isRunning())
            emit stopRequested();
        else
            emit runRequested();
    });
    connect(step, &QPushButton::clicked, this, &HeaderBar::stepRequested);
    connect(save, &QPushButton::clicked, this, &HeaderBar::exportRequested);
    connect(palette, &QPushButton::clicked, this, &HeaderBar::paletteRequested);
    connect(wanted_, &QSlider::valueChanged, this, &HeaderBar::showChoice);
    connect(&workspace_, &Workspace::sceneChanged, this, &HeaderBar::showScene);
    connect(&workspace_, &Workspace::fileChanged, this, &HeaderBar::showScene);
    connect(&run_, &RunControl::stateChanged, this, &HeaderBar::showState);
    connect(&run_, &RunControl::resultsChanged, this, &HeaderBar::showChoice);
    showScene();
    showState();
    showChoice();
}

void HeaderBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    constexpr int narrow = 940;  // below, what menus and the title of the window have as well gives way
    file_->setVisible(width() >= narrow);
    for (QPushButton* button : secondary_) button->setVisible(width() >= narrow);
}

void HeaderBar::showScene() {
    const QString title = QString::fromStdString(workspace_.scene().title);
    title_->setText(!workspace_.hasScene() ? tr("Extremal") : title.isEmpty() ? tr("Untitled scene") : title);
    file_->setText(workspace_.hasScene()
                       ? workspace_.fileName() + (workspace_.isDirty() ? tr(" (edited)") : QString())
                       : QString());
}

void HeaderBar::showState() {
    runButton_->setText(run_.isRunning() ? tr("Stop") : tr("Run"));
    runButton_->setEnabled(workspace_.hasScene());
}

void HeaderBar::showChoice() {
    const double wanted = std::pow(10.0, wanted_->value());
    const QString start = QStringLiteral("1e%1").arg(wanted_->value());
    const auto results = run_.results();
    const SchemeResult *cheapest = nullptr, *nearest = nullptr;
    if (results)
        for (const auto& s : results->schemes) {
            const Summary& m = s->summary;
            if (m.status != RunStatus::done || !std::isfinite(m.maxError)) continue;
            if (m.maxError <= wanted && (!cheapest || m.cpuSeconds < cheapest->summary.cpuSeconds))
                cheapest = s.get();
            if (!nearest || m.maxError < nearest->summary.maxError) nearest = s.get();
        }
    QString text = start;
    if (cheapest)
        text += QStringLiteral("  →  %1, %2, %3")
                    .arg(QString::fromStdString(cheapest->summary.label), stepText(cheapest->spec),
                         shortTime(cheapest->summary.cpuSeconds));
    else if (nearest)
        text +=
            tr("  →  no scheme; the closest is %1 with %2")
                .arg(QString::fromStdString(nearest->summary.label), shortNumber(nearest->summary.maxError));
    choice_->setText(text);
}

}  // namespace extremal
