// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_parts.hpp"

#include <algorithm>
#include <utility>

#include "engine/model/typed/tape/tape_line.hpp"

namespace extremal::typed {
namespace {

/// Registers of a tape.
struct Range {
    std::uint32_t first, count;
    bool meets(const Range& other) const {
        return first < other.first + other.count && other.first < first + count;
    }
    bool operator==(const Range&) const = default;
};

using Instructions = std::span<const Instruction>;

Instructions instructionsOf(Instructions code, const TapeGroup& g) { return code.subspan(g.first, g.count); }

/// `use` of what a group writes: in a loop all together, else register by register.
template <class Use>
void forWritten(Instructions code, const TapeGroup& g, const Use& use) {
    if (g.isSideBySide()) return use(Range{code[g.first].to, g.count});
    for (const Instruction& i : instructionsOf(code, g)) {
        use(Range{i.to, 1});
        if (i.op == Op::sinCos) use(Range{i.c, 1});
    }
}
/// The same of what it reads, operand by operand.
template <class Use>
void forRead(Instructions code, const TapeGroup& g, const Use& use) {
    if (!g.isSideBySide()) {
        for (const Instruction& i : instructionsOf(code, g))
            forOperands(i, [&](std::uint32_t k) { use(Range{k, 1}); });
        return;
    }
    const TapeGroup::Operand kinds[] = {g.a, g.b, g.c};
    const TapeGroup::Operand* kind = kinds;
    forOperands(code[g.first], [&](std::uint32_t k) {
        use(Range{k, *kind++ == TapeGroup::Operand::single ? 1 : g.count});
    });
}

/// Whether two groups next to each other may change places.
bool areApart(Instructions code, const TapeGroup& one, const TapeGroup& other) {
    bool are = true;
    forWritten(code, one, [&](const Range& written) {
        forRead(code, other, [&](const Range& read) { are = are && !read.meets(written); });
        forWritten(code, other, [&](const Range& too) { are = are && !too.meets(written); });
    });
    forWritten(code, other, [&](const Range& written) {
        forRead(code, one, [&](const Range& read) { are = are && !read.meets(written); });
    });
    return are;
}

}  // namespace

TapeParts::TapeParts(const Tape& tape, std::size_t mostInLoop)
    : code(tape.code().begin(), tape.code().end()),
      outputs(tape.outputPlaces().begin(), tape.outputPlaces().end()) {
    if (mostInLoop == 0) return;
    std::vector<TapeGroup> groups(tape.groups().begin(), tape.groups().end());
    if (tape.goesOn()) writeInPlace(groups, tape.inputs(), tape.registers());
    moveUp(groups);
    for (const TapeGroup& g : groups) {
        const bool isLoop = g.isSideBySide();
        const bool isNext = isLoop && !parts.empty() && parts.back().isLoop &&
                            parts.back().members.size() < mostInLoop && canJoin(parts.back().members, g);
        if (!isNext) parts.push_back({{}, isLoop});
        parts.back().members.push_back({g, true});
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (TapePart::Member& each : parts[p].members)
            each.isRead = !parts[p].isLoop || isReadFrom(p + 1, each.group);
}

void TapeParts::writeInPlace(std::span<const TapeGroup> groups, std::size_t inputs, std::size_t registers) {
    // One past the instruction; registers are given out more than once.
    std::vector<std::size_t> lastRead(inputs, 0), lastWritten(registers, 0);
    for (std::size_t at = 0; at < code.size(); ++at) {
        forOperands(code[at], [&](std::uint32_t k) {
            if (k < inputs) lastRead[k] = at + 1;
        });
        lastWritten[code[at].to] = at + 1;
        if (code[at].op == Op::sinCos) lastWritten[code[at].c] = at + 1;
    }
    const auto place = [&](std::size_t start, std::uint32_t count) {
        const std::uint32_t from = code[start].to;
        const auto first =
            static_cast<std::uint32_t>(std::find(outputs.begin(), outputs.end(), from) - outputs.begin());
        if (first + count > outputs.size()) return;
        for (std::uint32_t n = 0; n < count; ++n)
            if (outputs[first + n] != from + n || lastWritten[from + n] != start + n + 1 ||
                lastRead[first + n] > start + n + 1 ||
                std::count(outputs.begin(), outputs.end(), from + n) != 1)
                return;
        const auto move = [&](std::uint32_t& k) {
            if (k >= from && k < from + count) k += first - from;
        };
        for (std::uint32_t n = 0; n < count; ++n) move(code[start + n].to);
        for (std::size_t at = start + count; at < code.size(); ++at) forOperands(code[at], move);
        std::for_each(outputs.begin(), outputs.end(), move);
    };
    for (const TapeGroup& g : groups) {
        if (g.isSideBySide()) place(g.first, g.count);
        for (std::uint32_t n = 0; n < g.count && !g.isSideBySide(); ++n) place(g.first + n, 1);
    }
}

void TapeParts::moveUp(std::vector<TapeGroup>& groups) {
    for (std::size_t n = 1; n < groups.size(); ++n)
        for (std::size_t k = n; k > 0 && !groups[k].isSideBySide() && groups[k - 1].isSideBySide() &&
                                areApart(code, groups[k - 1], groups[k]);
             --k)
            std::swap(groups[k - 1], groups[k]);
    std::vector<Instruction> moved;
    for (TapeGroup& g : groups) {
        const auto first = static_cast<std::uint32_t>(moved.size());
        const Instructions own = instructionsOf(code, g);
        moved.insert(moved.end(), own.begin(), own.end());
        g.first = first;
    }
    if (!groups.empty()) code = std::move(moved);
}

bool TapeParts::hasLoopOver(std::uint32_t first, std::uint32_t count) const {
    bool has = false;
    for (const TapePart& part : parts)
        for (std::size_t k = 0; part.isLoop && k < part.members.size(); ++k)
            forRead(code, part.members[k].group, [&](const Range& read) {
                has = has || (read.count > 1 && read.meets({first, count}));
            });
    return has;
}

/// Whether a group can be carried out for some places before the ones in front of it are for the next: it
/// reads of these only what is of the same place, and writes nothing that they still read.
bool TapeParts::canJoin(std::span<const TapePart::Member> before, const TapeGroup& g) const {
    if (g.count != before.front().group.count) return false;
    const Range own{code[g.first].to, g.count};
    bool can = true;
    for (const auto& [e, isRead] : before) {
        const Range other{code[e.first].to, e.count};
        const auto isApart = [](const Range& a, const Range& b) { return !a.meets(b) || a == b; };
        can = can && !own.meets(other);
        forRead(code, g, [&](const Range& read) { can = can && isApart(read, other); });
        forRead(code, e, [&](const Range& read) { can = can && isApart(read, own); });
    }
    return can;
}

bool TapeParts::isReadFrom(std::size_t part, const TapeGroup& g) const {
    const std::uint32_t first = code[g.first].to;
    std::vector<char> isThere(g.count, 1);  // and not overwritten
    bool isRead = false;
    const auto forOwn = [&](const Range& other, const auto& use) {
        for (std::uint32_t n = 0; n < g.count; ++n)
            if (other.meets({first + n, 1})) use(isThere[n]);
    };
    const auto read = [&](const Range& range) {
        forOwn(range, [&](char is) { isRead = isRead || is != 0; });
    };
    for (; part < parts.size() && !isRead; ++part)
        for (const TapePart::Member& later : parts[part].members) {
            forRead(code, later.group, read);
            forWritten(code, later.group,
                       [&](const Range& range) { forOwn(range, [](char& is) { is = 0; }); });
        }
    for (const std::uint32_t k : outputs) read({k, 1});
    return isRead;
}

}  // namespace extremal::typed
