// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/metric.hpp"

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

std::string nameOf(const ObservableEntry& entry) {
    return entry.item.id == "phase-error" ? "phase" : entry.item.id;
}

bool isMeasurable(const ObservableEntry& entry, const System& system, const State& start) {
    return entry.bind && appliesTo(entry, system) && entry.bind({system, start, {}}).extreme >= 0;
}

}  // namespace

std::vector<std::string> metricNames(const System& system, const State& start) {
    std::vector<std::string> names;
    for (const ObservableEntry& entry : observableEntries())
        if (isMeasurable(entry, system, start)) names.push_back(nameOf(entry));
    return names;
}

Metric metricOf(const std::string& name, bool isAtEnd, const System& system, const State& start) {
    for (const ObservableEntry& entry : observableEntries())
        if (nameOf(entry) == name && isMeasurable(entry, system, start)) return {name, &entry, isAtEnd};
    throw InvalidScene("--metric", "\"" + name + "\" cannot be measured for " + system.id,
                       "one of " + joinNames(metricNames(system, start)));
}

}  // namespace extremal
