// SPDX-License-Identifier: GPL-3.0-or-later
/// The passport of a scheme: all that is known of it before a run, and what a few runs on its scene measure.
///
/// The discrete action and its stationarity; the step that is left when the interior unknowns are eliminated,
/// with the coefficients of its Runge-Kutta tableau to 30 digits where it is one (tableau/tableau.hpp); order
/// conditions by trees, symplecticity and symmetry of the coefficients; stability; claims; orders and costs
/// as measured.
#pragma once

#include <stop_token>

#include "engine/passport/document.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct PassportOptions {
    bool isMeasured = true;  ///< orders and costs, by runs of some seconds at most
    unsigned threads = 0;
};

/// Of a scheme of the scene, disabled ones as well. A stop leaves out what is measured.
Document passportOf(const ResolvedScene& scene, std::size_t scheme, const PassportOptions& options = {},
                    const std::stop_token& stop = {});

}  // namespace extremal
