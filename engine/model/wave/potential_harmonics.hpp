// SPDX-License-Identifier: GPL-3.0-or-later
/// The Fourier series of a potential on a periodic interval: V(x_j) = sum_a V_a exp(2 pi i a j/N).
#pragma once

#include <vector>

#include "engine/model/wave/basis/fourier.hpp"

namespace extremal {

struct PotentialHarmonics {
    std::vector<Complex> coefficients;  ///< V_a in FFT order
    int highest = 0;                    ///< the largest |a| above round-off; of the samples, so at most N/2

    /// Of the values at the nodes.
    static PotentialHarmonics of(const std::vector<double>& V, const Fourier& fourier);
};

}  // namespace extremal
