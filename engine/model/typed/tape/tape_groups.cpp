// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_groups.hpp"

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/tape_loops.hpp"

namespace extremal::typed {
namespace {

template <class Pack>
void carryOutGroups(const Tape* tape, double* r) {
    detail::fillConstants(*tape, r);
    detail::carryOutAll<Pack>(*tape, r);
}

}  // namespace

void runGroups(const Tape& tape, double* r) {
    using namespace registers;
    static const auto call =
        ForThisMachine<&carryOutGroups<Eight>, &carryOutGroups<Four>, &carryOutGroups<Two>>::call();
    call(&tape, r);
}

}  // namespace extremal::typed
