/// A scalar field in one dimension, u_tt = c^2 u_xx - W'(u): wave, Klein-Gordon, sine-Gordon, phi-4 equation,
/// or a typed potential, on a periodic domain, between fixed values, or with free ends.
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/field/profile.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> fieldParameters() {
    FieldInfo domain = numbers("domain", "domain", "", {"left", "right"}, Value::Array{-20.0, 20.0},
                               "Ends of the interval.");
    return {
        positive("wave_speed", "wave speed", "", 1, "c of u_tt = c² u_xx - W'(u)."),
        textField("potential", "W", Value("none"),
                  "W(u): none, klein-gordon (mass² u²/2), sine-gordon (1 - cos u), phi4 ((u² - 1)²/4), or "
                  "an expression in u and mass."),
        notNegative("mass", "mass", "", 1, "m of the Klein-Gordon equation, and a name in W(u)."),
        domain,
        choiceField("boundary", "boundary", {"periodic", "dirichlet", "neumann"},
                    "What holds at the ends: periodic, dirichlet: the values stay as they are at the "
                    "start, neumann: nothing acts on them."),
        integerField("cells", "N", 2, 4e6, 200, "Number of elements of schemes that do not say theirs.")};
}

double amplitudeOf(const FieldPotential& potential) {
    return potential.kind() == FieldPotential::Kind::sineGordon ? 2 * std::numbers::pi
           : potential.kind() == FieldPotential::Kind::phi4     ? 1.5
                                                                : 1;
}

System makeField(const Settings& settings) {
    const std::vector<double> ends = settings.numbers("domain");
    if (!(ends[1] > ends[0]))
        throw InvalidScene("/domain", "must go from left to right, got " + formatNumber(ends[0]) + " to " +
                                          formatNumber(ends[1]));
    auto problem = std::make_shared<FieldProblem>();
    problem->mesh = uniformMesh(ends[0], ends[1] - ends[0], settings.integer("cells"),
                                boundaryNamed(settings.text("boundary")));
    // Schemes with higher elements ask for their own nodes.
    problem->nodes = FieldNodes(problem->mesh, std::max(1, settings.integer(elementDegreeKey)));
    const double c = settings.number("wave_speed");
    problem->elastic.k = c * c;
    problem->potential = FieldPotential(settings.text("potential"), settings.number("mass"), "/potential");
    System s = makeFieldSystem(problem, amplitudeOf(problem->potential));
    s.id = "field";
    return s;
}

}  // namespace

ModelEntry field() {
    ModelEntry e;
    e.item = {"field",
              "scalar field",
              "A field in one dimension: wave, Klein-Gordon, sine-Gordon, phi-4 or typed potential.",
              fieldParameters(),
              {},
              ""};
    e.initial = fieldStartFields();
    e.exampleInitial = {{"u", "exp(-x^2)"}};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = makeField;
    return e;
}

}  // namespace extremal::systems
