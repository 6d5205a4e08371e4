// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps of the elements of an asynchronous scheme: one entry for each element of its mesh.
#pragma once

#include <vector>

namespace extremal {

struct ElementClocks {
    std::vector<double> x;        ///< of its middle
    std::vector<double> step;     ///< its own
    std::vector<double> updates;  ///< how often it has acted since the start of the run
    std::vector<double> energy;   ///< at the end of the run: its potential energy and the kinetic energy of
                                  ///< its part of the masses of its nodes
};

}  // namespace extremal
