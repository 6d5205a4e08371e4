// SPDX-License-Identifier: GPL-3.0-or-later
/// Splines: piecewise polynomials of one degree within each step.
#include "engine/space/catalog.hpp"
#include "engine/space/spline.hpp"
#include "engine/space/typed.hpp"

namespace extremal::spaces {
namespace {

FieldInfo count(const char* key, const char* symbol, double max, Value fallback, const char* description,
                const char* whyLimits) {
    FieldInfo f = integerField(key, symbol, 1, max, std::move(fallback), description);
    f.whyLimits = whyLimits;
    return f;
}

FieldInfo knots() {
    FieldInfo f = formulasField("knots", {}, nullptr,
                                "Where cells meet, in place of equal ones: ascending, between 0 and 1.");
    f.isOptional = true;
    return f;
}

}  // namespace

SpaceEntry spline() {
    SpaceEntry e;
    e.item = {
        "spline",
        "spline",
        "B-splines in time: s - 1 times differentiable inside each step, continuous from step to step.",
        {count("degree", "s", 24, nullptr, "Degree of the pieces.",
               "a curve of degree 0 stands still; above 24 more steps are cheaper than a higher degree"),
         count("cells", "n", 64, 2.0, "Number of equal cells in one step; one cell: polynomials.",
               "more cells than that are better taken as more steps"),
         knots()},
        {},
        ""};
    e.make = [](const Settings& settings) {
        if (const Value* given = settings.find("knots"); given && given->isArray())
            return splineSpace(settings.integer("degree"), cellsOf(settings));
        return splineSpace<double>(settings.integer("degree"), settings.integer("cells"));
    };
    return e;
}

}  // namespace extremal::spaces
