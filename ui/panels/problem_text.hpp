/// What is wrong, what to do about it, and a link to the page of the handbook that explains it.
#pragma once

#include <QString>

#include <string>

#include "engine/core/problem.hpp"

class QLabel;
class QWidget;

namespace extremal {

/// A link "Handbook" to a page or a heading of it, for labels with links; empty where the place is.
QString handbookLink(const std::string& place);

/// The problem as rich text; `lead` comes before it.
QString problemText(const Problem& problem, const QString& lead = {});

/// A label that wraps and whose links open, by a click, and by Tab and Return.
QLabel* makeLinkLabel(const char* role, QWidget* parent = nullptr);

/// F1 on the widget, or on what is inside, opens this place; empty: it is as it was.
void setHelp(QWidget& widget, const std::string& place);

}  // namespace extremal
