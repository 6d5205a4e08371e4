// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_energy.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/model/typed/symbolic.hpp"

namespace extremal::typed {
namespace {

/// The gradient in the first variables and the value, with nodes in place of these and 0 in place of all
/// others that are no parameters.
std::vector<int> insertedIn(Graph& to, const std::vector<int>& variables, std::size_t count,
                            const Formula& formula, const SymbolicLagrangian& of) {
    std::vector<int> roots(of.gradient.begin(), of.gradient.begin() + static_cast<std::ptrdiff_t>(count));
    roots.push_back(of.value);
    return to.insert(of.graph, roots, [&](int symbol) {
        if (static_cast<std::size_t>(symbol) < count) return variables[static_cast<std::size_t>(symbol)];
        const int k = symbol - formula.firstParameter();
        return to.number(k < 0 ? 0 : formula.parameters[static_cast<std::size_t>(k)].second);
    });
}

/// Steps of velocities have no derivatives and are no kinetic energy.
bool hasCallsOfVelocities(const SymbolicLagrangian& L, int d) {
    std::vector<int> calls;
    for (int i = 0; i < L.graph.size(); ++i)
        if (L.graph.at(i).kind == Graph::Kind::call) calls.push_back(i);
    return L.graph.dependsOn(calls, [d](int symbol) { return symbol >= d && symbol < 2 * d; });
}

}  // namespace

EnergyFormula energyOfHamiltonian(const Formula& phaseFormula, std::shared_ptr<const void> of) {
    const auto add = [formula = phaseFormula](
                         Graph& to, const std::vector<int>& variables) -> std::optional<GraphFunction> {
        GraphFunction H;
        H.gradient = insertedIn(to, variables, formula.coordinates.size(), formula, *differentiate(formula));
        H.value = H.gradient.back();
        H.gradient.pop_back();
        return H;
    };
    return {std::move(of), add};
}

std::optional<EnergyFormula> energyOfLagrangian(const Formula& formula, const Mechanics<double>& mechanics) {
    if (!mechanics.isSeparable) return {};
    const auto add = [formula, mechanics](Graph& to,
                                          const std::vector<int>& variables) -> std::optional<GraphFunction> {
        const auto n = formula.coordinates.size();
        const auto symbolic = differentiate(formula);
        if (hasCallsOfVelocities(*symbolic, formula.dimension())) return {};
        const std::vector<int> L = insertedIn(to, variables, n, formula, *symbolic);
        std::vector<Graph::Operand> terms{{L.back(), -1}};
        GraphFunction H;
        for (std::size_t k = 0; k < n; ++k) H.gradient.push_back(to.scaled(L[k], -1));
        for (std::size_t k = 0; k < n; ++k) {
            terms.push_back({to.product({{variables[n + k], 2}}), 0.5 / mechanics.masses[k]});
            H.gradient.push_back(to.scaled(variables[n + k], 1 / mechanics.masses[k]));
        }
        H.value = to.sum(0, terms);
        return H;
    };
    return EnergyFormula{mechanics.model, add};
}

}  // namespace extremal::typed
