// SPDX-License-Identifier: GPL-3.0-or-later
/// One rule for each direction (quadrature/tensor.hpp).
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal::rules {

RuleEntry product() {
    RuleEntry e;
    e.item = {
        "product",
        "tensor product",
        "A rule in space times a rule in time, each with its own keys: {\"space\": {...}, \"time\": {...}}; "
        "over rectangles perhaps with another one along y, \"space_y\".",
        {},
        {},
        "a space of functions of space and time"};
    for (const char* direction : tensorParts)
        e.item.parameters.push_back(jsonField(direction, std::string("rule in ") + direction, direction,
                                              nullptr,
                                              std::string("The rule in ") + direction + ", with its keys."));
    e.item.parameters.insert(e.item.parameters.begin() + 1,
                             jsonField(acrossPart, "rule along y", "space_y", nullptr,
                                       "Over a rectangle: where it is not that of space."));
    e.place = 11;
    e.refusal = "a tensor product of rules integrates over space and time, and this space takes one rule";
    e.hint = "one rule, such as that of \"time\" alone, or auto";
    return e;
}

}  // namespace extremal::rules
