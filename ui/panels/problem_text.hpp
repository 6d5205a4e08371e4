// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong, what to do about it, and a link to the page of the handbook that explains it.
#pragma once

#include <QString>

#include <string>

#include "engine/core/problem.hpp"

class QLabel;
class QWidget;

namespace extremal {

class Workspace;

/// A link "Handbook" to a page or a heading of it, for labels with links; empty where the place is.
QString handbookLink(const std::string& place);

/// The problem as rich text; `lead` comes before it.
QString problemText(const Problem& problem, const QString& lead = {});

/// Why what was typed at a place was refused, as rich text. A problem at another place names it, and how many
/// more there are.
QString refusalText(const Workspace& workspace, const std::string& place);

/// Whether a widget, or what is around it, was hidden. One that is new and not yet shown was not.
bool isSentAway(const QWidget& widget);

/// A label that wraps and whose links open, by a click, and by Tab and Return.
QLabel* makeLinkLabel(const char* role, QWidget* parent = nullptr);

/// A formula with a caret below its byte `position`, in the letters of the field it was typed in and no wider
/// than so many pixels.
QString caretHtml(const QWidget& field, const std::string& text, std::size_t position, int width);

/// F1 on the widget, or on what is inside, opens this place; empty: it is as it was.
void setHelp(QWidget& widget, const std::string& place);

}  // namespace extremal
