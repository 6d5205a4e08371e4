// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of many motions of one system at once, in the lanes of vector instructions.
#pragma once

namespace extremal {

class TakesManyStates {
public:
    /// Motions that go together: a multiple of 8, as many as keep the instructions of a call few beside them.
    static constexpr int together = 32;

    virtual ~TakesManyStates() = default;
    /// Takes so many steps of stepSize() with all of them, entry k of the state of motion i at x[k * together
    /// + i]. The bits are those of advance() for each motion by itself. False, and nothing is changed, where
    /// they would not be: the system has no forces at many places at once, or these round in another way
    /// than its force at one place does, which is tried with the motions at hand. Nothing else is checked: a
    /// motion that leaves the finite numbers goes on.
    virtual bool advanceMany(double* x, long long steps) = 0;
};

}  // namespace extremal
