// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/sketch/mechanism_sketch.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/model/system.hpp"
#include "ui/base/theme.hpp"
#include "ui/sketch/element_line.hpp"
#include "ui/sketch/sketch_canvas.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

bool has(const Value& model, const char* kind) {
    const Value* const all = model.find(kind);
    return all && all->isObject() && !all->asObject().empty();
}

/// What a drawing can be asked for: reactions where something holds, the balance where something takes or
/// gives energy.
Value observablesOf(const Value& model, bool hasReference) {
    Value::Array names;
    if (has(model, "rods") || has(model, "pins") || has(model, "sliders")) {
        names.emplace_back("constraint");
        names.emplace_back("reaction");
    }
    names.emplace_back("energy");
    if (hasReference) names.emplace_back("error");
    if (has(model, "dampers") || has(model, "motors") || has(model, "walls")) names.emplace_back("balance");
    return names;
}

Value viewsOf(const Value& model, bool hasReference) {
    Value::Array views{"stage", "energy"};
    if (hasReference) views.emplace_back("error");
    if (has(model, "dampers") || has(model, "motors") || has(model, "walls")) views.emplace_back("balance");
    if (has(model, "rods"))
        views.emplace_back(Value::Object{{"view", "phase"},
                                         {"x", "t"},
                                         {"y", "reaction." + model.find("rods")->asObject().front().first}});
    return views;
}

/// Whether nothing but what a drawing is asked for is looked at.
bool areOfDrawing(const Value* observe, const Value* views) {
    if (!observe || !observe->isArray() || !views || !views->isArray()) return false;
    const auto isOurs = [](const Value& name) {
        return name == Value("constraint") || name == Value("reaction") || name == Value("energy") ||
               name == Value("error") || name == Value("balance");
    };
    const auto isOurView = [](const Value& view) {
        const Value* const y = view.find("y");
        return view == Value("stage") || view == Value("energy") || view == Value("error") ||
               view == Value("balance") || (y && y->isString() && y->asString().starts_with("reaction."));
    };
    return std::all_of(observe->asArray().begin(), observe->asArray().end(), isOurs) &&
           std::all_of(views->asArray().begin(), views->asArray().end(), isOurView);
}

/// The order of their keys has no meaning.
bool isSameModel(const Value& a, const Value& b) {
    const auto isIn = [](const Value& other) {
        return [&other](const Value::Member& m) {
            const Value* const there = other.find(m.first);
            return there && *there == m.second;
        };
    };
    return a.isObject() && b.isObject() && a.asObject().size() == b.asObject().size() &&
           std::all_of(a.asObject().begin(), a.asObject().end(), isIn(b));
}

}  // namespace

/// Without a reference, which takes longer than the motion where springs are stiff: every change of the
/// drawing runs again. The header offers one.
Value newMechanismScene() {
    const ModelEntry* const entry = findModel("mechanism");
    Value scene(Value::Object{{"extremal", 1}, {"title", "A mechanism of my own"}});
    const Value model = exampleModel(*entry);
    scene.set("model", model);
    scene.set("time", Value(Value::Object{{"start", 0}, {"end", 10}}));
    scene.set("schemes", Value(Value::Array{Value(Value::Object{
                             {"label", "Gauss 2"}, {"step", 0.02}, {"scheme", "galerkin-gauss-2"}})}));
    scene.set("reference", Value(Value::Object{{"type", "none"}}));
    scene.set("observe", observablesOf(model, false));
    scene.set("views", viewsOf(model, false));
    return scene;
}

MechanismSketch::MechanismSketch(Workspace& workspace, StageWidget& stage, QWidget* parent)
    : QWidget(parent),
      workspace_(workspace),
      stage_(stage),
      canvas_(new SketchCanvas(&stage)),
      line_(new ElementLine) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* palette = new QHBoxLayout;
    palette->setSpacing(4);
    makePalette(*palette);
    column->addLayout(palette);
    column->addWidget(line_);
    canvas_->hide();
    hide();
    stage_.installEventFilter(this);
    connect(canvas_, &SketchCanvas::changed, this, &MechanismSketch::apply);
    connect(canvas_, &SketchCanvas::left, this, &MechanismSketch::end);
    connect(canvas_, &SketchCanvas::cameraChanged, this, [this] { stage_.setCamera(canvas_->camera()); });
    // The first results of a model bring the whole of it into view; the sheet stays where it is.
    connect(&stage_, &StageWidget::fittedChanged, this, [this](bool isFitted) {
        if (isOpen_ && isFitted) stage_.setCamera(canvas_->camera());
    });
    connect(canvas_, &SketchCanvas::selectionChanged, this,
            [this] { line_->show(canvas_->drawing(), canvas_->selected()); });
    connect(line_, &ElementLine::edited, this, [this](const std::string& key, const Value& value) {
        if (const auto element = canvas_->selected())
            canvas_->change([&](MechanismDrawing& drawing) { drawing.setKey(*element, key, value); });
    });
    connect(line_, &ElementLine::renamed, this, [this](const QString& name) {
        const auto element = canvas_->selected();
        if (!element) return;
        bool isDone = false;
        canvas_->change(
            [&](MechanismDrawing& drawing) { isDone = drawing.rename(*element, name.toStdString()); });
        if (!isDone)
            emit refused(tr("the name %1 is taken, or no name").arg(name), tr("letters, digits and _"));
        canvas_->select(isDone ? MechanismDrawing::Element{element->kind, name.toStdString()} : *element);
    });
    connect(&workspace_, &Workspace::sceneChanged, this, &MechanismSketch::followScene);
    connect(&workspace_, &Workspace::opened, this, &MechanismSketch::end);
}

void MechanismSketch::makePalette(QHBoxLayout& row) {
    for (const SketchTool& tool : sketchTools()) {
        auto* button =
            new QPushButton(QStringLiteral("%1 %2").arg(tool.name, QKeySequence(tool.key).toString()));
        button->setCheckable(true);
        button->setAutoExclusive(true);
        button->setProperty("kind", "chip");
        button->setFocusPolicy(Qt::NoFocus);
        button->setToolTip(tool.hint);
        button->setObjectName("tool." + tool.name.toLower());
        connect(button, &QPushButton::clicked, this, [this, kind = tool.kind] {
            canvas_->setTool(kind);
            canvas_->setFocus();
        });
        row.addWidget(button);
        buttons_.push_back(button);
    }
    row.addStretch();
    auto* done = new QPushButton(tr("Done Esc"));
    done->setProperty("kind", "flat");
    done->setFocusPolicy(Qt::NoFocus);
    connect(done, &QPushButton::clicked, this, &MechanismSketch::end);
    row.addWidget(done);
    connect(canvas_, &SketchCanvas::toolChanged, this, [this] {
        const auto& tools = sketchTools();
        for (std::size_t k = 0; k < tools.size(); ++k) {
            const bool isChosen = tools[k].kind == canvas_->tool();
            buttons_[k]->setChecked(isChosen);
            buttons_[k]->setProperty("kind", isChosen ? "primary" : "chip");
            repolish(*buttons_[k]);
        }
    });
}

void MechanismSketch::setTheme(const Theme& theme) { canvas_->setTheme(theme); }

void MechanismSketch::begin(bool isEmpty) {
    const Value* const model = workspace_.document().find("model");
    canvas_->begin(MechanismDrawing(isEmpty || !model ? Value() : *model));
    isOpen_ = true;
    canvas_->setGeometry(stage_.rect());
    canvas_->setCamera(stage_.camera());
    if (isEmpty) fitEmptySheet();
    stage_.setCamera(canvas_->camera());
    canvas_->setOpaque(isEmpty);
    canvas_->setNote({});
    show();
    canvas_->show();
    canvas_->raise();
    canvas_->setTool(isEmpty ? SketchTool::Kind::fixedPoint : SketchTool::Kind::select);
    canvas_->setFocus();
    line_->show(canvas_->drawing(), {});
    emit openChanged(true);
}

void MechanismSketch::fitEmptySheet() {
    constexpr double shown = 6;  // metres, from left to right
    Camera camera;
    camera.pixelsPerUnit = std::max(160, stage_.width()) / shown;
    canvas_->setCamera(camera);
}

void MechanismSketch::end() {
    if (!isOpen_) return;
    isOpen_ = false;
    hide();
    canvas_->hide();
    stage_.fit();
    stage_.setFocus();
    emit accepted();  // what was refused is not in the scene
    emit openChanged(false);
}

/// The model, and what is looked at as far as it was not chosen by hand. A start of its own would be that of
/// another drawing.
std::vector<Edit> MechanismSketch::edits() const {
    const Value& drawn = canvas_->drawing().model();
    const Value& document = workspace_.document();
    std::vector<Edit> edits{{"/model", drawn}};
    if (const Value* const initial = document.find("initial"))
        for (const char* key : {"q", "p", "v", "q1", "at"})
            if (initial->find(key)) edits.push_back({std::string("/initial/") + key, std::nullopt});
    if (areOfDrawing(document.find("observe"), document.find("views"))) {
        const bool hasReference = workspace_.scene().reference.kind != ReferenceSpec::Kind::none;
        edits.push_back({"/observe", observablesOf(drawn, hasReference)});
        edits.push_back({"/views", viewsOf(drawn, hasReference)});
    }
    return edits;
}

void MechanismSketch::apply() {
    line_->show(canvas_->drawing(), canvas_->selected());
    const Value* const now = workspace_.document().find("model");
    std::vector<Problem> problems;
    if (!now || !isSameModel(*now, canvas_->drawing().model())) {
        isApplying_ = true;
        problems = workspace_.tryEdit(edits(), tr("Draw the mechanism"));
        isApplying_ = false;
    }
    showProblems(problems);
    canvas_->setOpaque(!problems.empty());
    if (problems.empty()) emit played();
}

void MechanismSketch::showProblems(const std::vector<Problem>& problems) {
    if (problems.empty()) {
        canvas_->setNote({});
        emit accepted();
        return;
    }
    const Problem& first = problems.front();
    const QString text = QString::fromStdString(
        (first.pointer.starts_with("/model/") ? first.pointer.substr(7) + ": " : std::string()) +
        first.message);
    canvas_->setNote(tr("Not running yet: %1").arg(text));
    // An empty sheet is no mistake.
    if (first.pointer == "/model/points" || first.pointer == "/model") return emit accepted();
    emit refused(text, QString::fromStdString(first.hint));
}

/// The scene has another model, from a form or by its own undo.
void MechanismSketch::followScene() {
    if (!isOpen_ || isApplying_ || !workspace_.hasScene()) return;
    const Value* const model = workspace_.document().find("model");
    const Value* const type = model ? model->find("type") : nullptr;
    if (!type || !(*type == Value("mechanism"))) return end();
    if (isSameModel(*model, canvas_->drawing().model())) return;
    isApplying_ = true;
    canvas_->change([&](MechanismDrawing& drawing) { drawing.replace(*model); });
    isApplying_ = false;
}

bool MechanismSketch::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &stage_ && event->type() == QEvent::Resize) {
        canvas_->setGeometry(stage_.rect());
        if (isOpen_ && canvas_->drawing().isEmpty()) fitEmptySheet();
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace extremal
