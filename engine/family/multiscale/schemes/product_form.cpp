// SPDX-License-Identifier: GPL-3.0-or-later
/// The multiscale scheme as printed, to see it fail: amplitudes are multiples of the slow parts.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry product_form() {
    SchemeEntry e;
    e.item = {"product-form",
              "product form",
              "The printed multiscale space, a polynomial times an oscillation: an experiment that fails.",
              {},
              {},
              "a fast frequency of its own"};
    e.source = "Leok 2004, sec. 7.2, as printed";
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"oscillatory-product",
                                {{"omega", "model"},
                                 {"degree", 4.0},
                                 {"frequency", "fixed"},
                                 {"fast", Value(Value::Object{{"degree", 2.0}})}},
                                {}};
        discretization.quadrature = {"auto", {}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
