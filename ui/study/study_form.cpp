// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/study_form.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/request.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/study/metric_box.hpp"
#include "ui/study/varied_number_edit.hpp"
#include "ui/study/wishes_edit.hpp"

namespace extremal {

StudyForm::StudyForm(QWidget* parent) : Card(tr("Study"), parent) {
    kind_ = new ComboBox;
    kind_->setAccessibleName(tr("Study"));
    for (const StudyEntry& entry : studyEntries())
        kind_->addItem(QString::fromStdString(entry.item.title), QString::fromStdString(entry.item.id));
    metricLabel_ = makeLabel(tr("metric"), "caption");
    metric_ = new MetricBox;
    metric_->setAccessibleName(tr("Metric"));
    metric_->setToolTip(tr("What is measured of each run: the largest size of this observable"));
    isAtEnd_ = new QCheckBox(tr("at the end alone"));
    isAtEnd_->setToolTip(tr("The metric at the last node in place of its maximum over all nodes"));
    findsLimits_ = new QCheckBox(tr("limits of stability along x, to four digits"));
    findsLimits_->setToolTip(
        tr("Bisects the first value along x from which a run is not bounded; with two "
           "numbers, for every value of y"));
    findsLimits_->setChecked(true);
    run_ = new QPushButton(tr("Run the study"));
    run_->setObjectName("runStudy");
    run_->setProperty("kind", "primary");
    run_->setToolTip(tr("Runs it on every scheme that is on (Ctrl+R)"));
    header()->addWidget(kind_);
    header()->addWidget(run_);
    auto* row = new QHBoxLayout;
    for (QWidget* each : std::initializer_list<QWidget*>{metricLabel_, metric_, isAtEnd_, findsLimits_})
        row->addWidget(each);
    row->addStretch(1);
    body()->addLayout(row);
    wishes_ = new WishesEdit;
    body()->addWidget(wishes_);
    connect(wishes_, &WishesEdit::changed, this, &StudyForm::wishesChanged);
    addCases();
    auto* numbers = new QGridLayout;
    numbers->setHorizontalSpacing(6);
    numbers->setVerticalSpacing(4);
    x_ = new VariedNumberEdit(QStringLiteral("x"), *numbers, 0, this);
    y_ = new VariedNumberEdit(QStringLiteral("y"), *numbers, 1, this);
    numbers->setColumnStretch(1, 1);
    body()->addLayout(numbers);
    progress_ = new QProgressBar;
    progress_->setTextVisible(false);
    progress_->setRange(0, 1000);
    body()->addWidget(progress_);
    state_ = makeElidedLabel({}, "caption");
    state_->setObjectName("studyState");
    body()->addWidget(state_);
    connect(kind_, &QComboBox::currentIndexChanged, this, &StudyForm::showOptions);
    connect(run_, &QPushButton::clicked, this, &StudyForm::runRequested);
    choose("work-precision");
    showOptions();
}

/// What a search has to serve, and who takes part in it.
void StudyForm::addCases() {
    areAll_ = new QCheckBox(tr("all schemes that accept the scene"));
    areAll_->setObjectName("allCandidates");
    areAll_->setToolTip(tr("Named schemes, baselines and reduced models besides those of the scene"));
    overLabel_ = makeLabel(tr("for all of"), "caption");
    over_ = new QLineEdit;
    over_->setObjectName("overCases");
    over_->setAccessibleName(tr("Values of a number of the scene, all of which one setting serves"));
    over_->setPlaceholderText(QStringLiteral("/initial/q/0=0.5,1,1.5"));
    over_->setToolTip(
        tr("2 to 64 values of a number of the scene, or POINTER=FROM:TO:N[:log]: one setting has to serve "
           "them all. Empty: the scene as it is"));
    of_ = new ComboBox;
    of_->setAccessibleName(tr("Which of their errors counts"));
    of_->addItem(tr("the worst"), QStringLiteral("worst"));
    of_->addItem(tr("the median"), QStringLiteral("median"));
    auto* cases = new QHBoxLayout;
    for (QWidget* each : std::initializer_list<QWidget*>{areAll_, overLabel_, over_, of_})
        cases->addWidget(each, each == over_ ? 1 : 0);
    body()->addLayout(cases);
}

const StudyEntry& StudyForm::chosen() const {
    return *findStudy(kind_->currentData().toString().toStdString());
}

void StudyForm::choose(const char* study) {
    kind_->setCurrentIndex(std::max(0, kind_->findData(QString::fromLatin1(study))));
}

void StudyForm::openChoices() {
    kind_->setFocus(Qt::ShortcutFocusReason);
    kind_->showPopup();
}

void StudyForm::showOptions() {
    using Over = StudyEntry::Over;
    const StudyEntry& entry = chosen();
    const bool hasMetric = entry.over == Over::steps || entry.over == Over::wantedError ||
                           entry.over == Over::wishes || entry.over == Over::usableSteps;
    for (QWidget* each : std::initializer_list<QWidget*>{metricLabel_, metric_, isAtEnd_})
        each->setVisible(hasMetric);
    wishes_->setVisible(entry.over == Over::wantedError);
    areAll_->setVisible(entry.over == Over::wantedError);
    for (QWidget* each : std::initializer_list<QWidget*>{overLabel_, over_, of_})
        each->setVisible(entry.over == Over::wantedError || entry.over == Over::wishes);
    findsLimits_->setVisible(entry.over == Over::numbers);
    x_->setVisible(entry.over == Over::numbers);
    y_->setVisible(entry.over == Over::numbers);
    kind_->setToolTip(QString::fromStdString(entry.item.description));
    emit chosenChanged();
}

void StudyForm::offer(const ResolvedScene& resolved) {
    metric_->offer(resolved);
    x_->offer(resolved.scene);
    y_->offer(resolved.scene);
}

Study StudyForm::study(const ResolvedScene& resolved, double wantedError) const {
    using Over = StudyEntry::Over;
    const Over over = chosen().over;
    if (over == Over::extremes) return ExtremesStudy();
    if (over == Over::testEquation) return LinearStudy(resolved, LinearOptions{});
    if (over == Over::numbers) {
        StabilityOptions options;
        const std::optional<VariedNumber> x = x_->value();
        options.x = *x;
        options.y = y_->value();
        options.findsLimits = findsLimits_->isChecked();
        return StabilityStudy(resolved, options);
    }
    if (metric_->currentText().isEmpty())
        throw InvalidScene("", "the system has nothing that this study measures",
                           "a reference in the scene, or another study");
    if (over == Over::wantedError || over == Over::wishes) return search(resolved, wantedError);
    if (over == Over::usableSteps) {
        LimitsOptions options;
        options.wishes = {{metric_->currentText().toStdString(), wantedError}};
        options.isAtEnd = isAtEnd_->isChecked();
        return LimitsStudy(resolved, options);
    }
    SweepOptions options;
    options.metric = metric_->currentText().toStdString();
    options.isAtEnd = isAtEnd_->isChecked();
    return Sweep(resolved, options);
}

/// As the command line has it: the wanted error and the wishes beside it, or a ladder of wishes.
Study StudyForm::search(const ResolvedScene& resolved, double wantedError) const {
    const bool isLadder = chosen().over == StudyEntry::Over::wishes;
    StudyRequest request;
    request.kind = chosen().item.id;
    if (!isLadder) request.wishes = wishes_->wishes();
    if (!isLadder && areAll_->isChecked()) request.candidates = "all";
    request.isFinal = isAtEnd_->isChecked();
    request.over = over_->text().trimmed().toStdString();
    if (!request.over.empty()) request.of = of_->currentData().toString().toStdString();
    if (isLadder || !wishes_->areAlone()) request.metric = metric_->currentText().toStdString();
    if (!isLadder && !wishes_->areAlone()) request.error = wantedError;
    return makeStudy(chosen(), request, &resolved, 0);
}

bool StudyForm::checkWishes(const ResolvedScene& resolved) {
    return chosen().over != StudyEntry::Over::wantedError || wishes_->check(resolved);
}

void StudyForm::showState(const StudyJob& job, const QString& text) {
    run_->setText(job.isRunning() ? tr("Stop") : tr("Run the study"));
    progress_->setValue(static_cast<int>(1000 * job.fraction()));
    state_->setText(text);
}

}  // namespace extremal
