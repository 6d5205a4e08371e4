// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact actions from one state after a sequence of steps, and how far the discrete Lagrangian of a
/// discretization is from them; in the coordinates of the family of the system (family/step_equations.hpp),
/// the chart at the state of a body.
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
#include "engine/family/step_equations.hpp"

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
    /// Throws std::invalid_argument where no family of the system has coordinates.
    ExactActions(const System& system, const State& start, double largest);
    /// Not known where it was asked to stop; asked again it begins anew.
    Entry at(int i, const std::stop_token& stop);
    const Mechanics<double>& mechanics() const { return local_.mechanics; }
    const State& start() const { return start_; }

private:
    Eigen::MatrixXd path(double h, const std::stop_token& stop) const;

    const System& system_;
    State start_;
    LocalCoordinates local_;
    double largest_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Entry>> entries_;
};

/// Over at most 20 steps; of a discretization whose action is that of a table in these coordinates.
ActionDefect actionDefect(const System& system, const Discretization& discretization, double startTime,
                          ExactActions& exact, const std::stop_token& stop);
/// The same of one whose family gives both actions itself; in steps from that of `step` down.
ActionDefect actionDefect(const StepCase& step, const std::stop_token& stop);

}  // namespace extremal
