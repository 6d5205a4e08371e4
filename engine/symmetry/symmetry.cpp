// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/core/memo_cache.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/symmetry/candidates.hpp"
#include "engine/symmetry/jumps.hpp"
#include "engine/symmetry/null_space.hpp"
#include "engine/symmetry/sample.hpp"

namespace extremal {
namespace {

/// The product of the coordinates of a term.
double productOf(const GaugeTerm& term, const double* q) {
    double product = 1;
    for (const int i : {term.i, term.j, term.k})
        if (i >= 0) product *= q[i];
    return product;
}

/// The nearest fraction with a small denominator, where it is one to the accuracy of a null vector.
double snapped(double x) {
    for (int denominator = 1; denominator <= 64; ++denominator) {
        const double n = std::round(x * denominator);
        if (n != 0 && std::abs(x * denominator - n) < 1e-9 * std::abs(n)) return n / denominator;
    }
    return x;
}

template <class Change>
void changeAll(Symmetry& s, Change&& change) {
    for (auto* values : {&s.b, &s.A, &s.c})
        for (double& x : *values) x = change(x);
    s.tau0 = change(s.tau0);
    s.tau1 = change(s.tau1);
    for (GaugeTerm& term : s.F) term.coefficient = change(term.coefficient);
}

/// Divides by the entry that a reader expects to be 1; of a rotation, positive in the sense from the first
/// coordinate to the second.
void normalise(Symmetry& s) {
    double leading = s.tau0;
    const auto largest = [&](const std::vector<double>& values) {
        for (const double x : values)
            if (leading == 0 || (std::abs(x) > 1.000001 * std::abs(leading))) leading = x;
    };
    if (leading == 0) {
        largest(s.A);
        // Below the diagonal first.
        for (int i = 0; i < s.dimension && leading != 0; ++i)
            for (int j = 0; j < i; ++j)
                if (std::abs(std::abs(s.a(i, j)) - std::abs(leading)) < 1e-9 * std::abs(leading)) {
                    leading = s.a(i, j);
                    i = s.dimension;
                    break;
                }
    }
    if (leading == 0) largest(s.c);
    if (leading == 0) {
        for (const double x : s.b)
            if (leading == 0) leading = x;
    }
    if (leading == 0) leading = s.tau1;
    if (leading == 0) return;
    changeAll(s, [&](double x) { return x / leading; });
}

/// Near the limits of double precision all entries may underflow. Those that overflow are not looked for:
/// the violation is then not a number.
bool movesSomething(const Symmetry& s) {
    return s.movesTime() || hasNonzero(s.A) || hasNonzero(s.b) || hasNonzero(s.c);
}

/// Fresh states, those near the landmarks of the formula among them. Empty where L has no value at most
/// places.
std::vector<SampledState> freshStates(const Mechanical& mechanics) {
    constexpr int random = 40;
    StateSampler sampler(mechanics, 2718);
    std::vector<SampledState> states;
    SampledState state;
    for (int i = 0; i < random; ++i) {
        if (!sampler.next(state)) return {};
        states.push_back(state);
    }
    for (int i = 0; i < sampler.statesAtLandmarks(); ++i)
        if (sampler.nextAtLandmarks(state)) states.push_back(state);
    return states;
}

/// Whether a symmetry is violated by less than the limit at all states.
bool holdsAt(const std::vector<SampledState>& states, const Symmetry& s, double limit) {
    return !states.empty() && std::all_of(states.begin(), states.end(), [&](const SampledState& state) {
        return s.violation(state) < limit;  // false if it is not a number
    });
}

/// Whether t alone moves, and F does not make up for it: then L_t = 0, which the formula itself tells.
bool isPureTime(const Symmetry& s) {
    return s.tau0 != 0 && s.tau1 == 0 && !hasNonzero(s.A) && !hasNonzero(s.b) && !hasNonzero(s.c) &&
           s.F.empty();
}

/// dJ/d(q, p) at fixed t, entries times the sizes of q and p.
std::vector<double> gradientOf(const Symmetry& s, const SampledState& state, double sizeQ, double sizeP) {
    const auto d = static_cast<std::size_t>(s.dimension);
    const double* p = state.gradient.data() + d;
    std::vector<double> g(2 * d), unit(d, 0);
    for (std::size_t j = 0; j < d; ++j) {
        for (std::size_t i = 0; i < d; ++i) g[j] += p[i] * s.A[i * d + j];
        unit[j] = 1;
        for (const GaugeTerm& term : s.F) g[j] -= term.rateAlong(state.t, state.q.data(), unit.data());
        unit[j] = 0;
        g[j] *= sizeQ;
    }
    s.displacement(state.t, state.q.data(), g.data() + d);
    for (std::size_t i = 0; i < d; ++i) g[d + i] *= sizeP;
    return g;
}

/// Marks those whose gradient is a combination of those before it, by Gram-Schmidt at a random state.
void markDependent(const Mechanical& mechanics, std::vector<Symmetry>& all) {
    StateSampler sampler(mechanics, 1687);
    SampledState state;
    if (!sampler.next(state) || !sampler.next(state) || !sampler.next(state)) return;
    const auto size = [](auto from, auto to) {
        double most = 0;
        for (; from != to; ++from) most = std::max(most, std::abs(*from));
        return most > 0 ? most : 1.0;
    };
    const auto d = static_cast<std::ptrdiff_t>(mechanics.dimension);
    const double sizeQ = size(state.q.begin(), state.q.end()),
                 sizeP = size(state.gradient.begin() + d, state.gradient.end());
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    };
    std::vector<std::vector<double>> basis;
    for (Symmetry& s : all) {
        if (s.movesTime() || !s.isExact()) continue;
        std::vector<double> g = gradientOf(s, state, sizeQ, sizeP);
        const double before = std::sqrt(dot(g, g));
        for (int pass = 0; pass < 2; ++pass)
            for (const auto& e : basis) {
                const double along = dot(e, g);
                for (std::size_t i = 0; i < g.size(); ++i) g[i] -= along * e[i];
            }
        const double left = std::sqrt(dot(g, g));
        s.isDependent = !(left > 1e-9 * before);
        if (s.isDependent) continue;
        for (double& x : g) x /= left;
        basis.push_back(std::move(g));
    }
}

/// Whether both move states alike, to round-off. Near singular functions the null space may have several
/// directions that differ by less: they are one symmetry.
bool movesAlike(const Symmetry& a, const Symmetry& b) {
    constexpr double roundOff = 1e-9;  // of generators whose leading entry is 1
    const auto isNear = [](double x, double y) { return std::abs(x - y) <= roundOff; };
    const auto areNear = [&](const std::vector<double>& x, const std::vector<double>& y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(), isNear);
    };
    return areNear(a.A, b.A) && areNear(a.b, b.b) && areNear(a.c, b.c) && isNear(a.tau0, b.tau0) &&
           isNear(a.tau1, b.tau1);
}

std::vector<Symmetry> search(const System& system, const std::vector<Jump>& relations) {
    constexpr double exact = 1e-10, almost = 1e-4;
    const Mechanical& mechanics = system.mechanics();
    const bool isSmall = static_cast<std::size_t>(system.dimension()) <= mostSampledCoordinates;
    const std::vector<SampledState> states = freshStates(mechanics);
    std::vector<Jump> jumps = jumpsOf(mechanics);
    jumps.insert(jumps.end(), relations.begin(), relations.end());
    std::vector<Symmetry> found;
    for (Symmetry& s :
         isSmall ? symmetriesOnSamples(system, StateSampler(mechanics), jumps) : candidates(system)) {
        normalise(s);
        if (!movesSomething(s) || (isPureTime(s) && mechanics.isTimeDependent)) continue;
        const auto isMoved = [&s](const Jump& jump) { return jump.isMovedBy(s); };
        if (std::any_of(jumps.begin(), jumps.end(), isMoved)) continue;
        Symmetry rounded = s;
        changeAll(rounded, snapped);
        if (std::any_of(found.begin(), found.end(),
                        [&](const Symmetry& f) { return movesAlike(f, rounded); }))
            continue;
        const double limit = s.isExact() ? exact : almost;
        if (holdsAt(states, rounded, limit))
            found.push_back(std::move(rounded));
        else if (holdsAt(states, s, limit))
            found.push_back(std::move(s));
    }
    nameAll(system, found);
    std::stable_sort(found.begin(), found.end(), [](const Symmetry& a, const Symmetry& b) {
        return std::pair(!a.isExact(), a.kind) < std::pair(!b.isExact(), b.kind);
    });
    markDependent(mechanics, found);
    return found;
}

}  // namespace

bool hasNonzero(const std::vector<double>& entries) {
    return std::any_of(entries.begin(), entries.end(), [](double x) { return x != 0; });
}

double GaugeTerm::value(double t, const double* q) const {
    return coefficient * std::pow(t, power) * productOf(*this, q);
}

double GaugeTerm::rateAlong(double t, const double* q, const double* direction) const {
    double product = 1, slope = 0;
    for (const int index : {i, j, k}) {
        if (index < 0) continue;
        slope = slope * q[index] + product * direction[index];
        product *= q[index];
    }
    return coefficient * std::pow(t, power) * slope;
}

double GaugeTerm::rateInTime(double t, const double* q) const {
    return power > 0 ? coefficient * power * std::pow(t, power - 1) * productOf(*this, q) : 0;
}

void Symmetry::displacement(double t, const double* q, double* xi) const {
    const auto d = static_cast<std::size_t>(dimension);
    for (std::size_t i = 0; i < d; ++i) {
        xi[i] = b[i] + c[i] * t;
        for (std::size_t j = 0; j < d; ++j) xi[i] += A[i * d + j] * q[j];
    }
}

double Symmetry::gauge(double t, const double* q) const {
    double sum = 0;
    for (const GaugeTerm& term : F) sum += term.value(t, q);
    return sum;
}

double Symmetry::violation(const SampledState& state) const {
    const auto d = static_cast<std::size_t>(dimension);
    const double t = state.t, *const q = state.q.data(), *const v = state.v.data();
    std::vector<double> xi(d);
    double sum = 0, size = 0;
    displacement(t, q, xi.data());
    const auto add = [&](double term) {
        sum += term;
        size += std::abs(term);
    };
    for (std::size_t i = 0; i < d; ++i) {
        const double p = state.gradient[d + i];
        add(state.gradient[i] * xi[i]);
        add(p * c[i]);
        for (std::size_t j = 0; j < d; ++j) add(p * A[i * d + j] * v[j]);
        add(-p * tau1 * v[i]);
    }
    if (movesTime()) {
        add(state.Lt * (tau0 + tau1 * t));
        add(state.L * tau1);
    }
    for (const GaugeTerm& term : F) {
        if (term.power > 0) add(-term.rateInTime(t, q));
        add(-term.rateAlong(t, q, v));
    }
    return size == 0 ? 0 : std::abs(sum) / size;
}

double Symmetry::momentum(const Mechanical& mechanics, double t, const double* q, const double* p) const {
    const auto d = static_cast<std::size_t>(dimension);
    double J = -gauge(t, q);
    for (std::size_t i = 0; i < d; ++i) {
        double xi = b[i] + c[i] * t;
        for (std::size_t j = 0; j < d; ++j) xi += A[i * d + j] * q[j];
        J += p[i] * xi;
    }
    if (movesTime()) J -= (tau0 + tau1 * t) * mechanics.energy(mechanics.model.get(), t, q, p);
    return J;
}

std::shared_ptr<const std::vector<Symmetry>> symmetriesOf(const System& system) {
    using All = std::shared_ptr<const std::vector<Symmetry>>;
    if (!system.isMovedOnlyBy<Mechanical>()) return std::make_shared<const std::vector<Symmetry>>();
    const auto make = [&]() -> All {
        return std::make_shared<const std::vector<Symmetry>>(search(system, {}));
    };
    const std::shared_ptr<const void>& model = system.mechanics().model;
    if (!model) return make();
    static MemoCache<std::shared_ptr<const void>, All> known(16);
    return known.get(model, make);
}

std::shared_ptr<const std::vector<Symmetry>> symmetriesBesideForces(const System& system, bool areWallsKept) {
    using All = std::shared_ptr<const std::vector<Symmetry>>;
    using Key =
        std::tuple<std::shared_ptr<const void>, std::shared_ptr<const void>, std::shared_ptr<const void>>;
    const auto* const mechanical = system.parts.find<Mechanical>();
    if (!mechanical || system.parts.find<Rolling>()) return std::make_shared<const std::vector<Symmetry>>();
    const auto make = [&]() -> All {
        return std::make_shared<const std::vector<Symmetry>>(
            search(system, relationsOf(system, areWallsKept)));
    };
    Key key{mechanical->model, nullptr, nullptr};
    if (const auto* const part = system.parts.find<Constraint>()) std::get<1>(key) = part->model;
    if (const auto* const part = system.parts.find<Wall>(); part && areWallsKept)
        std::get<2>(key) = part->model;
    if (!std::get<0>(key)) return make();
    static MemoCache<Key, All> known(16);
    return known.get(key, make);
}

std::string symmetryText(const System& system) {
    std::string text;
    for (const Symmetry& s : *symmetriesOf(system)) {
        if (!text.empty()) text += ", ";
        if (!s.isExact()) text += "almost (" + formatNumber(s.defect, 1) + ") ";
        text += s.title;
        if (s.isDependent) text += " (dependent)";
    }
    return text.empty() ? "none found" : text;
}

}  // namespace extremal
