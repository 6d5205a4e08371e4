// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/model/typed/tape/tape_forms.hpp"

namespace extremal::typed {
namespace {

/// Powers up to this are products; beyond it the library's power is more accurate, and no slower.
constexpr double largestProduct = 32;

}  // namespace

std::uint32_t Code::value(int node) {
    if (const auto found = known_.find(node); found != known_.end()) return found->second;
    const Graph::Node& here = graph_.at(node);
    std::uint32_t made = 0;
    switch (here.kind) {
        case Graph::Kind::number:
            made = constant(here.number);
            break;
        case Graph::Kind::symbol: {
            const auto found = defined_.find(here.symbol);
            made = found != defined_.end() ? found->second : input(static_cast<std::uint32_t>(here.symbol));
            break;
        }
        case Graph::Kind::sum:
            made = sum(here);
            break;
        case Graph::Kind::product:
            made = product(here);
            break;
        case Graph::Kind::call:
            made = call(here);
            break;
    }
    known_.emplace(node, made);
    return made;
}

std::uint32_t Code::call(const Graph::Node& node) {
    std::array<std::uint32_t, 3> operands{};
    for (std::size_t k = 0; k < node.operands.size(); ++k) operands[k] = value(node.operands[k].node);
    const auto function = static_cast<std::uint32_t>(node.function);
    if (node.function == Function::choose) return make(Op::choose, operands[0], operands[1], operands[2]);
    if (node.operands.size() > 1) return make(Op::call2, operands[0], operands[1], function);
    if (!node.table) return make(Op::call, operands[0], 0, function);
    std::size_t k = 0;
    while (k < tables_.size() && !(tables_[k].table == node.table && tables_[k].order == node.order)) ++k;
    if (k == tables_.size()) tables_.push_back({node.table, node.order});
    return make(Op::lookUp, operands[0], 0, static_cast<std::uint32_t>(k));
}

std::uint32_t Code::input(std::uint32_t place) {
    Item item{Kind::input, 0, {}};
    item.code.a = place;
    items_.push_back(item);
    return static_cast<std::uint32_t>(items_.size() - 1);
}

std::uint32_t Code::constant(double number) {
    const auto key = std::bit_cast<std::uint64_t>(number);
    if (const auto found = constants_.find(key); found != constants_.end()) return found->second;
    items_.push_back({Kind::constant, number, {}});
    return constants_[key] = static_cast<std::uint32_t>(items_.size() - 1);
}

std::uint32_t Code::make(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if ((op == Op::add || op == Op::multiply) && a > b) std::swap(a, b);
    const auto key = std::tuple(op, a, b, c);
    if (const auto found = made_.find(key); found != made_.end()) return found->second;
    Item item{Kind::instruction, 0, {}};
    item.code = {op, 0, a, b, c};
    items_.push_back(item);
    return made_[key] = static_cast<std::uint32_t>(items_.size() - 1);
}

/// What is a function of one form is added first.
std::uint32_t Code::sum(const Graph::Node& node) {
    const SumByForms sorted = byForms(graph_, node);
    const auto valuesOf = [&](const std::vector<Graph::Operand>& terms) {
        std::vector<Scaled> values;
        for (const auto& [term, factor] : terms) values.push_back({value(term), factor});
        return values;
    };
    std::vector<Scaled> all = valuesOf(sorted.others);
    for (const auto& [terms, isNegative] : sorted.groups)
        all.push_back({scaledSum(0, valuesOf(terms)), isNegative ? -1.0 : 1.0});
    return scaledSum(sorted.number, all);
}

/// A common size of all coefficients is multiplied in at the end: c (a - b).
std::uint32_t Code::scaledSum(double start, const std::vector<Scaled>& terms) {
    const double first = std::fabs(terms.front().factor);
    const bool isCommon = std::all_of(terms.begin(), terms.end(),
                                      [&](const Scaled& term) { return std::fabs(term.factor) == first; });
    if (!isCommon || first == 1 || start != 0) return plainSum(start, terms, 1);
    const bool isNegative = terms.size() == 1 && terms[0].factor < 0;
    const double scale = isNegative ? -first : first;
    const std::uint32_t inner = plainSum(0, terms, scale);
    return make(Op::multiply, constant(scale), inner);
}

/// constant + sum of (factor / scale) term: one after the other, what is taken away last. Of many terms those
/// of one half are added to those of the other, again and again: these additions do not wait for each other,
/// and the error grows with the logarithm of their number.
std::uint32_t Code::plainSum(double start, const std::vector<Scaled>& terms, double scale) {
    constexpr std::size_t few = 16;
    std::vector<Term> plus, minus, scaled;
    for (const auto& [v, factor] : terms) {
        if (factor == scale)
            plus.push_back({v, false});
        else if (factor == -scale)
            minus.push_back({v, true});
        else
            scaled.push_back({make(Op::multiply, constant(factor / scale), v), false});
    }
    std::vector<Term> all;
    if (start != 0) all.push_back({constant(start), false});
    for (const auto& part : {plus, scaled, minus}) all.insert(all.end(), part.begin(), part.end());
    while (all.size() > few) {
        const std::size_t half = (all.size() + 1) / 2;
        for (std::size_t k = half; k < all.size(); ++k) all[k - half] = added(all[k - half], all[k]);
        all.resize(half);
    }
    // Where all are taken away, from the negative of the first, which has not to wait for the others.
    Term sum = all.front();
    if (sum.isNegative && all.size() > 1) sum = {make(Op::negate, sum.value), false};
    for (std::size_t k = 1; k < all.size(); ++k) sum = added(sum, all[k]);
    return sum.isNegative ? make(Op::negate, sum.value) : sum.value;
}

Code::Term Code::added(Term a, Term b) {
    if (a.isNegative == b.isNegative) return {make(Op::add, a.value, b.value), a.isNegative};
    if (a.isNegative) std::swap(a, b);
    return {make(Op::subtract, a.value, b.value), false};
}

std::uint32_t Code::product(const Graph::Node& node) {
    bool isEmpty = true;
    std::uint32_t result = 0;
    for (const auto& [operand, exponent] : node.operands) {
        const std::uint32_t factor = power(value(operand), exponent);
        result = isEmpty ? factor : make(Op::multiply, result, factor);
        isEmpty = false;
    }
    return result;
}

std::uint32_t Code::power(std::uint32_t base, double exponent) {
    const double size = std::fabs(exponent);
    if (2 * size != std::trunc(2 * size) || size > largestProduct)
        return make(Op::call2, base, constant(exponent), static_cast<std::uint32_t>(Function::power));
    const bool isWhole = size == std::trunc(size);
    std::uint32_t root = isWhole ? base : make(Op::sqrt, base);
    if (exponent < 0) root = make(Op::reciprocal, root);
    if (isWhole) return whole(root, static_cast<long>(size));
    if (size == 0.5) return root;
    // x^(n + 1/2) = x^n sqrt x; for negative powers 1/x = (1/sqrt x)^2 costs no second division.
    const std::uint32_t inner = exponent > 0 ? base : whole(root, 2);
    return make(Op::multiply, root, whole(inner, static_cast<long>(size)));
}

std::uint32_t Code::whole(std::uint32_t base, long exponent) {
    if (exponent == 1) return base;
    const std::uint32_t half = whole(base, exponent / 2);
    const std::uint32_t square = make(Op::multiply, half, half);
    return exponent % 2 == 0 ? square : make(Op::multiply, base, square);
}

}  // namespace extremal::typed
