// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers and names as people read them in the window; files never use these.
#pragma once

#include <QString>

#include "engine/run/comparison.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// "1.2e-7", "0.25", "-" for what is not known.
QString shortNumber(double value, int digits = 2);
/// "1.3 ms", "12 µs", "4.2 s".
QString shortTime(double seconds);
/// "0.25", or the text the user wrote.
QString numberText(const Number& number);
/// "polynomial 2 × Gauss 2", "baseline", "named scheme".
QString schemeText(const SchemeSpec& spec);
/// "h = 0.25" or "tolerance 1e-9".
QString stepText(const SchemeSpec& spec);
/// Of a boundary problem on an interval of length 1.
int elementsOf(const SchemeSpec& spec);
/// A value of a scene as it stands in a field.
QString fieldText(const Value& value);
/// The opposite: a number if it is one, else an expression; null if empty.
Value numberOrExpression(const QString& text);
/// An array of them from a text with commas.
Value numbersOrExpressions(const QString& text);
/// "a = 1, b = 2" for an object of numbers, and the opposite; what cannot be read stays a text.
QString constantsText(const Value& value);
Value constantsFrom(const QString& text);
/// Expressions may have commas in them: "1; tau; atan2(tau, 2)".
QString formulasText(const Value& value);
Value formulasFrom(const QString& text);
/// "z = w*h; x = 2*tau - 1".
QString definitionsText(const Value& value);
Value definitionsFrom(const QString& text);
/// "Gauss" for "gauss".
QString ruleTitle(const std::string& id);

}  // namespace extremal
