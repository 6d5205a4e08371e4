// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of families that work on meshes: in which keys of a model the mesh of a scheme differs from that of
/// the scene.
#pragma once

#include <optional>

#include "engine/core/settings.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// The keys of the model at the resolution of a space; nothing where the space has no resolution of its own,
/// so that the scheme is on the mesh of the scene. Without it all schemes of the family are on that mesh.
struct OwnMesh {
    static constexpr PartInfo part{"own-mesh", "spaces with a resolution of their own", false};
    std::optional<Settings> (*model)(const Settings& space, const Settings& model) = nullptr;
};

/// The keys of the model on a mesh of `factor` times as many elements along each axis. For the systems of the
/// part all orders, of whatever scheme, are those of a refinement of the mesh and the step together; without
/// it the step alone is refined. A baseline says it for its own schemes.
struct RefinedMesh {
    static constexpr PartInfo part{"refined-mesh", "orders in space and time", false};
    Settings (*model)(const Settings& model, int factor) = nullptr;
    Takes of = Takes::everything();  ///< for which systems of the family or the baseline
    /// Of families: further systems, for its own schemes alone, where others are spectral in space.
    Takes ofOwn = Takes::only<>();
};

/// A RefinedMesh::model of models with the keys cells and cells_y.
inline Settings refinedCells(const Settings& model, int factor) {
    Settings finer = model;
    for (auto& [key, value] : finer.keys)
        if (key == "cells" || key == "cells_y") value = value.asNumber() * factor;
    return finer;
}

}  // namespace extremal
