// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors and warnings about input: what is wrong, where, and what to do about it.
#pragma once

#include <exception>
#include <string>
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
/// The library exports it.
class __attribute__((visibility("default"))) InvalidScene : public std::exception {
public:
    explicit InvalidScene(std::vector<Problem> problems);
    InvalidScene(std::string pointer, std::string message, std::string hint = {});
    InvalidScene(const InvalidScene&);
    InvalidScene& operator=(const InvalidScene&);
    ~InvalidScene() override;
    const std::vector<Problem>& problems() const { return problems_; }
    const char* what() const noexcept override { return text_.c_str(); }

private:
    void makeText();

    std::vector<Problem> problems_;
    std::string text_;
};

}  // namespace extremal
