// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/multiprecision/float128.hpp>

#include "engine/core/algebra/dense_build.hpp"

namespace extremal::dense {

using Quad = boost::multiprecision::float128;

template class Lu<Quad>;
template Matrix<Quad> solve<Quad>(Given<Quad>, Given<Quad>);
template Matrix<Quad> inverse<Quad>(Given<Quad>);
template Matrix<Quad> leastSquares<Quad>(Given<Quad>, Given<Quad>);
template Matrix<Quad> product<Quad>(Given<Quad>, Given<Quad>);
template Qr<Quad> qr<Quad>(Given<Quad>);

}  // namespace extremal::dense
