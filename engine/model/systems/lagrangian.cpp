/// Any system, given by its Lagrangian as a text: L(t, q, q_t) with named coordinates and parameters.
///
/// Differentiated symbolically, evaluated as a tape (engine/model/typed). Units are the user's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/core/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::systems {
namespace {

bool isAngle(const std::string& name) {
    constexpr std::array<std::string_view, 7> angles = {"theta", "phi",  "varphi", "psi",
                                                        "alpha", "beta", "gamma"};
    const std::string_view word = std::string_view(name).substr(0, name.find_first_of("_0123456789"));
    return std::find(angles.begin(), angles.end(), word) != angles.end();
}

/// Nothing is known of the coordinates but their names: angles are drawn as a chain of rods of length 1,
/// measured from the downward vertical; of others the first two as a point in the plane, or one on a line.
void drawChain(const double* x, std::size_t d, Drawing& drawing) {
    Point joint{0, 0, 0};
    drawing.shapes.push_back(Support{joint, 0.5});
    for (std::size_t i = 0; i < d; ++i) {
        const Point next{joint[0] + std::sin(x[i]), joint[1] - std::cos(x[i]), 0};
        drawing.shapes.push_back(Segment{joint, next, 2});
        drawing.shapes.push_back(Disc{next, 9});
        drawing.tracer = joint = next;
    }
}
void drawPoint(const double* x, std::size_t d, Drawing& drawing) {
    const Point at{x[0], d > 1 ? x[1] : 0, 0};
    drawing.shapes.push_back(Disc{{0, 0, 0}, 2, ShapeRole::scenery});
    if (d == 1) drawing.shapes.push_back(Segment{{0, 0, 0}, at, 2});
    drawing.shapes.push_back(Disc{at, 9});
    drawing.tracer = at;
}

System makeLagrangian(const Settings& settings) {
    const typed::Formula formula = typed::formulaOf(settings);
    typed::TypedMechanics made = typed::mechanicsOf(formula);
    System s;
    s.id = "lagrangian";
    for (const std::string& name : formula.coordinates)
        s.coordinates.push_back({name, name, typed::symbolOf(name), "", ""});
    s.kind = std::move(made.mechanics);
    const auto d = formula.coordinates.size();
    for (const int i : made.cyclic) {
        const auto k = static_cast<std::size_t>(i);
        s.momenta.push_back({formula.coordinates[k], "p_" + typed::symbolOf(formula.coordinates[k]), "",
                             [k](const double*, const double* p) { return p[k]; }});
    }
    const bool isChain = std::all_of(formula.coordinates.begin(), formula.coordinates.end(), isAngle);
    s.draw = [isChain, d](const double* x, Drawing& drawing) {
        isChain ? drawChain(x, d, drawing) : drawPoint(x, d, drawing);
    };
    const std::string& first = formula.coordinates[0];
    s.phaseX = "q." + first;
    s.phaseY = "p." + first;
    s.hasPlanarTrajectory = d > 1 && first == "x" && formula.coordinates[1] == "y";
    s.trajectoryX = s.hasPlanarTrajectory ? "q.x" : "t";
    s.trajectoryY = s.hasPlanarTrajectory ? "q.y" : "q." + first;
    return s;
}

void checkLagrangian(const Settings& settings, const System& system, const State& initial) {
    const auto fault = typed::faultAt(typed::formulaOf(settings), system.mechanics(), initial.t,
                                      initial.x.data(), initial.x.data() + system.dimension());
    if (fault) throw InvalidScene("/lagrangian", *fault);
}

std::vector<FieldInfo> lagrangianFields() {
    FieldInfo coordinates;
    coordinates.key = coordinates.title = "coordinates";
    coordinates.type = FieldType::names;
    coordinates.example = Value(Value::Array{"theta"});
    coordinates.description = "Names of the coordinates, at most 64; the velocity of x is x_t or dot(x).";
    FieldInfo parameters =
        constantsField("parameters", "Constants by name; they may be expressions in each other.");
    parameters.example = Value(Value::Object{{"m", 1}, {"l", 1}, {"g", 9.81}});
    FieldInfo lagrangian = textField(
        "lagrangian", "", nullptr,
        "L as an expression in coordinates, velocities, parameters and the time t; or an object of such "
        "terms by name, which are summed and may have rules of their own.");
    lagrangian.type = FieldType::terms;
    lagrangian.title = "Lagrangian";
    lagrangian.example = "m/2*l^2*theta_t^2 + m*g*l*cos(theta)";
    return {coordinates, parameters, lagrangian};
}

}  // namespace

ModelEntry lagrangian() {
    ModelEntry e;
    e.item = {"lagrangian",
              "typed Lagrangian",
              "Any system by its Lagrangian, typed as a formula and differentiated symbolically.",
              lagrangianFields(),
              {},
              ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 10;
    e.exampleStep = 0.05;
    e.make = makeLagrangian;
    e.checkInitial = checkLagrangian;
    return e;
}

}  // namespace extremal::systems
