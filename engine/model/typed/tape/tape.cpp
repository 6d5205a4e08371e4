// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "engine/model/typed/tape/free_registers.hpp"
#include "engine/model/typed/tape/tape_code.hpp"
#include "engine/model/typed/tape/tape_groups.hpp"
#include "engine/model/typed/tape/tape_line.hpp"
#include "engine/model/typed/tape/tape_order.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {
namespace {

constexpr auto never = std::numeric_limits<std::size_t>::max();

/// Gives registers to what the steps of a line make, one block after the other.
class Placing {
public:
    Placing(Line& line, std::vector<std::uint32_t> place, std::uint32_t firstFree, const Line::Blocks& ends)
        : line_(line), place_(std::move(place)), firstFree_(firstFree), free_(firstFree) {
        last_.assign(place_.size(), never);
        std::size_t step = 0;
        for (std::size_t b = 0; b < ends.size(); ++b)
            for (; step < ends[b]; ++step)
                forOperands(line_.steps[step].code, [&](std::uint32_t v) { last_[v] = b; });
        for (const std::uint32_t v : line_.outputs) last_[v] = never;
    }

    /// Block number b, whose steps are sorted so that they read side by side what earlier blocks made.
    void place(std::size_t b, std::span<Line::Step> block) {
        std::vector<std::uint32_t> ended;
        for (Line::Step& step : block)
            forOperands(step.code, [&](std::uint32_t& v) {
                if (last_[v] == b && place_[v] >= firstFree_) ended.push_back(place_[v]);
                if (last_[v] == b) last_[v] = never;
                v = place_[v];
            });
        sortByOperands(block);
        // A single instruction may write where it read; a loop may not.
        const auto release = [&] {
            for (const std::uint32_t r : ended) free_.release(r);
        };
        if (block.size() == 1) release();
        std::uint32_t to = takeFor(block);
        for (Line::Step& step : block) step.code.to = place_[step.makes] = to++;
        if (block.front().makesToo != Line::none) {
            to = takeFor(block);
            for (Line::Step& step : block) step.code.c = place_[step.makesToo] = to++;
        }
        if (block.size() > 1) release();
    }
    std::uint32_t of(std::uint32_t value) const { return place_[value]; }
    /// One past the last register that is read or written; loops go over whole registers of the machine.
    std::uint32_t end() const { return free_.end() + (isGrouped_ ? loopOverrun : 0); }

private:
    /// Registers side by side for what a block makes. A loop writes past its end while nothing is kept there;
    /// those registers are free again behind it.
    std::uint32_t takeFor(std::span<const Line::Step> block) {
        const auto count = static_cast<std::uint32_t>(block.size());
        if (count == 1) return free_.take(count);
        isGrouped_ = true;
        const std::uint32_t to = free_.take(count + loopOverrun);
        for (std::uint32_t k = count; k < count + loopOverrun; ++k) free_.release(to + k);
        return to;
    }

    bool isGrouped_ = false;
    Line& line_;
    std::vector<std::uint32_t> place_;  ///< of each value
    std::uint32_t firstFree_;
    FreeRegisters free_;
    std::vector<std::size_t>
        last_;  ///< the last block that reads each value; never: it is an output, or not read
};

}  // namespace

Tape Tape::of(const Graph& graph, std::span<const int> roots, int inputs) {
    Code code(graph);
    std::vector<std::uint32_t> values;
    for (const int root : roots) values.push_back(code.value(root));
    return of(code, std::move(values), static_cast<std::size_t>(inputs));
}

Tape Tape::goingOn(const Code& code, std::vector<std::uint32_t> values, std::size_t inputs) {
    Tape tape = of(code, std::move(values), inputs);
    tape.goesOn_ = true;
    return tape;
}

Tape Tape::of(const Code& code, std::vector<std::uint32_t> values, std::size_t inputs) {
    Line line(code.items(), std::move(values));
    Tape tape;
    tape.inputs_ = inputs;
    tape.tables_ = code.tables();
    std::vector<std::uint32_t> place(code.items().size(), Line::none);
    for (std::size_t i = 0; i < code.items().size(); ++i) {
        const Code::Item& item = code.items()[i];
        if (line.uses[i] == 0) continue;
        if (item.kind == Code::Kind::input) place[i] = item.code.a;
        if (item.kind == Code::Kind::constant) {
            place[i] = static_cast<std::uint32_t>(tape.inputs_ + tape.constants_.size());
            tape.constants_.push_back(item.number);
        }
    }
    Line::Blocks ends = line.sortIntoBlocks();
    const bool isGrouped = !ends.empty();
    if (!isGrouped) {
        line.spread();
        for (std::size_t s = 0; s < line.steps.size(); ++s) ends.push_back(s + 1);
    }
    const auto firstFree = static_cast<std::uint32_t>(tape.inputs_ + tape.constants_.size());
    Placing placing(line, std::move(place), firstFree, ends);
    std::size_t first = 0;
    for (std::size_t b = 0; b < ends.size(); first = ends[b++]) {
        const auto block = std::span(line.steps).subspan(first, ends[b] - first);
        placing.place(b, block);
        for (const Line::Step& step : block) tape.code_.push_back(step.code);
        if (isGrouped) addGroups(tape.code_, first, tape.groups_);
    }
    tape.registers_ = placing.end();
    for (const std::uint32_t v : line.outputs) tape.outputs_.push_back(placing.of(v));
    tape.findStretches();
    tape.one_ = std::make_shared<MachineCode>(false);
    tape.eight_ = std::make_shared<MachineCode>(true);
    return tape;
}

void Tape::findStretches() {
    constexpr std::size_t fewOutputs = 4;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
        if (stretches_.empty() || outputs_[i] != stretches_.back().afterRegister)
            stretches_.push_back({0, outputs_[i]});
        stretches_.back() = {static_cast<std::uint32_t>(i + 1), outputs_[i] + 1};
    }
    if (stretches_.size() * fewOutputs > outputs_.size()) stretches_.clear();
}

void Tape::copyOutputs(std::size_t first, std::size_t count, const double* r, double* to) const {
    const std::size_t end = first + count;
    if (stretches_.empty()) {
        for (std::size_t i = first; i < end; ++i) *to++ = r[outputs_[i]];
        return;
    }
    for (const auto& [last, afterRegister] : stretches_) {
        if (last <= first) continue;
        const std::size_t here = std::min<std::size_t>(last, end) - first;
        to = std::copy_n(r + outputs_[first], here, to);
        if ((first += here) == end) return;
    }
}

void Tape::run(double* r) const {
    if (const auto code = forOne()) return code(r);
    runOne(r);
}

void Tape::runOne(double* r) const {
    if (!groups_.empty()) return runGroups(*this, r);
    detail::run(*this, r);
}

void Tape::goOn(double* r, const double* fresh, const double* end) const {
    const std::size_t kept = outputs_.size(), each = inputs_ - kept;
    while (fresh != end) {
        if (const auto code = codeOf<MachineCode::Runs>(one_)) return code(r, fresh, end);
        std::copy_n(fresh, each, r + kept);
        fresh += each;
        runOne(r);
        copyOutputs(0, kept, r, r);
    }
}

}  // namespace extremal::typed
