// SPDX-License-Identifier: GPL-3.0-or-later
/// What can stand beside a typed formula, as data: one entry per key of a model. A kind is offered where the
/// model takes its key.
#pragma once

#include <QString>

#include <string>
#include <vector>

namespace extremal {

/// How the lines of a kind are named: freely, by a coordinate or variable each, by a pair of variables "x,y",
/// or not at all as there is one.
enum class PartNaming { free, byCoordinate, byPair, single };

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
/// Whether a type of model has the key of the kind.
bool isOffered(const PartKind& kind, const std::string& model);

}  // namespace extremal
