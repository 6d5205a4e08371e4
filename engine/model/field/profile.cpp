// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/profile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

constexpr double pi = std::numbers::pi;
using At = std::function<void(double x, double t, double* u, double* v)>;
using Kind = FieldPotential::Kind;

const char* equationOf(Kind kind) {
    switch (kind) {
        case Kind::none:
            return "the wave equation";
        case Kind::kleinGordon:
            return "the Klein-Gordon equation";
        case Kind::sineGordon:
            return "the sine-Gordon equation";
        case Kind::phi4:
            return "the phi-4 equation";
        case Kind::typed:
            break;
    }
    return "an equation with a typed potential";
}

/// One named profile: its keys with their defaults, what it solves, and how it is made.
struct Named {
    const char *name, *title;
    std::vector<std::pair<const char*, double>> keys;
    std::vector<Kind> solves;  ///< empty: any equation, as initial data alone
    At (*make)(const std::vector<double>& keys, const FieldProblem& problem);
};

/// sqrt(1 - a^2). The square loses digits where a is near 1.
double complement(double a) {
    return std::abs(a) < 0.995 ? std::sqrt(1 - a * a) : std::sqrt((1 - a) * (1 + a));
}
/// 1/sqrt(1 - v^2/c^2), with the difference c - v where v is near c.
double lorentz(double v, double c) {
    return std::abs(v) < 0.995 * c ? 1 / complement(v / c) : c / std::sqrt((c - v) * (c + v));
}
double sech(double x) { return 1 / std::cosh(x); }

At kinkOf(const std::vector<double>& keys, const FieldProblem& problem, double sign) {
    const double c = problem.speed(), v = keys[0] / c, x0 = keys[1], gamma = lorentz(keys[0], c);
    if (problem.potential.kind() == Kind::phi4)
        return [=](double x, double t, double* u, double* u_t) {
            const double scale = sign * gamma / std::numbers::sqrt2, g = scale * ((x - x0) / c - v * t),
                         s = sech(g);
            *u = std::tanh(g);
            *u_t = -v * scale * s * s;
        };
    return [=](double x, double t, double* u, double* u_t) {
        const double g = gamma * ((x - x0) / c - v * t);
        *u = 4 * std::atan(std::exp(sign * g));
        *u_t = -2 * sign * v * gamma * sech(g);
    };
}

/// 4 atan(a / b) and its derivative by t, from a, b and their derivatives.
void fourAtan(double a, double b, double a_t, double b_t, double* u, double* u_t) {
    *u = 4 * std::atan(a / b);
    *u_t = 4 * (a_t * b - a * b_t) / (a * a + b * b);
}

/// sinh x and cosh x over a common factor, so that they do not overflow far out.
struct Hyperbolic {
    double sinh, cosh;
    Hyperbolic(double x, double largest) {
        constexpr double far = 300;
        if (largest < far) {
            sinh = std::sinh(x);
            cosh = std::cosh(x);
            return;
        }
        const double y = std::abs(x), high = std::exp(y - largest) / 2, low = std::exp(-y - largest) / 2;
        sinh = std::copysign(-std::expm1(-2 * y) * high, x);
        cosh = high + low;
    }
};

At collision(const std::vector<double>& keys, const FieldProblem& problem, bool isKinkKink) {
    const double c = problem.speed(), v = keys[0] / c, gamma = lorentz(keys[0], c);
    const double middle = problem.mesh.left() + problem.mesh.length() / 2;
    return [=](double x, double t, double* u, double* u_t) {
        const double g = gamma * (x - middle) / c, s = gamma * v * t;
        const double largest = std::max(std::abs(g), std::abs(s));
        const Hyperbolic G(g, largest), S(s, largest);
        if (isKinkKink)
            fourAtan(v * G.sinh, S.cosh, 0, gamma * v * S.sinh, u, u_t);
        else
            fourAtan(S.sinh, v * G.cosh, gamma * v * S.cosh, 0, u, u_t);
    };
}

At breather(const std::vector<double>& keys, const FieldProblem& problem) {
    const double c = problem.speed(), omega = keys[0], phase = keys[1], x0 = keys[2], k = complement(omega);
    return [=](double x, double t, double* u, double* u_t) {
        const double angle = omega * t + phase;
        fourAtan(k * std::sin(angle), omega * std::cosh(k * (x - x0) / c), k * omega * std::cos(angle), 0, u,
                 u_t);
    };
}

At planeWave(const std::vector<double>& keys, const FieldProblem& problem) {
    const double K = 2 * pi * keys[0] / problem.mesh.length(), amplitude = keys[1], phase = keys[2];
    const double m = problem.potential.kind() == Kind::kleinGordon ? problem.potential.mass() : 0;
    const double W = std::sqrt(problem.elastic.k * K * K + m * m);
    return [=](double x, double t, double* u, double* u_t) {
        const double angle = K * x - W * t + phase;
        *u = amplitude * std::cos(angle);
        *u_t = amplitude * W * std::sin(angle);
    };
}

At front(const std::vector<double>& keys, const FieldProblem&) {
    return [v = keys[0], x0 = keys[1], width = keys[2]](double x, double t, double* u, double* u_t) {
        const double g = (x - x0 - v * t) / width, s = sech(g);
        *u = std::tanh(g);
        *u_t = -v / width * s * s;
    };
}

const std::vector<Named>& namedProfiles() {
    static const std::vector<Named> all = {
        {"kink",
         "kink, u rises",
         {{"v", 0.5}, {"x0", 0}},
         {Kind::sineGordon, Kind::phi4},
         [](const auto& k, const FieldProblem& p) { return kinkOf(k, p, 1); }},
        {"antikink",
         "antikink, u falls",
         {{"v", 0.5}, {"x0", 0}},
         {Kind::sineGordon, Kind::phi4},
         [](const auto& k, const FieldProblem& p) { return kinkOf(k, p, -1); }},
        {"kink-kink",
         "two kinks that meet",
         {{"v", 0.5}},
         {Kind::sineGordon},
         [](const auto& k, const FieldProblem& p) { return collision(k, p, true); }},
        {"kink-antikink",
         "a kink and an antikink that meet",
         {{"v", 0.5}},
         {Kind::sineGordon},
         [](const auto& k, const FieldProblem& p) { return collision(k, p, false); }},
        {"breather", "breather", {{"omega", 0.5}, {"phase", 0}, {"x0", 0}}, {Kind::sineGordon}, breather},
        {"plane-wave",
         "plane wave of a field",
         {{"wave_number", 1}, {"amplitude", 1}, {"phase", 0}},
         {Kind::none, Kind::kleinGordon},
         planeWave},
        {"front", "front", {{"v", 0}, {"x0", 0}, {"width", 1}}, {}, front}};
    return all;
}

std::vector<std::string> keysOf(const Settings& initial) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : initial.keys) keys.push_back(key);
    return keys;
}

/// Every key that is there must be one of these.
void allowKeys(const Settings& initial, const std::vector<std::string>& known, const std::string& of) {
    for (const std::string& key : keysOf(initial))
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw InvalidScene("/" + key, "is not a key of " + of, "it has " + joinNames(known));
}

void checkSpeed(const Named& named, const std::vector<double>& values, const FieldProblem& problem) {
    const double c = problem.speed();
    const bool isWave = std::string_view(named.keys[0].first) == "v" && !named.solves.empty();
    if (isWave && !(std::abs(values[0]) < c))
        throw InvalidScene(
            "/v", "must be below the wave speed " + formatNumber(c) + ", got " + formatNumber(values[0]));
    const bool divides = std::string_view(named.name).starts_with("kink-");
    if (divides && values[0] == 0) throw InvalidScene("/v", "must not be 0: kinks at rest do not meet");
    if (std::string_view(named.name) == "breather" && !(values[0] > 0 && values[0] < 1))
        throw InvalidScene("/omega", "must lie between 0 and 1, got " + formatNumber(values[0]));
    if (std::string_view(named.name) == "front" && !(values[2] > 0))
        throw InvalidScene("/width", "must be positive, got " + formatNumber(values[2]));
    if (std::string_view(named.name) == "plane-wave" && values[0] != std::floor(values[0]))
        throw InvalidScene("/wave_number",
                           "must be a whole number of waves in the domain, got " + formatNumber(values[0]));
}

FieldProfile fromName(const Settings& initial, const FieldProblem& problem) {
    const std::string name = initial.text("profile");
    std::vector<std::string> names;
    for (const Named& named : namedProfiles()) names.push_back(named.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InvalidScene("/profile", "unknown profile \"" + name + "\"", suggestName(name, names));
    const Named& named = namedProfiles()[static_cast<std::size_t>(found - names.begin())];
    std::vector<std::string> known{"profile"};
    for (const auto& [key, fallback] : named.keys) known.push_back(key);
    allowKeys(initial, known, "the profile " + name);
    const Kind kind = problem.potential.kind();
    const bool isPlaneWave = name == "plane-wave", isFront = name == "front";
    const bool solves = std::find(named.solves.begin(), named.solves.end(), kind) != named.solves.end();
    if (!named.solves.empty() && (!solves || problem.coefficient || !problem.elastic.isLinear()))
        throw InvalidScene("/profile",
                           name + " solves " + equationOf(named.solves.front()) + ", and this is " +
                               (solves ? "one with a coefficient or a material" : equationOf(kind)),
                           "the potential of its equation, or u and u_t as expressions");
    if (isPlaneWave && !problem.mesh.isPeriodic())
        throw InvalidScene("/profile", "plane-wave needs the boundary periodic");
    if (!isPlaneWave && !isFront && name != "breather" && name != "kink-antikink" &&
        problem.mesh.isPeriodic())
        throw InvalidScene("/profile", name + " has other values at the two ends of the domain",
                           "the boundary dirichlet or neumann");
    std::vector<double> values;
    for (const auto& [key, fallback] : named.keys)
        values.push_back(initial.find(key) ? initial.number(key) : fallback);
    checkSpeed(named, values, problem);
    FieldProfile profile;
    profile.at = named.make(values, problem);
    profile.isExact = !isFront || (kind == Kind::none &&
                                   std::abs(std::abs(values[0]) - problem.speed()) < 1e-12 * problem.speed());
    return profile;
}

/// A function of x continued beyond the ends of the domain so that the free wave obeys its boundary: around a
/// circle, odd about fixed ends, even about free ones.
std::function<double(double)> continued(std::function<double(double)> f, const Mesh& mesh) {
    const double left = mesh.left(), L = mesh.length();
    const Boundary boundary = mesh.boundary;
    const double a = boundary == Boundary::dirichlet ? f(left) : 0,
                 b = boundary == Boundary::dirichlet ? f(left + L) : 0;
    return [=, f = std::move(f)](double x) {
        double y = x - left;
        if (boundary == Boundary::periodic) return f(left + y - L * std::floor(y / L));
        y -= 2 * L * std::floor(y / (2 * L));
        const bool isMirrored = y > L;
        if (isMirrored) y = 2 * L - y;
        if (boundary == Boundary::neumann) return f(left + y);
        // The line between the fixed values is at rest; what is left is odd.
        const double line = a + (b - a) * y / L, rest = f(left + y) - line;
        const double here = a + (b - a) * (x - left) / L;
        return here + (isMirrored ? -rest : rest);
    };
}

using Typed = typed::TypedFunction;
std::shared_ptr<const Typed> typedFunction(const Value& value, const std::string& pointer,
                                           const FieldProblem& problem, bool hasTime) {
    std::string text = value.isNumber() ? formatNumber(value.asNumber()) : "";
    if (value.isString()) text = value.asString();
    if (text.empty())
        throw InvalidScene(pointer, "must be an expression in x" + std::string(hasTime ? " and t" : ""));
    // In formulas t is the time that is not differentiated by.
    const std::string time = "T";
    std::vector<std::string> variables{"x"};
    if (hasTime) {
        variables.push_back(time);
        text = withNameReplaced(text, "t", time);
    }
    return std::make_shared<const Typed>(
        text, pointer, variables,
        std::vector<std::pair<std::string, double>>{{"wave_speed", problem.speed()},
                                                    {"mass", problem.potential.mass()}});
}

FieldProfile fromExpressions(const Settings& initial, const FieldProblem& problem, double start) {
    allowKeys(initial, {"u", "u_t"}, "initial data by expressions");
    const auto u0 = typedFunction(*initial.find("u"), "/u", problem, false);
    const Value zero(0.0);
    const Value* given = initial.find("u_t");
    const auto v0 = typedFunction(given ? *given : zero, "/u_t", problem, false);
    FieldProfile profile;
    const bool startsAtRest = !given || *given == zero || *given == Value("0");
    if (startsAtRest && problem.potential.kind() == Kind::none && problem.elastic.isLinear() &&
        !problem.coefficient) {
        profile.isExact = true;
        const auto value = continued([u0](double x) { return (*u0)(&x); }, problem.mesh);
        const auto slope = [value](double x) {  // by differences of order 4: u_t is drawn, not compared
            constexpr double d = 1e-3;
            return (8 * (value(x + d) - value(x - d)) - (value(x + 2 * d) - value(x - 2 * d))) / (12 * d);
        };
        profile.at = [value, slope, start, c = problem.speed()](double x, double t, double* u, double* v) {
            const double away = c * (t - start);
            *u = away == 0 ? value(x) : (value(x - away) + value(x + away)) / 2;
            *v = away == 0 ? 0 : c * (slope(x + away) - slope(x - away)) / 2;
        };
        return profile;
    }
    profile.at = [u0, v0](double x, double, double* u, double* v) {
        *u = (*u0)(&x);
        *v = (*v0)(&x);
    };
    return profile;
}

FieldProfile fromExact(const Settings& initial, const FieldProblem& problem) {
    allowKeys(initial, {"exact"}, "an exact solution");
    const auto f = typedFunction(*initial.find("exact"), "/exact", problem, true);
    FieldProfile profile;
    profile.isExact = profile.givesLevels = true;
    profile.formula = f;
    profile.at = [f](double x, double t, double* u, double* v) {
        const double place[2] = {x, t};
        double gradient[2];
        f->evaluate(place, u, gradient, nullptr);
        *v = gradient[1];
    };
    return profile;
}

/// The numbers of a key of `values`; none where it may be absent and is.
std::vector<double> numbersOf(const Value& values, const char* key, std::size_t n, const char* reason) {
    const Value* const numbers = values.find(key);
    if (!numbers && std::string_view(key) == "u_t") return std::vector<double>(n, 0);
    const std::string place = std::string("/values/") + key;
    if (!numbers || !numbers->isArray() || (n > 0 && numbers->asArray().size() != n))
        throw InvalidScene(
            place, n > 0 ? "must have " + std::to_string(n) + " numbers, one per node" : "must have numbers",
            reason);
    std::vector<double> all;
    for (std::size_t i = 0; i < numbers->asArray().size(); ++i) {
        const Value& v = numbers->asArray()[i];
        if (!v.isNumber() || !std::isfinite(v.asNumber()))
            throw InvalidScene(place + "/" + std::to_string(i), "must be a finite number");
        all.push_back(v.asNumber());
    }
    return all;
}

/// Through values at places: a cubic on each interval, with the slopes of the parabolas through three
/// neighbours; beyond the first and the last place constant.
class SmoothCurve {
public:
    SmoothCurve(std::vector<double> x, std::vector<double> y)
        : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()) {
        const std::size_t last = x_.size() - 1;
        const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
        for (std::size_t i = 1; i < last; ++i) {
            const double left = x_[i] - x_[i - 1], right = x_[i + 1] - x_[i];
            slope_[i] = (right * secant(i - 1) + left * secant(i)) / (left + right);
        }
        slope_[0] = secant(0);
        slope_[last] = secant(last - 1);
    }
    double operator()(double x) const {
        if (!(x > x_.front())) return y_.front();
        if (!(x < x_.back())) return y_.back();
        const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
        const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
        return (1 + 2 * s) * r * r * y_[i] + s * r * r * h * slope_[i] + s * s * (3 - 2 * s) * y_[i + 1] -
               s * s * r * h * slope_[i + 1];
    }

private:
    std::vector<double> x_, y_, slope_;
};

FieldProfile fromValues(const Settings& initial, const FieldProblem& problem) {
    allowKeys(initial, {"values"}, "values at the nodes");
    const Value& values = *initial.find("values");
    FieldProfile profile;
    if (!values.find("x")) {
        const auto n = static_cast<std::size_t>(problem.size());
        const char* const reason = "a periodic field has as many nodes as cells, others one more";
        profile.u = numbersOf(values, "u", n, reason);
        profile.v = numbersOf(values, "u_t", n, reason);
        return profile;
    }
    const std::vector<double> x = numbersOf(values, "x", 0, "places in ascending order");
    if (x.size() < 2 || !std::is_sorted(x.begin(), x.end(), std::less_equal<>()))
        throw InvalidScene("/values/x", "must be two places or more, in ascending order");
    const char* const reason = "one number for each place of \"x\"";
    const SmoothCurve u(x, numbersOf(values, "u", x.size(), reason)),
        v(x, numbersOf(values, "u_t", x.size(), reason));
    profile.at = [u, v](double place, double, double* value, double* rate) {
        *value = u(place);
        *rate = v(place);
    };
    return profile;
}

}  // namespace

std::vector<CatalogItem> fieldProfiles() {
    const std::vector<FieldInfo> fields = fieldStartFields();
    std::vector<CatalogItem> items;
    for (const Named& named : namedProfiles()) {
        CatalogItem item{named.name, named.title, "", {}, {}, "a field"};
        for (const Kind kind : named.solves)
            item.description +=
                (item.description.empty() ? "Solves " : " and ") + std::string(equationOf(kind));
        item.description += named.solves.empty() ? "Initial data of any field." : ".";
        for (const auto& [key, fallback] : named.keys)
            for (const FieldInfo& field : fields)
                if (field.key == key) {
                    item.parameters.push_back(field);
                    item.parameters.back().fallback = fallback;
                }
        items.push_back(std::move(item));
    }
    return items;
}

std::vector<FieldInfo> fieldStartFields() {
    const auto optionalNumber = [](const char* key, const char* title, const char* text) {
        FieldInfo f = numberField(key, title, "", 0, text);
        f.fallback = nullptr;
        f.isOptional = true;
        return f;
    };
    FieldInfo profile = textField("profile", "", nullptr,
                                  "A profile by name: kink, antikink, kink-kink, kink-antikink, breather, "
                                  "plane-wave or front, with its keys.");
    profile.isOptional = true;
    return {
        profile,
        optionalNumber("v", "speed", "Of kinks, collisions and fronts."),
        optionalNumber("x0", "place", "Of kinks, breathers and fronts."),
        optionalNumber("omega", "frequency", "Of breathers, below 1."),
        optionalNumber("phase", "phase", "Of breathers and plane waves."),
        optionalNumber("wave_number", "wave number", "Of plane waves: waves in the domain."),
        optionalNumber("amplitude", "amplitude", "Of plane waves."),
        optionalNumber("width", "width", "Of fronts."),
        optionalJsonField("u", "u", "u at the start, an expression in x."),
        optionalJsonField("u_t", "u_t", "u_t at the start, an expression in x; default 0."),
        optionalJsonField("exact", "exact solution", "The exact solution, an expression in x and t."),
        optionalJsonField("values", "values",
                          "u and u_t at the nodes, two arrays; with the array x at these places, and smooth "
                          "between them.")};
}

FieldProfile fieldProfile(const Settings& initial, const FieldProblem& problem, double start) {
    std::vector<std::string> ways;
    for (const char* key : {"profile", "exact", "values", "u"})
        if (initial.find(key)) ways.emplace_back(key);
    if (ways.empty())
        throw InvalidScene("", "says nothing of the field", "a profile, u and u_t, exact, or values");
    if (ways.size() > 1) throw InvalidScene("", "has " + joinNames(ways) + " at once", "keep one of them");
    if (ways[0] == "profile") return fromName(initial, problem);
    if (ways[0] == "exact") return fromExact(initial, problem);
    return ways[0] == "values" ? fromValues(initial, problem) : fromExpressions(initial, problem, start);
}

ExactSolution::AtPlaces atPlacesOf(const FieldProfile& profile) {
    return [at = profile.at](double t, std::span<const double> places, double* values) {
        for (std::size_t i = 0; i < places.size(); ++i)
            at(places[i], t, &values[i], &values[places.size() + i]);
    };
}

std::vector<double> fieldState(const FieldProfile& profile, const FieldProblem& problem, double t) {
    const auto n = static_cast<std::size_t>(problem.size());
    std::vector<double> x(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        if (profile.at) {
            profile.at(problem.nodes.x[i], t, &x[i], &x[n + i]);
        } else {
            x[i] = profile.u[i];
            x[n + i] = profile.v[i];
        }
        if (problem.isFixed(static_cast<int>(i))) x[n + i] = 0;
    }
    for (std::size_t i = 0; i < 2 * n; ++i)
        if (!std::isfinite(x[i]))
            throw InvalidScene("", "is not finite at x = " + formatNumber(problem.nodes.x[i % n], 6));
    return x;
}

}  // namespace extremal
