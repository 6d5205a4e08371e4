/// Symplectic Euler and Störmer-Verlet as products of four half-maps, for any Hamiltonian.
///
///     kickImplicit(s):  p <- p + s pdot(q, p_new)      kickExplicit(s):  p <- p + s pdot(q, p)
///     driftImplicit(s): q <- q + s qdot(q_new, p)      driftExplicit(s): q <- q + s qdot(q, p)
/// For separable systems all are explicit and the implicit ones are the explicit ones. Else the implicit ones are solved
/// by fixed-point iteration to round-off (Hairer, Lubich, Wanner 2006, VI.3, (3.3) and (3.4)).
#pragma once

#include <memory>
#include <vector>

#include "engine/baseline/catalog.hpp"

namespace extremal {

enum class HalfMap { kickImplicit, kickExplicit, driftImplicit, driftExplicit };

struct PartitionedStage {
    HalfMap map;
    double fraction;  ///< of the step
};

/// A method that applies these stages in turn, each step.
std::unique_ptr<Integrator> makePartitioned(const Mechanics<double>& mechanics, const Clock& clock,
                                            const std::vector<PartitionedStage>& stages);

/// The catalogue's entry of such a method. Symplectic whatever the stages; stable on the oscillator up to step * frequency
/// = 2, which all four compositions of one kick and one drift have in common.
BaselineEntry partitionedBaseline(CatalogItem item, std::vector<PartitionedStage> stages);

}  // namespace extremal
