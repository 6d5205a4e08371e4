// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/potential_harmonics.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

PotentialHarmonics PotentialHarmonics::of(const std::vector<double>& V, const Fourier& fourier) {
    const std::vector<Complex> samples(V.begin(), V.end());
    PotentialHarmonics h;
    h.coefficients.resize(V.size());
    fourier.rawToCoefficients(samples.data(), h.coefficients.data());
    double largest = 0;
    for (Complex& v : h.coefficients) {
        v /= fourier.size();
        largest = std::max(largest, std::abs(v));
    }
    for (int i = 0; i < fourier.size(); ++i)
        if (std::abs(h.coefficients[static_cast<std::size_t>(i)]) > 2e-15 * largest)
            h.highest = std::max(h.highest, std::abs(fourier.number(i)));
    return h;
}

}  // namespace extremal
