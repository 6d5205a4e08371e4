// SPDX-License-Identifier: GPL-3.0-or-later
/// Computes the motions from the starts of the views of a scene, each as a task, with the view's scheme: the
/// first enabled one by default. The Lyapunov exponent is carried along. Motions that were computed before in
/// this program are remembered: one more start costs one more motion.
#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/run/cases/start_sets.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

class StartsRun {
public:
    /// The scene must outlive it.
    explicit StartsRun(const ResolvedScene& resolved);

    std::size_t tasks() const { return tasks_.size(); }
    /// Callable from any thread, once each. Returns early when stopped: the motion then stays unknown.
    void run(std::size_t task, const std::stop_token& stop);

    /// What there is now.
    StartSets latest() const;
    double fraction() const;  ///< of all motions; 1 without starts

private:
    struct Task {
        std::size_t set, orbit;
    };
    struct Origin {
        std::size_t scheme;  ///< index in Scene::schemes
        std::string key;     ///< all that its motions depend on, but for their starts
        std::size_t mostPoints;
        std::vector<Orbit> starts;
    };
    const ResolvedScene& resolved_;
    std::vector<Task> tasks_;
    std::vector<Origin> origins_;
    StartSets sets_;  ///< guarded by the mutex
    std::size_t done_ = 0;
    mutable std::mutex mutex_;
};

/// The scheme of a view's starts: the one it names, else the first enabled one; none where there is none.
std::optional<std::size_t> schemeOfStarts(const Scene& scene, const View& view);

}  // namespace extremal
