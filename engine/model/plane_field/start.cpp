// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/known_keys.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/model/plane_field/q_ball.hpp"
#include "engine/model/typed/typed_function.hpp"
#include "engine/model/wave/random_field.hpp"

namespace extremal {
namespace {

using Pair = std::array<double, 2>;

/// A profile: what it adds to a state at time t.
struct Profile {
    std::function<void(double t, double* x)> add;
    bool isExact = false;  ///< alone it solves the field equation
};

/// The keys of one profile.
class Keys {
public:
    Keys(const Value& object, std::string pointer, const std::vector<std::string>& known)
        : object_(object), pointer_(std::move(pointer)) {
        allowKeys(object, "name", known, pointer_, "this profile");
    }
    double number(const char* key, double fallback) const {
        const Value* const value = object_.find(key);
        return value ? numberIn(*value, at(key), {}) : fallback;
    }
    Pair pair(const char* key, Pair fallback, int dimension) const {
        const Value* const value = object_.find(key);
        if (!value) return fallback;
        if (dimension == 1 && !value->isArray()) return {numberIn(*value, at(key), {}), 0};
        const auto numbers =
            numbersIn(*value, at(key), dimension, {}, dimension > 1 ? "[1, 0]" : "one number");
        return {numbers[0], dimension > 1 ? numbers[1] : 0};
    }
    std::string at(const char* key) const { return pointer_ + "/" + key; }

private:
    const Value& object_;
    std::string pointer_;
};

void requireComplex(const PlaneFieldProblem& problem, const std::string& name, const std::string& pointer) {
    if (problem.isComplex()) return;
    throw InvalidScene(pointer + "/name",
                       name +
                           " needs two components that the equations do not tell from each other when "
                           "they are turned",
                       "\"components\": [\"u\", \"v\"] and the potential klein-gordon-complex or q-ball");
}

Profile planeWave(const PlaneFieldProblem& problem, const Value& object, const std::string& pointer) {
    const Keys keys(object, pointer, {"wave_vector", "amplitude", "phase"});
    const wave::Grid& grid = problem.grid();
    const bool isReal = problem.components() == 1 && problem.potential().isLinear();
    if (!isReal) requireComplex(problem, "plane-wave", pointer);
    const Pair waves = keys.pair("wave_vector", {1, 0}, grid.dimension());
    for (const double each : waves)
        if (each != std::round(each))
            throw InvalidScene(keys.at("wave_vector"),
                               "must be whole numbers of waves in the domain, got " + formatNumber(each),
                               "[1, 0], or a domain of that length");
    const double A = keys.number("amplitude", 1), phase = keys.number("phase", 0),
                 K = 2 * std::numbers::pi * waves[0] / grid.x.length,
                 L = 2 * std::numbers::pi * waves[1] / grid.y.length;
    if (!(A > 0)) throw InvalidScene(keys.at("amplitude"), "must be positive", "1");
    const double u[2] = {A, 0};
    double slope[2];
    problem.potential().evaluate(u, 1, 1, nullptr, slope, nullptr);
    const double square = problem.stiffness() * (K * K + L * L) + slope[0] / A;
    if (!(square >= 0))
        throw InvalidScene(keys.at("amplitude"),
                           "gives the square of the frequency " + formatNumber(square, 4) +
                               ", which is negative: no such wave",
                           "another amplitude or wave_vector");
    const double w = std::sqrt(square);
    return {[=, &problem](double t, double* x) {
                const std::size_t n = problem.nodes(), size = problem.size();
                std::size_t i = 0;
                for (const double y : problem.y())
                    for (const double place : problem.x()) {
                        const double angle = K * place + L * y - w * t + phase;
                        x[i] += A * std::cos(angle);
                        x[size + i] += A * w * std::sin(angle);
                        if (!isReal) {
                            x[n + i] += A * std::sin(angle);
                            x[size + n + i] -= A * w * std::cos(angle);
                        }
                        ++i;
                    }
            },
            true};
}

/// What a Q-ball depends on, and numbers besides: scenes are read many times, and each takes a while to find.
std::string keyOf(const PlaneFieldProblem& problem, double omega, std::vector<double> further) {
    constexpr int probes = 6;
    for (int k = 1; k <= probes; ++k) {
        const double u[2] = {0.37 * k, 0};
        double slope[2];
        problem.potential().evaluate(u, 1, 1, nullptr, slope, nullptr);
        further.push_back(slope[0]);
    }
    further.insert(further.end(), {omega, problem.speed(), double(problem.grid().dimension())});
    std::string key;
    for (const double each : further) key += formatNumber(each, 17) + ' ';
    return key;
}

std::shared_ptr<const QBall> ballOf(const PlaneFieldProblem& problem, double omega,
                                    const std::string& pointer) {
    static MemoCache<std::string, std::shared_ptr<const QBall>> known(8);
    return known.get(keyOf(problem, omega, {}),
                     [&] { return std::make_shared<const QBall>(problem, omega, pointer); });
}

/// The lump at rest on the grid.
std::vector<double> restingBall(const PlaneFieldProblem& problem, const QBall& ball, Pair centre) {
    static MemoCache<std::string, std::vector<double>> known(4);
    const wave::Grid& grid = problem.grid();
    const std::string key = keyOf(problem, ball.omega(),
                                  {grid.x.left, grid.x.length, grid.y.left, grid.y.length, double(grid.nx),
                                   double(grid.ny), centre[0], centre[1]});
    return known.get(key, [&] { return ball.onGrid(problem, centre); });
}

Profile qBall(const PlaneFieldProblem& problem, const Value& object, const std::string& pointer) {
    requireComplex(problem, "q-ball", pointer);
    const Keys keys(object, pointer, {"omega", "centre", "velocity", "phase"});
    const wave::Grid& grid = problem.grid();
    const double omega = keys.number("omega", 0.8), phase = keys.number("phase", 0), c = problem.speed();
    const Pair centre = keys.pair("centre", {0, 0}, grid.dimension()),
               v = keys.pair("velocity", {0, 0}, grid.dimension());
    const double speed = std::hypot(v[0], v[1]);
    if (!(speed < c))
        throw InvalidScene(keys.at("velocity"), "must be below the wave speed " + formatNumber(c) + ", got " +
                                                    formatNumber(speed));
    const auto ball = ballOf(problem, omega, pointer);
    const double gamma = 1 / std::sqrt(1 - speed * speed / (c * c));
    return {[=, &problem](double t, double* x) {
                const std::size_t n = problem.nodes(), size = problem.size();
                std::size_t i = 0;
                for (const double y : problem.y())
                    for (const double place : problem.x()) {
                        const double dx = std::remainder(place - centre[0] - v[0] * t, grid.x.length),
                                     dy = grid.dimension() > 1
                                              ? std::remainder(y - centre[1] - v[1] * t, grid.y.length)
                                              : 0,
                                     along = speed > 0 ? (dx * v[0] + dy * v[1]) / speed : 0;
                        // In its own frame: stretched along v, and its time behind in front.
                        const double stretch = speed > 0 ? (gamma - 1) * along / speed : 0,
                                     X = dx + stretch * v[0], Y = dy + stretch * v[1], r = std::hypot(X, Y),
                                     own = t / gamma - gamma * speed * along / (c * c);
                        const double f = ball->value(r), angle = omega * own + phase,
                                     outwards = r > 0 ? -gamma * speed * (speed > 0 ? gamma * along : 0) / r *
                                                            ball->slope(r)
                                                      : 0;
                        const double turning = gamma * omega * f;
                        x[i] += f * std::cos(angle);
                        x[n + i] += f * std::sin(angle);
                        x[size + i] += outwards * std::cos(angle) - turning * std::sin(angle);
                        x[size + n + i] += outwards * std::sin(angle) + turning * std::cos(angle);
                        ++i;
                    }
            },
            false};
}

/// A Q-ball at rest, the only profile: as the equations on the grid have it.
Profile restingQBall(const PlaneFieldProblem& problem, const Value& object, const std::string& pointer) {
    requireComplex(problem, "q-ball", pointer);
    const Keys keys(object, pointer, {"omega", "centre", "velocity", "phase"});
    const double omega = keys.number("omega", 0.8), phase = keys.number("phase", 0);
    const Pair centre = keys.pair("centre", {0, 0}, problem.grid().dimension());
    const auto f = std::make_shared<const std::vector<double>>(
        restingBall(problem, *ballOf(problem, omega, pointer), centre));
    return {[=, &problem](double t, double* x) {
                const std::size_t n = problem.nodes(), size = problem.size();
                const double re = std::cos(omega * t + phase), im = std::sin(omega * t + phase);
                for (std::size_t i = 0; i < n; ++i) {
                    x[i] += re * (*f)[i];
                    x[n + i] += im * (*f)[i];
                    x[size + i] -= omega * im * (*f)[i];
                    x[size + n + i] += omega * re * (*f)[i];
                }
            },
            true};
}

Profile randomProfile(const PlaneFieldProblem& problem, const Value& object, const std::string& pointer) {
    const Keys keys(object, pointer, {"amplitude", "correlation", "seed"});
    const double seed = keys.number("seed", 1), amplitude = keys.number("amplitude", 0.1),
                 correlation = keys.number("correlation", problem.grid().x.length / 40);
    if (!(seed >= 0 && seed <= 0x1p52 && seed == std::floor(seed)))
        throw InvalidScene(keys.at("seed"),
                           "must be a whole number from 0 to 2^52, got " + formatNumber(seed), "1");
    if (!(correlation > 0)) throw InvalidScene(keys.at("correlation"), "must be positive", "1");
    return {[=, &problem](double, double* x) {
        for (std::size_t c = 0; c < problem.components(); ++c) {
            const auto f =
                wave::randomField(problem.grid(), {seed + static_cast<double>(c), correlation, amplitude});
            for (const double y : problem.y())
                for (const double place : problem.x()) *x++ += f(place, y, 0);
        }
    }};
}

Profile profileOf(const PlaneFieldProblem& problem, const Value& object, const std::string& pointer,
                  bool isAlone) {
    const std::vector<std::string> names = idsOf(planeFieldProfiles());
    const Value* const name = object.isObject() ? object.find("name") : nullptr;
    if (!name || !name->isString())
        throw InvalidScene(pointer, "must be an object with the name of a profile, or a list of such",
                           "{\"name\": \"plane-wave\", \"wave_vector\": [1, 2]}; known: " + joinNames(names));
    if (name->asString() == "plane-wave") return planeWave(problem, object, pointer);
    if (name->asString() == "q-ball")
        return isAlone && !object.find("velocity") ? restingQBall(problem, object, pointer)
                                                   : qBall(problem, object, pointer);
    if (name->asString() == "random") return randomProfile(problem, object, pointer);
    throw InvalidScene(pointer + "/name", "unknown profile \"" + name->asString() + "\"",
                       suggestName(name->asString(), names));
}

/// Those of a scene; `isAlone`: nothing besides.
std::vector<Profile> profilesOf(const PlaneFieldProblem& problem, const Settings& initial, bool isAlone) {
    const Value* const given = initial.find("profile");
    if (!given) return {};
    if (!given->isArray()) return {profileOf(problem, *given, "/profile", isAlone)};
    std::vector<Profile> all;
    for (std::size_t i = 0; i < given->asArray().size(); ++i)
        all.push_back(profileOf(problem, given->asArray()[i], "/profile/" + std::to_string(i),
                                isAlone && given->asArray().size() == 1));
    return all;
}

bool isProfileAlone(const Settings& initial) {
    return std::all_of(initial.keys.begin(), initial.keys.end(),
                       [](const auto& key) { return key.first == "profile" || key.second.isNull(); });
}

/// A component of u or u_t at the nodes, from its key.
void addFrom(const Settings& initial, const std::string& key, const PlaneFieldProblem& problem,
             double* values) {
    const std::size_t n = problem.nodes();
    const Value* const given = initial.find(key);
    const std::string pointer = "/" + key;
    if (!given || given->isNull()) return;
    if (given->isArray()) {
        const std::vector<double> own = valuesAtNodes(
            *given, pointer, n, "the number of nodes is /model/cells times /model/cells_y, x first");
        for (std::size_t i = 0; i < n; ++i) values[i] += own[i];
        return;
    }
    if (!given->isString() && !given->isNumber())
        throw InvalidScene(pointer, "must be an expression in x and y, or a list of values at the nodes",
                           "exp(-x^2 - y^2)");
    const typed::TypedFunction f(given->isString() ? given->asString() : formatNumber(given->asNumber(), 17),
                                 pointer, {"x", "y", "r", "phi"}, {});
    for (std::size_t j = 0, i = 0; j < problem.y().size(); ++j)
        for (const double x : problem.x()) {
            const double y = problem.y()[j], place[] = {x, y, std::hypot(x, y), std::atan2(y, x)},
                         value = f(place);
            if (!std::isfinite(value))
                throw InvalidScene(
                    pointer, "is not finite at x = " + formatNumber(x, 6) + ", y = " + formatNumber(y, 6),
                    "an expression that is finite on the whole rectangle");
            values[i++] += value;
        }
}

}  // namespace

std::vector<FieldInfo> planeFieldStartFields(const std::vector<std::string>& names) {
    std::vector<FieldInfo> fields;
    for (const std::string& name : names) {
        fields.push_back(optionalJsonField(name, name,
                                           name + " at the start: an expression in x, y, r and phi, or "
                                                  "values at the nodes, x first; default 0."));
        fields.push_back(optionalJsonField(name + "_t", name + "_t", name + "_t at the start, likewise."));
    }
    fields.push_back(optionalJsonField("profile", "profile",
                                       "Profiles by name, plane-wave, q-ball or random, with their keys: an "
                                       "object with a name, or a list of such, which add up."));
    return fields;
}

std::vector<CatalogItem> planeFieldProfiles() {
    const auto list = [](const char* key, const char* description, Value::Array fallback) {
        return jsonField(key, key, "", Value(std::move(fallback)), description);
    };
    const FieldInfo phase = numberField("phase", "phase", "", 0, "At the start, in radians.");
    return {
        {"plane-wave",
         "plane wave of a complex field",
         "amplitude exp(i (k.x - w t + phase)): exact for two components that turn into each other, and "
         "its real part for one of a linear field.",
         {list("wave_vector", "Waves in the domain along x and y.", {1.0, 0.0}),
          positive("amplitude", "amplitude", "", 1, "A; w depends on it."), phase},
         {},
         "a field over a rectangle"},
        {"q-ball",
         "Q-ball",
         "f(r) exp(i omega t): a lump of a complex field that keeps its charge; exact where it is alone "
         "and at rest.",
         {numberField("omega", "frequency", "", 0.8, "How fast its phase turns."),
          list("centre", "Its middle.", {0.0, 0.0}), list("velocity", "Below the wave speed.", {0.0, 0.0}),
          phase},
         {},
         "a complex field over a rectangle"},
        {"random",
         "random field",
         "A Gaussian random field in each component, from a seed: the same on every machine.",
         {numberField("amplitude", "amplitude", "", 0.1, "Root of its variance."),
          numberField("correlation", "correlation", "", 1, "Its length; default a fortieth of the domain."),
          integerField("seed", "seed", 0, 0x1p52, 1.0, "Another one, another field.")},
         {},
         "a field over a rectangle"}};
}

std::vector<double> planeFieldStart(const PlaneFieldProblem& problem, const Settings& initial, double t) {
    std::vector<double> x(2 * problem.size(), 0);
    for (const Profile& profile : profilesOf(problem, initial, isProfileAlone(initial)))
        profile.add(t, x.data());
    for (std::size_t c = 0; c < problem.components(); ++c) {
        double* const u = x.data() + c * problem.nodes();
        addFrom(initial, problem.name(c), problem, u);
        addFrom(initial, problem.name(c) + "_t", problem, u + problem.size());
    }
    problem.removeAlternation(x);
    return x;
}

ExactSolution planeFieldExact(const std::shared_ptr<const PlaneFieldProblem>& problem,
                              const Settings& initial) {
    if (!isProfileAlone(initial)) return {};
    std::vector<Profile> all = profilesOf(*problem, initial, true);
    if (all.size() != 1 || !all.front().isExact) return {};
    return [problem, add = std::move(all.front().add)](double t, std::span<double> x) {
        std::fill(x.begin(), x.end(), 0.0);
        add(t, x.data());
    };
}

}  // namespace extremal
