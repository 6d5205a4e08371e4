// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas of TeX, as they are copied from papers, in the way in which the program writes them:
///
///     \frac{1}{2} m \dot{x}^2 - m g l \cos\theta     (1)/(2)*m*x_t^2 - m*g*l*cos(theta)
///
/// Letters beside each other are factors, as in TeX; \dot makes velocities; Greek letters are their names;
/// digits below a letter belong to its name (\theta_1: theta1), words after a "_". A function without
/// brackets takes the numbers and letters that follow, up to a velocity, a bracket, a function or a sign.
/// What stands before "=" is left out. Commands that are not known stay as words, so that the place of what
/// is not understood is shown where formulas are checked.
#pragma once

#include <QString>

namespace extremal {

/// Whether a text is TeX rather than a formula of the program: it has a backslash or a brace.
bool isTex(const QString& text);

QString formulaFromTex(const QString& text);

}  // namespace extremal
