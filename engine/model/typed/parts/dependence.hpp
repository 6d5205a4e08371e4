// SPDX-License-Identifier: GPL-3.0-or-later
/// How the coordinates of typed constraints depend on each other, eliminated in formulas.
///
/// With G_D, the columns of g_q of as many coordinates as there are constraints, and G_F, those of the
/// others, N = -G_D^-1 G_F and -G_D^-1 g as one tape: Gauss and Jordan on [G_D, G_F, g] in a given order,
/// with what is 0 everywhere left out. Numbers would be eliminated anew at every place, with all of their
/// zeros. A tape is made once for each order that is asked for.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "engine/model/parts/constraint.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class Dependence {
public:
    /// Of more than this, numbers are as few instructions as formulas.
    static constexpr int mostRows = 8;

    /// `values`: g; `byPlace`: g_q row by row, count x dimension; nodes of a graph whose symbols are the
    /// coordinates and, behind these, time.
    Dependence(Graph graph, std::vector<int> values, std::vector<int> byPlace);

    /// As Constraint::dependence.
    Constraint::AtNodes inOrder(std::span<const int> order) const;

private:
    struct Eliminated {
        int d;
        Tape tape;
    };
    std::shared_ptr<const Eliminated> eliminated(std::span<const int> order) const;
    static void atNodes(const void*, const double* t, int nodes, const double* q, double* to);

    int n_, d_;
    std::vector<int> values_, byPlace_;
    mutable std::mutex making_;
    mutable Graph graph_;
    /// By order; a few, which are looked for without a key that would have to be made.
    mutable std::vector<std::pair<std::vector<int>, std::shared_ptr<const Eliminated>>> known_;
};

}  // namespace extremal::typed
