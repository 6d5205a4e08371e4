// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/discretizer.hpp"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/family/family.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/family/stability_check.hpp"
#include "engine/phase/monitored.hpp"
#include "ui/base/background.hpp"
#include "ui/base/format.hpp"
#include "ui/base/theme.hpp"
#include "ui/base/sideways_area.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/scheme_finder.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

const std::vector<KeptQuantity> energyAlone{{"energy", "energy"}};

/// The cell as one that keeps the energy, and what is known of it then.
std::pair<ChoiceGrid::Cell, Properties> keepingEnergy(ChoiceGrid::Cell cell) {
    const auto* const test = familyPart<TestSpace>(cell.discretization.space);
    Properties known;
    if (test)
        known = test->describe(cell.discretization, energyAlone);
    else
        known.refusal = "its steps keep the energy in another way, or not at all";
    cell.text = known.shortName;
    cell.superscript.clear();
    cell.title += ", keeps the energy";
    return {std::move(cell), std::move(known)};
}

}  // namespace

DiscretizerCell::DiscretizerCell(ChoiceGrid::Cell choice, const Properties& known, QWidget* parent)
    : QAbstractButton(parent), choice_(std::move(choice)) {
    const bool isPossible = known.refusal.empty() && known.instability.empty();
    setEnabled(isPossible);
    setObjectName("cell." + QString::fromStdString(choice_.id));
    const QString title = QString::fromStdString(choice_.title);
    setAccessibleName(title.at(0).toUpper() + title.mid(1));
    about_ = textAbout(known);
    words_ = wordsOf(known);
    setAccessibleDescription(QString(about_).replace("<br>", "; ").remove(QRegularExpression("<[^>]*>")));
    setFocusPolicy(Qt::TabFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setCursor(isPossible ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

/// By its rule where it has nodes, else by the name of the scheme.
QString DiscretizerCell::wordsOf(const Properties& known) const {
    if (!isEnabled() || known.claims.order <= 0) return {};
    const Settings& rule = quadrature();
    const Value* const nodes = rule.find("nodes");
    QString name;
    if (nodes && nodes->isNumber() && !choice_.isOwn)
        name = ruleTitle(rule.type) + ' ' + QString::number(rule.integer("nodes"));
    else
        name = QString::fromStdString(known.knownAs);
    return name.isEmpty() ? QString() : tr("%1, order %2").arg(name).arg(known.claims.order);
}

void DiscretizerCell::setCost(std::optional<CellCost> cost) {
    cost_ = std::move(cost);
    update();
}

QString DiscretizerCell::textAbout(const Properties& known) const {
    const QString discretization = QString::fromStdString(choice_.title).toHtmlEscaped();
    if (!known.refusal.empty())
        return tr("<b>%1</b><br>No scheme: %2")
            .arg(discretization, QString::fromStdString(known.refusal).toHtmlEscaped());
    if (!known.instability.empty())
        return tr("<b>%1</b><br>Unstable for every step: %2")
            .arg(discretization, QString::fromStdString(known.instability).toHtmlEscaped());
    if (!known.remark.empty())
        return "<b>" + QString::fromStdString(known.knownAs).toHtmlEscaped() + "</b><br>" + discretization +
               "<br>" + QString::fromStdString(known.remark).toHtmlEscaped();
    QString text =
        "<b>" +
        (known.knownAs.empty() ? discretization : QString::fromStdString(known.knownAs).toHtmlEscaped()) +
        "</b>";
    if (!known.knownAs.empty()) text += "<br>" + discretization;
    QStringList badges{tr("order %1").arg(known.claims.order)};
    badges << tr("order %1 between the nodes").arg(known.curveOrder);
    if (known.claims.isSymplectic) badges << tr("symplectic");
    if (known.claims.isSymmetric) badges << tr("symmetric");
    badges << (known.isExplicit ? tr("explicit where the model is separable") : tr("implicit"));
    text += "<br>" + badges.join(" · ");
    if (!known.shortfall.empty()) text += "<br>" + QString::fromStdString(known.shortfall).toHtmlEscaped();
    if (!known.claims.conserves.empty()) {
        QStringList kept;
        for (const std::string& c : known.claims.conserves) kept << QString::fromStdString(c);
        text += "<br>" + tr("conserves %1").arg(kept.join(", "));
    }
    if (std::isinf(known.stabilityLimit))
        text += "<br>" + tr("stable at every step on the harmonic oscillator");
    else if (known.stabilityLimit > 0)
        text += "<br>" + tr("stable on the harmonic oscillator for h ω below %1")
                             .arg(shortNumber(known.stabilityLimit, 3));
    if (std::isfinite(known.stabilityLimit) && known.stabilityLimit > 0 && hasTable(choice_.discretization))
        if (const auto& intervals = tableStability(choice_.discretization)->intervals; intervals.size() > 1)
            text += "<br>" + tr("unstable for h ω %1").arg(QString::fromStdString(intervalsText(intervals)));
    return text;
}

void DiscretizerCell::setTheme(const Theme& theme) {
    theme_ = &theme;
    setMinimumSize(minimumSizeHint() * std::max(1.0, theme.fontScale));
    update();
}

void DiscretizerCell::setUse(Use use, int style) {
    if (use_ == use && style_ == style) return;
    use_ = use;
    style_ = style;
    setProperty("use", use == Use::on ? "on" : use == Use::off ? "off" : "none");
    update();
}

/// Cells that are no scheme are disabled, and say why all the same.
bool DiscretizerCell::event(QEvent* event) {
    if (event->type() == QEvent::Enter || event->type() == QEvent::FocusIn) emit pointedAt(true);
    if (event->type() == QEvent::Leave || event->type() == QEvent::FocusOut) emit pointedAt(false);
    return QAbstractButton::event(event);
}

void DiscretizerCell::paintEvent(QPaintEvent*) {
    if (!theme_) return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    const bool isOn = use_ == Use::on;
    const QColor own = theme_->series(style_).color;
    QColor ground = isOn ? theme_->ground(own) : theme_->field;
    if (cost_ &&
        !isOn) {  // stronger the cheaper, down to a hundredth of the cost of the dearest that is told apart
        constexpr double range = 100;
        constexpr int faint = 6, full = 52;
        const double share =
            cost_->seconds > 0 ? 1 - std::log(std::max(1.0, cost_->times)) / std::log(range) : -1;
        ground = share < 0 ? theme_->panel
                           : theme_->pale(theme_->accent, faint + static_cast<int>((full - faint) * share));
    }
    if (!isEnabled()) ground = Qt::transparent;
    if (isEnabled() && underMouse() && !isOn) ground = theme_->selection;
    painter.setPen(hasFocus()         ? QPen(theme_->accent, 1.5)
                   : use_ == Use::off ? QPen(own, 1.2)
                                      : QPen(Qt::NoPen));
    painter.setBrush(ground);
    painter.drawRoundedRect(box, 4, 4);
    if (!isEnabled()) {
        painter.setPen(QPen(theme_->line, 1));
        painter.drawLine(QPointF(box.center().x() - 3, box.center().y()),
                         QPointF(box.center().x() + 3, box.center().y()));
        return;
    }
    paintText(painter, isOn                             ? theme_->onAccent
                       : cost_ && !(cost_->seconds > 0) ? theme_->muted
                                                        : theme_->text);
}

/// In words, where there is room for them.
void DiscretizerCell::paintText(QPainter& painter, const QColor& colour) const {
    const QFontMetricsF plain(theme_->body());
    if (!words_.isEmpty() && plain.horizontalAdvance(words_) <= width() - 8) {
        painter.setPen(colour);
        painter.setFont(theme_->body());
        painter.drawText(rect(), Qt::AlignCenter, words_);
        return;
    }
    const QString name = QString::fromStdString(choice_.text),
                  order = QString::fromStdString(choice_.superscript);
    QFont font = theme_->strong();
    font.setPixelSize(font.pixelSize() - 1);
    QFont small = theme_->caption();
    small.setPixelSize(small.pixelSize() - 3);
    const QFontMetricsF metrics(font), smallMetrics(small);
    double orderWidth = order.isEmpty() ? 0 : smallMetrics.horizontalAdvance(order) + 1;
    const bool hasRoom = metrics.horizontalAdvance(name) + orderWidth <= width() - 2;
    if (!hasRoom) orderWidth = 0;
    const double left = (width() - metrics.horizontalAdvance(name) - orderWidth) / 2;
    const double baseline = (height() + metrics.capHeight()) / 2;
    painter.setPen(colour);
    painter.setFont(font);
    painter.drawText(QPointF(left, baseline), name);
    painter.setFont(small);
    if (hasRoom) painter.drawText(QPointF(left + metrics.horizontalAdvance(name) + 1, baseline - 4), order);
}

Discretizer::Discretizer(Workspace& workspace, QWidget* parent)
    : Card(tr("Discretizer"), parent), workspace_(workspace) {
    costs_ = new QPushButton(tr("Costs"));
    costs_->setObjectName("cellCosts");
    costs_->setCheckable(true);
    costs_->setFocusPolicy(Qt::TabFocus);
    costs_->setToolTip(
        tr("Measures what the wanted error costs with each cell, and colours them: the stronger the "
           "cheaper (Ctrl+Shift+D)"));
    header()->addWidget(costs_);
    energy_ = new QPushButton(tr("Energy"));
    energy_->setObjectName("cellsKeepEnergy");
    energy_->setCheckable(true);
    energy_->setFocusPolicy(Qt::TabFocus);
    energy_->setToolTip(
        tr("What the cells keep: the symplectic form, or, while this is pressed, the energy. The curves are "
           "the same, and are tested by other functions"));
    header()->addWidget(energy_);
    connect(energy_, &QPushButton::toggled, this, [this] {
        fill();
        showUses();
    });
    room_ = new SidewaysArea;
    room_->setAccessibleName(tr("Discretizer"));
    body()->addWidget(room_);
    about_ = makeLabel({}, "caption");
    about_->setObjectName("aboutCell");
    about_->setWordWrap(true);
    about_->setTextFormat(Qt::RichText);
    about_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    constexpr int lines = 4;  // so that the card keeps its height
    about_->setMinimumHeight(lines * fontMetrics().lineSpacing());
    body()->addWidget(about_);
    showAbout(nullptr);
    refresh();
    later_.setSingleShot(true);  // in a turn of its own
    later_.setInterval(0);
    connect(&workspace_, &Workspace::sceneChanged, &later_, qOverload<>(&QTimer::start));
    connect(&later_, &QTimer::timeout, this, &Discretizer::refresh);
}

void Discretizer::showAbout(const DiscretizerCell* cell) {
    const QString cost = cell && cell->cost() ? "<br>" + cell->cost()->words.toHtmlEscaped() : QString();
    about_->setText(
        cell ? cell->about() + cost
        : !strip_.isEmpty()
            ? strip_
            : tr("Point at a cell: what it is, its order and what it keeps. A click adds it to the "
                 "comparison."));
}

void Discretizer::setStripText(const QString& text) {
    strip_ = text.toHtmlEscaped();
    showAbout(nullptr);
}

bool Discretizer::isCurrent() const {
    return workspace_.hasScene() && workspace_.scene().model == model_ && !later_.isActive();
}

void Discretizer::refresh() {
    if (!workspace_.hasScene()) return;
    showUses();
    look();
}

/// One search at a time; what comes while it goes on is looked for after it.
void Discretizer::look() {
    const Settings& model = workspace_.scene().model;
    if (isLooking_ || model == model_) return;
    isLooking_ = true;
    runInBackground([self = QPointer(this), model, system = workspace_.resolved()->system] {
        auto offered = std::make_shared<std::vector<DescribedGrid>>(describedChoices(*system));
        sendToWindow([self, model, offered] {
            if (!self) return;
            self->isLooking_ = false;
            self->take(model, std::move(*offered));
            self->look();
        });
    });
}

void Discretizer::take(const Settings& model, std::vector<DescribedGrid> offered) {
    if (workspace_.scene().model.type != model.type) return;  // that one's is looked for next
    model_ = model;
    const bool hasEnergy = canKeepInvariants(*workspace_.resolved()->system);
    energy_->setVisible(hasEnergy);
    if (!hasEnergy) energy_->setChecked(false);
    if (!grid_ || offered != offered_) {
        offered_ = std::move(offered);
        fill();
    }
    showUses();
}

void Discretizer::fill() {
    cells_.clear();
    delete grid_;
    grid_ = new QWidget;
    grid_->setProperty("ground", "panel");
    auto* column = new QVBoxLayout(grid_);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(3);
    for (std::size_t i = 0; i < offered_.size(); ++i) {
        const QString subtitle = QString::fromStdString(offered_[i].choices.subtitle);
        if (i > 0) column->addWidget(makeLabel(subtitle, "caption"));
        auto* grid = new QGridLayout;
        grid->setContentsMargins(0, 0, 0, 0);
        grid->setHorizontalSpacing(2);
        grid->setVerticalSpacing(3);
        column->addLayout(grid);
        addGrid(offered_[i], *grid);
    }
    room_->setWidget(grid_);
    showAbout(nullptr);
    setSubtitle(offered_.empty() ? QString() : QString::fromStdString(offered_.front().choices.subtitle));
    emit filled();
}

void Discretizer::addGrid(const DescribedGrid& offered, QGridLayout& grid) {
    const auto& [choices, known] = offered;
    const auto addHeading = [&](const ChoiceGrid::Heading& heading, int row, int column) {
        QLabel* label = makeLabel(QString::fromStdString(heading.text), "caption");
        if (!heading.description.empty()) label->setToolTip(QString::fromStdString(heading.description));
        if (row == 0) label->setAlignment(Qt::AlignHCenter);
        grid.addWidget(label, row, column);
    };
    const auto width = static_cast<int>(choices.width());
    for (int column = 0; column < width; ++column) {
        grid.setColumnStretch(column + 1, 1);
        if (!choices.columns.empty())
            addHeading(choices.columns[static_cast<std::size_t>(column)], 0, column + 1);
    }
    for (int row = 0; row < static_cast<int>(choices.rows.size()); ++row) {
        addHeading(choices.rows[static_cast<std::size_t>(row)], row + 1, 0);
        for (int column = 0; column < width; ++column) {
            const auto place = static_cast<std::size_t>(row * width + column);
            const auto [choice, about] = energy_->isChecked() ? keepingEnergy(choices.cells[place])
                                                              : std::pair(choices.cells[place], known[place]);
            auto* cell = new DiscretizerCell(choice, about);
            if (theme_) cell->setTheme(*theme_);
            connect(cell, &QAbstractButton::clicked, this, [this, cell] { choose(*cell); });
            connect(cell, &DiscretizerCell::pointedAt, this,
                    [this, cell](bool isPointedAt) { showAbout(isPointedAt ? cell : nullptr); });
            cells_.push_back(cell);
            grid.addWidget(cell, row + 1, column + 1);
        }
    }
}

void Discretizer::setTheme(const Theme& theme) {
    theme_ = &theme;
    for (DiscretizerCell* cell : cells_) cell->setTheme(theme);
}

DiscretizerCell* Discretizer::cell(int degree, const QString& rule) const {
    return findChild<DiscretizerCell*>(QString("cell.%1.%2").arg(degree).arg(rule));
}

void Discretizer::showUses() {
    const std::vector<SchemeSpec>& schemes = workspace_.scene().schemes;
    for (DiscretizerCell* cell : cells_) {
        const int there = findScheme(*workspace_.resolved(), cell->choice(), energy_->isChecked());
        if (there < 0) {
            cell->setUse(DiscretizerCell::Use::none, 0);
            continue;
        }
        const auto place = static_cast<std::size_t>(there);
        cell->setUse(schemes[place].isEnabled ? DiscretizerCell::Use::on : DiscretizerCell::Use::off,
                     styleOf(schemes[place], place));
    }
}

void Discretizer::choose(const DiscretizerCell& cell) {
    const Scene& scene = workspace_.scene();
    if (scene.model.type != model_.type) return;  // the cells of this model are on their way
    const bool isOwn = cell.choice().isOwn;
    if (const int there = findScheme(*workspace_.resolved(), cell.choice(), energy_->isChecked());
        there >= 0) {
        workspace_.selectScheme(there);
        if (isOwn) emit ownChosen();
        return;
    }
    Value scheme = newPair(scene, cell.space(), cell.quadrature());
    if (energy_->isChecked()) {
        scheme.set("keep", "energy");
        scheme.set("label",
                   uniqueLabel(scene, scheme.find("label")->asString() + tr(", energy").toStdString()));
    }
    const QString label = QString::fromStdString(scheme.find("label")->asString());
    if (!workspace_.edit(editsForAdding(scene, scheme), tr("Add %1").arg(label))) return;
    workspace_.selectScheme(static_cast<int>(workspace_.scene().schemes.size()) - 1);
    if (isOwn) emit ownChosen();
}

}  // namespace extremal
