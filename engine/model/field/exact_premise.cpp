#include "engine/model/field/exact_premise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

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
double errorOf(const std::array<EndWave, 2>& waves, double crossing, double speed, double step) {
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

/// The largest |u| on the domain over the run.
double sizeOf(const ExactSolution::AtPlaces& exact, const FieldProblem& problem, double start, double end) {
    constexpr int times = 16, cells = 128;
    std::array<double, cells + 1> places{};
    std::array<double, 2 * places.size()> values{};
    for (int k = 0; k <= cells; ++k)
        places[static_cast<std::size_t>(k)] = problem.mesh.left() + problem.mesh.length() * k / cells;
    double most = 0;
    for (int i = 0; i <= times; ++i) {
        exact(start + (end - start) * i / times, places, values.data());
        for (std::size_t k = 0; k < places.size(); ++k)
            if (std::isfinite(values[k])) most = std::max(most, std::abs(values[k]));
    }
    return most;
}

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
    found.size = sizeOf(exact, problem, start, end);
    const double left = problem.mesh.left(), right = left + problem.mesh.length();
    double a = 1;
    if (problem.coefficient) a = std::max(problem.coefficient(left), problem.coefficient(right));
    const double speed = problem.speed() * std::sqrt(a);
    const auto value = [&](double x, double t) {
        std::array<double, 2> u{};  // u, u_t
        exact(t, {&x, 1}, u.data());
        return u[0];
    };
    // One-sided, of order 4, within the domain.
    const auto slope = [&](double x, double t, double h) {
        return (-25 * value(x, t) + 48 * value(x + h, t) - 36 * value(x + 2 * h, t) +
                16 * value(x + 3 * h, t) - 3 * value(x + 4 * h, t)) /
               (12 * h);
    };
    const double h = 1e-4 * problem.mesh.length(), step = std::abs(end - start) / samples;
    std::array<EndWave, 2> waves;
    std::array<double, 2> integral{};
    for (int k = 0; k <= samples; ++k) {
        const double t = start + (end - start) * k / samples;
        const std::array<double, 2> u{value(left, t), value(right, t)};
        std::array<double, 2> g{};
        if (problem.mesh.boundary == Boundary::dirichlet) {
            g = {u[0] - value(left, start), u[1] - value(right, start)};
        } else {
            const std::array<double, 2> u_x{slope(left, t, h), slope(right, t, -h)};
            if (problem.mesh.boundary == Boundary::neumann) {
                for (std::size_t i = 0; i < 2; ++i) g[i] = integral[i] += speed * u_x[i] * step;
            } else {
                integral[0] += speed * (u_x[1] - u_x[0]) / 2 * step;
                g[0] = std::abs(u[1] - u[0]) / 2 + std::abs(integral[0]);
                g[1] = g[0];
            }
        }
        for (std::size_t i = 0; i < 2; ++i) waves[i].add(t, std::isfinite(g[i]) ? g[i] : 0);
    }
    const std::size_t worse = waves[1].largest > waves[0].largest ? 1 : 0;
    found.largest = waves[worse].largest;
    found.place = worse == 1 ? right : left;
    found.from = waves[worse].from();
    found.error = errorOf(waves, problem.mesh.length() / speed, speed, step);
    return found;
}

}  // namespace extremal
