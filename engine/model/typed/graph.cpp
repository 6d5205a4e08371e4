// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/graph.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "engine/core/text/expression.hpp"

namespace extremal::typed {
namespace {

constexpr std::array<std::string_view, 33> names = {
    "sin",   "cos",       "tan",   "asin",  "acos",  "atan",  "atan2", "sinh", "cosh", "tanh",  "exp",
    "log",   "abs",       "sign",  "power", "asinh", "acosh", "atanh", "erf",  "erfc", "floor", "ceil",
    "round", "heaviside", "hypot", "max",   "min",   "<",     "<=",    "==",   "!=",   "if",    "table"};

std::uint64_t mix(std::uint64_t h, std::uint64_t x) {
    h ^= x + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
    h *= 0xbf58476d1ce4e5b9ULL;
    return h ^ (h >> 29);
}
std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); }

bool isInteger(double x) { return x == std::trunc(x) && std::fabs(x) < 1e9; }

bool isSame(const Graph::Node& a, const Graph::Node& b) {
    return a.kind == b.kind && bits(a.number) == bits(b.number) && a.symbol == b.symbol &&
           (a.kind != Graph::Kind::call || a.function == b.function) && a.operands == b.operands &&
           a.order == b.order && (a.table == b.table || (a.table && b.table && *a.table == *b.table));
}

}  // namespace

std::string_view name(Function function) { return names[static_cast<std::size_t>(function)]; }

std::optional<Function> functionNamed(std::string_view wanted) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) return {};
    return static_cast<Function>(found - names.begin());
}

Graph::Rank Graph::rankOf(const Node& node) const {
    std::uint64_t shape = static_cast<std::uint64_t>(node.kind) + 1;
    if (node.kind == Kind::call) shape = mix(shape, static_cast<std::uint64_t>(node.function));
    if (node.table) shape = mix(mix(shape, node.table->hash()), static_cast<std::uint64_t>(node.order));
    std::uint64_t h = mix(mix(shape, bits(node.number)), static_cast<std::uint64_t>(node.symbol + 2));
    Rank rank;
    if (node.kind == Kind::symbol) rank.firstSymbol = rank.lastSymbol = node.symbol;
    for (const Operand& o : node.operands) {
        const Rank& own = at(o.node).rank;
        h = mix(mix(h, own.hash), bits(o.factor));
        shape = mix(mix(shape, own.shape), node.kind == Kind::product ? bits(o.factor) : 0);
        rank.firstSymbol = std::min(rank.firstSymbol, own.firstSymbol);
        rank.lastSymbol = std::max(rank.lastSymbol, own.lastSymbol);
    }
    rank.shape = shape;
    rank.hash = h;
    return rank;
}

int Graph::intern(Node node) {
    node.rank = rankOf(node);
    const std::uint64_t h = node.rank.hash;
    const auto [from, to] = known_.equal_range(h);
    for (auto it = from; it != to; ++it)
        if (isSame(at(it->second), node)) return it->second;
    nodes_.push_back(std::move(node));
    known_.emplace(h, size() - 1);
    return size() - 1;
}

int Graph::number(double value) {
    Node node;
    node.number = value == 0 ? 0 : value;
    return intern(std::move(node));
}

int Graph::symbol(int index) {
    Node node;
    node.kind = Kind::symbol;
    node.symbol = index;
    return intern(std::move(node));
}

std::vector<Graph::Operand> Graph::ordered(std::vector<Operand> operands) const {
    const auto key = [&](const Operand& o) { return std::tuple(at(o.node).rank, o.node, o.factor); };
    std::sort(operands.begin(), operands.end(),
              [&](const Operand& a, const Operand& b) { return key(a) < key(b); });
    return operands;
}

bool Graph::isNegative(const Node& node) {
    return node.kind == Kind::sum && (node.number != 0 ? node.number : node.operands[0].factor) < 0;
}

int Graph::negative(int node) {
    std::vector<Operand> terms = at(node).operands;
    for (Operand& o : terms) o.factor = -o.factor;
    return sum(-at(node).number, terms);
}

int Graph::sum(double constant, const std::vector<Operand>& operands) {
    Node node;
    node.kind = Kind::sum;
    node.number = constant;
    std::vector<Operand>& terms = node.operands;
    for (const auto& [operand, factor] : ordered(operands)) {
        const Node& inner = at(operand);
        const bool isScaled = inner.kind == Kind::sum && inner.operands.size() == 1 && inner.number == 0;
        if (factor == 0) continue;
        if (inner.kind == Kind::number)
            node.number += factor * inner.number;
        else if (isScaled || (inner.kind == Kind::sum && std::fabs(factor) == 1)) {
            node.number += factor * inner.number;
            for (const Operand& o : inner.operands) terms.push_back({o.node, factor * o.factor});
        } else if (isNegative(inner)) {
            terms.push_back({negative(operand), -factor});
        } else {
            terms.push_back({operand, factor});
        }
    }
    terms = ordered(std::move(terms));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < terms.size();) {
        Operand term = terms[i];
        for (++i; i < terms.size() && terms[i].node == term.node; ++i) term.factor += terms[i].factor;
        if (term.factor != 0) terms[kept++] = term;
    }
    terms.resize(kept);
    if (terms.empty()) return number(node.number);
    if (terms.size() == 1 && node.number == 0 && terms[0].factor == 1) return terms[0].node;
    return intern(std::move(node));
}

int Graph::product(const std::vector<Operand>& operands) {
    Node node;
    node.kind = Kind::product;
    double coefficient = 1;
    std::vector<Operand>& factors = node.operands;
    const auto add = [&](auto&& self, int operand, double exponent) -> void {
        const Node& inner = at(operand);
        if (exponent == 0) return;
        if (inner.kind == Kind::number) {
            coefficient *= exponent == 1 ? inner.number : std::pow(inner.number, exponent);
        } else if (inner.kind == Kind::sum && inner.operands.size() == 1 && inner.number == 0 &&
                   (isInteger(exponent) || inner.operands[0].factor > 0)) {
            coefficient *=
                exponent == 1 ? inner.operands[0].factor : std::pow(inner.operands[0].factor, exponent);
            self(self, inner.operands[0].node, exponent);
        } else if (isNegative(inner) && isInteger(exponent)) {
            if (std::fmod(exponent, 2) != 0) coefficient = -coefficient;
            factors.push_back({negative(operand), exponent});
        } else if (inner.kind == Kind::product && isInteger(exponent)) {
            for (const Operand& o : inner.operands) factors.push_back({o.node, o.factor * exponent});
        } else {
            factors.push_back({operand, exponent});
        }
    };
    for (const auto& [operand, exponent] : ordered(operands)) add(add, operand, exponent);
    factors = ordered(std::move(factors));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < factors.size();) {
        Operand factor = factors[i];
        for (++i; i < factors.size() && factors[i].node == factor.node; ++i)
            factor.factor += factors[i].factor;
        if (factor.factor != 0) factors[kept++] = factor;
    }
    factors.resize(kept);
    if (factors.empty() || coefficient == 0) return number(coefficient);
    const int whole =
        factors.size() == 1 && factors[0].factor == 1 ? factors[0].node : intern(std::move(node));
    return coefficient == 1 ? whole : scaled(whole, coefficient);
}

int Graph::call(Function function, int a, int b, int c) {
    const bool isFolded = isNumber(a) && (b < 0 || isNumber(b)) && (c < 0 || isNumber(c));
    if (function == Function::power) {
        if (isNumber(b)) return product({{a, at(b).number}});
        if (isFolded) return number(std::pow(at(a).number, at(b).number));
    } else if (isFolded) {
        return number(findFunction(name(function))
                          ->value(at(a).number, b < 0 ? 0 : at(b).number, c < 0 ? 0 : at(c).number));
    } else if (function == Function::choose && b == c) {
        return b;
    } else if (function == Function::choose && isNumber(a) && !std::isnan(at(a).number)) {
        return at(a).number != 0 ? b : c;
    }
    Node node;
    node.kind = Kind::call;
    node.function = function;
    for (const int operand : {a, b, c})
        if (operand >= 0) node.operands.push_back({operand, 1});
    return intern(std::move(node));
}

int Graph::lookUp(std::shared_ptr<const Interpolant> table, int order, int a) {
    if (order > table->degree()) return number(0);
    if (isNumber(a)) return number(table->at(at(a).number, order));
    Node node;
    node.kind = Kind::call;
    node.function = Function::table;
    node.operands.push_back({a, 1});
    node.table = std::move(table);
    node.order = order;
    return intern(std::move(node));
}

std::vector<int> Graph::adopt(const Graph& from, const std::vector<int>& roots,
                              const std::function<std::optional<double>(int)>& valueOf,
                              const std::function<int(int)>& rename) {
    return insert(from, roots, [&](int own) {
        const std::optional<double> value = valueOf(own);
        return value ? number(*value) : symbol(rename ? rename(own) : own);
    });
}

std::vector<int> Graph::insert(const Graph& from, const std::vector<int>& roots,
                               const std::function<int(int)>& nodeOf) {
    // Operands come before what uses them, so one pass over what the roots need is enough.
    std::vector<char> isNeeded(static_cast<std::size_t>(from.size()), 0);
    for (const int root : roots) isNeeded[static_cast<std::size_t>(root)] = 1;
    for (int i = from.size() - 1; i >= 0; --i)
        if (isNeeded[static_cast<std::size_t>(i)])
            for (const Operand& o : from.at(i).operands) isNeeded[static_cast<std::size_t>(o.node)] = 1;
    std::vector<int> here(static_cast<std::size_t>(from.size()), -1);
    for (int i = 0; i < from.size(); ++i) {
        if (!isNeeded[static_cast<std::size_t>(i)]) continue;
        const Node& node = from.at(i);
        std::vector<Operand> operands = node.operands;
        for (Operand& o : operands) o.node = here[static_cast<std::size_t>(o.node)];
        int& made = here[static_cast<std::size_t>(i)];
        switch (node.kind) {
            case Kind::number:
                made = number(node.number);
                break;
            case Kind::symbol:
                made = nodeOf(node.symbol);
                break;
            case Kind::sum:
                made = sum(node.number, operands);
                break;
            case Kind::product:
                made = product(operands);
                break;
            case Kind::call:
                if (node.table)
                    made = lookUp(node.table, node.order, operands[0].node);
                else
                    made = call(node.function, operands[0].node, operands.size() > 1 ? operands[1].node : -1,
                                operands.size() > 2 ? operands[2].node : -1);
                break;
        }
    }
    std::vector<int> result;
    for (const int root : roots) result.push_back(here[static_cast<std::size_t>(root)]);
    return result;
}

bool Graph::dependsOn(const std::vector<int>& roots, const std::function<bool(int)>& picks) const {
    std::vector<char> isNeeded(nodes_.size(), 0);
    for (const int root : roots) isNeeded[static_cast<std::size_t>(root)] = 1;
    for (int i = size() - 1; i >= 0; --i) {
        if (!isNeeded[static_cast<std::size_t>(i)]) continue;
        if (at(i).kind == Kind::symbol && picks(at(i).symbol)) return true;
        for (const Operand& o : at(i).operands) isNeeded[static_cast<std::size_t>(o.node)] = 1;
    }
    return false;
}

}  // namespace extremal::typed
