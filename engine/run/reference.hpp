/// The solution that errors are measured against, and how good it is itself.
///
/// exact: the model's own; computed: Gauss collocation of degree 12 at a step refined until two of them
/// agree, evaluated on its dense output; scheme: a scheme of the user's choice; file: rows of a CSV,
/// known only at their times.
#pragma once

#include <functional>
#include <stop_token>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

struct Reference {
    ReferenceInfo info;
    /// Makes a solution for one run: each keeps its own place in time. Empty where there is no reference. At
    /// times it does not know it gives NaN.
    std::function<ExactSolution()> make;
};

/// The reference as a scheme on a mesh of its own sees it: the exact solution at its nodes, else none.
Reference referenceFor(const Reference& reference, const ResolvedScene& resolved,
                       const ResolvedScheme& scheme);

/// Prepares the reference a scene asks for. Takes time for computed ones; gives up with kind none when
/// stopped. Throws InvalidScene for a file that cannot be used.
Reference makeReference(const ResolvedScene& resolved, const std::stop_token& stop);

/// Makes all solutions of a computed reference readers of one, at the nodes of the scene's schemes, where
/// memory allows.
void shareReference(Reference& reference, const ResolvedScene& resolved);

}  // namespace extremal
