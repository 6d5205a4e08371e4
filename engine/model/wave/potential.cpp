// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/potential.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/random_field.hpp"

namespace extremal::wave {
namespace {

void requireWhole(double cells, const std::string& pointer) {
    if (cells != std::floor(cells))
        throw InvalidScene(pointer, "must be a whole number, got " + formatNumber(cells),
                           "as many periods fit into the domain");
}

/// The wave number of this many periods.
double turns(double cells, const Domain& domain) { return 2 * std::numbers::pi * cells / domain.length; }

RandomField randomFieldOf(const Value& object, const std::string& pointer, const Domain& domain,
                          const Constants& constants) {
    const auto p = parametersOf(
        object, pointer, {{"seed", 1}, {"correlation", domain.length / 20, false, true}, {"amplitude", 1}},
        {"name"}, constants);
    if (!(p[0] >= 0 && p[0] <= 0x1p53 && p[0] == std::floor(p[0])))
        throw InvalidScene(pointer + "/seed",
                           "must be a whole number from 0 to 2^53, got " + formatNumber(p[0]));
    return {p[0], p[1], p[2]};
}

Function onInterval(const std::string& name, const Value& object, const std::string& pointer,
                    const Domain& domain, const Constants& constants) {
    const double middle = domain.left + domain.length / 2;
    const auto read = [&](const std::vector<Parameter>& parameters) {
        return parametersOf(object, pointer, parameters, {"name"}, constants);
    };
    const auto mass = numberIn(Value("m"), pointer, constants);
    if (name == "free") {
        read({});
        return {[](double, double, double) { return 0.0; }, false};
    }
    if (name == "harmonic") {
        const auto p = read({{"omega", 1, false, true}, {"centre", middle}});
        return {[a = mass * p[0] * p[0] / 2, c = p[1]](double x, double, double) {
                    return a * (x - c) * (x - c);
                },
                false};
    }
    if (name == "lattice") {
        const auto p = read({{"depth", 1}, {"cells", 1, false, true}, {"centre", domain.left}});
        requireWhole(p[1], pointer + "/cells");
        return {[d = p[0], k = turns(p[1], domain), c = p[2]](double x, double, double) {
                    return d * (1 - std::cos(k * (x - c)));
                },
                false};
    }
    if (name == "double-well") {
        const auto p =
            read({{"height", 1}, {"separation", domain.length / 8, false, true}, {"centre", middle}});
        return {[h = p[0], a = p[1], c = p[2]](double x, double, double) {
                    const double u = (x - c) / a, w = u * u - 1;
                    return h * w * w;
                },
                false};
    }
    if (name == "barrier") {
        const auto p = read({{"height", 1}, {"width", domain.length / 40, false, true}, {"centre", middle}});
        return {[h = p[0], w = p[1], c = p[2]](double x, double, double) {
                    const double u = (x - c) / w;
                    return h * std::exp(-u * u / 2);
                },
                false};
    }
    if (name == "morse") {
        const auto p = read({{"depth", 1}, {"a", 1, false, true}, {"centre", middle}});
        return {[d = p[0], a = p[1], c = p[2]](double x, double, double) {
                    const double u = 1 - std::exp(-a * (x - c));
                    return d * u * u;
                },
                false};
    }
    if (name == "random") {
        const RandomField f = randomFieldOf(object, pointer, domain, constants);
        return {randomField(Grid{domain}, f), false};
    }
    return {};
}

Function onRectangle(const std::string& name, const Value& object, const std::string& pointer,
                     const Grid& grid, const Constants& constants) {
    const Domain &X = grid.x, &Y = grid.y;
    const double middle = X.left + X.length / 2, middleY = Y.left + Y.length / 2;
    const auto read = [&](const std::vector<Parameter>& parameters) {
        return parametersOf(object, pointer, parameters, {"name"}, constants);
    };
    if (name == "harmonic") {
        const Value* both = object.find("omega");
        const double omega = both ? numberIn(*both, pointer + "/omega", constants) : 1;
        const auto p = read({{"omega", 1, false, true},
                             {"omega_y", omega, false, true},
                             {"centre", middle},
                             {"centre_y", middleY}});
        const double mass = numberIn(Value("m"), pointer, constants);
        return {[a = mass * p[0] * p[0] / 2, b = mass * p[1] * p[1] / 2, c = p[2], d = p[3]](
                    double x, double y, double) { return a * (x - c) * (x - c) + b * (y - d) * (y - d); },
                false};
    }
    if (name == "lattice") {
        const auto p = read({{"depth", 1},
                             {"cells", 1, false, true},
                             {"cells_y", 1, false, true},
                             {"centre", X.left},
                             {"centre_y", Y.left}});
        requireWhole(p[1], pointer + "/cells");
        requireWhole(p[2], pointer + "/cells_y");
        return {[d = p[0], k = turns(p[1], X), l = turns(p[2], Y), c = p[3], e = p[4]](double x, double y,
                                                                                       double) {
                    return d * (2 - std::cos(k * (x - c)) - std::cos(l * (y - e)));
                },
                false};
    }
    if (name == "double-slit") {
        const auto p = read({{"height", 1},
                             {"width", X.length / 40, false, true},
                             {"slit", Y.length / 20, false, true},
                             {"separation", Y.length / 6, false, true},
                             {"centre", middle},
                             {"centre_y", middleY}});
        return {
            [h = p[0], w = p[1], s = p[2], half = p[3] / 2, c = p[4], d = p[5]](double x, double y, double) {
                const auto gap = [s](double from) { return std::exp(-std::pow(2 * from / s, 4)); };
                const double u = (x - c) / w;
                return h * std::exp(-u * u / 2) * (1 - gap(y - d - half) - gap(y - d + half));
            },
            false};
    }
    if (name == "random") {
        const RandomField f = randomFieldOf(object, pointer, X, constants);
        return {randomField(grid, f), false};
    }
    if (name == "free" || name == "barrier") return onInterval(name, object, pointer, X, constants);
    return {};
}

Function named(const std::string& name, const Value& object, const std::string& pointer, const Grid& grid,
               const Constants& constants) {
    Function f = grid.dimension() == 2 ? onRectangle(name, object, pointer, grid, constants)
                                       : onInterval(name, object, pointer, grid.x, constants);
    if (!f.value)
        throw InvalidScene(pointer + (object.find("name") ? "/name" : ""),
                           "unknown potential \"" + name + "\"", suggestName(name, potentialNames(grid)));
    return f;
}

}  // namespace

const std::vector<std::string>& potentialNames(const Grid& grid) {
    static const std::vector<std::string> interval = {"free",    "harmonic", "lattice", "double-well",
                                                      "barrier", "morse",    "random"},
                                          rectangle = {"free",    "harmonic",    "lattice",
                                                       "barrier", "double-slit", "random"};
    return grid.dimension() == 2 ? rectangle : interval;
}

Potential makePotential(const Value& given, const std::string& pointer, const Grid& grid,
                        const Constants& constants) {
    const auto& names = potentialNames(grid);
    if (given.isNumber()) return {{[v = given.asNumber()](double, double, double) { return v; }, false}};
    if (given.isString()) {
        const std::string& text = given.asString();
        if (std::find(names.begin(), names.end(), text) != names.end())
            return {named(text, Value(Value::Object{}), pointer, grid, constants)};
        return {functionOf(text, pointer, constants, {grid.dimension() == 2, true})};
    }
    const Value* name = given.find("name");
    if (!name || !name->isString())
        throw InvalidScene(pointer,
                           std::string("must be an expression in x") + (grid.dimension() == 2 ? ", y" : "") +
                               " and t, or {\"name\": NAME, ..}",
                           "known: " + joinNames(names));
    return {named(name->asString(), given, pointer, grid, constants)};
}

}  // namespace extremal::wave
