// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/monitor.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "engine/core/algebra/differences.hpp"
#include "engine/core/field.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

class TypedMonitor final : public Monitor {
public:
    TypedMonitor(const Settings& settings, const System& system)
        : dimension_(system.dimension()),
          function_(textOf(settings), "/monitor/monitor", monitorNames(system.coordinates), {}) {}

    void evaluate(const double* q, const double* p, double* value, double* gradient,
                  double* hessian) const override {
        const auto n = static_cast<std::size_t>(2 * dimension_);
        thread_local std::vector<double> at, lower;
        at.assign(q, q + dimension_);
        at.insert(at.end(), p, p + dimension_);
        lower.resize(n * (n + 1) / 2);
        function_.evaluate(at.data(), value, gradient, hessian ? lower.data() : nullptr);
        if (!hessian) return;
        for (std::size_t i = 0, k = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j, ++k) hessian[i * n + j] = hessian[j * n + i] = lower[k];
    }
    std::optional<typed::GraphFunction> addTo(typed::Graph& to,
                                              const std::vector<int>& variables) const override {
        return function_.addTo(to, variables);
    }

private:
    /// With its definitions in place; later ones may use those before them.
    static std::string textOf(const Settings& settings) {
        std::string text = settings.text("monitor");
        const Value* const let = settings.find("let");
        if (!let || !let->isObject()) return text;
        const Value::Object& names = let->asObject();
        for (auto it = names.rbegin(); it != names.rend(); ++it) {
            const std::string meaning =
                it->second.isNumber() ? formatNumber(it->second.asNumber()) : it->second.asString();
            text = withNameReplaced(text, it->first, "(" + meaning + ")");
        }
        return text;
    }

    int dimension_;
    typed::TypedFunction function_;
};

/// H and its derivatives at a place, with room for them.
struct LocalMotion {
    explicit LocalMotion(const PhaseMechanics& of)
        : H(of),
          d(of.dimension),
          at(Vector::Zero(2 * d)),
          slope(at),
          rate(at),
          second(at),
          hessianAt(Vector::Constant(d, std::numeric_limits<double>::quiet_NaN())),
          hessian(Matrix::Zero(2 * d, 2 * d)),
          block(Matrix::Zero(d, d)) {}

    void place(const double* q, const double* p) {
        at << Eigen::Map<const Vector>(q, d), Eigen::Map<const Vector>(p, d);
    }
    void differentiate(bool twice) {
        H.gradient(H.model.get(), 0, at.data(), at.data() + d, slope.data());
        if (!twice || knowsHessian()) return;
        H.hessian(H.model.get(), 0, at.data(), at.data() + d, hessian.data());
        hessianAt = at.head(d);
    }
    /// Of a separable H it depends on q alone.
    bool knowsHessian() const { return H.isSeparable() && at.head(d) == hessianAt; }
    auto qq() const { return hessian.topLeftCorner(d, d); }
    auto qp() const { return hessian.topRightCorner(d, d); }
    auto pp() const { return hessian.bottomRightCorner(d, d); }

    PhaseMechanics H;
    int d;
    Vector at, slope, rate, second, hessianAt;
    Matrix hessian, block;
};

using Measure = double (*)(LocalMotion& of);

double localPeriod(LocalMotion& of) {
    of.differentiate(true);
    of.block.noalias() = of.qp().transpose().lazyProduct(of.qp().transpose());
    of.block.noalias() -= of.pp().lazyProduct(of.qq());
    return 1 / std::sqrt(of.block.norm());
}
double unsignedDensity(LocalMotion& of) {
    of.differentiate(true);
    const double forces = of.slope.head(of.d).norm(), rates = of.slope.tail(of.d).norm();
    return 1 / std::cbrt(of.pp().norm() * forces * forces + 2 * of.qp().norm() * forces * rates +
                         of.qq().norm() * rates * rates);
}

class MeasuredMonitor final : public Monitor {
public:
    MeasuredMonitor(const PhaseMechanics& H, Measure measure) : model_{H, measure}, id_(nextModelId()) {}

    bool hasHessian() const override { return false; }
    void evaluate(const double* q, const double* p, double* value, double* gradient,
                  double* hessian) const override {
        LocalMotion& local = ownBuffers<LocalMotion>(id_, model_.H);
        const int d = local.d;
        if (hessian) std::fill_n(hessian, 4 * d * d, 0.0);
        local.place(q, p);
        *value = model_.measure(local);
        if (!gradient) return;
        const std::array<double, 2> shifts = shiftsAt(local, *value);
        for (int k = 0; k < 2 * d; ++k)
            gradient[k] = slopeByDifferences(local.at(k), shifts[static_cast<std::size_t>(k < d ? 0 : 1)],
                                             [&] { return model_.measure(local); });
    }

private:
    /// A small part of the way that q and p go in the time g.
    static std::array<double, 2> shiftsAt(LocalMotion& local, double g) {
        constexpr double part = 4e-3;
        const int d = local.d;
        local.rate << local.slope.tail(d), -local.slope.head(d);
        local.second.noalias() = local.hessian.lazyProduct(local.rate);  // J of it: q'', then p''
        const auto shift = [&](double speed, double change, double size) {
            const double way = part * (speed * g + change * g * g);
            return way > 0 && std::isfinite(way) ? way : part * (size > 0 ? size : 1);
        };
        return {shift(local.rate.head(d).norm(), local.second.tail(d).norm(), local.at.head(d).norm()),
                shift(local.rate.tail(d).norm(), local.second.head(d).norm(), local.at.tail(d).norm())};
    }
    struct Model {
        PhaseMechanics H;
        Measure measure;
    } model_;
    long long id_;
};

/// 1/|f|: with H' and H'' alone.
class ArcLength final : public Monitor {
public:
    explicit ArcLength(const PhaseMechanics& H) : H_(H), id_(nextModelId()) {}

    bool hasHessian() const override { return false; }
    void evaluate(const double* q, const double* p, double* value, double* gradient,
                  double* hessian) const override {
        LocalMotion& local = ownBuffers<LocalMotion>(id_, H_);
        if (hessian) std::fill_n(hessian, 4 * local.d * local.d, 0.0);
        local.place(q, p);
        local.differentiate(gradient != nullptr);
        const double g = 1 / local.slope.norm();
        *value = g;
        if (gradient)
            Eigen::Map<Vector>(gradient, 2 * local.d).noalias() =
                (-g * g * g) * local.hessian.lazyProduct(local.slope);
    }

private:
    PhaseMechanics H_;
    long long id_;
};

/// 1/(-V), V = H(q, 0) of a separable H.
class DepthMonitor final : public Monitor {
public:
    explicit DepthMonitor(const PhaseMechanics& H) : H_(H), id_(nextModelId()) {}

    void evaluate(const double* q, const double*, double* value, double* gradient,
                  double* hessian) const override {
        LocalMotion& local = ownBuffers<LocalMotion>(id_, H_);
        const int d = local.d;
        local.at << Eigen::Map<const Vector>(q, d), Vector::Zero(d);
        const double g = -1 / H_.energy(H_.model.get(), 0, local.at.data(), local.at.data() + d);
        *value = g;
        if (!gradient) return;
        local.differentiate(hessian != nullptr);
        const auto slope = local.slope.head(d);  // g' = g^2 V', g'' = g^2 V'' + 2 g^3 V' V'
        Eigen::Map<Vector> first(gradient, 2 * d);
        first << g * g * slope, Vector::Zero(d);
        if (!hessian) return;
        Eigen::Map<Matrix> second(hessian, 2 * d, 2 * d);
        second.setZero();
        second.topLeftCorner(d, d) = g * g * local.qq() + 2 * g * g * g * slope * slope.transpose();
    }

private:
    PhaseMechanics H_;
    long long id_;
};

class BoundedMonitor final : public Monitor {
public:
    BoundedMonitor(std::shared_ptr<const Monitor> monitor, int dimension, double most)
        : monitor_(std::move(monitor)), n_(2 * dimension), most_(most) {}

    bool hasHessian() const override { return monitor_->hasHessian(); }
    void evaluate(const double* q, const double* p, double* value, double* gradient,
                  double* hessian) const override {
        monitor_->evaluate(q, p, value, gradient, hessian);
        // b = g m/(g + m), b' = (m/(g + m))^2, b'' = -2 m^2/(g + m)^3.
        const double share = 1 / (1 + *value / most_);
        const double first = share * share, second = -2 * first * share / most_;
        if (hessian) {
            Eigen::Map<Matrix> h(hessian, n_, n_);
            const Eigen::Map<const Vector> slope(gradient, n_);
            h *= first;
            h.noalias() += second * slope * slope.transpose();
        }
        if (gradient)
            for (int k = 0; k < n_; ++k) gradient[k] *= first;
        *value = bounded(*value);
    }
    std::optional<typed::GraphFunction> addTo(typed::Graph& to,
                                              const std::vector<int>& variables) const override {
        std::optional<typed::GraphFunction> g = monitor_->addTo(to, variables);
        if (!g) return {};
        const int ofShare = to.sum(1, {{g->value, 1 / most_}});  // 1/share
        g->value = to.product({{g->value}, {ofShare, -1}});
        for (int& slope : g->gradient) slope = to.product({{slope}, {ofShare, -2}});
        return g;
    }

private:
    double bounded(double g) const { return std::isinf(g) ? most_ : g / (1 + g / most_); }
    std::shared_ptr<const Monitor> monitor_;
    int n_;
    double most_;
};

constexpr const char* logarithmic = "logarithmic";

FieldInfo longestField() {
    FieldInfo longest = numberField("max", "longest step", "", 0, "The longest step, which others approach.");
    longest.fallback = {};
    longest.isOptional = longest.isMinExcluded = true;
    longest.min = 0;
    longest.example = 1;
    return longest;
}

}  // namespace

const std::vector<CatalogItem>& monitorCatalog() {
    static const std::vector<CatalogItem> catalog = [] {
        FieldInfo formula = textField("monitor", "g", nullptr,
                                      "g > 0 as an expression in coordinates, momenta (p_x) and parameters: "
                                      "steps are in proportion to it.");
        formula.example = "1";
        std::vector<CatalogItem> all = {
            {"typed",
             "typed monitor",
             "steps in proportion to a function g of coordinates and momenta",
             {formula, definitionsField("let", {}, "Names for expressions that the monitor uses.")},
             {},
             "a Lagrangian or a Hamiltonian without explicit time"},
            {"auto",
             "local period",
             "steps that are a part of the period that the forces have where the motion is",
             {},
             {},
             "a Lagrangian or a Hamiltonian without explicit time"},
            {"action",
             "action error",
             "steps that follow the density of the local action error, every term taken positive",
             {},
             {},
             "a Lagrangian or a Hamiltonian without explicit time"},
            {"arclength",
             "arc length",
             "steps of equal length in phase space: for schemes of order 2",
             {},
             {},
             "a Lagrangian or a Hamiltonian without explicit time"},
            {logarithmic,
             "potential, explicit",
             "steps in proportion to 1/(-V) in p^2/(2m) + V, which free motions between kicks take "
             "explicitly",
             {},
             {},
             "kinetic energies p^2/(2m) and a negative potential without explicit time"}};
        for (CatalogItem& item : all) item.parameters.push_back(longestField());
        return all;
    }();
    return catalog;
}

bool isLogarithmic(const Settings& monitor) { return monitor.type == logarithmic; }

std::vector<std::string> monitorNames(const std::vector<Coordinate>& coordinates) {
    std::vector<std::string> names;
    for (const char* prefix : {"", "p_"})
        for (const Coordinate& each : coordinates) {
            std::string name = prefix + each.name;
            std::replace(name.begin(), name.end(), '.', '_');
            names.push_back(std::move(name));
        }
    return names;
}

std::shared_ptr<const Monitor> makeMonitor(const Settings& settings, const System& system,
                                           const PhaseMechanics& H) {
    if (settings.type == "auto") return std::make_shared<MeasuredMonitor>(H, localPeriod);
    if (settings.type == "action") return std::make_shared<MeasuredMonitor>(H, unsignedDensity);
    if (settings.type == "arclength") return std::make_shared<ArcLength>(H);
    if (!isLogarithmic(settings)) return std::make_shared<TypedMonitor>(settings, system);
    if (!H.isSeparable())
        throw InvalidScene("/monitor",
                           "logarithmic is for energies p^2/(2m) + V(q) with constant masses, and " +
                               system.id + " has another one",
                           "auto, or a typed one");
    return std::make_shared<DepthMonitor>(H);
}

std::shared_ptr<const Monitor> boundedMonitor(std::shared_ptr<const Monitor> monitor, int dimension,
                                              double most) {
    return std::make_shared<BoundedMonitor>(std::move(monitor), dimension, most);
}

}  // namespace extremal
