// SPDX-License-Identifier: GPL-3.0-or-later
/// What is drawn and said of a discretization while it is typed: its functions over one step with the nodes
/// of its rule, their slopes, the amplification on the harmonic oscillator, the pattern of its equations, the
/// order that is predicted and the one that is measured. Computed on any thread.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/figure/figure.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

struct DiscretizationSketch {
    std::vector<Problem> errors;  ///< then there is nothing else
    Figure functions, slopes, amplification, pattern;
    std::vector<std::string> facts;    ///< name, symmetry, largest step, K, D(k), sigma
    std::vector<std::string> remarks;  ///< what bounds the order, and what is doubtful
    int order = 0;                     ///< predicted
};

/// Of the first scheme of a scene.
DiscretizationSketch sketchOf(const ReadScene& read);

/// The order at which ends of eight steps converge to each other as the step is halved, on the scene itself;
/// none where a step fails or errors are those of rounding.
std::optional<double> measuredOrder(const ReadScene& read, const std::stop_token& stop);

}  // namespace extremal
