// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/slow/normal_form.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

namespace extremal::slow {
namespace {

using Complex = std::complex<double>;

/// Powers of eps, z, conj z, p, cos, sin, G.
enum Variable { eps, z, conjugate, p, cosine, sine, gravity, variables };
struct Powers {
    std::array<std::int8_t, variables> of{};
    auto operator<=>(const Powers&) const = default;
    Powers operator+(const Powers& b) const {
        Powers sum = *this;
        for (std::size_t i = 0; i < variables; ++i) sum.of[i] = static_cast<std::int8_t>(sum.of[i] + b.of[i]);
        return sum;
    }
    Powers with(Variable v, int change) const {
        Powers changed = *this;
        changed.of[v] = static_cast<std::int8_t>(changed.of[v] + change);
        return changed;
    }
};
using Polynomial = std::map<Powers, Complex>;

Powers power(std::initializer_list<std::pair<Variable, int>> entries) {
    Powers made;
    for (const auto& [v, n] : entries) made.of[v] = static_cast<std::int8_t>(n);
    return made;
}

/// Adds f c m, with sin^2 = 1 - cos^2.
void add(Polynomial& to, const Powers& m, const Complex& c) {
    if (m.of[sine] < 2) {
        to[m] += c;
        return;
    }
    add(to, m.with(sine, -2), c);
    add(to, m.with(sine, -2).with(cosine, 2), -c);
}
void add(Polynomial& to, const Polynomial& from, double factor = 1) {
    for (const auto& [m, c] : from) add(to, m, factor * c);
}
/// Without what is left of terms that cancel.
void clean(Polynomial& f) {
    std::erase_if(f, [](const auto& term) { return std::abs(term.second) < 1e-13; });
}

Polynomial derivative(const Polynomial& f, Variable v) {
    Polynomial d;
    for (const auto& [m, c] : f)
        if (m.of[v] > 0) d[m.with(v, -1)] += static_cast<double>(m.of[v]) * c;
    return d;
}
Polynomial byTheta(const Polynomial& f) {
    Polynomial d;
    for (const auto& [m, c] : f) {
        if (m.of[cosine] > 0)
            add(d, m.with(cosine, -1).with(sine, 1), -static_cast<double>(m.of[cosine]) * c);
        if (m.of[sine] > 0) add(d, m.with(sine, -1).with(cosine, 1), static_cast<double>(m.of[sine]) * c);
    }
    return d;
}

/// factor eps^shift f g up to eps^most.
void addProduct(Polynomial& to, const Polynomial& f, const Polynomial& g, const Complex& factor, int shift,
                int most) {
    for (const auto& [m, a] : f)
        for (const auto& [n, b] : g)
            if (m.of[eps] + n.of[eps] + shift > most)
                break;  // they are in the order of this power
            else
                add(to, (m + n).with(eps, shift), factor * a * b);
}
Polynomial bracket(const Polynomial& f, const Polynomial& g, int most) {
    Polynomial r;
    addProduct(r, byTheta(f), derivative(g, p), 1, 0, most);
    addProduct(r, derivative(f, p), byTheta(g), -1, 0, most);
    // {z, conj z} = -i / eps.
    addProduct(r, derivative(f, z), derivative(g, conjugate), Complex(0, -1), -1, most);
    addProduct(r, derivative(f, conjugate), derivative(g, z), Complex(0, 1), -1, most);
    clean(r);
    return r;
}

/// Adds the terms of exp(L_S) from the one of number `from` on, which is `term`.
void addSeries(Polynomial& sum, Polynomial term, const Polynomial& S, int from, int most) {
    for (int j = from; !term.empty(); ++j) {
        add(sum, term);
        term = bracket(term, S, most);
        for (auto& [m, c] : term) c /= j + 1;
    }
    clean(sum);
}
/// exp(L_S) f.
Polynomial transformed(const Polynomial& f, const Polynomial& S, int most) {
    Polynomial sum;
    addSeries(sum, f, S, 0, most);
    return sum;
}

/// H up to eps^most: (eps x)^n = (eps/sqrt 2)^n (z + conj z)^n.
Polynomial hamiltonian(int most) {
    Polynomial H{{power({{z, 1}, {conjugate, 1}}), 1.0}};
    for (int n = 0; n <= most; ++n) {
        double binomial = std::pow(2, -0.5 * n);
        for (int i = 0; i <= n; ++i) {
            const Powers x = power({{eps, n}, {z, i}, {conjugate, n - i}});
            H[x.with(p, 2)] += (n % 2 == 0 ? 0.5 : -0.5) * (n + 1) * binomial;
            if (n < 2) H[x.with(cosine, 1).with(gravity, 1)] -= binomial;
            binomial *= static_cast<double>(n - i) / (i + 1);
        }
    }
    return H;
}

struct Generators {
    Polynomial energy;
    std::vector<Polynomial> S;
};
Generators generators(int N) {
    Generators made{hamiltonian(N), {}};
    for (int n = 1; n <= N; ++n) {
        Polynomial S;
        for (const auto& [m, c] : made.energy)
            if (const int turns = m.of[z] - m.of[conjugate]; m.of[eps] == n && turns != 0)
                S[m.with(eps, 1)] = Complex(0, 1.0 / turns) * c;
        made.energy = transformed(made.energy, S, N);
        made.S.push_back(std::move(S));
    }
    return made;
}

struct Map {
    Polynomial theta, p, z;
};
/// The variables after exp(L_S) for each S in turn, up to eps^most.
Map mapOf(const std::vector<Polynomial>& all, int most) {
    Map map{{}, {{power({{p, 1}}), 1.0}}, {{power({{z, 1}}), 1.0}}};
    for (const Polynomial& S : all) {
        Polynomial theta = transformed(map.theta, S, most), first = derivative(S, p);
        std::erase_if(first, [&](const auto& term) { return term.first.of[eps] > most; });
        addSeries(theta, std::move(first), S, 1, most);
        map = {std::move(theta), transformed(map.p, S, most), transformed(map.z, S, most)};
    }
    return map;
}

struct Symbolic {
    Polynomial energy;
    Map toOld, toNew;
};
const Symbolic& symbolic(int corrections) {
    static std::array<Symbolic, 3> known;
    static std::array<std::once_flag, 3> once;
    const auto i = static_cast<std::size_t>(corrections - 1);
    std::call_once(once[i], [&] {
        const int N = 2 * corrections;
        Generators made = generators(N);
        std::vector<Polynomial> back(made.S.rbegin(), made.S.rend());
        for (Polynomial& S : back)
            for (auto& [m, c] : S) c = -c;
        made.energy.erase(power({{z, 1}, {conjugate, 1}}));
        known[i] = {std::move(made.energy), mapOf(made.S, N + 1), mapOf(back, N + 1)};
    });
    return known[i];
}

/// With numbers for eps and G. Factors are real or imaginary, as S changes its sign with p and y.
Series inPlace(const Polynomial& f, double size, double G) {
    std::map<Powers, Complex> sum;
    for (const auto& [m, c] : f)
        sum[m.with(eps, -m.of[eps]).with(gravity, -m.of[gravity])] +=
            c * std::pow(size, m.of[eps]) * std::pow(G, m.of[gravity]);
    Series series;
    for (const auto& [m, c] : sum) {
        const bool isImaginary = std::abs(c.imag()) > std::abs(c.real());
        series.push_back({isImaginary ? c.imag() : c.real(), isImaginary, std::min(m.of[z], m.of[conjugate]),
                          m.of[p], m.of[cosine], m.of[sine], m.of[z] - m.of[conjugate]});
    }
    return series;
}
/// Twice those with positive powers of z in place of pairs of conjugates.
Series halved(Series series) {
    std::erase_if(series, [](const Term& t) { return t.z < 0; });
    for (Term& t : series)
        if (t.z > 0) t.factor *= 2;
    return series;
}
NearIdentity inPlace(const Map& map, double size, double G) {
    NearIdentity made{halved(inPlace(map.theta, size, G)), halved(inPlace(map.p, size, G)),
                      inPlace(map.z, size, G)};
    for (const Series* series : {&made.theta, &made.p, &made.z})
        for (const Term& t : *series)
            for (const int power : {t.J, t.p, t.cosine, t.sine, std::abs(t.z)})
                made.most = std::max(made.most, power);
    return made;
}

class PowerTable {
public:
    PowerTable(int highest, double p, double theta, const Complex& z) {
        const double c = std::cos(theta), s = std::sin(theta), J = std::norm(z);
        J_[0] = p_[0] = c_[0] = s_[0] = re_[0] = 1;
        im_[0] = 0;
        for (std::size_t i = 1; i <= at(highest); ++i) {
            J_[i] = J_[i - 1] * J;
            p_[i] = p_[i - 1] * p;
            c_[i] = c_[i - 1] * c;
            s_[i] = s_[i - 1] * s;
            re_[i] = re_[i - 1] * z.real() - im_[i - 1] * z.imag();
            im_[i] = re_[i - 1] * z.imag() + im_[i - 1] * z.real();
        }
    }
    double realSum(const Series& series) const {
        double sum = 0;
        for (const Term& t : series) sum += factor(t) * (t.isImaginary ? -im_[at(t.z)] : re_[at(t.z)]);
        return sum;
    }
    Complex sum(const Series& series) const {
        double re = 0, im = 0;
        for (const Term& t : series) {
            const double f = factor(t), x = re_[at(std::abs(t.z))],
                         y = t.z < 0 ? -im_[at(-t.z)] : im_[at(t.z)];
            re += f * (t.isImaginary ? -y : x);
            im += f * (t.isImaginary ? x : y);
        }
        return {re, im};
    }

private:
    static std::size_t at(int power) { return static_cast<std::size_t>(power); }
    double factor(const Term& t) const {
        return t.factor * J_[at(t.J)] * (p_[at(t.p)] * c_[at(t.cosine)] * s_[at(t.sine)]);
    }
    static constexpr std::size_t most = 12;
    std::array<double, most> J_, p_, c_, s_, re_, im_;
};

}  // namespace

NormalForm normalForm(int corrections, double size, double G) {
    const Symbolic& from = symbolic(corrections);
    NormalForm made;
    for (const Term& t : inPlace(from.energy, size, G)) {
        const SlowEnergy::Term term{t.factor, t.p / 2, t.cosine, t.J};
        made.energy.degree = std::max(made.energy.degree, term.P + term.cosine + term.J);
        made.energy.terms.push_back(term);
    }
    made.toOld = inPlace(from.toOld, size, G);
    made.toNew = inPlace(from.toNew, size, G);
    return made;
}

void apply(const NearIdentity& map, double& theta, double& p, Complex& z) {
    const PowerTable at(map.most, p, theta, z);
    theta += at.realSum(map.theta);
    p = at.realSum(map.p);
    z = at.sum(map.z);
}

}  // namespace extremal::slow
