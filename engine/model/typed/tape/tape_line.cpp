// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_line.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace extremal::typed {
namespace {

using Register = std::uint32_t;

/// The function or table of a call.
Register functionOf(const Instruction& code) {
    const bool hasFunction = code.op == Op::call || code.op == Op::call2 || code.op == Op::lookUp;
    return hasFunction ? code.c : Register{0};
}

}  // namespace

int operandCount(Op op) {
    switch (op) {
        case Op::negate:
        case Op::reciprocal:
        case Op::sqrt:
        case Op::sinCos:
        case Op::call:
        case Op::lookUp:
            return 1;
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::call2:
            return 2;
        case Op::multiplyAdd:
        case Op::multiplySubtract:
        case Op::subtractProduct:
        case Op::choose:
            return 3;
    }
    return 0;
}

Line::Line(const std::vector<Code::Item>& items, std::vector<Register> wanted) : outputs(std::move(wanted)) {
    uses.assign(items.size(), 0);
    for (const Register v : outputs) ++uses[v];
    for (std::size_t i = items.size(); i-- > 0;) {
        if (uses[i] == 0 || items[i].kind != Code::Kind::instruction) continue;
        Step step{items[i].code, static_cast<Register>(i), none};
        forOperands(step.code, [&](Register& v) { ++uses[v]; });
        steps.push_back(step);
    }
    std::reverse(steps.begin(), steps.end());
    joinSinesAndCosines();
    joinProductsAndSums();
}

Line::Blocks Line::sortIntoBlocks() {
    constexpr std::size_t few = 128, fewInBlock = 8;
    if (steps.size() < few) return {};
    std::vector<int> depth(uses.size(), 0);
    const auto keyOf = [&](const Step& step) {
        return std::tuple(depth[step.makes], step.code.op, functionOf(step.code));
    };
    std::map<std::tuple<int, Op, Register>, std::size_t> sizes;
    for (Step& step : steps) {
        int own = 0;
        forOperands(step.code, [&](Register v) { own = std::max(own, depth[v] + 1); });
        depth[step.makes] = own;
        if (step.makesToo != none) depth[step.makesToo] = own;
        ++sizes[keyOf(step)];
    }
    Blocks ends;
    std::size_t inLargeBlocks = 0, end = 0;
    for (const auto& [key, count] : sizes) {
        if (count >= fewInBlock) inLargeBlocks += count;
        ends.push_back(end += count);
    }
    if (2 * inLargeBlocks < steps.size()) return {};
    std::stable_sort(steps.begin(), steps.end(),
                     [&](const Step& a, const Step& b) { return keyOf(a) < keyOf(b); });
    return ends;
}

/// A list scheduling: of the next steps the first one whose operands are old, or else the one whose youngest
/// operand is the oldest. A wider window makes more values wait for their use, and takes more registers.
void Line::spread() {
    constexpr std::size_t window = 32, old = 12;
    std::vector<std::size_t> ages(uses.size(), 0);  // the place from which a value is old
    constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();
    for (const Step& step : steps) {
        ages[step.makes] = unknown;
        if (step.makesToo != none) ages[step.makesToo] = unknown;
    }
    std::vector<Step> next, sorted;
    sorted.reserve(steps.size());
    for (std::size_t taken = 0; sorted.size() < steps.size();) {
        while (next.size() < window && taken < steps.size()) next.push_back(steps[taken++]);
        std::size_t best = 0, bestAge = unknown;
        for (std::size_t k = 0; k < next.size() && bestAge > sorted.size(); ++k) {
            std::size_t age = 0;
            forOperands(next[k].code, [&](Register v) { age = std::max(age, ages[v]); });
            if (age < bestAge) best = k, bestAge = age;
        }
        const Step& step = next[best];
        ages[step.makes] = sorted.size() + old;
        if (step.makesToo != none) ages[step.makesToo] = sorted.size() + old;
        sorted.push_back(step);
        next.erase(next.begin() + static_cast<std::ptrdiff_t>(best));
    }
    steps.swap(sorted);
}

void Line::drop(const std::vector<char>& isDropped) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (!isDropped[i]) steps[kept++] = steps[i];
    steps.resize(kept);
}

void Line::joinSinesAndCosines() {
    constexpr auto sine = static_cast<Register>(Function::sin), cosine = static_cast<Register>(Function::cos);
    std::map<Register, std::pair<std::size_t, std::size_t>> pairs;  // argument -> places of sin, cos
    constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Instruction& c = steps[i].code;
        if (c.op != Op::call || (c.c != sine && c.c != cosine)) continue;
        auto& both = pairs.try_emplace(c.a, nowhere, nowhere).first->second;
        (c.c == sine ? both.first : both.second) = i;
    }
    std::vector<char> isDropped(steps.size(), 0);
    for (const auto& [argument, both] : pairs) {
        const auto [s, c] = both;
        if (s == nowhere || c == nowhere) continue;
        Step& first = steps[std::min(s, c)];
        const Register sinValue = steps[s].makes, cosValue = steps[c].makes;
        first = {{Op::sinCos, 0, argument, 0, 0}, sinValue, cosValue};
        isDropped[std::max(s, c)] = 1;
        --uses[argument];
    }
    drop(isDropped);
}

/// A product that only one sum uses becomes part of it.
void Line::joinProductsAndSums() {
    std::map<Register, std::size_t> products;
    std::vector<char> isDropped(steps.size(), 0);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        Instruction& code = steps[i].code;
        if (code.op == Op::multiply) products[steps[i].makes] = i;
        if (code.op != Op::add && code.op != Op::subtract) continue;
        const auto join = [&](Register product, Register other, Op op) {
            const auto found = products.find(product);
            if (found == products.end() || uses[product] != 1) return false;
            const Instruction& p = steps[found->second].code;
            code = {op, 0, p.a, p.b, other};
            isDropped[found->second] = 1;
            return true;
        };
        const Register a = code.a, b = code.b;
        if (code.op == Op::add) {
            if (!join(b, a, Op::multiplyAdd)) join(a, b, Op::multiplyAdd);
        } else if (!join(b, a, Op::subtractProduct)) {
            join(a, b, Op::multiplySubtract);
        }
    }
    drop(isDropped);
}

}  // namespace extremal::typed
