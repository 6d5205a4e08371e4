// SPDX-License-Identifier: GPL-3.0-or-later
/// A kick and the drift behind it as one tape. What it computes are its own inputs afterwards, so that
/// nothing is copied between the kicks of a step.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class Code;

/// Of an energy A(p) + B(q) that does not know the time. The bits are those of its force, kick and drift one
/// by one.
class KickTape {
public:
    KickTape() = default;
    /// `forces`: roots of -dB/dq, of the symbols 0, 1, ... for q. `masses`: A is a sum of p_i^2 / (2 m_i).
    static KickTape ofSeparable(const Graph& graph, std::span<const int> forces,
                                std::span<const double> masses);
    /// `velocities`: roots of dA/dp, of the symbols d, d + 1, ... for p.
    static KickTape ofSum(const Graph& graph, std::span<const int> forces, std::span<const int> velocities);

    /// As Mechanics::kicksAndDrifts.
    void take(const KicksAndDrifts<double>& steps, double* q, double* p, double* force) const;

private:
    /// The values of a drift over the value `drift` from the momenta p: what is added to each of q.
    using Drifts = std::function<std::vector<std::uint32_t>(Code&, std::uint32_t drift,
                                                            const std::vector<std::uint32_t>& p)>;
    KickTape(const Graph& graph, std::span<const int> forces, const Drifts& drifts);

    std::size_t d_ = 0;
    Tape pair_;              ///< (q, p, force, kick, drift) -> (q, p, force)
    Tape drift_;             ///< the same registers -> q
    std::size_t shift_ = 0;  ///< of the registers against lines of the cache
};

}  // namespace extremal::typed
