// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/system.hpp"

#include <algorithm>
#include <cmath>

#include "engine/model/slow/slow_models.hpp"

namespace extremal {

System::System() = default;
System::System(const System&) = default;
System::System(System&&) noexcept = default;
System& System::operator=(const System&) = default;
System& System::operator=(System&&) noexcept = default;
System::~System() = default;

void forgetKnownMotion(System& system) {
    system.exact = {};
    system.exactFrom = {};
    system.phaseError = {};
    system.fast = {};
    system.reduced.clear();
    if (system.parts.find<SlowModels>()) system.parts.set(SlowModels{});
}

const Measure* measureOf(const System& system, std::string_view observable) {
    const auto found = std::find_if(system.measures.begin(), system.measures.end(),
                                    [&](const Measure& m) { return m.observable == observable; });
    return found == system.measures.end() ? nullptr : &*found;
}

std::vector<Quantity> stateColumns(const System& system) {
    if (!system.columns.empty()) return system.columns;
    std::vector<Quantity> columns;
    for (const Coordinate& c : system.coordinates)
        columns.push_back({"q." + c.name, c.title, c.symbol, c.unit});
    for (const Coordinate& c : system.coordinates)
        columns.push_back({"p." + c.name, c.title + " momentum", "p_" + c.symbol, c.momentumUnit});
    return columns;
}

EnergyFunction energyOf(const System& system) {
    if (system.energy) return system.energy;
    const Mechanical* const found = system.parts.find<Mechanical>();
    if (!found) return {};
    return [m = *found](double t, const double* x) { return m.energy(m.model.get(), t, x, x + m.dimension); };
}

EnergyFunction kineticEnergyOf(const System& system) {
    if (system.kineticEnergy) return system.kineticEnergy;
    const Mechanical* const found = system.parts.find<Mechanical>();
    if (!found) return {};
    return [m = *found, v = std::vector<double>(static_cast<std::size_t>(found->dimension))](
               double t, const double* x) mutable {
        const double* const p = x + m.dimension;
        if (!m.velocity(m.model.get(), t, x, p, v.data())) return 0.0;
        double sum = 0;
        for (std::size_t k = 0; k < v.size(); ++k) sum += p[k] * v[k];
        return sum / 2;
    };
}

StateBlocks blocksOf(const System& system) {
    if (!system.hasCoordinates()) return system.blocks;
    const std::size_t d = system.coordinates.size();
    return {0, {d, d}};
}

LinearTest linearTestOf(const System& system) {
    if (system.linearTest != LinearTest::none) return system.linearTest;
    return system.isMovedOnlyBy<Mechanical>() ? LinearTest::oscillator : LinearTest::none;
}

ErrorMeasure errorMeasure(const System& system, const State& initial) {
    if (system.error.evaluate) return system.error;
    const auto& coordinates = system.coordinates;
    const std::size_t d = coordinates.size();
    const bool sameUnit = std::all_of(coordinates.begin(), coordinates.end(),
                                      [&](const Coordinate& c) { return c.unit == coordinates[0].unit; });
    ErrorMeasure m;
    m.columns.push_back({"error", "", "|q - q_ref|", sameUnit ? coordinates[0].unit : ""});
    m.columns.push_back({"error.p", "", "|p - p_ref|", sameUnit ? coordinates[0].momentumUnit : ""});
    for (const Coordinate& c : coordinates)
        m.columns.push_back({"error." + c.name, "", c.symbol + " - " + c.symbol + "_ref", c.unit});
    m.scale = 0;
    for (std::size_t i = 0; i < d; ++i) m.scale = std::max(m.scale, std::abs(initial.x[i]));
    m.evaluate = [d](const double* x, const double* reference, double* values) {
        coordinateError(d, x, reference, values);
    };
    return m;
}

bool rateOf(const System& system, double t, const double* x, double* dx) {
    if (system.rate) return system.rate(t, x, dx);
    const Mechanical* const m = system.parts.find<Mechanical>();
    return m && m->flow && m->flow(m->model.get(), t, x, x + m->dimension, dx, dx + m->dimension);
}

}  // namespace extremal
