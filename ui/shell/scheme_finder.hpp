/// Which scheme of a scene a cell of the discretizer stands for. The schemes are resolved once, as there are
/// dozens of cells.
#pragma once

#include <vector>

#include "engine/family/choices.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

class SchemeFinder {
public:
    explicit SchemeFinder(const Scene& scene);
    /// The scheme with the same space and rule, first of all one that is switched on, or -1. In a cell with
    /// formulas (isOwn) are all schemes of its kinds of space and rule and its degree.
    int find(const ChoiceGrid::Cell& cell) const;

private:
    std::vector<ResolvedScheme> schemes_;
};

}  // namespace extremal
