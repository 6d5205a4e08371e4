// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/kkt_axes.hpp"

#include <string>

namespace extremal {
namespace {

/// "z₂": digits as subscripts.
std::string indexed(const std::string& name) {
    std::string text;
    for (const char c : name) {
        if (c >= '0' && c <= '9')
            text += std::string("₀₁₂₃₄₅₆₇₈₉").substr(static_cast<std::size_t>(3 * (c - '0')), 3);
        else
            text += c;
    }
    return text;
}

std::string usualName(const UnknownBlock& b, int) {
    return (b.isMultiplier ? "p" : "z") + std::to_string(b.index);
}

}  // namespace

void nameBlocks(Figure& figure, const KktPattern& p,
                std::string (*nameOf)(const UnknownBlock&, int elements)) {
    for (const UnknownBlock& b : p.blocks) {
        const std::string name = indexed((nameOf ? nameOf : usualName)(b, p.elements));
        const double middle = b.offset + (b.size - 1) / 2.0;
        figure.x.ticks.push_back({middle, name});
        figure.y.ticks.push_back({p.size - 1 - middle, name});
    }
    figure.x.range = figure.y.range = {-1.0, static_cast<double>(p.size)};
}

}  // namespace extremal
