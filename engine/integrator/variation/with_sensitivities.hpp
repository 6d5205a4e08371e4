// SPDX-License-Identifier: GPL-3.0-or-later
/// An integrator that carries derivatives of its state by numbers mu along:
///
///     S_{k+1} = M_k S_k + N_k,    S = dx/dmu,   M_k = dx_{k+1}/dx_k,   N_k = dx_{k+1}/dmu of one step,
///
/// exactly for the discrete motion. Neither families nor baselines know of N: `along` is the same scheme on a
/// system that has the parameters as further coordinates u which stay where they are (very large masses, or
/// no momentum in the Hamiltonian), and the tangent map of its step is
///
///     (dq, du, dp, 0) -> (M (dq, dp) + N du, du, ...).
///
/// It takes each step once more, from the state of the scheme itself, so that the run has the same bits with
/// and without. Where only initial values are varied, `along` is null, and the tangent map is that of the
/// scheme. Columns are quantities `sensitivity.<name of the number>.<name of the entry of the state>`; they
/// are unknown from where a step did more than go on, has no tangent map, or ends elsewhere on `along`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/integrator/integrator.hpp"

namespace extremal {

/// A number by which the state is differentiated.
struct SensitivityColumn {
    std::string name;
    std::vector<double> start;       ///< dx/dmu at the start, as many as entries of the state
    std::vector<double> parameters;  ///< du/dmu, one for each coordinate that `along` has besides
};

/// Takes over both. `parameters`: u, whose coordinates are behind those of the scheme. `entries`: the names
/// of those of the state, x = (q, p). The scheme that is differentiated must have a tangentSize() of as many.
std::unique_ptr<Integrator> withSensitivities(std::unique_ptr<Integrator> scheme,
                                              std::unique_ptr<Integrator> along,
                                              std::vector<double> parameters,
                                              std::vector<SensitivityColumn> numbers,
                                              const std::vector<std::string>& entries);

}  // namespace extremal
