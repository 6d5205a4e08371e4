/// What the keys of a view may name in a scene: for the reader, which refuses the rest, and for menus.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// Whether a view has the key at all; and what it may be, where the system is known.
struct ViewChoices {
    bool hasColumns = false, hasZeros = false, hasScheme = false, hasNode = false;
    std::vector<std::string> columns;  ///< of `x` and `y`: phase portraits, trajectories and sections
    std::vector<std::string> zeros;    ///< of `at`: the state columns whose zeros make a section
    std::vector<std::string> schemes;  ///< of `scheme`: the labels, for pictures of one scheme
    int lastNode = 0;                  ///< of `node`, from 1: that of a shape function
};

/// `system` is null where the model is wrong. Views that show a picture of one scheme in the plane and a curve of each on a
/// line are asked with their system.
ViewChoices choicesOf(const std::string& view, const Scene& scene, const System* system);

}  // namespace extremal
