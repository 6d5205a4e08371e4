// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/fit_window.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/figure/studies/fit_figure.hpp"
#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/study/fit_job.hpp"
#include "ui/study/problem_of.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

const char* const key = "fit";
constexpr int leastHeight = 240, mostColumns = 4;
enum TableColumn { nameColumn, nowColumn, valueColumn, deviationColumn, biasColumn };

/// "theta and 2 more" would hide what is fitted: all names.
QString namesOf(const MeasuredData& data) {
    QStringList names;
    for (const MeasuredData::Each& each : data.columns) names << QString::fromStdString(each.name);
    return names.join(QStringLiteral(", "));
}

QString deviationText(const FittedNumber& number) {
    return std::isfinite(number.deviation) ? QStringLiteral("± ") + shortNumber(number.deviation)
                                           : QObject::tr("not seen");
}

/// As many digits as the deviation leaves.
QString valueText(double value, double deviation) {
    const bool isKnown = std::isfinite(deviation) && deviation > 0 && value != 0;
    const int digits = isKnown ? static_cast<int>(std::ceil(std::log10(std::abs(value) / deviation))) + 2 : 6;
    return shortNumber(value, std::clamp(digits, 2, 15));
}

/// The pairs that are correlated most.
QString correlationsText(const FitAnswer& answer) {
    constexpr std::size_t most = 6;
    std::vector<std::pair<double, QString>> pairs;
    for (std::size_t i = 0; i < answer.numbers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (const double r = answer.correlations[i][j]; std::isfinite(r))
                pairs.emplace_back(
                    r, QObject::tr("%1 and %2 %3")
                           .arg(QString::fromStdString(answer.numbers[j].name),
                                QString::fromStdString(answer.numbers[i].name), shortNumber(r, 3)));
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
    if (pairs.size() > most) pairs.resize(most);
    QStringList texts;
    for (const auto& pair : pairs) texts << pair.second;
    return texts.isEmpty() ? QString() : QObject::tr("Correlations: %1.").arg(texts.join(", "));
}

}  // namespace

FitWindow::FitWindow(Workspace& workspace, Notices& notices, const Theme& theme, QWidget* parent)
    : QWidget(parent, Qt::Window),
      workspace_(workspace),
      notices_(notices),
      theme_(theme),
      job_(new FitJob(this)) {
    setUpToolWindow(*this, "fit", tr("Fit to measurements"), "orbits#fits", {1180, 720});
    closeOnEscape(*this, [this] { return !stop(); });
    auto* layout = new QVBoxLayout(this);
    title_ = makeLabel(tr("Fit to measurements"), "heading", this);
    about_ = makeWrappedLabel({}, "caption", this);
    layout->addWidget(title_);
    layout->addWidget(about_);
    auto* splitter = new QSplitter;
    splitter->setChildrenCollapsible(false);
    auto* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("Fit"));
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    auto* inside = new QWidget;
    inside->setProperty("ground", "window");
    column_ = new QVBoxLayout(inside);
    column_->setContentsMargins(0, 0, 2, 0);
    column_->setSpacing(10);
    scroll->setWidget(inside);
    splitter->addWidget(makeNumbers());
    splitter->addWidget(scroll);
    splitter->setSizes({520, 660});
    layout->addWidget(splitter, 1);
    connect(job_, &FitJob::stepped, this, &FitWindow::showStep);
    connect(job_, &FitJob::ended, this, &FitWindow::showEnd);
    connect(&workspace_, &Workspace::sceneChanged, this, [this] {
        if (isVisible() && !isRunning() && !isApplying_) fillNumbers();
    });
    connect(&workspace_, &Workspace::opened, this, [this] {
        stop();
        data_.reset();
        fitted_.reset();
        showPlots({});
        close();
    });
}

QWidget* FitWindow::makeNumbers() {
    constexpr int leastWidth = 400;  // of all columns, with short names
    auto* card = new Card(tr("Numbers that may move"), this);
    card->setMinimumWidth(leastWidth);
    table_ = new QTableWidget(0, 5);
    table_->setObjectName("fitNumbers");
    table_->setAccessibleName(tr("Numbers that may move"));
    table_->setHorizontalHeaderLabels({tr("number"), tr("now"), tr("fitted"), tr("deviation"), tr("bias")});
    table_->horizontalHeaderItem(biasColumn)
        ->setToolTip(tr("The number less that which fits with half the step: what the scheme, not the data, "
                        "puts in"));
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setShowGrid(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(24);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    connect(table_, &QTableWidget::itemChanged, this, [this] { showButton(); });
    card->body()->addWidget(table_, 1);
    state_ = makeWrappedLabel({}, "strong");
    state_->setObjectName("fitState");
    found_ = makeWrappedLabel({}, "caption");
    found_->setObjectName("fitFound");
    card->body()->addWidget(state_);
    card->body()->addWidget(found_);
    auto* buttons = new QHBoxLayout;
    file_ = new QPushButton(tr("Other measurements..."));
    start_ = new QPushButton(tr("Fit"));
    start_->setObjectName("fitStart");
    buttons->addWidget(file_);
    buttons->addStretch(1);
    buttons->addWidget(start_);
    card->body()->addLayout(buttons);
    connect(file_, &QPushButton::clicked, this, &FitWindow::chooseFile);
    connect(start_, &QPushButton::clicked, this, &FitWindow::startOrStop);
    return card;
}

void FitWindow::chooseFile() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Measurements"), {}, tr("Measurements (*.csv);;All files (*)"));
    if (!path.isEmpty()) open(path);
}

void FitWindow::open() {
    if (!data_) return chooseFile();
    fillNumbers();
    bringToFront(*this);
}

void FitWindow::open(const QString& path) {
    stop();
    const QString name = QFileInfo(path).fileName();
    if (!workspace_.hasScene()) return;
    try {
        data_ = std::make_shared<const MeasuredData>(
            readMeasuredFile(path.toStdString(), *workspace_.resolved()->system, {}));
    } catch (const InvalidScene& e) {
        notices_.post(
            {Notice::Kind::error,
             key,
             tr("%1 cannot be fitted: %2").arg(name, QString::fromStdString(e.problems().front().message)),
             tr("a CSV with the column t and columns of the state, as q.x or x"),
             {},
             "orbits#fits"});
        return;
    }
    fitted_.reset();
    state_->clear();
    found_->clear();
    title_->setText(tr("Fit to %1").arg(name));
    about_->setText(tr("%1 values of %2, t = %3 to %4. %5")
                        .arg(data_->all.size())
                        .arg(namesOf(*data_), shortNumber(data_->all.empty() ? 0 : data_->all.front().t, 4),
                             shortNumber(data_->all.empty() ? 0 : data_->all.back().t, 4),
                             QString::fromStdString(data_->remark)));
    fillNumbers();
    showPlots(measuredFigures({}));
    bringToFront(*this);
}

void FitWindow::fillNumbers() {
    const std::vector<std::string> before = ticked();
    numbers_ = numbersOf(workspace_.scene(), *workspace_.resolved()->system);
    const QSignalBlocker quiet(table_);
    table_->setRowCount(static_cast<int>(numbers_.size()));
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const int row = static_cast<int>(i);
        auto* name = new QTableWidgetItem(QString::fromStdString(numbers_[i].name));
        name->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable | Qt::ItemIsSelectable);
        const bool isTicked = std::find(before.begin(), before.end(), numbers_[i].pointer) != before.end();
        name->setCheckState(isTicked ? Qt::Checked : Qt::Unchecked);
        name->setToolTip(QString::fromStdString(numbers_[i].pointer));
        table_->setItem(row, nameColumn, name);
        setCell(row, nowColumn, shortNumber(numbers_[i].value, 6));
        for (const int column : {valueColumn, deviationColumn, biasColumn}) setCell(row, column, {});
    }
    showButton();
}

void FitWindow::setCell(int row, int column, const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    table_->setItem(row, column, item);
}

std::vector<std::string> FitWindow::ticked() const {
    std::vector<std::string> pointers;
    for (int row = 0; row < table_->rowCount() && row < static_cast<int>(numbers_.size()); ++row)
        if (table_->item(row, nameColumn)->checkState() == Qt::Checked)
            pointers.push_back(numbers_[static_cast<std::size_t>(row)].pointer);
    return pointers;
}

int FitWindow::rowOf(const std::string& pointer) const {
    const auto at = std::find_if(numbers_.begin(), numbers_.end(),
                                 [&](const NumberOfScene& each) { return each.pointer == pointer; });
    return at == numbers_.end() ? -1 : static_cast<int>(at - numbers_.begin());
}

bool FitWindow::isRunning() const { return job_->isRunning(); }

void FitWindow::showButton() {
    const std::size_t count = ticked().size();
    start_->setText(isRunning() ? tr("Stop") : tr("Fit"));
    start_->setEnabled(isRunning() || (data_ && count > 0));
    start_->setToolTip(count > 0 ? tr("Least squares over the numbers that are ticked")
                                 : tr("Tick the numbers that may move"));
    table_->setEnabled(!isRunning());
    file_->setEnabled(!isRunning());
}

bool FitWindow::stop() {
    if (!job_->stop()) return false;
    state_->setText(tr("Stopped: the scene is as it was."));
    showButton();
    return true;
}

void FitWindow::startOrStop() {
    if (stop() || !data_ || !workspace_.hasScene()) return;
    FitRequest request;
    request.free = ticked();
    if (request.free.empty()) return;
    if (const int selected = workspace_.selectedScheme(); selected >= 0)
        request.scheme = workspace_.scene().schemes[static_cast<std::size_t>(selected)].label;
    fitted_ = problemOf(workspace_.scene());
    found_->clear();
    state_->setText(tr("The motion of the scene is computed ..."));
    job_->start(workspace_.resolved(), data_, request);
    showButton();
}

/// The numbers on their way, and the motion that they make.
void FitWindow::showStep() {
    const FitStep& step = *job_->step();
    if (step.isOfBias) return state_->setText(tr("Found; the bias of the step is measured ..."));
    state_->setText(tr("Step %1: sum of squares %2, at first %3")
                        .arg(job_->steps())
                        .arg(shortNumber(step.sum, 4), shortNumber(job_->firstSum(), 4)));
    const std::vector<std::string> free = ticked();
    for (std::size_t i = 0; i < free.size() && i < step.values.size(); ++i)
        if (const int row = rowOf(free[i]); row >= 0)
            setCell(row, valueColumn, shortNumber(step.values[i], 6));
    showPlots(measuredFigures(step.computed));
}

void FitWindow::showEnd() {
    showButton();
    if (!job_->answer()) {
        state_->setText(tr("No fit: %1").arg(job_->problem()));
        found_->setText(job_->remedy());
        return;
    }
    const FitAnswer& answer = *job_->answer();
    applyAnswer();
    fillNumbers();
    for (const FittedNumber& each : answer.numbers) {
        const int row = rowOf(each.pointer);
        if (row < 0) continue;
        setCell(row, valueColumn, valueText(each.value, each.deviation));
        setCell(row, deviationColumn, deviationText(each));
        setCell(row, biasColumn, std::isfinite(each.bias) ? shortNumber(each.bias) : QString());
    }
    state_->setText(tr("%1: sum of squares %2 after %3 steps, at first %4; scatter %5%6")
                        .arg(QString::fromStdString(answer.scheme), shortNumber(answer.sums.back(), 4))
                        .arg(answer.sums.size() - 1)
                        .arg(shortNumber(answer.sums.front(), 4), shortNumber(answer.scatter, 3),
                             answer.hasDeviations ? tr(" of the given deviations") : QString()));
    QStringList notes{correlationsText(answer)};
    for (const std::string& note : answer.notes) notes << QString::fromStdString(note) + QLatin1Char('.');
    notes.removeAll(QString());
    found_->setText(notes.join(QLatin1Char('\n')));
    std::vector<double> computed;
    for (const Value::Array& row : answer.residuals.rows) computed.push_back(row[3].asNumber());
    std::vector<Figure> figures = measuredFigures(computed);
    figures.push_back(residualsFigure(answer));
    showPlots(figures);
}

/// As one edit, unless the problem is not that of the fit any more.
void FitWindow::applyAnswer() {
    const FitAnswer& answer = *job_->answer();
    QStringList numbers;
    std::vector<Edit> edits;
    for (const FittedNumber& each : answer.numbers) {
        edits.push_back({each.pointer, each.value});
        numbers << QStringLiteral("%1 = %2 %3")
                       .arg(QString::fromStdString(each.name), valueText(each.value, each.deviation),
                            deviationText(each));
    }
    const QString name = QFileInfo(QString::fromStdString(answer.data)).fileName();
    Notice notice{Notice::Kind::information, key, {}, {}, {}, "orbits#fits"};
    const bool isSame = fitted_ && workspace_.hasScene() && problemOf(workspace_.scene()) == *fitted_;
    isApplying_ = true;
    if (isSame && workspace_.edit(edits, tr("Fit to %1").arg(name))) {
        notice.text = tr("Fitted to %1: %2.").arg(name, numbers.join(QStringLiteral(", ")));
        notice.hint = correlationsText(answer);
        notice.choices.push_back({tr("Undo"), [this] { workspace_.undo(); }});
    } else {
        notice.text = tr("%1 fits with %2; the scene has been changed since, and keeps its numbers.")
                          .arg(name, numbers.join(QStringLiteral(", ")));
    }
    isApplying_ = false;
    notices_.post(std::move(notice));
}

std::vector<Figure> FitWindow::measuredFigures(const std::vector<double>& computed) const {
    std::vector<Figure> figures;
    const std::size_t count = std::min<std::size_t>(data_ ? data_->columns.size() : 0, mostColumns);
    for (std::size_t column = 0; column < count; ++column)
        figures.push_back(measuredFigure(*data_, column, computed));
    return figures;
}

/// Plots stay where they are, with their zoom, while there are as many.
void FitWindow::showPlots(const std::vector<Figure>& figures) {
    while (plots_.size() > figures.size()) {
        plots_.back()->parentWidget()->deleteLater();
        plots_.pop_back();
    }
    while (plots_.size() < figures.size()) {
        auto* card = new Card({}, column_->parentWidget());
        auto* plot = new PlotWidget(theme_, card);
        plot->setMinimumHeight(leastHeight);
        card->body()->addWidget(plot, 1);
        column_->addWidget(card);
        plots_.push_back(plot);
    }
    for (std::size_t i = 0; i < plots_.size(); ++i) {
        auto* card = qobject_cast<Card*>(plots_[i]->parentWidget());
        card->setTitle(QString::fromStdString(figures[i].title));
        card->setSubtitle(QString::fromStdString(figures[i].subtitle));
        plots_[i]->setFigure(figures[i]);
    }
}

void FitWindow::setTheme(const Theme& theme) {
    theme_ = theme;
    for (PlotWidget* plot : plots_) plot->setTheme(theme);
}

}  // namespace extremal
