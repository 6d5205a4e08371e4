// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/oscillatory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/multiscale/oscillatory_table.hpp"
#include "engine/quadrature/catalog.hpp"

namespace extremal {
namespace {

constexpr int maxHarmonics = 6;
/// Below, a Filon grid and a large space do not go together (handbook, Multiscale).
constexpr double smallestFilonPhase = 20;
constexpr double pointsPerPeriod = 24;
constexpr int panelNodes = 12;

double integerBetween(const Value& value, int low, int high, const std::string& pointer,
                      const std::string& what) {
    const double n = value.isNumber() ? value.asNumber() : std::numeric_limits<double>::quiet_NaN();
    if (n == std::floor(n) && n >= low && n <= high) return n;
    throw InvalidScene(pointer, what + " must be an integer from " + std::to_string(low) + " to " +
                                    std::to_string(high) +
                                    (value.isNumber() ? ", got " + formatNumber(n) : ""));
}

/// { "of": [1, -1], "degree": 0 }: a combination of two frequencies.
Harmonic combinationFrom(const Value& value, const std::string& pointer) {
    Harmonic k;
    bool isGiven = false;
    for (const auto& [key, entry] : value.asObject()) {
        if (key == "degree") {
            k.degree = static_cast<int>(integerBetween(entry, 0, OscillatoryBasis::mostDegree,
                                                       pointer + "/degree", "the degree of a harmonic"));
        } else if (key == "of") {
            isGiven = entry.isArray() && entry.asArray().size() == 2;
            for (std::size_t i = 0; isGiven && i < 2; ++i)
                k.of[i] = static_cast<int>(integerBetween(entry.asArray()[i], -maxHarmonics, maxHarmonics,
                                                          pointer + "/of/" + std::to_string(i),
                                                          "a multiple of a frequency"));
        } else {
            throw InvalidScene(pointer + "/" + key, "unknown key \"" + key + "\"", "known: of and degree");
        }
    }
    if (!isGiven || k.of == Multiples{0, 0})
        throw InvalidScene(pointer + "/of", "must be two multiples of the two frequencies, not both 0",
                           "[1, -1]: their difference");
    // k and -k are the same functions.
    if (k.of[0] < 0 || (k.of[0] == 0 && k.of[1] < 0)) k.of = {-k.of[0], -k.of[1]};
    return k;
}

std::vector<Harmonic> harmonicsFrom(const Value& value, int frequencies, const std::string& pointer) {
    if (!value.isArray() || value.asArray().size() > maxHarmonics)
        throw InvalidScene(
            pointer,
            "must be an array of at most " + std::to_string(maxHarmonics) + " degrees, one for each harmonic",
            "[1]: the first harmonic with linear amplitudes; []: none");
    std::vector<Harmonic> harmonics;
    const auto add = [&](const Harmonic& k, const std::string& place) {
        if (std::any_of(harmonics.begin(), harmonics.end(),
                        [&](const Harmonic& other) { return other.of == k.of; }))
            throw InvalidScene(place, "is a harmonic that is there already", "give each once");
        harmonics.push_back(k);
    };
    for (std::size_t k = 0; k < value.asArray().size(); ++k) {
        const Value& entry = value.asArray()[k];
        const std::string place = pointer + "/" + std::to_string(k);
        if (entry.isObject() && frequencies == 2) {
            add(combinationFrom(entry, place), place);
            continue;
        }
        const int n = static_cast<int>(k) + 1;
        const int degree = static_cast<int>(
            integerBetween(entry, 0, OscillatoryBasis::mostDegree, place, "the degree of a harmonic"));
        add({{n, 0}, degree}, place);
        if (frequencies == 2) add({{0, n}, degree}, place);
    }
    return harmonics;
}

/// {degree, harmonics}, each optional, over what stands without it.
OscillatoryBasis changedBy(const Value& object, OscillatoryBasis basis, int frequencies,
                           const std::string& pointer) {
    if (!object.isObject())
        throw InvalidScene(pointer, "must be an object", "for example { \"degree\": 2, \"harmonics\": [1] }");
    for (const auto& [key, value] : object.asObject()) {
        const std::string place = pointer + "/" + key;
        if (key == "degree")
            basis.degree =
                static_cast<int>(integerBetween(value, 1, OscillatoryBasis::mostDegree, place, "the degree"));
        else if (key == "harmonics")
            basis.harmonics = harmonicsFrom(value, frequencies, place);
        else
            throw InvalidScene(place, "unknown key \"" + key + "\"", "known: degree and harmonics");
    }
    return basis;
}

const Value* given(const Settings& space, const char* key) {
    const Value* value = space.find(key);
    return value && !value->isNull() ? value : nullptr;
}

/// A scene may give two frequencies.
int frequencyCount(const Settings& space) {
    const Value* omega = given(space, "omega");
    return omega && omega->isArray() ? 2 : 1;
}

OscillatoryBasis common(const Settings& space) {
    OscillatoryBasis basis(space.integer("degree"), {});
    const Value* harmonics = given(space, "harmonics");
    basis.harmonics = harmonicsFrom(harmonics ? *harmonics : Value(Value::Array{1.0}), frequencyCount(space),
                                    "/space/harmonics");
    return basis;
}

/// All bases the keys speak of, whatever the system.
std::vector<OscillatoryBasis> mentioned(const Settings& space) {
    const int frequencies = frequencyCount(space);
    std::vector<OscillatoryBasis> all{common(space)};
    if (const Value* fast = given(space, "fast"))
        all.push_back(changedBy(*fast, all[0], frequencies, "/space/fast"));
    if (const Value* variables = given(space, "variables"); variables && variables->isObject())
        for (const auto& [name, keys] : variables->asObject())
            all.push_back(changedBy(keys, all[0], frequencies, "/space/variables/" + name));
    return all;
}

struct Extent {
    int degree = 0;
    Multiples harmonic{0, 0};
    explicit Extent(const std::vector<OscillatoryBasis>& bases) {
        for (const OscillatoryBasis& b : bases) {
            degree = std::max(degree, b.highestDegree());
            const Multiples top = b.highestHarmonics();
            for (std::size_t i = 0; i < 2; ++i) harmonic[i] = std::max(harmonic[i], top[i]);
        }
    }
    int highest() const { return std::max(harmonic[0], harmonic[1]); }
    int filonNodes() const { return degree + 2; }
    /// Of each frequency.
    int filonPhases() const { return 2 * (2 * highest() + 1) + 2; }
};

double positiveFrequency(const Value& omega, const std::string& pointer, const std::string& what) {
    if (omega.isNumber() && omega.asNumber() > 0 && std::isfinite(omega.asNumber())) return omega.asNumber();
    throw InvalidScene(pointer,
                       what + (omega.isNumber() ? ", got " + formatNumber(omega.asNumber()) : std::string()),
                       "a number, \"model\", \"estimate\", or two numbers");
}

Phases<double> frequenciesOf(const Settings& space, const System& system) {
    const Value* omega = given(space, "omega");
    if (!omega || *omega == Value("model")) {
        if (system.fast.frequency > 0) return {system.fast.frequency, 0};
        throw InvalidScene("/space/omega", system.id + " does not say how fast it oscillates",
                           "give a number, or \"estimate\"");
    }
    if (*omega == Value("estimate"))
        throw InvalidScene("/space/omega", "can be estimated from the initial data of a scene only",
                           "give a number");
    const std::string what = "must be a positive finite number, \"model\", \"estimate\" or two numbers";
    if (!omega->isArray()) return {positiveFrequency(*omega, "/space/omega", what), 0};
    const Value::Array& both = omega->asArray();
    if (both.size() != 2)
        throw InvalidScene("/space/omega", what + ", got " + std::to_string(both.size()), "[100, 161.8]");
    return {positiveFrequency(both[0], "/space/omega/0", "must be a positive finite number"),
            positiveFrequency(both[1], "/space/omega/1", "must be a positive finite number")};
}

/// "auto", decided.
Settings ruleFor(const Settings& quadrature, const Extent& extent, const Phases<double>& z) {
    if (!quadrature.type.empty() && quadrature.type != "auto") return quadrature;
    const bool areTwo = z[1] != 0;
    const double fastest = std::max(std::abs(z[0]), std::abs(z[1])),
                 slowest = areTwo ? std::min(std::abs(z[0]), std::abs(z[1])) : fastest;
    const Settings resolving = resolvingRule(fastest, extent.degree);
    const int grid = extent.filonNodes() * extent.filonPhases() * (areTwo ? extent.filonPhases() : 1);
    if (slowest >= smallestFilonPhase && grid <= resolving.integer("panels") * panelNodes)
        return {"filon-lobatto", {{"nodes", extent.filonNodes()}, {"phases", extent.filonPhases()}}, {}};
    return resolving;
}

}  // namespace

Settings resolvingRule(double z, int degree) {
    const double points = std::max(pointsPerPeriod * std::abs(z) / (2 * std::numbers::pi), 2.0 * degree + 4);
    const int panels = static_cast<int>(std::min(1e6, std::ceil(points / panelNodes)));
    return {"gauss", {{"nodes", panelNodes}, {"panels", panels}}, {}};
}

bool isOscillatory(const Settings& space) { return space.type == "oscillatory"; }
bool isFilon(const Settings& quadrature) {
    const RuleEntry* const rule = findRule(quadrature.type);
    return rule && rule->filon;
}

std::vector<OscillatoryBasis> oscillatoryBases(const Settings& space, const System& system) {
    const int frequencies = frequencyCount(space);
    std::vector<OscillatoryBasis> bases(system.coordinates.size(), common(space));
    if (const Value* fast = given(space, "fast"))
        for (const int k : system.fast.coordinates)
            bases[static_cast<std::size_t>(k)] =
                changedBy(*fast, bases[static_cast<std::size_t>(k)], frequencies, "/space/fast");
    const Value* variables = given(space, "variables");
    if (!variables) return bases;
    if (!variables->isObject())
        throw InvalidScene("/space/variables", "must be an object with one entry for each coordinate",
                           "for example { \"" + system.coordinates.front().name +
                               "\": { \"degree\": 2, \"harmonics\": [1] } }");
    std::vector<std::string> names;
    for (const Coordinate& c : system.coordinates) names.push_back(c.name);
    for (const auto& [name, keys] : variables->asObject()) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidScene("/space/variables/" + name, system.id + " has no coordinate \"" + name + "\"",
                               "it has " + joinNames(names));
        auto& basis = bases[static_cast<std::size_t>(found - names.begin())];
        basis = changedBy(keys, basis, frequencies, "/space/variables/" + name);
    }
    return bases;
}

Phases<double> oscillatoryPhases(const System& system, const Settings& space, double step) {
    const Phases<double> frequency = frequenciesOf(space, system);
    return {step * frequency[0], step * frequency[1]};
}

std::vector<Table<double>> oscillatoryTables(const System& system, const Discretization& discretization,
                                             double step) {
    const std::vector<OscillatoryBasis> bases = oscillatoryBases(discretization.space, system);
    const Phases<double> z = oscillatoryPhases(system, discretization.space, step);
    const double fastest = std::max(std::abs(z[0]), std::abs(z[1]));
    if (!(fastest <= 1e15))
        throw InvalidScene("/step",
                           "times the frequency is " + formatNumber(fastest, 3) +
                               ": the phase after a step is lost to round-off beyond 1e15",
                           "a smaller step");
    const Settings rule = ruleFor(discretization.quadrature, Extent(bases), z);
    const FilonNodes nodes = isFilon(rule) ? *findRule(rule.type)->filon : FilonNodes::lobatto;
    std::vector<Table<double>> tables;
    for (std::size_t k = 0; k < bases.size(); ++k) {
        const auto same =
            static_cast<std::size_t>(std::find(bases.begin(), bases.end(), bases[k]) - bases.begin());
        if (same < k)
            tables.push_back(tables[same]);
        else if (isFilon(rule))
            tables.push_back(
                makeOscillatoryTable(bases[k], z, nodes, rule.integer("nodes"),
                                     {rule.integer("phases"), z[1] != 0 ? rule.integer("phases") : 1}));
        else
            tables.push_back(makeOscillatoryTable(bases[k], z, makeRule<double>(rule)));
    }
    return tables;
}

Settings completeOscillatoryRule(const Settings& space, const Settings& quadrature) {
    Settings q = quadrature;
    if (q.type.empty()) q.type = "auto";
    if (q.type == "auto") return {"auto", {}, {}};
    RuleDemand demand;
    if (!isFilon(q)) demand.nodes = panelNodes;
    try {
        const Extent extent(mentioned(space));
        demand.degree = extent.degree;
        demand.harmonic = extent.highest();
    } catch (const InvalidScene&) {
        // Wrong keys are reported where the discretization is made.
    }
    return completeRule(q, demand);
}

Properties describeOscillatory(const Settings& space, const Settings& quadrature) {
    Properties p;
    const RuleEntry* const rule = findRule(quadrature.type);
    p.claims.isSymmetric = rule && rule->isSymmetric;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    // No order: the error depends on the step, on the periods in it, and on the harmonics that are left out.
    p.space = "slow polynomials and harmonics of a fast frequency";
    p.knownAs = "multiscale";
    p.shortName = "MS";
    try {
        const Extent extent(mentioned(space));
        if (!isFilon(quadrature)) return p;
        const int nodes = quadrature.integer("nodes"), phases = quadrature.integer("phases");
        if (nodes < extent.degree + 1) {
            p.refusal = std::to_string(nodes) + " nodes do not see amplitudes of degree " +
                        std::to_string(extent.degree);
            p.hint = "at least " + std::to_string(extent.degree + 1) + " nodes; " +
                     std::to_string(extent.filonNodes()) + " are accurate";
        } else if (phases < 4 * extent.highest() + 1) {
            p.refusal = std::to_string(phases) + " phases do not see the square of harmonic " +
                        std::to_string(extent.highest()) + ", which is in the kinetic energy";
            p.hint = "at least " + std::to_string(4 * extent.highest() + 1) + " phases; " +
                     std::to_string(extent.filonPhases()) + " are accurate";
        }
    } catch (const InvalidScene&) {
        // Wrong keys are reported where the discretization is made.
    }
    return p;
}

}  // namespace extremal
