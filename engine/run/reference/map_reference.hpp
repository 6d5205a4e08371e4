// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference of runs with several steps (a column of a map, a study): computed once, at the nodes of
/// every step, and then looked up by every scheme. An exact solution is asked directly.
///
/// A scheme as the reference runs once for every step h of the grid, with h/n, n the least that is not above
/// its own step: its nodes are then those of the run. (Between its nodes a variational scheme is worse than
/// at them, and a fine error would show that.) Where it fails, nothing is known of the whole row.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "engine/run/reference/reference.hpp"

namespace extremal {

class MapReference {
public:
    MapReference() = default;
    /// Throws InvalidScene for a file that cannot be used.
    MapReference(const ResolvedScene& resolved, const std::vector<double>& steps,
                 const std::stop_token& stop);

    /// For a run of a scheme with the step of this row; empty where there is no reference.
    ExactSolution at(std::size_t row, const ResolvedScene& resolved, const ResolvedScheme& scheme) const;
    /// Of the reference that is asked itself; that of a scheme's tables has none.
    const ReferenceInfo& info() const { return reference_.info; }
    /// Whether what one run has asked for is there for the others.
    bool isShared() const { return isShared_; }

private:
    struct Table {
        double start, step;
        std::size_t width;
        std::vector<double> states;  ///< node after node
    };
    void runScheme(const ResolvedScene& resolved, const std::vector<double>& steps,
                   const std::stop_token& stop);
    void share(const ResolvedScene& resolved, const std::vector<double>& steps);
    ExactSolution atNodes(std::size_t row) const;

    Reference reference_;
    bool isShared_ = false;
    std::vector<std::shared_ptr<const Table>> tables_;  ///< empty: the reference is asked itself
};

}  // namespace extremal
