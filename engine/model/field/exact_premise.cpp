// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/exact_premise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

/// |g| at one end over time.
struct EndWave {
    double largest = 0;
    std::vector<double> times, values;

    void add(double t, double g) {
        times.push_back(t);
        values.push_back(std::abs(g));
        largest = std::max(largest, std::abs(g));
    }
    double from() const {
        const auto half =
            std::find_if(values.begin(), values.end(), [this](double g) { return g >= largest / 2; });
        return half == values.end() ? 0 : times[static_cast<std::size_t>(half - values.begin())];
    }
};

/// sum over stretches of this length of sqrt(c integral of the squares).
double sumOver(double stretch, double speed, double step, const std::vector<double>& squares) {
    double sum = 0, inside = 0, length = 0;
    for (const double square : squares) {
        inside += speed * square * step;
        length += step;
        if (length < stretch) continue;
        sum += std::sqrt(inside);
        inside = length = 0;
    }
    return sum + std::sqrt(inside);
}

/// Waves from one end meet themselves after 2 L/c; those of both ends meet each other after L/2c, and add up
/// as squares before. The smaller of both bounds.
double boundOf(const std::array<EndWave, 2>& waves, double crossing, double speed, double step) {
    std::vector<double> left, right, both;
    for (std::size_t k = 0; k < waves[0].values.size(); ++k) {
        left.push_back(waves[0].values[k] * waves[0].values[k]);
        right.push_back(waves[1].values[k] * waves[1].values[k]);
        both.push_back(left[k] + right[k]);
    }
    return std::min(sumOver(crossing / 2, speed, step, both),
                    sumOver(2 * crossing, speed, step, left) + sumOver(2 * crossing, speed, step, right));
}

/// a(x) and its slope by differences of order 4 over two steps, whose distance says how good they are.
struct Coefficient {
    double value = 1, slope = 0, uncertainty = 0;
    bool isSmooth = true;

    Coefficient(const MediumCoefficient& a, double x, double length) {
        if (!a) return;
        const double h = 1e-4 * length;
        const auto difference = [&](double d) {
            return (8 * (a(x + d / 2) - a(x - d / 2)) - (a(x + d) - a(x - d))) / (6 * d);
        };
        value = a(x);
        slope = difference(h / 2);
        uncertainty = 2 * std::abs(slope - difference(h)) + 1e-15 * std::abs(value) / h;
        isSmooth = uncertainty < 1e-4 * std::abs(value) / length;
    }
};

/// The largest |u| and |u_t| on the domain over the run.
std::array<double, 2> sizesOf(const ExactSolution::AtPlaces& exact, const FieldProblem& problem, double start,
                              double end) {
    constexpr int times = 16, cells = 128;
    std::array<double, cells + 1> places{};
    std::array<double, 2 * places.size()> values{};
    for (int k = 0; k <= cells; ++k)
        places[static_cast<std::size_t>(k)] = problem.mesh.left() + problem.mesh.length() * k / cells;
    std::array<double, 2> most{};
    for (int i = 0; i <= times; ++i) {
        exact(start + (end - start) * i / times, places, values.data());
        for (std::size_t k = 0; k < values.size(); ++k)
            if (double& size = most[k / places.size()]; std::isfinite(values[k]))
                size = std::max(size, std::abs(values[k]));
    }
    return most;
}

/// g at both ends, time after time.
class Ends {
public:
    Ends(const ExactSolution::AtPlaces& exact, const FieldProblem& problem, double start, double end)
        : exact_(exact),
          boundary_(problem.mesh.boundary),
          places_{problem.mesh.left(), problem.mesh.left() + problem.mesh.length()},
          h_(1e-4 * problem.mesh.length()) {
        double a = 1;
        if (problem.coefficient)
            a = std::max(problem.coefficient(places_[0]), problem.coefficient(places_[1]));
        speed_ = problem.speed() * std::sqrt(a);
        const auto [size, rate] = sizesOf(exact, problem, start, end);
        size_ = size;
        // That of a wave's argument x - c t included.
        const double reach = std::max(std::abs(start), std::abs(end)) +
                             std::max(std::abs(places_[0]), std::abs(places_[1])) / speed_;
        roundOff_ = std::numeric_limits<double>::epsilon() * (size + rate * reach);
        atStart_ = {value(places_[0], start), value(places_[1], start)};
    }
    double size() const { return size_; }
    double speed() const { return speed_; }
    double place(std::size_t i) const { return places_[i]; }

    /// At a time one step after the last one that was asked for.
    std::array<double, 2> violationAt(double t, double step) {
        const std::array<double, 2> u{value(places_[0], t), value(places_[1], t)};
        if (boundary_ == Boundary::dirichlet) return {u[0] - atStart_[0], u[1] - atStart_[1]};
        const std::array<double, 2> slopes{slope(places_[0], t, h_), slope(places_[1], t, -h_)};
        if (boundary_ == Boundary::neumann) {
            for (std::size_t i = 0; i < 2; ++i)
                integral_[i] += speed_ * beyond(slopes[i], noiseOfSlope()) * step;
            return integral_;
        }
        integral_[0] += speed_ * beyond(slopes[1] - slopes[0], 2 * noiseOfSlope()) / 2 * step;
        const double g = std::abs(beyond(u[1] - u[0], 2 * roundOff_)) / 2 + std::abs(integral_[0]);
        return {g, g};
    }

private:
    double value(double x, double t) const {
        std::array<double, 2> u{};  // u, u_t
        exact_(t, {&x, 1}, u.data());
        return u[0];
    }
    /// One-sided, of order 4, within the domain.
    double slope(double x, double t, double d) const {
        return (-25 * value(x, t) + 48 * value(x + d, t) - 36 * value(x + 2 * d, t) +
                16 * value(x + 3 * d, t) - 3 * value(x + 4 * d, t)) /
               (12 * d);
    }
    /// Its weights add up to 128/12.
    double noiseOfSlope() const { return 11 * roundOff_ / h_; }
    /// What round-off explains counts as 0.
    static double beyond(double number, double noise) {
        return std::copysign(std::max(0.0, std::abs(number) - noise), number);
    }

    const ExactSolution::AtPlaces& exact_;
    Boundary boundary_;
    std::array<double, 2> places_, atStart_{}, integral_{};
    double h_, speed_ = 1, size_ = 0, roundOff_ = 0;
};

}  // namespace

FieldResidual residualOf(const FieldProfile& profile, const FieldProblem& problem, double start, double end) {
    FieldResidual worst;
    if (!profile.formula) return worst;
    constexpr int places = 400;
    std::mt19937 random(1905);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967295.0; };
    const double left = problem.mesh.left(), length = problem.mesh.length();
    for (int i = 0; i < places; ++i) {
        const std::array<double, 2> at{left + length * uniform(), start + (end - start) * uniform()};
        double u = 0, W = 0, slope = 0, curvature = 0;
        std::array<double, 2> gradient{};
        std::array<double, 3> hessian{};  // u_xx, u_xt, u_tt
        profile.formula->evaluate(at.data(), &u, gradient.data(), hessian.data());
        problem.potential.evaluate(&u, 1, &W, &slope, &curvature);
        const Elasticity::Values material = problem.elastic.at(gradient[0]);
        const Coefficient a(problem.coefficient, at[0], length);
        if (!a.isSmooth) continue;
        const double force = -(a.value * material.modulus * hessian[0] + a.slope * material.stress);
        const double sum = hessian[2] + force + slope,
                     size = std::abs(hessian[2]) + std::abs(force) + std::abs(slope);
        if (!std::isfinite(sum) || size == 0) continue;
        // W' of u next to a minimum is known to the round-off of u.
        const double explained =
            1e-14 * (std::abs(u) * std::abs(curvature) + size) + a.uncertainty * std::abs(material.stress);
        const double ratio = std::max(0.0, std::abs(sum) - explained) / size;
        if (ratio > worst.ratio) worst = {ratio, at[0], at[1], hessian[2], force, slope};
    }
    return worst;
}

EndViolation endViolationOf(const ExactSolution::AtPlaces& exact, const FieldProblem& problem, double start,
                            double end) {
    constexpr int samples = 1000;
    EndViolation found;
    if (!exact || end == start) return found;
    Ends ends(exact, problem, start, end);
    const double step = std::abs(end - start) / samples;
    std::array<EndWave, 2> waves;
    for (int k = 0; k <= samples; ++k) {
        const double t = start + (end - start) * k / samples;
        const std::array<double, 2> g = ends.violationAt(t, step);
        for (std::size_t i = 0; i < 2; ++i) waves[i].add(t, std::isfinite(g[i]) ? g[i] : 0);
    }
    const std::size_t worse = waves[1].largest > waves[0].largest ? 1 : 0;
    found.size = ends.size();
    found.largest = waves[worse].largest;
    found.place = ends.place(worse);
    found.from = waves[worse].from();
    found.error = boundOf(waves, problem.mesh.length() / ends.speed(), ends.speed(), step);
    return found;
}

namespace {

ExactPremise premiseOf(const FieldProblem& problem, const ExactSolution& exact, double start, double end) {
    ExactPremise premise;
    if (!exact.atPlaces()) return premise;
    const EndViolation ends = endViolationOf(exact.atPlaces(), problem, start, end);
    premise.error = ends.error;
    premise.isViolated = ends.matters();
    if (premise.isViolated)
        premise.text = "does not hold at x = " + formatNumber(ends.place, 6) + " (" +
                       formatNumber(ends.largest, 2) + " from t = " + formatNumber(ends.from, 2) + " on)";
    return premise;
}

std::string faultOf(const FieldProblem& problem, const PremiseCheck::Run& run) {
    constexpr double most = 1e-10;
    if (!run.given.find("exact")) return {};
    const FieldProfile profile = fieldProfile(run.given, problem, run.initial.t);
    const FieldResidual r = residualOf(profile, problem, run.start, run.end);
    if (!(r.ratio > most)) return {};
    const auto number = [](double x) { return formatNumber(x, 4); };
    return "does not solve the equation of the field: at x = " + number(r.x) + ", t = " + number(r.t) +
           " u_tt = " + number(r.acceleration) + ", -(a φ'(u_x))_x = " + number(r.force) +
           ", W'(u) = " + number(r.slope) + ", and their sum is " + formatNumber(r.ratio, 2) +
           " of their sizes";
}

}  // namespace

PremiseCheck premiseCheckOf(const std::shared_ptr<const FieldProblem>& problem) {
    return {[problem](const PremiseCheck::Run& run, const std::function<ExactSolution()>& exact) {
                return premiseOf(*problem, exact(), run.start, run.end);
            },
            [problem](const PremiseCheck::Run& run) { return faultOf(*problem, run); }};
}

}  // namespace extremal
