// SPDX-License-Identifier: GPL-3.0-or-later
/// What GiNaC finds for one formula: the work behind differentiate(). Internal to engine/model/typed.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>

#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/symbolic.hpp"

namespace extremal::typed {

/// What was found for a formula: derivatives, or why there are none; neither if it was stopped.
struct DerivativesFound {
    std::shared_ptr<const SymbolicLagrangian> result;
    std::optional<ExpressionError> error;
};

DerivativesFound findDerivatives(const Formula& formula, const ResolvedFormula& resolved,
                                 const std::stop_token& stop, double maxWork);

}  // namespace extremal::typed
