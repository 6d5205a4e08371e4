// SPDX-License-Identifier: GPL-3.0-or-later
/// How well a scheme does over a grid of a parameter of the model and the step: one short run a cell.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/scene/map_grid.hpp"

namespace extremal {

struct MapCell {
    /// blownUp: the state has grown to 10^6 times its size at the start; refused: no such scene or scheme.
    enum class End { waiting, done, blownUp, failed, refused };
    End end = End::waiting;
    Outcome cause = Outcome::converged;  ///< of a failure
    /// Done: the largest size of the column over all nodes; NaN where it is not known.
    double value = std::numeric_limits<double>::quiet_NaN();
    bool isDone() const { return end == End::done; }
};

/// "done", "blow-up", "refused", or the cause of a failure; "stopped" of one that has not been computed.
constexpr std::string_view name(const MapCell& cell) {
    switch (cell.end) {
        case MapCell::End::waiting:
            return "stopped";
        case MapCell::End::done:
            return "done";
        case MapCell::End::blownUp:
            return "blow-up";
        case MapCell::End::failed:
            return extremal::name(cell.cause);
        case MapCell::End::refused:
            return "refused";
    }
    return "";
}

/// One scheme's.
struct ParameterMap {
    std::size_t view = 0;  ///< index in Scene::views
    std::string scheme;    ///< its label
    int style = 0;
    MapGrid grid;
    std::vector<std::string>
        problems;                ///< of each value of the parameter: why it makes no valid scene, else empty
    std::vector<MapCell> cells;  ///< of value i and step j at i * steps + j

    const MapCell& at(std::size_t i, std::size_t j) const { return cells[i * grid.steps.size() + j]; }
};

}  // namespace extremal
