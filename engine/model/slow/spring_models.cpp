// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/slow/spring_models.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "engine/model/slow/bind_hamiltonian.hpp"
#include "engine/model/slow/normal_form.hpp"

namespace extremal::slow {
namespace {

using Spring = SpringParameters;

// --- rod -----------------------------------------------------------------------------------------------

struct Rod {
    static constexpr int dimension = 1;
    double inertia, weight;  ///< m l^2, m g l

    double energy(const double* q, const double* p) const {
        return p[0] * p[0] / (2 * inertia) - weight * std::cos(q[0]);
    }
    template <class S>
    void gradient(const S* q, const S* p, S* g) const {
        using std::sin;
        g[0] = weight * sin(q[0]);
        g[1] = p[0] / inertia;
    }
    void hessian(const double* q, const double*, double* h) const {
        h[0] = weight * std::cos(q[0]);
        h[1] = h[2] = 0;
        h[3] = 1 / inertia;
    }
    std::vector<double> inverseMasses() const { return {1 / inertia}; }
};

SlowModel rod(const Spring& s) {
    SlowModel m{"rod", "rod", 1, 0, 2, {}, {}, {}};
    m.project = [](const State& start, double* y) {
        y[0] = start.x[1];
        y[1] = start.x[3];
    };
    m.hamiltonian = [s](const double*) { return bindHamiltonian(Rod{s.m * s.l * s.l, s.m * s.g * s.l}); };
    m.embed = [](double, const double* y, double* x) {
        x[0] = x[2] = 0;
        x[1] = y[0];
        x[3] = y[1];
    };
    return m;
}

// --- averaged ------------------------------------------------------------------------------------------

struct Averaged {
    static constexpr int dimension = 1;
    Spring s;
    double I = 0;

    /// k a = m g cos theta + p^2/(m r^3), r = l + a.
    template <class S>
    S extension(const S& cosine, const S& p) const {
        S a(0);
        for (int i = 0; i < 8; ++i) {
            const S r = a + s.l;
            a = (cosine * (s.m * s.g) + p * p / (r * r * r * s.m)) / s.k;
        }
        return a;
    }
    template <class S>
    S frequency(const S& p) const {
        using std::sqrt;
        const S rate = p / (s.m * s.l * s.l);
        return sqrt(rate * rate * 3 + s.k / s.m);
    }
    /// dw/dp times w.
    double stiffening() const { return 3 / (s.m * s.m * s.l * s.l * s.l * s.l); }

    double energy(const double* q, const double* p) const {
        const double c = std::cos(q[0]), a = extension(c, p[0]), r = s.l + a;
        return p[0] * p[0] / (2 * s.m * r * r) - s.m * s.g * r * c + s.k * a * a / 2 + I * frequency(p[0]);
    }
    /// The extension is stationary: it adds nothing.
    template <class S>
    void gradient(const S* q, const S* p, S* g) const {
        using std::cos;
        using std::sin;
        const S r = extension<S>(cos(q[0]), p[0]) + s.l;
        g[0] = r * sin(q[0]) * (s.m * s.g);
        g[1] = p[0] / (r * r * s.m) + p[0] * (I * stiffening()) / frequency(p[0]);
    }
    void hessian(const double* q, const double* p, double* h) const {
        const double c = std::cos(q[0]), r = s.l + extension(c, p[0]), w = frequency(p[0]),
                     slope = stiffening() * p[0] / w, aTheta = s.m * s.g * std::sin(q[0]),
                     aP = -2 * p[0] / (s.m * r * r * r), aa = 3 * p[0] * p[0] / (s.m * r * r * r * r) + s.k;
        h[0] = s.m * s.g * r * c - aTheta * aTheta / aa;
        h[1] = h[2] = -aTheta * aP / aa;
        h[3] = 1 / (s.m * r * r) - aP * aP / aa + I * (stiffening() - slope * slope) / w;
    }
};

/// The invariant of the oscillation around the mean at the start; fast parts of theta and p, of order 1/w^2,
/// are taken off.
void projectOnAverage(const Spring& s, const State& start, double* y) {
    const double* x = start.x.data();
    const double r = x[0] + s.l, rate = x[3] / (s.m * r * r), w = std::sqrt(s.k / s.m + 3 * rate * rate),
                 off = x[0] - s.m * (s.g * std::cos(x[1]) + r * rate * rate) / s.k,
                 shift = x[2] / (s.m * w * w);
    y[0] = x[1] - 2 * x[3] / (s.m * s.l * s.l * s.l) * shift;
    y[1] = x[3] - s.m * s.g * std::sin(x[1]) * shift;
    y[2] = (x[2] * x[2] / (2 * s.m) + s.k / 2 * off * off) / w;
}

SlowModel averaged(const Spring& s) {
    SlowModel m{"averaged", "averaged spring", 1, 1, 2, {}, {}, {}};
    m.project = [s](const State& start, double* y) { projectOnAverage(s, start, y); };
    m.hamiltonian = [s](const double* y) { return bindHamiltonian(Averaged{s, y[2]}); };
    m.embed = [s](double, const double* y, double* x) {
        x[0] = Averaged{s}.extension(std::cos(y[0]), y[1]);
        x[1] = y[0];
        x[2] = 0;
        x[3] = y[1];
    };
    return m;
}

// --- normal form ---------------------------------------------------------------------------------------

/// K(theta, p, J) - J: q = (theta, angle of the oscillation less w t), p = (p / (m l^2), eps J).
/// Lanes take J from the start; it is constant.
struct Normal {
    static constexpr int dimension = 2;
    static constexpr std::size_t most = SlowEnergy::mostDegree + 1;
    /// c(i, j) of P^i cos^j, i + j <= degree.
    struct Form {
        std::array<std::array<double, most>, most> c{};

        template <class S>
        S at(int degree, const S& P, const S& cosine) const {
            S sum(0);
            for (int i = degree; i >= 0; --i) {
                const auto& row = c[static_cast<std::size_t>(i)];
                S part(row[static_cast<std::size_t>(degree - i)]);
                for (int j = degree - i - 1; j >= 0; --j)
                    part = part * cosine + S(row[static_cast<std::size_t>(j)]);
                sum = sum * P + part;
            }
            return sum;
        }
    };

    std::shared_ptr<const NormalForm> form;
    double eps;
    int degree;
    Form byP, byCosine, byJ;  ///< K_P, K_c, K_J / eps at the J of the start

    Normal(std::shared_ptr<const NormalForm> of, double size, double action)
        : form(std::move(of)), eps(size), degree(form->energy.degree - 1) {
        const double J = action / eps;
        for (const auto& t : form->energy.terms) {
            const auto i = static_cast<std::size_t>(t.P), j = static_cast<std::size_t>(t.cosine);
            const double f = t.factor * std::pow(J, t.J);
            if (i > 0) byP.c[i - 1][j] += f * t.P;
            if (j > 0) byCosine.c[i][j - 1] += f * t.cosine;
            if (t.J > 0) byJ.c[i][j] += t.factor * t.J * std::pow(J, t.J - 1) / eps;
        }
    }

    template <class S>
    void gradient(const S* q, const S* p, S* g) const {
        using std::cos;
        using std::sin;
        const S c = cos(q[0]), P = p[0] * p[0];
        g[0] = -sin(q[0]) * byCosine.at(degree, P, c);
        g[1] = S(0);
        g[2] = p[0] * byP.at(degree, P, c) * 2;
        g[3] = byJ.at(degree, P, c);
    }
    double energy(const double* q, const double* p) const {
        const double c = std::cos(q[0]), P = p[0] * p[0], J = p[1] / eps;
        double sum = 0;
        for (const auto& t : form->energy.terms)
            sum += t.factor * std::pow(P, t.P) * std::pow(c, t.cosine) * std::pow(J, t.J);
        return sum;
    }
    void hessian(const double* q, const double* p, double* h) const {
        const double c = std::cos(q[0]), s = std::sin(q[0]), P = p[0] * p[0], J = p[1] / eps;
        std::array<double, 3> first{};
        std::array<std::array<double, 3>, 3> second{};
        for (const auto& t : form->energy.terms) {
            const std::array<int, 3> power{t.P, t.cosine, t.J};
            const std::array<double, 3> at{P, c, J};
            const auto term = [&](std::size_t a, std::size_t b) {
                double value = t.factor;
                for (std::size_t v = 0; v < 3; ++v) {
                    int n = power[v];
                    for (const std::size_t by : {a, b})
                        if (by == v) value *= n--;
                    if (value == 0) return 0.0;
                    value *= std::pow(at[v], n);
                }
                return value;
            };
            for (std::size_t a = 0; a < 3; ++a) {
                first[a] += term(a, 3);
                for (std::size_t b = 0; b < 3; ++b) second[a][b] += term(a, b);
            }
        }
        const auto set = [&](std::size_t i, std::size_t j, double v) { h[4 * i + j] = h[4 * j + i] = v; };
        for (std::size_t i = 0; i < 4; ++i) set(1, i, 0);
        set(0, 0, s * s * second[1][1] - c * first[1]);
        set(0, 2, -2 * p[0] * s * second[0][1]);
        set(0, 3, -s * second[1][2] / eps);
        set(2, 2, 2 * first[0] + 4 * P * second[0][0]);
        set(2, 3, 2 * p[0] * second[0][2] / eps);
        set(3, 3, second[2][2] / (eps * eps));
    }
};

SlowModel normal(const Spring& s, int corrections) {
    SlowModel m{"normal-form-" + std::to_string(corrections), "", 2, 0, 3, {}, {}, {}};
    m.title = corrections == 1 ? "first correction"
                               : "normal form with " + std::to_string(corrections) + " corrections";
    const double w = std::sqrt(s.k / s.m), eps = 1 / w, G = s.g / s.l, inertia = s.m * s.l * s.l;
    // Made when it is needed: most scenes do not.
    const auto form = [corrections, eps, G, made = std::make_shared<std::shared_ptr<const NormalForm>>(),
                       once = std::make_shared<std::once_flag>()] {
        std::call_once(*once, [&] { *made = std::make_shared<NormalForm>(normalForm(corrections, eps, G)); });
        return *made;
    };
    m.project = [=](const State& start, double* y) {
        const std::vector<double>& x = start.x;
        std::complex<double> z(x[0] / (s.l * eps * std::sqrt(2)), x[2] / (s.m * s.l * std::sqrt(2)));
        y[0] = x[1];
        y[2] = x[3] / inertia;
        apply(form()->toNew, y[0], y[2], z);
        y[1] = -std::arg(z) - w * start.t;
        y[3] = eps * std::norm(z);
    };
    m.hamiltonian = [=](const double* y) { return bindHamiltonian(Normal(form(), eps, y[3])); };
    m.embed = [=](double t, const double* y, double* x) {
        std::complex<double> z = std::polar(std::sqrt(y[3] / eps), -(w * t + y[1]));
        double p = y[2];
        x[1] = y[0];
        apply(form()->toOld, x[1], p, z);
        x[0] = std::sqrt(2) * z.real() * eps * s.l;
        x[2] = std::sqrt(2) * z.imag() * s.m * s.l;
        x[3] = p * inertia;
    };
    return m;
}

}  // namespace

std::vector<SlowModel> springModels(const SpringParameters& spring) {
    std::vector<SlowModel> all{rod(spring), averaged(spring)};
    for (int corrections = 1; corrections <= 3; ++corrections) all.push_back(normal(spring, corrections));
    return all;
}

}  // namespace extremal::slow
