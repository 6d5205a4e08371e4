// SPDX-License-Identifier: GPL-3.0-or-later
/// A run of a scene: every enabled scheme is a task on a pool of threads; results stream out while it goes
/// on.
///
///     Comparison result = run(scene);                 // wait for everything
///     Run r(scene); r.start(); ... r.latest(); r.stop();   // or watch it
///
/// Construction throws InvalidScene if the scene cannot be run, or be resumed. Memory does not grow with the
/// number of steps.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/run/comparison.hpp"
#include "engine/run/march/checkpoints.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct RunOptions {
    unsigned threads = 0;                ///< 0: as many as the machine has cores
    std::vector<Product> products = {};  ///< besides those that the views of the scene need
    /// By the places of the schemes: results that hold (run/reuse.hpp) and are not computed again; null or
    /// missing: to be computed. `reference` is then shown if nothing is left to be measured against it.
    std::vector<std::shared_ptr<const SchemeResult>> known = {};
    ReferenceInfo reference = {};
    std::optional<CheckpointPlan> checkpoints = {};  ///< none: there are none
    bool isTimed = true;  ///< short runs are repeated for their CPU time; false: it is that of one run
};

class Run {
public:
    explicit Run(ResolvedScene scene, const RunOptions& options = {});
    explicit Run(const Scene& scene, const RunOptions& options = {});
    ~Run();  ///< stops and joins
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    void start();
    void stop();  ///< returns at once; workers end within 50 ms and keep their partial result
    void wait();
    /// Waits so long at most; true: it is finished.
    bool waitFor(std::chrono::milliseconds time);
    bool isFinished() const;
    /// What there is so far, at most some 30 ms old while running; cheap, callable from any thread.
    Comparison latest() const;
    /// Of the work of this run, 0..1: schemes that are known are not part of it, those that failed are over.
    double fraction() const;
    bool isPreparing() const;  ///< the reference is computed; no scheme has begun

    /// Of a run that is over: whether there are checkpoints to go on from; the first reason why one could not
    /// be written, or empty; and removes them, when the results are written.
    bool hasCheckpoints() const;
    std::string checkpointFailure() const;
    void removeCheckpoints();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Runs everything and returns it.
Comparison run(const Scene& scene, const RunOptions& options = {});

}  // namespace extremal
