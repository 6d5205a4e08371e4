// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/view/parameter_map.hpp"

namespace extremal {
namespace {

FieldInfo optional(FieldInfo field) {
    field.isOptional = true;
    return field;
}

}  // namespace

const std::vector<FieldInfo>& mapFields() {
    static const std::vector<FieldInfo> all = [] {
        FieldInfo parameter = optional(textField("parameter", "", {},
                                                 "The parameter of the model that varies; by default the one "
                                                 "that sets its fast frequency."));
        FieldInfo from = optional(
            positive("from", "from", "", 0, "Its smallest value, by default a thousandth of the model's."));
        FieldInfo to = optional(
            positive("to", "to", "", 0, "Its largest value, by default a thousand times the model's."));
        from.fallback = to.fallback = {};
        FieldInfo steps = optional(
            numbers("steps", "steps", "", {"smallest", "largest"}, {},
                    "The range of the step, by default one decade beyond the steps of the schemes."));
        steps.min = 0;
        steps.isMinExcluded = true;
        FieldInfo cells = numbers("cells", "cells", "", {"columns", "rows"}, Value::Array{25, 20},
                                  "Numbers of values and of steps, spaced logarithmically.");
        cells.min = 2;
        cells.max = 400;
        FieldInfo duration =
            optional(positive("duration", "duration", "", 0,
                              "Length of each run, by default the "
                              "time span of the scene, or less if that would take many steps."));
        duration.fallback = {};
        FieldInfo value = textField("value", "", "energy_error",
                                    "The column of an observable whose largest absolute value is shown.");
        return std::vector<FieldInfo>{parameter, from, to, steps, cells, duration, value};
    }();
    return all;
}

}  // namespace extremal
