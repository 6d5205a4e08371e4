// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential W(u_1, .., u_m) of a field with one component or more, at many places at once.
///
///     one component          as model/field/potential.hpp: by name or an expression in u and mass
///     none                   0
///     klein-gordon           mass^2 |u|^2/2,                             |u|^2 = sum of u_c^2
///     klein-gordon-complex   mass^2 |u|^2/2 + lambda |u|^4/4             two components; default lambda 1
///     q-ball                 mass^2 |u|^2/2 - a |u|^4/4 + b |u|^6/6      two components; default a 1, b 1/4
///     anything else          an expression in the names of the components and mass
/// The last two names with numbers of their own are objects, {"name": "q-ball", "a": 1, "b": 0.25}.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/model/field/potential.hpp"

namespace extremal {

class JointPotential {
public:
    static constexpr std::size_t mostComponents = 8;

    /// Of one component.
    JointPotential(FieldPotential single);
    /// Of components with these names. Throws InvalidScene with pointers that start with `pointer`.
    JointPotential(const Value& given, double mass, std::vector<std::string> names,
                   const std::string& pointer);

    std::size_t components() const { return names_.size(); }
    /// W' is linear in u, and each component moves by itself.
    bool isLinear() const;
    bool isZero() const;
    double mass() const { return mass_; }

    /// Of n places, with `stride` numbers from one component to the next: W, n numbers; its gradient,
    /// component after component; the second derivatives W_cd, d <= c, row c (c + 1)/2 + d of them. Null: not
    /// wanted.
    void evaluate(const double* u, std::size_t n, std::size_t stride, double* W, double* slope,
                  double* curvature) const;
    /// Of one component, as FieldPotential has it.
    std::optional<CubicSlope> cubicSlope() const {
        return kind_ == Kind::single ? single_.cubicSlope() : std::nullopt;
    }
    /// The total degree of W where it is a polynomial of degree 12 at most, 0 where it is none: of typed ones
    /// seen along lines in general directions.
    int degree() const;
    /// The mean of W_cc for each component, over |u_d| <= 1; 0 where it is not positive and finite.
    std::vector<double> meanCurvatures() const;
    /// The largest eigenvalue of the second derivatives, seen at places of the box of the extremes; of no
    /// component 0.
    double largestCurvature(const std::vector<double>& low, const std::vector<double>& high) const;
    /// Whether W does not change when components a and b are turned into each other (of typed ones: at
    /// probes, to 1e-12 of the terms).
    bool turns(std::size_t a, std::size_t b) const;

    /// Potentials with names.
    static const std::vector<std::string>& names();

private:
    enum class Kind { single, radial, typed };
    void readNamed(const std::string& name, const Value& given, const std::string& pointer);
    void evaluateRadial(const double* u, std::size_t n, std::size_t stride, double* W, double* slope,
                        double* curvature) const;
    void evaluateTyped(const double* u, std::size_t n, std::size_t stride, double* W, double* slope,
                       double* curvature) const;

    Kind kind_ = Kind::single;
    std::vector<std::string> names_;
    double mass_ = 1;
    FieldPotential single_;
    double quadratic_ = 0, quartic_ = 0, sextic_ = 0;  ///< radial: q |u|^2/2 + r |u|^4/4 + s |u|^6/6
    std::shared_ptr<const typed::TypedFunction> typed_;
};

}  // namespace extremal
