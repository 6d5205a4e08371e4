// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/node_tape.hpp"

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal::typed {
namespace {

void rootsOfNodes(const Tape& tape, int d, int nodes, const double* q, const double* p, double* values) {
    for (int i = 0; i < nodes; i += 8)
        runEight(
            tape,
            [&](Lanes* r) {
                for (int k = 0; k < d; ++k) {
                    r[k] = Lanes::load(q + k * nodes + i);
                    r[d + k] = Lanes::load(p + k * nodes + i);
                }
            },
            [&](std::size_t k, const Lanes& value) {
                storeEight(value, values + static_cast<int>(k) * nodes + i);
            });
}

}  // namespace

NodeTape::NodeTape(const Graph& graph, std::span<const int> roots, int dimension)
    : dimension_(dimension), tape_(Tape::of(graph, roots, 2 * dimension)) {}

void NodeTape::evaluate(int nodes, const double* q, const double* p, double* values) const {
    static const auto call = ForThisMachine<&rootsOfNodes>::call();
    call(tape_, dimension_, nodes, q, p, values);
}

}  // namespace extremal::typed
