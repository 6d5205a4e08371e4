// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/race_window.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/seek_slider.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/wanted.hpp"

namespace extremal {
namespace {

constexpr int tickMs = 33, wholeMs = 10000, fine = 1000;

}  // namespace

RaceWindow::RaceWindow(RunControl& run, Wanted& wanted, const Theme& theme, QWidget* parent)
    : QWidget(parent, Qt::Window), run_(run), error_(wanted), theme_(theme) {
    setUpToolWindow(*this, "race", tr("Race"), "studies", {1200, 800});
    closeOnEscape(*this);
    auto* column = new QVBoxLayout(this);
    auto* row = new QHBoxLayout;
    play_ = new QPushButton(tr("Start"), this);
    play_->setProperty("kind", "primary");
    connect(play_, &QPushButton::clicked, this, [this] { setPlaying(!timer_.isActive()); });
    row->addWidget(play_);
    spent_ = makeLabel({}, "strong", this);
    row->addWidget(spent_);
    share_ = new SeekSlider(Qt::Horizontal, this);
    share_->setRange(0, fine);
    share_->setAccessibleName(tr("Processor time spent"));
    connect(share_, &QSlider::valueChanged, this, &RaceWindow::show);
    row->addWidget(share_, 3);
    wanted_ = makeLabel({}, "strong", this);
    row->addWidget(wanted_);
    digits_ = new SeekSlider(Qt::Horizontal, this);
    digits_->setRange(-14, 0);
    digits_->setAccessibleName(tr("Wanted error"));
    connect(digits_, &QSlider::valueChanged, this,
            [this](int power) { error_.setError(std::pow(10.0, power)); });
    connect(&error_, &Wanted::changed, this, &RaceWindow::show);
    row->addWidget(digits_, 1);
    column->addLayout(row);
    grid_ = new QGridLayout;
    grid_->setSpacing(10);
    column->addLayout(grid_, 1);
    timer_.setInterval(tickMs);
    connect(&timer_, &QTimer::timeout, this, [this] {
        share_->setValue(share_->value() +
                         std::max(1, static_cast<int>(sinceTick_.restart() * fine / wholeMs)));
        if (share_->value() == fine) setPlaying(false);
    });
}

void RaceWindow::open() {
    build();
    share_->setValue(0);
    show();
    bringToFront(*this);
}

void RaceWindow::setPlaying(bool plays) {
    if (plays && share_->value() == fine) share_->setValue(0);
    sinceTick_.start();
    plays ? timer_.start() : timer_.stop();
    play_->setText(plays ? tr("Pause") : tr("Start"));
}

void RaceWindow::setSpent(double share) { share_->setValue(static_cast<int>(std::lround(share * fine))); }
void RaceWindow::setTheme(const Theme& theme) {
    theme_ = theme;
    for (const Lane& lane : lanes_) lane.stage->setTheme(theme);
}

void RaceWindow::build() {
    setPlaying(false);
    for (const Lane& lane : lanes_) delete lane.card;
    lanes_.clear();
    runners_.clear();
    longest_ = 0;
    const auto results = run_.results();
    if (!results) return;
    runners_ = runnersOf(*results);
    const int columns = runners_.size() > 6 ? 4 : runners_.size() > 4 ? 3 : 2;
    for (const Runner& runner : runners_) {
        longest_ = std::max(longest_, runner.seconds());
        auto* card = new Card(QString::fromStdString(runner.result().spec.label), this);
        auto* stage = new StageWidget(card);
        stage->setTheme(theme_);
        stage->setLegendShown(false);
        auto alone = std::make_shared<Comparison>(*results);
        std::erase_if(alone->schemes,
                      [&](const auto& s) { return s->spec.label != runner.result().spec.label; });
        stage->setComparison(alone);
        auto* bar = new QProgressBar(card);
        bar->setRange(0, fine);
        bar->setTextVisible(false);
        auto* verdict = makeLabel({}, "caption", card);
        card->body()->addWidget(stage, 1);
        card->body()->addWidget(bar);
        card->body()->addWidget(verdict);
        const int place = static_cast<int>(lanes_.size());
        grid_->addWidget(card, place / columns, place % columns);
        lanes_.push_back({card, stage, bar, verdict});
    }
}

void RaceWindow::show() {
    const double spent = longest_ * share_->value() / fine, wanted = error_.error();
    spent_->setText(tr("%1 CPU").arg(shortTime(spent)));
    wanted_->setText(tr("wanted error %1").arg(shortNumber(wanted)));
    {
        const QSignalBlocker blocker(digits_);
        digits_->setValue(static_cast<int>(std::lround(std::log10(wanted))));
    }
    const std::vector<int> places = placesOf(runners_, spent, wanted);
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const Runner& runner = runners_[i];
        const Lane& lane = lanes_[i];
        const double t = runner.timeAt(spent), error = runner.errorUpTo(t);
        lane.stage->setTime(t);
        lane.bar->setValue(static_cast<int>(fine * std::min(1.0, spent / runner.seconds())));
        QString text = tr("t = %1").arg(shortNumber(t, 4));
        if (std::isfinite(error)) text += tr(", error %1").arg(shortNumber(error));
        if (places[i] > 0)
            text =
                tr("%1. in %2, error %3").arg(places[i]).arg(shortTime(runner.seconds()), shortNumber(error));
        else if (!runner.isComplete() && spent >= runner.seconds())
            text += tr("  ·  out: it failed");
        else if (runner.isOut(spent, wanted))
            text += tr("  ·  out: the error is too large");
        lane.verdict->setText(text);
        lane.card->setSelected(places[i] == 1);
    }
}

QStringList RaceWindow::verdicts() const {
    QStringList all;
    for (const Lane& lane : lanes_) all << lane.verdict->text();
    return all;
}

}  // namespace extremal
