// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/order_table.hpp"

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "engine/action/table.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/model/bind.hpp"
#include "engine/space/polynomial.hpp"
#include "engine/space/spline.hpp"
#include "tests/tools/quadruple_kepler.hpp"
#include "tests/tools/slope.hpp"

namespace extremal::tools {
namespace {

struct PendulumModel {
    static constexpr int dimension = 1;
    template <class T>
    std::array<T, 1> masses() const {
        return {T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        return cos(q[0]) * (T(-981) / T(100));
    }
};

Space<Quad> wideSpace(const Settings& space) {
    const int degree = space.integer("degree");
    if (space.type == "spline") return splineSpace<Quad>(degree, space.integer("cells"));
    return polynomialSpace<Quad>(degree, polynomialBasis(space.text("basis")));
}

/// Times at which nodes are compared: several, because an error may pass zero at one of them.
constexpr int looks = 12;

/// A problem with its solution at any time (Kepler) or at multiples of 3 / looks.
template <int D>
struct Setting {
    Mechanics<Quad> mechanics;
    std::vector<Quad> start;
    std::function<std::vector<Quad>(const Quad&)> exact;
};

Setting<2> keplerSetting() {
    return {bindMechanics<Quad>(KeplerModel{}), {Quad(2) / 5, 0, 0, 2}, exactKepler};
}

/// The pendulum's solution at the multiples of 3 / looks: Gauss collocation of degree 14 with 480 steps (good
/// to 1e-32).
Setting<1> pendulumSetting() {
    constexpr int steps = 40 * looks;
    Setting<1> s{bindMechanics<Quad>(PendulumModel{}), {Quad(1), Quad(7) / 10}, {}};
    const Table<Quad> table = makeTable(polynomialSpace<Quad>(14, PolynomialBasis::lobatto), gauss<Quad>(14));
    GalerkinStep<Quad, 1> integrator(s.mechanics, table, Quad(3) / steps, SolverPolicy{});
    std::vector<Quad> x = s.start;
    std::vector<std::vector<Quad>> solution{x};
    for (int k = 0; k < steps; ++k) {
        (void)integrator.advance(Quad(3) * k / steps, &x[0], &x[1], {});
        if ((k + 1) % 40 == 0) solution.push_back(x);
    }
    s.exact = [solution](const Quad& t) {
        return solution[static_cast<std::size_t>(std::lround(static_cast<double>(t) * looks / 3))];
    };
    return s;
}

template <int D>
Quad distance(const std::vector<Quad>& a, const std::vector<Quad>& b, std::size_t from) {
    Quad sum = 0;
    for (std::size_t i = from; i < from + D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

struct Errors {
    Quad q = 0, p = 0, curveQ = 0, curveP = 0;
    bool isComplete = false;
};

template <int D>
Errors errorsOf(const Setting<D>& setting, const Table<Quad>& table, int steps, bool withCurve) {
    const Quad T(3), h = T / steps;
    GalerkinStep<Quad, D> step(setting.mechanics, table, h, SolverPolicy{});
    std::vector<Quad> x = setting.start, inside = x;
    Errors e;
    for (int k = 0; k < steps; ++k) {
        if (step.advance(h * k, x.data(), x.data() + D, {}).outcome != Outcome::converged) return e;
        if ((k + 1) % (steps / looks) != 0) continue;
        const std::vector<Quad> exact = setting.exact(h * (k + 1));
        e.q = std::max(e.q, distance<D>(x, exact, 0));
        e.p = std::max(e.p, distance<D>(x, exact, D));
        if (!withCurve) continue;
        for (const double tau : {0.13, 0.29, 0.5, 0.64, 0.83}) {
            step.denseOutput(Quad(tau), inside.data(), inside.data() + D);
            const std::vector<Quad> there = setting.exact(h * (k + Quad(tau)));
            e.curveQ = std::max(e.curveQ, distance<D>(inside, there, 0));
            e.curveP = std::max(e.curveP, distance<D>(inside, there, D));
        }
    }
    e.isComplete = true;
    return e;
}

template <int D>
Orders fit(const Setting<D>& setting, const Table<Quad>& table, long long budget, bool withCurve) {
    std::vector<double> h;
    std::array<std::vector<double>, 4> errors;
    for (double n = 3; n * looks * table.nodes() < static_cast<double>(budget); n *= 1.4) {
        const int steps = looks * static_cast<int>(std::lround(n));
        const Errors e = errorsOf(setting, table, steps, withCurve);
        if (!e.isComplete || std::max(e.q, e.p) > 0.1) continue;
        if (std::min(e.q, e.p) < Quad(1e-28)) break;
        h.push_back(std::log(3.0 / steps));
        errors[0].push_back(static_cast<double>(log(e.q)));
        errors[1].push_back(static_cast<double>(log(e.p)));
        errors[2].push_back(withCurve ? static_cast<double>(log(e.curveQ)) : 0);
        errors[3].push_back(withCurve ? static_cast<double>(log(e.curveP)) : 0);
    }
    const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
    if (points < 3) return {0, 0, 0, 0, static_cast<int>(points)};
    h.erase(h.begin(), h.end() - points);
    for (auto& e : errors) e.erase(e.begin(), e.end() - points);
    return {slope(h, errors[0]), slope(h, errors[1]), slope(h, errors[2]), slope(h, errors[3]),
            static_cast<int>(points)};
}

}  // namespace

Orders measureOrders(const Settings& space, const Settings& quadrature, Motion motion, long long budget) {
    const Table<Quad> table = makeTable(wideSpace(space), makeRule<Quad>(quadrature));
    if (motion == Motion::kepler) return fit(keplerSetting(), table, budget, true);
    static const Setting<1> pendulum = pendulumSetting();
    return fit(pendulum, table, budget, false);
}

}  // namespace extremal::tools
