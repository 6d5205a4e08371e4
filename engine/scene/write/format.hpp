// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of the scene format that do not come from a catalogue.
#pragma once

#include <string>
#include <vector>

namespace extremal::format {

inline const std::vector<std::string> root = {"$schema",   "extremal", "title",       "source", "lesson",
                                              "notes",     "model",    "initial",     "time",   "schemes",
                                              "reference", "observe",  "sensitivity", "events", "output",
                                              "views",     "show",     "limits",      "steps"};
inline const std::vector<std::string> lessonStep = {"text", "scheme", "view", "time", "set", "until"};
inline const std::vector<std::string> goal = {"above", "below"};
inline const std::vector<std::string> time = {"start", "end"};
inline const std::vector<std::string> initial = {"q", "p", "v", "q1", "at", "project"};
inline const std::vector<std::string> directions = {"both", "up", "down"};
inline const std::vector<std::string> actions = {"write", "count", "stop", "reflect", "switch"};
inline const std::vector<std::string> event = {"expression",  "label",     "direction", "action",
                                               "restitution", "parameter", "value"};
inline const std::vector<std::string> output = {"every", "dense"};
inline const std::vector<std::string> limits = {"steps"};
inline const std::vector<std::string> reference = {"type", "scheme", "path"};
/// In the order of ReferenceSpec::Kind.
inline const std::vector<std::string> referenceKinds = {"auto",   "exact", "none",
                                                        "scheme", "file",  "companion"};
/// Of these, those that need nothing else.
inline const std::vector<std::string> plainReferences = {"auto", "exact", "companion", "none"};
inline const std::vector<std::string> view = {"view",  "x",   "y",     "at",     "scheme", "node",
                                              "range", "log", "curve", "starts", "spread", "size"};
inline const std::vector<std::string> cardSize = {"width", "height"};
inline const std::vector<std::string> show = {"time", "pinned", "layout"};
/// In the order of PageLayout.
inline const std::vector<std::string> layouts = {"automatic", "one-column", "two-columns", "three-columns",
                                                 "plots-only"};
inline const std::vector<std::string> range = {"x", "y"};
inline const std::vector<std::string> scheme = {
    "label",  "enabled",        "step",        "tolerance", "space",  "quadrature", "baseline", "scheme",
    "solver", "allow_unstable", "composition", "keep",      "impact", "monitor",    "style"};
/// Words for ImpactLaw, in its order.
inline const std::vector<std::string> impactLaws = {"energy", "variational"};
inline const std::vector<std::string> solver = {"method", "tolerance", "max_iterations"};

}  // namespace extremal::format
