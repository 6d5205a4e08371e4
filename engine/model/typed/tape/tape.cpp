// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "engine/model/typed/tape/tape_code.hpp"
#include "engine/model/typed/tape/tape_groups.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {
namespace {

using Register = std::uint32_t;
constexpr Register none = std::numeric_limits<Register>::max();

/// How many operands of an instruction are values; a comes first, then b, then c.
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

template <class F>
void forOperands(Instruction& code, F&& f) {
    const int n = operandCount(code.op);
    if (n > 0) f(code.a);
    if (n > 1) f(code.b);
    if (n > 2) f(code.c);
}

/// The instructions that some outputs need, in order, each with the value it makes.
struct Line {
    struct Step {
        Instruction code;
        Register makes, makesToo = none;  ///< makesToo: cos of sinCos
    };
    std::vector<Step> steps;
    std::vector<Register> outputs;
    std::vector<int> uses;  ///< of each value

    Line(const std::vector<Code::Item>& items, std::vector<Register> wanted) : outputs(std::move(wanted)) {
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

    /// Sorts the steps by how many have to be there before them, and then by operations; false, and nothing
    /// changed, where fewer than half of them are in long groups.
    bool sortIntoGroups() {
        constexpr std::size_t few = 128, fewInGroup = 8;
        if (steps.size() < few) return false;
        std::vector<int> depth(uses.size(), 0);
        std::map<std::tuple<int, Op, Register>, std::size_t> groups;
        const auto functionOf = [](const Instruction& code) {
            const bool hasFunction = code.op == Op::call || code.op == Op::call2 || code.op == Op::lookUp;
            return hasFunction ? code.c : Register{0};
        };
        for (Step& step : steps) {
            int own = 0;
            forOperands(step.code, [&](Register& v) { own = std::max(own, depth[v] + 1); });
            depth[step.makes] = own;
            if (step.makesToo != none) depth[step.makesToo] = own;
            ++groups[{own, step.code.op, functionOf(step.code)}];
        }
        std::size_t inLongGroups = 0;
        for (const auto& [key, count] : groups)
            if (count >= fewInGroup) inLongGroups += count;
        if (2 * inLongGroups < steps.size()) return false;
        std::stable_sort(steps.begin(), steps.end(), [&](const Step& a, const Step& b) {
            return std::tuple(depth[a.makes], a.code.op, functionOf(a.code)) <
                   std::tuple(depth[b.makes], b.code.op, functionOf(b.code));
        });
        return true;
    }

private:
    void drop(const std::vector<char>& isDropped) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (!isDropped[i]) steps[kept++] = steps[i];
        steps.resize(kept);
    }
    void joinSinesAndCosines() {
        constexpr auto sine = static_cast<Register>(Function::sin),
                       cosine = static_cast<Register>(Function::cos);
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
    void joinProductsAndSums() {
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
};

}  // namespace

Tape Tape::of(const Graph& graph, std::span<const int> roots, int inputs) {
    Code code(graph);
    std::vector<Register> wanted;
    for (const int root : roots) wanted.push_back(code.value(root));
    Line line(code.items(), std::move(wanted));
    const bool isGrouped = line.sortIntoGroups();

    Tape tape;
    tape.inputs_ = static_cast<std::size_t>(inputs);
    tape.tables_ = code.tables();
    std::vector<std::uint32_t> place(code.items().size(), none);
    for (std::size_t i = 0; i < code.items().size(); ++i) {
        const Code::Item& item = code.items()[i];
        if (line.uses[i] == 0) continue;
        if (item.kind == Code::Kind::input) place[i] = item.code.a;
        if (item.kind == Code::Kind::constant) {
            place[i] = static_cast<std::uint32_t>(tape.inputs_ + tape.constants_.size());
            tape.constants_.push_back(item.number);
        }
    }
    // The last step that reads each value; outputs are read at the end.
    std::vector<std::size_t> last(place.size(), 0);
    for (std::size_t s = 0; s < line.steps.size(); ++s)
        forOperands(line.steps[s].code, [&](Register& v) { last[v] = s; });
    for (const Register v : line.outputs) last[v] = line.steps.size();
    const auto firstFree = static_cast<std::uint32_t>(tape.inputs_ + tape.constants_.size());
    std::uint32_t end = firstFree;
    std::vector<std::uint32_t> free;
    const auto take = [&] {
        if (free.empty()) return end++;
        const std::uint32_t r = free.back();
        free.pop_back();
        return r;
    };
    for (std::size_t s = 0; s < line.steps.size(); ++s) {
        auto& [instruction, makes, makesToo] = line.steps[s];
        std::vector<Register> read;
        forOperands(instruction, [&](Register& v) {
            read.push_back(v);
            v = place[v];
        });
        std::sort(read.begin(), read.end());
        read.erase(std::unique(read.begin(), read.end()), read.end());
        for (const Register v : read)
            if (last[v] == s && place[v] >= firstFree && !isGrouped) free.push_back(place[v]);
        instruction.to = place[makes] = take();
        if (makesToo != none) instruction.c = place[makesToo] = take();
        tape.code_.push_back(instruction);
    }
    tape.registers_ = end;
    for (const Register v : line.outputs) tape.outputs_.push_back(place[v]);
    if (isGrouped) tape.groups_ = groupsOf(tape.code_);
    return tape;
}

void Tape::run(double* r) const {
    if (groups_.empty()) return detail::run(*this, r);
    detail::fillConstants(*this, r);
    for (const TapeGroup& g : groups_) {
        const Instruction* const code = &code_[g.first];
        if (g.isLoop)
            runLoop(g, code, r);
        else
            for (std::uint32_t k = 0; k < g.count; ++k) detail::carryOut(*this, code[k], r);
    }
}

}  // namespace extremal::typed
