// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data of a field: a named profile, expressions, or values; and the exact solution that they start,
/// where one is known.
///
///     kink, antikink {v, x0}       sine-Gordon 4 atan exp(+-g), phi-4 tanh(+-g / sqrt 2),
///                                  g = gamma (x - x0 - v t), gamma = 1/sqrt(1 - v^2)
///     kink-kink {v}                sine-Gordon 4 atan(v sinh(gamma x) / cosh(gamma v t))
///     kink-antikink {v}            sine-Gordon 4 atan(sinh(gamma v t) / (v cosh(gamma x)))
///     breather {omega, phase, x0}  sine-Gordon 4 atan(k/omega sin(omega t + phase) / cosh(k (x - x0))),
///                                  k = sqrt(1 - omega^2)
///     plane-wave {wave_number, amplitude, phase}  amplitude cos(K x - W t + phase), K = 2 pi wave_number /
///                                  length, W^2 = c^2 K^2 + m^2: wave and Klein-Gordon equation, periodic
///     front {v, x0, width}         tanh((x - x0 - v t) / width)
///     u, u_t                       expressions in x; of the wave equation with u_t = 0 d'Alembert's solution
///     exact                        an expression in x and t
///     values {u, u_t}              at the nodes
///     values {x, u, u_t}           at places, smooth between them: on any mesh
/// With a wave speed c lengths and speeds of the first four count in units of c. Collisions are about the
/// middle of the domain. Exact solutions of kinks and breathers are those of the whole line.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/field/problem.hpp"

namespace extremal {

namespace typed {
class TypedFunction;
}

struct FieldProfile {
    /// u and u_t at (x, t). Where the profile is not exact t is that of the start. Empty: values alone.
    std::function<void(double x, double t, double* u, double* v)> at;
    bool isExact = false;
    /// Given at all times by the user: schemes of two levels start from both of their first levels.
    bool givesLevels = false;
    std::vector<double> u, v;  ///< at the nodes, where values are given
    /// Of an exact solution that is typed: u in (x, t), for its residual.
    std::shared_ptr<const typed::TypedFunction> formula = {};
};

/// The keys of /initial of a field.
std::vector<FieldInfo> fieldStartFields();

/// The profiles that have names, with their keys.
std::vector<CatalogItem> fieldProfiles();

/// `start`: the time of expressions in x alone; profiles by name have their own. Throws InvalidScene with
/// pointers relative to /initial, also where a profile solves another problem.
FieldProfile fieldProfile(const Settings& initial, const FieldProblem& problem, double start);

/// An exact profile as a solution at all places.
ExactSolution::AtPlaces atPlacesOf(const FieldProfile& profile);

/// The state of the profile at time t (FieldProblem): values at the nodes, v = 0 where they are fixed.
std::vector<double> fieldState(const FieldProfile& profile, const FieldProblem& problem, double t);

}  // namespace extremal
