// SPDX-License-Identifier: GPL-3.0-or-later
/// The user's own schemes: a JSON file of schemes under names,
///     {"extremal-schemes": 1, "schemes": [{"label": "fitted", "step": 0.1, "space": {...}, ...}, ...]},
/// each as a scene has it. The file is the same whether it is the user's catalogue or an export of one
/// scheme.
///
/// What cannot be used is named with its place, and kept: entries that have faults are written back as they
/// were, and a file that is not a catalogue at all is never written over.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"

namespace extremal {

class OwnSchemes {
public:
    /// Throws InvalidScene, pointer into the file, where the text is not a catalogue. One scheme alone is one
    /// as well.
    static OwnSchemes parse(std::string_view json);
    /// The catalogue in a file; empty where there is none. Throws InvalidScene, and names the file.
    static OwnSchemes load(const std::string& file);
    /// Writes it whole or not at all. Throws ExportError.
    void save(const std::string& file) const;
    std::string text() const;

    /// Of the entries without faults, in their order.
    std::vector<std::string> names() const;
    /// The scheme as a scene takes it, with its name as label; null if there is none.
    const Value* find(std::string_view name) const;
    /// What is wrong with the others: "/schemes/2/label".
    const std::vector<Problem>& faults() const { return faults_; }

    /// A scheme of a scene under a name, without what belongs to that scene (colour, on or off). Throws
    /// InvalidScene where the name is taken, empty or not on one line.
    void add(const std::string& name, const Value& scheme);
    /// All of another catalogue; a name that is taken gets a number. Returns the names.
    std::vector<std::string> import(const OwnSchemes& other);
    void rename(std::string_view name, const std::string& next);
    void remove(std::string_view name);
    /// A catalogue of one of them, for export.
    OwnSchemes only(std::string_view name) const;

private:
    void examine();
    std::size_t placeOf(std::string_view name) const;

    Value::Array entries_;
    std::vector<bool> isSound_;
    std::vector<Problem> faults_;
};

/// The user's catalogue: $EXTREMAL_SCHEMES, else schemes.json in the folder of the program's configuration.
std::string ownSchemesFile();

/// The user's schemes as they are on disk now; empty where the file cannot be used.
OwnSchemes ownSchemes();

}  // namespace extremal
