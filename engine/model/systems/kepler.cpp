/// Kepler problem in the plane: L = (x_t^2 + y_t^2) / 2 + mu / r. Dimensionless.
///
/// Exact solution of elliptic and hyperbolic orbits by Kepler's equation, in the basis of the perihelion;
/// radial and parabolic orbits have none here (the reference is then computed).
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "engine/model/bind.hpp"
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

/// An orbit that is no circle-degenerate line: semi-major axis a > 0 (|a| for hyperbolas), eccentricity e,
/// mean motion n, unit vectors P (to the perihelion) and Q (90 degrees further along the motion).
struct Orbit {
    bool isElliptic = true;
    double a = 1, e = 0, b = 1, n = 1, start = 0, meanAnomaly = 0;
    double px = 1, py = 0, qx = 0, qy = 1;

    /// Position and velocity where cos, sin (hyperbolas: cosh, sinh) of the anomaly are c and s, and dE/dM =
    /// r.
    void place(double c, double s, double r, double* x) const {
        const double sign = isElliptic ? 1 : -1, rate = n * r;
        const double u = sign * a * (c - e), v = b * s;
        const double ut = -a * s * rate, vt = b * c * rate;
        x[0] = u * px + v * qx;
        x[1] = u * py + v * qy;
        x[2] = ut * px + vt * qx;
        x[3] = ut * py + vt * qy;
    }
    void operator()(std::span<const double> t, double* x) const {
        constexpr std::size_t width = 4;
        if (isElliptic) return near(t, x);
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double E = solveHyperbolic(meanAnomaly + n * (t[i] - start));
            const double c = std::cosh(E);
            place(c, std::sinh(E), 1 / (e * c - 1), x + i * width);
        }
    }
    /// Of ellipses: prepares places from which others are near.
    void makeAnchors() {
        auto all = std::make_shared<std::vector<Anchor>>();
        for (std::size_t k = 0; k < anchors; ++k) all->push_back(anchorAt(spacing * static_cast<double>(k)));
        anchors_ = std::move(all);
    }

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
    /// e sinh E - E = M.
    double solveHyperbolic(double mean) const {
        double E = std::asinh(mean / e);
        for (int i = 0; i < 60; ++i) {
            const double s = e * std::sinh(E), slope = e * std::cosh(E) - 1;
            const double f = s - E - mean;
            const double step = f / (slope - 0.5 * f * s / slope);
            E -= step;
            if (std::abs(step) < 1e-8 * (1 + std::abs(E)) || !std::isfinite(E)) break;
        }
        return E;
    }

    std::shared_ptr<const std::vector<Anchor>> anchors_;
};

ExactSolution exactSolution(double mu, const State& initial) {
    const double x = initial.x[0], y = initial.x[1], vx = initial.x[2], vy = initial.x[3];
    const double r = std::hypot(x, y), L = x * vy - y * vx;
    const double inverseA = 2 / r - (vx * vx + vy * vy) / mu;  // 1/a, negative for hyperbolas
    // Laplace-Runge-Lenz vector: length e, towards the perihelion.
    const double ex = vy * L / mu - x / r, ey = -vx * L / mu - y / r;
    Orbit o;
    o.e = std::hypot(ex, ey);
    if (!(r > 0) || !std::isfinite(inverseA) || std::abs(L) < 1e-12 * std::sqrt(mu * r) ||
        std::abs(inverseA) * r < 1e-9)
        return {};
    o.isElliptic = inverseA > 0;
    o.a = 1 / std::abs(inverseA);
    o.n = std::sqrt(mu * std::abs(inverseA)) * std::abs(inverseA);
    o.b = std::abs(L) / std::sqrt(mu * o.a) * o.a;  // a sqrt|1 - e^2| without cancellation
    o.start = initial.t;
    const double scale = o.e > 1e-300 ? o.e : 1;
    o.px = o.e > 1e-300 ? ex / scale : x / r;
    o.py = o.e > 1e-300 ? ey / scale : y / r;
    const double turn = L > 0 ? 1 : -1;
    o.qx = -turn * o.py;
    o.qy = turn * o.px;
    const double u = x * o.px + y * o.py, v = x * o.qx + y * o.qy;
    if (o.isElliptic) {
        const double E = std::atan2(v / o.b, u / o.a + o.e);
        o.meanAnomaly = E - o.e * std::sin(E);
        o.makeAnchors();
    } else {
        const double E = std::asinh(v / o.b);
        o.meanAnomaly = o.e * std::sinh(E) - E;
    }
    return o;
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
    s.kind = bindMechanics<double>(model);
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
