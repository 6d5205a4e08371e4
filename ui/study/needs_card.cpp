// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/needs_card.hpp"

#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/problem.hpp"
#include "ui/base/format.hpp"
#include "ui/base/theme.hpp"
#include "ui/base/sideways_area.hpp"
#include "ui/study/metric_box.hpp"
#include "ui/study/study_edits.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr double firstSeconds = 1, moreSeconds = 4;  // of a search, and of one that was not enough

QString wishText(double wish) { return shortNumber(wish, 1); }

/// A search that ended by its time may find more.
bool isOutOfTime(const NeedsJob& job) {
    return !job.rungs().empty() && !job.rungs().back().isReached &&
           job.rungs().back().reason.startsWith(QStringLiteral("the search ended"));
}

}  // namespace

NeedsStep::NeedsStep(QWidget* parent) : QAbstractButton(parent) {
    setObjectName("needsStep");
    setFocusPolicy(Qt::TabFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void NeedsStep::setTheme(const Theme& theme) {
    theme_ = &theme;
    updateGeometry();
    update();
}

QSize NeedsStep::sizeHint() const {
    const int line =
        theme_ ? QFontMetrics(theme_->strong()).height() + QFontMetrics(theme_->caption()).height() : 30;
    constexpr int around = 14;
    return {200, line + around};
}

void NeedsStep::show(const NeedsRung& rung, const NeedsAnswer& answer, double share, bool isChosen) {
    isReached_ = rung.isReached;
    isChosen_ = isChosen;
    share_ = share;
    const QString wish = wishText(isChosen ? answer.wish : rung.smallest());
    title_ = QStringLiteral("%1   %2").arg(wish, rung.title);
    cost_ = rung.isReached ? shortTime(answer.seconds) : QString();
    const QString place = rung.model.section(QStringLiteral(" in place of "), 1);
    left_ = !rung.isReached   ? tr("not reached: %1").arg(rung.reason)
            : place.isEmpty() ? answer.kept
                              : tr("in place of %1, %2").arg(place, answer.kept);
    times_ = rung.timesAbove > 0 ? QStringLiteral("× %1").arg(shortNumber(rung.timesAbove)) : QString();
    setEnabled(rung.isReached);
    setCursor(rung.isReached ? Qt::PointingHandCursor : Qt::ArrowCursor);
    QStringList said{
        rung.isReached ? tr("Down to an error of %1: %2, %3; %4, measured error %5.")
                             .arg(wishText(answer.wish), rung.title, left_, cost_, shortNumber(answer.error))
                       : tr("An error of %1 is not reached: %2. The nearest is %3 with %4.")
                             .arg(wishText(answer.wish), rung.reason, rung.title, shortNumber(answer.error))};
    if (rung.timesAbove > 0)
        said << tr("%1 times the cost of the step above.").arg(shortNumber(rung.timesAbove));
    if (isChosen) said << tr("It is the cheapest for the wanted error.");
    setAccessibleName(said.join(' '));
    if (rung.isReached) said << tr("A click puts it into the scene.");
    setToolTip(said.join(' '));
    update();
}

/// Enter is a click, as Space is.
void NeedsStep::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
    QAbstractButton::keyPressEvent(event);
}

void NeedsStep::paintEvent(QPaintEvent*) {
    if (!theme_) return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    painter.setPen(hasFocus() ? QPen(theme_->accent, 1.5) : QPen(Qt::NoPen));
    painter.setBrush(isChosen_ || (underMouse() && isEnabled()) ? theme_->selection
                                                                : QColor(Qt::transparent));
    painter.drawRoundedRect(box, 4, 4);
    // The tread: as long as the cost is high, on a logarithmic scale.
    painter.setPen(Qt::NoPen);
    painter.setBrush(isReached_ ? theme_->accent : theme_->line);
    constexpr double tread = 2;
    painter.drawRoundedRect(QRectF(6, height() - tread - 2, std::max(6.0, share_ * (width() - 12)), tread), 1,
                            1);
    const QFontMetrics strong(theme_->strong()), caption(theme_->caption());
    const int room = width() - 12, first = 4 + strong.ascent(),
              second = 4 + strong.height() + caption.ascent();
    const auto line = [&](const QFontMetrics& metrics, int y, const QString& left, const QString& right,
                          const QColor& ofLeft, const QColor& ofRight) {
        const int width = right.isEmpty() ? 0 : metrics.horizontalAdvance(right) + 8;
        painter.setPen(ofRight);
        if (!right.isEmpty()) painter.drawText(6 + room - metrics.horizontalAdvance(right), y, right);
        painter.setPen(ofLeft);
        painter.drawText(6, y, metrics.elidedText(left, Qt::ElideRight, room - width));
    };
    painter.setFont(theme_->strong());
    line(strong, first, title_, cost_, isReached_ ? theme_->text : theme_->muted, theme_->text);
    painter.setFont(theme_->caption());
    line(caption, second, left_, times_, theme_->muted, theme_->muted);
}

NeedsCard::NeedsCard(Workspace& workspace, Wanted& wanted, const Theme& theme, QWidget* parent)
    : Card(tr("What it needs"), parent),
      workspace_(workspace),
      wanted_(wanted),
      theme_(&theme),
      job_(new NeedsJob(this)) {
    setObjectName("needs");
    measure_ = new QPushButton(tr("Measure"));
    measure_->setObjectName("measureNeeds");
    measure_->setFocusPolicy(Qt::TabFocus);
    measure_->setToolTip(
        tr("Searches all models and schemes for the cheapest at each error, for a second (Ctrl+Shift+L)"));
    header()->addWidget(measure_);
    metric_ = new MetricBox;
    metric_->setAccessibleName(tr("What the error is of"));
    metric_->setToolTip(
        tr("What must come out right: an error that is wanted of one coordinate alone may need "
           "less of the model"));
    body()->addWidget(metric_);
    progress_ = new QProgressBar;
    progress_->setTextVisible(false);
    progress_->setRange(0, 1000);
    progress_->hide();
    body()->addWidget(progress_);
    state_ = makeWrappedLabel({}, "caption");
    state_->setObjectName("needsState");
    body()->addWidget(state_);
    stair_ = new SidewaysArea;
    auto* const inside = new QWidget;
    inside->setProperty("ground", "panel");
    treads_ = new QVBoxLayout(inside);
    treads_->setContentsMargins(0, 0, 0, 0);
    treads_->setSpacing(3);
    stair_->setWidget(inside);
    stair_->hide();
    body()->addWidget(stair_);
    body()->setSpacing(3);
    connect(measure_, &QPushButton::clicked, this, &NeedsCard::measure);
    connect(metric_, &QComboBox::currentIndexChanged, this, &NeedsCard::showJob);
    connect(job_, &NeedsJob::changed, this, &NeedsCard::showJob);
    connect(&wanted_, &Wanted::changed, this, &NeedsCard::showSteps);
    connect(&workspace_, &Workspace::opened, job_, &NeedsJob::clear);
    connect(&workspace_, &Workspace::sceneChanged, this, &NeedsCard::showScene);
    showJob();
}

void NeedsCard::setTheme(const Theme& theme) {
    theme_ = &theme;
    for (NeedsStep* step : steps_) step->setTheme(theme);
}

void NeedsCard::showScene() {
    if (!workspace_.hasScene()) return;
    metric_->offer(*workspace_.resolved());
    showJob();
}

void NeedsCard::measure() {
    if (!workspace_.hasScene() || stop()) return;
    if (metric_->currentText().isEmpty())
        return emit problemFound(tr("This system has nothing that could be wanted exact"),
                                 tr("a reference in the scene"));
    const std::string metric = metric_->currentText().toStdString();
    const bool isMore = isOutOfTime(*job_) && job_->isOf(workspace_.scene()) && job_->metric() == metric;
    job_->start(workspace_.resolved(), metric, isMore ? moreSeconds : firstSeconds);
}

bool NeedsCard::stop() {
    if (!job_->isRunning()) return false;
    job_->stop();
    return true;
}

QString NeedsCard::stateText() const {
    if (!job_->problem().isEmpty()) return job_->problem();
    if (job_->isRunning() && job_->rungs().empty())
        return tr("computing the reference, and trying all schemes");
    if (job_->isRunning()) return tr("searching");
    if (job_->rungs().empty())
        return job_->wasStopped() ? tr("stopped")
                                  : tr("Which model and which scheme are enough for each error, and what the "
                                       "next digits cost.");
    if (!workspace_.hasScene() || !job_->isOf(workspace_.scene()))
        return tr("of an earlier version of the scene");
    if (metric_->currentText().toStdString() != job_->metric())
        return tr("of the metric %1").arg(QString::fromStdString(job_->metric()));
    return job_->wasStopped() ? tr("stopped") : QString();
}

void NeedsCard::showJob() {
    const bool isMore =
        !job_->isRunning() && isOutOfTime(*job_) && workspace_.hasScene() && job_->isOf(workspace_.scene()) &&
        metric_->currentText().toStdString() == job_->metric() && job_->seconds() < moreSeconds;
    measure_->setText(job_->isRunning() ? tr("Stop") : isMore ? tr("Search on") : tr("Measure"));
    progress_->setVisible(job_->isRunning());
    progress_->setValue(static_cast<int>(1000 * job_->fraction()));
    const QString state = stateText();
    state_->setText(state);
    state_->setVisible(!state.isEmpty());
    showSteps();
}

void NeedsCard::showSteps() {
    const std::vector<NeedsRung>& rungs = job_->rungs();
    while (steps_.size() < rungs.size()) {
        auto* const step = steps_.emplace_back(new NeedsStep);
        step->setTheme(*theme_);
        treads_->addWidget(step);
        connect(step, &QAbstractButton::clicked, this, [this, place = steps_.size() - 1] { use(place); });
    }
    stair_->setVisible(!rungs.empty());
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const NeedsRung& rung : rungs)
        if (rung.isReached) {
            least = std::min(least, rung.answers.front().seconds);
            most = std::max(most, rung.answers.back().seconds);
        }
    double above = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        steps_[i]->setVisible(i < rungs.size());
        if (i >= rungs.size()) continue;
        const bool isChosen = rungs[i].serves(wanted_.error(), above);
        const NeedsAnswer& answer = isChosen ? rungs[i].answerFor(wanted_.error()) : rungs[i].answers.back();
        constexpr double shortest = 0.08;
        const double share =
            rungs[i].isReached && most > least
                ? shortest + (1 - shortest) * std::log(answer.seconds / least) / std::log(most / least)
                : shortest;
        steps_[i]->show(rungs[i], answer, std::clamp(share, shortest, 1.0), isChosen);
        above = rungs[i].smallest();
    }
}

std::vector<NeedsStep*> NeedsCard::steps() const {
    std::vector<NeedsStep*> all;
    for (NeedsStep* step : steps_)
        if (!step->isHidden()) all.push_back(step);
    return all;
}

void NeedsCard::use(std::size_t place) {
    if (place >= job_->rungs().size()) return;
    const NeedsRung& rung = job_->rungs()[place];
    const NeedsAnswer answer =
        steps_[place]->isChosen() ? rung.answerFor(wanted_.error()) : rung.answers.back();
    const QString what = tr("%1, %2").arg(rung.title, stepText(answer.scheme));
    const std::vector<Problem> problems =
        workspace_.tryEdit(editsForScheme(workspace_.scene(), answer.scheme), tr("Use what is enough"));
    if (!problems.empty())
        return emit problemFound(tr("%1 cannot be put into the scene: %2")
                                     .arg(what, QString::fromStdString(problems.front().message)),
                                 QString::fromStdString(problems.front().hint));
    workspace_.selectScheme(indexOfScheme(workspace_.scene(), answer.scheme.label));
    emit used(what);
}

}  // namespace extremal
