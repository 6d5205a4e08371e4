// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/derivatives_found.hpp"

#include <string>
#include <utility>
#include <vector>

#include "engine/core/memo_cache.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::typed {
namespace {

/// All that the derivatives of a formula depend on.
struct KeyOfFormula {
    std::vector<std::string> names;
    std::string text;
    std::vector<double> exponents;
    bool operator==(const KeyOfFormula&) const = default;
};

/// A control by all that its derivatives depend on.
std::string textOf(const std::pair<std::string, Expression>& control) {
    std::string text = control.first + " = " + control.second.text;
    for (const Expression::Node& node : control.second.nodes)
        if (node.table) text += " " + node.name + " " + std::to_string(node.table->hash());
    return text;
}

}  // namespace

std::shared_ptr<const SymbolicLagrangian> differentiate(const Formula& formula, const std::stop_token& stop,
                                                        double maxWork) {
    static CountedCache<KeyOfFormula, DerivativesFound> known(24);
    const ResolvedFormula resolved = resolve(formula);
    KeyOfFormula key{formula.coordinates, formula.text, resolved.exponents};
    key.names.emplace_back();
    for (const auto& parameter : formula.parameters) key.names.push_back(parameter.first);
    for (const auto& control : formula.controls) key.names.push_back(textOf(control));
    const DerivativesFound finding = known.getIf(
        key, "derivatives of " + formula.text,
        [&] { return findDerivatives(formula, resolved, stop, maxWork); },
        [](const DerivativesFound& f) { return f.result || f.error; });
    if (finding.error) throw *finding.error;
    return finding.result;
}

}  // namespace extremal::typed
