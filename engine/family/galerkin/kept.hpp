// SPDX-License-Identifier: GPL-3.0-or-later
/// Polynomials that keep invariants in place of the symplectic form: x = (q, p) of degree s, tested by those
/// of degree s - 1 (phase/kept_step.hpp).
#pragma once

#include "engine/family/parts/test_space.hpp"

namespace extremal::galerkin {

TestSpace keptTest();

}  // namespace extremal::galerkin
