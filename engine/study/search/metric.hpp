// SPDX-License-Identifier: GPL-3.0-or-later
/// What a study measures of a run: the largest size, over all nodes or at the last one, of the column that an
/// observable declares as its extreme.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal {

struct Metric {
    std::string name;  ///< "error", "energy", "momentum", "norm", "phase", or the id of an observable
    const ObservableEntry* observable = nullptr;
    bool isAtEnd = false;  ///< at the last node in place of the maximum
};

/// The names of what can be measured for a system, in the order of the catalogue.
std::vector<std::string> metricNames(const System& system, const State& start);

/// Throws InvalidScene (pointer "--metric") where the system has no such observable, or where it declares no
/// extreme; the hint lists those that can be measured.
Metric metricOf(const std::string& name, bool isAtEnd, const System& system, const State& start);

}  // namespace extremal
