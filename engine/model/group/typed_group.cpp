// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/typed_group.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/algebra/elimination.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape.hpp"
#include "engine/model/typed/tape_registers.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;
using Matrix = MatrixGroup::Matrix;
using Parameters = std::vector<std::pair<std::string, double>>;

/// What entry e of g E_a, or of g E_b E_a, is: a sum of value g_entry.
struct Share {
    int a, b, entry;
    double value;
};
struct UsedEntry {
    int entry = 0;
    std::vector<Share> first, second;
};

/// Inputs of the tapes: xi, then the entries that occur.
struct TypedGroup {
    int d = 0;
    std::vector<UsedEntry> used;
    std::vector<int> isotropy;  ///< GroupMechanics::isotropy
    bool isQuadratic = false;   ///< in xi
    typed::Tape gradient, jet;  ///< L and its gradient; the same and the second derivatives of `places`
    std::vector<std::pair<int, int>> places;  ///< (i, j), j <= i
};

const TypedGroup& self(const void* p) { return *static_cast<const TypedGroup*>(p); }

/// One evaluation of a tape at (g, eta).
class Evaluated : public typed::TapeRegisters {
public:
    Evaluated(const TypedGroup& of, const typed::Tape& tape, const double* g, const double* eta)
        : TapeRegisters(tape, [&](double* r) {
              r = std::copy_n(eta, of.d, r);
              for (const UsedEntry& e : of.used) *r++ = g[e.entry];
          }) {}
};

template <class Registers>
void fillGradient(const TypedGroup& of, const Registers& r, const double* g, double* value, double* m,
                  double* f) {
    const auto d = static_cast<std::size_t>(of.d);
    *value = r[0];
    for (std::size_t i = 0; i < d; ++i) m[i] = r[1 + i];
    if (!f) return;
    std::fill_n(f, d, 0.0);
    for (std::size_t e = 0; e < of.used.size(); ++e) {
        const double slope = r[1 + d + e];
        for (const Share& s : of.used[e].first) f[s.a] += slope * s.value * g[s.entry];
    }
}

void gradientAt(const void* p, const double* g, const double* eta, double* value, double* m, double* f) {
    const TypedGroup& of = self(p);
    fillGradient(of, Evaluated(of, of.gradient, g, eta), g, value, m, f);
}

void jetAt(const void* p, const double* g, const double* eta, double* value, double* m, double* f, double* M,
           double* N, double* S) {
    const TypedGroup& of = self(p);
    const Evaluated r(of, of.jet, g, eta);
    fillGradient(of, r, g, value, m, f);
    const int d = of.d;
    Eigen::Map<Matrix> mass(M, d, d);
    mass.setZero();
    const std::size_t first = 1 + static_cast<std::size_t>(d) + of.used.size();
    if (!f) {
        for (std::size_t k = 0; k < of.places.size(); ++k)
            if (const auto [i, j] = of.places[k]; i < d) mass(i, j) = mass(j, i) = r[first + k];
        return;
    }
    Eigen::Map<Matrix> mixed(N, d, d), slope(S, d, d);
    mixed.setZero();
    slope.setZero();
    // Row e: how entry e of g moves along g E_a.
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, MatrixGroup::maxEntries,
                  MatrixGroup::maxDimension>
        moves(static_cast<Eigen::Index>(of.used.size()), d);
    moves.setZero();
    for (std::size_t e = 0; e < of.used.size(); ++e) {
        const auto row = static_cast<Eigen::Index>(e);
        for (const Share& s : of.used[e].first) moves(row, s.a) += s.value * g[s.entry];
        const double by = r[1 + static_cast<std::size_t>(d) + e];
        for (const Share& s : of.used[e].second) slope(s.a, s.b) += by * s.value * g[s.entry];
    }
    for (std::size_t k = 0; k < of.places.size(); ++k) {
        const auto [i, j] = of.places[k];
        const double h = r[first + k];
        if (i < d) {
            mass(i, j) = mass(j, i) = h;
        } else if (j < d) {
            mixed.row(j) += h * moves.row(i - d);
        } else {
            slope += h * moves.row(i - d).transpose().lazyProduct(moves.row(j - d));
            if (i != j) slope += h * moves.row(j - d).transpose().lazyProduct(moves.row(i - d));
        }
    }
}

/// Newton's method on dL/deta = mu from rest; one step where L is quadratic in eta.
bool velocityAt(const void* p, const double* g, const double* mu, double* eta) {
    const TypedGroup& of = self(p);
    Vector x = Vector::Zero(of.d), m(of.d);
    Matrix M(of.d, of.d);
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 100; ++iteration) {
        double value = 0;
        jetAt(p, g, x.data(), &value, m.data(), nullptr, M.data(), nullptr, nullptr);
        Vector rest = Eigen::Map<const Vector>(mu, of.d) - m;
        for (const int k : of.isotropy) {
            rest(k) = 0;
            M(k, k) = 1;
        }
        if (!rest.allFinite() || !M.allFinite()) return false;
        Vector change = rest;
        eliminate(of.d, M.data(), change.data());
        if (!change.allFinite()) return false;
        x += change;
        const double size = change.norm(), scale = x.norm();
        const bool isFound = of.isQuadratic || size <= 1e-15 * scale ||
                             (iteration > 5 && size >= last && size <= 1e-10 * scale) || rest.isZero(0);
        if (isFound) {
            std::copy_n(x.data(), of.d, eta);
            return true;
        }
        last = size;
    }
    return false;
}

std::string entryName(const MatrixGroup::Factor& f, int row, int column) {
    const std::string prefix = f.name.empty() ? "" : f.name + "_", i = std::to_string(row + 1),
                      j = std::to_string(column + 1);
    return prefix + (f.n > 9 ? "g_" + i + "_" + j : "g" + i + j);
}

/// Names that a formula may use, and what is wrong with one that it may not.
class Names {
public:
    Names(const MatrixGroup& group, const Parameters& parameters, const OwnNames& own)
        : velocities_(velocityNames(group)), entries_(entryNames(group)) {
        for (const auto& [name, meaning] : own.meanings) known_.push_back(name);
        std::vector<std::string>& inFormulas = own.meanings.empty() ? known_ : taken_;
        inFormulas.insert(inFormulas.end(), velocities_.begin(), velocities_.end());
        inFormulas.insert(inFormulas.end(), entries_.begin(), entries_.end());
        hint_ = "names: " +
                (own.meanings.empty() ? velocities_.front() + ".." + velocities_.back() + ", " +
                                            entries_.front() + ".." + entries_.back()
                                      : joined(own)) +
                ", the parameters and the names of \"let\"";
        for (const auto& [name, value] : parameters) {
            if (const std::string problem = nameProblem(name); !problem.empty())
                throw InvalidScene("/parameters/" + name, "the name \"" + name + "\" " + problem,
                                   "another name");
            add(name, "/parameters/" + name);
        }
    }
    void add(const std::string& name, const std::string& pointer) {
        if (std::find(known_.begin(), known_.end(), name) != known_.end() ||
            std::find(taken_.begin(), taken_.end(), name) != taken_.end())
            throw InvalidScene(pointer, "the name \"" + name + "\" has a meaning already", "another name");
        known_.push_back(name);
    }
    void check(const std::string& text, const std::string& pointer) const {
        atPlace(
            pointer, text,
            [&] {
                const Expression expression = parseExpression(text);
                for (const Expression::Node& node : expression.nodes) {
                    if (node.kind == Operator::call && node.name == "dot")
                        throw ExpressionError("has a velocity of its own", node.position, hint_);
                    if (node.kind != Operator::name || node.name == "pi" ||
                        std::find(known_.begin(), known_.end(), node.name) != known_.end())
                        continue;
                    throw ExpressionError(node.name == "t" ? "a Lagrangian on a group does not depend on t"
                                                           : "has an unknown name \"" + node.name + "\"",
                                          node.position, hint_);
                }
                return true;
            },
            "");
    }
    const std::vector<std::string>& velocities() const { return velocities_; }
    const std::vector<std::string>& entries() const { return entries_; }

private:
    static std::string joined(const OwnNames& own) {
        std::vector<std::string> names;
        for (const auto& [name, meaning] : own.meanings) names.push_back(name);
        return joinNames(names);
    }
    std::vector<std::string> velocities_, entries_;
    std::vector<std::string> known_, taken_;  ///< that a formula may use; that have a meaning behind it
    std::string hint_;
};

/// The text of the Lagrangian with the names of "let" written out.
std::string writtenOut(const Settings& settings, Names& names, const OwnNames& own) {
    std::vector<std::pair<std::string, std::string>> definitions;
    if (const Value* const let = settings.find("let"); let && !let->isNull()) {
        if (!let->isObject())
            throw InvalidScene("/let", "must be an object of expressions by name", "{\"vx\": \"xi1\"}, say");
        for (const auto& [name, text] : let->asObject()) {
            const std::string pointer = "/let/" + name;
            if (const std::string problem = nameProblem(name); !problem.empty())
                throw InvalidScene(pointer, "the name \"" + name + "\" " + problem, "another name");
            if (!text.isString() && !text.isNumber())
                throw InvalidScene(pointer, "must be an expression", "\"xi1 + xi2\", say");
            const std::string written = text.isString() ? text.asString() : formatNumber(text.asNumber());
            names.check(written, pointer);
            names.add(name, pointer);
            definitions.emplace_back(name, written);
        }
    }
    const Value* const given = settings.find("lagrangian");
    std::string whole;
    if (given->isObject()) {
        for (const auto& [name, text] : given->asObject()) {
            names.check(text.asString(), "/lagrangian/" + name);
            whole += (whole.empty() ? "(" : " + (") + text.asString() + ")";
        }
        if (whole.empty())
            throw InvalidScene("/lagrangian", "needs at least one term", "\"kinetic\": \"xi1^2/2\", say");
    } else {
        whole = given->asString();
        names.check(whole, "/lagrangian");
    }
    for (auto each = definitions.rbegin(); each != definitions.rend(); ++each)
        whole = withNameReplaced(whole, each->first, "(" + each->second + ")");
    for (const auto& [name, meaning] : own.meanings)
        whole = withNameReplaced(whole, name, "(" + meaning + ")");
    return whole;
}

UsedEntry usedEntry(const MatrixGroup& group, int entry) {
    UsedEntry used;
    used.entry = entry;
    const auto f = std::find_if(group.factors().rbegin(), group.factors().rend(),
                                [&](const MatrixGroup::Factor& each) { return each.entry <= entry; });
    const int row = (entry - f->entry) / f->n, column = (entry - f->entry) % f->n;
    const auto add = [&](const MatrixGroup::Square& E, int a, int b, std::vector<Share>& to) {
        for (int k = 0; k < f->n; ++k)
            if (E(k, column) != 0)
                to.push_back({f->coordinate + a, f->coordinate + b, f->entry + row * f->n + k, E(k, column)});
    };
    for (int a = 0; a < f->d; ++a) {
        const auto& Ea = f->basis[static_cast<std::size_t>(a)];
        add(Ea, a, 0, used.first);
        for (int b = 0; b < f->d; ++b) add(f->basis[static_cast<std::size_t>(b)] * Ea, a, b, used.second);
    }
    return used;
}

struct Built {
    TypedGroup model;
    bool isInvariant = true, isMixed = false, hasConstantMasses = false;
};

Built build(const MatrixGroup& group, const typed::Formula& formula, const std::vector<int>& entries) {
    const auto symbolic = typed::differentiate(formula);
    const int d = group.dimension(), count = formula.dimension();
    std::vector<int> roots{symbolic->value};
    roots.insert(roots.end(), symbolic->gradient.begin(), symbolic->gradient.begin() + count);
    const auto triangle = symbolic->hessian.begin();
    roots.insert(roots.end(), triangle, triangle + count * (count + 1) / 2);
    typed::Graph graph;
    const std::vector<int> here =
        graph.adopt(symbolic->graph, roots, [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula.firstParameter();
            if (k < 0) return {};
            return formula.parameters[static_cast<std::size_t>(k)].second;
        });
    Built made;
    made.model.d = d;
    for (const int entry : entries) made.model.used.push_back(usedEntry(group, entry));
    std::vector<int> outputs(here.begin(), here.begin() + 1 + count), masses;
    made.isInvariant = entries.empty();
    made.model.gradient = typed::Tape::of(graph, outputs, count);
    std::size_t k = outputs.size();
    for (int i = 0; i < count; ++i)
        for (int j = 0; j <= i; ++j, ++k) {
            if (graph.isZero(here[k])) continue;
            outputs.push_back(here[k]);
            made.model.places.emplace_back(i, j);
            if (i < d) masses.push_back(here[k]);
            made.isMixed = made.isMixed || (i >= d && j < d);
        }
    made.model.jet = typed::Tape::of(graph, outputs, count);
    made.model.isQuadratic = !graph.dependsOn(masses, [d](int symbol) { return symbol < d; });
    made.hasConstantMasses = !graph.dependsOn(masses, [](int) { return true; });
    return made;
}

}  // namespace

std::vector<std::string> velocityNames(const MatrixGroup& group) {
    std::vector<std::string> names;
    for (const MatrixGroup::Factor& f : group.factors())
        for (int a = 0; a < f.d; ++a)
            names.push_back((f.name.empty() ? "" : f.name + "_") + "xi" + std::to_string(a + 1));
    return names;
}
std::vector<std::string> entryNames(const MatrixGroup& group) {
    std::vector<std::string> names;
    for (const MatrixGroup::Factor& f : group.factors())
        for (int i = 0; i < f.n; ++i)
            for (int j = 0; j < f.n; ++j) names.push_back(entryName(f, i, j));
    return names;
}

GroupMechanics mechanicsOf(const MatrixGroup& given, const Settings& settings, const OwnNames& own) {
    GroupMechanics mechanics;
    const auto group = std::make_shared<const MatrixGroup>(given);
    mechanics.group = group;
    mechanics.invariants = std::make_shared<const GroupInvariants>(*group);
    mechanics.isotropy = own.isotropy;
    const Parameters parameters = typed::parametersOf(settings);
    Names names(*group, parameters, own);
    typed::Formula formula;
    formula.parameters = parameters;
    formula.text = writtenOut(settings, names, own);
    formula.isExpanded = true;
    formula.coordinates = names.velocities();
    std::vector<int> entries;
    try {
        const std::vector<std::string> inText = parseWrittenOut(formula.text).names();
        for (std::size_t e = 0; e < names.entries().size(); ++e)
            if (std::find(inText.begin(), inText.end(), names.entries()[e]) != inText.end()) {
                entries.push_back(static_cast<int>(e));
                formula.coordinates.push_back(names.entries()[e]);
            }
        Built built = build(*group, formula, entries);
        mechanics.isInvariant = built.isInvariant;
        mechanics.isMixed = built.isMixed;
        mechanics.hasConstantMasses = built.hasConstantMasses;
        built.model.isotropy = own.isotropy;
        mechanics.model = std::make_shared<const TypedGroup>(std::move(built.model));
    } catch (const ExpressionError& e) {
        throw invalidText("/lagrangian", formula.text, e);
    }
    mechanics.gradient = gradientAt;
    mechanics.jet = jetAt;
    mechanics.velocity = velocityAt;
    return mechanics;
}

GroupMechanics mechanicsOf(const Settings& settings) {
    return mechanicsOf(groupOf(*settings.find("group")), settings, {});
}

FieldInfo letField() {
    return optionalJsonField("let", "let", "Expressions by name, which the Lagrangian may use.");
}

}  // namespace extremal::groups
