// SPDX-License-Identifier: GPL-3.0-or-later
/// A space for each coordinate. Its table depends on the system: it is made by the family
/// (family/galerkin/split.hpp).
#include "engine/core/problem.hpp"
#include "engine/space/catalog.hpp"

namespace extremal::spaces {

SpaceEntry by_coordinate() {
    SpaceEntry e;
    FieldInfo otherwise =
        jsonField("otherwise", "other coordinates", "", nullptr,
                  "The space of the coordinates that have none of their own, with its keys.");
    otherwise.example = Value(Value::Object{{"type", "polynomial"}, {"degree", 1.0}});
    FieldInfo variables = jsonField("variables", "coordinates", "", Value(Value::Object{}),
                                    "Spaces by the names of coordinates: fast ones with more cells.");
    e.item = {"by-coordinate",
              "a space per coordinate",
              "Multirate: a space for each coordinate, such as more cells for a fast one.",
              {otherwise, variables},
              {},
              ""};
    e.make = [](const Settings&) -> Space<double> {
        throw InvalidScene("/space", "has no one table", "a space for all coordinates");
    };
    return e;
}

}  // namespace extremal::spaces
