// SPDX-License-Identifier: GPL-3.0-or-later
/// The catalogue of observables; the observables themselves are in observe/observables, one file each.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/state.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/variation/with_variations.hpp"
#include "engine/model/system.hpp"
#include "engine/observe/evaluation.hpp"
#include "engine/trajectory/trajectory.hpp"

namespace extremal {

/// What an observable may use when it is bound to a run.
struct ObserveContext {
    const System& system;
    const State& initial;
    /// The reference solution, one per run because it may keep a warm start; empty where there is none.
    ExactSolution reference;
    /// The discretization and the step of the scheme; null for baselines, and where only the columns are
    /// asked for.
    const Discretization* discretization = nullptr;
    double step = 0;
    /// What the integrator can say of each step. An observer that reads them finds their values in
    /// NodeBlock::quantities.
    std::span<const Quantity> quantities = {};
    /// That of the run, to be cloned for a trial; null where only the columns are asked for.
    const Integrator* integrator = nullptr;
    int order = 0;  ///< that the scheme claims; 0: none

    /// Where the quantity of a name is among them.
    std::optional<std::size_t> quantity(std::string_view name) const { return indexOf(quantities, name); }
};

/// An observable bound to one run: its columns, and a pure function from a node to their values.
struct Observer {
    std::vector<Column> columns;  ///< names, symbols, units; values empty
    /// Fills one value per column.
    Evaluation evaluate;
    /// Columns behind those, whose values cost more and are computed at rows alone. Empty: none.
    std::vector<Column> rowColumns = {};
    std::function<void(double t, const double* x, double* values)> evaluateRow = {};
    /// Column whose size goes into the summary as a maximum over every node ("energy_error", ...); -1 if
    /// none.
    int extreme = -1;
    /// Whether it reads NodeBlock::quantities: they are measured only then.
    bool readsQuantities = false;
    /// Its values are those of the node so many nodes before the one that it is shown: it looks at nodes on
    /// both sides. The last nodes of a run remain unknown, and what is not a node.
    long long delay = 0;
    std::string about = {};  ///< what it chose for this run, for people
    /// What it remembers of the nodes it has seen, to be written or read; empty: nothing.
    std::function<void(Archive&)> checkpoint = {};
};

/// An observer of a quantity that the integrator says of each step, and of its change from the first known
/// value; the latter is its extreme. Both stay unknown for integrators that have no such quantity.
Observer observeQuantity(const ObserveContext& context, std::string_view quantity, Column value,
                         Column change);

struct ObservableEntry {
    CatalogItem item;
    bool needsReference = false;
    bool needsWayBack = false;      ///< the run goes back from its end, which needs a fixed step
    VariationPlan variations = {};  ///< which variations of the state the run must carry along for it
    /// The binding parts beside which it means something: by default those of problems that are one part
    /// alone.
    Takes takes = plainProblems();
    std::function<bool(const System&)> suits;  ///< whether a system of these parts has it; empty: all have
    /// Empty for what only fills the summary ("order").
    std::function<Observer(const ObserveContext&)> bind;
};

const std::vector<ObservableEntry>& observableEntries();
const ObservableEntry* findObservable(std::string_view id);

/// The same as catalogue items.
const std::vector<CatalogItem>& observableCatalog();

}  // namespace extremal
