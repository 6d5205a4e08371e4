// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {

std::vector<LagrangianTerm<double>> makeTerms(const Formula& formula, std::string* throwing) {
    std::vector<LagrangianTerm<double>> terms;
    for (const auto& [name, text] : formula.terms) {
        if (throwing) *throwing = name;
        Formula own = formula;
        own.text = text;
        own.terms.clear();
        const ResolvedFormula resolved = resolve(own);
        const bool hasVelocities =
            std::any_of(resolved.symbol.begin(), resolved.symbol.end(),
                        [d = own.dimension()](int symbol) { return symbol >= d && symbol < 2 * d; });
        const Mechanics<double> mechanics = makeMechanics(own).mechanics;
        terms.push_back({name, mechanics.model, mechanics.jet, mechanics.gradient, hasVelocities});
    }
    return terms;
}

}  // namespace extremal::typed
