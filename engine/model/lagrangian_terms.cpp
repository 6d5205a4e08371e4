// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/lagrangian_terms.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>

#include "engine/core/memo_cache.hpp"

namespace extremal {
namespace {

const Mechanics<double>& whole(const void* p) { return *static_cast<const Mechanics<double>*>(p); }

/// 1/2 sum_i m_i v_i^2.
struct Kinetic {
    static void gradient(const void* p, const double&, const double*, const double* v, double* g) {
        const auto& m = whole(p);
        for (int i = 0; i < m.dimension; ++i) {
            g[i] = 0;
            g[m.dimension + i] = m.masses[i] * v[i];
        }
    }
    static void jet(const void* p, const double& t, const double* q, const double* v, double* value,
                    double* g, double* hessian) {
        const auto& m = whole(p);
        const int d = m.dimension;
        gradient(p, t, q, v, g);
        *value = 0;
        std::fill_n(hessian, 4 * d * d, 0.0);
        for (int i = 0; i < d; ++i) {
            *value += m.masses[i] * v[i] * v[i] / 2;
            hessian[(d + i) * 2 * d + d + i] = m.masses[i];
        }
    }
};

/// -V(t, q): what a separable Lagrangian is but for the velocities.
struct Potential {
    static void gradient(const void* p, const double& t, const double* q, const double*, double* g) {
        const auto& m = whole(p);
        m.force(m.model.get(), t, q, g);
        std::fill_n(g + m.dimension, m.dimension, 0.0);
    }
    static void jet(const void* p, const double& t, const double* q, const double* v, double* value,
                    double* g, double* hessian) {
        const auto& m = whole(p);
        const int d = m.dimension;
        m.jet(m.model.get(), t, q, v, value, g, hessian);
        for (int i = 0; i < d; ++i) {
            *value -= m.masses[i] * v[i] * v[i] / 2;
            g[d + i] = 0;
            std::fill_n(hessian + (d + i) * 2 * d + d, d, 0.0);
        }
    }
};

struct Sum {
    std::vector<LagrangianTerm<double>> terms;
    int dimension;

    static void gradient(const void* p, const double& t, const double* q, const double* v, double* g) {
        const auto& s = *static_cast<const Sum*>(p);
        s.add(g, nullptr, [&](const LagrangianTerm<double>& term, double* to, double*) {
            term.gradient(term.model.get(), t, q, v, to);
        });
    }
    static void jet(const void* p, const double& t, const double* q, const double* v, double* value,
                    double* g, double* hessian) {
        const auto& s = *static_cast<const Sum*>(p);
        *value = 0;
        s.add(g, hessian, [&](const LagrangianTerm<double>& term, double* to, double* second) {
            double own = 0;
            term.jet(term.model.get(), t, q, v, &own, to, second);
            *value += own;
        });
    }

private:
    /// The first term writes, the others are added from room that each thread keeps.
    template <class Call>
    void add(double* g, double* hessian, Call call) const {
        thread_local std::vector<double> room;
        const auto n = static_cast<std::size_t>(2 * dimension), square = hessian ? n * n : 0;
        if (room.size() < n + square) room.resize(n + square);
        call(terms.front(), g, hessian);
        for (std::size_t r = 1; r < terms.size(); ++r) {
            call(terms[r], room.data(), room.data() + n);
            for (std::size_t i = 0; i < n; ++i) g[i] += room[i];
            for (std::size_t i = 0; i < square; ++i) hessian[i] += room[n + i];
        }
    }
};

}  // namespace

GivesTerms madeOnce(GivesTerms make) {
    using Terms = std::vector<LagrangianTerm<double>>;
    const auto known = std::make_shared<CountedCache<int, Terms>>(1);
    const std::string name = "terms " + std::to_string(std::bit_cast<std::uintptr_t>(known.get()));
    return [known, name, make = std::move(make)] { return known->get(0, name, make); };
}

std::vector<LagrangianTerm<double>> termsOf(const Mechanics<double>& mechanics) {
    if (mechanics.terms) return mechanics.terms();
    if (!mechanics.isSeparable) return {};
    const auto model = std::make_shared<const Mechanics<double>>(mechanics);
    return {{"kinetic", model, Kinetic::jet, Kinetic::gradient, true},
            {"potential", model, Potential::jet, Potential::gradient, false}};
}

std::vector<std::string> termNames(const Mechanics<double>& mechanics) {
    std::vector<std::string> names;
    for (const LagrangianTerm<double>& term : termsOf(mechanics)) names.push_back(term.name);
    return names;
}

LagrangianTerm<double> sumOf(const std::vector<LagrangianTerm<double>>& terms, int dimension) {
    if (terms.size() == 1) return terms.front();
    LagrangianTerm<double> sum;
    for (const LagrangianTerm<double>& term : terms) {
        sum.name += (sum.name.empty() ? "" : " + ") + term.name;
        sum.hasVelocities = sum.hasVelocities || term.hasVelocities;
    }
    sum.model = std::make_shared<const Sum>(Sum{terms, dimension});
    sum.jet = Sum::jet;
    sum.gradient = Sum::gradient;
    return sum;
}

}  // namespace extremal
