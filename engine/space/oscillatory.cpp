#include "engine/space/oscillatory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace extremal {

int OscillatoryBasis::highestDegree() const {
    int highest = degree;
    for (const int m : harmonics) highest = std::max(highest, m);
    return highest;
}

int OscillatoryBasis::size() const {
    int count = degree + 1;
    for (const int m : harmonics) count += 2 * (m + 1);
    return count;
}

template <class T>
void OscillatoryBasis::evaluate(T tau, T phase, T z, std::span<T> value, std::span<T> derivative) const {
    // One pass over the degrees; each function sits at its fixed place.
    T P = 1, lower = 0, dP = 0, dLower = 0;
    const T x = 2 * tau - 1;
    const int highest = highestDegree();
    for (int j = 0; j <= highest; ++j) {
        if (j <= degree) {
            value[static_cast<std::size_t>(j)] = P;
            derivative[static_cast<std::size_t>(j)] = dP;
        }
        int first = degree + 1;
        for (int k = 1; k <= highestHarmonic(); ++k) {
            const int m = harmonics[static_cast<std::size_t>(k - 1)];
            if (j <= m) {
                const T wave = static_cast<T>(k) * phase, turn = static_cast<T>(k) * z;
                const T c = std::cos(wave), s = std::sin(wave);
                const auto a = static_cast<std::size_t>(first + 2 * j);
                value[a] = P * c;
                value[a + 1] = P * s;
                derivative[a] = dP * c - turn * P * s;
                derivative[a + 1] = dP * s + turn * P * c;
            }
            first += 2 * (m + 1);
        }
        const auto n = static_cast<T>(j);
        const T next = ((2 * n + 1) * x * P - n * lower) / (n + 1);
        const T dNext = dLower + 2 * (2 * n + 1) * P;
        lower = P;
        dLower = dP;
        P = next;
        dP = dNext;
    }
}

template void OscillatoryBasis::evaluate(double, double, double, std::span<double>, std::span<double>) const;
template void OscillatoryBasis::evaluate(long double, long double, long double, std::span<long double>,
                                         std::span<long double>) const;

Space<double> oscillatorySpace(const OscillatoryBasis& basis, double z) {
    Space<double> space;
    space.size = basis.size();
    space.degree = basis.degree;
    space.evaluate = [basis, z](const double& tau, std::span<double> value, std::span<double> derivative) {
        basis.evaluate<double>(tau, z * tau, z, value, derivative);
    };
    return space;
}

}  // namespace extremal
