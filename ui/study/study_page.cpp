#include "ui/study/study_page.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/figure/study_figure.hpp"
#include "ui/panels/card.hpp"
#include "ui/panels/format.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/theme.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {
namespace {

QString cellText(const Value& value, const std::string& column) {
    if (value.isNumber())
        return column.find("cpu") != std::string::npos ? shortTime(value.asNumber())
                                                       : shortNumber(value.asNumber(), 4);
    if (value.isBool()) return value.asBool() ? StudyPage::tr("yes") : QString();
    return value.isString() ? QString::fromStdString(value.asString()) : QString();
}

/// The scene as far as a study depends on it.
Scene studiedPart(Scene scene) {
    scene.title = scene.source = scene.lesson = scene.notes = {};
    scene.views.clear();
    return scene;
}

}  // namespace

std::vector<Edit> editsForPoint(const Scene& scene, const std::string& label, double step, double tolerance) {
    const auto found = std::find_if(scene.schemes.begin(), scene.schemes.end(),
                                    [&](const SchemeSpec& s) { return s.label == label; });
    if (found == scene.schemes.end()) return {};
    const std::string place = "/schemes/" + std::to_string(found - scene.schemes.begin());
    std::vector<Edit> edits;
    if (step > 0) edits.push_back({place + "/step", step});
    if (tolerance > 0) edits.push_back({place + "/tolerance", tolerance});
    if (!edits.empty() && !found->isEnabled) edits.push_back({place + "/enabled", true});
    return edits;
}

StudyPage::StudyPage(Workspace& workspace, const Theme& theme, QWidget* parent)
    : QWidget(parent), workspace_(workspace), job_(new StudyJob(this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    makeOptions();
    makeResults(theme);
    connect(job_, &StudyJob::changed, this, &StudyPage::showStudy);
    connect(&workspace_, &Workspace::sceneChanged, this, &StudyPage::showScene);
    connect(&workspace_, &Workspace::opened, this, [this] { job_->stop(); });
    showOptions();
    showScene();
}

void StudyPage::makeOptions() {
    auto* card = new Card(tr("Study"));
    auto* row = new QHBoxLayout;
    kind_ = new QComboBox;
    kind_->setAccessibleName(tr("Study"));
    for (const StudyEntry& entry : studyEntries())
        if (entry.rows)  // others ask for more than steps, or for no scene: extremal study
            kind_->addItem(QString::fromStdString(entry.item.title), QString::fromStdString(entry.item.id));
    kind_->setCurrentIndex(std::max(0, kind_->findData(QStringLiteral("work-precision"))));
    metric_ = new QComboBox;
    metric_->setAccessibleName(tr("Metric"));
    metric_->setToolTip(tr("What is measured of each run: the largest size of this observable"));
    isAtEnd_ = new QCheckBox(tr("at the end alone"));
    isAtEnd_->setToolTip(tr("The metric at the last node in place of its maximum over all nodes"));
    error_ = new QLineEdit(QStringLiteral("1e-6"));
    error_->setAccessibleName(tr("Wanted error"));
    error_->setMaximumWidth(90);
    errorLabel_ = makeLabel(tr("wanted error"), "caption");
    errorLabel_->setBuddy(error_);
    run_ = new QPushButton(tr("Run the study"));
    run_->setObjectName("runStudy");
    run_->setProperty("kind", "primary");
    run_->setToolTip(tr("Runs every scheme that is on over its steps (Ctrl+R)"));
    row->addWidget(kind_);
    row->addWidget(makeLabel(tr("metric"), "caption"));
    row->addWidget(metric_);
    row->addWidget(isAtEnd_);
    row->addWidget(errorLabel_);
    row->addWidget(error_);
    row->addStretch(1);
    row->addWidget(run_);
    card->body()->addLayout(row);
    progress_ = new QProgressBar;
    progress_->setTextVisible(false);
    progress_->setRange(0, 1000);
    card->body()->addWidget(progress_);
    state_ = makeElidedLabel({}, "caption");
    state_->setObjectName("studyState");
    card->body()->addWidget(state_);
    layout()->addWidget(card);
    connect(kind_, &QComboBox::currentIndexChanged, this, &StudyPage::showOptions);
    connect(run_, &QPushButton::clicked, this, [this] {
        if (!stop()) start();
    });
}

void StudyPage::makeResults(const Theme& theme) {
    plotCard_ = new Card(tr("Plot"));
    plot_ = new PlotWidget(theme);
    plotCard_->body()->addWidget(plot_, 1);
    tableCard_ = new Card(tr("Table"));
    use_ = new QPushButton(tr("Use it"));
    use_->setObjectName("useStudy");
    use_->setToolTip(tr("Puts the scheme of the selected row, with its step, into the scene (Return)"));
    tableCard_->header()->addWidget(use_);
    table_ = new QTableWidget;
    table_->setAccessibleName(tr("Results of the study"));
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setShowGrid(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(22);
    tableCard_->body()->addWidget(table_, 1);
    auto* splitter = new QSplitter(Qt::Vertical);
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(plotCard_);
    splitter->addWidget(tableCard_);
    splitter->setStretchFactor(0, 2);
    splitter->setStretchFactor(1, 1);
    qobject_cast<QVBoxLayout*>(layout())->addWidget(splitter, 1);
    connect(use_, &QPushButton::clicked, this, &StudyPage::use);
    connect(table_, &QTableWidget::itemActivated, this, &StudyPage::use);
    connect(table_, &QTableWidget::itemSelectionChanged, this, &StudyPage::showState);
}

const StudyEntry& StudyPage::chosen() const {
    return *findStudy(kind_->currentData().toString().toStdString());
}

SweepOptions StudyPage::options() const {
    SweepOptions options;
    options.metric = metric_->currentText().toStdString();
    options.isAtEnd = isAtEnd_->isChecked();
    if (chosen().over == StudyEntry::Over::wantedError) {
        const std::optional<double> wanted = parseNumber(error_->text().trimmed().toStdString());
        if (!wanted || !(*wanted > 0) || !std::isfinite(*wanted))
            throw InvalidScene("", "the wanted error must be a number above 0", "for example 1e-6");
        options.wantedError = *wanted;
    }
    return options;
}

void StudyPage::start() {
    if (!workspace_.hasScene()) return;
    try {
        const StudyEntry& entry = chosen();
        const SweepOptions wanted = options();
        studied_ = studiedPart(workspace_.scene());
        shown_ = &entry;
        job_->start(workspace_.scene(), wanted);
    } catch (const InvalidScene& e) {
        const Problem& first = e.problems().front();
        state_->setText(QString::fromStdString(first.message) +
                        (first.hint.empty() ? QString() : " (" + QString::fromStdString(first.hint) + ")"));
    }
}

bool StudyPage::stop() {
    if (!job_->isRunning()) return false;
    job_->stop();
    return true;
}

void StudyPage::setTheme(const Theme& theme) { plot_->setTheme(theme); }

void StudyPage::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    showScene();
}

void StudyPage::showOptions() {
    const StudyEntry& entry = chosen();
    const bool hasError = entry.over == StudyEntry::Over::wantedError;
    error_->setVisible(hasError);
    errorLabel_->setVisible(hasError);
    kind_->setToolTip(QString::fromStdString(entry.item.description));
    showState();
}

/// The metrics of the scene; an error needs a reference.
void StudyPage::showScene() {
    if (!isVisible() || !workspace_.hasScene()) return;
    const Scene& scene = workspace_.scene();
    const ResolvedScene resolved = resolve(scene);
    const bool hasReference = scene.reference.kind != ReferenceSpec::Kind::none;
    QStringList names;
    for (const std::string& name : metricNames(*resolved.system, resolved.initial))
        if (hasReference ||
            metricOf(name, false, *resolved.system, resolved.initial).observable->needsReference == false)
            names << QString::fromStdString(name);
    QStringList present;
    for (int i = 0; i < metric_->count(); ++i) present << metric_->itemText(i);
    if (names != present) {
        const QString before = metric_->currentText();
        metric_->clear();
        metric_->addItems(names);
        metric_->setCurrentText(names.contains(before)                    ? before
                                : names.contains(QStringLiteral("error")) ? QStringLiteral("error")
                                                                          : names.value(0));
    }
    run_->setEnabled(!names.isEmpty());
    showState();
}

void StudyPage::showStudy() {
    if (const Sweep* sweep = job_->sweep(); sweep && shown_) {
        Figure figure = studyFigure(shown_->item.id, *sweep);
        plotCard_->setTitle(QString::fromStdString(figure.title));
        plot_->setFigure(std::move(figure));
        showTable();
    }
    showState();
}

void StudyPage::showTable() {
    const StudyTable summary = summaryOf(*shown_, *job_->sweep());
    const int selected = table_->currentRow();
    tableCard_->setTitle(QString::fromStdString(shown_->item.title));
    table_->setColumnCount(static_cast<int>(summary.columns.size()));
    QStringList titles;
    for (const std::string& column : summary.columns)
        titles << QString::fromStdString(column).replace("cpu seconds", tr("CPU time")).replace("cpu", "CPU");
    table_->setHorizontalHeaderLabels(titles);
    table_->setRowCount(static_cast<int>(summary.rows.size()));
    for (int row = 0; row < table_->rowCount(); ++row)
        for (int c = 0; c < table_->columnCount(); ++c) {
            const auto at = static_cast<std::size_t>(c);
            const Value& value = summary.rows[static_cast<std::size_t>(row)][at];
            auto* item = new QTableWidgetItem(cellText(value, summary.columns[at]));
            if (value.isNumber()) {
                item->setData(Qt::UserRole, value.asNumber());
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            }
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

void StudyPage::showState() {
    run_->setText(job_->isRunning() ? tr("Stop") : tr("Run the study"));
    progress_->setValue(static_cast<int>(1000 * job_->fraction()));
    const Sweep* sweep = job_->sweep();
    use_->setEnabled(sweep && table_->currentRow() >= 0 && shown_ && shown_->summaryPoints);
    if (!sweep) return state_->setText(QString::fromStdString(chosen().item.description));
    const auto& rows = sweep->rows();
    const auto known = std::count_if(rows.begin(), rows.end(), [](const SweepRow& row) {
        return row.result.status != RunStatus::waiting;
    });
    QStringList parts;
    parts << tr("%1 of %2 points").arg(known).arg(rows.size());
    if (!job_->problem().isEmpty()) parts << job_->problem();
    if (job_->isRunning() && known == 0 && sweep->metric().observable->needsReference)
        parts << tr("the reference comes first");
    if (job_->wasStopped()) parts << tr("stopped");
    if (!sweep->reference().description.empty())
        parts << tr("reference: %1").arg(QString::fromStdString(sweep->reference().description));
    if (studied_ && workspace_.hasScene() && !(*studied_ == studiedPart(workspace_.scene())))
        parts << tr("of an earlier version of the scene");
    state_->setText(parts.join(QStringLiteral("   ·   ")));
}

/// The selected row's scheme with its step, as an edit that can be undone.
void StudyPage::use() {
    const int row = table_->currentRow();
    if (!shown_ || !shown_->summaryPoints || row < 0) return;
    const SweepRow& point = *shown_->summaryPoints(*job_->sweep()).at(static_cast<std::size_t>(row));
    const std::string& label = job_->sweep()->scene().scene.schemes[point.point.scheme].label;
    const double step = point.result.step, tolerance = point.result.tolerance;
    const std::vector<Edit> edits = editsForPoint(workspace_.scene(), label, step, tolerance);
    const QString name = QString::fromStdString(label);
    if (edits.empty() || !workspace_.edit(edits, tr("Use a result of a study"))) {
        state_->setText(tr("%1 cannot be put into the scene as it is now").arg(name));
        return;
    }
    emit pointUsed(step > 0 ? tr("%1 with the step %2").arg(name, shortNumber(step, 4))
                            : tr("%1 with the tolerance %2").arg(name, shortNumber(tolerance, 4)));
}

}  // namespace extremal
