// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/q_ball.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stop_token>

#include "engine/core/algebra/gmres.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

using Radial = std::array<double, 2>;  // f, f'

/// dW/du and d2W/du2 at (f, 0).
std::array<double, 2> derivativesAt(const JointPotential& potential, double f) {
    const double u[2] = {f, 0};
    double slope[2], curvature[3];
    potential.evaluate(u, 1, 1, nullptr, slope, curvature);
    return {slope[0], curvature[0]};
}

double potentialAt(const JointPotential& potential, double f) {
    const double u[2] = {f, 0};
    double W = 0;
    potential.evaluate(u, 1, 1, &W, nullptr, nullptr);
    return W;
}

/// The range of f(0): from where the lump has the energy to come to rest at 0, to where it is at rest.
std::array<double, 2> bracketOf(const JointPotential& potential, double omega) {
    constexpr double finest = 1e-3, largest = 1e4;
    const double W0 = potentialAt(potential, 0);
    const auto hill = [&](double f) { return potentialAt(potential, f) - W0 - omega * omega * f * f / 2; };
    double low = 0;
    for (double f = finest; f < largest; f *= 1 + finest) {
        if (low == 0 && hill(f) < 0) low = f;
        if (low > 0 && derivativesAt(potential, f)[0] > omega * omega * f) return {low / (1 + finest), f};
    }
    return {low / (1 + finest), low > 0 ? 100 * low : 0};
}

}  // namespace

struct QBall::Shot {
    bool crosses = false;
    std::vector<double> values = {}, slopes = {};
};

double QBall::rate(double f) const {
    return (derivativesAt(potential_, f)[0] - omega_ * omega_ * f) / stiffness_;
}

QBall::Shot QBall::shoot(double start, bool isKept) const {
    constexpr double first = 1e-3;  // of the spacing: where the series of the centre ends
    constexpr int mostSteps = 20000;
    boost::numeric::odeint::runge_kutta_fehlberg78<Radial> stepper;
    const auto flow = [this](const Radial& f, Radial& df, double r) {
        df[0] = f[1];
        df[1] = rate(f[0]) - (dimension_ - 1) / r * f[1];
    };
    const double second = rate(start) / dimension_;
    double r = first * spacing_;
    Radial f{start + second * r * r / 2, second * r};
    Shot shot;
    const auto keep = [&] {
        if (!isKept) return;
        shot.values.push_back(f[0]);
        shot.slopes.push_back(f[1]);
    };
    if (isKept) {
        shot.values.push_back(start);
        shot.slopes.push_back(0);
    }
    for (int k = 1; k < mostSteps; ++k) {
        stepper.do_step(flow, f, r, k * spacing_ - r);
        r = k * spacing_;
        shot.crosses = !(f[0] > 0);
        if (shot.crosses || f[1] > 0) return shot;
        keep();
    }
    return shot;
}

QBall::QBall(const PlaneFieldProblem& problem, double omega, const std::string& pointer)
    : potential_(problem.potential()),
      omega_(omega),
      stiffness_(problem.stiffness()),
      dimension_(problem.grid().dimension()) {
    constexpr double small = 1e-5;  // against the centre: there W' is linear to 1e-10
    const double mass = derivativesAt(potential_, 0)[1] - omega * omega;
    auto [low, high] = bracketOf(potential_, omega);
    if (!(mass > 0) || !(low > 0))
        throw InvalidScene(pointer + "/omega",
                           "has no Q-ball, got " + formatNumber(omega) +
                               ": omega^2 must be below d2W/du2 at 0, and above the least 2 W/|u|^2",
                           "0.8 for the potential q-ball with its defaults");
    decay_ = std::sqrt(mass / stiffness_);
    spacing_ = 0.01 / std::max(decay_, std::abs(omega) / std::sqrt(stiffness_));
    for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2)
        (shoot(middle, false).crosses ? high : low) = middle;
    Shot best = shoot(low, true);
    std::size_t kept = 0;
    while (kept < best.values.size() && best.values[kept] > small * low) ++kept;
    if (kept == best.values.size())
        throw InvalidScene(pointer + "/omega",
                           "has a Q-ball with too wide a wall to be found, got " + formatNumber(omega),
                           "a value further from the end of its range");
    best.values.resize(kept + 1);
    best.slopes.resize(kept + 1);
    values_ = std::move(best.values);
    slopes_ = std::move(best.slopes);
}

double QBall::value(double r) const {
    const double place = r / spacing_;
    const std::size_t last = values_.size() - 1;
    if (place >= static_cast<double>(last)) {
        const double R = static_cast<double>(last) * spacing_;
        if (dimension_ == 1) return values_.back() * std::exp(-decay_ * (r - R));
        if (decay_ * r > 600) return 0;
        return values_.back() * boost::math::cyl_bessel_k(0, decay_ * r) /
               boost::math::cyl_bessel_k(0, decay_ * R);
    }
    const auto i = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(i), q = 1 - s;
    return (1 + 2 * s) * q * q * values_[i] + s * q * q * spacing_ * slopes_[i] +
           s * s * (3 - 2 * s) * values_[i + 1] - s * s * q * spacing_ * slopes_[i + 1];
}

double QBall::slope(double r) const {
    const double place = r / spacing_;
    const std::size_t last = values_.size() - 1;
    if (place >= static_cast<double>(last)) {
        if (dimension_ == 1) return -decay_ * value(r);
        if (decay_ * r > 600) return 0;
        return -decay_ * value(r) * boost::math::cyl_bessel_k(1, decay_ * r) /
               boost::math::cyl_bessel_k(0, decay_ * r);
    }
    const auto i = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(i), q = 1 - s;
    return 6 * s * q * (values_[i + 1] - values_[i]) / spacing_ + q * (q - 2 * s) * slopes_[i] +
           s * (s - 2 * q) * slopes_[i + 1];
}

namespace {

/// G(f) = f - L^{-1} (W''(0) f - W'(f)), L = -c^2 (laplacian) + W''(0) - omega^2: 0 for lumps on the grid.
class GridEquation {
public:
    GridEquation(const PlaneFieldProblem& problem, double omega)
        : problem_(problem),
          ways_(problem.grid().nx, problem.grid().ny, problem.grid().nx, problem.grid().ny),
          row_(2 * ways_.modes()),
          work_(problem.nodes()),
          curvature0_(derivativesAt(problem.potential(), 0)[1]),
          shift_(curvature0_ - omega * omega) {}

    std::vector<double> defect(const std::vector<double>& f) {
        for (std::size_t i = 0; i < f.size(); ++i)
            work_[i] = curvature0_ * f[i] - derivativesAt(problem_.potential(), f[i])[0];
        solve();
        std::vector<double> G(f.size());
        for (std::size_t i = 0; i < f.size(); ++i) G[i] = f[i] - work_[i];
        return G;
    }
    void linearise(const std::vector<double>& f) {
        softness_.resize(f.size());
        for (std::size_t i = 0; i < f.size(); ++i)
            softness_[i] = curvature0_ - derivativesAt(problem_.potential(), f[i])[1];
        displacements_.clear();
        for (const bool isAlongX : {true, false}) {
            if (!isAlongX && problem_.grid().dimension() == 1) continue;
            std::vector<double> d = derivative(f, isAlongX);
            double square = 0;
            for (const double each : d) square += each * each;
            for (double& each : d) each /= std::sqrt(square);
            displacements_.push_back(std::move(d));
        }
    }
    /// G'(f) u, and displacements as they are: where G' is nearly 0, and all that is sought is at rest.
    void apply(const std::complex<double>* u, std::complex<double>* image) {
        for (std::size_t i = 0; i < work_.size(); ++i) work_[i] = softness_[i] * u[i].real();
        solve();
        for (std::size_t i = 0; i < work_.size(); ++i) image[i] = u[i].real() - work_[i];
        for (const std::vector<double>& d : displacements_) {
            double along = 0;
            for (std::size_t i = 0; i < d.size(); ++i) along += d[i] * u[i].real();
            for (std::size_t i = 0; i < d.size(); ++i) image[i] += along * d[i];
        }
    }

private:
    /// f(k, l, entry) of the modes of row_.
    template <class F>
    void forModes(F&& f) {
        const wave::Grid& grid = problem_.grid();
        const double turn = 2 * std::numbers::pi;
        for (int l = 0, i = 0; l < grid.ny; ++l)
            for (int k = 0; k <= grid.nx / 2; ++k, ++i)
                f(turn * k / grid.x.length, turn * (2 * l > grid.ny ? l - grid.ny : l) / grid.y.length,
                  2 * k == grid.nx || 2 * l == grid.ny, row_.data() + 2 * i);
    }
    /// work_ <- L^{-1} work_.
    void solve() {
        ways_.toModes(work_.data(), row_.data());
        forModes([this](double K, double L, bool isAlternating, double* entry) {
            const double factor = isAlternating ? 0 : 1 / (problem_.stiffness() * (K * K + L * L) + shift_);
            entry[0] *= factor;
            entry[1] *= factor;
        });
        ways_.toNodes(row_.data(), work_.data());
    }
    std::vector<double> derivative(const std::vector<double>& f, bool isAlongX) {
        ways_.toModes(f.data(), row_.data());
        forModes([isAlongX](double K, double L, bool isAlternating, double* entry) {
            const double k = isAlternating ? 0 : isAlongX ? K : L, re = entry[0];
            entry[0] = -k * entry[1];
            entry[1] = k * re;
        });
        std::vector<double> slope(f.size());
        ways_.toNodes(row_.data(), slope.data());
        return slope;
    }

    const PlaneFieldProblem& problem_;
    SpectralGrid ways_;
    std::vector<double> row_, work_, softness_;
    std::vector<std::vector<double>> displacements_;  ///< of length 1
    double curvature0_, shift_;
};

}  // namespace

std::vector<double> QBall::onGrid(const PlaneFieldProblem& problem, std::array<double, 2> centre) const {
    constexpr int mostSteps = 20, mostProducts = 400;
    constexpr double roundOff = 1e-13, tolerance = 1e-6;
    std::vector<double> f;
    for (const double y : problem.y())
        for (const double x : problem.x()) f.push_back(value(std::hypot(x - centre[0], y - centre[1])));
    GridEquation equation(problem, omega_);
    Gmres gmres(f.size());
    std::vector<std::complex<double>> right(f.size()), change(f.size());
    double last = INFINITY;
    for (int k = 0; k < mostSteps; ++k) {
        const std::vector<double> G = equation.defect(f);
        double size = 0, defect = 0;
        for (std::size_t i = 0; i < f.size(); ++i) {
            size = std::max(size, std::abs(f[i]));
            defect = std::max(defect, std::abs(G[i]));
            right[i] = -G[i];
        }
        if (defect <= roundOff * size || (defect >= last && defect < 1e-11 * size)) return f;
        last = defect;
        equation.linearise(f);
        long long products = 0;
        if (gmres.solve([&](const auto* u, auto* image) { equation.apply(u, image); }, right.data(),
                        change.data(), tolerance, mostProducts, products, {}) != Outcome::converged)
            break;
        for (std::size_t i = 0; i < f.size(); ++i) f[i] += change[i].real();
    }
    throw InvalidScene("", "has no Q-ball on this grid: Newton's iteration does not converge",
                       "more cells, or a larger domain");
}

}  // namespace extremal
