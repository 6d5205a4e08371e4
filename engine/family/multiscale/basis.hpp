// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves with a slow and a fast part: polynomials, and harmonics of one frequency or of two with polynomial
/// amplitudes,
///     q(tau) = sum_{j <= n} c_j P_j + sum_k sum_{j <= m_k} P_j (C_kj cos(k . phase) + S_kj sin(k . phase)),
/// P_j Legendre's polynomials in 2 tau - 1, phase = z tau with z = step * frequency; k are multiples of the
/// frequencies, such as (1, 0), (0, 1) and the combination (1, -1). The amplitudes are unknowns of their own,
/// linear and additive; the printed product (sum p_j t^j)(1 + a_0 sin + a_1 cos) ties the fast amplitude to
/// the slow mean, and fails where the mean passes through 0 (Leok 2004, sec. 7.2).
///
/// Between two nodes of a Filon grid (quadrature/filon.hpp) position and phases are independent: functions
/// are evaluated at (tau, phase), and differentiated along the curve, d/dtau + z . d/dphase.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/space/space.hpp"

namespace extremal {

/// One entry for each frequency; the second is 0 where there is one only.
using Multiples = std::array<int, 2>;
template <class T>
using Phases = std::array<T, 2>;

struct Harmonic {
    Multiples of{1, 0};  ///< k
    int degree = 0;      ///< m_k, of the amplitudes
    bool operator==(const Harmonic&) const = default;

    /// k . phase
    template <class T>
    T times(const Phases<T>& phase) const {
        return static_cast<T>(of[0]) * phase[0] + static_cast<T>(of[1]) * phase[1];
    }
};

struct OscillatoryBasis {
    static constexpr int mostDegree = 24;

    int degree = 1;  ///< n, of the slow part; 1 to mostDegree as those of the amplitudes from 0
    std::vector<Harmonic> harmonics;
    bool operator==(const OscillatoryBasis&) const = default;

    OscillatoryBasis() = default;
    /// The first harmonics of one frequency, with amplitudes of these degrees.
    OscillatoryBasis(int slow, const std::vector<int>& amplitudes);

    int highestDegree() const;
    /// Largest multiple of each frequency.
    Multiples highestHarmonics() const;
    /// Functions in the order 1, P_1, ..., P_n, then for each harmonic P_j cos and P_j sin, j = 0..m_k.
    int size() const;

    /// value[a] at (tau, phase) and derivative[a] along the curve, by tau.
    /// T: double or long double.
    template <class T>
    void evaluate(T tau, const Phases<T>& phase, const Phases<T>& z, std::span<T> value,
                  std::span<T> derivative) const;
};

/// The space on one step with z = step * frequency.
Space<double> oscillatorySpace(const OscillatoryBasis& basis, const Phases<double>& z);

}  // namespace extremal
