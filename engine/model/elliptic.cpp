// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

constexpr int mostPanels = 100'000;

/// a(x/epsilon), which must be positive and finite.
double coefficient(const EllipticProblem& p, double x) {
    const double a = p.a(x / p.epsilon);
    if (a > 0 && std::isfinite(a)) return a;
    throw InvalidScene(
        "/a", "must be positive, got " + formatNumber(a) + " at s = " + formatNumber(x / p.epsilon, 6));
}

}  // namespace

EllipticHat ellipticHat(const EllipticProblem& problem, EllipticElements kind, int elements, int node) {
    const Rule<double> rule = gauss<double>(12);
    const int n = static_cast<int>(std::clamp(std::ceil(40 / (problem.epsilon * elements)), 100.0, 4000.0));
    const double width = 1.0 / (static_cast<double>(n) * elements);
    const int panels = static_cast<int>(std::max(1.0, std::ceil(4 * width / problem.epsilon)));
    const auto place = [&](int i) { return node / static_cast<double>(elements) + i * width; };
    // R from the left end of the two elements on; for hats, x.
    EllipticHat hat;
    std::vector<long double> R{0};
    for (int i = -n; i < n; ++i) {
        long double sum = R.back();
        if (kind == EllipticElements::linear) sum += width;
        for (int p = 0; p < panels && kind == EllipticElements::multiscale; ++p)
            for (std::size_t j = 0; j < rule.c.size(); ++j)
                sum += rule.b[j] * width / panels /
                       coefficient(problem, place(i) + (p + rule.c[j]) * width / panels);
        R.push_back(sum);
    }
    const auto middle = R[static_cast<std::size_t>(n)], end = R.back();
    for (int i = -n; i <= n; ++i) {
        const auto here = R[static_cast<std::size_t>(i + n)];
        hat.x.push_back(place(i));
        hat.phi.push_back(static_cast<double>(i <= 0 ? here / middle : (end - here) / (end - middle)));
    }
    return hat;
}

EllipticSolution::EllipticSolution(EllipticProblem problem, int elements)
    : problem_(std::move(problem)), elements_(elements) {
    const Rule<double> rule = gauss<double>(12);
    c_ = rule.c;
    b_ = rule.b;
    const double wanted = std::max(4.0, 4 / (problem_.epsilon * elements_));
    if (!(wanted * elements_ <= mostPanels))
        throw InvalidScene("/epsilon",
                           "needs " + formatNumber(wanted * elements_, 3) +
                               " panels of quadrature, the limit is " + std::to_string(mostPanels),
                           "a larger epsilon");
    perElement_ = static_cast<int>(std::ceil(wanted));
    ends_.reserve(static_cast<std::size_t>(elements_ * perElement_) + 1);
    ends_.push_back({});
    for (int panel = 0; panel < elements_ * perElement_; ++panel)
        ends_.push_back(added(ends_.back(), start(panel), start(panel + 1)));
}

/// Ends of elements are i / elements, whatever the panels.
double EllipticSolution::start(int panel) const {
    return (static_cast<double>(panel / perElement_) +
            static_cast<double>(panel % perElement_) / perElement_) /
           elements_;
}

/// R alone, continued from x0 to x1.
EllipticSolution::Wide EllipticSolution::resistance(Wide from, double x0, double x1) const {
    for (std::size_t i = 0; i < c_.size(); ++i)
        from += Wide(b_[i] * (x1 - x0)) / Wide(coefficient(problem_, x0 + c_[i] * (x1 - x0)));
    return from;
}

/// The sums continued from x0 to x1, within one panel. F inside is integrated by the same rule on a shorter
/// stretch.
EllipticSolution::Sums EllipticSolution::added(Sums from, double x0, double x1) const {
    Sums sums = from;
    const double length = x1 - x0;
    const auto forces = [&](double width) {
        Wide sum = 0;
        for (std::size_t j = 0; j < c_.size(); ++j)
            sum += Wide(b_[j] * width) * Wide(problem_.f(x0 + c_[j] * width));
        return sum;
    };
    for (std::size_t i = 0; i < c_.size(); ++i) {
        const Wide share = Wide(b_[i] * length) / Wide(coefficient(problem_, x0 + c_[i] * length));
        sums.R += share;
        sums.G += share * (from.F + forces(c_[i] * length));
    }
    sums.F += forces(length);
    return sums;
}

EllipticSolution::Sums EllipticSolution::at(double x) const {
    const int last = elements_ * perElement_ - 1;
    int panel = std::clamp(static_cast<int>(x * elements_ * perElement_), 0, last);
    while (panel > 0 && start(panel) > x) --panel;
    while (panel < last && start(panel + 1) <= x) ++panel;
    const Sums& before = ends_[static_cast<std::size_t>(panel)];
    if (x == start(panel)) return before;
    if (x == start(panel + 1)) return ends_[static_cast<std::size_t>(panel) + 1];
    return added(before, start(panel), x);
}

double EllipticSolution::u(double x) const {
    const Sums here = at(x), &all = ends_.back();
    return static_cast<double>(here.G - all.G / all.R * here.R);
}

double EllipticSolution::resistance(double x) const { return static_cast<double>(at(x).R); }

std::vector<double> EllipticSolution::nodal(EllipticElements kind) const {
    const auto n = static_cast<std::size_t>(elements_);
    // Of each element: its stiffness, and the load on its right node; the left one takes the rest of int f.
    std::vector<Wide> stiffness(n), right(n), force(n);
    for (std::size_t e = 0; e < n; ++e) {
        const std::size_t first = e * static_cast<std::size_t>(perElement_),
                          last = first + static_cast<std::size_t>(perElement_);
        const Wide length = ends_[last].R - ends_[first].R;
        Wide mean = 0, load = 0;
        for (std::size_t panel = first; panel < last; ++panel) {
            const double x0 = start(static_cast<int>(panel)), width = start(static_cast<int>(panel) + 1) - x0;
            for (std::size_t i = 0; i < c_.size(); ++i) {
                const double x = x0 + c_[i] * width;
                const Wide share = Wide(b_[i] * width);
                mean += share * Wide(coefficient(problem_, x));
                const Wide phi = kind == EllipticElements::linear
                                     ? Wide(x) * elements_ - static_cast<Wide>(e)
                                     : (resistance(ends_[panel].R, x0, x) - ends_[first].R) / length;
                load += share * Wide(problem_.f(x)) * phi;
            }
        }
        stiffness[e] = kind == EllipticElements::linear ? mean * elements_ * elements_ : 1 / length;
        right[e] = load;
        force[e] = ends_[last].F - ends_[first].F;
    }
    // Elimination of the tridiagonal system A u = -load from the left.
    std::vector<Wide> diagonal(n + 1), rhs(n + 1), u(n + 1);
    for (std::size_t i = 1; i < n; ++i) {
        diagonal[i] = stiffness[i - 1] + stiffness[i];
        rhs[i] = -(right[i - 1] + force[i] - right[i]);
        if (i == 1) continue;
        const Wide factor = stiffness[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * stiffness[i - 1];
        rhs[i] += factor * rhs[i - 1];
    }
    for (std::size_t i = n; i-- > 1;)
        u[i] = (rhs[i] + (i + 1 < n ? stiffness[i] * u[i + 1] : 0)) / diagonal[i];
    return {u.begin(), u.end()};
}

double EllipticSolution::between(EllipticElements kind, const std::vector<double>& nodal, double x) const {
    const auto e = static_cast<std::size_t>(std::clamp(static_cast<int>(x * elements_), 0, elements_ - 1));
    const double x0 = static_cast<double>(e) / elements_, x1 = static_cast<double>(e + 1) / elements_;
    double phi = (x - x0) / (x1 - x0);
    if (kind == EllipticElements::multiscale) {
        const Wide from = at(x0).R;
        phi = static_cast<double>((at(x).R - from) / (at(x1).R - from));
    }
    return nodal[e] + (nodal[e + 1] - nodal[e]) * phi;
}

}  // namespace extremal
