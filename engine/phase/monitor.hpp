// SPDX-License-Identifier: GPL-3.0-or-later
/// Monitors: functions g(q, p) > 0 that steps follow, dt = g dtau, with equal steps dtau.
///
/// A step is dtau g, and dtau is chosen so that the first one has the length that is asked for: only ratios
/// of g count. Typed ones are formulas in coordinates and momenta, differentiated symbolically. Others are
/// made from the Hamiltonian, with f = (H_p, -H_q):
///     auto       |B|^(-1/2), B the block of q in (df/dx)^2: for p^2/(2m) + V it is -V''/m, so that the step
///                is a part of a local period, r^(3/2) in the field of a mass;
///     action     rho^(-1/3), rho = |H_pp| |H_q|^2 + 2 |H_pq| |H_q| |H_p| + |H_qq| |H_p|^2: the density of
///                the local action error with every term taken positive, so that it has no zeros on the way;
///     arclength  1/|f|: equal lengths in phase space;
///     logarithmic  1/(-V) of p^2/(2m) + V, of which steps can be explicit (logarithmic.hpp).
/// |.| of matrices is Frobenius' norm. With a longest step, 1/g is 1/g + 1/g_max.
///
/// The gradients of the first two are differences of order 6 over lengths of the motion itself. In a step the
/// gradient of g has the factor H - H_0, which is small, and so has their error (monitored.hpp).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/graph.hpp"

namespace extremal {

/// Called by several threads at a time.
class Monitor {
public:
    virtual ~Monitor() = default;
    /// g at (q, p); its gradient, 2d numbers (q, then p), unless null; its Hessian, 2d x 2d, unless null. A
    /// Hessian of a monitor that has none is 0.
    virtual void evaluate(const double* q, const double* p, double* value, double* gradient,
                          double* hessian) const = 0;
    virtual bool hasHessian() const { return true; }
    /// Adds g to a graph, with these nodes for q, then p; nothing where it is no formula.
    virtual std::optional<typed::GraphFunction> addTo(typed::Graph& /*to*/,
                                                      const std::vector<int>& /*variables*/) const {
        return {};
    }
    double operator()(const double* q, const double* p) const {
        double value = 0;
        evaluate(q, p, &value, nullptr, nullptr);
        return value;
    }
};

/// Typed ones first, then "auto", "action", "arclength" and "logarithmic", with their keys.
const std::vector<CatalogItem>& monitorCatalog();
/// Whether steps that follow it have the energy of logarithmic.hpp.
bool isLogarithmic(const Settings& monitor);

/// The names that a typed monitor may use besides those of its own definitions: coordinates and momenta.
std::vector<std::string> monitorNames(const std::vector<Coordinate>& coordinates);

/// Of a system with the Hamiltonian H; the settings are checked and have the values of parameters in place.
/// Throws InvalidScene, with pointers below "/monitor".
std::shared_ptr<const Monitor> makeMonitor(const Settings& settings, const System& system,
                                           const PhaseMechanics& H);

/// 1/g + 1/most in place of 1/g.
std::shared_ptr<const Monitor> boundedMonitor(std::shared_ptr<const Monitor> monitor, int dimension,
                                              double most);

}  // namespace extremal
