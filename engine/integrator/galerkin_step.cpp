// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/galerkin_step_build.hpp"

namespace extremal {

template class GalerkinStep<double, 1>;
template class GalerkinStep<double, 2>;
template class GalerkinStep<double, 3>;
template class GalerkinStep<double, 4>;
template class GalerkinStep<double, Eigen::Dynamic>;

}  // namespace extremal
