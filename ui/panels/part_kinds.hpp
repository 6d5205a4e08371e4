// SPDX-License-Identifier: GPL-3.0-or-later
/// What can stand beside a typed Lagrangian, as data: one entry per key of the model. A kind is offered as
/// soon as the model takes its key.
#pragma once

#include <QString>

#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/model/typed/part_equations.hpp"

namespace extremal {

/// How the lines of a kind are named: freely, by a coordinate each, or not at all as there is one.
enum class PartNaming { free, byCoordinate, single };

struct PartKind {
    const char* key;    ///< of the model: "constraints"
    const char* title;  ///< "constraint"
    PartNaming naming;
    const char* firstName;  ///< of a new line; further ones are numbered
    const char* tail;       ///< what the formula is understood with: "= 0"
    const char* example;
    const char* tip;
    /// Formulas of one line by their keys; empty: the line is one formula.
    struct Member {
        const char* key;
        const char* initial;  ///< what a new line has; empty: it is typed
    };
    std::vector<Member> members = {};
};

const std::vector<PartKind>& partKinds();
/// Whether the model in this program has the key of the kind.
bool isOffered(const PartKind& kind);

/// What equations of motion are written with.
typed::PartTexts partTextsOf(const Value& model);

}  // namespace extremal
