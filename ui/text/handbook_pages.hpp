// SPDX-License-Identifier: GPL-3.0-or-later
/// The pages of the handbook that are built into the program, and their sections. A place is a page or a
/// heading of it: "tour", "scenes#time-and-rows".
#pragma once

#include <QStringList>

namespace extremal {

/// Names of all pages, in the order in which the index links to them.
QStringList handbookPages();

/// The Markdown of a page; empty: there is none of that name.
QString handbookPage(const QString& page);

/// The first line of a page, without the marks of Markdown; empty: there is none of that name.
QString handbookTitle(const QString& page);

/// "A heading, with words" -> "a-heading-with-words".
QString handbookAnchor(const QString& heading);

/// The Markdown of a place: a page, or a heading with what is below it. Empty: there is no such place.
QString handbookSection(const QString& place);

}  // namespace extremal
