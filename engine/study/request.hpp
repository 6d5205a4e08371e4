// SPDX-License-Identifier: GPL-3.0-or-later
/// A study as it is asked for, by the words of the command line, and made from them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "engine/study/catalog.hpp"

namespace extremal {

struct StudyRequest {
    std::string kind, metric = "error", shard, x, y;
    bool isFinal = false, findsLimits = false, isLong = false;
    std::vector<double> steps;
    double from = 0, to = 0, error = 0;
    std::vector<std::string> wishes;  ///< "METRIC=VALUE"
    std::string candidates;           ///< "scene" or "all"; empty: "scene", of needs "all"
    std::string budget;               ///< "1ms", "1ms/s"; empty: none
    std::string memory;               ///< "10MB": that a scheme may hold; empty: any
    std::string over, of;             ///< "POINTER=a,b,c"; "worst" or "median". Empty: the scene alone
    std::string knobs;                ///< "step,degree,cells"; empty: all
    std::string searchTime;           ///< "0.5", "500ms", "1s"; empty: the usual one
    int points = 0, repeat = 5;
    std::vector<std::string> only;
};

using AnyStudy = std::variant<Sweep, StabilityStudy, LinearStudy, ExtremesStudy, LimitsStudy>;

/// The entry of its kind. Throws InvalidScene where there is none, and where the request has options that
/// belong to another study, or lacks one: none is silently ignored.
const StudyEntry& knownStudy(const StudyRequest& request);

/// `scene`: null of a study that has none. Throws InvalidScene, with options as pointers ("--error").
AnyStudy makeStudy(const StudyEntry& entry, const StudyRequest& request, const ResolvedScene* scene,
                   unsigned threads);

}  // namespace extremal
