// SPDX-License-Identifier: GPL-3.0-or-later
/// An elastic bar of unit length, density and modulus: L = integral of u_t^2 / 2 - w(u_X), u the displacement
/// of the material point X. On uniform, graded and notched meshes: what asynchronous schemes are for.
#include <memory>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/field/profile.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> barParameters() {
    FieldInfo ratio =
        numberField("ratio", "ratio", "", 50,
                    "Of a graded mesh: size of the largest element over the smallest; of a notch: "
                    "size of the others over its own.");
    ratio.min = 1;
    return {integerField("cells", "N", 2, 1e6, 100, "Number of elements."),
            choiceField("grading", "grading", {"uniform", "geometric", "notch"},
                        "Sizes of the elements: equal, growing geometrically from the middle to the ends, or "
                        "equal but for a notch of small ones in the middle."),
            ratio,
            integerField("notch", "", 1, 1e5, 10, "Number of small elements in a notch."),
            choiceField(
                "material", "material", {"linear", "fput", "neo-hookean"},
                "Energy of the strain e: e²/2, e²/2 + e³/6 + e⁴/4, or (l² - 1 - 2 ln l)/4 with l = 1 + e."),
            choiceField("boundary", "boundary", {"dirichlet", "neumann", "periodic"},
                        "dirichlet: the ends are held; neumann: they are free.")};
}

/// The keys of a bar are those of a field under other names.
Settings asField(const Settings& initial) {
    Settings field;
    for (const auto& [key, value] : initial.keys) {
        const bool isText = value.isString();
        const Value own = isText ? Value(withNameReplaced(value.asString(), "X", "x")) : value;
        field.keys.emplace_back(key == "displacement" ? "u" : key == "velocity" ? "u_t" : key, own);
    }
    if (!field.find("values") && !field.find("u")) field.keys.emplace_back("u", "0");
    return field;
}

/// Names of the user's keys in what is thrown.
template <class Call>
auto inItsWords(Call&& call) {
    try {
        return call();
    } catch (const InvalidScene& e) {
        std::vector<Problem> problems = e.problems();
        for (Problem& p : problems) {
            if (p.pointer == "/u") p.pointer = "/displacement";
            if (p.pointer == "/u_t") p.pointer = "/velocity";
        }
        throw InvalidScene(std::move(problems));
    }
}

System makeBar(const Settings& settings) {
    const int N = settings.integer("cells"), notch = settings.integer("notch");
    const double ratio = settings.number("ratio");
    const Boundary boundary = boundaryNamed(settings.text("boundary"));
    const std::string grading = settings.text("grading");
    if (grading == "notch" && notch >= N)
        throw InvalidScene("/notch", "must be less than the number of cells, got " + std::to_string(notch));
    auto problem = std::make_shared<FieldProblem>();
    problem->mesh = grading == "geometric" ? gradedMesh(0, 1, N, ratio, boundary)
                    : grading == "notch"   ? notchedMesh(0, 1, N, notch, ratio, boundary)
                                           : uniformMesh(0, 1, N, boundary);
    problem->nodes = FieldNodes(problem->mesh, std::max(1, settings.integer(elementDegreeKey)));
    problem->isBody = true;
    problem->elastic.material = materialNamed(settings.text("material"));
    System s = makeFieldSystem(problem, 0.05);
    s.id = "elastic-bar";
    s.start = [start = s.start](const Settings& initial, double t) {
        return inItsWords([&] { return start(asField(initial), t); });
    };
    s.exactFrom = [exact = s.exactFrom](const Settings& initial, const State& start) {
        return inItsWords([&] { return exact(asField(initial), start); });
    };
    s.givesLevels = {};
    return s;
}

std::vector<FieldInfo> barStartFields() {
    return {
        optionalJsonField("displacement", "displacement", "u at the start, an expression in X from 0 to 1."),
        optionalJsonField("velocity", "velocity", "u_t at the start, an expression in X; default 0."),
        optionalJsonField("values", "values",
                          "u and u_t at the nodes, two arrays; with the array x at these places.")};
}

}  // namespace

ModelEntry elastic_bar() {
    ModelEntry e;
    e.item = {"elastic-bar",
              "elastic bar",
              "A bar of unit length, density and modulus on uniform, graded and notched meshes.",
              barParameters(),
              {},
              ""};
    e.initial = barStartFields();
    e.exampleInitial = {{"displacement", "0.005*sin(pi*X)"}};
    e.exampleEnd = 10;
    e.exampleStep = 0.001;
    e.make = makeBar;
    return e;
}

}  // namespace extremal::systems
