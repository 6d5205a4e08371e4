// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler problem in the plane: L = (x_t^2 + y_t^2) / 2 + mu / r. Dimensionless.
///
/// Exact solution in the basis of the perihelion: of ellipses up to e = 0.9 by Kepler's equation, at many
/// times together; of all other orbits, the parabola and its neighbours among them, by universal variables
/// (model/orbit/conic.hpp). Motion through the centre has no exact solution here: its reference is computed.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "engine/model/bind.hpp"
#include "engine/model/orbit/conic.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct Kepler {
    static constexpr int dimension = 2;
    static constexpr bool isNodeParallel = true;
    double mu = 1;

    template <class T>
    std::array<T, 2> masses() const {
        return {T(1), T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 2>& q) const {
        using std::sqrt;
        return T(-mu) / sqrt(square(q[0]) + square(q[1]));
    }
    template <class T>
    void force(const T&, const T* q, T* f) const {
        using std::sqrt;
        const T r2 = q[0] * q[0] + q[1] * q[1], w = T(-mu) / (r2 * sqrt(r2));
        if constexpr (std::is_same_v<T, double>) {
            // As one store: the caller reads f as a vector, and two narrow stores would make it wait for the
            // cache.
            Eigen::Map<Eigen::Array2d>{f} = w * Eigen::Map<const Eigen::Array2d>{q};
        } else {
            f[0] = w * q[0];
            f[1] = w * q[1];
        }
    }
};

const std::vector<Field<Kepler>>& keplerFields() {
    static const std::vector<Field<Kepler>> all = {
        {&Kepler::mu, positive("mu", "gravitational parameter", "", 1, "Strength of the attraction, G M.")},
    };
    return all;
}

/// An ellipse: semi-axes a and b, eccentricity e, mean motion n, and the mean anomaly at the start, from what
/// the conic knows without cancellation.
struct Orbit {
    double a, e, b, n, start, meanAnomaly, px, py, qx, qy;

    Orbit(double mu, const Conic& conic)
        : a(mu / conic.beta()),
          e(conic.eccentricity()),
          b(conic.angularMomentum() / std::sqrt(conic.beta())),
          n(conic.beta() * std::sqrt(conic.beta()) / mu),
          start(conic.start()),
          meanAnomaly(n * conic.sincePerihelion()),
          px(conic.px),
          py(conic.py),
          qx(conic.qx),
          qy(conic.qy) {
        auto all = std::make_shared<std::vector<Anchor>>();
        for (std::size_t k = 0; k < anchors; ++k) all->push_back(anchorAt(spacing * static_cast<double>(k)));
        anchors_ = std::move(all);
    }

    /// Position and velocity where cos and sin of the anomaly are c and s, and dE/dM = r.
    void place(double c, double s, double r, double* x) const {
        const double rate = n * r;
        const double u = a * (c - e), v = b * s;
        const double ut = -a * s * rate, vt = b * c * rate;
        x[0] = u * px + v * qx;
        x[1] = u * py + v * qy;
        x[2] = ut * px + vt * qx;
        x[3] = ut * py + vt * qy;
    }
    void operator()(std::span<const double> t, double* x) const { near(t, x); }

private:
    static constexpr std::size_t lanes = 8, anchors = 512;
    static constexpr double spacing = 2 * std::numbers::pi / anchors;  ///< of M

    /// cos E, sin E and dE/dM at a mean anomaly.
    struct Anchor {
        double c, s, r;
    };
    Anchor anchorAt(double mean) const {
        const double E = solveElliptic(mean), c = std::cos(E);
        return {c, std::sin(E), 1 / (1 - e * c)};
    }

    /// Ellipses, eight times at once: from the next anchor E turns by a small d, which is the Taylor
    /// polynomial of E(M) of degree 3; then the addition theorems with Taylor polynomials of sin d and cos d,
    /// and one Newton step. Where d is too large for that, from scratch. What is found for a time does not
    /// depend on the others.
    void near(std::span<const double> t, double* x) const {
        constexpr std::size_t width = 4;
        std::array<double, lanes> mean, f, s, c, r, d, worst;
        for (std::size_t first = 0; first < t.size(); first += lanes) {
            const std::size_t count = std::min(lanes, t.size() - first);
            for (std::size_t l = 0; l < lanes; ++l) {
                mean[l] = meanAnomaly + n * (t[first + std::min(l, count - 1)] - start);
                const double k = std::round(mean[l] / spacing),
                             turns = std::floor(k / static_cast<double>(anchors));
                const double index = k - turns * static_cast<double>(anchors);
                const bool isFinite = index >= 0 && index < static_cast<double>(anchors);
                const Anchor& anchor = (*anchors_)[isFinite ? static_cast<std::size_t>(index) : 0];
                f[l] = mean[l] - k * spacing;
                c[l] = anchor.c;
                s[l] = anchor.s;
                r[l] = anchor.r;
            }
            for (std::size_t l = 0; l < lanes; ++l) {
                const double es = e * s[l], ec = e * c[l], w = f[l] * r[l];
                d[l] = w * (1 + w * r[l] * (-0.5 * es + w * (3 * es * es * r[l] - ec) * (1.0 / 6)));
            }
            for (std::size_t l = 0; l < lanes; ++l) {
                const double d2 = d[l] * d[l];
                const double sd = d[l] * (1 - d2 * (1.0 / 6) * (1 - d2 * (1.0 / 20) * (1 - d2 * (1.0 / 42))));
                const double cd = d2 * 0.5 * (1 - d2 * (1.0 / 12) * (1 - d2 * (1.0 / 30)));  // 1 - cos d
                const double ds = c[l] * sd - s[l] * cd;
                const double turnedS = s[l] + ds, turnedC = c[l] - (s[l] * sd + c[l] * cd);
                r[l] = 1 / (1 - e * turnedC);
                f[l] = (f[l] + e * ds - d[l]) * r[l];  // the Newton correction
                worst[l] = std::max(std::abs(f[l]), 5e-7 * std::abs(d[l]));
                s[l] = turnedS + turnedC * f[l];
                c[l] = turnedC - turnedS * f[l];
                r[l] *= 1 - r[l] * e * turnedS * f[l];
            }
            for (std::size_t l = 0; l < count; ++l) {
                // Squares of the correction are then below round-off; |d| < 0.02 for the truncated series.
                const Anchor at = worst[l] < 1e-8 ? Anchor{c[l], s[l], r[l]} : anchorAt(mean[l]);
                place(at.c, at.s, at.r, x + (first + l) * width);
            }
        }
    }
    /// E - e sin E = M, by Newton with Halley's correction.
    double solveElliptic(double mean) const {
        double E = mean + e * std::sin(mean);
        for (int i = 0; i < 60; ++i) {
            const double s = e * std::sin(E), slope = 1 - e * std::cos(E);
            const double f = E - s - mean;
            const double step = f / (slope - 0.5 * f * s / slope);
            E -= step;
            if (std::abs(step) < 1e-8 * (1 + std::abs(E)) || !std::isfinite(E)) break;  // converges cubically
        }
        return E;
    }
    std::shared_ptr<const std::vector<Anchor>> anchors_;
};

/// Kepler's equation divides by 1 - e: long ellipses, parabolas and hyperbolas go by universal variables.
ExactSolution exactSolution(double mu, const State& initial) {
    constexpr double mostByAnomaly = 0.9;
    const Conic conic(mu, initial);
    if (!conic.isKnown()) return {};
    if (conic.isElliptic() && conic.eccentricity() < mostByAnomaly) return Orbit(mu, conic);
    return [conic](double t, std::span<double> x) { conic(t, x.data()); };
}

void drawKepler(const double* x, Drawing& drawing) {
    drawing.shapes.push_back(Disc{{0, 0, 0}, 11, ShapeRole::scenery});
    drawing.shapes.push_back(Disc{{x[0], x[1], 0}, 7});
    drawing.tracer = {x[0], x[1], 0};
}

System makeKepler(const Settings& settings) {
    const auto model = withParameters(settings, keplerFields());
    System s;
    s.id = "kepler";
    s.coordinates = {{"x", "position x", "x", "", ""}, {"y", "position y", "y", "", ""}};
    s.parts.set(bindMechanics<double>(model));
    s.momenta = {{"z", "L", "", [](const double* q, const double* p) { return q[0] * p[1] - q[1] * p[0]; }}};
    s.exact = [mu = model.mu](const State& initial) { return exactSolution(mu, initial); };
    s.draw = drawKepler;
    s.phaseX = "q.x";
    s.phaseY = "p.x";
    s.trajectoryX = "q.x";
    s.trajectoryY = "q.y";
    s.hasPlanarTrajectory = true;
    return s;
}

}  // namespace

ModelEntry kepler() {
    ModelEntry e;
    e.item = {"kepler",
              "Kepler problem",
              "A planet around a fixed sun, in the plane; exact solution by Kepler's equation.",
              infos(keplerFields()),
              {},
              ""};
    e.exampleQ = {0.4, 0};
    e.exampleP = {0, 2};
    e.exampleEnd = 50;
    e.exampleStep = 0.05;
    e.lagrangian = [](const Settings&) -> std::string { return "(x_t^2+y_t^2)/2 + mu/sqrt(x^2+y^2)"; };
    e.make = makeKepler;
    return e;
}

}  // namespace extremal::systems
