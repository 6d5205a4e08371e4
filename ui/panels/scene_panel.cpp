// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/scene_panel.hpp"

#include <algorithm>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QVBoxLayout>

#include "engine/model/parts/written_form.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typeset.hpp"
#include "engine/scene/event_names.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/format.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/panels/form.hpp"
#include "ui/panels/typed_model_editor.hpp"
#include "ui/panels/scene_fields.hpp"
#include "ui/panels/symmetry_line.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/typed_kind.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

/// Its coordinates are named by the user, so that the initial data of another one do not fit.
bool hasOwnNames(const ModelEntry& entry) {
    return std::any_of(entry.item.parameters.begin(), entry.item.parameters.end(),
                       [](const FieldInfo& field) { return field.type == FieldType::names; });
}
/// It is given by a formula in names of its own, which has a separate editor.
bool isTyped(const ModelEntry& entry) { return typedKind(entry.item.id) != nullptr; }

bool isPlainText(const Value& value) { return value.isNumber() || value.isString() || value.isBool(); }

/// Whether a value is an object of numbers and texts, which has a row for each.
bool isSmallObject(const Value* value) {
    return value && value->isObject() && !value->asObject().empty() &&
           std::all_of(value->asObject().begin(), value->asObject().end(),
                       [](const Value::Member& m) { return isPlainText(m.second); });
}

bool hasRows(const FieldInfo& info, const Value* value) {
    return (info.type == FieldType::json || info.type == FieldType::terms) && isSmallObject(value);
}

/// The terms of a formula, or formulas by variable: a row for each.
void addTerms(const FieldInfo& info, const Value& terms, const std::string& place,
              std::vector<FormField>& fields) {
    for (const auto& [name, formula] : terms.asObject()) {
        FieldInfo row = textField(name, name, nullptr, info.description);
        row.title = name;
        const QString shown =
            QString::fromStdString(info.symbol.empty() ? name : typed::symbolOf(name)).toHtmlEscaped();
        fields.push_back({std::move(row),
                          place + "/" + name,
                          info.symbol.empty()
                              ? shown
                              : QString::fromStdString(info.symbol) + QString("<sub>%1</sub>").arg(shown),
                          {}});
    }
}

/// A parameter: one row, or where it is a small object (a potential by name, a wave packet) one for each of
/// its members. What the object is, its member `name` or `packet`, brings the defaults of its kind.
void addFields(const Workspace& workspace, const FieldInfo& info, const std::string& place,
               std::vector<FormField>& fields) {
    const Value* value = valueAt(workspace.document(), place);
    if (addElementFields(workspace.scene().model.type, info, value, place, fields)) return;
    if (!hasRows(info, value)) {
        fields.push_back({info, place, {}, {}});
        return;
    }
    if (info.type == FieldType::terms) return addTerms(info, *value, place, fields);
    for (const auto& [key, member] : value->asObject()) {
        const bool isKind = key == "name" || key == "packet";
        FieldInfo row = isKind ? textField(key, info.title, nullptr, info.description)
                               : numberField(key, key, "", 0, info.description);
        if (isKind) {
            row.title = info.title;
            row.symbol.clear();
        }
        std::replace(row.title.begin(), row.title.end(), '_', ' ');
        std::vector<Edit> others;  // of another kind they would be unknown
        for (const Value::Member& other : value->asObject())
            if (other.first != key) others.push_back({place + "/" + other.first, std::nullopt});
        const std::string pointer = place + "/" + key;
        const auto change = [pointer, others](const Value& chosen) {
            std::vector<Edit> edits = others;
            edits.push_back({pointer, chosen});
            return edits;
        };
        fields.push_back({std::move(row),
                          pointer,
                          {},
                          isKind ? change : std::function<std::vector<Edit>(const Value&)>{}});
    }
}

/// The members of the small objects in a part of the scene: other members need other rows.
std::string shapeOf(const Workspace& workspace, const std::vector<FieldInfo>& infos,
                    const std::string& part) {
    std::string shape;
    for (const FieldInfo& info : infos) {
        const Value* value = valueAt(workspace.document(), part + info.key);
        shape += shapeOfElements(workspace.scene().model.type, info, value);
        if (!hasRows(info, value)) continue;
        shape += ' ' + info.key;
        for (const Value::Member& member : value->asObject()) shape += '.' + member.first;
    }
    return shape;
}

std::vector<FormField> parameterFields(const Workspace& workspace, const ModelEntry& entry) {
    std::vector<FormField> fields;
    for (const FieldInfo& info : entry.item.parameters)
        addFields(workspace, info, "/model/" + info.key, fields);
    return fields;
}

/// q(0), then p(0) or v(0), one row per coordinate.
std::vector<FormField> initialFields(const Workspace& workspace, const System& system) {
    std::vector<FormField> fields;
    if (const ModelEntry* entry = findModel(workspace.scene().model.type))
        for (const FieldInfo& info : entry->initial)
            if (valueAt(workspace.document(), "/initial/" + info.key))
                addFields(workspace, info, "/initial/" + info.key, fields);
    const auto add = [&](const char* key, const QString& letter, bool isMomentum) {
        for (std::size_t i = 0; i < system.coordinates.size(); ++i) {
            const Coordinate& c = system.coordinates[i];
            const QString symbol =
                QString::fromStdString(c.symbol.empty() ? c.name : c.symbol).toHtmlEscaped();
            const std::string unit = isMomentum ? c.momentumUnit : c.unit;
            FieldInfo info =
                numberField(std::string(key) + "." + c.name, c.title + (isMomentum ? " momentum" : ""), unit,
                            0, "Value at the start.");
            const QString label =
                letter.isEmpty() ? symbol + "(0)" : QString("%1<sub>%2</sub>(0)").arg(letter, symbol);
            fields.push_back(
                {std::move(info), "/initial/" + std::string(key) + "/" + std::to_string(i), label, {}});
        }
    };
    // A start that the model says is that of its elements.
    const bool saysItself = system.parts.find<WrittenForm>() && !valueAt(workspace.document(), "/initial/q");
    if (!saysItself) add("q", {}, false);
    if (workspace.scene().initial.second == Initial::Second::position) {
        for (std::size_t i = 0; i < system.coordinates.size(); ++i) {
            const Coordinate& c = system.coordinates[i];
            const QString symbol =
                QString::fromStdString(c.symbol.empty() ? c.name : c.symbol).toHtmlEscaped();
            FieldInfo info =
                numberField("q1." + c.name, c.title, c.unit, 0, "Value a time t1 after the start.");
            fields.push_back({std::move(info),
                              "/initial/q1/" + std::to_string(i),
                              QString("%1(t<sub>1</sub>)").arg(symbol),
                              {}});
        }
        FieldInfo at = numberField("at", "time of the second position", system.timeUnit, 0.1,
                                   "Time from the start to the second position.");
        fields.push_back({std::move(at), "/initial/at", QStringLiteral("t<sub>1</sub>"), {}});
        return fields;
    }
    const bool isVelocity = workspace.scene().initial.second == Initial::Second::velocity;
    if (valueAt(workspace.document(), isVelocity ? "/initial/v" : "/initial/p"))
        add(isVelocity ? "v" : "p", isVelocity ? "v" : "p", !isVelocity);
    return fields;
}

/// The references that need no more than their name, and the one there is.
FormField referenceField(const Workspace& workspace, const std::string& now) {
    std::vector<std::string> kinds = format::plainReferences;
    if (std::find(kinds.begin(), kinds.end(), now) == kinds.end()) kinds.push_back(now);
    const auto edits = [&workspace](const Value& type) {
        std::vector<Edit> all{{"/reference/type", type}};
        for (const char* key : {"/reference/scheme", "/reference/path"})
            if (valueAt(workspace.document(), key)) all.push_back({key, std::nullopt});
        return all;
    };
    return {choiceField(
                "type", "reference", std::move(kinds),
                "What errors are measured against. auto: the exact solution where it is known, else a far "
                "more accurate run; companion: of each scheme itself with one degree more."),
            "/reference/type",
            {},
            edits,
            "/reference"};
}

QLabel* sectionLabel(const QString& text) {
    QLabel* label = makeLabel(text, "strong");
    label->setContentsMargins(0, 4, 0, 0);
    return label;
}

}  // namespace

ScenePanel::ScenePanel(Workspace& workspace, QWidget* parent)
    : Card(tr("Scene"), parent), workspace_(workspace) {
    model_ = new ComboBox;
    model_->setObjectName("model");
    model_->setAccessibleName(tr("Model"));
    for (const ModelEntry& entry : modelCatalog()) {
        model_->addItem(QString::fromStdString(entry.item.title), QString::fromStdString(entry.item.id));
        model_->setItemData(model_->count() - 1, QString::fromStdString(entry.item.description),
                            Qt::ToolTipRole);
    }
    model_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    connect(model_, &QComboBox::activated, this, &ScenePanel::changeModel);
    parameters_ = new Form(workspace);
    typed_ = new TypedModelEditor(workspace);
    typed_->hide();
    initial_ = new Form(workspace);
    time_ = new Form(workspace);
    reference_ = new Form(workspace);
    body()->addWidget(model_);
    body()->addWidget(parameters_);
    body()->addWidget(typed_);
    body()->addWidget(new SymmetryLine(workspace));
    initialTitle_ = sectionLabel(tr("Initial data"));
    timeTitle_ = sectionLabel(tr("Time"));
    body()->addWidget(initialTitle_);
    body()->addWidget(initial_);
    body()->addWidget(timeTitle_);
    body()->addWidget(time_);
    body()->addWidget(sectionLabel(tr("Errors")));
    body()->addWidget(reference_);
    eventsTitle_ = sectionLabel(tr("Events"));
    events_ = new Form(workspace);
    body()->addWidget(eventsTitle_);
    body()->addWidget(events_);
    menu()->addAction(tr("Reset parameters"), this, [this] {
        if (const ModelEntry* entry = findModel(workspace_.scene().model.type)) {
            std::vector<Edit> edits{{"/model", exampleModel(*entry)}};
            if (hasOwnNames(*entry)) edits.push_back({"/initial", std::nullopt});
            workspace_.edit(edits, tr("Reset parameters"));
        }
    });
    menu()->addAction(tr("Reset initial data"), this, [this] {
        workspace_.edit({{"/initial", std::nullopt}}, tr("Reset initial data"));
    });
    menu()->addAction(tr("Start from two positions"), this, &ScenePanel::startFromTwoPositions);
    menu()->addAction(tr("Start from a momentum"), this, &ScenePanel::startFromMomentum);
    menu()->addAction(tr("Watch for an event"), this, &ScenePanel::addEvent);
    menu()->addAction(tr("Remove the last event"), this, [this] {
        if (const std::size_t count = workspace_.scene().events.size(); count > 0)
            workspace_.edit({{"/events/" + std::to_string(count - 1), std::nullopt}}, tr("Remove an event"));
    });
    menu()->addAction(tr("Compare with a file..."), this, &ScenePanel::compareWithFile);
    QAction* compare =
        menu()->addAction(tr("Compare with the selected scheme"), this, &ScenePanel::compareWithSelected);
    connect(menu(), &QMenu::aboutToShow, this,
            [this, compare] { compare->setEnabled(workspace_.selectedScheme() >= 0); });
    connect(&workspace_, &Workspace::sceneChanged, this, &ScenePanel::rebuild);
    connect(&workspace_, &Workspace::opened, this, [this] { shownModel_.clear(); });
}

void ScenePanel::rebuild() {
    const Scene& scene = workspace_.scene();
    if (const Value* kind = valueAt(workspace_.document(), "/reference/type");
        kind && kind->asString() != shownReference_) {
        shownReference_ = kind->asString();
        reference_->setFields({referenceField(workspace_, shownReference_)});
    }
    if (const std::string shape = shapeOfEvents(scene); shownEvents_ != shape) {
        shownEvents_ = shape;
        events_->setFields(eventFields(scene));
    }
    eventsTitle_->setVisible(!scene.events.empty());
    events_->setVisible(!scene.events.empty());
    std::string keys = std::to_string(static_cast<int>(scene.initial.second));
    for (const auto& [key, value] : scene.initial.given.keys) keys += ' ' + key;
    if (valueAt(workspace_.document(), "/initial/q")) keys += " q";
    for (const char* key : {"coordinates", "variables"})
        if (const Value* names = scene.model.find(key)) keys += writeCompactJson(*names);
    const ModelEntry* entry = findModel(scene.model.type);
    if (!entry) return;
    keys += shapeOf(workspace_, entry->item.parameters, "/model/") +
            shapeOf(workspace_, entry->initial, "/initial/");
    if (scene.model.type == shownModel_ && keys == shownInitial_) return;
    shownModel_ = scene.model.type;
    shownInitial_ = keys;
    model_->setCurrentIndex(model_->findData(QString::fromStdString(shownModel_)));
    model_->setToolTip(QString::fromStdString(entry->item.description));
    // The name of a box is read as its text.
    model_->setAccessibleDescription(tr("Model: %1").arg(model_->toolTip()));
    const System& system = *workspace_.resolved()->system;
    parameters_->setFields(isTyped(*entry) ? std::vector<FormField>{} : parameterFields(workspace_, *entry));
    parameters_->setVisible(!isTyped(*entry));
    typed_->setVisible(isTyped(*entry));
    typed_->refresh();
    for (QWidget* part : std::initializer_list<QWidget*>{initialTitle_, initial_, timeTitle_, time_})
        part->setVisible(system.isMotion());  // solved at once, from nothing but its boundary values
    initial_->setFields(initialFields(workspace_, system));
    time_->setFields(
        {{numberField("end", "end", system.timeUnit, 10, "The run ends here."), "/time/end", {}, {}}});
}

/// The second position is the one that the first scheme with a fixed step reaches in one step.
void ScenePanel::startFromTwoPositions() {
    const auto resolved = workspace_.resolved();
    const System& system = *resolved->system;
    const Mechanical* const lagrangian = system.parts.find<Mechanical>();  // whose action joins them
    if (resolved->scene.initial.second == Initial::Second::position || !lagrangian) return;
    for (const ResolvedScheme& scheme : resolved->schemes) {
        const SchemeSpec& spec = scheme.spec;
        if (spec.tolerance) continue;
        const State& start = resolved->initial;
        State state = start;
        const auto integrator = scheme.make(system, spec.step.value, state);
        if (advance(*integrator, state).outcome != Outcome::converged) continue;
        const auto positions = [&](const State& s) {
            Value::Array values;
            for (int i = 0; i < system.dimension(); ++i)
                values.emplace_back(s.x[static_cast<std::size_t>(i)]);
            return values;
        };
        Value initial{Value::Object{}};
        initial.set("q", positions(start));
        initial.set("q1", positions(state));
        initial.set("at", spec.step.value);
        workspace_.edit({{"/initial", initial}}, tr("Start from two positions"));
        return;
    }
}

void ScenePanel::startFromMomentum() {
    const auto resolved = workspace_.resolved();
    const System& system = *resolved->system;
    if (resolved->scene.initial.second == Initial::Second::momentum || !system.hasCoordinates()) return;
    const State& start = resolved->initial;
    const auto half = start.x.begin() + system.dimension();
    Value initial{Value::Object{}};
    initial.set("q", Value::Array(start.x.begin(), half));
    initial.set("p", Value::Array(half, start.x.end()));
    workspace_.edit({{"/initial", initial}}, tr("Start from a momentum"));
}

/// Of the first coordinate, to be changed.
void ScenePanel::addEvent() {
    const Scene& scene = workspace_.scene();
    std::vector<std::string> parameters;
    for (const auto& [key, value] : scene.model.keys) parameters.push_back(key);
    const auto names = stateNames(*workspace_.resolved()->system, parameters);
    std::string first = names.size() > 1 ? names[1].name : names.front().name;
    for (const StateName& name : names)
        if (name.kind == StateName::Kind::column && name.index == 0)
            first = name.name;  // the shortest name comes last
    workspace_.edit({{"/events/-", Value(Value::Object{{"expression", first}})}}, tr("Watch for an event"));
}

void ScenePanel::compareWithFile() {
    const QString path = QFileDialog::getOpenFileName(
        this, tr("Compare with a file"), {}, tr("Tables with t and the state (*.csv);;All files (*)"));
    if (path.isEmpty()) return;
    const Value reference(Value::Object{{"type", "file"}, {"path", path.toStdString()}});
    workspace_.edit({{"/reference", reference}}, tr("Compare with a file"));
}

void ScenePanel::compareWithSelected() {
    const int selected = workspace_.selectedScheme();
    const Value* scheme = valueAt(workspace_.document(), "/schemes/" + std::to_string(selected));
    if (selected < 0 || !scheme) return;
    const Value reference(Value::Object{{"type", "scheme"}, {"scheme", *scheme}});
    workspace_.edit({{"/reference", reference}}, tr("Compare with the selected scheme"));
}

void ScenePanel::changeModel(int index) {
    const std::string id = model_->itemData(index).toString().toStdString();
    const ModelEntry* entry = findModel(id);
    if (!entry || id == workspace_.scene().model.type) return;
    if (!workspace_.edit(editsForModel(workspace_.scene(), *entry), tr("Change model"))) {
        model_->setCurrentIndex(model_->findData(QString::fromStdString(workspace_.scene().model.type)));
    }
}

}  // namespace extremal
