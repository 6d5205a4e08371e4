// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/own/own_window.hpp"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "engine/family/family.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/theme.hpp"
#include "ui/base/tool_window.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// One formula per line; what JSON reads as a number is one.
Value::Array linesOf(const FormulaEdit& edit) {
    Value::Array all;
    for (const QString& line : edit.toPlainText().split('\n')) {
        const QString text = line.trimmed();
        if (text.isEmpty()) continue;
        bool isNumber = false;
        const double number = text.toDouble(&isNumber);
        all.emplace_back(isNumber && std::isfinite(number) ? Value(number) : Value(text.toStdString()));
    }
    return all;
}

/// "z = w*h" per line.
Value::Object definitionsOf(const FormulaEdit& edit) {
    Value::Object all;
    for (const Value& line : linesOf(edit)) {
        const QString text =
            QString::fromStdString(line.isString() ? line.asString() : writeCompactJson(line));
        const qsizetype at = text.indexOf('=');
        all.emplace_back(text.left(at).trimmed().toStdString(),
                         Value(at < 0 ? std::string() : text.mid(at + 1).trimmed().toStdString()));
    }
    return all;
}

QString textOf(const Value& value) {
    return QString::fromStdString(value.isString() ? value.asString() : writeCompactJson(value));
}

QString textOf(const Value* list) {
    QStringList lines;
    if (list && list->isArray())
        for (const Value& entry : list->asArray()) lines << textOf(entry);
    if (list && list->isObject())
        for (const auto& [name, entry] : list->asObject())
            lines << QString::fromStdString(name) + " = " + textOf(entry);
    return lines.join('\n');
}

/// The space whose functions are formulas.
const std::string& typedKind() {
    static const std::string id = [] {
        for (const CatalogItem& space : spaceCatalog())
            for (const FieldInfo& field : space.parameters)
                if (field.type == FieldType::formulas && field.key == "functions") return space.id;
        return std::string();
    }();
    return id;
}

const char* const typedRuleKind = "nodes";

}  // namespace

OwnWindow::OwnWindow(Workspace& workspace, Notices& notices, const Theme& theme, QWidget* parent)
    : QWidget(parent, Qt::Window), workspace_(workspace), notices_(notices) {
    setUpToolWindow(*this, "ownScheme", tr("Your own space and rule"), "own-space", {1080, 700});
    closeOnEscape(*this, [this] { return !workspace_.hasScene() || scheme() == opened_; });
    auto* layout = new QHBoxLayout(this);
    makeForm();
    auto* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("Space and rule"));
    scroll->setWidget(form_);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(270);
    layout->addWidget(scroll, 2);
    auto* grid = new QGridLayout;
    grid->setSpacing(10);
    const char* const names[] = {"ownFunctions", "ownSlopes", "ownAmplification", "ownPattern"};
    const QString titles[] = {tr("Functions"), tr("Slopes"), tr("Amplification"), tr("KKT matrix")};
    for (int i = 0; i < 4; ++i) {
        plots_[i] = new PlotWidget(theme);
        plots_[i]->setAccessibleName(titles[i]);  // until it has a figure
        plots_[i]->setObjectName(names[i]);
        cards_[i] = new Card(titles[i]);
        cards_[i]->body()->addWidget(plots_[i], 1);
        grid->addWidget(cards_[i], i / 2, i % 2);
    }
    layout->addLayout(grid, 5);
    delay_.setSingleShot(true);
    delay_.setInterval(150);
    connect(&delay_, &QTimer::timeout, this, &OwnWindow::compute);
    connect(&workspace_, &Workspace::opened, this, &QWidget::hide);
}

OwnWindow::~OwnWindow() { stop_.request_stop(); }

void OwnWindow::makeForm() {
    form_ = new QWidget;
    auto* column = new QVBoxLayout(form_);
    column->setContentsMargins(4, 4, 8, 4);
    whose_ = makeElidedLabel({}, "title");
    column->addWidget(whose_);
    example_ = makeLabel({}, "caption");
    example_->setObjectName("ownExample");
    example_->setWordWrap(true);
    column->addWidget(example_);
    space_ = addChoice(tr("Space"), "ownSpace");
    functions_ =
        addText(ofSpace_, tr("Functions of tau, one per line"), "ownFunctionTexts", "1\ntau\ncos(z*tau)");
    names_ = addText(ofSpace_, tr("Names in them"), "ownNames", "z = 2*h");
    knots_ = addText(ofSpace_, tr("Knots, where slopes may jump"), "ownKnots", "0.5");
    rule_ = addChoice(tr("Rule"), "ownRule");
    nodes_ =
        addText(ofRule_, tr("Nodes from 0 to 1, one per line"), "ownNodes", "(3-sqrt(3))/6\n(3+sqrt(3))/6");
    weights_ = addText(ofRule_, tr("Weights; none: interpolatory"), "ownWeights", "1/2\n1/2");
    facts_ = makeLabel({}, "caption");
    facts_->setObjectName("ownFacts");
    measured_ = makeLabel({}, "caption");
    measured_->setObjectName("ownMeasured");
    problem_ = makeLinkLabel("problem");
    problem_->setObjectName("ownProblem");
    problem_->hide();
    for (QLabel* label : {facts_, measured_, problem_}) {
        label->setWordWrap(true);
        label->setTextFormat(Qt::RichText);
        column->addWidget(label);
    }
    addButtons();
    column->addStretch();
}

QComboBox* OwnWindow::addChoice(const QString& caption, const char* name) {
    auto* box = new ComboBox;
    box->setObjectName(name);
    box->setAccessibleName(caption);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(10);
    form_->layout()->addWidget(makeLabel(caption, "caption"));
    form_->layout()->addWidget(box);
    connect(box, &QComboBox::activated, this, &OwnWindow::changed);
    return box;
}

FormulaEdit* OwnWindow::addText(Fields& fields, const QString& caption, const char* name,
                                const QString& example) {
    auto* edit = new FormulaEdit;
    edit->setObjectName(name);
    edit->setAccessibleName(caption);
    edit->setPlaceholderText(example);
    auto* label = makeLabel(caption, "caption");
    form_->layout()->addWidget(label);
    form_->layout()->addWidget(edit);
    fields.emplace_back(label, edit);
    connect(edit, &QPlainTextEdit::textChanged, this, &OwnWindow::changed);
    return edit;
}

void OwnWindow::addButtons() {
    auto* buttons = new QHBoxLayout;
    keep_ = new QPushButton(tr("Keep..."));
    keep_->setObjectName("ownKeep");
    keep_->setToolTip(tr("In your catalogue, under a name, for all scenes"));
    apply_ = new QPushButton(tr("Apply"));
    apply_->setObjectName("ownApply");
    apply_->setToolTip(tr("To the scheme of the scene"));
    buttons->addStretch();
    buttons->addWidget(keep_);
    buttons->addWidget(apply_);
    qobject_cast<QVBoxLayout*>(form_->layout())->addLayout(buttons);
    connect(apply_, &QPushButton::clicked, this, &OwnWindow::apply);
    connect(keep_, &QPushButton::clicked, this, [this] { emit keepRequested(scheme()); });
}

void OwnWindow::setTheme(const Theme& theme) {
    for (PlotWidget* plot : plots_) plot->setTheme(theme);
}

void OwnWindow::open() {
    if (!workspace_.hasScene() || workspace_.scene().schemes.empty()) return;
    index_ =
        std::clamp(workspace_.selectedScheme(), 0, static_cast<int>(workspace_.scene().schemes.size()) - 1);
    original_ = workspace_.document().find("schemes")->asArray()[static_cast<std::size_t>(index_)];
    const SchemeSpec& spec = workspace_.scene().schemes[static_cast<std::size_t>(index_)];
    written_ = writtenScheme(spec);
    // Of a scheme with a name, what it stands for.
    if (const ResolvedScheme resolved = resolve(spec); resolved.plain() && !original_.find("space")) {
        const Value pair = newPair(workspace_.scene(), resolved.plain()->space, resolved.plain()->quadrature);
        for (const char* part : {"space", "quadrature"}) original_.set(part, *pair.find(part));
    }
    fill();
    opened_ = scheme();
    bringToFront(*this);
    changed();
}

/// The boxes and fields as the scheme has them.
void OwnWindow::fill() {
    isFilling_ = true;
    whose_->setText(textOf(*original_.find("label")));
    const Value* const space = original_.find("space");
    const Value* const quadrature = original_.find("quadrature");
    const bool isTyped = !space || space->find("functions");
    space_->clear();
    space_->addItem(tr("typed functions"), QString::fromStdString(typedKind()));
    if (space && !isTyped)
        space_->addItem(tr("that of the scheme: %1").arg(textOf(*space->find("type"))), "scheme");
    space_->setCurrentIndex(space_->count() - 1);
    isSpaceWritten_ = (isTyped && space) || written_.hasFunctions;
    functions_->setPlainText(isTyped && space ? textOf(space->find("functions"))
                                              : QString::fromStdString(written_.functions));
    names_->setPlainText(isTyped && space ? textOf(space->find("let")) : QString());
    knots_->setPlainText(isTyped && space ? textOf(space->find("knots")) : QString());
    const Value* const type = quadrature ? quadrature->find("type") : nullptr;
    rule_->clear();
    rule_->addItem(tr("typed nodes"), typedRuleKind);
    const bool isOwnRule = type && *type == Value(typedRuleKind);
    if (quadrature && !isOwnRule)
        rule_->addItem(type ? tr("that of the scheme: %1").arg(textOf(*type)) : tr("a rule for each term"),
                       "scheme");
    if (!isOwnRule) rule_->addItem(tr("automatic"), "auto");
    rule_->setCurrentIndex(isOwnRule ? 0 : 1);
    isRuleWritten_ = isOwnRule || written_.hasNodes;
    nodes_->setPlainText(isOwnRule ? textOf(quadrature->find("nodes"))
                                   : QString::fromStdString(written_.nodes));
    weights_->setPlainText(isOwnRule ? textOf(quadrature->find("weights"))
                                     : QString::fromStdString(written_.weights));
    isFilling_ = false;
}

Value OwnWindow::typedSpace() const {
    Value space(Value::Object{{"type", typedKind()}, {"functions", linesOf(*functions_)}});
    if (const Value::Object names = definitionsOf(*names_); !names.empty()) space.set("let", names);
    if (const Value::Array knots = linesOf(*knots_); !knots.empty()) space.set("knots", knots);
    return space;
}

Value OwnWindow::typedRule() const {
    Value rule(Value::Object{{"type", typedRuleKind}, {"nodes", linesOf(*nodes_)}});
    if (const Value::Array weights = linesOf(*weights_); !weights.empty()) rule.set("weights", weights);
    return rule;
}

Value OwnWindow::scheme() const {
    Value scheme = original_;
    std::erase_if(scheme.asObject(), [](const Value::Member& m) {
        return m.first == "baseline" || m.first == "scheme" || m.first == "tolerance";
    });
    if (space_->currentData() != "scheme") scheme.set("space", typedSpace());
    if (rule_->currentData() == typedRuleKind)
        scheme.set("quadrature", typedRule());
    else if (rule_->currentData() == "auto")
        scheme.set("quadrature", Value(Value::Object{{"type", "auto"}}));
    if (!scheme.find("step")) scheme.set("step", sensibleStep(workspace_.scene(), 4, 0));
    scheme.set("enabled", true);
    return scheme;
}

void OwnWindow::changed() {
    if (isFilling_) return;
    const bool ownSpace = space_->currentData() != "scheme";
    const bool ownRule = rule_->currentData() == typedRuleKind;
    const auto setVisible = [](const auto& fields, bool areVisible) {
        for (const auto& [label, edit] : fields) {
            label->setVisible(areVisible);
            edit->setVisible(areVisible);
        }
    };
    const bool isExample = (ownSpace && !isSpaceWritten_) || (ownRule && !isRuleWritten_);
    example_->setVisible(isExample);
    example_->setText(ownSpace && !isSpaceWritten_
                          ? tr("The functions are an example: those of %1 cannot be written as one list.")
                                .arg(whose_->text())
                          : tr("The nodes are an example: %1 has no one rule.").arg(whose_->text()));
    setVisible(ofSpace_, ownSpace);
    setVisible(ofRule_, ownRule);
    isCurrent_ = false;
    stop_.request_stop();
    delay_.start();
}

void OwnWindow::compute() {
    stop_.request_stop();
    stop_ = std::stop_source();
    Value document = workspace_.document();
    document.set("schemes", Value::Array{scheme()});
    for (const char* other : {"views", "observe", "reference", "starts", "events"})
        std::erase_if(document.asObject(), [&](const Value::Member& m) { return m.first == other; });
    runInBackground([self = QPointer(this), document, stop = stop_.get_token()] {
        const auto post = [&](DiscretizationSketch sketch, const QString& measured, bool isComplete) {
            auto shared = std::make_shared<DiscretizationSketch>(std::move(sketch));
            sendToWindow([self, shared, measured, isComplete, stop] {
                if (self && !stop.stop_requested()) self->show(*shared, measured, isComplete);
            });
        };
        const ReadScene read = readScene(document);
        const DiscretizationSketch sketch = sketchOf(read);
        if (stop.stop_requested()) return;
        if (!sketch.errors.empty()) return post(sketch, {}, true);
        post(sketch, tr("The order is being measured ..."), false);
        const auto order = measuredOrder(read, stop);
        post(sketch,
             order ? tr("measured order %1 on this scene, as the step is halved").arg(*order, 0, 'f', 2)
                   : tr("The order cannot be measured here: a step fails, or errors are those of rounding."),
             true);
    });
}

void OwnWindow::show(DiscretizationSketch sketch, const QString& measured, bool isComplete) {
    sketch_ = std::move(sketch);
    const bool isSound = sketch_.errors.empty();
    QStringList problems;
    for (const Problem& p : sketch_.errors) {
        problems << problemText(
            p, QString::fromStdString(p.pointer).remove(QStringLiteral("/schemes/0")) + ": ");
    }
    problem_->setText(problems.join("<br>"));
    problem_->setVisible(!isSound);
    QStringList facts{tr("<b>predicted order %1</b>").arg(sketch_.order)};
    for (const std::string& fact : sketch_.facts) facts << QString::fromStdString(fact).toHtmlEscaped();
    QStringList lines{facts.join(QStringLiteral(" · "))};
    for (const std::string& remark : sketch_.remarks) lines << QString::fromStdString(remark).toHtmlEscaped();
    facts_->setText(lines.join("<br>"));
    facts_->setVisible(isSound);
    measured_->setText(measured);
    measured_->setVisible(isSound);
    apply_->setEnabled(isSound);
    keep_->setEnabled(isSound);
    if (isSound) {
        const Figure* figures[] = {&sketch_.functions, &sketch_.slopes, &sketch_.amplification,
                                   &sketch_.pattern};
        for (int i = 0; i < 4; ++i) {
            plots_[i]->setFigure(*figures[i]);
            cards_[i]->setSubtitle(QString::fromStdString(figures[i]->subtitle));
        }
    }
    for (PlotWidget* plot : plots_) plot->setStale(!isSound);
    isCurrent_ = isComplete;
}

void OwnWindow::apply() {
    if (index_ >= static_cast<int>(workspace_.scene().schemes.size())) return hide();
    Value next = scheme();
    next.set("enabled", workspace_.scene().schemes[static_cast<std::size_t>(index_)].isEnabled);
    if (workspace_.edit({{"/schemes/" + std::to_string(index_), next}}, tr("Change discretization")))
        original_ = next;
}

}  // namespace extremal
