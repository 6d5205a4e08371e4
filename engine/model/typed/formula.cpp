// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/formula.hpp"

#include <cmath>
#include <map>
#include <string_view>

#include "engine/core/text/indexed.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/parts/controls.hpp"

namespace extremal::typed {
namespace {

using Node = Expression::Node;

std::size_t place(int node) { return static_cast<std::size_t>(node); }

class Resolver {
public:
    explicit Resolver(const Formula& formula) : formula_(formula) {
        const int d = formula.dimension();
        for (int i = 0; i < d; ++i) {
            symbols_[formula.coordinates[place(i)]] = i;
            symbols_[formula.coordinates[place(i)] + "_t"] = d + i;
        }
        symbols_.emplace("t", formula.time());  // or a coordinate, for derivatives by it
        for (std::size_t k = 0; k < formula.parameters.size(); ++k)
            symbols_[formula.parameters[k].first] = formula.firstParameter() + static_cast<int>(k);
    }

    ResolvedFormula resolve() {
        result_.expression = withControls(
            formula_.isExpanded ? parseWrittenOut(formula_.text) : parseExpression(formula_.text),
            formula_.controls);
        const std::size_t count = result_.expression.nodes.size();
        result_.symbol.assign(count, -1);
        result_.constant.assign(count, std::nullopt);
        for (std::size_t n = 0; n < count; ++n) {
            findSymbol(n);
            fold(n);
        }
        putExponentsInPlace();
        return std::move(result_);
    }

private:
    const Node& node(std::size_t n) const { return result_.expression.nodes[n]; }

    void findSymbol(std::size_t n) {
        const Node& here = node(n);
        if (here.kind == Operator::name) {
            const auto found = symbols_.find(here.name);
            if (found == symbols_.end()) throw unknown(here);
            result_.symbol[n] = found->second;
        } else if (here.kind == Operator::call && here.name == "dot") {
            const int of = result_.symbol[place(here.left)];
            if (of < 0 || of >= formula_.dimension())
                throw ExpressionError("has dot(...) of something other than a coordinate", here.position,
                                      "coordinates: " + joinNames(formula_.coordinates));
            result_.symbol[n] = formula_.dimension() + of;
        }
    }
    ExpressionError unknown(const Node& here) const {
        std::vector<std::string> known = formula_.coordinates;
        for (const std::string& c : formula_.coordinates) known.push_back(c + "_t");
        for (const auto& parameter : formula_.parameters) known.push_back(parameter.first);
        for (const auto& control : formula_.controls) known.push_back(control.first);
        known.insert(known.end(), {"t", "pi"});
        if (isFunctionName(here.name))
            return {"has an unknown name \"" + here.name + "\"", here.position,
                    "as a function it needs brackets: " + here.name + "(...)"};
        return {"has an unknown name \"" + here.name + "\"", here.position, suggestName(here.name, known)};
    }

    std::optional<double> valueOf(const Node& here, const std::vector<std::optional<double>>& values) const {
        const auto operand = [&](int n) { return n < 0 ? std::optional<double>(0) : values[place(n)]; };
        const auto a = operand(here.left), b = operand(here.right), c = operand(here.third);
        if (!a || !b || !c || here.kind == Operator::name) return {};
        return applyNode(here, *a, *b, *c);
    }
    void fold(std::size_t n) {
        if (result_.symbol[n] >= 0) return;
        result_.constant[n] = valueOf(node(n), result_.constant);
        requireFinite(n);
    }
    void requireFinite(std::size_t n) const {
        if (result_.constant[n] && !std::isfinite(*result_.constant[n]))
            throw ExpressionError("is not finite here: " + formatNumber(*result_.constant[n]),
                                  node(n).position);
    }
    /// An exponent that has only parameters in it becomes a number: x^n with n = 2 is x^2, smooth at 0.
    void putExponentsInPlace() {
        std::vector<std::optional<double>> values(result_.constant.size());
        std::vector<char> hasParameter(values.size(), 0);
        const auto dependsOnParameter = [&](int n) { return n >= 0 && hasParameter[place(n)]; };
        for (std::size_t n = 0; n < values.size(); ++n) {
            const Node& here = node(n);
            const int parameter = result_.symbol[n] - formula_.firstParameter();
            if (parameter >= 0)
                values[n] = formula_.parameters[place(parameter)].second;
            else if (result_.symbol[n] < 0)
                values[n] = valueOf(here, values);
            hasParameter[n] = parameter >= 0 || dependsOnParameter(here.left) ||
                              dependsOnParameter(here.right) || dependsOnParameter(here.third);
            if (here.kind != Operator::power || !dependsOnParameter(here.right) || !values[place(here.right)])
                continue;
            const std::size_t exponent = place(here.right);
            result_.constant[exponent] = values[exponent];
            requireFinite(exponent);
            result_.exponents.push_back(*values[exponent]);
        }
    }

    const Formula& formula_;
    std::map<std::string, int, std::less<>> symbols_;
    ResolvedFormula result_;
};

}  // namespace

ResolvedFormula resolve(const Formula& formula) { return Resolver(formula).resolve(); }

}  // namespace extremal::typed
