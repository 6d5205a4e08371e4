/// Kepler problem in the plane: L = (x_t^2 + y_t^2) / 2 + mu / r. Dimensionless.
///
/// Exact solution of elliptic and hyperbolic orbits by Kepler's equation, in the basis of the perihelion;
/// radial and parabolic orbits have none here (the reference is then computed).
#include <array>
#include <cmath>
#include <span>

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
        std::size_t done = 0;
        if (isElliptic && t.size() >= 4 * lanes) {
            march(t, x);
            done = t.size() / lanes * lanes;
        }
        for (; done < t.size(); ++done) {
            const double mean = meanAnomaly + n * (t[done] - start);
            const double E = isElliptic ? solveElliptic(mean) : solveHyperbolic(mean);
            const double c = isElliptic ? std::cos(E) : std::cosh(E),
                         s = isElliptic ? std::sin(E) : std::sinh(E);
            place(c, s, 1 / (isElliptic ? 1 - e * c : e * c - 1), x + done * width);
        }
    }

private:
    static constexpr std::size_t lanes = 8;

    /// Many times in a row, as runs ask for them: they are cut into `lanes` stretches that march together.
    /// From one time to the next E turns by a small d: the Taylor polynomial of E(M) of degree 3, the
    /// addition theorems with Taylor polynomials of sin d and cos d, and one Newton step. Where d is too
    /// large for that, from scratch; so is the first of each stretch, so that round-off cannot add up.
    void march(std::span<const double> t, double* x) const {
        constexpr std::size_t width = 4;
        const std::size_t length = t.size() / lanes;
        std::array<double, lanes> s, c, r, last, f, d, turnS, turnC;
        for (std::size_t k = 0; k < length; ++k) {
            double worst = 1;
            if (k > 0) {
                worst = 0;
                for (std::size_t l = 0; l < lanes; ++l) f[l] = n * (t[l * length + k] - last[l]);
                for (std::size_t l = 0; l < lanes; ++l) {
                    const double es = e * s[l], ec = e * c[l], w = f[l] * r[l];
                    d[l] = w * (1 + w * r[l] * (-0.5 * es + w * (3 * es * es * r[l] - ec) * (1.0 / 6)));
                }
                for (std::size_t l = 0; l < lanes; ++l) {
                    const double d2 = d[l] * d[l];
                    const double sd =
                        d[l] * (1 - d2 * (1.0 / 6) * (1 - d2 * (1.0 / 20) * (1 - d2 * (1.0 / 42))));
                    const double cd = d2 * 0.5 * (1 - d2 * (1.0 / 12) * (1 - d2 * (1.0 / 30)));  // 1 - cos d
                    const double ds = c[l] * sd - s[l] * cd;
                    turnS[l] = s[l] + ds;
                    turnC[l] = c[l] - (s[l] * sd + c[l] * cd);
                    r[l] = 1 / (1 - e * turnC[l]);
                    f[l] = (f[l] + e * ds - d[l]) * r[l];  // the Newton correction
                }
                for (std::size_t l = 0; l < lanes; ++l) {
                    const double size = std::abs(f[l]), turn = 5e-7 * std::abs(d[l]);
                    worst = size > worst ? size : worst;
                    worst = turn > worst ? turn : worst;
                    s[l] = turnS[l] + turnC[l] * f[l];
                    c[l] = turnC[l] - turnS[l] * f[l];
                    r[l] *= 1 - r[l] * e * turnS[l] * f[l];
                }
            }
            // Squares of the correction are then below round-off; |d| < 0.02 for the truncated series.
            if (!(worst < 1e-8)) {
                for (std::size_t l = 0; l < lanes; ++l) {
                    const double E = solveElliptic(meanAnomaly + n * (t[l * length + k] - start));
                    s[l] = std::sin(E);
                    c[l] = std::cos(E);
                    r[l] = 1 / (1 - e * c[l]);
                }
            }
            for (std::size_t l = 0; l < lanes; ++l) {
                last[l] = t[l * length + k];
                place(c[l], s[l], r[l], x + (l * length + k) * width);
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
    e.make = makeKepler;
    return e;
}

}  // namespace extremal::systems
