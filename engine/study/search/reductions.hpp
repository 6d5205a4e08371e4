// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scheme can do without: a smaller degree, fewer nodes, equations that are solved to round-off.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// The degree of a space, the nodes of its rule, its elements, the tolerance of its solver, the key of the
/// space that its steps are proportional to, as a Courant number, and which of its smaller spaces it is
/// (SmallerSpaces), from 1 on; 0: not changed.
struct Reduction {
    int degree = 0, nodes = 0, cells = 0;
    double solver = 0, stepFactor = 0;
    int smaller = 0;
    explicit operator bool() const {
        return degree > 0 || cells > 0 || solver > 0 || stepFactor > 0 || smaller > 0;
    }
    bool operator==(const Reduction&) const = default;
};

/// The present ones of a scheme whose space has one degree for all and whose rule has nodes; else none.
Reduction richnessOf(const ResolvedScheme& scheme);

/// The elements of a scheme whose space may have any number of them; 0: it has none.
int cellsOf(const ResolvedScheme& scheme, const ResolvedScene& scene);

/// The number in its space that the steps of a scheme are proportional to (StepOfSpace); 0: where they are
/// proportional to no number.
double stepFactorOf(const ResolvedScheme& scheme, const ResolvedScene& scene);

/// The scheme with another degree and number of nodes; itself where nothing is reduced. Throws
/// InvalidScene where there is no such scheme.
ResolvedScheme reduced(const ResolvedScheme& scheme, const Reduction& to, const ResolvedScene& scene);

/// Smaller ones that exist, the largest degree first: each degree with as many more nodes than degrees as the
/// scheme has, and with fewer.
std::vector<Reduction> reductionsOf(const ResolvedScheme& scheme, const ResolvedScene& scene);

/// Those of a scheme, as it is reduced already, that have fewer functions besides, and the share of the
/// unknowns that each keeps; of what the family leaves out by itself (SmallerSpaces).
struct SmallerReduction {
    Reduction reduction;
    double share = 1;
};
std::vector<SmallerReduction> smallerReductionsOf(const ResolvedScheme& scheme, const Reduction& reduction,
                                                  const ResolvedScene& scene);

/// Whether each of them is a part of the one before it.
bool areSmallerNested(const ResolvedScheme& scheme);

/// What is left of a scheme in words: "48 modes"; empty where its space is the whole one.
std::string textOfSmaller(const ResolvedScheme& scheme, const Reduction& reduction,
                          const ResolvedScene& scene);

}  // namespace extremal
