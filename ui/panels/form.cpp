// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/form.hpp"

#include <QGridLayout>
#include <QLabel>

#include "engine/scene/outlook/topics.hpp"
#include "ui/base/card.hpp"
#include "ui/base/scrub_label.hpp"
#include "ui/base/value_edit.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

Form::Form(Workspace& workspace, QWidget* parent) : QWidget(parent), workspace_(workspace) {
    grid_ = new QGridLayout(this);
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(8);
    grid_->setVerticalSpacing(5);
    grid_->setColumnStretch(1, 1);
    connect(&workspace_, &Workspace::sceneChanged, this, &Form::refresh);
    connect(&workspace_, &Workspace::draftsChanged, this, &Form::refresh);
}

void Form::setFields(std::vector<FormField> fields) {
    rows_.clear();
    while (QLayoutItem* item = grid_->takeAt(0)) {
        if (item->widget()) item->widget()->deleteLater();
        delete item;
    }
    for (FormField& field : fields) addRow(std::move(field));
    refresh();
}

void Form::addRow(FormField field) {
    const FieldInfo& info = field.info;
    QString label = field.label;
    if (label.isEmpty()) {
        label = QString::fromStdString(info.title).toHtmlEscaped();
        const QString symbol = QString::fromStdString(info.symbol);
        const QString words = QString(symbol).replace('_', ' ');  // a key that stands in for a symbol
        if (!symbol.isEmpty() && !(' ' + label + ' ').contains(' ' + words + ' '))
            label += " " + symbol.toHtmlEscaped();
    }
    const int row = 2 * static_cast<int>(rows_.size());
    auto* edit = new ValueEdit(info);
    QLabel* name = nullptr;
    if (info.type == FieldType::number) {
        auto* scrub = new ScrubLabel;
        connect(scrub, &ScrubLabel::scrubbed, edit, &ValueEdit::scaleBy);
        connect(scrub, &ScrubLabel::clicked, edit, [edit] { edit->setFocus(); });
        scrub->setToolTip(tr("Drag sideways to change %1").arg(QString::fromStdString(info.title)));
        name = scrub;
    } else {
        name = new QLabel;
    }
    name->setObjectName("label." + QString::fromStdString(info.key));
    name->setTextFormat(Qt::RichText);  // what comes from a scene is escaped
    name->setText(label);
    name->setWordWrap(true);  // narrow panels; then as wide as its longest word
    name->setBuddy(edit);
    edit->setAccessibleName(QString::fromStdString(info.title));  // not that of the label, which has markup
    constexpr int roomOfUnit = 72;  // a longer one would leave the field no room
    const QString unitText = QString::fromStdString(info.unit);
    auto* unit = makeLabel(fontMetrics().elidedText(unitText, Qt::ElideRight, roomOfUnit), "caption");
    unit->setToolTip(unitText);
    auto* problem = makeLinkLabel("caption");
    problem->setObjectName("problem." + QString::fromStdString(info.key));
    problem->setProperty("problem", true);
    problem->hide();
    grid_->setColumnMinimumWidth(0, 68);
    grid_->addWidget(name, row, 0);
    grid_->addWidget(edit, row, 1);
    grid_->addWidget(unit, row, 2);
    grid_->addWidget(problem, row + 1, 0, 1, 3);

    const QString what = tr("Change %1").arg(QString::fromStdString(info.title));
    connect(edit, &ValueEdit::edited, this, [this, field, what](const Value& value) {
        const Value* now = valueAt(workspace_.document(), field.pointer);
        if (now && *now == value) return workspace_.dropDraft(field.pointer);
        // A key that may be left out is removed.
        const std::optional<Value> kept =
            field.info.isOptional && value.isNull() ? std::nullopt : std::optional(value);
        workspace_.edit(field.edits ? field.edits(value) : std::vector<Edit>{{field.pointer, kept}}, what,
                        QString::fromStdString(field.pointer));
    });
    rows_.push_back({std::move(field), edit, problem});
}

void Form::refresh() {
    if (!workspace_.hasScene()) return;
    for (const Row& row : rows_) {
        const Value* draft = workspace_.draftAt(row.field.pointer);
        const Value* value = draft ? draft : valueAt(workspace_.document(), row.field.pointer);
        row.edit->show(value ? *value : row.field.info.fallback);
        const std::string& place = row.field.place.empty() ? row.field.pointer : row.field.place;
        const std::vector<Problem> problems = draft ? workspace_.refusalAt(place) : std::vector<Problem>{};
        const bool isWrong = !problems.empty();
        row.edit->setInvalid(isWrong);
        row.problem->setVisible(isWrong);
        setHelp(*row.edit, isWrong ? handbookPlace(problems.front()) : std::string());
        if (!isWrong) continue;
        row.problem->setText(refusalText(workspace_, place));
        if (!isSentAway(*row.edit)) workspace_.claimRefusal(row.field.pointer);
    }
}

}  // namespace extremal
