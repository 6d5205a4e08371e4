// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems and spaces of one's own. They are added before the first scene is read or catalogue asked for,
/// and are then used in scenes, lists and checks like those that are supplied:
///
///     struct Quartic {                                   // L = x_t^2 / 2 - c x^4 / 4
///         static constexpr int dimension = 1;
///         double c;
///         template <class S>
///         S lagrangian(double, const std::array<S, 1>& q, const std::array<S, 1>& v) const {
///             return square(v[0]) * 0.5 - square(square(q[0])) * (c / 4);
///         }
///     };
///     addSystem({"quartic", "quartic oscillator", {{"x"}}, {{"c", 1}}},
///               [](const Parameters& p) { return Quartic{p["c"]}; });
///
/// and in a scene "model": {"type": "quartic", "c": 2}. The Lagrangian is generic in its number S, so that
/// gradients and Hessians follow by automatic differentiation (engine/core/algebra/jet.hpp has square, sqrt,
/// sin,
/// ...).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/algebra/jet.hpp"
#include "extremal/api.hpp"

namespace extremal::api {

/// A number of a model or space: its key in scenes.
struct Parameter {
    std::string key;
    double fallback = 0;
    std::string title = {}, unit = {}, description = {};
};

/// The values of the parameters in a scene.
class EXTREMAL_API Parameters {
public:
    explicit Parameters(std::vector<std::pair<std::string, double>> values) : values_(std::move(values)) {}
    /// Throws std::out_of_range.
    double operator[](std::string_view key) const;

private:
    std::vector<std::pair<std::string, double>> values_;
};

/// A generalised coordinate: state columns "q.<name>" and "p.<name>".
struct CoordinateInfo {
    std::string name, title = {}, unit = {}, momentumUnit = {};
};

struct SystemInfo {
    std::string id, title;
    std::vector<CoordinateInfo> coordinates;
    std::vector<Parameter> parameters = {};
    std::string description = {};
    bool isTimeDependent = false;  ///< its energy is not conserved, and has no error
};

/// What a Lagrangian is behind plain calls, one per node of a step; d = dimension. q and v have d entries,
/// the gradient 2d (by q, then by v), the Hessian 2d x 2d by rows in the same order.
struct LagrangianCalls {
    int dimension = 0;
    void (*jet)(const LagrangianCalls*, double t, const double* q, const double* v, double* value,
                double* gradient, double* hessian) = nullptr;
    void (*gradient)(const LagrangianCalls*, double t, const double* q, const double* v,
                     double* gradient) = nullptr;
};

namespace detail {

template <class Model>
struct BoundModel : LagrangianCalls {
    static constexpr int d = Model::dimension;
    static constexpr std::size_t n = static_cast<std::size_t>(d);
    Model model;

    explicit BoundModel(Model m) : LagrangianCalls{d, &callJet, &callGradient}, model(std::move(m)) {}

    template <class S>
    static S evaluate(const LagrangianCalls* self, double t, const double* q, const double* v) {
        std::array<S, n> Q, V;
        for (int i = 0; i < d; ++i) {
            Q[static_cast<std::size_t>(i)] = S::variable(q[i], i);
            V[static_cast<std::size_t>(i)] = S::variable(v[i], d + i);
        }
        return static_cast<const BoundModel*>(self)->model.lagrangian(t, Q, V);
    }
    static void callJet(const LagrangianCalls* self, double t, const double* q, const double* v,
                        double* value, double* gradient, double* hessian) {
        const auto L = evaluate<Jet<double, 2 * d>>(self, t, q, v);
        *value = L.value;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 2 * n; ++i) {
            gradient[i] = L.g[i];
            for (std::size_t j = 0; j <= i; ++j, ++k)
                hessian[i * 2 * n + j] = hessian[j * 2 * n + i] = L.h[k];
        }
    }
    static void callGradient(const LagrangianCalls* self, double t, const double* q, const double* v,
                             double* gradient) {
        const auto L = evaluate<Dual<double, 2 * d>>(self, t, q, v);
        for (std::size_t i = 0; i < 2 * n; ++i) gradient[i] = L.g[i];
    }
};

}  // namespace detail

/// Adds a system; `make` returns its calls for the parameters of a scene. Throws std::logic_error where the
/// id is taken, no system has such a dimension (1 to 64), or the catalogues are in use already.
EXTREMAL_API void addSystemCalls(
    const SystemInfo& info, std::function<std::shared_ptr<const LagrangianCalls>(const Parameters&)> make);

/// The same for a model with `static constexpr int dimension` and a generic lagrangian(t, q, v);
/// `make(parameters)` returns it.
template <class Make>
void addSystem(const SystemInfo& info, Make make) {
    addSystemCalls(info, [make](const Parameters& parameters) -> std::shared_ptr<const LagrangianCalls> {
        using Model = decltype(make(parameters));
        return std::make_shared<const detail::BoundModel<Model>>(make(parameters));
    });
}

/// A finite-dimensional space of curves on [0, 1]: its basis functions. It must contain constants, and the
/// values at both ends must be free.
struct Basis {
    int size = 0;    ///< number of basis functions
    int degree = 0;  ///< highest degree of polynomials contained
    /// value[a] = phi_a(tau), derivative[a] = phi_a'(tau), by tau; also for tau outside [0, 1].
    std::function<void(double tau, std::span<double> value, std::span<double> derivative)> evaluate;
};

struct SpaceInfo {
    std::string id, title;
    std::vector<Parameter> parameters = {};
    std::string description = {};
};

/// Adds a space: "space": {"type": ID, ...}. Throws std::logic_error as addSystemCalls.
EXTREMAL_API void addSpace(const SpaceInfo& info, std::function<Basis(const Parameters&)> make);

}  // namespace extremal::api
