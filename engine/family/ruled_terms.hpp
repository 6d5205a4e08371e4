// SPDX-License-Identifier: GPL-3.0-or-later
/// The terms of a Lagrangian, put together by the rules that a scene gives them.
#pragma once

#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal {

/// All terms with one rule, as one part of the Lagrangian.
struct RuledTerms {
    Settings rule;  ///< without a type: none was given
    LagrangianTerm<double> part;
};
/// `quadrature`: a rule for each term (quadrature/tensor.hpp).
std::vector<RuledTerms> ruledTerms(const Mechanics<double>& mechanics, const Settings& quadrature);

/// The name of a part that does not have the symmetry, so that the discrete action does not; empty: all have
/// it. The symmetry is one without F that does not move time.
std::string breakerOf(const std::vector<RuledTerms>& parts, const Symmetry& symmetry);

}  // namespace extremal
