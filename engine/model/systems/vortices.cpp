// SPDX-License-Identifier: GPL-3.0-or-later
/// Point vortices of an ideal fluid on the sphere of radius 1:
///     x_i' = (1/4 pi) sum_j G_j x_j x x_i / (1 - x_i . x_j),   H = -(1/4 pi) sum_{i<j} G_i G_j log(1 - x_i .
///     x_j),
/// spins with the strengths as weights (Bogomolov 1977).
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/spins/spin_system.hpp"

namespace extremal::systems {
namespace {

constexpr std::size_t mostVortices = 200;

SpinModel modelOfVortices(const Settings& settings) {
    SpinModel model;
    model.weights = extremal::spins::weightsOf(*settings.find("strengths"), "/strengths");
    if (model.weights.size() < 2 || model.weights.size() > mostVortices)
        throw InvalidScene("/strengths", "has " + std::to_string(model.weights.size()) + " numbers",
                           "2 to " + std::to_string(mostVortices) + " vortices");
    model.pair = std::make_shared<const typed::TypedFunction>(
        "-log(1 - a1*b1 - a2*b2 - a3*b3)/(4*pi)", "/strengths",
        std::vector<std::string>{"a1", "a2", "a3", "b1", "b2", "b3"},
        std::vector<std::pair<std::string, double>>{});
    for (int i = 0; i < model.count(); ++i)
        for (int j = i + 1; j < model.count(); ++j)
            model.bonds.push_back(
                {i, j,
                 model.weights[static_cast<std::size_t>(i)] * model.weights[static_cast<std::size_t>(j)]});
    return model;
}

void checkApart(const Settings&, const System& system, const State& initial) {
    const SpinModel& model = *system.part<Spins>().model;
    std::vector<double> s(3 * static_cast<std::size_t>(model.count()));
    extremal::spins::spinsOf(model, initial.x.data(), initial.x.data() + 2 * model.count(), s.data());
    for (const SpinModel::Bond& bond : model.bonds) {
        const double* const a = s.data() + 3 * bond.i;
        const double* const b = s.data() + 3 * bond.j;
        if (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 1 - 1e-12)
            throw InvalidScene("/strengths",
                               "has vortices " + std::to_string(bond.i + 1) + " and " +
                                   std::to_string(bond.j + 1) + " at one place at the start",
                               "another start: two vortices at one place have no motion");
    }
}

}  // namespace

ModelEntry vortices() {
    ModelEntry e;
    const FieldInfo strengths =
        jsonField("strengths", "strengths", "Γ", Value(Value::Array{1, 1, -1}),
                  "Circulation of each vortex, positive counterclockwise as seen from outside.");
    e.item = {"vortices",
              "point vortices",
              "Point vortices of an ideal fluid on the sphere, which carry each other around.",
              {choiceField("surface", "surface", {"sphere"}, "Where the fluid is."), strengths},
              {},
              ""};
    e.initial = {extremal::spins::startField("vortices")};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = [](const Settings& settings) {
        return extremal::spins::systemOf("vortices", modelOfVortices(settings),
                                         extremal::spins::SpinPicture::points);
    };
    e.checkInitial = checkApart;
    return e;
}

}  // namespace extremal::systems
