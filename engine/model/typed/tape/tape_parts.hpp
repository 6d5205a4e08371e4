// SPDX-License-Identifier: GPL-3.0-or-later
/// The groups of a tape as the code of a machine carries them out: loops in which several of them go from
/// place to place together, so that what one makes is in a register for the next, and what is between them.
/// Internal to engine/model/typed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

/// Groups that are carried out together.
struct TapePart {
    struct Member {
        TapeGroup group;
        bool isRead;  ///< later, so that it has to be in memory
    };
    std::vector<Member> members;  ///< in a loop, of one length
    bool isLoop = false;
};

/// What groups do, with their instructions and the registers that are read at the end.
struct TapeParts {
    std::vector<Instruction> code;
    std::vector<std::uint32_t> outputs;
    std::vector<TapePart> parts;

    /// At most `mostInLoop` groups together; 0: no parts, and the instructions are one by one.
    TapeParts(const Tape& tape, std::size_t mostInLoop);
    /// Whether a loop goes over some of these registers.
    bool hasLoopOver(std::uint32_t first, std::uint32_t count) const;

private:
    /// Of a tape that goes on, outputs are written over the inputs that they are to be, where nothing that
    /// comes later reads these as they were.
    void writeInPlace(std::span<const TapeGroup> groups, std::size_t inputs, std::size_t registers);
    /// Groups that are no loops go in front of loops that do not make what they read, so that there is
    /// nothing between those loops.
    void moveUp(std::vector<TapeGroup>& groups);
    bool canJoin(std::span<const TapePart::Member> before, const TapeGroup& g) const;
    bool isReadFrom(std::size_t part, const TapeGroup& g) const;
};

}  // namespace extremal::typed
