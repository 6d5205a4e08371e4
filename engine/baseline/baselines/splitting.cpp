// SPDX-License-Identifier: GPL-3.0-or-later
/// A splitting of the user's: a product of kicks and drifts by their fractions of the step.
#include "engine/baseline/parts.hpp"
#include "engine/baseline/splitting_baseline.hpp"
#include "engine/baseline/typed_tableau.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal::baselines {
namespace {

FieldInfo fractions(const char* key, const char* description, Value example) {
    FieldInfo f = formulasField(key, {}, nullptr, description);
    f.example = std::move(example);
    return f;
}

}  // namespace

BaselineEntry splitting() {
    BaselineEntry e;
    e.item = {"splitting",
              "typed splitting",
              "Kicks of p and drifts of q in turn, by fractions of your own; order and symmetry are found.",
              {fractions("kicks", "Fractions of the step of the kicks, which sum to 1.",
                         Value(Value::Array{"1/6", "2/3", "1/6"})),
               fractions("drifts", "Fractions of the step of the drifts, which sum to 1.",
                         Value(Value::Array{"1/2", "1/2"})),
               choiceField("first", "first", {"drift", "kick"},
                           "Which begins where there are as many of both; else those that are one more.")},
              Claims{},
              ""};
    e.takes = flowProblems().with<Wave, Interaction, Rotation>();
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        Claims claims = typedSplitting(settings)->claims;
        claims.conserves.emplace_back("norm");
        return claims;
    }});
    e.parts.set(
        OscillatorLimit([](const Settings& settings) { return typedSplitting(settings)->stabilityLimit; }));
    e.parts.set(BaselineTableau{[](const Settings& settings) { return typedSplitting(settings)->tableau; }});
    e.parts.set(
        KeyCheck{[](const Settings& settings, Findings& findings) { examine(settings, true, findings); }});
    e.make = [](const System& system, const BaselineOptions& options) {
        const auto typed = typedSplitting(options.settings);
        const Splitting& made = typed->splitting;
        if (system.parts.find<Wave>()) return makeWaveSplittingBaseline(system, options.step, made);
        const Mechanics<double> flow = flowOf(system);
        if (made.isNystrom && !flow.isSeparable)
            throw InvalidScene(
                "/baseline",
                "has its order for kinetic energies p^2/(2m) with constant masses alone, and " + system.id +
                    " has another one",
                "fractions that have their order for every T(p), or another scheme");
        if (!flow.isSum() && (!made.stages.front().isKick || made.stages.size() % 2 == 0))
            throw InvalidScene("/baseline",
                               "needs H = A(p) + B(q) here: kicks and drifts are not explicit for " +
                                   system.id +
                                   ", and only splittings that begin and end with a kick have another form",
                               "a splitting with one kick more than drifts, or another scheme");
        return makePartitioned(flow, options.step, partitionedStages(made, flow.isSum()));
    };
    return e;
}

}  // namespace extremal::baselines
