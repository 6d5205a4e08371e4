// SPDX-License-Identifier: GPL-3.0-or-later
/// Methods for wave functions with an interaction, beside splittings.
#include "engine/baseline/wave/coupled_waves.hpp"

#include <limits>
#include <string>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/family/wave/wave_interacting.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal::baselines {
namespace {

template <class Make>
BaselineEntry coupledWave(const std::string& id, const std::string& title, const char* description,
                          Claims claims, Make made) {
    BaselineEntry e;
    e.item = {id, title, description, {}, std::move(claims), "a wave function"};
    e.takes = Takes::only<Wave, Interaction>();
    e.make = [id, made](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        requireSplit(system, "/baseline", id, "schrodinger-gauss-2 or crank-nicolson");
        return made(system.hamiltonian(), couplingOf(system.parts).g, options.step);
    };
    return e;
}

BaselineEntry midpoint(const char* id, const char* title, const char* description, Claims claims,
                       CoupledMidpoint form) {
    BaselineEntry e = coupledWave(
        id, title, description, std::move(claims),
        [form](auto h, double g, double step) { return makeCoupledMidpoint(std::move(h), g, step, form); });
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    return e;
}

BaselineEntry exponential(const char* id, const char* title, const char* description, ExponentialForm form) {
    return coupledWave(
        id, title, description, Claims{4, false, false, {}},
        [form](auto h, double g, double step) { return makeExponentialWave(std::move(h), g, step, form); });
}

/// Polynomials of degree s in time with an exact integral over time, of V that does not depend on it.
BaselineEntry exactInTime(int s) {
    const std::string id = "energy-" + std::to_string(s);
    // What is observed is the energy per norm squared, which changes with the norm.
    const Claims claims{2 * s, true, false, {"norm² times energy"}};
    BaselineEntry e =
        coupledWave(id, "energy by degree " + std::to_string(s) + " in time",
                    "Continuous Petrov-Galerkin: the integral over time is exact; norm² times energy, order "
                    "2s, not symplectic.",
                    claims, [s](auto h, double g, double step) {
                        // Counted from elsewhere, E - Ec <1> would stay.
                        return makeInteractingWave(std::move(h), {g, 0}, step, 0, s, 0, 0, InTime::exact);
                    });
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(ClaimsOnSystem{[claims](const System& system) {
        if (couplingOf(system.parts).g != 0) return claims;
        return Claims{claims.order, true, true, {"norm", "energy"}};  // without: Gauss
    }});
    return e;
}

}  // namespace

std::vector<BaselineEntry> coupled_waves() {
    Claims besse{2, true, false, {"norm"}};
    besse.isOneStep = false;  // the density is carried on
    BaselineEntry mean =
        midpoint("delfour-fortin-payre", "Delfour-Fortin-Payre",
                 "Crank-Nicolson with the mean of the densities at both ends: norm and energy, order 2.",
                 Claims{2, true, false, {"norm", "energy"}}, CoupledMidpoint::delfourFortinPayre);
    mean.parts.set(ClaimsOnSystem{[](const System& system) {
        return Claims{2, true, couplingOf(system.parts).g == 0, {"norm", "energy"}};  // without: Cayley's map
    }});
    return {
        midpoint("besse", "Besse relaxation",
                 "The density lives between the steps, so that each is linear; norm, and an energy of two "
                 "levels.",
                 besse, CoupledMidpoint::besse),
        std::move(mean),
        exponential("if-rk4", "integrating factor RK4",
                    "The classical Runge-Kutta method in the frame of the free motion; explicit.",
                    ExponentialForm::integratingFactor),
        exponential("etd-rk4", "exponential time differencing RK4",
                    "Cox and Matthews: the free motion exactly, the rest by four stages; explicit.",
                    ExponentialForm::timeDifferencing),
        exactInTime(1),
        exactInTime(2),
        exactInTime(3),
    };
}

}  // namespace extremal::baselines
