// SPDX-License-Identifier: GPL-3.0-or-later
/// What the handbook says of an error or a warning: every finding has a topic, and every topic a page, as
/// "PAGE#HEADING" with the heading's words in lower case, joined by hyphens.
#pragma once

#include <string>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/problem.hpp"

namespace extremal {

struct Topic {
    std::string id;     ///< "resonance", "model.kepler", "outcome.lost"
    std::string place;  ///< "multiscale#resonances"
};

const std::vector<Topic>& topics();

/// Gives problems of a scene without a topic that of the model or the space which they concern.
void nameTopics(std::vector<Problem>& problems, const Value& document);

/// The place of the problem's topic; of one without, the place of the scene's format where its pointer is
/// explained.
std::string handbookPlace(const Problem& problem);
/// Of what ended a run; empty for steps that are done.
std::string handbookPlace(Outcome outcome);

}  // namespace extremal
