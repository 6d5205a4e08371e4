/// Kepler problem in the plane: L = (x_t^2 + y_t^2) / 2 + mu / r. Dimensionless.
///
/// Exact solution of elliptic and hyperbolic orbits by Kepler's equation, in the basis of the perihelion; radial and
/// parabolic orbits have none here (the reference is then computed).
#include <array>
#include <cmath>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct Kepler {
    static constexpr int dimension = 2;
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
};

const std::vector<Field<Kepler>>& fields() {
    static const std::vector<Field<Kepler>> all = {
        {&Kepler::mu, positive("mu", "gravitational parameter", "", 1, "Strength of the attraction, G M.")},
    };
    return all;
}

/// An orbit that is no circle-degenerate line: semi-major axis a > 0 (|a| for hyperbolas), eccentricity e, mean motion n,
/// unit vectors P (to the perihelion) and Q (90 degrees further along the motion).
struct Orbit {
    bool isElliptic = true;
    double a = 1, e = 0, b = 1, n = 1, start = 0, meanAnomaly = 0;
    double px = 1, py = 0, qx = 0, qy = 1;
    double warm = 0, warmMean = 0;  ///< eccentric anomaly of the previous call and its mean anomaly

    double sinE = 0, cosE = 1;  ///< of warm
    int sinceFresh = 0;         ///< calls since they were last computed afresh

    void operator()(double t, std::span<double> x) {
        const double mean = meanAnomaly + n * (t - start);
        double c, s;
        if (isElliptic) {
            if (!stepElliptic(mean)) solveElliptic(mean);
            c = cosE;
            s = sinE;
        } else {
            const double E = solveHyperbolic(mean);
            c = std::cosh(E);
            s = std::sinh(E);
        }
        const double sign = isElliptic ? 1 : -1;
        const double rate = n / (sign * (1 - e * c));  // dE/dt
        const double u = sign * a * (c - e), v = b * s;
        const double ut = -a * s * rate, vt = b * c * rate;
        x[0] = u * px + v * qx;
        x[1] = u * py + v * qy;
        x[2] = ut * px + vt * qx;
        x[3] = ut * py + vt * qy;
    }
    /// E - e sin E = M from scratch, by Newton with Halley's correction.
    void solveElliptic(double mean) {
        double E = mean + e * std::sin(mean);
        for (int i = 0; i < 60; ++i) {
            const double s = e * std::sin(E), slope = 1 - e * std::cos(E);
            const double f = E - s - mean;
            const double step = f / (slope - 0.5 * f * s / slope);
            E -= step;
            if (std::abs(step) < 1e-8 * (1 + std::abs(E)) || !std::isfinite(E)) break;  // converges cubically
        }
        warm = E;
        warmMean = mean;
        sinE = std::sin(E);
        cosE = std::cos(E);
        sinceFresh = 0;
    }
    /// The same close to the previous call: E turns by a small d, found by Halley's iteration on the addition theorems
    /// with Taylor polynomials of sin d and cos d. Much cheaper, as runs ask for one node after the other; every 64th
    /// call starts afresh, so that round-off cannot add up. False where d is not small.
    bool stepElliptic(double mean) {
        const double advance = mean - warmMean;
        double slope = 1 - e * cosE;
        double d = advance / slope;
        if (++sinceFresh > 64 || !(std::abs(d) < 0.02)) return false;
        d -= 0.5 * e * sinE / slope * d * d;
        double s = sinE, c = cosE;
        for (int i = 0; i < 2; ++i) {
            const double d2 = d * d;
            const double sd = d * (1 - d2 / 6 * (1 - d2 / 20 * (1 - d2 / 42)));
            const double cd = d2 / 2 * (1 - d2 / 12 * (1 - d2 / 30));  // 1 - cos d
            s = sinE + (cosE * sd - sinE * cd);
            c = cosE - (sinE * sd + cosE * cd);
            if (i == 1) break;
            const double f = d - e * (s - sinE) - advance;
            slope = 1 - e * c;
            d -= f / (slope - 0.5 * f * e * s / slope);
        }
        warm += d;
        warmMean = mean;
        sinE = s;
        cosE = c;
        return true;
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
    if (o.isElliptic) o.solveElliptic(o.meanAnomaly);
    return o;
}

void draw(const double* x, Drawing& drawing) {
    drawing.shapes.push_back(Disc{{0, 0, 0}, 11, ShapeRole::scenery});
    drawing.shapes.push_back(Disc{{x[0], x[1], 0}, 7});
    drawing.tracer = {x[0], x[1], 0};
}

System make(const Settings& settings) {
    const auto model = withParameters(settings, fields());
    System s;
    s.id = "kepler";
    s.coordinates = {{"x", "position x", "x", "", ""}, {"y", "position y", "y", "", ""}};
    s.mechanics = bindMechanics<double>(model);
    s.momenta = {{"z", "L", "", [](const double* q, const double* p) { return q[0] * p[1] - q[1] * p[0]; }}};
    s.exact = [mu = model.mu](const State& initial) { return exactSolution(mu, initial); };
    s.draw = draw;
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
    e.item = {"kepler", "Kepler problem", "A planet around a fixed sun, in the plane; exact solution by Kepler's equation.",
              infos(fields()), {}, ""};
    e.exampleQ = {0.4, 0};
    e.exampleP = {0, 2};
    e.exampleEnd = 50;
    e.exampleStep = 0.05;
    e.make = make;
    return e;
}

}  // namespace extremal::systems
