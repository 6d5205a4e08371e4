// SPDX-License-Identifier: GPL-3.0-or-later
/// What a formula that is typed means for the names of its scene: an unknown velocity x_t, of a Hamiltonian
/// an unknown momentum p_x, makes x a coordinate, any other unknown name a parameter, both with a value to
/// begin with. Of a one-form or a bracket the variables are listed, so that unknown names are parameters.
///
///     TypedNames names;
///     names.forget(document);                              // another scene
///     names.edit(workspace, "/model/lagrangian", "m/2*x_t^2 - k/2*x^2", tr("Change the Lagrangian"));
///
/// A name that was made so goes as soon as no formula has it; its value is remembered, in case it comes back.
/// A name that looks like a slip ("thetta" beside "theta") makes nothing until mean() says that it is meant.
/// What was typed itself is never changed.
#pragma once

#include <QString>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

class Workspace;

class TypedNames {
public:
    struct Outcome {
        std::vector<Edit> edits;                           ///< with that of what was typed
        std::vector<std::string> coordinates, parameters;  ///< new ones
        std::vector<std::string> slips;                    ///< unknown names that look like slips
        bool changesNames = false;
    };

    /// Forgets what was made. Of a page with nothing but the example of a new scene, all names may go.
    void forget(const Value& document);
    /// What typing this value at a place of the document means. `triesStarts`: looks for initial data from
    /// which the system can start, which differentiates the formula.
    Outcome outcomeOf(const Value& document, const std::string& place, const Value& typed,
                      bool triesStarts) const;
    /// Makes these edits, as one step of undo with what is typed next; false: they were refused.
    bool edit(Workspace& workspace, const std::string& place, const Value& typed, const QString& what);
    /// Drops what was typed there and refused, with the names that it would have made.
    void drop(Workspace& workspace, const std::string& place);
    /// The name is no slip.
    void mean(const std::string& name) { meant_.insert(name); }
    /// The latest unknown names that look like slips.
    const std::vector<std::string>& slips() const { return slips_; }
    /// "x is a coordinate now", of the latest edit; empty where it made no name.
    const QString& note() const { return note_; }
    void clearNote() { note_.clear(); }

private:
    std::set<std::string> made_, meant_;
    std::map<std::string, Value> remembered_;  ///< values of parameters, places of coordinates
    std::vector<std::string> slips_;
    QString note_;
    bool hasRefusedNames_ = false;  ///< drafts of names are those of a refused edit of this class
};

}  // namespace extremal
