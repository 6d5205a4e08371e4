// SPDX-License-Identifier: GPL-3.0-or-later
/// Random potentials: a periodic Gaussian random field of variance 1 in mean and correlation exp(-|r|^2/(2
/// l^2)) about, from a seed: the same on every machine.
///
/// A sum over wave numbers k of the domain (on a rectangle over half the plane of them) of
///     w_k (g_k cos k.r + g'_k sin k.r),   w_k = exp(-|k|^2 l^2/4),   g normal,
/// divided by sqrt(sum w_k^2).
#pragma once

#include <functional>

#include "engine/model/wave/basis/grid.hpp"

namespace extremal::wave {

struct RandomField {
    double seed = 1, correlation = 1, amplitude = 1;
};

std::function<double(double x, double y, double t)> randomField(const Grid& grid, const RandomField& field);

}  // namespace extremal::wave
