// SPDX-License-Identifier: GPL-3.0-or-later
/// From a graph to instructions, before registers are given out: each value is made once and has its own
/// number. Internal to engine/model/typed.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class Code {
public:
    enum class Kind : std::uint8_t { input, constant, instruction };
    struct Item {
        Kind kind;
        double number = 0;   ///< constant
        Instruction code{};  ///< instruction; operands are values; `to` is not used
    };
    explicit Code(const Graph& graph) : graph_(graph) {}

    /// The value of a node; what it needs is made before it.
    std::uint32_t value(int node);
    /// The value in an input register; that of a symbol is in the register of its number, unless it is
    /// defined.
    std::uint32_t input(std::uint32_t place);
    /// A symbol that stands for a value, in nodes that are yet to be made.
    void define(int symbol, std::uint32_t value) { defined_[symbol] = value; }
    std::uint32_t constant(double number);
    std::uint32_t make(Op op, std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0);
    const std::vector<Item>& items() const { return items_; }
    const std::vector<LookUp>& tables() const { return tables_; }

private:
    struct Term {
        std::uint32_t value;
        bool isNegative;
    };
    struct Scaled {
        std::uint32_t value;
        double factor;
    };
    std::uint32_t sum(const Graph::Node& node);
    std::uint32_t scaledSum(double constant, const std::vector<Scaled>& terms);
    std::uint32_t plainSum(double constant, const std::vector<Scaled>& terms, double scale);
    Term added(Term a, Term b);
    std::uint32_t product(const Graph::Node& node);
    std::uint32_t power(std::uint32_t base, double exponent);
    std::uint32_t whole(std::uint32_t base, long exponent);

    const Graph& graph_;
    std::uint32_t call(const Graph::Node& node);

    std::vector<Item> items_;
    std::vector<LookUp> tables_;
    std::map<int, std::uint32_t> known_;
    std::map<int, std::uint32_t> defined_;
    std::map<std::uint64_t, std::uint32_t> constants_;
    std::map<std::tuple<Op, std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

}  // namespace extremal::typed
