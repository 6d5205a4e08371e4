// SPDX-License-Identifier: GPL-3.0-or-later
/// The multisymplectic form formula of a scheme of fields: the sum over the boundary of a patch of space and
/// time, relative to its terms. It is 0 to round-off for every scheme that follows from a discrete action.
#include <cmath>
#include <optional>

#include "engine/family/family.hpp"
#include "engine/family/parts/own_measures.hpp"
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry multisymplectic() {
    ObservableEntry e;
    e.item = {
        "multisymplectic",
        "multisymplectic form",
        "Sum of the multisymplectic form over the boundary of a patch (half of the elements, all steps so "
        "far), relative to its terms; 0 to round-off. Costs two linearised solutions.",
        {},
        {},
        "a field"};
    e.takes = Takes::only<ScalarField>();
    e.bind = [](const ObserveContext& context) {
        const auto* const own =
            context.discretization ? familyPart<OwnMeasures>(context.discretization->space) : nullptr;
        std::optional<Measure> measure;
        if (own) measure = own->of("multisymplectic", context.system, *context.discretization, context.step);
        if (measure) return bindMeasure(*measure, context.initial);
        Observer o;  // of a baseline, which no discrete action defines
        o.columns = {{"multisymplectic", "Σ Ω / Σ |Ω|", "", {}, {}}};
        o.evaluate = [](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i) values[i * stride] = std::nan("");
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
