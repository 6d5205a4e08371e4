// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/header_bar.hpp"

#include <QHBoxLayout>
#include <QEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/seek_slider.hpp"
#include "ui/study/background_sweep.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

QPushButton* button(const QString& text, const QString& tip, QWidget* parent) {
    auto* b = new QPushButton(text, parent);
    b->setToolTip(tip);
    b->setFocusPolicy(Qt::TabFocus);
    return b;
}

}  // namespace

HeaderBar::HeaderBar(Workspace& workspace, RunControl& run, const BackgroundSweep& sweep, Wanted& wanted,
                     QWidget* parent)
    : QWidget(parent), workspace_(workspace), run_(run), sweep_(sweep), error_(wanted) {
    setProperty("ground", "panel");
    setAttribute(Qt::WA_StyledBackground);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(18, 9, 14, 9);
    row->setSpacing(8);
    title_ = makeElidedLabel({}, "heading", this);
    file_ = makeLabel({}, "caption", this);
    title_->setObjectName("title");
    title_->setCursor(Qt::IBeamCursor);
    title_->installEventFilter(this);
    titleEdit_ = new QLineEdit(this);
    titleEdit_->setObjectName("titleEdit");
    titleEdit_->setAccessibleName(tr("Title of the scene"));
    titleEdit_->setMinimumWidth(260);
    titleEdit_->hide();
    connect(titleEdit_, &QLineEdit::editingFinished, this, &HeaderBar::takeTitle);
    row->addWidget(title_);
    row->addWidget(titleEdit_);
    row->addSpacing(6);
    row->addWidget(file_);
    row->addStretch(1);
    makeWanted(*row);
    row->addSpacing(8);
    makeButtons(*row);
    connect(&sweep_, &BackgroundSweep::changed, this, &HeaderBar::showChoice);
    connect(&workspace_, &Workspace::sceneChanged, this, &HeaderBar::showScene);
    connect(&workspace_, &Workspace::fileChanged, this, &HeaderBar::showScene);
    connect(&run_, &RunControl::stateChanged, this, &HeaderBar::showState);
    connect(&run_, &RunControl::resultsChanged, this, &HeaderBar::showChoice);
    connect(&error_, &Wanted::changed, this, &HeaderBar::showWanted);
    showScene();
    showState();
    showWanted();
}

/// The wanted error, and the scheme that would be chosen for it.
void HeaderBar::makeWanted(QHBoxLayout& row) {
    auto* label = makeLabel(tr("wanted error"), "caption", this);
    wanted_ = new SeekSlider(Qt::Horizontal, this);
    wanted_->setRange(-14, 0);
    wanted_->setMinimumWidth(70);
    wanted_->setMaximumWidth(190);
    wanted_->setAccessibleName(tr("Wanted error"));
    wanted_->setToolTip(
        tr("The largest acceptable error: shows the cheapest scheme measured so far that reaches it"));
    use_ = button(tr("Use it"), tr("Gives the scheme this step"), this);
    use_->setObjectName("useChoice");
    use_->hide();
    connect(use_, &QPushButton::clicked, this, &HeaderBar::useChoice);
    choice_ = makeElidedLabel({}, "strong", this);
    row.addWidget(label);
    row.addWidget(wanted_, 1);
    row.addWidget(choice_, 3);
    row.addWidget(use_);
    connect(wanted_, &QSlider::valueChanged, this,
            [this](int power) { error_.setError(std::pow(10.0, power)); });
}

void HeaderBar::makeButtons(QHBoxLayout& row) {
    runButton_ = button(tr("Run"), tr("Compute everything again (R)"), this);
    runButton_->setProperty("kind", "primary");
    runButton_->setObjectName("run");
    auto* step = button(tr("Step"), tr("Next row (Right)"), this);
    auto* save = button(tr("Export"), tr("Export everything into a folder (Ctrl+Shift+E)"), this);
    auto* palette = button(tr("Ctrl+K"), tr("Find an action or a preset"), this);
    for (QPushButton* b : {runButton_, step, save, palette}) row.addWidget(b);
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
}

void HeaderBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    // Below, what menus and the title of the window have as well gives way; 940 pixels of usual letters.
    const int narrow = 134 * fontMetrics().averageCharWidth();
    file_->setVisible(width() >= narrow);
    for (QPushButton* button : secondary_) button->setVisible(width() >= narrow);
}

/// A click on the title is where it is written.
bool HeaderBar::eventFilter(QObject* watched, QEvent* event) {
    if (watched == title_ && event->type() == QEvent::MouseButtonRelease && isSceneInSight_) writeTitle();
    return QWidget::eventFilter(watched, event);
}

void HeaderBar::writeTitle() {
    titleEdit_->setText(QString::fromStdString(workspace_.scene().title));
    title_->hide();
    titleEdit_->show();
    titleEdit_->setFocus();
    titleEdit_->selectAll();
}

void HeaderBar::takeTitle() {
    if (titleEdit_->isHidden()) return;
    titleEdit_->hide();
    title_->show();
    const std::string text = titleEdit_->text().trimmed().toStdString();
    if (workspace_.hasScene() && text != workspace_.scene().title)
        workspace_.edit({{"/title", text}}, tr("Change the title"));
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
    runButton_->setEnabled(isSceneInSight_);
}

void HeaderBar::setSceneInSight(bool isInSight) {
    isSceneInSight_ = isInSight;
    for (QWidget* part : std::initializer_list<QWidget*>{wanted_, choice_, use_}) part->setEnabled(isInSight);
    for (QPushButton* button : secondary_) button->setEnabled(isInSight);
    showState();
}

/// The slider stands at the next power of ten; the number is exact.
void HeaderBar::showWanted() {
    const QSignalBlocker blocker(wanted_);
    wanted_->setValue(static_cast<int>(std::lround(std::log10(error_.error()))));
    wanted_->setAccessibleDescription(tr("%1; %2").arg(shortNumber(error_.error()), wanted_->toolTip()));
    showChoice();
}

void HeaderBar::showChoice() {
    struct Candidate {
        SchemeSpec spec;
        double seconds = 0, error = 0;
        bool isOfScene = true;
    };
    std::vector<Candidate> all;
    if (const auto results = run_.results()) {
        for (const auto& s : results->schemes) {
            const Summary& m = s->summary;
            if (m.status == RunStatus::done && m.steps > 0 && std::isfinite(m.maxError))
                all.push_back({s->spec, m.cpuSeconds, m.maxError});
        }
        for (const SweptScheme& swept : sweep_.known())
            for (const SweptPoint& p : swept.points) {
                Candidate other{swept.spec, p.seconds, p.error, false};
                (other.spec.tolerance ? *other.spec.tolerance : other.spec.step.value) = p.step;
                other.spec.step.expression.clear();
                all.push_back(std::move(other));
            }
    }
    const double wanted = error_.error();
    // What the scene has is proposed where another step would not save a tenth.
    const auto price = [](const Candidate& c) { return (c.isOfScene ? 0.9 : 1) * c.seconds; };
    const Candidate *cheapest = nullptr, *nearest = nullptr;
    for (const Candidate& c : all) {
        if (c.error <= wanted && (!cheapest || price(c) < price(*cheapest))) cheapest = &c;
        if (!nearest || c.error < nearest->error) nearest = &c;
    }
    QString text = shortNumber(wanted, 2);
    if (cheapest)
        text += QStringLiteral("  →  %1, %2, %3")
                    .arg(QString::fromStdString(cheapest->spec.label), stepText(cheapest->spec),
                         shortTime(cheapest->seconds));
    else if (nearest)
        text += tr("  →  no scheme; the closest is %1 with %2")
                    .arg(QString::fromStdString(nearest->spec.label), shortNumber(nearest->error));
    else if (run_.results() && run_.results()->isFinished)
        text += offersReference() ? tr("  →  there is no reference: no errors")
                                  : tr("  →  no errors are known here");
    choice_->setText(text);
    const bool isOther = cheapest && !cheapest->isOfScene;
    use_->setText(offersReference() ? tr("Compute one") : tr("Use it"));
    use_->setToolTip(offersReference()
                         ? tr("Compares the schemes with a run whose own error is small; it may take longer "
                              "than they do")
                         : tr("Gives the scheme this step"));
    chosen_ = isOther ? cheapest->spec.label : std::string();
    if (isOther)
        chosenStep_ = cheapest->spec.tolerance ? *cheapest->spec.tolerance : cheapest->spec.step.value;
    use_->setVisible(isOther || offersReference());
}

/// Whether the scene was computed, and asks for no reference.
bool HeaderBar::offersReference() const {
    return workspace_.hasScene() && run_.results() && run_.results()->isFinished &&
           workspace_.scene().reference.kind == ReferenceSpec::Kind::none;
}

/// The reference that the program chooses, with the observable and the plot of errors.
void HeaderBar::computeReference() {
    const Scene& scene = workspace_.scene();
    std::vector<Edit> edits{{"/reference", std::nullopt}};
    const auto has = [](const auto& all, const auto& isError) {
        return std::any_of(all.begin(), all.end(), isError);
    };
    const Value* const observe = workspace_.document().find("observe");
    if (observe && observe->isArray() &&
        !has(scene.observe, [](const std::string& name) { return name == "error"; }))
        edits.push_back({"/observe/-", "error"});
    const Value* const views = workspace_.document().find("views");
    if (views && views->isArray() &&
        !has(views->asArray(), [](const Value& view) { return view == Value("error"); }))
        edits.push_back({"/views/-", "error"});
    workspace_.edit(edits, tr("Compare with a reference"));
}

void HeaderBar::useChoice() {
    if (offersReference()) return computeReference();
    const auto& schemes = workspace_.scene().schemes;
    for (std::size_t i = 0; i < schemes.size(); ++i) {
        if (schemes[i].label != chosen_) continue;
        const std::string key = schemes[i].tolerance ? "/tolerance" : "/step";
        workspace_.edit({{"/schemes/" + std::to_string(i) + key, chosenStep_}},
                        tr("Use the step for the wanted error"));
        workspace_.selectScheme(static_cast<int>(i));
        return;
    }
}

}  // namespace extremal
