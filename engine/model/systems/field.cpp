// SPDX-License-Identifier: GPL-3.0-or-later
/// A scalar field in one dimension, u_tt = c^2 (a(x/epsilon) u_x)_x - W'(u): wave, Klein-Gordon, sine-Gordon,
/// phi-4 equation, or a typed potential, on a periodic domain, between fixed values, or with free ends; or a
/// field with any typed Lagrangian density.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/density/density_system.hpp"
#include "engine/model/density/places.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/field/moving_field.hpp"
#include "engine/model/field/profile.hpp"
#include "engine/model/plane_field/plane_field_system.hpp"
#include "engine/model/plane_field/settings.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> fieldParameters() {
    FieldInfo domain = numbers("domain", "domain", "", {"left", "right"}, Value::Array{-20.0, 20.0},
                               "Ends of the interval.");
    return {
        positive("wave_speed", "wave speed", "", 1, "c of u_tt = c² (a u_x)_x - W'(u)."),
        componentNamesField(),
        waveSpeedsField(),
        textField("a", "a", Value("1"),
                  "a(s) > 0 of a medium, an expression in s = x/epsilon, and its period 1; of a homogeneous "
                  "one 1."),
        positive("epsilon", "epsilon", "", 0.05, "Period of the medium in x."),
        textField(
            "potential", "W", Value("none"),
            "W(u): none, klein-gordon (mass² u²/2), sine-gordon (1 - cos u), phi4 ((u² - 1)²/4), of two "
            "components klein-gordon-complex or q-ball, or an expression in the components and mass."),
        notNegative("mass", "mass", "", 1, "m of the Klein-Gordon equation, and a name in W(u)."),
        densityField("\"-sqrt(1 - u_t^2 + u_x^2)\""),
        densityParametersField(),
        densityPlacesField(false),
        domain,
        choiceField("boundary", "boundary", {"periodic", "dirichlet", "neumann"},
                    "What holds at the ends: periodic, dirichlet: the values stay as they are at the "
                    "start, neumann: nothing acts on them."),
        integerField("cells", "N", 2, 1e6, 200, "Number of elements of schemes that do not say theirs.")};
}

/// a(x/epsilon); empty: 1. Throws where it is not positive.
MediumCoefficient mediumOf(const Settings& settings) {
    const std::string text = settings.find("a") ? settings.text("a") : "1";
    if (text == "1") return {};
    const auto a = std::make_shared<const typed::TypedFunction>(
        text, "/a", std::vector<std::string>{"s"}, std::vector<std::pair<std::string, double>>{});
    constexpr int samples = 1000;
    for (int i = 0; i < samples; ++i) {
        const double s = static_cast<double>(i) / samples;
        if (const double value = (*a)(&s); !(value > 0) || !std::isfinite(value))
            throw InvalidScene(
                "/a", "must be positive, and is " + formatNumber(value, 3) + " at s = " + formatNumber(s),
                "1 + 0.5*sin(2*pi*s)");
    }
    return [a, epsilon = settings.number("epsilon")](double x) {
        const double s = x / epsilon;
        return (*a)(&s);
    };
}

/// The functions that the elements of a scheme have in place of linear ones, or null.
std::shared_ptr<const ElementFunctions> functionsOf(const Settings& settings, const FieldProblem& problem) {
    constexpr int perPeriod = 32, mostParts = 512;
    if (!settings.find(elementFunctionsKey)) return {};
    const MediumCoefficient a = problem.coefficient ? problem.coefficient : [](double) { return 1.0; };
    int parts = settings.integer(elementPartsKey);
    if (parts == 0)
        parts = static_cast<int>(std::min<double>(
            mostParts,
            std::ceil(perPeriod * std::max(1.0, problem.mesh.size(0) / settings.number("epsilon")))));
    return std::make_shared<const ElementFunctions>(
        settings.text(elementFunctionsKey) == "snapshots"
            ? snapshotFunctions(problem.mesh, a, problem.speed(), parts)
            : cellFunctions(problem.mesh, a, parts));
}

double amplitudeOf(const FieldPotential& potential) {
    return potential.kind() == FieldPotential::Kind::sineGordon ? 2 * std::numbers::pi
           : potential.kind() == FieldPotential::Kind::phi4     ? 1.5
                                                                : 1;
}

/// Several components, which only periodic domains have: a row of a rectangle.
System makeRow(const Settings& settings, const wave::Domain& domain) {
    constexpr int fewest = 4;
    if (settings.text("boundary") != "periodic")
        throw InvalidScene("/boundary",
                           "must be periodic for a field with components, got " + settings.text("boundary"),
                           "periodic");
    if (settings.text("a") != "1")
        throw InvalidScene("/a", "must be 1 for a field with components", "1, and wave_speeds");
    const int cells = settings.integer("cells");
    if (cells < fewest || cells > wave::mostPlaces)
        throw InvalidScene("/cells", "must be from 4 to " + std::to_string(wave::mostPlaces) +
                                         " for a field with components, got " + std::to_string(cells));
    System s = makePlaneFieldSystem(
        std::make_shared<const PlaneFieldProblem>(planeFieldOf(settings, wave::Grid{domain, cells})));
    s.id = "field";
    return s;
}

/// A field with the density of these settings.
std::shared_ptr<const DensityProblem> densityProblem(const Settings& settings) {
    const std::vector<double> ends = settings.numbers("domain");
    const std::vector<std::string> names = componentNames(settings);
    DensityProblem problem{names, FieldDensity(settings, names, 1)};
    problem.along = {ends[0], ends[1] - ends[0]};
    problem.cellsX = settings.integer("cells");
    problem.boundary = boundaryNamed(settings.text("boundary"));
    readPlaces(settings, problem);
    return std::make_shared<const DensityProblem>(std::move(problem));
}

System makeUsualField(const Settings& settings) {
    const std::vector<double> ends = settings.numbers("domain");
    if (componentNames(settings) != std::vector<std::string>{"u"})
        return makeRow(settings, {ends[0], ends[1] - ends[0]});
    if (const Value* const speeds = settings.find("wave_speeds"); speeds && !speeds->isNull())
        throw InvalidScene("/wave_speeds", "is for a field with several components", "wave_speed");
    auto problem = std::make_shared<FieldProblem>();
    const int movingNodes = settings.integer(movingNodesKey);
    problem->hasMovingNodes = movingNodes > 0;
    problem->mesh =
        uniformMesh(ends[0], ends[1] - ends[0], movingNodes > 0 ? movingNodes + 1 : settings.integer("cells"),
                    boundaryNamed(settings.text("boundary")));
    // Schemes with higher elements ask for their own nodes.
    problem->nodes = FieldNodes(problem->mesh, std::max(1, settings.integer(elementDegreeKey)));
    problem->isTrigonometric = settings.flag(trigonometricKey);
    const double c = settings.number("wave_speed");
    problem->elastic.k = c * c;
    problem->coefficient = mediumOf(settings);
    problem->functions = functionsOf(settings, *problem);
    problem->potential = FieldPotential(settings.text("potential"), settings.number("mass"), "/potential");
    const double amplitude = amplitudeOf(problem->potential);
    System s =
        problem->hasMovingNodes ? makeMovingField(problem, amplitude) : makeFieldSystem(problem, amplitude);
    s.id = "field";
    return s;
}

System makeField(const Settings& settings) {
    const std::vector<double> ends = settings.numbers("domain");
    if (!(ends[1] > ends[0]))
        throw InvalidScene("/domain", "must go from left to right, got " + formatNumber(ends[0]) + " to " +
                                          formatNumber(ends[1]));
    if (!hasDensity(settings)) {
        refusePlaces(settings);
        return makeUsualField(settings);
    }
    refuseKeysBesideDensity(settings);
    const auto problem = densityProblem(settings);
    const auto& usual = problem->density.usual();
    const bool isRow = problem->components() > 1;
    // Of several components the usual field is a periodic row.
    if (!usual || (isRow && !problem->isPeriodic())) {
        System s = makeDensitySystem(problem);
        s.id = "field";
        return s;
    }
    System s = makeUsualField(withPotential(settings, *usual));
    const auto* const line = s.parts.find<ScalarField>();
    if (!line || (!line->problem->hasMovingNodes && line->problem->nodes.degree == 1))
        s.parts.set(TypedDensity{problem});
    return s;
}

/// Of a density that no potential stands for.
void checkField(const Settings&, const System& system, const State& initial) {
    if (const auto* const own = system.parts.find<DensityField>()) checkDensityStart(*own->problem, initial);
}

}  // namespace

ModelEntry field() {
    ModelEntry e;
    e.item = {"field",
              "field",
              "A field in one dimension, of one component or more: wave, Klein-Gordon, sine-Gordon, phi-4 or "
              "typed potential, or any typed Lagrangian density.",
              fieldParameters(),
              {},
              ""};
    e.initial = fieldStartFields();
    e.exampleInitial = {{"u", "exp(-x^2)"}};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = makeField;
    e.checkInitial = checkField;
    return e;
}

}  // namespace extremal::systems
