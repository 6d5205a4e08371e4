// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose spaces have more to leave out than a degree: modes, harmonics, moving nodes.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/core/set_key.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct SmallerSpace {
    Settings space;
    double share = 1;  ///< of the unknowns of the whole space that it keeps
};

/// Spaces with fewer functions, for a search of what a scene needs. Without it the degree is all that there
/// is to leave out.
struct SmallerSpaces {
    static constexpr PartInfo part{"smaller-spaces", "spaces with fewer functions", false};
    const char* knob = "";  ///< what is left out, as a name among the knobs of a search: "modes"
    /// From the largest down, at most 20; empty: nothing can be left out.
    std::vector<SmallerSpace> (*of)(const Settings& space, const Settings& model) = nullptr;
    /// What such a space has, in words: "48 modes".
    std::string (*text)(const Settings& space) = nullptr;
    /// Each of them is a part of the one before it, so that what fails in one fails in the next.
    bool areNested = true;
};

/// With the whole number `key` at 4/5 of `whole`, at 4/5 of that and so on, rounded to multiples of
/// `multiple`, eight times or down to `least`.
inline std::vector<SmallerSpace> thinnedSpaces(const Settings& space, const char* key, int whole, int least,
                                               int multiple) {
    constexpr int most = 8;
    constexpr double part = 0.8;
    std::vector<SmallerSpace> all;
    for (int count = whole; static_cast<int>(all.size()) < most;) {
        count = static_cast<int>(std::floor(part * count / multiple)) * multiple;
        if (count < least) break;
        SmallerSpace smaller{space, static_cast<double>(count) / whole};
        setKey(smaller.space, key, static_cast<double>(count));
        all.push_back(std::move(smaller));
    }
    return all;
}

/// "48 modes".
inline std::string textOfModes(const Settings& space) {
    return std::to_string(space.integer("modes")) + " modes";
}

}  // namespace extremal
