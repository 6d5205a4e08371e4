/// What the keys of a view may name in a scene: for the reader, which refuses the rest, and for menus.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// Which of these keys a view has.
struct ViewKeys {
    bool hasColumns = false;  ///< `x` and `y`: phase portraits, trajectories and sections
    bool hasZeros = false;    ///< `at`: sections
    bool hasScheme = false;   ///< `scheme`: pictures of one scheme
    bool hasNode = false;     ///< `node`: shape functions
};
/// `system` is null where the model is wrong. A profile is a picture of one scheme in the plane, and has a
/// curve of each on a line.
ViewKeys keysOf(const std::string& view, const System* system);

/// What `x` and `y` of a view may be. Makes the start of the scene, to know what its observables write.
std::vector<std::string> columnsFor(const std::string& view, const Scene& scene, const System& system);
/// What `at` may be: the state columns.
std::vector<std::string> zerosFor(const System& system);
/// What `scheme` may be.
std::vector<std::string> labelsOf(const Scene& scene);
/// What `node` may be at most; from 1.
int lastNodeOf(const Scene& scene);

}  // namespace extremal
