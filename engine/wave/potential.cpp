#include "engine/wave/potential.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"

namespace extremal::wave {
namespace {


/// The generator "splitmix64" of Steele, Lea and Flood (2014): whole numbers alone, so the same everywhere.
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    /// Uniform in [0, 1).
    double uniform() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    /// Nearly normal, by sums of twelve: no logarithm whose last bit differs from library to library.
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += uniform();
        return sum;
    }

private:
    std::uint64_t state_;
};

struct Harmonic {
    double k, cosine, sine;
};

/// sum_a w_a (g_a cos k_a x + g'_a sin k_a x), w_a^2 ~ exp(-(k_a l)^2/2), of variance 1.
Function randomField(const Domain& domain, double seed, double correlation, double amplitude) {
    SplitMix random(static_cast<std::uint64_t>(seed));
    std::vector<Harmonic> terms;
    double variance = 0;
    for (int a = 1; a <= 4096; ++a) {
        const double k = 2 * std::numbers::pi * a / domain.length, weight = std::exp(-k * k * correlation * correlation / 4);
        if (weight < 1e-17) break;
        const double cosine = random.normal(), sine = random.normal();
        terms.push_back({k, weight * cosine, weight * sine});
        variance += weight * weight;
    }
    const double scale = variance > 0 ? amplitude / std::sqrt(variance) : 0;
    for (Harmonic& h : terms) {
        h.cosine *= scale;
        h.sine *= scale;
    }
    return {[terms, left = domain.left](double x, double) {
                double sum = 0;
                for (const Harmonic& h : terms)
                    sum += h.cosine * std::cos(h.k * (x - left)) + h.sine * std::sin(h.k * (x - left));
                return sum;
            },
            false};
}

Function named(const std::string& name, const Value& object, const std::string& pointer, const Domain& domain,
               const Constants& constants) {
    const double middle = domain.left + domain.length / 2;
    const auto read = [&](const std::vector<Parameter>& parameters) {
        return parametersOf(object, pointer, parameters, {"name"}, constants);
    };
    const auto mass = numberOf(Value("m"), pointer, constants);
    if (name == "free") {
        read({});
        return {[](double, double) { return 0.0; }, false};
    }
    if (name == "harmonic") {
        const auto p = read({{"omega", 1, false, true}, {"centre", middle}});
        return {[a = mass * p[0] * p[0] / 2, c = p[1]](double x, double) { return a * (x - c) * (x - c); }, false};
    }
    if (name == "lattice") {
        const auto p = read({{"depth", 1}, {"cells", 1, false, true}, {"centre", domain.left}});
        if (p[1] != std::floor(p[1]))
            throw InvalidScene(pointer + "/cells", "must be a whole number, got " + formatNumber(p[1]),
                               "as many periods fit into the domain");
        return {[d = p[0], k = 2 * std::numbers::pi * p[1] / domain.length, c = p[2]](double x, double) {
                    return d * (1 - std::cos(k * (x - c)));
                },
                false};
    }
    if (name == "double-well") {
        const auto p = read({{"height", 1}, {"separation", domain.length / 8, false, true}, {"centre", middle}});
        return {[h = p[0], a = p[1], c = p[2]](double x, double) {
                    const double u = (x - c) / a, w = u * u - 1;
                    return h * w * w;
                },
                false};
    }
    if (name == "barrier") {
        const auto p = read({{"height", 1}, {"width", domain.length / 40, false, true}, {"centre", middle}});
        return {[h = p[0], w = p[1], c = p[2]](double x, double) {
                    const double u = (x - c) / w;
                    return h * std::exp(-u * u / 2);
                },
                false};
    }
    if (name == "morse") {
        const auto p = read({{"depth", 1}, {"a", 1, false, true}, {"centre", middle}});
        return {[d = p[0], a = p[1], c = p[2]](double x, double) {
                    const double u = 1 - std::exp(-a * (x - c));
                    return d * u * u;
                },
                false};
    }
    if (name == "random") {
        const auto p = read({{"seed", 1}, {"correlation", domain.length / 20, false, true}, {"amplitude", 1}});
        if (!(p[0] >= 0 && p[0] <= 0x1p53 && p[0] == std::floor(p[0])))
            throw InvalidScene(pointer + "/seed", "must be a whole number from 0 to 2^53, got " + formatNumber(p[0]));
        return randomField(domain, p[0], p[1], p[2]);
    }
    throw InvalidScene(pointer + (object.find("name") ? "/name" : ""), "unknown potential \"" + name + "\"",
                       suggestName(name, potentialNames()));
}

}  // namespace

const std::vector<std::string>& potentialNames() {
    static const std::vector<std::string> all = {"free", "harmonic", "lattice", "double-well", "barrier", "morse", "random"};
    return all;
}

Potential makePotential(const Value& given, const std::string& pointer, const Domain& domain, const Constants& constants) {
    const auto& names = potentialNames();
    if (given.isNumber()) return {{[v = given.asNumber()](double, double) { return v; }, false}};
    if (given.isString()) {
        const std::string& text = given.asString();
        if (std::find(names.begin(), names.end(), text) != names.end())
            return {named(text, Value(Value::Object{}), pointer, domain, constants)};
        return {functionOf(text, pointer, constants, true)};
    }
    const Value* name = given.find("name");
    if (!name || !name->isString())
        throw InvalidScene(pointer, "must be an expression in x and t, or {\"name\": NAME, ..}", "known: " + joinNames(names));
    return {named(name->asString(), given, pointer, domain, constants)};
}

}  // namespace extremal::wave
