// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/problem.hpp"

#include <utility>

namespace extremal {

InvalidScene::InvalidScene(std::vector<Problem> problems) : problems_(std::move(problems)) { makeText(); }
InvalidScene::InvalidScene(std::string pointer, std::string message, std::string hint)
    : problems_{{std::move(pointer), std::move(message), std::move(hint)}} {
    makeText();
}
InvalidScene::InvalidScene(const InvalidScene&) = default;
InvalidScene& InvalidScene::operator=(const InvalidScene&) = default;
InvalidScene::~InvalidScene() = default;

void InvalidScene::makeText() {
    for (const Problem& p : problems_) {
        if (!text_.empty()) text_ += '\n';
        text_ += p.pointer + ": " + p.message;
        if (!p.hint.empty()) text_ += " (" + p.hint + ")";
    }
}

}  // namespace extremal
