/// Curves with a slow and a fast part: polynomials, and harmonics of one frequency with polynomial amplitudes,
///     q(tau) = sum_{j <= n} c_j P_j + sum_{k=1}^{H} sum_{j <= m_k} P_j (C_kj cos k phase + S_kj sin k phase),
/// P_j Legendre's polynomials in 2 tau - 1, phase = z tau with z = step * frequency. The amplitudes are unknowns of their
/// own, linear and additive; the printed product (sum p_j t^j)(1 + a_0 sin + a_1 cos) ties the fast amplitude to the slow
/// mean, and fails where the mean passes through 0 (Leok 2004, sec. 6.2).
///
/// Between two nodes of a Filon grid (quadrature/filon.hpp) position and phase are independent: functions are evaluated at
/// (tau, phase), and differentiated along the curve, d/dtau + z d/dphase.
#pragma once

#include <span>
#include <vector>

#include "engine/space/space.hpp"

namespace extremal {

struct OscillatoryBasis {
    int degree = 1;              ///< n, of the slow part
    std::vector<int> harmonics;  ///< m_1, m_2, ...: degrees of the amplitudes of the harmonics
    bool operator==(const OscillatoryBasis&) const = default;

    int highestHarmonic() const { return static_cast<int>(harmonics.size()); }
    int highestDegree() const;
    /// Functions in the order 1, P_1, ..., P_n, then for each harmonic P_j cos and P_j sin, j = 0..m_k.
    int size() const;

    /// value[a] at (tau, phase) and derivative[a] along the curve, by tau.
    /// T: double or long double.
    template <class T>
    void evaluate(T tau, T phase, T z, std::span<T> value, std::span<T> derivative) const;
};

/// The space on one step with z = step * frequency.
Space<double> oscillatorySpace(const OscillatoryBasis& basis, double z);

}  // namespace extremal
