// SPDX-License-Identifier: GPL-3.0-or-later
/// The catalogue's entries of kicks and drifts in turn, and of split steps of wave functions.
#pragma once

#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/step/partitioned.hpp"

namespace extremal {

/// Of these stages, each step. Symplectic whatever the stages; stable on the oscillator up to step *
/// frequency = 2, which all four compositions of one kick and one drift have in common.
BaselineEntry partitionedBaseline(CatalogItem item, std::vector<PartitionedStage> stages);

/// Of a splitting of order splitting.order; Nystrom ones are for separable systems.
BaselineEntry splittingBaseline(std::string id, std::string title, std::string description,
                                const Splitting& splitting);

/// Of a splitting for wave functions alone.
BaselineEntry waveSplittingBaseline(std::string id, std::string title, std::string description,
                                    const Splitting& splitting);

/// A split step; throws InvalidScene where H is not split.
std::unique_ptr<Integrator> makeWaveSplittingBaseline(const System& system, double step,
                                                      const Splitting& splitting);

}  // namespace extremal
