// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose steps are made of a table: space x quadrature.
#pragma once

#include "engine/family/discretization.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

template <class T>
struct Table;
class OscillatorStep;

/// A family without it has steps of its own, which no table describes.
struct Tables {
    static constexpr PartInfo part{"tables", "steps made of tables", false};
    /// Whether a discretization has one table for every system and step.
    bool (*isOne)(const Discretization&) = nullptr;
    /// The one table of a space and a rule, where neither the system nor the step is in it.
    Table<double> (*make)(const Settings& space, const Settings& quadrature) = nullptr;
    /// The step on the harmonic oscillator in quadruple precision, of one with one table. Throws InvalidScene
    /// where its functions are not known to it.
    OscillatorStep (*oscillator)(const Settings& space, const Settings& quadrature) = nullptr;
};

}  // namespace extremal
