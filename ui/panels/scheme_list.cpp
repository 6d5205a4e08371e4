// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/scheme_list.hpp"

#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "ui/base/card.hpp"
#include "ui/base/column_area.hpp"
#include "ui/base/format.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/workspace/fitting.hpp"
#include "ui/workspace/own_schemes.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

SchemeList::SchemeList(Workspace& workspace, RunControl& run, const Theme& theme, QWidget* parent)
    : QWidget(parent), workspace_(workspace), run_(run), theme_(&theme) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    auto* header = new QHBoxLayout;
    addButton_ = new QPushButton(tr("+ Add"));
    addButton_->setObjectName("add");
    addMenu_ = new QMenu(this);
    connect(addButton_, &QPushButton::clicked, this, &SchemeList::openAddMenu);
    header->addWidget(makeLabel(tr("Schemes"), "title"));
    header->addStretch();
    header->addWidget(addButton_);
    layout->addLayout(header);

    scroll_ = new ColumnArea;
    scroll_->setAccessibleName(tr("Schemes"));
    auto* inside = new QWidget;
    inside->setProperty("ground", "window");
    cardsLayout_ = new QVBoxLayout(inside);
    cardsLayout_->setContentsMargins(0, 0, 4, 0);
    cardsLayout_->setSpacing(9);
    cardsLayout_->addStretch();
    scroll_->setWidget(inside);
    layout->addWidget(scroll_, 1);

    connect(&workspace_, &Workspace::sceneChanged, this, &SchemeList::rebuild);
    connect(&workspace_, &Workspace::selectionChanged, this, &SchemeList::showSelection);
    connect(&run_, &RunControl::resultsChanged, this, &SchemeList::showResults);
}

void SchemeList::setWidths(int least, int most) { scroll_->setLimits(least, most); }

void SchemeList::addFoot(QWidget* foot) { layout()->addWidget(foot); }

void SchemeList::mousePressEvent(QMouseEvent*) { workspace_.selectScheme(-1); }

void SchemeList::fillAddMenu() {
    addMenu_->clear();
    const ChoiceGrid grid = choicesFor(workspace_.scene());
    QMenu* discretizations = addMenu_->addMenu(tr("Space × quadrature"));
    discretizations->menuAction()->setVisible(!grid.columns.empty());
    for (std::size_t column = 0; column < grid.columns.size(); ++column) {
        QMenu* sub = discretizations->addMenu(QString::fromStdString(grid.columns[column].description));
        for (std::size_t row = 0; row < grid.rows.size(); ++row) {
            const Discretization& made = grid.cells[row * grid.columns.size() + column].discretization;
            const Properties known = describe(made);
            if (!known.refusal.empty()) continue;
            QString text =
                tr("%1, order %2").arg(QString::fromStdString(known.space)).arg(known.claims.order);
            if (!known.knownAs.empty()) text += QStringLiteral(" – ") + QString::fromStdString(known.knownAs);
            sub->addAction(text, this,
                           [=, this] { add(newPair(workspace_.scene(), made.space, made.quadrature)); });
        }
        sub->menuAction()->setVisible(!sub->isEmpty());
    }
    QMenu* named = addMenu_->addMenu(tr("Named scheme"));
    for (const SchemeEntry* fitting : fittingSchemes(workspace_.scene())) {
        const SchemeEntry& entry = *fitting;
        if (entry.maxDegree == 0) {
            const std::string id = entry.item.id;
            named->addAction(QString::fromStdString(entry.item.title), this,
                             [=, this] { add(newNamed(workspace_.scene(), id)); });
            continue;
        }
        QMenu* sub = named->addMenu(QString::fromStdString(entry.item.title));
        const std::string stem = entry.item.id.substr(0, entry.item.id.rfind('-'));
        for (int s = entry.minDegree; s <= entry.maxDegree; ++s) {
            const std::string id = stem + "-" + std::to_string(s);
            sub->addAction(QString::fromStdString(id), this,
                           [=, this] { add(newNamed(workspace_.scene(), id)); });
        }
    }
    QMenu* own = addMenu_->addMenu(tr("Your own"));
    const OwnSchemes kept = ownSchemes();
    for (const std::string& name : kept.names())
        own->addAction(QString::fromStdString(name).replace("&", "&&"), this,
                       [=, this] { add(newOwn(workspace_.scene(), *kept.find(name))); });
    if (!own->isEmpty()) own->addSeparator();
    own->addAction(tr("Your schemes..."), this, &SchemeList::catalogueRequested);
    own->menuAction()->setVisible(!kept.names().empty() ||
                                  std::any_of(grid.cells.begin(), grid.cells.end(),
                                              [](const ChoiceGrid::Cell& cell) { return cell.isOwn; }));
    QMenu* baselines = addMenu_->addMenu(tr("Baseline"));
    for (const BaselineEntry* fitting : fittingBaselines(workspace_.scene())) {
        const BaselineEntry& entry = *fitting;
        const std::string id = entry.item.id;
        QAction* action = baselines->addAction(QString::fromStdString(entry.item.title), this,
                                               [=, this] { add(newBaseline(workspace_.scene(), id)); });
        action->setToolTip(QString::fromStdString(entry.item.description));
    }
    baselines->setToolTipsVisible(true);
    baselines->menuAction()->setVisible(!baselines->isEmpty());
}

void SchemeList::add(const Value& scheme) {
    const QString label = QString::fromStdString(scheme.find("label")->asString());
    if (workspace_.edit(editsForAdding(workspace_.scene(), scheme), tr("Add %1").arg(label)))
        workspace_.selectScheme(static_cast<int>(workspace_.scene().schemes.size()) - 1);
}

void SchemeList::openAddMenu() {
    fillAddMenu();
    addMenu_->popup(addButton_->mapToGlobal(QPoint(0, addButton_->height() + 2)));
}

SchemeCard* SchemeList::card(int index) const {
    return index >= 0 && index < static_cast<int>(cards_.size()) ? cards_[static_cast<std::size_t>(index)]
                                                                 : nullptr;
}

void SchemeList::setTheme(const Theme& theme) {
    theme_ = &theme;
    for (SchemeCard* card : cards_) card->setTheme(theme);
}

/// A card stays with its scheme, wherever that goes: cards are found by the name, and where one has a new
/// name by the place.
void SchemeList::rebuild() {
    const auto& schemes = workspace_.scene().schemes;
    std::vector<SchemeCard*> before = std::move(cards_);
    cards_.assign(schemes.size(), nullptr);
    const auto take = [&](std::size_t place, auto isIt) {
        const auto found = std::find_if(before.begin(), before.end(), isIt);
        if (cards_[place] || found == before.end()) return;
        cards_[place] = *found;
        *found = nullptr;
    };
    for (std::size_t i = 0; i < schemes.size(); ++i)
        take(i, [&](const SchemeCard* c) { return c && c->shownLabel() == schemes[i].label; });
    for (std::size_t i = 0; i < schemes.size(); ++i)
        take(i, [&](const SchemeCard* c) { return c && c->index() == static_cast<int>(i); });
    for (SchemeCard* card : before) {
        if (!card) continue;
        card->hide();
        card->deleteLater();
    }
    for (std::size_t i = 0; i < cards_.size(); ++i) {
        const int place = static_cast<int>(i);
        if (!cards_[i]) {
            cards_[i] = new SchemeCard(workspace_, place, *theme_);
            connect(cards_[i], &SchemeCard::moveRequested, this, [this](int index, int by) {
                workspace_.selectScheme(index);
                moveSelected(by);
            });
            connect(cards_[i], &SchemeCard::neighbourRequested, this,
                    [this](int index, int by) { focusRow(index + by); });
        }
        cardsLayout_->insertWidget(place, cards_[i]);
        cards_[i]->setIndex(place);
    }
    showResults();
    showSelection();
}

void SchemeList::showResults() {
    const auto results = run_.results();
    const Scene& scene = workspace_.scene();
    for (std::size_t i = 0; i < cards_.size() && i < scene.schemes.size(); ++i) {
        const SchemeResult* found = nullptr;
        if (results)
            for (const auto& result : results->schemes)
                if (result->spec.label == scene.schemes[i].label) found = result.get();
        cards_[i]->showResult(scene.schemes[i].isEnabled ? found : nullptr, run_.isStale(),
                              results ? results->reference : ReferenceInfo());
    }
}

void SchemeList::showSelection() {
    for (std::size_t i = 0; i < cards_.size(); ++i)
        cards_[i]->setSelected(static_cast<int>(i) == workspace_.selectedScheme());
}

void SchemeList::focusRow(int index) {
    SchemeCard* const there = card(index);
    if (!there) return;
    there->setFocus(Qt::TabFocusReason);
    scroll_->ensureWidgetVisible(there);
}

void SchemeList::editSelected() {
    if (SchemeCard* there = card(workspace_.selectedScheme())) there->setEditing(!there->isEditing());
}

bool SchemeList::closeEditors() {
    bool wasOpen = false;
    for (SchemeCard* each : cards_) {
        wasOpen = wasOpen || each->isEditing();
        each->setEditing(false);
    }
    return wasOpen;
}

void SchemeList::renameSelected() {
    if (SchemeCard* there = card(workspace_.selectedScheme())) there->editName();
}

void SchemeList::editStep(int index) {
    workspace_.selectScheme(index);
    if (SchemeCard* there = card(index)) there->editStep();
}

void SchemeList::duplicateSelected() {
    const int index = workspace_.selectedScheme();
    if (!card(index)) return;
    if (workspace_.edit(editsForDuplicate(workspace_.scene(), index), tr("Duplicate scheme")))
        workspace_.selectScheme(index + 1);
}

void SchemeList::soloSelected() {
    const int index = workspace_.selectedScheme();
    if (card(index)) workspace_.edit(editsForSolo(workspace_.scene(), index), tr("Selected scheme alone"));
}

void SchemeList::removeSelected() {
    const int index = workspace_.selectedScheme();
    if (card(index)) workspace_.edit(editsForRemoval(workspace_.scene(), index), tr("Remove scheme"));
}

void SchemeList::moveSelected(int by) {
    const int index = workspace_.selectedScheme();
    if (!card(index)) return;
    const std::vector<Edit> edits = editsForMove(workspace_.scene(), index, by);
    if (!edits.empty() && workspace_.edit(edits, tr("Move scheme"))) workspace_.selectScheme(index + by);
}

void SchemeList::toggle(int index) {
    if (card(index)) workspace_.edit(editsForToggle(workspace_.scene(), index), tr("Switch scheme"));
}

}  // namespace extremal
