// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/multiprecision/float128.hpp>

#include "engine/integrator/galerkin_step_build.hpp"

namespace extremal {

template class GalerkinStep<boost::multiprecision::float128, 1>;
template class GalerkinStep<boost::multiprecision::float128, 2>;

}  // namespace extremal
