// SPDX-License-Identifier: GPL-3.0-or-later
/// The arguments of the switches of a typed Lagrangian at states of a motion whose branches are held fixed.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

#include "engine/model/typed/branches.hpp"

namespace extremal {

class SwitchValues {
public:
    explicit SwitchValues(std::shared_ptr<const typed::Branches> branches);

    const typed::Branches& branches() const { return *branches_; }
    const std::shared_ptr<const typed::Branches>& shared() const { return branches_; }

    /// s of switch k at (t, x), x = (q, p). `mechanics`: in these cells.
    double at(std::size_t k, double t, const double* x, const Mechanics<double>& mechanics,
              const typed::Branches::Cells& cells);
    /// The cells of (t, x). `mechanics`: of the formula as it is.
    typed::Branches::Cells cells(double t, const double* x, const Mechanics<double>& mechanics);
    /// ds/dt along the motion. `time`: on which it changes.
    double rate(std::size_t k, double t, const double* x, double time, const Mechanics<double>& mechanics,
                const typed::Branches::Cells& cells);
    /// The same after a small part of `time`: not zero where the first derivative alone vanishes.
    double laterRate(std::size_t k, double t, const double* x, double time,
                     const Mechanics<double>& mechanics, const typed::Branches::Cells& cells);
    /// ds/dx.
    Eigen::VectorXd gradient(std::size_t k, double t, const double* x, const Mechanics<double>& mechanics,
                             const typed::Branches::Cells& cells);
    /// What rounding of t and x makes of s.
    double noise(std::size_t k, double t, const double* x, const Mechanics<double>& mechanics,
                 const typed::Branches::Cells& cells);
    /// Hamilton's vector field; not a number where it does not exist.
    Eigen::VectorXd flow(double t, const double* x, const Mechanics<double>& mechanics) const;

private:
    std::shared_ptr<const typed::Branches> branches_;
    std::vector<double> inputs_;
};

}  // namespace extremal
