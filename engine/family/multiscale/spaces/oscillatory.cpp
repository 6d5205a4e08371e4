/// A slow polynomial and harmonics of a fast frequency with polynomial amplitudes; each coordinate its own.
#include "engine/space/catalog.hpp"
#include "engine/family/multiscale/basis.hpp"

namespace extremal::spaces {
namespace {

FieldInfo json(const char* key, const char* title, const char* symbol, Value fallback,
               const char* description) {
    FieldInfo f = jsonField(key, title, symbol, std::move(fallback), description);
    f.isOptional = f.fallback.isNull();
    return f;
}

FieldInfo omega() {
    FieldInfo f = json("omega", "frequency", "ω", "model",
                       "Frequency of the fast motion: a number or expression, two of them in an array, "
                       "\"model\" (what the model "
                       "says), or \"estimate\" (from a short resolved run).");
    f.choices = {"model", "estimate"};
    return f;
}

FieldInfo slowDegree() {
    FieldInfo f =
        integerField("degree", "n", 1, OscillatoryBasis::mostDegree, 4.0, "Degree of the slow part.");
    f.whyLimits =
        "a slow part of degree 0 stands still; above 24 more steps are cheaper than a higher degree";
    return f;
}

}  // namespace

SpaceEntry oscillatory() {
    SpaceEntry e;
    e.item = {
        "oscillatory",
        "oscillatory",
        "A slow polynomial and harmonics of a fast frequency with polynomial amplitudes: steps of many fast "
        "periods.",
        {omega(), slowDegree(),
         json("harmonics", "harmonics", "m", Value::Array{1.0},
              "Degree of the amplitudes of the first harmonic, of the second, ... of each frequency; with "
              "two frequencies "
              "{ of, degree } is a combination, such as [1, -1]."),
         json("fast", "fast coordinates", "", {},
              "degree and harmonics of the coordinates the model calls fast."),
         json("variables", "variables", "", {}, "degree and harmonics of single coordinates, by name.")},
        {},
        ""};
    e.make = [](const Settings& settings) {
        return oscillatorySpace({settings.integer("degree"), {}}, {0, 0});
    };
    return e;
}

}  // namespace extremal::spaces
