// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential W(u) of a field, at many places at once: sine-Gordon, phi-4, Klein-Gordon, none, or typed.
///
///     none          0
///     klein-gordon  m^2 u^2 / 2
///     sine-gordon   1 - cos u
///     phi4          (u^2 - 1)^2 / 4
///     anything else an expression in u and mass
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace extremal {

namespace typed {
class TypedFunction;
}

/// The degree of a polynomial f(s) of degree 12 at most, where Chebyshev's coefficients of its values on |s|
/// < 2 end there, to 1e-13; 0: it is no such polynomial.
int polynomialDegree(const std::function<double(double)>& f);

/// W' = u (linear + cubic u^2).
struct CubicSlope {
    double linear = 0, cubic = 0;
};

class FieldPotential {
public:
    enum class Kind { none, kleinGordon, sineGordon, phi4, typed };

    FieldPotential() = default;
    /// Throws InvalidScene with the pointer.
    FieldPotential(const std::string& text, double mass, const std::string& pointer);

    Kind kind() const { return kind_; }
    double mass() const { return mass_; }
    /// W' is linear in u: the field equation is.
    bool isLinear() const { return kind_ == Kind::none || kind_ == Kind::kleinGordon; }

    /// Of n values u: W, W' and W''. Null: not wanted.
    void evaluate(const double* u, std::size_t n, double* W, double* slope, double* curvature) const;
    /// W' of potentials with a name, where it is a cubic.
    std::optional<CubicSlope> cubicSlope() const;
    /// W at one value.
    double operator()(double u) const;
    /// The degree of W where it is a polynomial of degree 12 at most, else 0.
    int degree() const;
    /// The mean of W'' over |u| <= 1, by 64 places; 0 where it is not positive and finite.
    double meanCurvature() const;
    /// Largest W'' from `low` to `high`, seen at 400 places.
    double largestCurvature(double low, double high) const;

private:
    Kind kind_ = Kind::none;
    double mass_ = 1;
    std::shared_ptr<const typed::TypedFunction> typed_;
};

}  // namespace extremal
