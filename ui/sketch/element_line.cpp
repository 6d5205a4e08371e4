// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/sketch/element_line.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>

#include <algorithm>

#include "engine/model/cartesian/element_kinds.hpp"
#include "ui/base/card.hpp"
#include "ui/base/value_edit.hpp"

namespace extremal {
namespace {

/// Names of other elements are drawn, and not typed.
bool isValue(const FieldInfo& info) {
    return info.type == FieldType::number || info.type == FieldType::numbers || info.type == FieldType::json;
}

/// The fields that an element of this kind has values for, or could have.
bool isOffered(const FieldInfo& info, const Value& element, const std::string& kind) {
    if (!isValue(info)) return false;
    if (element.find(info.key)) return true;
    const bool isFixed = element.find("fixed") && *element.find("fixed") == Value(true);
    if (kind == "points") return info.key == "velocity" && !isFixed && !element.find("body");
    if (kind == "walls") return info.key == "restitution";
    if (kind == "motors") return false;  // torque, angle or speed: the one that it has
    return true;
}

}  // namespace

ElementLine::ElementLine(QWidget* parent) : QWidget(parent), row_(new QHBoxLayout(this)) {
    row_->setContentsMargins(0, 0, 0, 0);
    row_->setSpacing(6);
    setFixedHeight(30);
}

void ElementLine::show(const MechanismDrawing& drawing,
                       const std::optional<MechanismDrawing::Element>& element) {
    std::string shape;
    const Value* const value = element ? drawing.find(*element) : nullptr;
    if (value && value->isObject()) {
        shape = element->kind + " " + element->name;
        for (const auto& [key, member] : value->asObject()) shape += " " + key;
    }
    const bool isSame = shape == shape_ && element_ == element;
    element_ = value ? element : std::nullopt;
    shape_ = shape;
    if (!isSame || row_->count() == 0) rebuild(drawing);
    if (!value) return;
    const cartesian::ElementKind* const kind = cartesian::findKind(element->kind);
    for (auto* const edit : findChildren<ValueEdit*>(Qt::FindDirectChildrenOnly))
        for (const FieldInfo& info : kind->fields)
            if (edit->objectName() == QString::fromStdString("value." + info.key)) {
                const Value* const own = value->find(info.key);
                edit->show(own ? *own : info.fallback);
            }
}

void ElementLine::rebuild(const MechanismDrawing& drawing) {
    while (QLayoutItem* item = row_->takeAt(0)) {
        if (item->widget()) {
            item->widget()->hide();
            item->widget()->setParent(nullptr);
            item->widget()->deleteLater();
        }
        delete item;
    }
    const Value* const value = element_ ? drawing.find(*element_) : nullptr;
    const cartesian::ElementKind* const kind = element_ ? cartesian::findKind(element_->kind) : nullptr;
    if (!value || !kind) {
        row_->addWidget(makeLabel(tr("Click an element to change its values."), "caption"));
        row_->addStretch();
        return;
    }
    row_->addWidget(makeLabel(QString::fromStdString(kind->title), "strong"));
    auto* name = new QLineEdit(QString::fromStdString(element_->name));
    name->setObjectName(QStringLiteral("elementName"));
    name->setAccessibleName(tr("Name of the element"));
    name->setMaximumWidth(90);
    connect(name, &QLineEdit::editingFinished, this, [this, name] {
        if (element_ && name->text().toStdString() != element_->name) emit renamed(name->text());
    });
    row_->addWidget(name);
    for (const FieldInfo& info : kind->fields) {
        if (!isOffered(info, *value, element_->kind)) continue;
        row_->addWidget(makeLabel(QString::fromStdString(info.title), "caption"));
        auto* edit = new ValueEdit(info);
        edit->setObjectName(QString::fromStdString("value." + info.key));
        edit->setMaximumWidth(info.type == FieldType::numbers ? 130 : 80);
        connect(edit, &ValueEdit::edited, this,
                [this, key = info.key](const Value& changed) { emit edited(key, changed); });
        row_->addWidget(edit);
        if (!info.unit.empty()) row_->addWidget(makeLabel(QString::fromStdString(info.unit), "caption"));
    }
    row_->addStretch();
}

}  // namespace extremal
