// SPDX-License-Identifier: GPL-3.0-or-later
/// What the parts that a user types have in common: formulas with time as one more name, differentiated, in
/// one graph and evaluated by one tape. Internal to engine/model/typed.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal::typed {

inline std::size_t placeOf(int i) { return static_cast<std::size_t>(i); }

/// The names with time as one more coordinate, so that derivatives by it are found as those by the others.
/// Symbols: q_i: i,  t: d,  v_i: d + 1 + i,  the rate of t: 2d + 1.
Formula withTime(const Formula& formula, const std::string& text);

/// A formula with time, in those coordinates of the model that occur in it where there are many, else in all:
/// what is differentiated by each of its names should not have the names of all others.
struct OwnFormula {
    Formula formula;
    std::vector<int> coordinates;  ///< in the model, of each of its own but time

    OwnFormula(const Formula& model, const std::string& text);
    int dimension() const { return static_cast<int>(coordinates.size()); }
    /// The number that a symbol has in withTime() of the model, of d coordinates.
    int renamed(int symbol, int d) const {
        const int own = dimension() + 1, i = symbol % own;
        return (symbol / own) * (d + 1) + (i == dimension() ? d : coordinates[static_cast<std::size_t>(i)]);
    }
};
/// Whether a name stands in a text as a whole word.
bool occurs(const std::string& name, const std::string& text);

/// Roots of several formulas in one graph, with numbers in place of parameters.
class Roots {
public:
    explicit Roots(const Formula& withTime) : formula_(withTime) {}

    /// The nodes of the graph of a formula here.
    std::vector<int> adopt(const OwnFormula& own, const Graph& from, const std::vector<int>& nodes) {
        return graph_.adopt(
            from, nodes,
            [&](int symbol) -> std::optional<double> {
                const int k = symbol - own.formula.firstParameter();
                if (k < 0) return {};
                return own.formula.parameters[placeOf(k)].second;
            },
            [&](int symbol) { return own.renamed(symbol, formula_.dimension() - 1); });
    }
    /// Of one that has all names.
    std::vector<int> adopt(const Graph& from, const std::vector<int>& nodes) {
        return graph_.adopt(from, nodes, [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula_.firstParameter();
            if (k < 0) return {};
            return formula_.parameters[placeOf(k)].second;
        });
    }
    Graph& graph() { return graph_; }
    Tape tape(const std::vector<int>& roots) const {
        return Tape::of(graph_, roots, 2 * formula_.dimension());
    }

private:
    const Formula& formula_;
    Graph graph_;
};

/// One evaluation of a tape at (q, t, v); v may be null.
class Run : public TapeRegisters {
public:
    Run(const Tape& tape, int d, double t, const double* q, const double* v)
        : TapeRegisters(tape, [&](double* r) {
              std::copy_n(q, d, r);
              r[d] = t;
              if (v)
                  std::copy_n(v, d, r + d + 1);
              else
                  std::fill_n(r + d + 1, d, 0.0);
              r[2 * d + 1] = 1;
          }) {}
};

/// Evaluations of a tape at (q, t, v) of many nodes, eight at a time and in line with their caller; v may be
/// null. `write(k, value, i)` takes output k of the nodes from i on.
template <class Write>
void runNodes(const Tape& tape, int d, const double* t, int nodes, const double* q, const double* v,
              const Write& write) {
    for (int i = 0; i < nodes; i += static_cast<int>(Lanes::size))
        runEight(
            tape,
            [&](Lanes* r) {
                for (int k = 0; k < d; ++k) {
                    r[k] = Lanes::load(q + k * nodes + i);
                    r[d + 1 + k] = v ? Lanes::load(v + k * nodes + i) : Lanes(0);
                }
                r[d] = Lanes::load(t + i);
                r[2 * d + 1] = Lanes(1);
            },
            [&](std::size_t k, const Lanes& value) { write(k, value, i); });
}

/// differentiate() with what is wrong as a problem of the scene.
std::shared_ptr<const SymbolicLagrangian> derivativesOf(const Formula& formula, const std::string& pointer);

/// The formulas by name under a key of the model; empty where there are none.
const Value::Object& formulasUnder(const Settings& settings, const char* key);

/// The gap of a wall, which is typed alone or as {"gap", "restitution"}; null: it has none.
const Value* gapOf(const Value& wall);

/// Time has no rate among the names.
void requireNoRateOfTime(const Formula& own, const std::string& pointer);

}  // namespace extremal::typed
