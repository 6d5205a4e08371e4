// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/format.hpp"

#include <QStringList>

#include <algorithm>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

QString shortNumber(double value, int digits) {
    if (!std::isfinite(value)) return QStringLiteral("–");
    if (value == 0) return QStringLiteral("0");
    const double size = std::abs(value);
    if (size >= 1e-3 && size < 1e5) return QString::fromStdString(formatNumber(value, std::max(digits, 3)));
    QString text = QString::number(value, 'e', digits - 1);
    text.replace(QStringLiteral("e-0"), QStringLiteral("e-"));
    text.replace(QStringLiteral("e+0"), QStringLiteral("e"));
    text.replace(QStringLiteral("e+"), QStringLiteral("e"));
    text.replace(QStringLiteral(".0e"), QStringLiteral("e"));
    return text;
}

QString shortTime(double seconds) {
    const auto with = [](double value, const char* unit) {
        return QString::number(value, 'f', value < 9.95 ? 1 : 0) + QString::fromUtf8(unit);
    };
    if (!std::isfinite(seconds)) return QStringLiteral("–");
    if (seconds < 1e-3) return with(seconds * 1e6, " µs");
    if (seconds < 1) return with(seconds * 1e3, " ms");
    if (seconds < 120) return with(seconds, " s");
    return with(seconds / 60, " min");
}

QString numberText(const Number& number) {
    return QString::fromStdString(number.expression.empty() ? formatNumber(number.value) : number.expression);
}

QString ruleTitle(const std::string& id) {
    for (const CatalogItem& item : quadratureCatalog())
        if (item.id == id) return QString::fromStdString(item.title);
    return QString::fromStdString(id);
}

namespace {

/// At the separators outside of brackets: max(a, b) and table(x; 0, 0; 1, 2) have some inside.
QStringList partsOf(const QString& text, char16_t separator) {
    QStringList parts{QString()};
    int depth = 0;
    for (const QChar c : text) {
        if (c == u'(') ++depth;
        if (c == u')') --depth;
        if (c == separator && depth <= 0)
            parts << QString();
        else
            parts.back() += c;
    }
    return parts;
}

/// "Gauss 3 (2 panels)", of a rule in one direction.
QString ruleText(const Settings& rule) {
    QString text = ruleTitle(rule.type);
    if (const Value* nodes = rule.find("nodes"); nodes && nodes->isNumber())
        text += QString(" %1").arg(rule.integer("nodes"));
    if (const int panels = rule.integer("panels"); panels > 1)
        text += QStringLiteral(" (%1 panels)").arg(panels);
    return text;
}

QString innerText(const SchemeSpec& spec) {
    if (spec.kind == SchemeSpec::Kind::baseline) {
        const BaselineEntry* entry = findBaseline(spec.baseline.type);
        const QString title = QString::fromStdString(entry ? entry->item.title : spec.baseline.type);
        const QString stages =
            spec.baseline.find("stages") ? QString(" %1").arg(spec.baseline.integer("stages")) : QString();
        return QStringLiteral("baseline: ") + title + stages;
    }
    if (spec.kind == SchemeSpec::Kind::named)
        return QStringLiteral("scheme ") + QString::fromStdString(spec.named);
    QString text = QString::fromStdString(spec.space.type);
    if (const Value* const degree = spec.space.find("degree"); degree && degree->isObject()) {
        QStringList parts;
        for (const char* direction : tensorParts) {
            const Value* const own = degree->find(direction);
            parts << shortNumber(own && own->isNumber() ? own->asNumber() : 1);
        }
        text += ' ' + parts.join(", ");
    } else if (degree) {
        text += QString(" %1").arg(spec.space.integer("degree"));
    }
    if (const int cells = spec.space.integer("cells"); cells > 1)
        text += QStringLiteral(" (%1 cells)").arg(cells);
    text += QStringLiteral(" × ");
    if (!isTensorRule(spec.quadrature)) return text + ruleText(spec.quadrature);
    QStringList parts;
    for (const char* direction : tensorPartsOf(spec.quadrature))
        parts << ruleText(tensorPart(spec.quadrature, direction));
    return text + parts.join(", ");
}

/// The length of an element, which follows from their number: the expression in its place says how, and is
/// not what was typed.
bool hasElements(const SchemeSpec& spec) {
    const auto discretization = discretizationOf(spec);
    return discretization && familyPart<StepOfSpace>(discretization->space);
}

}  // namespace

QString schemeText(const SchemeSpec& spec) {
    // Of elements that take their rule from the problem, "auto" says nothing.
    if (spec.kind == SchemeSpec::Kind::discretization && spec.quadrature.type == "auto" && hasElements(spec))
        return QString::fromStdString(describe(spec.space, spec.quadrature).space);
    const Settings& c = spec.composition;
    if (c.type.empty()) return innerText(spec);
    for (const CatalogItem& item : compositionCatalog())
        if (item.id == c.type)
            return QStringLiteral("%1 %2 of %3")
                .arg(QString::fromStdString(item.title))
                .arg(c.integer("order"))
                .arg(innerText(spec).remove(QStringLiteral("baseline: ")).remove(QStringLiteral("scheme ")));
    return innerText(spec);
}

int elementsOf(const SchemeSpec& spec) { return static_cast<int>(std::lround(1 / spec.step.value)); }

QString stepText(const SchemeSpec& spec) {
    if (spec.tolerance) return QStringLiteral("tol ") + shortNumber(*spec.tolerance);
    // Steps that follow from a mesh have all digits.
    const Number& step = spec.step;
    return QStringLiteral("h = ") + (step.expression.empty() || hasElements(spec)
                                         ? QString::fromStdString(formatNumber(step.value, 5))
                                         : numberText(step));
}

QString fieldText(const Value& value) {
    if (value.isNull()) return {};
    if (value.isNumber()) return QString::fromStdString(formatNumber(value.asNumber()));
    if (value.isString()) return QString::fromStdString(value.asString());
    const auto isPlain = [](const Value& v) { return v.isNumber() || v.isString(); };
    if (value.isArray() && std::all_of(value.asArray().begin(), value.asArray().end(), isPlain)) {
        QStringList entries;
        for (const Value& entry : value.asArray()) entries << fieldText(entry);
        return entries.join(QStringLiteral(", "));
    }
    return QString::fromStdString(writeCompactJson(value));
}

QString constantsText(const Value& value) {
    if (!value.isObject()) return fieldText(value);
    QStringList entries;
    for (const auto& [name, number] : value.asObject())
        entries << QString::fromStdString(name) + QStringLiteral(" = ") + fieldText(number);
    return entries.join(QStringLiteral(", "));
}

Value constantsFrom(const QString& text) {
    Value constants{Value::Object{}};
    if (text.trimmed().isEmpty()) return constants;
    for (const QString& entry : partsOf(text, u',')) {
        const qsizetype at = entry.indexOf('=');
        const Value number = at < 0 ? Value() : numberOrExpression(entry.mid(at + 1));
        if (number.isNull()) return text.toStdString();  // the scene's own check says what is wrong with it
        constants.set(entry.left(at).trimmed().toStdString(), number);
    }
    return constants;
}

QString formulasText(const Value& value) {
    if (!value.isArray()) return fieldText(value);
    QStringList entries;
    for (const Value& entry : value.asArray()) entries << fieldText(entry);
    return entries.join(QStringLiteral("; "));
}

Value formulasFrom(const QString& text) {
    Value::Array entries;
    for (const QString& entry : partsOf(text, u';'))
        if (Value value = numberOrExpression(entry); !value.isNull()) entries.push_back(std::move(value));
    return entries;
}

QString definitionsText(const Value& value) {
    if (!value.isObject()) return fieldText(value);
    QStringList entries;
    for (const auto& [name, entry] : value.asObject())
        entries << QString::fromStdString(name) + QStringLiteral(" = ") + fieldText(entry);
    return entries.join(QStringLiteral("; "));
}

Value definitionsFrom(const QString& text) {
    Value names{Value::Object{}};
    for (const QString& entry : partsOf(text, u';')) {
        if (entry.trimmed().isEmpty()) continue;
        const qsizetype at = entry.indexOf('=');
        const Value value = at < 0 ? Value() : numberOrExpression(entry.mid(at + 1));
        if (value.isNull()) return text.toStdString();  // the scene's own check says what is wrong with it
        names.set(entry.left(at).trimmed().toStdString(), value);
    }
    return names;
}

Value numbersOrExpressions(const QString& text) {
    Value::Array entries;
    for (const QString& entry : partsOf(text, u',')) entries.push_back(numberOrExpression(entry));
    return entries;
}

Value numberOrExpression(const QString& text) {
    const std::string trimmed = text.trimmed().toStdString();
    if (trimmed.empty()) return {};
    if (const auto number = parseNumber(trimmed); number && std::isfinite(*number)) return *number;
    return trimmed;
}

}  // namespace extremal
