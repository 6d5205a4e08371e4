// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/parameter_table.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/base/value_edit.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/workspace/typed_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

constexpr int sliderSteps = 200;

std::string placeOf(const std::string& name) { return "/model/parameters/" + name; }

}  // namespace

ParameterTable::Range ParameterTable::Range::around(double value) {
    if (value == 0 || !std::isfinite(value)) return {-1, 1};
    return value > 0 ? Range{0, 2 * value} : Range{2 * value, 0};
}

/// Rounded to the digits that one position of the slider changes.
double ParameterTable::Range::at(int position) const {
    const double step = (high - low) / sliderSteps;
    const double unit = std::pow(10, std::floor(std::log10(step)));
    const double value = std::round((low + step * position) / unit) * unit;
    return parseNumber(formatNumber(value, 12)).value_or(value);
}

int ParameterTable::Range::position(double value) const {
    return static_cast<int>(std::lround((value - low) / (high - low) * sliderSteps));
}

ParameterTable::ParameterTable(Workspace& workspace, FormulaChange change, QWidget* parent)
    : QWidget(parent), workspace_(workspace), change_(std::move(change)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    grid_ = new QGridLayout;
    grid_->setHorizontalSpacing(6);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(2, 1);
    problem_ = makeLinkLabel("caption");
    problem_->setObjectName("problem.parameters");
    problem_->setProperty("problem", true);
    problem_->hide();
    auto* add = new QToolButton;
    add->setObjectName("addParameter");
    add->setText(tr("+ parameter"));
    add->setToolTip(tr("Adds a constant for the formula and for numbers of the scene"));
    connect(add, &QToolButton::clicked, this, &ParameterTable::addParameter);
    column->addLayout(grid_);
    column->addWidget(problem_);
    column->addWidget(add, 0, Qt::AlignLeft);
}

ParameterTable::Row* ParameterTable::rowOf(const std::string& name) {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == name; });
    return found == rows_.end() ? nullptr : &*found;
}

void ParameterTable::rebuild(const Value::Object& parameters) {
    rows_.clear();
    while (QLayoutItem* item = grid_->takeAt(0)) {
        if (item->widget()) {
            item->widget()->hide();
            item->widget()->deleteLater();
        }
        delete item;
    }
    for (const auto& [name, value] : parameters) addRow(name);
}

void ParameterTable::addRow(const std::string& name) {
    const QString title = QString::fromStdString(name);
    FieldInfo info;
    info.key = name;
    info.title = name;
    info.fallback = 1.0;
    info.description = "Value of the constant.";
    Row row{name, new QLineEdit(title), new ValueEdit(info), new QSlider(Qt::Horizontal), new QToolButton, {},
            false};
    row.nameEdit->setObjectName("name." + title);
    row.nameEdit->setAccessibleName(tr("Name of %1").arg(title));
    row.nameEdit->setToolTip(tr("A new name also replaces the old one in the formula and in all numbers."));
    row.nameEdit->setProperty("room", "name");
    row.valueEdit->setProperty("room", "value");
    row.slider->setObjectName("slider." + title);
    row.slider->setAccessibleName(tr("Slider of %1").arg(title));
    row.slider->setRange(0, sliderSteps);
    row.slider->setPageStep(sliderSteps / 20);
    row.slider->setMinimumWidth(40);
    row.remove->setObjectName("remove." + title);
    row.remove->setText("×");
    row.remove->setAccessibleName(tr("Remove %1").arg(title));
    row.remove->setProperty("room", "mark");
    const int line = static_cast<int>(rows_.size());
    grid_->addWidget(row.nameEdit, line, 0);
    grid_->addWidget(row.valueEdit, line, 1);
    grid_->addWidget(row.slider, line, 2);
    grid_->addWidget(row.remove, line, 3);
    connect(row.nameEdit, &QLineEdit::editingFinished, this,
            [this, name, edit = row.nameEdit] { rename(name, *edit); });
    connect(row.valueEdit, &ValueEdit::edited, this, [this, name](const Value& value) {
        const Value* now = valueAt(workspace_.document(), placeOf(name));
        if (now && *now == value) return workspace_.dropDraft(placeOf(name));
        workspace_.edit({{placeOf(name), value}}, tr("Change %1").arg(QString::fromStdString(name)),
                        QString::fromStdString(placeOf(name)));
    });
    connect(row.slider, &QSlider::valueChanged, this, [this, name](int position) { slide(name, position); });
    connect(row.remove, &QToolButton::clicked, this, [this, name] {
        if (!workspace_
                 .tryEdit(editsForParameterRemoval(workspace_.document(), name),
                          tr("Remove %1").arg(QString::fromStdString(name)))
                 .empty()) {
            problem_->setText(tr("%1 is used in a number of the scene").arg(QString::fromStdString(name)));
            problem_->show();
        }
    });
    rows_.push_back(row);
}

void ParameterTable::slide(const std::string& name, int position) {
    const Row* row = rowOf(name);
    if (!row) return;
    workspace_.edit({{placeOf(name), row->range.at(position)}},
                    tr("Change %1").arg(QString::fromStdString(name)), QString::fromStdString(placeOf(name)));
}

void ParameterTable::rename(const std::string& from, QLineEdit& edit) {
    const std::string to = edit.text().trimmed().toStdString();
    if (to == from) return;
    std::string trouble = nameProblem(to);
    const typed::Formula formula = formulaIn(*valueAt(workspace_.document(), "/model"));
    for (const std::string& c : formula.coordinates)
        if (c == to) trouble = "is already a coordinate";
    for (const auto& parameter : formula.parameters)
        if (parameter.first == to) trouble = "is already a parameter";
    if (trouble.empty()) {
        const bool isMade =
            change_([=](const Value& document) { return editsForParameterName(document, from, to); },
                    tr("Rename %1").arg(QString::fromStdString(from)),
                    [=](const std::string& typed) { return withNameReplaced(typed, from, to); });
        if (!isMade) refresh();
        return;
    }
    edit.setProperty("invalid", true);
    repolish(edit);
    problem_->setText(
        tr("the name \"%1\" %2").arg(QString::fromStdString(to), QString::fromStdString(trouble)));
    problem_->show();
}

void ParameterTable::addParameter() {
    std::string name;
    const std::vector<Edit> edits = editsForNewParameter(workspace_.document(), name);
    if (!workspace_.edit(edits, tr("Add a parameter"))) return;
    if (Row* row = rowOf(name)) {
        row->nameEdit->setFocus();
        row->nameEdit->selectAll();
    }
}

void ParameterTable::refresh() {
    const Value* parameters = valueAt(workspace_.document(), "/model/parameters");
    if (!parameters || !parameters->isObject()) return;
    const Value::Object& shown = parameters->asObject();
    const bool isSame =
        std::equal(rows_.begin(), rows_.end(), shown.begin(), shown.end(),
                   [](const Row& row, const Value::Member& m) { return row.name == m.first; });
    if (!isSame) rebuild(shown);
    problem_->hide();
    const auto evaluated = workspace_.scene().model.find("parameters");
    for (Row& row : rows_) {
        const std::string place = placeOf(row.name);
        const Value* draft = workspace_.draftAt(place);
        const Value* written = draft ? draft : valueAt(workspace_.document(), place);
        row.valueEdit->show(*written);
        row.valueEdit->setInvalid(draft != nullptr);
        if (draft) {
            problem_->setText(QString::fromStdString(row.name).toHtmlEscaped() + ' ' +
                              refusalText(workspace_, place));
            problem_->show();
            if (!isSentAway(*row.valueEdit)) workspace_.claimRefusal(place);
        }
        const bool isNumber = written->isNumber();
        row.slider->setEnabled(isNumber);
        const Value* value = isNumber ? written : evaluated->find(row.name);
        const QSignalBlocker block(row.slider);
        if (value && value->isNumber()) {
            if (!row.hasRange || !row.range.contains(value->asNumber()))
                row.range = Range::around(value->asNumber());
            row.hasRange = true;
            row.slider->setValue(row.range.position(value->asNumber()));
        }
        row.slider->setToolTip(isNumber ? tr("%1 to %2").arg(row.range.low).arg(row.range.high)
                                        : tr("follows the expression"));
        const bool isUsed = isInFormulas(workspace_.document(), row.name);
        row.remove->setEnabled(!isUsed);
        row.remove->setToolTip(isUsed ? tr("A formula uses %1").arg(QString::fromStdString(row.name))
                                      : tr("Removes %1").arg(QString::fromStdString(row.name)));
    }
}

}  // namespace extremal
