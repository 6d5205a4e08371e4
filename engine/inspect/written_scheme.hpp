// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme written down as functions, nodes and weights, one per line, for an editor to begin with.
#pragma once

#include <string>

#include "engine/scene/scene.hpp"

namespace extremal {

struct WrittenScheme {
    std::string functions = "1\ntau\ntau^2\ntau^3";
    std::string nodes = "(3-sqrt(3))/6\n(3+sqrt(3))/6", weights;
    bool hasFunctions = false;  ///< they are those of the scheme; else an example
    bool hasNodes = false;      ///< with the weights
};

/// Of discretizations with one table: polynomials as monomials, every rule as numbers.
WrittenScheme writtenScheme(const SchemeSpec& scheme);

}  // namespace extremal
