// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the maps of the views "parameter-map" of a scene, a column (one value of the parameter, every
/// step, every scheme) as a task: its scene is read anew with the parameter changed, as --set would, so that
/// what is written in terms of the parameter follows. A cell is the same run as that scene with this step.
/// Its reference runs once per column.
///
/// Columns that were computed before in this program are remembered: an edit that does not touch them costs
/// nothing.
#pragma once

#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/run/cases/parameter_map.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

class MapRun {
public:
    explicit MapRun(const Scene& scene);

    std::size_t tasks() const { return tasks_.size(); }
    /// Callable from any thread, once each. Returns early when stopped: cells that are not known
    /// from before then wait.
    void run(std::size_t task, const std::stop_token& stop);

    /// What there is now.
    std::vector<std::shared_ptr<const ParameterMap>> latest() const;
    double fraction() const;  ///< of all cells; 1 without maps

private:
    struct Task {
        std::size_t firstMap, column;  ///< maps of the same view are neighbours
    };
    const Scene& scene_;
    std::vector<Task> tasks_;
    std::vector<ParameterMap> maps_;  ///< cells are guarded by the mutex
    std::size_t done_ = 0, all_ = 0;
    mutable std::mutex mutex_;
};

}  // namespace extremal
