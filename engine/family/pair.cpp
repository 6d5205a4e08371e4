#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

#include "engine/action/table.hpp"
#include "engine/core/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/galerkin/table_of.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/stability.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/catalog.hpp"

namespace extremal {
namespace {

/// Half the trace of the step's map on L = (v^2 - z^2 q^2)/2 with h = 1.
double halfTrace(const Table<double>& t, double z) {
    const int m = t.unknowns();
    const Eigen::MatrixXd weighted = t.weight.asDiagonal() * t.testValue;
    const Eigen::MatrixXd stiffness = t.testDerivative.transpose() * t.weight.asDiagonal() * t.derivative;
    const Eigen::MatrixXd A = stiffness - z * z * weighted.transpose() * t.value;
    // Right-hand sides for (q_0, p_0) = (1, 0) and (0, 1).
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(m, 2);
    rhs.col(0) = z * z * weighted.colwise().sum().transpose();
    rhs(m - 1, 1) = -1;
    const Eigen::MatrixXd Y = dense::solve<double>(A, rhs);
    const double q = 1 + Y(m - 1, 0);
    const double p = 1 - z * z * t.weight.dot(t.value * Y.col(1));
    return (q + p) / 2;
}

std::string ordinal(const char* prefix, int order) { return prefix + std::to_string(order); }

/// Name by which the field knows the pair; degree s, rule with n nodes.
void nameOf(const Settings& space, const Settings& rule, int n, PairProperties& p) {
    const int s = space.integer("degree");
    if (space.type != "polynomial") {
        p.shortName = ordinal(space.type == "spline" ? "S" : "VI", p.claims.order);
        return;
    }
    if (rule.integer("panels") > 1) {
        p.shortName = ordinal("VI", p.claims.order);
        return;
    }
    const bool isTrapezoid = (rule.type == "trapezoid" && n == 2) || (rule.type == "lobatto" && n == 2) ||
                             (rule.type == "clenshaw-curtis" && n == 2);
    const bool isMidpoint = n == 1 && rule.type != "radau";
    p.isExplicit = s == 1 && (isTrapezoid || (rule.type == "radau" && n == 1));
    if (s == 1 && isMidpoint) {
        p.knownAs = "implicit midpoint";
        p.shortName = "mid";
    } else if (s == 1 && isTrapezoid) {
        p.knownAs = "Störmer-Verlet";
        p.shortName = "SV";
    } else if (s == 1 && rule.type == "radau" && n == 1) {
        p.knownAs = "symplectic Euler";
        p.shortName = "SE";
    } else if (rule.type == "gauss" && n == s) {
        p.knownAs = "Gauss collocation";
        p.shortName = ordinal("G", p.claims.order);
    } else if (rule.type == "lobatto" && n == s + 1) {
        p.knownAs = "Lobatto IIIA-IIIB";
        p.shortName = ordinal("L", p.claims.order);
    } else if (rule.type == "clenshaw-curtis") {
        p.knownAs = "spectral variational";
        p.shortName = ordinal("CC", p.claims.order);
    } else {
        p.shortName = ordinal(rule.type == "radau" ? "R" : "VI", p.claims.order);
    }
}

/// The error of L_d over h^(2 degree + 1) from the space, h^(order of the rule + 1) from the rule on the
/// solution, and h^(2 consistency + 1) from the rule in the stationarity conditions, where it counts twice.
int orderOf(const Table<double>& table) {
    return std::min({2 * table.space.degree, table.rule.degree + 1, 2 * table.consistency});
}

/// Which of the three bounds on the order is the rule's doing.
std::string shortfallOf(const Table<double>& table) {
    const int order = orderOf(table), ofSpace = 2 * table.space.degree;
    if (order >= ofSpace) return {};
    const std::string bound =
        "order " + std::to_string(order) + ", not the " + std::to_string(ofSpace) + " of the space: ";
    const std::string exact = "the rule is exact to degree " + std::to_string(table.rule.degree);
    if (table.rule.degree + 1 <= order) return bound + exact;
    return bound + exact + ", too little for the equations inside the step";
}

PairProperties makeDescription(const Settings& space, const Settings& quadrature) {
    if (const PairFamily* family = familyOf(space); family && family->describe)
        return family->describe(space, quadrature);
    PairProperties p;
    if (const RuleEntry* rule = findRule(quadrature.type); rule && !rule->make) {
        p.refusal = rule->refusal;
        p.hint = rule->hint;
        p.shortName = "-";
        return p;
    }
    const Rule<double> rule = makeRule<double>(quadrature);
    p.claims.isSymmetric = rule.isSymmetric;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    const bool isLie = space.type == "lie-polynomial";
    try {
        const Table<double> table = tableOf(space, quadrature);
        p.claims.order = orderOf(table);
        p.curveOrder = std::min({table.space.degree + 1, table.consistency + 1, p.claims.order});
        p.stabilityLimit = firstInstability([&](double z) { return halfTrace(table, z); });
        // A limit of the oscillator says nothing of a turning body.
        if (isLie && p.stabilityLimit > 0) p.stabilityLimit = std::numeric_limits<double>::infinity();
        p.shortfall = shortfallOf(table);
        if (table.consistency == 0) {
            p.refusal =
                "the rule does not integrate the velocities of the space: not even a free particle would "
                "keep its speed";
            p.hint = "a rule that is exact for degree " +
                     std::to_string(std::max(0, table.space.degree - 1)) + " between the knots of the space";
        }
    } catch (const InvalidScene& e) {
        p.refusal = e.problems().front().message;
        p.hint = e.problems().front().hint;
    }
    if (isLie) {
        // The chart at the start of the step is seen from one side; but a curve of degree 1 has the same
        // charts at both ends.
        p.claims.isSymmetric = rule.isSymmetric && (space.flag("symmetric") || space.integer("degree") == 1);
        p.shortName = ordinal("Lie", p.claims.order);
    } else {
        nameOf(space, quadrature, rule.size(), p);
    }
    if (p.knownAs == "Gauss collocation" || p.knownAs == "implicit midpoint")
        p.claims.conserves.push_back("quadratic invariants");
    return p;
}

/// A key for the memory: everything the description depends on.
std::string keyOf(const Settings& s) {
    std::string key = s.type;
    for (const auto& [name, value] : s.keys) {
        key += '|' + name + '=';
        if (value.isNumber()) key += formatNumber(value.asNumber());
        if (value.isString()) key += value.asString();
        if (value.isBool()) key += value.asBool() ? "true" : "false";
    }
    return key;
}

/// What was made for a pair before. A result is a function of the settings alone, so it does not matter who
/// asked first.
template <class V>
class Memory {
public:
    template <class Make>
    V get(const Settings& space, const Settings& quadrature, Make make) {
        const std::string key = keyOf(space) + "||" + keyOf(quadrature);
        {
            const std::lock_guard lock(mutex_);
            if (const auto found = known_.find(key); found != known_.end()) return found->second;
        }
        V made = make();
        const std::lock_guard lock(mutex_);
        if (known_.size() >= 256) known_.clear();
        return known_.emplace(key, std::move(made)).first->second;
    }

private:
    std::mutex mutex_;
    std::map<std::string, V> known_;
};

}  // namespace

PairProperties describe(const Settings& space, const Settings& quadrature) {
    if (isTensorRule(quadrature)) {
        PairProperties p;
        p.refusal = findRule(quadrature.type)->refusal;
        p.hint = findRule(quadrature.type)->hint;
        p.shortName = "-";
        return p;
    }
    if (!hasOneTable(space)) return familyOf(space)->describe(space, quadrature);
    static Memory<PairProperties> known;
    return known.get(space, quadrature, [&] { return makeDescription(space, quadrature); });
}

bool hasOneTable(const Settings& space) {
    const PairFamily* const family = familyOf(space);
    return !family || family->hasOneTable;
}

Table<double> tableOf(const Settings& space, const Settings& quadrature) {
    static Memory<Table<double>> known;
    return known.get(space, quadrature,
                     [&] { return makeTable(makeSpace(space), makeRule<double>(quadrature)); });
}

Settings completeQuadrature(const Settings& space, const Settings& quadrature) {
    if (isTensorRule(quadrature)) return quadrature;  // complete since it was read
    if (const PairFamily* family = familyOf(space); family && family->complete)
        return family->complete(space, quadrature);
    Settings q = quadrature;
    if (q.type.empty() || q.type == "auto")
        q = {space.text("form") == "three-level" ? "exact" : "gauss", {}, {}};
    const int cells = space.type == "spline" ? space.integer("cells") : 1;
    return completeRule(q, {space.integer("degree"), cells});
}

std::optional<Discretization> namedScheme(std::string_view id) {
    for (const SchemeEntry& e : schemeCatalog()) {
        if (e.maxDegree == 0) {
            if (e.item.id == id) return e.make(0);
            continue;
        }
        const std::string_view family = std::string_view(e.item.id).substr(0, e.item.id.find('<'));
        if (!id.starts_with(family) || id.size() == family.size() || id.size() > family.size() + 2) continue;
        int degree = 0;
        for (const char c : id.substr(family.size())) {
            if (c < '0' || c > '9' || (degree == 0 && c == '0')) {
                degree = -1;
                break;
            }
            degree = 10 * degree + (c - '0');
        }
        if (degree >= e.minDegree && degree <= e.maxDegree) return e.make(degree);
    }
    return std::nullopt;
}

bool isPairFor(const Discretization& pair, const System& system) {
    for (const SpaceEntry& e : spaceEntries())
        if (e.item.id == pair.space.type)
            return appliesTo(e, system) && (pair.space.text("omega") != "model" || system.fast.frequency > 0);
    return false;
}

Discretization settled(const Discretization& pair, const System& system, const State& start) {
    Discretization known = pair;
    if (isOscillatory(pair.space) && pair.space.text("omega") == "estimate" && isMechanical(system))
        for (auto& [key, value] : known.space.keys)
            if (key == "omega") value = estimateFrequency(system, start);
    return withShift(known, system, start);
}

Discretization trustedPair(const System& system) {
    Discretization pair;
    if (isBody(system)) {
        pair.space = {"lie-polynomial", {{"degree", 8.0}, {"symmetric", false}, {"reduced", true}}, {}};
        pair.quadrature = {"gauss", {{"nodes", 8.0}}, {}};
        return pair;
    }
    if (isWave(system)) {
        pair.space = {"fourier",
                      {{"degree", 8.0}, {"energy_shift", "mean"}, {"form", "one-step"}, {"start", "gauss"}},
                      {}};
        pair.quadrature = {"gauss", {{"nodes", 8.0}}, {}};
        return pair;
    }
    constexpr double degree = 12;
    pair.space = {"polynomial", {{"degree", degree}, {"basis", "lobatto"}}, {}};
    pair.quadrature = {"gauss", {{"nodes", degree}}, {}};
    return pair;
}

std::string trustedName(const System& system) {
    if (isWave(system)) return "Gauss of degree 8";
    return isBody(system) ? "Lie group Gauss of degree 8" : "Gauss collocation of degree 12";
}

double highestFrequency(const System& system, const State& state) {
    if (system.frequency) return system.frequency(state.t, state.x.data());
    if (!isMechanical(system)) return 0;
    const int d = system.dimension();
    const auto& m = system.mechanics();
    Eigen::VectorXd v(d), gradient(2 * d);
    Eigen::MatrixXd H(2 * d, 2 * d);
    const double* q = state.x.data();
    double value = 0;
    if (!m.velocity(m.model.get(), state.t, q, q + d, v.data())) return 0;
    m.jet(m.model.get(), state.t, q, v.data(), &value, gradient.data(), H.data());
    if (!H.allFinite()) return 0;
    // Largest growth rate of the linearised flow by power iteration on (M^{-1} K)^2, K = -L_qq: enough for a
    // warning.
    const Eigen::MatrixXd A = dense::solve<double>(H.bottomRightCorner(d, d), -H.topLeftCorner(d, d));
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(d, 1, 1.5);
    double eigenvalue = 0;
    for (int i = 0; i < 500 && x.norm() > 0; ++i) {
        x.normalize();
        const Eigen::VectorXd y = A * x;
        eigenvalue = x.dot(y);
        x = y + 1e-3 * y.norm() * x;  // a small shift breaks ties between eigenvalues of opposite sign
    }
    return eigenvalue > 0 && std::isfinite(eigenvalue) ? std::sqrt(eigenvalue) : 0;
}

}  // namespace extremal
