// SPDX-License-Identifier: GPL-3.0-or-later
/// Compositions: a symmetric scheme with itself, over parts of the step, has a higher order.
///
///     Psi_h = Phi_{g_1 h} o ... o Phi_{g_m h},   sum g_i = 1,   sum g_i^(p+1) = 0,   g_i = g_{m+1-i}
/// turns a symmetric scheme of order p (even) into a symmetric one of order p + 2; repeated, into any higher
/// even order.
/// - yoshida: g = (a, 1 - 2a, a), a = 1 / (2 - 2^(1/(p+1))): 3 parts a level, the middle one goes back by
/// more than h;
/// - suzuki: g = (a, a, 1 - 4a, a, a), a = 1 / (4 - 4^(1/(p+1))): 5 parts a level, none longer than h;
/// - kahan-li: of a scheme of order 2 to order 6 at once in 9 parts, or to order 8 in 17, none longer than h.
///   Their errors are some hundred times smaller than those of the other two with as many parts or more.
/// All parts are steps of the scheme, so what each of them keeps is kept: symplecticity, momenta, quadratic
/// invariants.
///
/// Sources: Yoshida 1990; Suzuki 1990; Kahan and Li 1997 (s9odr6a, s17odr8a); Hairer, Lubich, Wanner 2006,
/// II.4 and V.3.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/integrator/integrator.hpp"

namespace extremal {

/// "yoshida", "suzuki" and "kahan-li", each with the key `order`.
const std::vector<CatalogItem>& compositionCatalog();

/// The order that is aimed at where none is given: the least one that the composition has above that of the
/// scheme.
int defaultOrder(const std::string& composition, const Claims& scheme);

/// Whether the scheme can be composed to the default order.
bool isComposableBy(const std::string& composition, const Claims& scheme);

/// Why the scheme cannot be composed to this order; empty if it can. `hint`: the remedy.
std::string compositionRefusal(const Settings& composition, const Claims& scheme, std::string& hint);

/// The parts g_i of the step, for a scheme of order `from`.
std::vector<double> compositionParts(const Settings& composition, int from);

/// What the composition promises: the higher order, and all else that the scheme does.
Claims composedClaims(const Settings& composition, Claims scheme);

/// The steps g_i h of a one-step method, one after the other, as one step; h is the step size of `scheme`.
/// Dense output is that of shorter steps: a composition of tau h from where the step began.
std::unique_ptr<Integrator> composed(const std::vector<double>& parts, const Integrator& scheme);

}  // namespace extremal
