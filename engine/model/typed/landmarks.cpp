// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/landmarks.hpp"

#include <algorithm>
#include <array>

#include "engine/core/work.hpp"

namespace extremal::typed {
namespace {

/// The symbols below a node.
std::vector<int> symbolsBelow(const Graph& graph, int root, int inputs) {
    std::vector<int> found;
    graph.dependsOn({root}, [&](int symbol) {
        if (symbol < inputs) found.push_back(symbol);
        return false;  // go on to the others
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace

Landmarks::Landmarks(const Graph& graph, int root, int inputs) {
    std::vector<char> isSeen(static_cast<std::size_t>(graph.size()), 0);
    std::vector<int> open{root}, sums;
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        if (isSeen[static_cast<std::size_t>(at)]) continue;
        isSeen[static_cast<std::size_t>(at)] = 1;
        const Graph::Node& node = graph.at(at);
        for (const Graph::Operand& operand : node.operands) open.push_back(operand.node);
        const bool isShifted = node.number != 0 || node.operands.size() > 1;
        if (at != root && node.kind == Graph::Kind::sum && isShifted) sums.push_back(at);
    }
    std::stable_sort(sums.begin(), sums.end(),
                     [&](int a, int b) { return (graph.at(a).number != 0) > (graph.at(b).number != 0); });
    sums.resize(std::min(sums.size(), most));
    for (const int sum : sums) {
        symbols_.push_back(symbolsBelow(graph, sum, inputs));
        tapes_.push_back(Tape::of(graph, std::array{sum}, inputs));
    }
}

double Landmarks::value(std::size_t k, const double* inputs) const {
    const Tape& tape = tapes_[k];
    work::spend(static_cast<double>(tape.registers()));
    thread_local std::vector<double> registers;
    if (registers.size() < tape.registers()) registers.resize(tape.registers());
    std::copy_n(inputs, tape.inputs(), registers.begin());
    tape.run(registers.data());
    return tape.output(0, registers.data());
}

}  // namespace extremal::typed
