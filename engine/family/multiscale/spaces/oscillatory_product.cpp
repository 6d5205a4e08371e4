/// The printed multiscale space: a slow polynomial times one oscillation. For teaching: it fails.
#include "engine/space/catalog.hpp"
#include "engine/family/multiscale/basis.hpp"

namespace extremal::spaces {
namespace {

FieldInfo optionalJson(const char* key, const char* title, const char* symbol, const char* description) {
    FieldInfo f = jsonField(key, title, symbol, {}, description);
    f.isOptional = true;
    return f;
}

}  // namespace

SpaceEntry oscillatory_product() {
    FieldInfo omega = jsonField(
        "omega", "frequency", "ω", "model",
        "Frequency of the fast motion, or where it starts from: a number or expression, or \"model\".");
    omega.choices = {"model"};
    SpaceEntry e;
    e.item = {
        "oscillatory-product",
        "product form",
        "A slow polynomial times 1 + alpha sin wt + beta cos wt, as printed. Experimental: steps soon have "
        "no solution.",
        {omega, integerField("degree", "n", 1, OscillatoryBasis::mostDegree, 4.0, "Degree of the slow part."),
         choiceField("frequency", "frequency is", {"fixed", "free"},
                     "Whether each coordinate has its frequency as an unknown."),
         optionalJson("fast", "fast coordinates", "", "degree of the coordinates the model calls fast."),
         optionalJson("variables", "variables", "", "degree of single coordinates, by name.")},
        {},
        ""};
    e.make = [](const Settings& settings) {
        return oscillatorySpace(OscillatoryBasis(settings.integer("degree"), {}), {0, 0});
    };
    return e;
}

}  // namespace extremal::spaces
