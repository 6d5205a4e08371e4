// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/kkt_axes.hpp"

#include <string>

namespace extremal {
namespace {

/// "z₂": digits as subscripts.
std::string indexed(const char* letter, int k) {
    std::string text = letter;
    for (const char digit : std::to_string(k))
        text += std::string("₀₁₂₃₄₅₆₇₈₉").substr(static_cast<std::size_t>(3 * (digit - '0')), 3);
    return text;
}

}  // namespace

void nameBlocks(Figure& figure, const KktPattern& p) {
    for (const UnknownBlock& b : p.blocks) {
        const std::string name = indexed(b.isMultiplier ? "p" : "z", b.index);
        const double middle = b.offset + (b.size - 1) / 2.0;
        figure.x.ticks.push_back({middle, name});
        figure.y.ticks.push_back({p.size - 1 - middle, name});
    }
    figure.x.range = figure.y.range = {-1.0, static_cast<double>(p.size)};
}

}  // namespace extremal
