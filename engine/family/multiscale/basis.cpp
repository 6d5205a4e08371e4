// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/basis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace extremal {

OscillatoryBasis::OscillatoryBasis(int slow, const std::vector<int>& amplitudes) : degree(slow) {
    for (std::size_t k = 0; k < amplitudes.size(); ++k)
        harmonics.push_back({{static_cast<int>(k) + 1, 0}, amplitudes[k]});
}

int OscillatoryBasis::highestDegree() const {
    int highest = degree;
    for (const Harmonic& k : harmonics) highest = std::max(highest, k.degree);
    return highest;
}

Multiples OscillatoryBasis::highestHarmonics() const {
    Multiples highest{0, 0};
    for (const Harmonic& k : harmonics)
        for (std::size_t i = 0; i < 2; ++i) highest[i] = std::max(highest[i], std::abs(k.of[i]));
    return highest;
}

int OscillatoryBasis::size() const {
    int count = degree + 1;
    for (const Harmonic& k : harmonics) count += 2 * (k.degree + 1);
    return count;
}

template <class T>
void OscillatoryBasis::evaluate(T tau, const Phases<T>& phase, const Phases<T>& z, std::span<T> value,
                                std::span<T> derivative) const {
    T P[OscillatoryBasis::mostDegree + 1], dP[OscillatoryBasis::mostDegree + 1];
    const T x = 2 * tau - 1;
    const int highest = highestDegree();
    P[0] = 1;
    P[1] = x;
    dP[0] = 0;
    dP[1] = 2;
    for (int j = 1; j < highest; ++j) {
        const auto n = static_cast<T>(j);
        P[j + 1] = ((2 * n + 1) * x * P[j] - n * P[j - 1]) / (n + 1);
        dP[j + 1] = dP[j - 1] + 2 * (2 * n + 1) * P[j];
    }
    std::size_t a = 0;
    for (int j = 0; j <= degree; ++j, ++a) {
        value[a] = P[j];
        derivative[a] = dP[j];
    }
    for (const Harmonic& k : harmonics) {
        const T wave = k.times(phase), turn = k.times(z), c = std::cos(wave), s = std::sin(wave);
        for (int j = 0; j <= k.degree; ++j, a += 2) {
            value[a] = P[j] * c;
            value[a + 1] = P[j] * s;
            derivative[a] = dP[j] * c - turn * P[j] * s;
            derivative[a + 1] = dP[j] * s + turn * P[j] * c;
        }
    }
}

template void OscillatoryBasis::evaluate(double, const Phases<double>&, const Phases<double>&,
                                         std::span<double>, std::span<double>) const;
template void OscillatoryBasis::evaluate(long double, const Phases<long double>&, const Phases<long double>&,
                                         std::span<long double>, std::span<long double>) const;

Space<double> oscillatorySpace(const OscillatoryBasis& basis, const Phases<double>& z) {
    Space<double> space;
    space.size = basis.size();
    space.degree = basis.degree;
    space.evaluate = [basis, z](const double& tau, std::span<double> value, std::span<double> derivative) {
        basis.evaluate<double>(tau, {z[0] * tau, z[1] * tau}, z, value, derivative);
    };
    return space;
}

}  // namespace extremal
