// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

using SharedDensity = std::shared_ptr<const DensityProblem>;
using typed::TypedFunction;

std::string textOf(const Value& given) {
    return given.isString() ? given.asString() : formatNumber(given.asNumber(), 17);
}

std::vector<std::string> placeNames(const DensityProblem& problem, bool hasTime) {
    std::vector<std::string> names{"x"};
    if (problem.isPlane()) names.emplace_back("y");
    if (hasTime) names.emplace_back("t");
    return names;
}

std::string joinedPlaces(const DensityProblem& problem, bool hasTime) {
    return joinNames(placeNames(problem, hasTime)) + " and the parameters";
}

/// The exact solution of each component, of (x, [y], t); empty without the key.
std::vector<std::shared_ptr<const TypedFunction>> exactFunctions(const DensityProblem& problem,
                                                                 const Settings& initial) {
    const Value* const given = initial.find("exact");
    std::vector<std::shared_ptr<const TypedFunction>> all;
    if (!given || given->isNull()) return all;
    const auto make = [&](const Value& text, const std::string& pointer) {
        if (!text.isString() && !text.isNumber())
            throw InvalidScene(pointer, "must be an expression in " + joinedPlaces(problem, true));
        all.push_back(std::make_shared<const TypedFunction>(textOf(text), pointer, placeNames(problem, true),
                                                            problem.density.parameters()));
    };
    if (!given->isObject()) {
        if (problem.components() > 1)
            throw InvalidScene("/exact", "must be an object of expressions for " + joinNames(problem.names));
        make(*given, "/exact");
        return all;
    }
    for (const auto& [name, text] : given->asObject())
        if (std::find(problem.names.begin(), problem.names.end(), name) == problem.names.end())
            throw InvalidScene("/exact/" + name, "is not a component", joinNames(problem.names));
    for (const std::string& name : problem.names) {
        const Value* const text = given->find(name);
        if (!text) throw InvalidScene("/exact", "lacks the component " + name);
        make(*text, "/exact/" + name);
    }
    return all;
}

/// f(place, i) where the values of a component are, place = (x, [y], room for t).
template <class F>
void forPlaces(const DensityProblem& problem, std::size_t component, F&& f) {
    const double right = problem.offset(component, 0), up = problem.offset(component, 1);
    std::size_t i = 0;
    for (int row = 0; row < problem.nodesY(); ++row)
        for (int column = 0; column < problem.nodesX(); ++column) {
            std::array<double, 3> place{problem.placeX(column) + right, 0, 0};
            if (problem.isPlane()) place[1] = problem.placeY(row) + up;
            f(place, i++);
        }
}

void fillExact(const DensityProblem& problem,
               const std::vector<std::shared_ptr<const TypedFunction>>& functions, double t, double* x) {
    const std::size_t time = problem.isPlane() ? 2 : 1;
    for (std::size_t c = 0; c < functions.size(); ++c)
        forPlaces(problem, c, [&](std::array<double, 3> place, std::size_t i) {
            std::array<double, 3> slope{};
            place[time] = t;
            const std::size_t at = c * problem.nodes() + i;
            functions[c]->evaluate(place.data(), &x[at], slope.data(), nullptr);
            x[problem.size() + at] = slope[time];
        });
}

/// A component of u or u_t from its key.
void fillFrom(const Settings& initial, const std::string& key, const DensityProblem& problem,
              std::size_t component, double* values) {
    const Value* const given = initial.find(key);
    const std::string pointer = "/" + key;
    if (!given || given->isNull()) return;
    if (given->isArray()) {
        const std::vector<double> own = valuesAtNodes(*given, pointer, problem.nodes());
        std::copy(own.begin(), own.end(), values);
        return;
    }
    if (!given->isString() && !given->isNumber())
        throw InvalidScene(
            pointer,
            "must be an expression in " + joinedPlaces(problem, false) + ", or a list of values at the nodes",
            problem.isPlane() ? "exp(-x^2 - y^2)" : "exp(-x^2)");
    const TypedFunction f(textOf(*given), pointer, placeNames(problem, false), problem.density.parameters());
    forPlaces(problem, component, [&](const std::array<double, 3>& place, std::size_t i) {
        values[i] = f(place.data());
        if (!std::isfinite(values[i]))
            throw InvalidScene(pointer, "is not finite at x = " + formatNumber(place[0], 6),
                               "an expression that is finite on the whole domain");
    });
}

/// The field equations d/dt dL/du_t + d/dx dL/du_x + .. - dL/du = 0 at places of a typed solution.
class DensityResidual {
public:
    DensityResidual(const DensityProblem& problem,
                    std::vector<std::shared_ptr<const TypedFunction>> functions)
        : problem_(problem), functions_(std::move(functions)), directions_(problem.isPlane() ? 2 : 1) {}

    /// |sum of the terms| over the sum of their sizes, for the worst component, without what the round-off
    /// of differences explains.
    double ratioAt(const std::array<double, 3>& place, const std::array<double, 3>& scale) const {
        const int m = problem_.density.components();
        const std::vector<double> here = slopesAt(place);
        double worst = 0;
        for (int c = 0; c < m; ++c) {
            double sum = -here[static_cast<std::size_t>(c)], size = std::abs(sum), doubt = 0;
            for (int direction = 0; direction <= directions_; ++direction) {
                // u_t is argument 1, u_x 2, u_y 3; t is the last number of a place.
                const int kind = direction == directions_ ? 1 : 2 + direction;
                const auto k = static_cast<std::size_t>(kind * m + c);
                const auto i = static_cast<std::size_t>(direction);
                const double fine = differenceOf(place, i, 1e-3 * scale[i], k),
                             coarse = differenceOf(place, i, 2e-3 * scale[i], k);
                sum += fine;
                size += std::abs(fine);
                doubt += 2 * std::abs(fine - coarse) + 1e-11 * std::abs(here[k]) / scale[i];
            }
            if (!std::isfinite(sum) || size == 0) continue;
            worst = std::max(worst, std::max(0.0, std::abs(sum) - doubt) / size);
        }
        return worst;
    }

private:
    /// Of order 4.
    double differenceOf(const std::array<double, 3>& place, std::size_t i, double d, std::size_t k) const {
        const auto at = [&](double away) {
            std::array<double, 3> moved = place;
            moved[i] += away;
            return slopesAt(moved)[k];
        };
        return (8 * (at(d) - at(-d)) - (at(2 * d) - at(-2 * d))) / (12 * d);
    }
    std::vector<double> slopesAt(const std::array<double, 3>& place) const {
        const FieldDensity& density = problem_.density;
        const auto m = static_cast<std::size_t>(density.components());
        std::vector<double> at(static_cast<std::size_t>(density.inputs())), slopes(at.size());
        for (std::size_t c = 0; c < m; ++c) {
            std::array<double, 3> slope{};
            functions_[c]->evaluate(place.data(), &at[c], slope.data(), nullptr);
            at[m + c] = slope[static_cast<std::size_t>(directions_)];
            for (std::size_t i = 0; i < static_cast<std::size_t>(directions_); ++i)
                at[(2 + i) * m + c] = slope[i];
        }
        for (std::size_t i = 0; i <= static_cast<std::size_t>(directions_); ++i)
            at[static_cast<std::size_t>(density.arguments()) + i] = place[i];
        (void)density.gradient(at.data(), slopes.data());
        return slopes;
    }

    const DensityProblem& problem_;
    std::vector<std::shared_ptr<const TypedFunction>> functions_;
    int directions_;
};

std::string faultOfExact(const DensityProblem& problem, const PremiseCheck::Run& run) {
    constexpr int places = 100;
    constexpr double most = 1e-6;
    const auto functions = exactFunctions(problem, run.given);
    if (functions.empty()) return {};
    const DensityResidual residual(problem, functions);
    const std::size_t time = problem.isPlane() ? 2 : 1;
    std::array<double, 3> scale{problem.dx(), problem.dy(), 0};
    scale[time] = problem.isPlane() ? std::min(problem.dx(), problem.dy()) : problem.dx();
    std::mt19937 random(1905);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967295.0; };
    double worst = 0;
    std::array<double, 3> there{};
    for (int i = 0; i < places; ++i) {
        std::array<double, 3> place{problem.along.left + problem.along.length * uniform(), 0, 0};
        if (problem.isPlane()) place[1] = problem.across.left + problem.across.length * uniform();
        place[time] = run.start + (run.end - run.start) * uniform();
        const double ratio = residual.ratioAt(place, scale);
        if (ratio > worst) {
            worst = ratio;
            there = place;
        }
    }
    if (!(worst > most)) return {};
    return "does not solve the equation of the field: at x = " + formatNumber(there[0], 4) +
           ", t = " + formatNumber(there[time], 4) + " what is left of it is " + formatNumber(worst, 2) +
           " of the sizes of its terms";
}

/// How far the solution leaves what the ends of an interval ask for.
ExactPremise endsOfExact(const DensityProblem& problem, const PremiseCheck::Run& run) {
    ExactPremise premise;
    const auto functions = exactFunctions(problem, run.given);
    if (functions.empty() || problem.isPlane() || problem.boundary == Boundary::neumann) return premise;
    constexpr int samples = 200;
    const double left = problem.along.left, right = left + problem.along.length;
    double size = 0, most = 0;
    for (const auto& f : functions) {
        const auto at = [&](double x, double t) {
            const double place[2] = {x, t};
            return (*f)(place);
        };
        for (int k = 0; k <= samples; ++k) {
            const double t = run.start + (run.end - run.start) * k / samples, a = at(left, t),
                         b = at(right, t);
            size = std::max({size, std::abs(a), std::abs(b), std::abs(at((left + right) / 2, t))});
            most = std::max(most, problem.isPeriodic() ? std::abs(b - a)
                                                       : std::max(std::abs(a - at(left, run.start)),
                                                                  std::abs(b - at(right, run.start))));
        }
    }
    premise.isViolated = most > 1e-6 * size;
    if (premise.isViolated)
        premise.text = "does not hold at the ends of the domain (" + formatNumber(most, 2) + ")";
    return premise;
}

}  // namespace

std::vector<FieldInfo> densityStartFields(const DensityProblem& problem) {
    std::vector<FieldInfo> fields;
    for (const std::string& name : problem.names) {
        fields.push_back(optionalJsonField(name, name,
                                           name + " at the start: an expression in " +
                                               joinedPlaces(problem, false) +
                                               ", or values at the nodes; default 0."));
        fields.push_back(optionalJsonField(name + "_t", name + "_t", name + "_t at the start, likewise."));
    }
    fields.push_back(optionalJsonField("exact", "exact solution",
                                       "The exact solution, an expression in " + joinedPlaces(problem, true) +
                                           "; of several components an object of such."));
    return fields;
}

std::vector<double> densityStart(const DensityProblem& problem, const Settings& initial, double t) {
    std::vector<double> x(2 * problem.size(), 0);
    const auto functions = exactFunctions(problem, initial);
    for (const auto& [key, value] : initial.keys)
        if (!functions.empty() && key != "exact" && !value.isNull())
            throw InvalidScene("/" + key, "stands beside exact, which says all", "one of both");
    fillExact(problem, functions, t, x.data());
    for (std::size_t c = 0; c < problem.components() && functions.empty(); ++c) {
        double* const u = x.data() + c * problem.nodes();
        fillFrom(initial, problem.names[c], problem, c, u);
        fillFrom(initial, problem.names[c] + "_t", problem, c, u + problem.size());
    }
    for (std::size_t i = 0; i < problem.size(); ++i)
        if (problem.isFixed(i)) x[problem.size() + i] = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isfinite(x[i]))
            throw InvalidScene(
                "/exact",
                "is not finite at x = " +
                    formatNumber(
                        problem.placeX(static_cast<int>(i % static_cast<std::size_t>(problem.nodesX()))), 6));
    return x;
}

ExactSolution densityExact(const SharedDensity& problem, const Settings& initial) {
    const auto functions = exactFunctions(*problem, initial);
    if (functions.empty()) return {};
    return [problem, functions](double t, std::span<double> x) {
        fillExact(*problem, functions, t, x.data());
        for (std::size_t i = 0; i < problem->size(); ++i)
            if (problem->isFixed(i)) x[problem->size() + i] = 0;
    };
}

PremiseCheck densityPremise(const SharedDensity& problem) {
    return {[problem](const PremiseCheck::Run& run, const std::function<ExactSolution()>&) {
                return endsOfExact(*problem, run);
            },
            [problem](const PremiseCheck::Run& run) { return faultOfExact(*problem, run); }};
}

}  // namespace extremal
