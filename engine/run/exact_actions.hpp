// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact actions from one state after a sequence of steps, and how far the discrete Lagrangian of a
/// discretization is from them.
///
/// Each action is that of a resolved boundary-value solve (solve/discrete_lagrangian.hpp) between the state's
/// position and where the exact motion is after h. It is found when it is first asked for and shared by the
/// discretizations that are compared.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/run/action_defect.hpp"
#include "engine/family/scheme.hpp"

namespace extremal {

/// Safe to use from several threads.
class ExactActions {
public:
    struct Entry {
        double h = 0, action = 0, estimatedError = 0;
        Eigen::VectorXd q0, q1;
        bool isKnown = false;
    };
    /// The steps h_i = largest / sqrt(2)^i.
    ExactActions(const System& system, const State& start, double largest)
        : system_(system), start_(start), largest_(largest) {}
    /// Not known where it was asked to stop; asked again it begins anew.
    Entry at(int i, const std::stop_token& stop);

private:
    const System& system_;
    State start_;
    double largest_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Entry>> entries_;
};

/// Over at most 20 steps; of a discretization that has one table (table_of.hpp).
ActionDefect actionDefect(const System& system, const Discretization& discretization, double startTime,
                          ExactActions& exact, const std::stop_token& stop);

}  // namespace extremal
