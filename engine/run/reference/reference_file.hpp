// SPDX-License-Identifier: GPL-3.0-or-later
/// A reference from a CSV file: rows with the time t and the state, in columns of these names and in any
/// order, as the files of a run have them. Columns of the state may be missing, as momenta are in what was
/// measured: errors are those of what is there. It is known at its own times, to 1e-9 of t; an empty cell, or
/// nan, is not known.
#pragma once

#include <istream>
#include <string>

#include "engine/model/system.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

/// `name`: of the file, for messages. Throws InvalidScene (pointer /reference/path) that names the line for a
/// row of another length, a cell that is not a number, or a time that is there twice; or that says that t, or
/// every column of the state, is missing, or that cells are separated by something other than commas.
Reference readReference(std::istream& in, const std::string& name, const System& system);

/// The same from a path.
Reference readReference(const std::string& path, const System& system);

}  // namespace extremal
