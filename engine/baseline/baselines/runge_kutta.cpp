// SPDX-License-Identifier: GPL-3.0-or-later
/// A Runge-Kutta method of the user's, plain or partitioned, by its table.
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/baseline/table_method.hpp"
#include "engine/baseline/typed_tableau.hpp"
#include "engine/model/spins/spins.hpp"

namespace extremal::baselines {
namespace {

FieldInfo table(const char* key, const char* title, const char* description) {
    FieldInfo f = jsonField(key, title, key, nullptr, description);
    return f;
}
FieldInfo optional(FieldInfo f) {
    f.isOptional = true;
    return f;
}

}  // namespace

BaselineEntry runge_kutta() {
    FieldInfo a = table("a", "table",
                        "Coefficients a_ij: one row per stage, numbers or expressions; a row may end "
                        "with its last entry that is not 0.");
    FieldInfo b = table("b", "weights", "Weights b_i, which sum to 1.");
    a.example =
        Value(Value::Array{Value::Array{}, Value::Array{"1/2"}, Value::Array{-1, 2}});  // Kutta, order 3
    b.example = Value(Value::Array{"1/6", "2/3", "1/6"});
    BaselineEntry e;
    e.item = {
        "runge-kutta",
        "typed Runge-Kutta method",
        "A table of your own, explicit or implicit, with a second one for p if you like; order, symmetry and "
        "symplecticity are found.",
        {a, b, optional(table("c", "nodes", "Nodes c_i; by default the sums of the rows.")),
         optional(table("a_hat", "table of p", "The table of p, where it is another one.")),
         optional(table("b_hat", "weights of p", "The weights of p; by default b."))},
        Claims{},
        ""};
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) { return typedRungeKutta(settings)->claims; }});
    e.parts.set(
        OscillatorLimit([](const Settings& settings) { return typedRungeKutta(settings)->stabilityLimit; }));
    e.parts.set(BaselineTableau{[](const Settings& settings) { return typedRungeKutta(settings)->tableau; }});
    e.parts.set(
        KeyCheck{[](const Settings& settings, Findings& findings) { examine(settings, false, findings); }});
    e.takes = flowProblems().with<Spins>();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeTableMethod(flowOf(system), options.step, *typedRungeKutta(options.settings)->tableau);
    };
    return e;
}

}  // namespace extremal::baselines
