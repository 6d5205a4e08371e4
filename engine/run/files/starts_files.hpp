// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of the starts of views: "starts.csv", one row per start, and "starts.points.csv", the points of
/// their motions; of further views with starts "starts-2.csv", ...
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/run/comparison.hpp"

namespace extremal {

/// Name of the first file of each set, without ".csv".
std::vector<std::pair<std::string, const StartSet*>> startFiles(const Comparison& comparison);

/// scheme,start,x and y by their columns,lyapunov,megno,steps,points,status
std::string startsCsv(const StartSet& set);
/// start, then t and the state
std::string startPointsCsv(const StartSet& set);

/// "done", "no start" where the energy admits none, "waiting", or how the motion ended.
std::string statusOf(const Orbit* orbit);

}  // namespace extremal
