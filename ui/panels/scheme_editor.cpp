// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/scheme_editor.hpp"

#include <algorithm>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include "engine/baseline/catalog.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/format.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/panels/form.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/panels/term_strip.hpp"
#include "ui/workspace/fitting.hpp"
#include "ui/workspace/own_schemes.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

void addFields(std::vector<FormField>& fields, const std::vector<FieldInfo>& infos,
               const std::string& place) {
    for (const FieldInfo& info : infos) fields.push_back({info, place + "/" + info.key, {}, {}});
}

const CatalogItem* itemNamed(const std::vector<CatalogItem>& items, const std::string& id) {
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const CatalogItem& i) { return i.id == id; });
    return found == items.end() ? nullptr : &*found;
}

void fill(QComboBox& box, const std::vector<CatalogItem>& items) {
    box.clear();
    for (const CatalogItem& item : items) {
        box.addItem(QString::fromStdString(item.title), QString::fromStdString(item.id));
        box.setItemData(box.count() - 1, QString::fromStdString(item.description), Qt::ToolTipRole);
    }
}

std::vector<CatalogItem> namedItems(const Scene& scene) {
    std::vector<CatalogItem> items;
    for (const SchemeEntry* fitting : fittingSchemes(scene)) {
        const SchemeEntry& entry = *fitting;
        if (entry.maxDegree == 0) items.push_back(entry.item);
        const std::string stem = entry.item.id.substr(0, entry.item.id.rfind('-'));
        for (int s = entry.minDegree; s <= entry.maxDegree && entry.maxDegree > 0; ++s) {
            CatalogItem item = entry.item;
            item.id = item.title = stem + "-" + std::to_string(s);
            items.push_back(item);
        }
    }
    return items;
}

/// Those of the user's catalogue, which become what they stand for.
constexpr std::string_view ownPrefix = "own: ";

void addOwn(QComboBox& box) {
    for (const std::string& name : ownSchemes().names())
        box.addItem(QString::fromStdString(name), QString::fromStdString(std::string(ownPrefix) + name));
}

std::vector<CatalogItem> baselineItems(const Scene& scene) {
    std::vector<CatalogItem> items;
    for (const BaselineEntry* entry : fittingBaselines(scene)) items.push_back(entry->item);
    return items;
}

void choose(QComboBox& box, const std::string& id) {
    box.setCurrentIndex(box.findData(QString::fromStdString(id)));
}

/// Those that solve the equations of the scheme.
std::vector<std::string> methodsFor(const SchemeSpec& spec) {
    std::vector<std::string> methods{"auto"};
    if (const Family* const family = resolve(spec).family) {
        const auto& own = solverMethods(*family);
        methods.insert(methods.end(), own.begin(), own.end());
    }
    return methods;
}

std::string chosen(const QComboBox& box) { return box.currentData().toString().toStdString(); }

}  // namespace

SchemeEditor::SchemeEditor(Workspace& workspace, int index, QWidget* parent)
    : QWidget(parent), workspace_(workspace), index_(index) {
    layout_ = new QVBoxLayout(this);
    layout_->setContentsMargins(0, 4, 0, 4);
    layout_->setSpacing(5);
    kind_ = addChoice(tr("kind"), "kind");
    kind_->addItems({tr("space × quadrature"), tr("baseline"), tr("named scheme")});
    connect(kind_, &QComboBox::activated, this, &SchemeEditor::changeKind);
    first_ = addChoice(tr("choice"), "choice");
    connect(first_, &QComboBox::activated, this, [this] {
        const Scene& scene = workspace_.scene();
        const std::string id = chosen(*first_);
        if (id.starts_with(ownPrefix)) {
            const OwnSchemes kept = ownSchemes();
            if (const Value* scheme = kept.find(id.substr(ownPrefix.size()))) change(newOwn(scene, *scheme));
            return;
        }
        if (spec().kind == SchemeSpec::Kind::discretization) {
            const Settings space = spaceOf(chosen(*first_), std::max(1, spec().space.integer("degree")));
            const bool isOtherFamily = familyOf(space) != familyOf(spec().space);
            const std::string rule = fittingRule(isOtherFamily ? "auto" : shownRule().type, space);
            return change(newPair(scene, space, ruleFor(rule, space)));
        }
        change(spec().kind == SchemeSpec::Kind::baseline ? newBaseline(scene, chosen(*first_))
                                                         : newNamed(scene, chosen(*first_)));
    });
    rule_ = addChoice(tr("rule"), "rule");
    rule_->setPlaceholderText(tr("auto"));
    ruleRow_ = rule_->parentWidget();
    connect(rule_, &QComboBox::activated, this, [this] {
        const Settings rule = ruleFor(chosen(*rule_), spec().space);
        Value tree(Value::Object{{"type", rule.type}});
        for (const auto& [key, value] : rule.keys)  // typed ones have no default
            if (value.isArray()) tree.set(key, value);
        workspace_.edit({{placeOfRule(), tree}}, tr("Change quadrature"));
    });
    problem_ = makeLinkLabel("caption");
    problem_->setObjectName("problem.scheme");
    problem_->setProperty("problem", true);
    problem_->hide();
    layout_->addWidget(problem_);
    terms_ = new TermStrip(workspace);
    layout_->addWidget(terms_);
    form_ = new Form(workspace);
    layout_->addWidget(form_);
    auto* close = new QPushButton(tr("Done"));
    close->setObjectName("done");
    connect(close, &QPushButton::clicked, this, &SchemeEditor::closed);
    layout_->addWidget(close, 0, Qt::AlignRight);
    connect(&workspace_, &Workspace::sceneChanged, this, &SchemeEditor::refresh);
    connect(&workspace_, &Workspace::draftsChanged, this, &SchemeEditor::showRefusal);
    rebuild();
}

QComboBox* SchemeEditor::addChoice(const QString& title, const QString& name) {
    auto* row = new QWidget;
    auto* line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(title);
    label->setMinimumWidth(64);
    auto* box = new ComboBox;
    box->setObjectName(name);
    box->setAccessibleName(title);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    label->setBuddy(box);
    line->addWidget(label);
    line->addWidget(box, 1);
    layout_->addWidget(row);
    return box;
}

const SchemeSpec& SchemeEditor::spec() const {
    return workspace_.scene().schemes[static_cast<std::size_t>(index_)];
}

/// The rule of the list: with a rule for each term that of the others.
Settings SchemeEditor::shownRule() const {
    const Settings& rule = spec().quadrature;
    return isTermRule(rule) ? termPart(rule, otherTerms) : rule;
}

std::string SchemeEditor::placeOfRule() const {
    const std::string at = place() + "/quadrature";
    return isTermRule(spec().quadrature) ? at + "/" + otherTerms : at;
}

/// Changes when other fields are needed.
std::string SchemeEditor::signature() const {
    const SchemeSpec& s = spec();
    return std::to_string(static_cast<int>(s.kind)) + s.space.type + "/" + s.quadrature.type + "/" +
           shownRule().type + "/" + s.baseline.type + "/" + s.named + "/" + s.composition.type + "/" +
           s.monitor.type + "/" + std::to_string(s.keep.size());
}

void SchemeEditor::setIndex(int index) {
    if (index == index_) return;
    index_ = index;
    rebuild();
}

void SchemeEditor::refresh() {
    if (index_ >= static_cast<int>(workspace_.scene().schemes.size())) return;
    if (signature() != shown_) return rebuild();
    terms_->setScheme(index_);
}

/// A kind, a choice or a rule that the scene does not take: the words stand below the lists, which show what
/// the scheme still is.
void SchemeEditor::showRefusal() {
    if (index_ >= static_cast<int>(workspace_.scene().schemes.size())) return;
    std::string refused;
    for (const std::string& at : {place(), placeOfRule()})
        if (workspace_.drafts().contains(at)) refused = at;
    problem_->setVisible(!refused.empty());
    if (refused.empty()) return;
    problem_->setText(refusalText(workspace_, refused));
    workspace_.claimRefusal(refused);
    showChoices();
}

/// What the scheme is, in the lists.
void SchemeEditor::showChoices() {
    const SchemeSpec& s = spec();
    kind_->setCurrentIndex(static_cast<int>(s.kind));
    if (s.kind == SchemeSpec::Kind::discretization) choose(*rule_, shownRule().type);
    choose(*first_, s.kind == SchemeSpec::Kind::discretization ? s.space.type
                    : s.kind == SchemeSpec::Kind::baseline     ? s.baseline.type
                                                               : s.named);
    terms_->setScheme(index_);
}

void SchemeEditor::rebuild() {
    shown_ = signature();
    const SchemeSpec& s = spec();
    if (auto* kinds = qobject_cast<QStandardItemModel*>(kind_->model()))  // a model may have no baselines
        kinds->item(static_cast<int>(SchemeSpec::Kind::baseline))
            ->setEnabled(!baselineItems(workspace_.scene()).empty());
    ruleRow_->setVisible(s.kind == SchemeSpec::Kind::discretization);
    std::vector<FormField> fields;
    if (s.kind == SchemeSpec::Kind::discretization) {
        fill(*first_, fittingSpaces(workspace_.scene()));
        rule_->clear();
        for (const CatalogItem& item : quadratureCatalog())
            if (fittingRule(item.id, s.space) == item.id)
                rule_->addItem(QString::fromStdString(item.title), QString::fromStdString(item.id));
        // A rule for each direction is not one to choose, but may be what the scheme has.
        if (isTensorRule(shownRule()))
            rule_->addItem(ruleTitle(shownRule().type), QString::fromStdString(shownRule().type));
        if (const CatalogItem* space = itemNamed(spaceCatalog(), s.space.type))
            addFields(fields, space->parameters, place() + "/space");
        if (const CatalogItem* rule = itemNamed(quadratureCatalog(), shownRule().type))
            addFields(fields, rule->parameters, placeOfRule());
    } else if (s.kind == SchemeSpec::Kind::baseline) {
        fill(*first_, baselineItems(workspace_.scene()));
        if (const BaselineEntry* entry = findBaseline(s.baseline.type))
            addFields(fields, entry->item.parameters, place() + "/baseline");
    } else {
        fill(*first_, namedItems(workspace_.scene()));
        addOwn(*first_);
    }
    if (s.tolerance)
        fields.push_back(
            {numberField("tolerance", "tolerance", "", 1e-9, "Wanted local error of the adaptive code."),
             place() + "/tolerance",
             {},
             {}});
    else {
        FieldInfo step = numberField("step", "step", "", 0.01, "Time step.");
        step.symbol = "h";
        fields.push_back({step, place() + "/step", {}, {}});
    }
    if (s.kind != SchemeSpec::Kind::baseline)
        fields.push_back(
            {choiceField("method", "solver", methodsFor(s), "How the equations of a step are solved."),
             place() + "/solver/method",
             {},
             {}});
    addComposition(fields);
    addKeep(fields);
    addImpact(fields);
    addMonitor(fields);
    form_->setFields(std::move(fields));
    showChoices();
    showRefusal();
}

/// Symmetric schemes with fixed steps can be composed, in some ways only those of order 2.
void SchemeEditor::addComposition(std::vector<FormField>& fields) const {
    const SchemeSpec& s = spec();
    if (s.tolerance) return;
    SchemeSpec part = s;
    part.composition = {};
    const Claims claims = resolve(part).claims;
    if (!claims.isSymmetric) return;
    std::vector<std::string> choices{"none"};
    for (const CatalogItem& item : compositionCatalog())
        if (item.id == s.composition.type || isComposableBy(item.id, claims)) choices.push_back(item.id);
    const FieldInfo type = choiceField("composition", "composed", std::move(choices),
                                       "Steps of the scheme over parts of the step, for a higher order.");
    const std::string at = place() + "/composition";
    fields.push_back({type, at + "/type", {}, [at](const Value& chosen) -> std::vector<Edit> {
                          if (chosen == Value("none")) return {{at, std::nullopt}};
                          return {{at, Value(Value::Object{{"type", chosen}})}};
                      }});
    if (const CatalogItem* item = itemNamed(compositionCatalog(), s.composition.type))
        addFields(fields, item->parameters, at);
}

/// The third choice beside space and rule: what is kept.
void SchemeEditor::addKeep(std::vector<FormField>& fields) const {
    const auto discretization = discretizationOf(spec());
    const Family* const family = discretization ? familyOf(discretization->space) : nullptr;
    const auto& resolved = workspace_.resolved();
    if (!family || !family->parts.find<TestSpace>() || !resolved || !canKeepInvariants(*resolved->system))
        return;
    const std::string at = place() + "/keep";
    const char* const about =
        "What the steps keep: the symplectic form, the energy, or a list of invariants by name or formula.";
    if (!spec().keep.empty() && !isEnergyAlone(spec().keep))
        fields.push_back({optionalJsonField("keep", "keeps", about), at, {}, {}});
    else
        fields.push_back({choiceField("keep", "keeps", {"symplectic", "energy"}, about), at, {}, {}});
}

/// What is equal on both sides of an impact, where there can be some.
void SchemeEditor::addImpact(std::vector<FormField>& fields) const {
    const auto& resolved = workspace_.resolved();
    if (!discretizationOf(spec()) || !resolved || !resolved->system->parts.find<Wall>()) return;
    fields.push_back(
        {choiceField("impact", "at impacts", format::impactLaws,
                     "What is equal on both sides of an impact without a loss: the energy, or the "
                     "discrete energies of the parts of the step, which is symplectic."),
         place() + "/impact",
         {},
         {}});
}

/// Equal steps can be made to follow the motion, where a Hamiltonian says how.
void SchemeEditor::addMonitor(std::vector<FormField>& fields) const {
    SchemeSpec equal = spec();
    equal.monitor = {};
    const auto& resolved = workspace_.resolved();
    if (!resolved || !hasHamiltonian(*resolved->system) || resolve(equal).grid != TimeGrid::fixed) return;
    std::vector<std::string> choices = idsOf(monitorCatalog());
    choices.insert(choices.begin(), "none");
    const FieldInfo type = choiceField("monitor", "steps follow", std::move(choices),
                                       "Steps in proportion to a function of the motion, the step above "
                                       "being the first.");
    const std::string at = place() + "/monitor";
    // A monitor may be written as a word or a formula: fields show what was read, and write the whole.
    const Value written = toValue(workspace_.scene());
    const Value* const monitor = valueAt(written, at);
    FormField kind{type, at + "/type", {}, [at](const Value& chosen) -> std::vector<Edit> {
                       if (chosen == Value("none")) return {{at, std::nullopt}};
                       Value next(Value::Object{{"type", chosen}});
                       if (chosen == Value(monitorCatalog().front().id)) next.set("monitor", "1");
                       return {{at, next}};
                   }};
    if (monitor) kind.info.fallback = spec().monitor.type;
    fields.push_back(std::move(kind));
    const CatalogItem* const item = itemNamed(monitorCatalog(), spec().monitor.type);
    if (!item || !monitor) return;
    for (const FieldInfo& info : item->parameters) {
        FormField field{info, at + "/" + info.key, {}, [this, at, key = info.key](const Value& value) {
                            const Value whole = toValue(workspace_.scene());
                            Value next(Value::Object{});
                            if (const Value* const now = valueAt(whole, at))
                                for (const auto& [name, old] : now->asObject())
                                    if (name != key) next.set(name, old);
                            if (!value.isNull()) next.set(key, value);
                            return std::vector<Edit>{{at, next}};
                        }};
        if (const Value* const value = monitor->find(info.key)) field.info.fallback = *value;
        fields.push_back(std::move(field));
    }
}

void SchemeEditor::changeKind(int kind) {
    const Scene& scene = workspace_.scene();
    if (kind == static_cast<int>(spec().kind)) return;
    if (kind == 0) {
        const ChoiceGrid grid = choicesFor(scene);
        if (const ChoiceGrid::Cell* choice = nearestChoice(grid, "gauss", 2))
            change(newPair(scene, choice->discretization.space, choice->discretization.quadrature));
        return;
    }
    const auto firstOf = [](const std::vector<CatalogItem>& items, const char* wish) {
        const bool hasWish =
            std::any_of(items.begin(), items.end(), [&](const CatalogItem& i) { return i.id == wish; });
        return hasWish || items.empty() ? std::string(wish) : items.front().id;
    };
    if (kind == 1) return change(newBaseline(scene, firstOf(baselineItems(scene), "stormer-verlet")));
    change(newNamed(scene, firstOf(namedItems(scene), "midpoint")));
}

/// Replaces the scheme, keeping its step where both have one.
void SchemeEditor::change(const Value& scheme) {
    Value next = scheme;
    const Value* step = valueAt(workspace_.document(), place() + "/step");
    if (step && next.find("step")) next.set("step", *step);
    next.set("enabled", spec().isEnabled);
    if (spec().style) next.set("style", *spec().style + 1);
    workspace_.edit({{place(), next}}, tr("Change scheme"));
}

}  // namespace extremal
