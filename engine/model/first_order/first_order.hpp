// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of first order, x' = f(x), of problems whose variables are not coordinates and momenta: what a
/// one-form (one_form.hpp) or a bracket (poisson.hpp) makes of a Hamiltonian.
///
/// An even number of variables, so that methods for Hamilton's equations take the first half of them in the
/// place of q and the other half in that of p, whatever they are.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <utility>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

struct System;

/// With buffers of their own.
class FirstOrderEquations {
public:
    virtual ~FirstOrderEquations() = default;
    /// x' = f(x); false where it is not defined.
    virtual bool rate(const double* x, double* dx) = 0;
    /// df/dx, entry (i, k); null where it is not defined.
    virtual const Eigen::MatrixXd* jacobian(const double* x) = 0;
};

/// How they are made, and the energy, with its gradient unless that is null.
struct FirstOrder {
    int variables = 0;
    std::function<std::unique_ptr<FirstOrderEquations>()> make;
    std::function<double(const double* x, double* gradient)> energy;
};

/// Those of a part: with `Equations` made of it, and the calls of its energy.
template <class Equations, class Of>
FirstOrder firstOrderBy(const Of& of) {
    return {of.variables, [of] { return std::make_unique<Equations>(of); },
            [of](const double* x, double* gradient) {
                double value = 0;
                of.energy(of.model.get(), x, &value, gradient, nullptr);
                return value;
            }};
}

/// Equations in a value: a copy has buffers of its own, for another thread.
class OwnFirstOrder {
public:
    explicit OwnFirstOrder(FirstOrder of) : of_(std::move(of)), equations_(of_.make()) {}
    OwnFirstOrder(const OwnFirstOrder& other) : OwnFirstOrder(other.of_) {}
    OwnFirstOrder& operator=(const OwnFirstOrder& other) {
        of_ = other.of_;
        equations_ = of_.make();
        return *this;
    }
    FirstOrderEquations* operator->() const { return equations_.get(); }

private:
    FirstOrder of_;
    std::unique_ptr<FirstOrderEquations> equations_;
};

/// Whether a system has no coordinates, but a part that gives such equations.
bool isFirstOrder(const System& system);
/// These; empty where it has none of those parts.
FirstOrder firstOrderOf(const System& system);
/// Problems with equations of first order, Hamilton's among them.
Takes firstOrderProblems();

/// f behind the calls of methods for first-order equations (engine/baseline). Null: `jet`, `velocity` and
/// `gradient`.
Mechanics<double> flowOf(const FirstOrder& of);
/// The equations behind what flowOf() has made; null for others.
const FirstOrder* firstOrderOf(const Mechanics<double>& mechanics);
/// x' = f(x) as the equations of H = lambda . f(x), which is linear in its momenta lambda. Started with
/// lambda = 0 the momenta stay 0, and are not evaluated.
PhaseMechanics fieldOf(const FirstOrder& of);

/// The largest frequency of small motions about x.
double fastestOf(const FirstOrder& of, const double* x);

}  // namespace extremal
