// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/split.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/action/combined_table.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/frequency.hpp"
#include "engine/family/galerkin/tables.hpp"
#include "engine/family/kept_momenta.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/ruled_terms.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/model/lagrangian_terms.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/typed.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal::galerkin {
namespace {

bool isByCoordinate(const Settings& space) { return space.find("otherwise") != nullptr; }

std::vector<Settings> spacesOf(const Settings& space, const System& system) {
    if (!isByCoordinate(space)) return {space};
    std::vector<Settings> all(system.coordinates.size(), settingsOf(*space.find("otherwise")));
    std::vector<std::string> names;
    for (const Coordinate& c : system.coordinates) names.push_back(c.name);
    for (const auto& [name, own] : space.find("variables")->asObject()) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidScene("/space/variables/" + name, system.id + " has no coordinate \"" + name + "\"",
                               "it has " + joinNames(names));
        all[static_cast<std::size_t>(found - names.begin())] = settingsOf(own);
    }
    return all;
}

/// The gradient at some places: what a part depends on.
void findDependence(const LagrangianTerm<double>& part, int dimension, std::vector<bool>& sees,
                    std::vector<bool>& moves) {
    const auto d = static_cast<std::size_t>(dimension);
    sees.assign(d, false);
    moves.assign(d, false);
    std::vector<double> q(d), v(d), gradient(2 * d);
    for (int trial = 1; trial <= 4; ++trial) {
        for (std::size_t k = 0; k < d; ++k) {
            q[k] = std::sin(1.3 * trial + 0.7 * static_cast<double>(k)) + 0.1;
            v[k] = std::cos(0.9 * trial + 1.1 * static_cast<double>(k)) - 0.1;
        }
        part.gradient(part.model.get(), 0.37 * trial, q.data(), v.data(), gradient.data());
        for (std::size_t k = 0; k < d; ++k) {
            moves[k] = moves[k] || gradient[d + k] != 0;
            sees[k] = sees[k] || moves[k] || gradient[k] != 0;
        }
    }
}

/// Panels that were left out are the cells of the finest space that the part sees.
void fillPanels(Split& split, std::size_t r) {
    Settings& rule = split.rules[r];
    if (const Value* given = rule.find("panels"); given && !given->isNull()) return;
    int cells = 1;
    for (std::size_t k = 0; k < split.sees[r].size(); ++k)
        if (split.sees[r][k])
            cells = std::max(cells, cellsIn(split.spaces[split.spaces.size() == 1 ? 0 : k]));
    std::erase_if(rule.keys, [](const auto& key) { return key.first == "panels"; });
    rule.keys.emplace_back("panels", static_cast<double>(cells));
}

/// The space whose cells the panels of a part are made for.
std::size_t finest(const Split& split, std::size_t r) {
    std::size_t best = 0;
    int most = 0;
    for (std::size_t k = 0; k < split.spaces.size(); ++k) {
        const bool isSeen = split.spaces.size() == 1 || split.sees[r][k];
        if (isSeen && cellsIn(split.spaces[k]) > most) {
            most = cellsIn(split.spaces[k]);
            best = k;
        }
    }
    return best;
}

std::string velocityRemedy(const Settings& space) {
    const int degree = space.integer("degree");
    return degree > 0 ? "gauss with " + std::to_string(degree) + " nodes" +
                            (cellsIn(space) > 1 ? " in each cell" : "") + " or better"
                      : "a rule with more nodes";
}

/// All that the table of a part in one space depends on.
struct PartKey {
    Settings space;
    Settings panels;  ///< the space whose cells the panels of the rule are made for
    Settings rule;
    bool operator==(const PartKey&) const = default;
};

/// The table of a part in one space, remembered: describing a scheme, checking it and making its step want
/// the same one, and it is computed in quadruple precision.
Table<double> partTable(const Space<double>& space, const Rule<double>& rule, const PartKey& key) {
    static MemoCache<PartKey, Table<double>> known(64);
    return known.get(key, [&] { return makePartTable(space, rule); });
}

/// Table (r, k) of part r in the space of coordinate k; refused where velocities are under a poor rule.
std::vector<std::vector<Table<double>>> partTables(const Split& split, double step) {
    std::vector<Settings> settings;
    std::vector<Space<double>> spaces;
    for (const Settings& space : split.spaces) {
        settings.push_back(withStep(space, step));
        spaces.push_back(makeSpace(settings.back()));
    }
    std::vector<std::vector<Table<double>>> all;
    for (std::size_t r = 0; r < split.parts.size(); ++r) {
        const std::size_t panels = finest(split, r);
        const Rule<double> rule = ruleOn<double>(spaces[panels], split.rules[r]);
        all.emplace_back();
        for (std::size_t k = 0; k < spaces.size(); ++k) {
            Table<double> table = partTable(spaces[k], rule, {settings[k], settings[panels], split.rules[r]});
            table.dependsOnStep = dependsOnStep(split.spaces[k]);
            const bool moves = spaces.size() == 1 ? std::any_of(split.moves[r].begin(), split.moves[r].end(),
                                                                [](bool m) { return m; })
                                                  : split.moves[r][k];
            const bool isRegular = table.nodes() > 0 && kineticValues(table).cwiseAbs().minCoeff() > 1e-8;
            if (moves && (!isRegular || (table.consistency == 0 && !table.dependsOnStep)))
                throw InvalidScene("/quadrature/" + split.parts[r].name,
                                   "\"" + split.parts[r].name +
                                       "\" has velocities, which its rule does not integrate" +
                                       (isRegular ? "" : ": some motions inside a step would cost no action"),
                                   velocityRemedy(split.spaces[k]));
            all.back().push_back(std::move(table));
        }
    }
    return all;
}

/// Smallest k with (rule_r - A)(tau^k phi_a) != 0 for an interior function; `most` if there is none below.
int firstDifference(const Table<double>& part, const Table<double>& kinetic, int most) {
    Eigen::VectorXd there = part.weight, here = kinetic.weight;
    for (int k = 0; k < most; ++k) {
        for (int a = 0; a < part.unknowns() - 1; ++a)
            if (std::abs(there.dot(part.value.col(a)) - here.dot(kinetic.value.col(a))) > 1e-9) return k;
        there.array() *= part.node.array();
        here.array() *= kinetic.node.array();
    }
    return most;
}

/// "order 2, not 8: the rule of "slow" has degree 3".
void predict(const Split& split, const std::vector<std::vector<Table<double>>>& tables, Properties& p) {
    int ofSpace = 1000, order = 1000;
    std::string reason;
    const auto bound = [&](int value, const std::string& why) {
        if (value >= order) return;
        order = value;
        reason = why;
    };
    for (std::size_t k = 0; k < split.spaces.size(); ++k)
        ofSpace = std::min(ofSpace, 2 * tables.front()[k].space.degree);
    bound(ofSpace, "");
    p.claims.isSymmetric = true;
    for (std::size_t r = 0; r < split.parts.size(); ++r) {
        const std::string name = "the rule of \"" + split.parts[r].name + "\"";
        const Rule<double>& rule = tables[r].front().rule;
        const std::string degree = name + " has degree " + std::to_string(rule.degree);
        p.claims.isSymmetric = p.claims.isSymmetric && rule.isSymmetric;
        bound(rule.degree + 1, degree);
        for (std::size_t k = 0; k < split.sees[r].size(); ++k) {
            const std::size_t s = split.spaces.size() == 1 ? 0 : k;
            if (!split.sees[r][k]) continue;
            const Table<double>& part = tables[r][s];
            p.claims.isSymmetric = p.claims.isSymmetric && part.space.isSymmetric;
            if (split.moves[r][k]) {
                bound(2 * part.consistency, degree);
            } else {
                const Table<double>& kinetic = tables[split.kineticPart(k)][s];
                bound(2 * (1 + firstDifference(part, kinetic, part.space.degree + 1)),
                      degree + ", too little for the equations inside the step");
            }
        }
    }
    p.claims.order = std::max(order, 0);
    p.curveOrder = std::min(p.claims.order, ofSpace / 2 + 1);
    if (order < ofSpace)
        p.shortfall = "order " + std::to_string(order) + ", not " + std::to_string(ofSpace) + ": " + reason;
}

std::string spaceName(const Discretization& d) {
    if (!isByCoordinate(d.space)) return {};
    return "a space for each coordinate";
}

Properties described(const Discretization& discretization, const Split& split) {
    Properties p;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    p.stabilityLimit = std::numeric_limits<double>::infinity();  // of two frequencies: checked at the step
    constexpr double small = 1.0 / 64;
    predict(split, partTables(split, small), p);
    p.shortName = "VI" + std::to_string(p.claims.order);
    p.space = spaceName(discretization);
    return p;
}

Properties refused(const InvalidScene& error, const Discretization& discretization) {
    Properties p;
    refuse(error, p);
    if (p.place.empty()) p.place = error.problems().front().pointer;
    p.shortName = "-";
    p.space = spaceName(discretization);
    return p;
}

/// -L_qq of a part at a state, at rest; empty where it is not finite.
Eigen::MatrixXd stiffnessOf(const LagrangianTerm<double>& part, const State& at, Eigen::Index d) {
    std::vector<double> v(static_cast<std::size_t>(d), 0.0), gradient(static_cast<std::size_t>(2 * d));
    Eigen::MatrixXd H(2 * d, 2 * d);
    double value = 0;
    part.jet(part.model.get(), at.t, at.x.data(), v.data(), &value, gradient.data(), H.data());
    if (!H.allFinite()) return {};
    return -H.topLeftCorner(d, d);
}

/// Half the trace of a step of length 1 on L = v^2/2 - sum_r z_r^2 q^2/2, each term under its rule.
double halfTraceOf(const Table<double>& kinetic, const std::vector<const Table<double>*>& parts,
                   const std::vector<double>& z) {
    const Eigen::Index m = kinetic.unknowns();
    Eigen::MatrixXd J = kinetic.testDerivative.transpose() * kinetic.weight.asDiagonal() * kinetic.derivative;
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(m, 2);
    Eigen::RowVectorXd impulse = Eigen::RowVectorXd::Zero(m);
    rhs(m - 1, 1) = -1;
    for (std::size_t r = 0; r < parts.size(); ++r) {
        const Table<double>& part = *parts[r];
        const double square = z[r] * z[r];
        J -= square * part.testValue.transpose() * part.weight.asDiagonal() * part.value;
        rhs.col(0) += square * part.testValue.transpose() * part.weight;
        impulse += square * part.weight.transpose() * part.value;
    }
    const Eigen::MatrixXd Y = dense::solve<double>(J, rhs);
    return (1 + Y(m - 1, 0) + 1 - impulse.dot(Y.col(1))) / 2;
}

/// Of the space of one coordinate, or of the only one; frequencyOf(r): of part r at the start, 0 where it
/// does not oscillate.
void warnOfBand(const Split& split, const std::vector<std::vector<Table<double>>>& tables, std::size_t space,
                const SchemeCase& scheme, const std::string& whose, Findings& findings,
                const std::function<double(std::size_t)>& frequencyOf) {
    std::vector<const Table<double>*> parts;
    std::vector<double> z;
    std::string frequencies;
    for (std::size_t r = 0; r < split.parts.size(); ++r) {
        const double w = frequencyOf(r);
        if (!(w > 0)) continue;
        parts.push_back(&tables[r][space]);
        z.push_back(w * scheme.step);
        frequencies +=
            (frequencies.empty() ? "" : ", ") + formatNumber(z.back(), 3) + " of " + split.parts[r].name;
    }
    const double trace = halfTraceOf(tables[split.kineticPart(space)][space], parts, z);
    // Half a trace of double precision says nothing of growth below 1e-7.
    if (!(std::abs(trace) > 1 + 1e-13)) return;
    const double growth = std::acosh(std::abs(trace));
    const double steps = std::abs(scheme.end - scheme.initial.t) / scheme.step;
    if (growth * steps > 1)
        findings.warning("/step",
                         "is in a band of instability" + whose + ": with step times frequency " +
                             frequencies + ", half the trace of a step is " + formatNumber(trace, 4) +
                             ", beyond 1: growth " + formatNumber(growth, 2) + " a step, e^" +
                             formatNumber(growth * steps, 2) + " in this run",
                         "another step; degree 1 with the midpoint rule for the fast terms has no bands", {},
                         "rule-per-term");
}

/// "b" alone changes under the rotation in the plane x-y: symmetries that a part does not have.
std::vector<std::string> lostSymmetries(const Discretization& d, const System& system) {
    std::vector<std::string> lost;
    for (const Symmetry& s : *symmetriesOf(system)) {
        if (!s.isExact() || s.movesTime() || !s.F.empty() || keeps(d, s, system)) continue;
        const std::string part =
            isTermRule(d.quadrature) ? breakerOf(ruledTerms(system.mechanics(), d.quadrature), s) : "";
        lost.push_back(part.empty() ? "the coordinates that the " + s.title + " mixes have different spaces"
                                    : "\"" + part + "\" alone changes under the " + s.title);
    }
    return lost;
}

}  // namespace

bool isSplit(const Discretization& d) { return isTermRule(d.quadrature) || isByCoordinate(d.space); }

std::size_t Split::kineticPart(std::size_t coordinate) const {
    for (std::size_t r = 0; r < parts.size(); ++r)
        if (moves[r][coordinate]) return r;
    return 0;
}

Split splitOf(const System& system, const Discretization& d) {
    Split split;
    split.spaces = spacesOf(d.space, system);
    const Mechanics<double>& mechanics = system.mechanics();
    const auto dependence = [&] {
        split.sees.resize(split.parts.size());
        split.moves.resize(split.parts.size());
        for (std::size_t r = 0; r < split.parts.size(); ++r) {
            findDependence(split.parts[r], mechanics.dimension, split.sees[r], split.moves[r]);
            fillPanels(split, r);
        }
    };
    if (!isTermRule(d.quadrature)) {
        split.parts = {{"L", mechanics.model, mechanics.jet, mechanics.gradient, true}};
        split.rules = {d.quadrature};
        dependence();
        return split;
    }
    const std::vector<LagrangianTerm<double>> terms = termsOf(mechanics);
    std::vector<std::string> names;
    for (const auto& term : terms) names.push_back(term.name);
    if (terms.empty())
        throw InvalidScene("/quadrature", system.id + " is not given in terms, and has one rule for all",
                           "one rule; or a model of type \"lagrangian\" with an object of named terms");
    for (const auto& [name, rule] : d.quadrature.keys)
        if (name != otherTerms && std::find(names.begin(), names.end(), name) == names.end())
            throw InvalidScene("/quadrature/" + name, system.id + " has no term \"" + name + "\"",
                               "it has " + joinNames(names));
    for (RuledTerms& ruled : ruledTerms(mechanics, d.quadrature)) {
        split.rules.push_back(ruled.rule.type.empty() ? completedRule(d.space, {}) : std::move(ruled.rule));
        split.parts.push_back(std::move(ruled.part));
    }
    dependence();
    return split;
}

std::vector<Table<double>> tablesOf(const Split& split, double step) {
    const auto tables = partTables(split, step);
    std::vector<Table<double>> made;
    for (std::size_t k = 0; k < split.spaces.size(); ++k) {
        std::vector<Table<double>> own;
        for (const auto& part : tables) own.push_back(part[k]);
        made.push_back(own.size() == 1 ? own.front() : combined(own, split.kineticPart(k)));
    }
    return made;
}

Properties describeSplit(const Discretization& discretization, const System& system) {
    try {
        Properties p = described(discretization, splitOf(system, discretization));
        if (!lostSymmetries(discretization, system).empty()) p.claims.conserves.clear();
        return p;
    } catch (const InvalidScene& e) {
        return refused(e, discretization);
    }
}

Properties describeSplit(const Discretization& d) {
    Split split;
    try {
        if (isByCoordinate(d.space)) {
            split.spaces = {settingsOf(*d.space.find("otherwise"))};
            for (const auto& [name, own] : d.space.find("variables")->asObject())
                split.spaces.push_back(settingsOf(own));
        } else {
            split.spaces = {d.space};
        }
        const std::size_t count = split.spaces.size();
        const auto add = [&](const std::string& name, const Settings& rule, bool moves) {
            if (rule.type.empty()) return;
            split.parts.push_back({name, nullptr, nullptr, nullptr, moves});
            split.rules.push_back(rule);
            split.sees.emplace_back(count, true);
            split.moves.emplace_back(count, moves);
            fillPanels(split, split.rules.size() - 1);
        };
        if (isTermRule(d.quadrature)) {
            const bool isNamed = d.quadrature.find("kinetic") != nullptr;
            for (const auto& [name, rule] : d.quadrature.keys)
                add(name, settingsOf(rule), isNamed ? name == "kinetic" : name == otherTerms);
            if (!isNamed && !d.quadrature.find(otherTerms)) add(otherTerms, completedRule(d.space, {}), true);
        } else {
            add("L", d.quadrature, true);
        }
        return described(d, split);
    } catch (const InvalidScene& e) {
        return refused(e, d);
    }
}

void checkSplit(const SchemeCase& scheme, Findings& findings) {
    const Split split = splitOf(scheme.system, scheme.discretization);
    for (const std::string& reason : lostSymmetries(scheme.discretization, scheme.system))
        findings.warning("/quadrature", "does not keep a momentum of the system: " + reason,
                         "one rule for terms, and one space for coordinates, that belong together", {},
                         "momentum");
    const Mechanics<double>& mechanics = scheme.system.mechanics();
    const auto d = mechanics.dimension;
    std::vector<double> v(static_cast<std::size_t>(d)), gradient(static_cast<std::size_t>(2 * d));
    Eigen::MatrixXd H(2 * d, 2 * d);
    double value = 0;
    const double* q = scheme.initial.x.data();
    if (!mechanics.velocity(mechanics.model.get(), scheme.initial.t, q, q + d, v.data())) return;
    mechanics.jet(mechanics.model.get(), scheme.initial.t, q, v.data(), &value, gradient.data(), H.data());
    if (!H.allFinite()) return;
    const Eigen::MatrixXd mass = H.bottomRightCorner(d, d);
    const auto tables = partTables(split, scheme.step);
    if (split.spaces.size() == 1) {
        warnOfBand(split, tables, 0, scheme, "", findings, [&](std::size_t r) {
            const Eigen::MatrixXd K = stiffnessOf(split.parts[r], scheme.initial, d);
            return K.size() > 0 ? highestFrequency(mass, K) : 0;
        });
        return;
    }
    // Each coordinate for itself, the others at rest.
    for (Eigen::Index k = 0; k < d; ++k) {
        const std::string& name = scheme.system.coordinates[static_cast<std::size_t>(k)].name;
        warnOfBand(split, tables, static_cast<std::size_t>(k), scheme, " of " + name, findings,
                   [&](std::size_t r) {
                       const Eigen::MatrixXd K = stiffnessOf(split.parts[r], scheme.initial, d);
                       return K.size() > 0 && K(k, k) > 0 ? std::sqrt(K(k, k) / mass(k, k)) : 0;
                   });
    }
}

}  // namespace extremal::galerkin
