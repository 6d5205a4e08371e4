// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run was asked for and could not have, and why: nothing that was asked for vanishes without a word.
///
/// An observable is missing where it has no value at any row, or, of those that only fill the summary, where
/// that stays empty. What has no error by its nature (the energy of a system that depends on time) is not
/// missing. Of runs that ended early the values up to there count; of one that took no step there are none.
#pragma once

#include <string>
#include <vector>

#include "engine/run/comparison.hpp"

namespace extremal {

struct Missing {
    std::string observable;  ///< its id: "error"
    std::string reason;      ///< a clause for people
};

/// In the order of the scene's `observe`; of a scheme that is not computed yet, nothing.
std::vector<Missing> missingFrom(const Comparison& comparison, const SchemeResult& scheme);

/// Of a run without a step: what was measured at its start alone says nothing of the scheme, and is not
/// known.
void forgetMeasured(Summary& summary);

/// Of an extreme over some of the nodes only: a clause that says over how many, and where the first is that
/// has no value.
std::string textOfKnown(const std::string& column, long long known, long long nodes, double unknownFrom);

}  // namespace extremal
