// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems whose Lagrangian is evaluated in Python (extremal.add_system).
#pragma once

#include <pybind11/pybind11.h>

namespace extremal::python {

void bindOwnSystem(pybind11::module_& m);

/// Throws what a Lagrangian has thrown since it was asked last. With the lock of Python.
void rethrowOfSystem();

}  // namespace extremal::python
