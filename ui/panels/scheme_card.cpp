// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/scheme_card.hpp"

#include "engine/model/system.hpp"
#include "engine/run/files/event_files.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "engine/scene/resolve.hpp"

#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/scrub_label.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/explain.hpp"
#include "ui/panels/line_sample.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

SchemeCard::SchemeCard(Workspace& workspace, int index, const Theme& theme, QWidget* parent)
    : QFrame(parent), workspace_(workspace), index_(index), theme_(&theme) {
    setProperty("card", true);
    setFocusPolicy(Qt::StrongFocus);
    layout_ = new QVBoxLayout(this);
    layout_->setContentsMargins(11, 8, 11, 9);
    layout_->setSpacing(3);
    makeHeader();
    second_ = new QHBoxLayout;
    second_->setSpacing(4);
    parts_ = makeElidedLabel({}, "caption");
    second_->addWidget(parts_, 1);
    layout_->addLayout(second_);
    refusal_ = makeLinkLabel("caption");
    refusal_->setObjectName("refusal");
    refusal_->setProperty("problem", true);
    refusal_->hide();
    layout_->addWidget(refusal_);
    events_ = makeLabel({}, "caption");
    events_->setObjectName("events");
    events_->setWordWrap(true);
    events_->hide();
    layout_->addWidget(events_);
    caution_ = makeLinkLabel("caption");
    caution_->setObjectName("caution");
    layout_->addWidget(caution_);
    remedy_ = new QPushButton;
    remedy_->setObjectName("remedy");
    connect(remedy_, &QPushButton::clicked, this, &SchemeCard::takeRemedy);
    layout_->addWidget(remedy_, 0, Qt::AlignLeft);
    makeFigures();
    failure_ = makeLabel({}, "strong");
    failure_->setWordWrap(true);
    advice_ = makeLinkLabel("caption");
    advice_->setObjectName("advice");
    for (QLabel* label : {failure_, advice_}) {
        label->hide();
        layout_->addWidget(label);
    }
    progress_ = new QProgressBar;
    progress_->setRange(0, 1000);
    progress_->setTextVisible(false);
    progress_->hide();
    layout_->addWidget(progress_);
    setIndex(index);
    connect(&workspace_, &Workspace::draftsChanged, this, &SchemeCard::showRefusal);
}

void SchemeCard::setIndex(int index) {
    index_ = index;
    setObjectName(QString("scheme.%1").arg(index));
    if (editor_) editor_->setIndex(index);
    showSpec();
}

const SchemeSpec& SchemeCard::spec() const {
    return workspace_.scene().schemes[static_cast<std::size_t>(index_)];
}

void SchemeCard::makeHeader() {
    auto* row = first_ = new QHBoxLayout;
    row->setSpacing(4);
    line_ = new LineSample;
    line_->setObjectName("toggle");
    connect(line_, &QAbstractButton::clicked, this, &SchemeCard::toggleOrSolo);
    line_->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(line_, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu;  // without a parent, which may go away while the menu is open
        fillColours(menu);
        menu.exec(line_->mapToGlobal(at));
    });
    name_ = makeWrappedLabel({}, "strong");
    nameEdit_ = new QLineEdit;
    nameEdit_->setObjectName("name");
    nameEdit_->setAccessibleName(tr("Name of the scheme"));
    nameEdit_->hide();
    connect(nameEdit_, &QLineEdit::editingFinished, this, &SchemeCard::finishName);
    step_ = new ScrubLabel;
    step_->setProperty("role", "strong");
    step_->setObjectName("stepLabel");
    step_->setToolTip(tr(
        "Click to type; drag sideways to scale it; the wheel over the selected scheme doubles or halves it, "
        "with Ctrl in smaller steps"));
    connect(step_, &ScrubLabel::clicked, this, [this] { editStep(); });
    connect(step_, &ScrubLabel::scrubbed, this,
            [this](int notches) { scaleStep(std::pow(10, 0.02 * notches)); });
    connect(step_, &ScrubLabel::turned, this, [this](int notches) {
        const bool isFine = QGuiApplication::keyboardModifiers() & Qt::ControlModifier;
        scaleStep(std::pow(isFine ? 1.1 : 2, notches));
    });
    stepEdit_ = new QLineEdit;
    stepEdit_->setObjectName("step");
    stepEdit_->setAccessibleName(tr("Step"));
    stepEdit_->setAlignment(Qt::AlignRight);
    stepEdit_->setProperty("room", "step");
    stepEdit_->hide();
    connect(stepEdit_, &QLineEdit::editingFinished, this, &SchemeCard::finishStep);
    auto* const dots = dots_ = new QToolButton;
    dots->setText(QStringLiteral("⋯"));
    dots->setFixedSize(22, 20);
    dots->setProperty("kind", "dots");
    dots->setPopupMode(QToolButton::InstantPopup);
    dots->setToolTip(tr("Edit, duplicate, remove, ..."));
    dots->setFocusPolicy(Qt::TabFocus);
    makeMenu(*dots);
    row->addWidget(line_);
    row->addWidget(name_, 1);
    row->addWidget(nameEdit_, 1);
    row->addWidget(step_);
    row->addWidget(stepEdit_);
    row->addWidget(dots);
    layout_->addLayout(row);
}

void SchemeCard::makeMenu(QToolButton& dots) {
    auto* menu = new QMenu(&dots);
    dots.setMenu(menu);
    menu->addAction(tr("Edit"), this, [this] { setEditing(!isEditing()); });
    menu->addAction(tr("Rename"), this, [this] { editName(); });
    menu->addAction(tr("On or off"), line_, [this] { line_->click(); });
    menu->addAction(tr("This scheme alone, or all"), this, [this] {
        workspace_.edit(editsForSolo(workspace_.scene(), index_), tr("Only %1").arg(name_->text()));
    });
    auto* colours = menu->addMenu(tr("Colour"));
    connect(colours, &QMenu::aboutToShow, this, [this, colours] { fillColours(*colours); });
    menu->addAction(tr("Duplicate"), this, [this] {
        workspace_.edit(editsForDuplicate(workspace_.scene(), index_), tr("Duplicate scheme"));
    });
    menu->addAction(tr("Move up"), this, [this] { emit moveRequested(index_, -1); });
    menu->addAction(tr("Move down"), this, [this] { emit moveRequested(index_, 1); });
    menu->addSeparator();
    menu->addAction(tr("Remove"), this, [this] {
        workspace_.edit(editsForRemoval(workspace_.scene(), index_), tr("Remove scheme"));
    });
}

/// Colours with their dashes.
void SchemeCard::fillColours(QMenu& menu) {
    menu.clear();
    const int count = static_cast<int>(theme_->seriesColors.size());
    for (int style = 0; style < count; ++style) {
        QPixmap sample(QSize(30, 14) * devicePixelRatioF());
        sample.setDevicePixelRatio(devicePixelRatioF());
        sample.fill(Qt::transparent);
        QPainter painter(&sample);
        drawLineSample(painter, QRectF(0, 0, 30, 14), *theme_, style, true);
        painter.end();
        QAction* action = menu.addAction(QIcon(sample), tr("Colour %1").arg(style + 1), this, [this, style] {
            const std::vector<Edit> edits = editsForStyle(workspace_.scene(), index_, style);
            if (!edits.empty()) workspace_.edit(edits, tr("Change the colour of %1").arg(name_->text()));
        });
        action->setEnabled(style != styleOf(spec(), static_cast<std::size_t>(index_)));
    }
}

/// With Alt this scheme alone stays on.
void SchemeCard::toggleOrSolo() {
    const bool isSolo = QGuiApplication::keyboardModifiers() & Qt::AltModifier;
    workspace_.edit(
        isSolo ? editsForSolo(workspace_.scene(), index_) : editsForToggle(workspace_.scene(), index_),
        tr("Switch %1").arg(QString::fromStdString(spec().label)));
}

void SchemeCard::scaleStep(double factor) {
    if (hasElements()) {
        const int now = elementsOf(spec()), scaled = static_cast<int>(std::lround(now / factor));
        const int next = std::max(2, scaled != now ? scaled : factor < 1 ? now + 1 : now - 1);
        const Edit edit = stepEdit(Value(next));
        if (next != now)
            workspace_.edit({edit}, tr("Change the number of elements"),
                            QString::fromStdString(edit.pointer));
        return;
    }
    const std::vector<Edit> edits = editsForStep(workspace_.scene(), index_, factor);
    if (!edits.empty())
        workspace_.edit(edits, tr("Change the step"), QString::fromStdString(edits[0].pointer));
}

void SchemeCard::makeFigures() {
    figures_ = new QWidget;
    auto* grid = new QGridLayout(figures_);
    grid->setContentsMargins(0, 2, 0, 0);
    grid->setVerticalSpacing(1);
    grid->setHorizontalSpacing(6);
    int column = 0;
    const auto add = [&](const QString& caption) {
        Figure figure{makeLabel(caption, "caption"), makeLabel({}, "strong")};
        figure.value->setObjectName(caption);
        for (QLabel* label : {figure.caption, figure.value}) {
            label->setCursor(Qt::WhatsThisCursor);
            label->installEventFilter(this);
        }
        grid->addWidget(figure.caption, 0, column);
        grid->addWidget(figure.value, 1, column);
        grid->setColumnStretch(column++, 1);
        return figure;
    };
    cost_ = add(tr("cost"));
    error_ = add(tr("error"));
    order_ = add(tr("order"));
    steps_ = add(tr("steps"));
    layout_->addWidget(figures_);
}

void SchemeCard::setTheme(const Theme& theme) {
    theme_ = &theme;
    line_->show(theme, styleOf(spec(), static_cast<std::size_t>(index_)), spec().isEnabled);
}

void SchemeCard::showSpec() {
    const SchemeSpec& s = spec();
    const QString label = QString::fromStdString(s.label);
    shownLabel_ = s.label;
    setAccessibleName(tr("Scheme %1").arg(label));
    name_->setText(label);
    name_->setEnabled(s.isEnabled);
    step_->setText(hasElements() ? tr("%n elements", nullptr, elementsOf(s)) : stepText(s));
    steps_.caption->setText(hasElements() ? tr("elements") : tr("steps"));
    step_->setEnabled(s.isEnabled);
    parts_->setToolTip({});
    parts_->setText(s.isEnabled ? schemeText(s) : schemeText(s) + tr(" · off"));
    placeStep();
    line_->show(*theme_, styleOf(s, static_cast<std::size_t>(index_)), s.isEnabled);
    line_->setToolTip(tr("Switch this scheme on or off (key %1); with Alt: this one alone, or all. A right "
                         "click chooses the "
                         "colour")
                          .arg(index_ + 1));
    line_->setAccessibleName(tr("Switch %1 on or off").arg(label));
    dots_->setAccessibleName(tr("Actions of %1").arg(label));
    if (!s.isEnabled) showResult(nullptr, false, {});
    showCaution();
    showRefusal();
}

namespace {

std::string unitOfError(const SchemeResult& result) {
    const auto& columns = result.trajectory.columns;
    const auto error =
        std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.name == "error"; });
    return error == columns.end() ? std::string() : error->unit;
}

/// The same discretization with the same step, under whatever name and colour.
bool isSameScheme(SchemeSpec a, const SchemeSpec& b) {
    a.label = b.label;
    a.style = b.style;
    a.isEnabled = b.isEnabled;
    a.allowsUnstable = b.allowsUnstable;
    return a == b;
}

}  // namespace

void SchemeCard::showResult(const SchemeResult* result, bool isStale, const ReferenceInfo& reference) {
    static const Summary nothing;
    // Numbers of another step or discretization do not stand beside this one.
    const bool isOfThis = result && (!isStale || isSameScheme(result->spec, spec()));
    const Summary& summary = isOfThis ? result->summary : nothing;
    const bool isRunning =
        isOfThis && (summary.status == RunStatus::running || summary.status == RunStatus::waiting);
    figures_->setVisible(result != nullptr);
    progress_->setVisible(isRunning && !isStale);
    if (result) progress_->setValue(static_cast<int>(1000 * result->fraction));
    if (isOfThis && !summary.about.empty())
        parts_->setText(schemeText(result->spec) + QStringLiteral(" · ") +
                        QString::fromStdString(summary.about));
    cost_.value->setText(summary.cpuSeconds > 0 ? shortTime(summary.cpuSeconds) : QStringLiteral("–"));
    // What a run that was stopped has measured so far is not a property of the scheme, and one that took no
    // step has only the start.
    const bool isMeasured =
        (summary.status == RunStatus::done || summary.status == RunStatus::failed) && summary.steps > 0;
    error_.value->setText(isMeasured ? shortNumber(summary.maxError) : QStringLiteral("–"));
    const bool hasOrder = isMeasured && summary.orderClaimed > 0;
    QString order = hasOrder ? QString::number(summary.orderClaimed) : QStringLiteral("–");
    if (std::isfinite(summary.orderMeasured)) {
        const bool agrees = std::abs(summary.orderMeasured - summary.orderClaimed) < 0.3;
        order = QString::number(summary.orderMeasured, 'f', 1);
        if (summary.orderClaimed > 0) order += agrees ? QStringLiteral(" ✓") : QStringLiteral(" ≠");
    }
    order_.value->setText(order);
    steps_.value->setText(summary.steps > 0 ? QString::number(summary.steps) : QStringLiteral("–"));
    for (const auto& [figure, text] :
         {std::pair{&cost_, explainCost(summary)},
          std::pair{&error_, explainError(summary, reference, result ? unitOfError(*result) : std::string())},
          std::pair{&order_, explainOrder(summary)},
          std::pair{&steps_, explainSteps(summary, hasElements())}}) {
        figure->value->setEnabled(!isStale);
        figure->value->setToolTip(text);
        figure->caption->setToolTip(text);
    }
    showFailure(summary);
    const std::string events = isOfThis ? eventsText(*result) : std::string();
    events_->setVisible(!events.empty());
    events_->setText(QString::fromStdString(events));
}

void SchemeCard::setSelected(bool isSelected) {
    if (property("selected").toBool() == isSelected) return;
    setProperty("selected", isSelected);
    step_->setTurnable(isSelected);
    repolish(*this);
}

void SchemeCard::resizeEvent(QResizeEvent* event) {
    QFrame::resizeEvent(event);
    placeStep();
}

/// The step stands beside the name, or below where the name needs the room.
void SchemeCard::placeStep() {
    constexpr int lineAndDots = 30 + 22 + 3 * 4;
    const QMargins m = layout_->contentsMargins();
    const int needed = name_->sizeHint().width() + step_->sizeHint().width();
    const bool isBelow = needed > width() - m.left() - m.right() - lineAndDots;
    QHBoxLayout* const row = isBelow ? second_ : first_;
    if (row->indexOf(step_) >= 0) return;
    // Not back by the width of a scroll bar: the height of the card decides whether there is one.
    constexpr int moreThanABar = 24;
    if (!isBelow && needed == neededBelow_ && width() < widthBelow_ + moreThanABar) return;
    widthBelow_ = width();
    neededBelow_ = needed;
    for (QWidget* part : {static_cast<QWidget*>(step_), static_cast<QWidget*>(stepEdit_)}) {
        (isBelow ? first_ : second_)->removeWidget(part);
        row->insertWidget(isBelow ? row->count() : row->count() - 1, part);  // before the dots
    }
}

void SchemeCard::mousePressEvent(QMouseEvent* event) {
    workspace_.selectScheme(index_);
    event->accept();  // beside the cards a click ends the selection
}

/// The name is edited in place, all else in the editor.
void SchemeCard::mouseDoubleClickEvent(QMouseEvent* event) {
    if (name_->geometry().contains(event->position().toPoint()))
        editName();
    else
        setEditing(!isEditing());
}

}  // namespace extremal
