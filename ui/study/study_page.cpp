// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/study_page.hpp"

#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "engine/core/known_value.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/explain.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/study/explain_study.hpp"
#include "ui/study/study_edits.hpp"
#include "ui/study/study_form.hpp"
#include "ui/study/wanted_error.hpp"
#include "ui/workspace/bare_scene.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

QString cellText(const Value& value, const std::string& column) {
    const bool isRough = column.find("error") != std::string::npos || column == "ratio";
    if (value.isNumber())
        return column.find("cpu") != std::string::npos ? shortTime(value.asNumber())
                                                       : shortNumber(value.asNumber(), isRough ? 3 : 5);
    if (value.isBool()) return value.asBool() ? StudyPage::tr("yes") : QString();
    return value.isString() ? QString::fromStdString(value.asString()) : QString();
}

/// The scene as far as a study depends on it.
Scene studiedPart(Scene scene) {
    scene = bareScene(std::move(scene));
    scene.views.clear();
    return scene;
}

std::vector<std::pair<std::string, double>> stepOrTolerance(double step, double tolerance) {
    std::vector<std::pair<std::string, double>> numbers;
    if (step > 0) numbers.emplace_back("/schemes/*/step", step);
    if (tolerance > 0) numbers.emplace_back("/schemes/*/tolerance", tolerance);
    return numbers;
}

QString textOf(double step, double tolerance) {
    return step > 0 ? StudyPage::tr("h = %1").arg(shortNumber(step, 4))
                    : StudyPage::tr("tolerance %1").arg(shortNumber(tolerance, 3));
}

}  // namespace

StudyPage::StudyPage(Workspace& workspace, Wanted& wanted, const Theme& theme, QWidget* parent)
    : QWidget(parent),
      workspace_(workspace),
      wanted_(wanted),
      job_(new StudyJob(this)),
      form_(new StudyForm) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(form_);
    makeResults(theme);
    connect(form_, &StudyForm::chosenChanged, this, &StudyPage::showKind);
    connect(form_, &StudyForm::wishesChanged, this, [this] {
        if (workspace_.hasScene()) form_->checkWishes(*workspace_.resolved());
    });
    connect(form_, &StudyForm::runRequested, this, [this] {
        if (!stop()) start();
    });
    connect(job_, &StudyJob::pointsArrived, this, [this] {
        showTable();
        showFigure();
    });
    connect(job_, &StudyJob::changed, this, &StudyPage::showState);
    connect(&workspace_, &Workspace::sceneChanged, this, &StudyPage::showScene);
    connect(&workspace_, &Workspace::opened, this, [this] { job_->stop(); });
    connect(&workspace_, &Workspace::selectionChanged, this, [this] {
        const int index = workspace_.selectedScheme();
        if (index >= 0) showMapOf(workspace_.scene().schemes[static_cast<std::size_t>(index)].label);
    });
    showKind();
    showScene();
}

void StudyPage::makeResults(const Theme& theme) {
    makePlots(theme);
    makeTable();
    auto* splitter = new QSplitter(Qt::Vertical);
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(plotCard_);
    splitter->addWidget(tableCard_);
    splitter->setStretchFactor(0, 2);
    splitter->setStretchFactor(1, 1);
    qobject_cast<QVBoxLayout*>(layout())->addWidget(splitter, 1);
    connectResults();
}

void StudyPage::makePlots(const Theme& theme) {
    plotCard_ = new Card(tr("Plot"));
    plot_ = new PlotWidget(theme);
    Figure nothing;
    nothing.axes = AxisStyle::none;
    nothing.message = tr("No study has been run: Ctrl+R").toStdString();
    plot_->setFigure(std::move(nothing));
    beside_ = new PlotWidget(theme);
    beside_->hide();
    auto* plots = new QHBoxLayout;
    plots->addWidget(plot_, 1);
    plots->addWidget(beside_, 1);
    plotCard_->body()->addLayout(plots, 1);
}

/// The results as numbers, with what can be done with a row.
void StudyPage::makeTable() {
    tableCard_ = new Card(tr("Table"));
    const auto button = [this](const QString& text, const char* name, const QString& tip) {
        auto* made = new QPushButton(text);
        made->setObjectName(QLatin1String(name));
        made->setToolTip(tip);
        tableCard_->header()->addWidget(made);
        return made;
    };
    measure_ = button(tr("Measure"), "measureCheapest",
                      tr("Runs every scheme that is on at the step that the wanted error needs (Ctrl+M)"));
    load_ =
        button(tr("Show"), "loadStudy",
               tr("Puts the run of the selected row into the scene and shows it in Compare (Ctrl+Shift+U)"));
    use_ = button(tr("Use it"), "useStudy",
                  tr("Puts the scheme of the selected row, with its step, into the scene (Ctrl+U)"));
    wantedEdit_ = new WantedError(wanted_);
    answer_ = makeElidedLabel({}, "strong");
    answer_->setObjectName("studyAnswer");
    tableCard_->body()->addWidget(wantedEdit_);
    tableCard_->body()->addWidget(answer_);
    table_ = new QTableWidget;
    table_->setAccessibleName(tr("Results of the study"));
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setShowGrid(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(22);
    table_->setMinimumHeight(100);
    explainCellsOf(*table_);
    tableCard_->body()->addWidget(table_, 1);
}

void StudyPage::connectResults() {
    connect(measure_, &QPushButton::clicked, this, &StudyPage::measureCheapest);
    connect(use_, &QPushButton::clicked, this, &StudyPage::useSelected);
    connect(load_, &QPushButton::clicked, this, &StudyPage::loadSelected);
    connect(table_, &QTableWidget::itemActivated, this, &StudyPage::useSelected);
    connect(table_, &QTableWidget::itemSelectionChanged, this, &StudyPage::showSelection);
    connect(&wanted_, &Wanted::changed, this, &StudyPage::showWanted);
    connect(wantedEdit_, &WantedError::refused, this, [this](const QString& text) {
        emit problemFound(tr("The wanted error must be a number above 0, got \"%1\"").arg(text),
                          tr("for example 1e-6"));
    });
    connect(plot_, &PlotWidget::levelMoved, &wanted_, &Wanted::setError);
    connect(plot_, &PlotWidget::rowChosen, this, [this](std::size_t row) { load(runOfRow(row)); });
    connect(plot_, &PlotWidget::cellChosen, this, [this](double x, double y) {
        if (const auto* study = job_->as<StabilityStudy>(); study && study->options().y)
            load({mapped_, {{study->options().x.pointer, x}, {study->options().y->pointer, y}}});
    });
    connect(plot_, &PlotWidget::saveFailed, this, [this](const QString& reason) {
        emit problemFound(tr("The plot could not be saved: %1").arg(reason), {});
    });
}

void StudyPage::start() {
    if (!workspace_.hasScene()) return;
    try {
        const StudyEntry& entry = form_->chosen();
        if (!form_->checkWishes(*workspace_.resolved())) return;
        Study study = form_->study(*workspace_.resolved(), wanted_.error());
        studied_ = studiedPart(workspace_.scene());
        shown_ = &entry;
        mapped_.clear();
        job_->start(std::move(study));
    } catch (const InvalidScene& e) {
        const Problem& first = e.problems().front();
        const std::string place = first.pointer.empty() ? "" : first.pointer + ": ";
        emit problemFound(QString::fromStdString(place + first.message), QString::fromStdString(first.hint));
    }
}

bool StudyPage::stop() {
    if (!job_->isRunning()) return false;
    job_->stop();
    return true;
}

void StudyPage::measureCheapest() {
    form_->choose("cheapest");
    start();
}

void StudyPage::openChoices() { form_->openChoices(); }

void StudyPage::askForError() {
    if (wantedEdit_->isHidden()) form_->choose("cheapest");
    wantedEdit_->takeFocus();
}

void StudyPage::setTheme(const Theme& theme) {
    plot_->setTheme(theme);
    beside_->setTheme(theme);
}

void StudyPage::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    showScene();
}

bool StudyPage::isCheapest() const { return shown_ && shown_->over == StudyEntry::Over::wantedError; }

/// Errors against costs are there, or are asked for.
bool StudyPage::hasWantedError() const {
    const auto isOf = [](const StudyEntry& entry) {
        return entry.over == StudyEntry::Over::wantedError || entry.item.id == "work-precision";
    };
    return job_->study() ? shown_ && isOf(*shown_) : isOf(form_->chosen());
}

void StudyPage::showKind() {
    const bool isAsked = hasWantedError() || form_->chosen().over == StudyEntry::Over::wantedError;
    wantedEdit_->setVisible(isAsked || form_->chosen().over == StudyEntry::Over::usableSteps);
    answer_->setVisible(isAsked);
    measure_->setVisible(isAsked);
    showState();
}

void StudyPage::showScene() {
    if (!isVisible() || !workspace_.hasScene()) return;
    form_->offer(*workspace_.resolved());
    showState();
}

void StudyPage::showFigure() {
    const Study* study = job_->study();
    if (!study || !shown_) return;
    std::vector<Figure> figures;
    if (const auto* stability = std::get_if<StabilityStudy>(study)) {
        const int known = indexOfScheme(stability->scene().scene, mapped_);
        const std::size_t scheme =
            known < 0 ? stability->rows().front().scheme : static_cast<std::size_t>(known);
        figures.push_back(studyFigure(shown_->item.id, *stability, scheme));
        mapped_ = stability->scene().scene.schemes[scheme].label;
    } else {
        figures = std::visit([&](const auto& each) { return studyFigures(shown_->item.id, each); }, *study);
    }
    ++figuresMade_;
    beside_->setVisible(figures.size() > 1);
    if (figures.size() > 1) beside_->setFigure(std::move(figures[1]));
    Figure& figure = figures.front();
    plotCard_->setVisible(!figure.view.empty());
    plotCard_->setTitle(QString::fromStdString(figure.title));
    plotCard_->setSubtitle(QString::fromStdString(figure.subtitle));
    plot_->setFigure(std::move(figure));
    plot_->setLevel(hasWantedError() ? std::optional(wanted_.error()) : std::nullopt,
                    shortNumber(wanted_.error(), 2));
}

/// What would reach the wanted error, before it is measured.
StudyTable StudyPage::proposalTable() const {
    const Sweep& sweep = *job_->as<Sweep>();
    StudyTable table{
        "", {"scheme", "step", "tolerance", "predicted cpu", "ratio", "nearest error", "nearest cpu"}, {}};
    for (const Proposal& p : proposals_) {
        const PointResult& measured = sweep.rows()[p.row].result;
        table.rows.push_back({sweep.scene().scene.schemes[p.scheme].label, positiveNumber(p.step),
                              positiveNumber(p.tolerance), knownNumber(p.predictedSeconds),
                              p.predictedSeconds / proposals_.front().predictedSeconds,
                              knownNumber(measured.error), knownNumber(measured.cpuSeconds)});
    }
    return table;
}

void StudyPage::showTable() {
    const Study* study = job_->study();
    if (!study || !shown_) return;
    proposals_.clear();
    if (const Sweep* sweep = job_->as<Sweep>(); sweep && hasWantedError() && !isCheapest()) {
        proposals_ = proposalsFor(*sweep, wanted_.error());
        tableCard_->setTitle(tr("Schemes that reach the error"));
        fill(proposalTable());
    } else {
        tableCard_->setTitle(QString::fromStdString(shown_->item.title));
        fill(std::visit([&](const auto& each) { return summaryOf(*shown_, each); }, *study));
    }
    answer_->setText(answer());
    showKind();
}

void StudyPage::fill(const StudyTable& table) {
    const QSignalBlocker blocker(table_);
    const int selected = table_->currentRow();
    table_->setColumnCount(static_cast<int>(table.columns.size()));
    QStringList titles;
    for (const std::string& column : table.columns)
        titles << QString::fromStdString(column).replace("cpu seconds", tr("CPU time")).replace("cpu", "CPU");
    table_->setHorizontalHeaderLabels(titles);
    table_->setRowCount(static_cast<int>(table.rows.size()));
    for (int row = 0; row < table_->rowCount(); ++row)
        for (int c = 0; c < table_->columnCount(); ++c) {
            const auto at = static_cast<std::size_t>(c);
            const Value& value = table.rows[static_cast<std::size_t>(row)][at];
            auto* item = new QTableWidgetItem(cellText(value, table.columns[at]));
            if (value.isNumber()) {
                item->setData(Qt::UserRole, value.asNumber());
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            }
            // Between two events the study may have gone on: the job's is the one that the table is of.
            if (const Study* study = job_->study())
                item->setToolTip(explainStudyCell(*study, table.columns[at], value));
            table_->setItem(row, c, item);
        }
    for (int c = 0; c < table_->columnCount(); ++c) {
        bool isEmpty = true;
        for (int row = 0; row < table_->rowCount(); ++row) isEmpty &= table_->item(row, c)->text().isEmpty();
        table_->setColumnHidden(c, isEmpty);
    }
    table_->resizeColumnsToContents();
    if (table_->rowCount() > 0) table_->selectRow(std::clamp(selected, 0, table_->rowCount() - 1));
}

/// The cheapest scheme and the next one, with what they cost: predicted, or measured.
QString StudyPage::answer() const {
    const Sweep* sweep = job_->as<Sweep>();
    if (!sweep || !hasWantedError()) return {};
    const auto label = [&](std::size_t scheme) {
        return QString::fromStdString(sweep->scene().scene.schemes[scheme].label);
    };
    const double wanted = isCheapest() ? sweep->options().wantedError : wanted_.error();
    QString start = shortNumber(wanted, 2);
    if (isCheapest())
        for (const Wish& wish : sweep->options().wishes)
            start += tr(" and %1 %2").arg(QString::fromStdString(wish.metric), shortNumber(wish.value, 2));
    start += QStringLiteral("  →  ");
    if (!isCheapest()) {
        if (proposals_.empty())
            return job_->isRunning() ? start + tr("no point reaches it yet")
                                     : start + tr("no scheme reaches it at these steps");
        const Proposal& first = proposals_.front();
        QString text = start + tr("%1, %2: %3 predicted")
                                   .arg(label(first.scheme), textOf(first.step, first.tolerance),
                                        shortTime(first.predictedSeconds));
        if (proposals_.size() > 1)
            text += tr("; next %1, %2 times")
                        .arg(label(proposals_[1].scheme),
                             shortNumber(proposals_[1].predictedSeconds / first.predictedSeconds));
        return text;
    }
    const SweepRow* best = nullptr;
    for (const SweepRow& row : sweep->rows())
        if (row.result.isDone() && (!best || row.result.cpuSeconds < best->result.cpuSeconds)) best = &row;
    if (!best) return start + (job_->isRunning() ? tr("searching") : tr("no scheme reaches it"));
    QString text =
        start + tr("%1, %2: %3 measured")
                    .arg(label(best->point.scheme), textOf(best->result.step, best->result.tolerance),
                         shortTime(best->result.cpuSeconds));
    if (best->result.predictedSeconds > 0)
        text += tr(" (%1 predicted)").arg(shortTime(best->result.predictedSeconds));
    if (wanted != wanted_.error()) text += tr("; Ctrl+M measures %1").arg(shortNumber(wanted_.error(), 2));
    return text;
}

/// Another wanted error: the line in the plot and the proposals follow, the figure stays.
void StudyPage::showWanted() {
    if (job_->study() && hasWantedError()) plot_->setLevel(wanted_.error(), shortNumber(wanted_.error(), 2));
    if (isCheapest())
        answer_->setText(answer());
    else
        showTable();
}

void StudyPage::showSelection() {
    showState();
    if (job_->as<StabilityStudy>() && table_->currentRow() >= 0)
        showMapOf(table_->item(table_->currentRow(), 0)->text().toStdString());
}

/// Of the maps of stability that of this scheme, if there is one.
void StudyPage::showMapOf(const std::string& label) {
    const auto* study = job_->as<StabilityStudy>();
    if (!study || !study->options().y || label == mapped_) return;
    const int scheme = indexOfScheme(study->scene().scene, label);
    if (std::none_of(study->rows().begin(), study->rows().end(),
                     [&](const auto& row) { return static_cast<int>(row.scheme) == scheme; }))
        return;
    mapped_ = label;
    showFigure();
}

void StudyPage::showState() {
    const bool canLoad = !selectedRun().numbers.empty();
    use_->setEnabled(canLoad);
    load_->setEnabled(canLoad);
    const Study* study = job_->study();
    if (!study || !shown_)
        return form_->showState(*job_, QString::fromStdString(form_->chosen().item.description));
    const StudyCount count = countOf(*study);
    QStringList parts;
    parts << tr("%1 of %2 points").arg(count.known).arg(count.all);
    if (!job_->problem().isEmpty()) parts << job_->problem();
    if (job_->isPreparing()) parts << tr("the reference comes first");
    if (const AnnouncedTime time = job_->announced(); job_->isRunning() && time.seconds >= 1)
        parts << tr("%1 in all").arg(QString::fromStdString(textOf(time)));
    if (job_->wasStopped()) parts << tr("stopped");
    if (const Sweep* sweep = job_->as<Sweep>(); sweep && !sweep->reference().description.empty())
        parts << tr("reference: %1").arg(QString::fromStdString(sweep->reference().description));
    if (studied_ && workspace_.hasScene() && shown_->over != StudyEntry::Over::extremes &&
        !(*studied_ == studiedPart(workspace_.scene())))
        parts << tr("of an earlier version of the scene");
    form_->showState(*job_, parts.join(QStringLiteral("   ·   ")));
}

StudyPage::LoadableRun StudyPage::runOfRow(std::size_t row) const {
    if (const Sweep* sweep = job_->as<Sweep>(); sweep && row < sweep->rows().size()) {
        const SweepRow& point = sweep->rows()[row];
        LoadableRun run{sweep->scene().scene.schemes[point.point.scheme].label,
                        stepOrTolerance(point.result.step, point.result.tolerance)};
        // One that the scene does not have is added.
        if (point.result.reduction || !sweep->isOfScene(point.point.scheme))
            run.scheme = schemeAt(sweep->scene(), point.point.scheme, point.result).spec;
        return run;
    }
    if (const auto* study = job_->as<StabilityStudy>(); study && row < study->rows().size())
        return {study->scene().scene.schemes[study->rows()[row].scheme].label,
                {{study->options().x.pointer, study->rows()[row].x}}};
    return {};
}

StudyPage::LoadableRun StudyPage::selectedRun() const {
    const int row = table_->currentRow();
    if (!shown_ || row < 0 || row >= table_->rowCount()) return {};
    if (!proposals_.empty()) {
        const Proposal& p = proposals_[static_cast<std::size_t>(row)];
        return {job_->as<Sweep>()->scene().scene.schemes[p.scheme].label,
                stepOrTolerance(p.step, p.tolerance)};
    }
    const Sweep* sweep = job_->as<Sweep>();
    if (!sweep || !shown_->summaryPoints) return {};
    const std::vector<const SweepRow*> points = shown_->summaryPoints(*sweep);
    if (static_cast<std::size_t>(row) >= points.size()) return {};
    return runOfRow(static_cast<std::size_t>(points[static_cast<std::size_t>(row)] - sweep->rows().data()));
}

/// As an edit that can be undone. False, with a problem, where the scene does not take it.
bool StudyPage::use(const LoadableRun& run, QString& text) {
    QStringList parts;
    for (const auto& [pointer, value] : run.numbers) {
        const std::string name = pointer.substr(pointer.rfind('/') + 1);
        parts << tr("%1 = %2").arg(QString::fromStdString(name), shortNumber(value, 4));
    }
    text = tr("%1 with %2").arg(QString::fromStdString(run.label), parts.join(QStringLiteral(", ")));
    const std::vector<Edit> edits = run.scheme ? editsForScheme(workspace_.scene(), *run.scheme)
                                               : editsForRun(workspace_.scene(), run.label, run.numbers);
    QString why = tr("the scene has no such scheme");
    if (!edits.empty()) {
        const std::vector<Problem> problems = workspace_.tryEdit(edits, tr("Use a result of a study"));
        if (problems.empty()) {
            workspace_.selectScheme(indexOfScheme(workspace_.scene(), run.label));
            return true;
        }
        why = QString::fromStdString(problems.front().message);
    }
    emit problemFound(tr("%1 cannot be put into the scene: %2").arg(text, why), {});
    return false;
}

void StudyPage::useSelected() {
    const LoadableRun run = selectedRun();
    QString text;
    if (!run.numbers.empty() && use(run, text)) emit pointUsed(text);
}

void StudyPage::loadSelected() { load(selectedRun()); }

void StudyPage::load(const LoadableRun& run) {
    QString text;
    if (!run.numbers.empty() && use(run, text)) emit runLoaded(text);
}

}  // namespace extremal
