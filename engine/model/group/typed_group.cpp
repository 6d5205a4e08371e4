// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/typed_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <unordered_set>
#include <utility>

#include "engine/core/own_buffers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/group/mass_solver.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"
#include "engine/model/typed/written_out.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;
using Matrix = MatrixGroup::Matrix;
using Parameters = std::vector<std::pair<std::string, double>>;

/// What entry e of g E_a, or of g E_b E_a, is: a sum of value g_entry; a and b within the factor.
struct Share {
    int a, b, entry;
    double value;
};
struct UsedEntry {
    int entry = 0, part = 0, first = 0, d = 0;  ///< its factor, and the coordinates of that
    int move = 0;                       ///< the first of the d numbers that say how it moves along g E_a
    std::size_t square = 0;             ///< the block of its factor in S
    std::vector<Share> shares, second;  ///< of g E_a, and of g E_b E_a
};

/// Where an entry of the Hessian by (xi, used entries) goes.
struct Destination {
    enum class Kind { mass, mixed, slope } kind;
    std::size_t at, mirrored;  ///< of a mass: in M; mixed: of the row in N; of a slope: blocks of S
    std::size_t stride = 0;    ///< of the row in N
    int e = 0, f = 0;          ///< used entries
};

/// Inputs of the tapes: xi, then the entries that occur.
struct TypedGroup {
    int d = 0;
    long long id = nextModelId();
    std::shared_ptr<const Couplings> couplings;
    std::vector<std::pair<int, int>> massCoupled;  ///< factors that M couples
    std::vector<UsedEntry> used;
    int moves = 0;
    std::vector<int> isotropy;       ///< GroupMechanics::isotropy
    bool isQuadratic = false;        ///< in xi
    bool hasConstantMasses = false;  ///< M depends on nothing
    /// L and its gradient; the same and M; and the second derivatives of all `places`.
    typed::Tape gradient, inertia, jet;
    std::vector<Destination> places;  ///< those of M first
    std::size_t masses = 0;           ///< so many of them
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
        const UsedEntry& entry = of.used[e];
        const double slope = r[1 + d + e];
        for (const Share& s : entry.shares) f[entry.first + s.a] += slope * s.value * g[s.entry];
    }
}

void gradientAt(const void* p, const double* g, const double* eta, double* value, double* m, double* f) {
    const TypedGroup& of = self(p);
    fillGradient(of, Evaluated(of, of.gradient, g, eta), g, value, m, f);
}

/// S += h moves_a moves_b^T, column after column.
void addOuter(double h, const double* a, int rows, const double* b, int columns, double* S) {
    for (int j = 0; j < columns; ++j)
        for (int i = 0; i < rows; ++i) *S++ += h * a[i] * b[j];
}

template <class Registers>
void fillMasses(const TypedGroup& of, const Registers& r, double* M) {
    std::fill_n(M, of.couplings->entries(), 0.0);
    const std::size_t first = 1 + static_cast<std::size_t>(of.d) + of.used.size();
    for (std::size_t k = 0; k < of.masses; ++k) M[of.places[k].at] = M[of.places[k].mirrored] = r[first + k];
}

/// L, m and M.
void massesAt(const TypedGroup& of, const double* g, const double* eta, double* value, double* m, double* M) {
    const Evaluated r(of, of.inertia, g, eta);
    fillGradient(of, r, g, value, m, nullptr);
    fillMasses(of, r, M);
}

/// Room of one thread, and M, which is kept where it is constant.
struct OwnRoom {
    explicit OwnRoom(const TypedGroup& of)
        : moves(of.moves),
          masses(of.couplings->entries()),
          solver(*of.couplings, of.massCoupled),
          x(of.d),
          m(x),
          change(x) {}
    /// m and M at the velocity x.
    void evaluate(const TypedGroup& of, const double* g) {
        double value = 0;
        if (isKnown) return gradientAt(&of, g, x.data(), &value, m.data(), nullptr);
        massesAt(of, g, x.data(), &value, m.data(), masses.data());
        for (const int k : of.isotropy) masses[of.couplings->place(k, k)] = 1;
        isKnown = of.hasConstantMasses;
    }
    Vector moves;
    std::vector<double> masses;
    MassSolver solver;
    Vector x, m, change;
    bool isKnown = false;
};
OwnRoom& ownRoom(const TypedGroup& of) { return ownBuffers<OwnRoom>(of.id, of); }

void jetAt(const void* p, const double* g, const double* eta, double* value, double* m, double* f, double* M,
           double* N, double* S) {
    const TypedGroup& of = self(p);
    if (!f) return massesAt(of, g, eta, value, m, M);
    const Evaluated r(of, of.jet, g, eta);
    fillGradient(of, r, g, value, m, f);
    fillMasses(of, r, M);
    const std::size_t entries = of.couplings->entries(),
                      first = 1 + static_cast<std::size_t>(of.d) + of.used.size();
    std::fill_n(N, entries, 0.0);
    std::fill_n(S, entries, 0.0);
    Vector& moves = ownRoom(of).moves;
    moves.setZero();
    for (std::size_t e = 0; e < of.used.size(); ++e) {
        const UsedEntry& entry = of.used[e];
        for (const Share& s : entry.shares) moves(entry.move + s.a) += s.value * g[s.entry];
        if (entry.second.empty()) continue;
        const double by = r[1 + static_cast<std::size_t>(of.d) + e];
        double* const slope = S + entry.square;
        for (const Share& s : entry.second) slope[s.b * entry.d + s.a] += by * s.value * g[s.entry];
    }
    for (std::size_t k = of.masses; k < of.places.size(); ++k) {
        const Destination& to = of.places[k];
        const double h = r[first + k];
        const UsedEntry& e = of.used[static_cast<std::size_t>(to.e)];
        const double* const own = moves.data() + e.move;
        if (to.kind == Destination::Kind::mixed) {
            for (int a = 0; a < e.d; ++a) N[to.at + static_cast<std::size_t>(a) * to.stride] += h * own[a];
            continue;
        }
        const UsedEntry& other = of.used[static_cast<std::size_t>(to.f)];
        addOuter(h, own, e.d, moves.data() + other.move, other.d, S + to.at);
        if (to.e != to.f) addOuter(h, moves.data() + other.move, other.d, own, e.d, S + to.mirrored);
    }
}

/// Newton's method on dL/deta = mu from rest; one step where L is quadratic in eta.
bool velocityAt(const void* p, const double* g, const double* mu, double* eta) {
    const TypedGroup& of = self(p);
    OwnRoom& own = ownRoom(of);
    own.x.setZero();
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 100; ++iteration) {
        own.evaluate(of, g);
        own.change = Eigen::Map<const Vector>(mu, of.d) - own.m;
        for (const int k : of.isotropy) own.change(k) = 0;
        const bool isDone = own.change.isZero(0);
        if (!own.change.allFinite()) return false;
        own.solver.solve(own.masses.data(), own.change.data());
        if (!own.change.allFinite()) return false;
        own.x += own.change;
        const double size = own.change.norm(), scale = own.x.norm();
        const bool isFound = of.isQuadratic || size <= 1e-15 * scale ||
                             (iteration > 5 && size >= last && size <= 1e-10 * scale) || isDone;
        if (isFound) {
            std::copy_n(own.x.data(), of.d, eta);
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
        for (const auto& [name, meaning] : own.meanings) known_.insert(name);
        std::unordered_set<std::string>& inFormulas = own.meanings.empty() ? known_ : taken_;
        inFormulas.insert(velocities_.begin(), velocities_.end());
        inFormulas.insert(entries_.begin(), entries_.end());
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
        if (known_.contains(name) || taken_.contains(name))
            throw InvalidScene(pointer, "the name \"" + name + "\" has a meaning already", "another name");
        known_.insert(name);
    }
    void check(const std::string& text, const std::string& pointer) const {
        atPlace(
            pointer, text,
            [&] {
                const Expression expression = parseWrittenOut(text);
                for (const Expression::Node& node : expression.nodes) {
                    if (node.kind == Operator::call && node.name == "dot")
                        throw ExpressionError("has a velocity of its own", node.position, hint_);
                    if (node.kind != Operator::name || node.name == "pi" || known_.contains(node.name))
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
    std::unordered_set<std::string> known_,
        taken_;  ///< that a formula may use; that have a meaning behind it
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
    const auto& factors = group.factors();
    const auto after =
        std::upper_bound(factors.begin(), factors.end(), entry,
                         [](int e, const MatrixGroup::Factor& each) { return e < each.entry; });
    const auto f = std::prev(after);
    used.part = static_cast<int>(f - factors.begin());
    used.first = f->coordinate;
    used.d = f->d;
    const int row = (entry - f->entry) / f->n, column = (entry - f->entry) % f->n;
    const auto add = [&](const MatrixGroup::Square& E, int a, int b, std::vector<Share>& to) {
        for (int k = 0; k < f->n; ++k)
            if (E(k, column) != 0) to.push_back({a, b, f->entry + row * f->n + k, E(k, column)});
    };
    for (int a = 0; a < f->d; ++a) {
        const auto& Ea = f->basis[static_cast<std::size_t>(a)];
        add(Ea, a, 0, used.shares);
        for (int b = 0; b < f->d; ++b) add(f->basis[static_cast<std::size_t>(b)] * Ea, a, b, used.second);
    }
    return used;
}

struct Built {
    TypedGroup model;
    bool isInvariant = true, isMixed = false, hasConstantMasses = false;
};

/// The factors that second derivatives couple, and where these go: (i, j), of xi and then of used entries.
void placeDerivatives(const MatrixGroup& group, const std::vector<std::pair<int, int>>& found,
                      TypedGroup& model) {
    std::vector<int> sizes, partOf;
    for (const MatrixGroup::Factor& f : group.factors()) {
        partOf.insert(partOf.end(), static_cast<std::size_t>(f.d), static_cast<int>(sizes.size()));
        sizes.push_back(f.d);
    }
    for (const UsedEntry& e : model.used) partOf.push_back(e.part);
    const auto part = [&](int i) { return partOf[static_cast<std::size_t>(i)]; };
    std::vector<std::pair<int, int>> coupled;
    for (const auto& [i, j] : found) {
        if (part(i) == part(j)) continue;
        coupled.emplace_back(part(i), part(j));
        if (i < model.d && j < model.d) model.massCoupled.emplace_back(std::minmax(part(i), part(j)));
    }
    std::sort(model.massCoupled.begin(), model.massCoupled.end());
    model.massCoupled.erase(std::unique(model.massCoupled.begin(), model.massCoupled.end()),
                            model.massCoupled.end());
    const auto couplings = std::make_shared<const Couplings>(sizes, std::move(coupled));
    model.couplings = couplings;
    for (UsedEntry& e : model.used) e.square = couplings->find(e.part, e.part).place;
    for (const auto& [i, j] : found) {  // j <= i
        if (i < model.d) {
            model.places.push_back({Destination::Kind::mass, couplings->place(i, j), couplings->place(j, i)});
        } else if (const int e = i - model.d; j < model.d) {
            const int first = model.used[static_cast<std::size_t>(e)].first;
            model.places.push_back({Destination::Kind::mixed, couplings->place(j, first), 0,
                                    static_cast<std::size_t>(couplings->size(part(j))), e});
        } else {
            const Couplings::Pair& pair = couplings->find(part(i), part(j));
            model.places.push_back(
                {Destination::Kind::slope, pair.place, pair.transposed, 0, e, j - model.d});
        }
    }
}

Built build(const MatrixGroup& group, const typed::Formula& formula, const std::vector<int>& entries) {
    const auto symbolic = typed::differentiate(formula);
    const int d = group.dimension(), count = formula.dimension();
    std::vector<int> roots{symbolic->value};
    roots.insert(roots.end(), symbolic->gradient.begin(), symbolic->gradient.begin() + count);
    std::vector<std::pair<int, int>> places;
    const int* second = symbolic->hessian.data();
    for (int i = 0; i < count; ++i)
        for (int j = 0; j <= i; ++j, ++second) {
            if (symbolic->graph.isZero(*second)) continue;
            places.emplace_back(i, j);
            roots.push_back(*second);
        }
    typed::Graph graph;
    const std::vector<int> here =
        graph.adopt(symbolic->graph, roots, [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula.firstParameter();
            if (k < 0) return {};
            return formula.parameters[static_cast<std::size_t>(k)].second;
        });
    Built made;
    made.model.d = d;
    for (const int entry : entries) {
        made.model.used.push_back(usedEntry(group, entry));
        made.model.used.back().move =
            std::exchange(made.model.moves, made.model.moves + made.model.used.back().d);
    }
    std::vector<int> outputs(here.begin(), here.begin() + 1 + count), masses;
    made.isInvariant = entries.empty();
    const auto first = static_cast<std::ptrdiff_t>(outputs.size());
    made.model.gradient = typed::Tape::of(graph, outputs, count);
    std::vector<std::pair<int, int>> found;
    std::size_t k = outputs.size();
    for (const auto& [i, j] : places) {
        const int node = here[k++];
        if (graph.isZero(node)) continue;
        outputs.push_back(node);
        found.emplace_back(i, j);
        if (i < d) masses.push_back(node);
        made.isMixed = made.isMixed || (i >= d && j < d);
    }
    made.model.jet = typed::Tape::of(graph, outputs, count);
    made.model.masses = masses.size();
    outputs.resize(static_cast<std::size_t>(first) + masses.size());
    made.model.inertia = typed::Tape::of(graph, outputs, count);
    made.model.isQuadratic = !graph.dependsOn(masses, [d](int symbol) { return symbol < d; });
    made.hasConstantMasses = made.model.hasConstantMasses =
        !graph.dependsOn(masses, [](int) { return true; });
    placeDerivatives(group, found, made.model);
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
        const std::vector<std::string> all = parseWrittenOut(formula.text).names();
        const std::unordered_set<std::string> inText(all.begin(), all.end());
        for (std::size_t e = 0; e < names.entries().size(); ++e)
            if (inText.contains(names.entries()[e])) {
                entries.push_back(static_cast<int>(e));
                formula.coordinates.push_back(names.entries()[e]);
            }
        Built built = build(*group, formula, entries);
        mechanics.isInvariant = built.isInvariant;
        mechanics.isMixed = built.isMixed;
        mechanics.hasConstantMasses = built.hasConstantMasses;
        built.model.isotropy = own.isotropy;
        mechanics.couplings = built.model.couplings;
        mechanics.model = std::make_shared<const TypedGroup>(std::move(built.model));
    } catch (const ExpressionError& e) {
        throw invalidText("/lagrangian", formula.text, e);
    }
    mechanics.gradient = gradientAt;
    mechanics.jet = jetAt;
    mechanics.velocity = velocityAt;
    return mechanics;
}

GroupMechanics mechanicsOf(const Settings& given) {
    const Settings settings = typed::writtenOut(given);
    return mechanicsOf(groupOf(*settings.find("group")), settings, {});
}

FieldInfo letField() {
    return optionalJsonField("let", "let", "Expressions by name, which the Lagrangian may use.");
}

}  // namespace extremal::groups
