// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian density of a field as a user types it, with its first and second derivatives:
///
///     L(u_1 .. u_m, u_1,t .. u_m,t, u_1,x .., [u_1,y ..], x, [y], t).
///
/// Of a component u the derivatives are u_t, u_x and, in the plane, u_y. It is differentiated symbolically
/// and flattened to tapes. An evaluation takes the arguments in the order above, argument k of component c at
/// k m + c (k = 0: u, 1: u_t, 2: u_x, 3: u_y), then x, [y], t.
///
/// A density sum_c [u_c,t^2/2 - c_c^2 |grad u_c|^2/2] - W(u) is recognised symbolically.
///
/// Errors: InvalidScene with pointers below /model ("/lagrangian/kinetic", "/parameters/k"); what is wrong
/// inside a formula is shown with a caret under the place.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/core/value.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal {

/// The keys of a model that has one.
FieldInfo densityField(const char* example);
FieldInfo densityParametersField();

/// What a density of the usual kind is made of.
struct UsualDensity {
    std::vector<double> speeds;  ///< c_c > 0
    std::string potential;       ///< W as the key /model/potential says it
    double mass = 1;             ///< of the potential klein-gordon
};

/// Which argument of a component.
struct DensityArgument {
    static constexpr int value = 0, velocity = 1, slopeX = 2, slopeY = 3;
};

class FieldDensity {
public:
    /// Of the keys lagrangian and parameters. `directions`: 1, or 2 for the plane.
    FieldDensity(const Settings& settings, const std::vector<std::string>& components, int directions);

    int components() const { return components_; }
    int directions() const { return directions_; }
    /// Arguments per component, 2 + directions.
    int kinds() const { return 2 + directions_; }
    /// Arguments that L is differentiated by.
    int arguments() const { return components_ * kinds(); }
    /// These, x, [y] and t.
    int inputs() const { return arguments() + directions_ + 1; }

    /// Of inputs() numbers.
    double value(const double* at) const;
    /// Fills arguments() numbers; returns L.
    double gradient(const double* at, double* slope) const;
    /// The same, and the lower triangle of the second derivatives row by row.
    double jet(const double* at, double* slope, double* curvature) const;
    /// The first derivatives at eight places together.
    void gradient(const Lanes* at, Lanes* slope) const;

    bool isTimeDependent() const { return isTimeDependent_; }
    /// Whether it depends on x (0) or y (1) itself.
    bool dependsOnPlace(int direction) const { return dependsOnPlace_[static_cast<std::size_t>(direction)]; }
    bool dependsOnPlace() const { return dependsOnPlace(0) || (directions_ > 1 && dependsOnPlace(1)); }
    /// Whether it does not depend on component c but through its derivatives.
    bool isCyclic(int c) const { return isCyclic_[static_cast<std::size_t>(c)]; }
    /// Whether dL/du_t depends on t itself.
    bool isMomentumTimeDependent() const { return isMomentumTimeDependent_; }
    /// Whether it depends on argument k m + c.
    bool dependsOn(int argument) const { return dependsOn_[static_cast<std::size_t>(argument)]; }
    /// What keeps it from being sum_c m_c(x, y) u_c,t^2/2 - V(u, grad u, x, y, t), for which a step may be
    /// explicit; empty: nothing.
    const std::string& implicitBecause() const { return implicitBecause_; }
    /// The field equation is linear: all second derivatives depend on place and time alone.
    bool isLinear() const { return isLinear_; }

    /// Where it is of the usual kind; else nothing, and why.
    const std::optional<UsualDensity>& usual() const { return usual_; }
    const std::string& unusual() const { return unusual_; }
    /// The parameters, for expressions of initial data.
    const std::vector<std::pair<std::string, double>>& parameters() const { return parameters_; }

private:
    void recognise(const std::string& text, const std::vector<std::string>& names);

    int components_, directions_;
    std::vector<std::pair<std::string, double>> parameters_;
    typed::Tape value_, gradient_, jet_;
    bool isTimeDependent_ = false, isMomentumTimeDependent_ = false, isLinear_ = false;
    std::vector<bool> dependsOnPlace_, isCyclic_, dependsOn_;
    std::string implicitBecause_;
    std::optional<UsualDensity> usual_;
    std::string unusual_;
};

/// Whether the settings of a model have a density.
bool hasDensity(const Settings& model);

/// The settings of the same model with a potential and wave speeds in place of a density of the usual kind.
Settings withPotential(const Settings& model, const UsualDensity& usual);

}  // namespace extremal
