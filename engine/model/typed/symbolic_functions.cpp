// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/symbolic_functions.hpp"

namespace extremal::typed {

namespace {

GiNaC::ex magnitudeDerivative(const GiNaC::ex& x, unsigned) { return signum(x); }
GiNaC::ex flat(const GiNaC::ex&, unsigned) { return 0; }
GiNaC::ex flatInBoth(const GiNaC::ex&, const GiNaC::ex&, unsigned) { return 0; }
GiNaC::ex errorFunctionDerivative(const GiNaC::ex& x, unsigned) {
    return 2 / GiNaC::sqrt(GiNaC::Pi) * GiNaC::exp(-x * x);
}
GiNaC::ex complementaryErrorFunctionDerivative(const GiNaC::ex& x, unsigned) {
    return -errorFunctionDerivative(x, 0);
}
GiNaC::ex hypotenuseDerivative(const GiNaC::ex& a, const GiNaC::ex& b, unsigned which) {
    return (which == 0 ? a : b) / hypotenuse(a, b);
}
/// That of the branch: chosen, and not a sum of products with 0, as the other one need not be finite.
GiNaC::ex chosen(const GiNaC::ex& condition, const GiNaC::ex& a, const GiNaC::ex& b) {
    return a.is_equal(b) ? a : choice(condition, a, b);
}
GiNaC::ex choiceDerivative(const GiNaC::ex& c, const GiNaC::ex& a, const GiNaC::ex& b,
                           const GiNaC::symbol& s) {
    return chosen(c, a.diff(s), b.diff(s));
}
GiNaC::ex greaterDerivative(const GiNaC::ex& a, const GiNaC::ex& b, const GiNaC::symbol& s) {
    return chosen(isLess(a, b), b.diff(s), a.diff(s));
}
GiNaC::ex smallerDerivative(const GiNaC::ex& a, const GiNaC::ex& b, const GiNaC::symbol& s) {
    return chosen(isLess(b, a), b.diff(s), a.diff(s));
}
GiNaC::ex lookedUpDerivative(const GiNaC::ex& x, const GiNaC::ex& table, const GiNaC::ex& order,
                             const GiNaC::ex& degree, const GiNaC::symbol& s) {
    if (order.is_equal(degree)) return 0;
    return lookedUp(x, table, order + 1, degree) * x.diff(s);
}

}  // namespace

REGISTER_FUNCTION(magnitude, derivative_func(magnitudeDerivative))
REGISTER_FUNCTION(signum, derivative_func(flat))
REGISTER_FUNCTION(errorFunction, derivative_func(errorFunctionDerivative))
REGISTER_FUNCTION(complementaryErrorFunction, derivative_func(complementaryErrorFunctionDerivative))
REGISTER_FUNCTION(floorOf, derivative_func(flat))
REGISTER_FUNCTION(ceilOf, derivative_func(flat))
REGISTER_FUNCTION(rounded, derivative_func(flat))
REGISTER_FUNCTION(heavisideOf, derivative_func(flat))
REGISTER_FUNCTION(hypotenuse, derivative_func(hypotenuseDerivative))
REGISTER_FUNCTION(isLess, derivative_func(flatInBoth))
REGISTER_FUNCTION(isLessOrEqual, derivative_func(flatInBoth))
REGISTER_FUNCTION(isEqualTo, derivative_func(flatInBoth))
REGISTER_FUNCTION(isNotEqualTo, derivative_func(flatInBoth))
REGISTER_FUNCTION(greaterOf, expl_derivative_func(greaterDerivative))
REGISTER_FUNCTION(smallerOf, expl_derivative_func(smallerDerivative))
REGISTER_FUNCTION(choice, expl_derivative_func(choiceDerivative))
REGISTER_FUNCTION(lookedUp, expl_derivative_func(lookedUpDerivative))

}  // namespace extremal::typed
