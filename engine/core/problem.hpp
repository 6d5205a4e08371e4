// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors and warnings about input: what is wrong, where, and what to do about it.
#pragma once

#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// One finding. `pointer` is a JSON pointer into the scene ("/schemes/1/step"), empty for the whole document.
struct Problem {
    std::string pointer;
    std::string message;  ///< names the value and the limit: "must be a positive finite number, got -0.1"
    std::string hint;     ///< the remedy, without brackets; may be empty
    std::string origin =
        {};             ///< the pointer of the override (--set) it comes from; empty: the document itself
    Value remedy = {};  ///< a value for the pointer that resolves the problem; null: none
    /// What the handbook explains it under (scene/outlook/topics.hpp); empty: what its pointer says.
    std::string topic = {};
    bool operator==(const Problem&) const = default;
};

/// Input that cannot be used. Thrown before any work is done, with every error that was found.
class InvalidScene : public std::exception {
public:
    explicit InvalidScene(std::vector<Problem> problems) : problems_(std::move(problems)) { makeText(); }
    InvalidScene(std::string pointer, std::string message, std::string hint = {})
        : problems_{{std::move(pointer), std::move(message), std::move(hint)}} {
        makeText();
    }
    const std::vector<Problem>& problems() const { return problems_; }
    const char* what() const noexcept override { return text_.c_str(); }

private:
    void makeText() {
        for (const Problem& p : problems_) {
            if (!text_.empty()) text_ += '\n';
            text_ += p.pointer + ": " + p.message;
            if (!p.hint.empty()) text_ += " (" + p.hint + ")";
        }
    }
    std::vector<Problem> problems_;
    std::string text_;
};

}  // namespace extremal
