// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy phi(e) of a field's slope e = u_x, per length, and its derivatives.
///
///     linear       k e^2 / 2
///     fput         k (e^2 / 2 + e^3 / 6 + e^4 / 4)
///     neo-Hookean  k (l^2 - 1 - 2 ln l) / 4 with the stretch l = 1 + e; infinite where l <= 0
/// k = phi''(0): the square of the wave speed at rest.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace extremal {

struct Elasticity {
    enum class Material { linear, fput, neoHookean };
    Material material = Material::linear;
    double k = 1;

    struct Values {
        double energy, stress, modulus;
    };
    Values at(double e) const {
        switch (material) {
            case Material::linear:
                break;
            case Material::fput:
                return {k * e * e * (0.5 + e * (1.0 / 6 + e / 4)), k * e * (1 + e * (0.5 + e)),
                        k * (1 + e * (1 + 3 * e))};
            case Material::neoHookean: {
                const double l = 1 + e;
                if (!(l > 0)) {
                    constexpr double never = std::numeric_limits<double>::infinity();
                    return {never, never, never};
                }
                return {k * (e * (2 + e) - 2 * std::log1p(e)) / 4, k * (l - 1 / l) / 2,
                        k * (1 + 1 / (l * l)) / 2};
            }
        }
        return {k * e * e / 2, k * e, k};
    }
    double stress(double e) const {
        if (material == Material::linear) return k * e;
        return at(e).stress;
    }
    bool isLinear() const { return material == Material::linear; }
};

constexpr const char* name(Elasticity::Material m) {
    return m == Elasticity::Material::linear ? "linear"
           : m == Elasticity::Material::fput ? "fput"
                                             : "neo-hookean";
}
inline Elasticity::Material materialNamed(std::string_view name) {
    return name == "fput"          ? Elasticity::Material::fput
           : name == "neo-hookean" ? Elasticity::Material::neoHookean
                                   : Elasticity::Material::linear;
}

}  // namespace extremal
