// SPDX-License-Identifier: GPL-3.0-or-later
/// Fermi-Pasta-Ulam-Tsingou chain with alternating springs (Hairer, Lubich and Wanner, Geometric Numerical
/// Integration, sec. I.5): 2n equal masses between fixed walls, displacements q_1..q_2n, joined by soft and
/// stiff springs in turn,
///     L = m/2 sum_i q_i_t^2 - sum_soft (k_soft/2 r^2 + alpha/3 r^3 + beta/4 r^4) - sum_stiff k_stiff/2 r^2,
/// r the extension of a spring; springs 0, 2, .., 2n counted from the wall are soft, 1, 3, .., 2n - 1 stiff.
/// Dimensionless. The book's potential, r^4 for soft and omega^2/4 r^2 for stiff springs with omega = 50, is
/// beta = 4, k_stiff = 1250. The stiff springs exchange their oscillatory energies over times of order omega.
/// No exact solution.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/bind_runtime.hpp"
#include "engine/model/lagrangian_terms.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::systems {
namespace {

struct FputChain {
    double n = 3, m = 1, kSoft = 0, kStiff = 1250, alpha = 0, beta = 4;

    int dimension() const { return 2 * static_cast<int>(n); }
    double mass(int) const { return m; }

    /// Calls f(i, r, isStiff) for spring i, between masses i - 1 and i (-1 and 2n are the walls), with
    /// extension r.
    template <class F>
    void eachSpring(const double* q, F f) const {
        const int d = dimension();
        for (int i = 0; i <= d; ++i) f(i, (i < d ? q[i] : 0) - (i > 0 ? q[i - 1] : 0), i % 2 == 1);
    }
    double potential(double, const double* q) const {
        double sum = 0;
        eachSpring(q, [&](int, double r, bool isStiff) {
            sum += isStiff ? 0.5 * kStiff * r * r : r * r * (0.5 * kSoft + r * (alpha / 3 + r * beta / 4));
        });
        return sum;
    }
    void force(double, const double* q, double* f) const {
        const int d = dimension();
        for (int i = 0; i < d; ++i) f[i] = 0;
        eachSpring(q, [&](int i, double r, bool isStiff) {
            const double tension = isStiff ? kStiff * r : r * (kSoft + r * (alpha + r * beta));
            if (i < d) f[i] -= tension;
            if (i > 0) f[i - 1] += tension;
        });
    }
    /// Energy of the stiff springs and of the motion along them.
    double oscillation(const double* x) const {
        double sum = 0;
        for (int i = 0; i < dimension(); i += 2) {
            const double r = x[i + 1] - x[i], rate = (x[dimension() + i + 1] - x[dimension() + i]) / m;
            sum += m / 4 * rate * rate + kStiff / 2 * r * r;
        }
        return sum;
    }
    void curvature(double, const double* q, double* V) const {
        const int d = dimension();
        for (int i = 0; i < d * d; ++i) V[i] = 0;
        eachSpring(q, [&](int i, double r, bool isStiff) {
            const double k = isStiff ? kStiff : kSoft + r * (2 * alpha + 3 * r * beta);
            if (i < d) V[i * d + i] += k;
            if (i > 0) V[(i - 1) * d + i - 1] += k;
            if (i > 0 && i < d) {
                V[(i - 1) * d + i] -= k;
                V[i * d + i - 1] -= k;
            }
        });
    }
};

FieldInfo halfCount() {
    FieldInfo f =
        positive("n", "stiff springs", "", 3, "Number of stiff springs: half the number of masses.");
    f.type = FieldType::integer;
    f.min = 1;
    f.isMinExcluded = false;
    f.max = 64;
    return f;
}
FieldInfo signedNumber(std::string key, std::string title, double fallback, std::string description) {
    FieldInfo f = positive(std::move(key), std::move(title), "", fallback, std::move(description));
    f.min = -std::numeric_limits<double>::infinity();
    f.isMinExcluded = false;
    return f;
}

const std::vector<Field<FputChain>>& fputChainFields() {
    static const std::vector<Field<FputChain>> all = {
        {&FputChain::n, halfCount()},
        {&FputChain::m, positive("m", "mass", "", 1, "Mass of every particle.")},
        {&FputChain::kSoft,
         notNegative("k_soft", "soft stiffness", "", 0, "Linear stiffness of the soft springs.")},
        {&FputChain::kStiff,
         positive("k_stiff", "stiff stiffness", "", 1250,
                  "Stiffness of the stiff springs; their frequency is sqrt(2 k_stiff/m).")},
        {&FputChain::alpha,
         signedNumber("alpha", "cubic coefficient", 0, "Soft springs: alpha/3 r^3 in the potential.")},
        {&FputChain::beta,
         signedNumber("beta", "quartic coefficient", 4, "Soft springs: beta/4 r^4 in the potential.")},
    };
    return all;
}

void drawFputChain(int d, const double* x, Drawing& drawing) {
    // Masses at rest stand at 1..2n between walls at 0 and 2n + 1.
    const auto place = [&](int i) { return Point{i + 1.0 + (i >= 0 && i < d ? x[i] : 0), 0, 0}; };
    drawing.shapes.push_back(Segment{{0, -0.6, 0}, {0, 0.6, 0}, 3, ShapeRole::scenery});
    drawing.shapes.push_back(Segment{{d + 1.0, -0.6, 0}, {d + 1.0, 0.6, 0}, 3, ShapeRole::scenery});
    for (int i = 0; i <= d; ++i)
        drawing.shapes.push_back(Spring{place(i - 1), place(i), i % 2 == 1 ? 14 : 5});
    for (int i = 0; i < d; ++i) drawing.shapes.push_back(Disc{place(i), 8});
    drawing.tracer = place(0);
}

/// The terms of L in q1, q2, .. and the keys of the model; the stiff springs are the fast one.
struct ChainTerms {
    std::vector<std::string> coordinates;
    std::string kinetic, fast, slow;
};
ChainTerms termsOf(int d) {
    ChainTerms terms;
    for (int i = 1; i <= d; ++i) {
        terms.coordinates.push_back("q" + std::to_string(i));
        terms.kinetic += (i > 1 ? " + " : "") + ("m/2*q" + std::to_string(i) + "_t^2");
    }
    for (int i = 0; i <= d; ++i) {
        const std::string r = std::string(i < d ? "(q" + std::to_string(i + 1) : "(0") +
                              (i > 0 ? " - q" + std::to_string(i) : "") + ")";
        if (i % 2 == 1)
            terms.fast += " - k_stiff/2*" + r + "^2";
        else
            terms.slow += " - (k_soft/2*" + r + "^2 + alpha/3*" + r + "^3 + beta/4*" + r + "^4)";
    }
    return terms;
}

std::vector<LagrangianTerm<double>> chainTerms(const FputChain& chain) {
    ChainTerms terms = termsOf(chain.dimension());
    typed::Formula f{std::move(terms.coordinates),
                     {{"m", chain.m},
                      {"k_soft", chain.kSoft},
                      {"k_stiff", chain.kStiff},
                      {"alpha", chain.alpha},
                      {"beta", chain.beta}},
                     ""};
    f.terms = {{"kinetic", terms.kinetic}, {"fast", terms.fast}, {"slow", terms.slow}};
    return typed::makeTerms(f);
}

System makeFputChain(const Settings& settings) {
    const auto model = withParameters(settings, fputChainFields());
    System s;
    s.id = "fput-chain";
    for (int i = 1; i <= model.dimension(); ++i)
        s.coordinates.push_back(
            {std::to_string(i), "displacement " + std::to_string(i), "q_" + std::to_string(i), "", ""});
    Mechanics<double> mechanics = bindRuntime(model);
    if (model.dimension() <= static_cast<int>(typed::fewCoordinates))
        mechanics.terms = madeOnce([model] { return chainTerms(model); });
    s.parts.set(std::move(mechanics));
    // Every displacement has a slow part as well.
    s.fast = {std::sqrt(2 * model.kStiff / model.m),
              {},
              [model](double, const double* x) { return model.oscillation(x); },
              [model](double, const double* x) {
                  return model.oscillation(x) / std::sqrt(2 * model.kStiff / model.m);
              }};
    s.draw = [d = model.dimension()](const double* x, Drawing& drawing) { drawFputChain(d, x, drawing); };
    s.phaseX = "q.1";
    s.phaseY = "p.1";
    s.trajectoryX = "t";
    s.trajectoryY = "q.1";
    return s;
}

}  // namespace

ModelEntry fput_chain() {
    ModelEntry e;
    e.item = {"fput-chain",
              "Fermi-Pasta-Ulam-Tsingou chain",
              "Masses joined by soft nonlinear and stiff linear springs in turn: fast oscillation, slow "
              "exchange of energy.",
              infos(fputChainFields()),
              {},
              ""};
    // The book's data: the first soft variable and the first stiff spring are excited, x = (q_2 + q_1)/sqrt 2
    // = 1 and x = (q_2 - q_1)/sqrt 2 = 1/omega, each with velocity 1.
    const double r = std::sqrt(0.5), omega = 50;
    e.exampleQ = {(1 - 1 / omega) * r, (1 + 1 / omega) * r, 0, 0, 0, 0};
    e.exampleP = {0, 2 * r, 0, 0, 0, 0};
    e.exampleEnd = 20;
    e.exampleStep = 0.002;
    e.make = makeFputChain;
    e.lagrangian = [](const Settings& settings) -> std::string {
        const ChainTerms terms = termsOf(2 * settings.integer("n"));
        return terms.kinetic + terms.fast + terms.slow;
    };
    return e;
}

}  // namespace extremal::systems
