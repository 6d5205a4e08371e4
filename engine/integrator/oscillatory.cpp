#include "engine/integrator/oscillatory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/action/oscillatory_table.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"

namespace extremal {
namespace {

constexpr int maxDegree = 24, maxHarmonics = 6;
/// Below, a Filon grid and a rich space do not go together (handbook, Multiscale).
constexpr double smallestFilonPhase = 20;
constexpr double pointsPerPeriod = 24;
constexpr int panelNodes = 12;

double integerBetween(const Value& value, int low, int high, const std::string& pointer, const std::string& what) {
    const double n = value.isNumber() ? value.asNumber() : std::numeric_limits<double>::quiet_NaN();
    if (n == std::floor(n) && n >= low && n <= high) return n;
    throw InvalidScene(pointer, what + " must be an integer from " + std::to_string(low) + " to " + std::to_string(high) +
                                    (value.isNumber() ? ", got " + formatNumber(n) : ""));
}

std::vector<int> harmonicsFrom(const Value& value, const std::string& pointer) {
    if (!value.isArray() || value.asArray().size() > maxHarmonics)
        throw InvalidScene(pointer, "must be an array of at most " + std::to_string(maxHarmonics) +
                                        " degrees, one for each harmonic",
                           "[1]: the first harmonic with linear amplitudes; []: none");
    std::vector<int> degrees;
    for (std::size_t k = 0; k < value.asArray().size(); ++k)
        degrees.push_back(static_cast<int>(integerBetween(value.asArray()[k], 0, maxDegree,
                                                          pointer + "/" + std::to_string(k), "the degree of a harmonic")));
    return degrees;
}

/// {degree, harmonics}, each optional, over what stands without it.
OscillatoryBasis changedBy(const Value& object, OscillatoryBasis basis, const std::string& pointer) {
    if (!object.isObject()) throw InvalidScene(pointer, "must be an object", "for example { \"degree\": 2, \"harmonics\": [1] }");
    for (const auto& [key, value] : object.asObject()) {
        const std::string place = pointer + "/" + key;
        if (key == "degree")
            basis.degree = static_cast<int>(integerBetween(value, 1, maxDegree, place, "the degree"));
        else if (key == "harmonics")
            basis.harmonics = harmonicsFrom(value, place);
        else
            throw InvalidScene(place, "unknown key \"" + key + "\"", "known: degree and harmonics");
    }
    return basis;
}

const Value* given(const Settings& space, const char* key) {
    const Value* value = space.find(key);
    return value && !value->isNull() ? value : nullptr;
}

OscillatoryBasis common(const Settings& space) {
    OscillatoryBasis basis{space.integer("degree"), {1}};
    if (const Value* harmonics = given(space, "harmonics")) basis.harmonics = harmonicsFrom(*harmonics, "/space/harmonics");
    return basis;
}

/// All bases the keys speak of, whatever the system.
std::vector<OscillatoryBasis> mentioned(const Settings& space) {
    std::vector<OscillatoryBasis> all{common(space)};
    if (const Value* fast = given(space, "fast")) all.push_back(changedBy(*fast, all[0], "/space/fast"));
    if (const Value* variables = given(space, "variables"); variables && variables->isObject())
        for (const auto& [name, keys] : variables->asObject())
            all.push_back(changedBy(keys, all[0], "/space/variables/" + name));
    return all;
}

struct Extent {
    int degree = 0, harmonic = 0;
    explicit Extent(const std::vector<OscillatoryBasis>& bases) {
        for (const OscillatoryBasis& b : bases) {
            degree = std::max(degree, b.highestDegree());
            harmonic = std::max(harmonic, b.highestHarmonic());
        }
    }
    int filonNodes() const { return degree + 2; }
    int filonPhases() const { return 2 * (2 * harmonic + 1) + 2; }
};

double frequencyOf(const Settings& space, const System& system) {
    const Value* omega = given(space, "omega");
    const std::string hint = "a number, \"model\" or \"estimate\"";
    if (!omega || *omega == Value("model")) {
        if (system.fast.frequency > 0) return system.fast.frequency;
        throw InvalidScene("/space/omega", system.id + " does not say how fast it oscillates", "give a number, or \"estimate\"");
    }
    if (omega->isNumber() && omega->asNumber() > 0 && std::isfinite(omega->asNumber())) return omega->asNumber();
    if (*omega == Value("estimate"))
        throw InvalidScene("/space/omega", "can be estimated from the initial data of a scene only", "give a number");
    throw InvalidScene("/space/omega",
                       "must be a positive finite number, \"model\" or \"estimate\"" +
                           (omega->isNumber() ? ", got " + formatNumber(omega->asNumber()) : std::string()),
                       hint);
}

/// "auto", decided.
Settings ruleFor(const Settings& quadrature, const Extent& extent, double z) {
    if (!quadrature.type.empty() && quadrature.type != "auto") return quadrature;
    const double points = std::max(pointsPerPeriod * std::abs(z) / (2 * std::numbers::pi), 2.0 * extent.degree + 4);
    const int panels = static_cast<int>(std::min(1e6, std::ceil(points / panelNodes)));
    if (std::abs(z) >= smallestFilonPhase && extent.filonNodes() * extent.filonPhases() <= panels * panelNodes)
        return {"filon-lobatto", {{"nodes", extent.filonNodes()}, {"phases", extent.filonPhases()}}, {}};
    return {"gauss", {{"nodes", panelNodes}, {"panels", panels}}, {}};
}

}  // namespace

bool isOscillatory(const Settings& space) { return space.type == "oscillatory"; }
bool isFilon(const Settings& quadrature) {
    return quadrature.type == "filon-lobatto" || quadrature.type == "filon-gauss";
}

std::vector<OscillatoryBasis> oscillatoryBases(const Settings& space, const System& system) {
    std::vector<OscillatoryBasis> bases(system.coordinates.size(), common(space));
    if (const Value* fast = given(space, "fast"))
        for (const int k : system.fast.coordinates)
            bases[static_cast<std::size_t>(k)] = changedBy(*fast, bases[static_cast<std::size_t>(k)], "/space/fast");
    const Value* variables = given(space, "variables");
    if (!variables) return bases;
    if (!variables->isObject())
        throw InvalidScene("/space/variables", "must be an object with one entry for each coordinate",
                           "for example { \"" + system.coordinates.front().name + "\": { \"degree\": 2, \"harmonics\": [1] } }");
    std::vector<std::string> names;
    for (const Coordinate& c : system.coordinates) names.push_back(c.name);
    for (const auto& [name, keys] : variables->asObject()) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidScene("/space/variables/" + name, system.id + " has no coordinate \"" + name + "\"",
                               "it has " + joinNames(names));
        auto& basis = bases[static_cast<std::size_t>(found - names.begin())];
        basis = changedBy(keys, basis, "/space/variables/" + name);
    }
    return bases;
}

std::vector<Table<double>> oscillatoryTables(const System& system, const Discretization& pair, double step) {
    const std::vector<OscillatoryBasis> bases = oscillatoryBases(pair.space, system);
    const double z = step * frequencyOf(pair.space, system);
    if (!(std::abs(z) <= 1e15))
        throw InvalidScene("/step", "times the frequency is " + formatNumber(std::abs(z), 3) +
                                        ": the phase after a step is lost to round-off beyond 1e15",
                           "a smaller step");
    const Settings rule = ruleFor(pair.quadrature, Extent(bases), z);
    const FilonNodes nodes = rule.type == "filon-gauss" ? FilonNodes::gauss : FilonNodes::lobatto;
    std::vector<Table<double>> tables;
    for (std::size_t k = 0; k < bases.size(); ++k) {
        const auto same = static_cast<std::size_t>(std::find(bases.begin(), bases.end(), bases[k]) - bases.begin());
        if (same < k)
            tables.push_back(tables[same]);
        else if (isFilon(rule))
            tables.push_back(makeOscillatoryTable(bases[k], z, nodes, rule.integer("nodes"), rule.integer("phases")));
        else
            tables.push_back(makeOscillatoryTable(bases[k], z, makeRule<double>(rule)));
    }
    return tables;
}

Settings completeOscillatoryRule(const Settings& space, const Settings& quadrature) {
    Settings q = quadrature;
    if (q.type.empty()) q.type = "auto";
    if (q.type == "auto") return {"auto", {}, {}};
    int nodes = panelNodes, phases = 0;
    try {
        const Extent extent(mentioned(space));
        if (isFilon(q)) nodes = extent.filonNodes();
        phases = extent.filonPhases();
    } catch (const InvalidScene&) {
        // Wrong keys are reported where the pair is made.
    }
    const auto set = [&](const char* key, Value value) {
        for (auto& member : q.keys)
            if (member.first == key) {
                if (member.second.isNull()) member.second = std::move(value);
                return;
            }
        q.keys.emplace_back(key, std::move(value));
    };
    if (q.type != "midpoint" && q.type != "trapezoid") set("nodes", nodes);
    if (q.type == "radau") set("end", "right");
    if (isFilon(q))
        set("phases", phases);
    else
        set("panels", 1.0);
    return q;
}

PairProperties describeOscillatory(const Settings& space, const Settings& quadrature) {
    PairProperties p;
    p.claims.isSymmetric = quadrature.type != "radau";
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    // No order: the error depends on the step, on the periods in it, and on the harmonics that are left out.
    p.knownAs = "multiscale";
    p.shortName = "MS";
    try {
        const Extent extent(mentioned(space));
        if (!isFilon(quadrature)) return p;
        const int nodes = quadrature.integer("nodes"), phases = quadrature.integer("phases");
        if (nodes < extent.degree + 1) {
            p.refusal = std::to_string(nodes) + " nodes do not see amplitudes of degree " + std::to_string(extent.degree);
            p.hint = "at least " + std::to_string(extent.degree + 1) + " nodes; " + std::to_string(extent.filonNodes()) +
                     " are accurate";
        } else if (phases < 4 * extent.harmonic + 1) {
            p.refusal = std::to_string(phases) + " phases do not see the square of harmonic " + std::to_string(extent.harmonic) +
                        ", which is in the kinetic energy";
            p.hint = "at least " + std::to_string(4 * extent.harmonic + 1) + " phases; " + std::to_string(extent.filonPhases()) +
                     " are accurate";
        }
    } catch (const InvalidScene&) {
        // Wrong keys are reported where the pair is made.
    }
    return p;
}

}  // namespace extremal
