// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/fitting.hpp"

#include <cstdlib>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/core/library_exceptions.hpp"
#include "engine/family/scheme.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

Properties describedSafely(const ChoiceGrid::Cell& cell) {
    try {
        return contained({}, [&] { return describe(cell.discretization); });
    } catch (const InvalidScene& error) {
        Properties unknown;
        unknown.refusal = error.problems().front().message;
        return unknown;
    }
}

}  // namespace

std::vector<CatalogItem> fittingSpaces(const Scene& scene) { return spacesFor(makeSystem(scene)); }

std::vector<const BaselineEntry*> fittingBaselines(const Scene& scene) {
    return baselinesFor(makeSystem(scene));
}

std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<const SchemeEntry*> entries;
    for (const SchemeEntry& e : schemeCatalog())
        if (isFor(e.make(e.minDegree), system)) entries.push_back(&e);
    return entries;
}

std::vector<DescribedGrid> describedChoices(const System& system) {
    std::vector<DescribedGrid> all;
    try {
        for (ChoiceGrid& grid : contained("/model", [&] { return choiceGrids(system); }))
            all.push_back({std::move(grid), {}});
    } catch (const InvalidScene&) {
        return {};
    }
    for (auto& [choices, known] : all)
        for (const ChoiceGrid::Cell& cell : choices.cells) known.push_back(describedSafely(cell));
    return all;
}

ChoiceGrid choicesFor(const Scene& scene) { return choicesFor(makeSystem(scene)); }

const ChoiceGrid::Cell* nearestChoice(const ChoiceGrid& grid, const std::string& rule, int degree) {
    const ChoiceGrid::Cell* best = nullptr;
    int least = 0;
    for (const ChoiceGrid::Cell& cell : grid.cells) {
        const auto& [space, quadrature, solver, impact] = cell.discretization;
        if (!describe(cell.discretization).refusal.empty()) continue;
        const int distance =
            std::abs(space.integer("degree") - degree) + (quadrature.type == rule ? 0 : 1000);
        if (best && distance >= least) continue;
        best = &cell;
        least = distance;
    }
    return best;
}

}  // namespace extremal
