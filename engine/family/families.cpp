// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/frequency.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/family/parts/tensor_rules.hpp"
#include "engine/family/parts/variant.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/table_of.hpp"
#include "engine/model/parts/refused_because.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal {
namespace {

/// A key for the memory: everything the result depends on.
std::string keyOf(const Settings& s) {
    std::string key = s.type;
    const std::function<void(const Value&)> add = [&](const Value& value) {
        if (value.isNumber()) key += formatNumber(value.asNumber());
        if (value.isString()) key += value.asString();
        if (value.isBool()) key += value.asBool() ? "true" : "false";
        if (value.isArray())
            for (const Value& entry : value.asArray()) {
                key += ',';
                add(entry);
            }
        if (value.isObject())
            for (const auto& [name, entry] : value.asObject()) {
                key += '{' + name + ':';
                add(entry);
                key += '}';
            }
    };
    for (const auto& [name, value] : s.keys) {
        key += '|' + name + '=';
        add(value);
    }
    return key;
}

double megabytes(const Properties&) { return 1e-3; }
double megabytes(const Table<double>& t) {
    const auto entries = 4 * t.value.size() + t.extrapolation.size() + t.change.size();
    return 8e-6 * static_cast<double>(entries);
}
double megabytes(const SharedCell& cell) { return 2 * megabytes(cell->table); }

/// What was made for a space and a rule before: a function of the settings alone. Sizes are in megabytes.
template <class V>
class KnownBySettings {
public:
    explicit KnownBySettings(std::string of) : of_(std::move(of)) {}

    template <class Make>
    V get(const Settings& space, const Settings& quadrature, Make&& make) {
        const std::string key = keyOf(space) + "||" + keyOf(quadrature);
        return known_.get(key, of_ + key, std::forward<Make>(make));
    }

private:
    std::string of_;
    CountedCache<std::string, V> known_{4096, 256.0, [](const V& v) { return megabytes(v); }};
};

/// The family of a space that the reader has found in the catalogue.
const Family& knownFamily(const Settings& space) {
    const Family* const family = familyOf(space);
    if (!family) throw InvalidScene("/space/type", "there is no space \"" + space.type + "\"");
    return *family;
}

}  // namespace

const Family* familyOf(const Settings& space) {
    for (const Family& family : families())
        for (const SpaceEntry& entry : family.spaces)
            if (entry.item.id == space.type) return &family;
    return nullptr;
}

bool appliesTo(const Family& family, const System& system) {
    return isTaken(family.takes, system.parts) && meetsCondition(family.parts, system);
}

bool isVariant(const Family& family, const System& system) {
    const auto* const variant = family.parts.find<Variant>();
    return variant && isTaken(variant->of, system.parts);
}

const Family* familyFor(const System& system) {
    for (const Family& family : families())
        if (!isVariant(family, system) && appliesTo(family, system)) return &family;
    return nullptr;
}

std::vector<ChoiceGrid> choiceGrids(const System& system) {
    const Family* const main = familyFor(system);
    if (!main) return {};
    std::vector<ChoiceGrid> grids{main->choices(system)};
    for (const Family& family : families()) {
        if (&family == main || !appliesTo(family, system)) continue;
        ChoiceGrid further = family.choices(system);
        const bool fit = !further.cells.empty() && std::all_of(further.cells.begin(), further.cells.end(),
                                                               [&](const ChoiceGrid::Cell& cell) {
                                                                   return isFor(cell.discretization, system);
                                                               });
        if (!fit) continue;
        ChoiceGrid& grid = grids.front();
        if (!isVariant(family, system) || further.width() != grid.width() ||
            further.columns.size() != grid.columns.size()) {
            grids.push_back(std::move(further));
            continue;
        }
        // One's own functions stay last.
        const auto width = static_cast<std::ptrdiff_t>(grid.width());
        const bool endsInOwn =
            !grid.cells.empty() && std::all_of(grid.cells.end() - width, grid.cells.end(),
                                               [](const auto& cell) { return cell.isOwn; });
        grid.rows.insert(grid.rows.end() - (endsInOwn ? 1 : 0), further.rows.begin(), further.rows.end());
        grid.cells.insert(grid.cells.end() - (endsInOwn ? width : 0), further.cells.begin(),
                          further.cells.end());
    }
    return grids;
}

ChoiceGrid choicesFor(const System& system) {
    const std::vector<ChoiceGrid> grids = choiceGrids(system);
    return grids.empty() ? ChoiceGrid{} : grids.front();
}

const Family* findFamily(std::string_view id) {
    for (const Family& family : families())
        if (family.item.id == id) return &family;
    return nullptr;
}

const std::vector<CatalogItem>& spaceCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> all;
        for (const Family& family : families())
            for (const SpaceEntry& entry : family.spaces) all.push_back(entry.item);
        std::sort(all.begin(), all.end(),
                  [](const CatalogItem& a, const CatalogItem& b) { return a.id < b.id; });
        return all;
    }();
    return items;
}

std::vector<CatalogItem> spacesFor(const System& system) {
    std::vector<CatalogItem> items;
    for (const Family& family : families())
        if (appliesTo(family, system))
            for (const SpaceEntry& entry : family.spaces) items.push_back(entry.item);
    return items;
}

const std::vector<std::string>& solverMethods(const Family& family) {
    static const std::vector<std::string> none;
    const auto* const methods = family.parts.find<SolverMethods>();
    return methods ? methods->ids : none;
}

TimeGrid timeGridOf(const Settings& space) {
    const auto* const own = familyPart<OwnTimeGrid>(space);
    return own ? own->of(space) : TimeGrid::fixed;
}

Properties describe(const Discretization& discretization) {
    static KnownBySettings<Properties> known("properties");
    const auto& [space, quadrature, solver, impact] = discretization;
    if (isTensorRule(quadrature) && !knownFamily(space).parts.find<TensorRules>()) {
        Properties p;
        refuseRule(quadrature, p);
        return p;
    }
    return known.get(space, quadrature, [&d = discretization] { return knownFamily(d.space).describe(d); });
}

Properties describe(const Discretization& discretization, const System& system) {
    const Family* const family = familyOf(discretization.space);
    const auto* const onSystem = family ? family->parts.find<DescribedOnSystem>() : nullptr;
    if (onSystem && appliesTo(*family, system))
        if (auto known = onSystem->describe(discretization, system)) return *std::move(known);
    return describe(discretization);
}

Settings completeQuadrature(const Settings& space, const Settings& quadrature) {
    if (isTensorRule(quadrature) || isTermRule(quadrature)) return quadrature;  // complete since it was read
    const Family* const family = familyOf(space);
    return family ? family->completeRule(space, quadrature)
                  : completePlainRule(quadrature, std::max(1, space.integer("degree")), 1);
}

std::string mismatch(const Discretization& discretization, const System& system) {
    const Family* const family = familyOf(discretization.space);
    if (!family) return "there is no space \"" + discretization.space.type + "\"";
    if (const auto* const because = system.parts.find<RefusedBecause>();
        because && !isTaken(family->takes, system.parts))
        return discretization.space.type + " is not for this " + system.id + ": " + because->reason;
    if (const std::string needed = neededInstead(family->takes, system.parts); !needed.empty())
        return discretization.space.type + " needs " + needed + ", which " + system.id + " is not";
    if (const std::string reason = unmetReason(family->parts, system); !reason.empty())
        return discretization.space.type + " is not for " + system.id + ": " + reason;
    if (!appliesTo(*family, system))
        return discretization.space.type + " needs " + family->item.needs + ", and " + system.id +
               " has none";
    const auto* const condition = family->parts.find<SchemeCondition>();
    return condition ? condition->mismatch(discretization, system) : std::string();
}

Discretization withEstimates(const Discretization& discretization, const System& system, const State& start) {
    const Family* const family = familyOf(discretization.space);
    const auto* const estimate = family ? family->parts.find<StartEstimate>() : nullptr;
    return estimate && appliesTo(*family, system) ? estimate->of(discretization, system, start)
                                                  : discretization;
}

std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& discretization,
                                           const Clock& clock) {
    const Family& family = knownFamily(discretization.space);
    if (!appliesTo(family, system)) throw InvalidScene("/space/type", mismatch(discretization, system));
    const std::string& method = discretization.solver.type;
    const auto& methods = solverMethods(family);
    if (!method.empty() && method != "auto" &&
        std::find(methods.begin(), methods.end(), method) == methods.end())
        throw InvalidScene("/solver/method",
                           method + " does not solve the equations of " + family.item.title + " schemes",
                           methods.empty() ? "leave it out" : "auto or " + joinNames(methods));
    return family.make(system, discretization, clock.step);
}

bool hasTable(const Discretization& discretization) {
    const auto* const tables = familyPart<Tables>(discretization.space);
    return tables && tables->isOne(discretization);
}

Table<double> tableOf(const Settings& space, const Settings& quadrature) {
    static KnownBySettings<Table<double>> known("table");
    return known.get(space, quadrature,
                     [&] { return knownFamily(space).parts.find<Tables>()->make(space, quadrature); });
}

SharedCell cellOf(const Settings& space, const Settings& quadrature) {
    static KnownBySettings<SharedCell> known("cell");
    return known.get(space, quadrature, [&] { return SharedCell(tableOf(space, quadrature)); });
}

std::optional<Discretization> namedScheme(std::string_view id) {
    const auto complete = [](Discretization made) {
        made.quadrature = completeQuadrature(made.space, made.quadrature);
        return made;
    };
    for (const SchemeEntry& e : schemeCatalog()) {
        if (e.maxDegree == 0) {
            if (e.item.id == id) return complete(e.make(0));
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
        if (degree >= e.minDegree && degree <= e.maxDegree) return complete(e.make(degree));
    }
    return std::nullopt;
}

double highestFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
    const Eigen::Index d = mass.rows();
    // Largest growth rate of the linearised flow by power iteration on (M^{-1} K)^2, K = -L_qq: enough for a
    // warning.
    const Eigen::MatrixXd A = dense::solve<double>(mass, stiffness);
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

namespace {

/// The Hessian of L in (q, v) at a state; empty where it is not finite, or the system has no coordinates.
Eigen::MatrixXd hessianAt(const System& system, const State& state) {
    if (!system.parts.find<Mechanical>()) return {};
    const int d = system.dimension();
    const auto& m = system.mechanics();
    Eigen::VectorXd v(d), gradient(2 * d);
    Eigen::MatrixXd H(2 * d, 2 * d);
    const double* q = state.x.data();
    double value = 0;
    if (!m.velocity(m.model.get(), state.t, q, q + d, v.data())) return {};
    m.jet(m.model.get(), state.t, q, v.data(), &value, gradient.data(), H.data());
    return H.allFinite() ? H : Eigen::MatrixXd();
}

}  // namespace

double highestFrequency(const System& system, const State& state) {
    if (system.frequency) return system.frequency(state.t, state.x.data());
    const Eigen::MatrixXd H = hessianAt(system, state);
    if (H.size() == 0) return 0;
    const Eigen::Index d = H.rows() / 2;
    return highestFrequency(H.bottomRightCorner(d, d), -H.topLeftCorner(d, d));
}

std::vector<double> linearFrequencies(const System& system, const State& state) {
    constexpr Eigen::Index most = 200;
    const auto highest = [](double w) { return w > 0 ? std::vector{w} : std::vector<double>{}; };
    if (system.frequency) return highest(system.frequency(state.t, state.x.data()));
    const Eigen::MatrixXd H = hessianAt(system, state);
    if (H.size() == 0) return {};
    const Eigen::Index d = H.rows() / 2;
    const Eigen::MatrixXd mass = H.bottomRightCorner(d, d), stiffness = -H.topLeftCorner(d, d),
                          mixed = H.topRightCorner(d, d);
    const bool isGyroscopic =
        (mixed - mixed.transpose()).cwiseAbs().maxCoeff() > 1e-12 * H.cwiseAbs().maxCoeff();
    if (d > most || isGyroscopic) return highest(highestFrequency(mass, stiffness));
    const auto masses = dense::symmetricEigen<double>(mass);
    if (!(masses.values(0) > 1e-13 * masses.values(d - 1))) return highest(highestFrequency(mass, stiffness));
    const Eigen::MatrixXd scale = masses.vectors * masses.values.cwiseSqrt().cwiseInverse().asDiagonal();
    const auto squares = dense::symmetricEigen<double>(scale.transpose() * stiffness * scale).values;
    std::vector<double> all;
    for (Eigen::Index i = 0; i < d; ++i)
        if (squares(i) > 1e-14 * squares.cwiseAbs().maxCoeff()) all.push_back(std::sqrt(squares(i)));
    return all;
}

}  // namespace extremal
