// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that a user types.
#include "engine/space/catalog.hpp"
#include "engine/space/typed.hpp"

namespace extremal::spaces {

SpaceEntry typed() {
    FieldInfo functions = formulasField("functions", {"tau", "h"}, nullptr,
                                        "Functions of tau from 0 to 1 on a step, which span the space; they "
                                        "may name the length h of the step, "
                                        "parameters of the model, and names of \"let\".");
    functions.example = Value(Value::Array{"1", "tau", "tau^2"});
    FieldInfo let = definitionsField("let", {"tau", "h"},
                                     "Names for expressions, which functions and later names may use.");
    FieldInfo knots = formulasField("knots", {}, Value(Value::Array{}),
                                    "Where functions are not smooth: ascending, between 0 and 1.");
    SpaceEntry e;
    e.item = {"typed",
              "typed functions",
              "The span of functions of your own: differentiated, made well conditioned and tabulated in "
              "quadruple precision.",
              {functions, let, knots},
              {},
              ""};
    e.make = [](const Settings& settings) { return typedSpace(settings).space; };
    return e;
}

}  // namespace extremal::spaces
