// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps of a lesson: the key "steps" of a scene. They tell a reader what to do next and drive the
/// window; no run depends on them, and a Scene does not hold them.
///
///     "steps": [{"text": "Now drag h past 2.", "scheme": "midpoint", "view": "energy", "time": 5,
///                "set": {"/schemes/0/step": 2.05}, "until": {"/schemes/0/step": {"above": 2}}}]
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

class Reader;
struct Scene;

struct LessonStep {
    /// A number of the scene within bounds, or any value equal to one.
    struct Goal {
        std::string pointer;
        double above = -std::numeric_limits<double>::infinity();
        double below = std::numeric_limits<double>::infinity();
        std::optional<Value> equal = {};
    };
    std::string text;    ///< Markdown with formulas
    std::string scheme;  ///< label of the scheme that is selected; empty: none
    std::string view;    ///< id of the view that is looked at; empty: none
    std::optional<double> time;
    std::vector<std::pair<std::string, Value>> set;  ///< places of the scene and what they become
    std::vector<Goal> until;                         ///< done when all are reached; empty: when it is read
};

/// The steps of a document; those with mistakes, which go to the reader, are left out. A view
/// must be one that there is, and a place to set a JSON pointer; a label that no scheme has is a warning.
std::vector<LessonStep> readLessonSteps(Reader& reader, const Value& document, const Scene& scene);

/// The steps of a document that readScene() has found right.
std::vector<LessonStep> lessonSteps(const Value& document, const Scene& scene);

/// Whether the document is as the step wants it.
bool isReached(const LessonStep& step, const Value& document);

}  // namespace extremal
