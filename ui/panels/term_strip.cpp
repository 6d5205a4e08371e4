// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/term_strip.hpp"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSpinBox>

#include <algorithm>

#include "engine/family/family.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/model/lagrangian_terms.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/bind.hpp"
#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// The terms that a scheme can have rules for; none where it cannot.
std::vector<std::string> termsOf(const Scene& scene, const SchemeSpec& spec) {
    if (spec.kind != SchemeSpec::Kind::discretization) return {};
    const Family* const family = familyOf(spec.space);
    if (!family || !family->parts.find<DescribedOnSystem>()) return {};
    const System system = makeSystem(scene);
    const Mechanical* const mechanics = system.parts.find<Mechanical>();
    if (!mechanics || !appliesTo(*family, system)) return {};
    std::vector<std::string> names;
    for (const auto& term : termsOf(*mechanics)) names.push_back(term.name);
    if (names.size() < 2) return {};
    return names;
}

/// The rules that have nodes and no formulas, and whether they have a number of them.
std::vector<const RuleEntry*> rulesOfTerms() {
    std::vector<const RuleEntry*> rules;
    for (const RuleEntry* rule : rulesByPlace()) {
        const bool isTyped = std::any_of(rule->item.parameters.begin(), rule->item.parameters.end(),
                                         [](const FieldInfo& f) { return f.type == FieldType::formulas; });
        if (rule->make && !isTyped) rules.push_back(rule);
    }
    return rules;
}

bool hasNodes(const RuleEntry* rule) {
    return rule && std::any_of(rule->item.parameters.begin(), rule->item.parameters.end(),
                               [](const FieldInfo& f) { return f.key == "nodes"; });
}

}  // namespace

TermStrip::TermStrip(Workspace& workspace, QWidget* parent) : QWidget(parent), workspace_(workspace) {
    setObjectName("terms");
    grid_ = new QGridLayout(this);
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setVerticalSpacing(3);
    grid_->setColumnStretch(1, 1);
    caption_ = makeLabel(tr("A rule for each term"), "caption");
    grid_->addWidget(caption_, 0, 0, 1, 3);
    hide();
}

void TermStrip::setScheme(int index) {
    index_ = index;
    const Scene& scene = workspace_.scene();
    const SchemeSpec& spec = scene.schemes[static_cast<std::size_t>(index)];
    const std::vector<std::string> terms = termsOf(scene, spec);
    setVisible(!terms.empty());
    if (terms.empty()) return;
    const bool isSame = terms.size() == rows_.size() &&
                        std::equal(rows_.begin(), rows_.end(), terms.begin(),
                                   [](const Row& row, const std::string& term) { return row.term == term; });
    isFilling_ = true;
    if (!isSame) fill(terms);
    for (const Row& row : rows_) {
        const Settings own = isTermRule(spec.quadrature) ? termPart(spec.quadrature, row.term) : Settings{};
        const Value* const written = isTermRule(spec.quadrature) ? spec.quadrature.find(row.term) : nullptr;
        row.rule->setCurrentIndex(written ? std::max(0, row.rule->findData(QString::fromStdString(own.type)))
                                          : 0);
        const bool counts = written && hasNodes(findRule(own.type));
        row.nodes->setEnabled(counts);
        row.nodes->setValue(counts ? own.integer("nodes") : 1);
    }
    isFilling_ = false;
}

void TermStrip::fill(const std::vector<std::string>& terms) {
    for (const Row& row : rows_) {
        QWidget* const name = grid_->itemAtPosition(static_cast<int>(&row - rows_.data()) + 1, 0)->widget();
        for (QWidget* part : {name, static_cast<QWidget*>(row.rule), static_cast<QWidget*>(row.nodes)}) {
            part->hide();
            grid_->removeWidget(part);
            part->deleteLater();  // one of them may have asked for it
        }
    }
    rows_.clear();
    for (const std::string& term : terms) {
        const int line = static_cast<int>(rows_.size()) + 1;
        const QString name = QString::fromStdString(term);
        Row row{term, new ComboBox, new QSpinBox};
        row.rule->setObjectName("term." + name);
        row.rule->setAccessibleName(tr("Rule of %1").arg(name));
        row.rule->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        row.rule->setMinimumContentsLength(6);
        row.rule->addItem(tr("as the others"), QString());
        for (const RuleEntry* rule : rulesOfTerms())
            row.rule->addItem(QString::fromStdString(rule->item.title),
                              QString::fromStdString(rule->item.id));
        row.nodes->setObjectName("nodes." + name);
        row.nodes->setAccessibleName(tr("Nodes for %1").arg(name));
        row.nodes->setRange(1, 64);
        row.nodes->setKeyboardTracking(false);
        grid_->addWidget(makeLabel(name, "body"), line, 0);
        grid_->addWidget(row.rule, line, 1);
        grid_->addWidget(row.nodes, line, 2);
        rows_.push_back(row);
        const std::size_t at = rows_.size() - 1;
        connect(row.rule, &QComboBox::activated, this, [this, at] { change(rows_[at]); });
        connect(row.nodes, &QSpinBox::valueChanged, this, [this, at] {
            if (!isFilling_) change(rows_[at]);
        });
    }
}

void TermStrip::change(const Row& row) {
    const SchemeSpec& spec = workspace_.scene().schemes[static_cast<std::size_t>(index_)];
    const std::string place = "/schemes/" + std::to_string(index_) + "/quadrature";
    const Value* const now = valueAt(workspace_.document(), place);
    const std::string id = row.rule->currentData().toString().toStdString();
    Value rules = isTermRule(spec.quadrature) && now ? *now : Value(Value::Object{});
    if (!isTermRule(spec.quadrature) && now) rules.set(otherTerms, *now);
    std::erase_if(rules.asObject(), [&](const Value::Member& m) { return m.first == row.term; });
    if (!id.empty()) {
        Value own(Value::Object{{"type", id}});
        if (hasNodes(findRule(id)) && row.nodes->isEnabled()) own.set("nodes", row.nodes->value());
        rules.set(row.term, own);
    }
    // Without a rule for any term it is one rule again.
    const bool isOne = rules.asObject().size() == 1 && rules.find(otherTerms);
    workspace_.edit({{place, isOne ? *rules.find(otherTerms) : rules}}, tr("Change the rule of a term"));
}

}  // namespace extremal
