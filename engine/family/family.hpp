/// Spaces whose pairs have a description, a rule or an integrator of their own. What is not in a family has
/// one table for every system and step (table_of.hpp) and runs in GalerkinStep.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/integrator/galerkin_step.hpp"
#include "engine/family/scheme.hpp"

namespace extremal {

struct PairFamily {
    bool (*has)(const Settings& space);
    bool hasOneTable;  ///< none where its functions depend on the step or the system
    PairProperties (*describe)(const Settings& space, const Settings& quadrature);  ///< null: from the table
    Settings (*complete)(const Settings& space,
                         const Settings& quadrature);  ///< the rule's default keys; null: the usual ones
    std::unique_ptr<Integrator> (*make)(const System&, const Discretization&, const Clock&,
                                        const SolverPolicy&);
};

/// Null where the space is in none.
const PairFamily* familyOf(const Settings& space);

/// One table for all coordinates or one for each, for a step size.
using TablesOfStep = std::function<std::vector<Table<double>>(double step)>;
/// GalerkinStep as an Integrator.
std::unique_ptr<Integrator> makeGalerkin(const System& system, TablesOfStep tables, double step,
                                         const SolverPolicy& policy);

}  // namespace extremal
