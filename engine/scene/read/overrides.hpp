// SPDX-License-Identifier: GPL-3.0-or-later
/// --set POINTER=VALUE: changes a document before it is checked.
#pragma once

#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

/// Where an override went: a place in the document, and the pointer the user gave ("/schemes/*/step").
struct Change {
    std::string place;
    std::string pointer;
};

/// Applies one override. "*" is every element of an array, "-" appends. A key that the format knows is
/// created, another is an error; errors carry the override's pointer as their origin.
void applyOverride(Value& document, const Override& override, std::vector<Change>& changes,
                   std::vector<Problem>& errors);

/// Marks the problems that lie at or below a changed place with the override they come from.
void markOrigins(std::vector<Problem>& problems, const std::vector<Change>& changes);

/// Keys that may stand in the object at a place of a document; empty if any may (it is checked elsewhere).
std::vector<std::string> knownKeys(const Value& document, const std::vector<std::string>& place);

}  // namespace extremal
