// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/multiprecision/float128.hpp>

#include <Eigen/Core>

#include <type_traits>

#include "engine/action/combined_table.hpp"
#include "engine/action/quadruple_table.hpp"
#include "engine/action/table_build.hpp"
#include "engine/core/problem.hpp"

namespace extremal {
namespace {

/// The twin of a space in quadruple precision, from its evaluateQuadruple. Throws InvalidScene where a
/// space of one's own does not have it.
Space<Quad> quadrupleTwin(const Space<double>& space) {
    if (!space.evaluateQuadruple)
        throw InvalidScene("/space", "has no functions in quadruple precision", "a space of the catalogue");
    Space<Quad> twin;
    twin.size = space.size;
    twin.degree = space.degree;
    twin.hasKinks = space.hasKinks;
    twin.isSymmetric = space.isSymmetric;
    twin.continues = space.continues;
    twin.equalCells = space.equalCells;
    twin.cells.assign(space.cells.begin(), space.cells.end());
    twin.isAdapted = space.isAdapted;
    twin.evaluate = [evaluate = space.evaluateQuadruple](const Quad& tau, std::span<Quad> value,
                                                         std::span<Quad> derivative) {
        std::vector<__float128> v(value.size()), d(value.size());
        evaluate(tau.backend().value(), v, d);
        for (std::size_t a = 0; a < value.size(); ++a) {
            value[a] = v[a];
            derivative[a] = d[a];
        }
    };
    return twin;
}

Rule<Quad> inQuadruple(const Rule<double>& rule) {
    Rule<Quad> wide;
    wide.c.assign(rule.c.begin(), rule.c.end());
    wide.b.assign(rule.b.begin(), rule.b.end());
    wide.degree = rule.degree;
    wide.isSymmetric = rule.isSymmetric;
    wide.panels = rule.panels;
    wide.perPanel = rule.perPanel;
    wide.ends.assign(rule.ends.begin(), rule.ends.end());
    return wide;
}

Table<double> rounded(const Table<Quad>& wide, const Space<double>& space, const Rule<double>& rule) {
    Table<double> t;
    t.node = wide.node.cast<double>();
    t.weight = wide.weight.cast<double>();
    t.value = wide.value.cast<double>();
    t.derivative = wide.derivative.cast<double>();
    t.testValue = wide.testValue.cast<double>();
    t.testDerivative = wide.testDerivative.cast<double>();
    t.extrapolation = wide.extrapolation.cast<double>();
    t.change = wide.change.cast<double>();
    t.lift = wide.lift.cast<double>();
    t.consistency = wide.consistency;
    t.space = space;
    t.rule = rule;
    return t;
}

}  // namespace

template <class T>
bool tellsFunctionsApart(const Table<T>& t) {
    if (t.nodes() < t.unknowns()) return false;
    const typename Table<T>::Matrix seen = t.weight.cwiseAbs().cwiseSqrt().asDiagonal() * t.derivative;
    const Eigen::VectorXd pivots = dense::rankPivots(seen.template cast<double>());
    return pivots.minCoeff() > 1e-8 * pivots(0);
}

template bool tellsFunctionsApart(const Table<double>&);
template bool tellsFunctionsApart(const Table<Quad>&);

namespace {

template <class T>
Table<T> made(const Space<T>& space, const Rule<T>& rule, bool mustTellApart) {
    if constexpr (std::is_same_v<T, double>) {
        if (space.evaluateQuadruple) {
            const Rule<double> once = space.hasKinks ? rule : merged(rule);
            return rounded(detail::buildTable(quadrupleTwin(space), inQuadruple(once), mustTellApart), space,
                           once);
        }
    }
    return detail::buildTable(space, rule, mustTellApart);
}

}  // namespace

template <class T>
Table<T> makeTable(const Space<T>& space, const Rule<T>& rule) {
    return made(space, rule, true);
}

Table<double> makePartTable(const Space<double>& space, const Rule<double>& rule) {
    return made(space, rule, false);
}

Table<Quad> makeQuadrupleTable(const Space<double>& space, const Rule<Quad>& rule) {
    return makeTable(quadrupleTwin(space), rule);
}

template std::vector<double> consistencyDefects(const Table<double>&, int);
template Eigen::VectorXd kineticValues(const Table<double>&);
template Table<double> makeTable(const Space<double>&, const Rule<double>&);
template Table<Quad> makeTable(const Space<Quad>&, const Rule<Quad>&);

template <class T>
std::vector<T> weightsUpTo(const Table<T>& table, const T& tau) {
    std::vector<T> weights(static_cast<std::size_t>(table.nodes()));
    if (table.upTo)
        table.upTo(tau, weights);
    else
        partialWeights<T>(table.rule, tau, weights);
    return weights;
}

template std::vector<double> weightsUpTo(const Table<double>&, const double&);
template std::vector<Quad> weightsUpTo(const Table<Quad>&, const Quad&);

}  // namespace extremal
