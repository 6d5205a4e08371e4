// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/filon.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

using Complex = std::complex<double>;

/// j_n(x) = x^n / (2n+1)!! sum_k (-x^2/2)^k / (k! (2n+3)(2n+5)...(2n+2k+1)): for |x| < 1 the terms fall fast.
std::vector<double> ascending(double x, int count) {
    std::vector<double> j(static_cast<std::size_t>(count));
    double lead = 1;
    for (int n = 0; n < count; ++n) {
        if (n > 0) lead *= x / (2 * n + 1);
        double term = 1, sum = 1;
        for (int k = 1; std::abs(term) > 1e-18; ++k) {
            term *= -x * x / (2.0 * k * (2 * n + 2 * k + 1));
            sum += term;
        }
        j[static_cast<std::size_t>(n)] = lead * sum;
    }
    return j;
}

/// Miller's backward recurrence, normalised by sum (2n+1) j_n^2 = 1: where j_n falls with n, the upward one
/// is unstable.
std::vector<double> backward(double x, int count) {
    const int top = count + 30 + static_cast<int>(x);
    std::vector<double> j(static_cast<std::size_t>(top) + 2);
    j[static_cast<std::size_t>(top)] = 1e-30;
    for (int n = top; n > 0; --n) {
        const auto i = static_cast<std::size_t>(n);
        j[i - 1] = (2 * n + 1) / x * j[i] - j[i + 1];
        if (std::abs(j[i - 1]) > 1e100)
            for (double& value : j) value *= 1e-30;
    }
    double norm = 0;
    for (int n = 0; n <= top; ++n) norm += (2 * n + 1) * std::pow(j[static_cast<std::size_t>(n)], 2);
    const double j0 = std::sin(x) / x, j1 = (j0 - std::cos(x)) / x;
    const bool isFlipped = std::abs(j0) > std::abs(j1) ? (j0 < 0) != (j[0] < 0) : (j1 < 0) != (j[1] < 0);
    const double factor = (isFlipped ? -1 : 1) / std::sqrt(norm);
    j.resize(static_cast<std::size_t>(count));
    for (double& value : j) value *= factor;
    return j;
}

std::vector<double> upward(double x, int count) {
    std::vector<double> j(static_cast<std::size_t>(count));
    j[0] = std::sin(x) / x;
    if (count > 1) j[1] = (j[0] - std::cos(x)) / x;
    for (std::size_t n = 2; n < j.size(); ++n)
        j[n] = static_cast<double>(2 * n - 1) / x * j[n - 1] - j[n - 2];
    return j;
}

/// What does not depend on z: nodes, gamma_n w_i P_n(2 c_i - 1) at i * count + n, and 1/prod (c_i - c_l) over
/// the other nodes.
struct Expansion {
    std::vector<double> node, coefficient, cardinal;
};

Expansion madeExpansion(FilonNodes nodes, int count) {
    const Rule<double> rule = nodes == FilonNodes::gauss ? gauss<double>(count) : lobatto<double>(count);
    Expansion e;
    e.node = rule.c;
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        const double t = 2 * rule.c[i] - 1;
        double P = 1, lower = 0;
        for (int n = 0; n < count; ++n) {
            const bool isLastOfLobatto = nodes == FilonNodes::lobatto && n == count - 1;
            e.coefficient.push_back((isLastOfLobatto ? count - 1 : 2 * n + 1) * rule.b[i] * P);
            const double next = ((2 * n + 1) * t * P - n * lower) / (n + 1);
            lower = P;
            P = next;
        }
        double product = 1;
        for (std::size_t l = 0; l < rule.c.size(); ++l)
            if (l != i) product *= rule.c[i] - rule.c[l];
        e.cardinal.push_back(1 / product);
    }
    return e;
}

/// Dense output asks for the same one at every place.
std::shared_ptr<const Expansion> expansionOf(FilonNodes nodes, int count) {
    static MemoCache<std::pair<FilonNodes, int>, std::shared_ptr<const Expansion>> recent(16);
    return recent.get({nodes, count},
                      [&] { return std::make_shared<const Expansion>(madeExpansion(nodes, count)); });
}

std::vector<Complex> weightsOf(const Expansion& e, double z) {
    const std::size_t count = e.node.size();
    const std::vector<double> j = sphericalBessel(z / 2, static_cast<int>(count));
    const Complex turn = std::polar(1.0, z / 2);
    std::vector<Complex> weight(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Even n are real, odd ones imaginary; signs alternate in pairs: 1, i, -1, -i.
        double even = 0, odd = 0;
        for (std::size_t n = 0; n < count; ++n) {
            const double term = (n % 4 < 2 ? 1 : -1) * e.coefficient[i * count + n] * j[n];
            (n % 2 == 0 ? even : odd) += term;
        }
        weight[i] = turn * Complex(even, odd);
    }
    return weight;
}

/// tau l_i(tau c_j) at i * count + j: the cardinal polynomials are seen exactly by the same rule on [0, tau].
std::vector<double> partsUpTo(const Expansion& e, double tau) {
    const std::size_t count = e.node.size();
    std::vector<double> part(count * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) {
            double product = tau * e.cardinal[i];
            for (std::size_t l = 0; l < count; ++l)
                if (l != i) product *= tau * e.node[j] - e.node[l];
            part[i * count + j] = product;
        }
    return part;
}

/// int_0^tau l_i(x) e^{izx} dx.
std::vector<Complex> weightsUpTo(const Expansion& e, double z, double tau, const std::vector<double>& part) {
    const std::vector<Complex> inner = weightsOf(e, tau * z);
    const std::size_t count = e.node.size();
    std::vector<Complex> weight(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) weight[i] += part[i * count + j] * inner[j];
    return weight;
}

}  // namespace

std::vector<double> sphericalBessel(double x, int count) {
    const double size = std::abs(x);
    std::vector<double> j = size < 1             ? ascending(size, count)
                            : size < count + 0.5 ? backward(size, count)
                                                 : upward(size, count);
    if (x < 0)
        for (std::size_t n = 1; n < j.size(); n += 2) j[n] = -j[n];
    return j;
}

FilonRule filonRule(FilonNodes nodes, int count, double z) {
    const auto e = expansionOf(nodes, count);
    return {e->node, weightsOf(*e, z)};
}

FilonGrid filonGrid(FilonNodes nodes, int count, std::array<int, 2> phases, std::array<double, 2> z,
                    double tau) {
    const auto shared = expansionOf(nodes, count);
    const Expansion& e = *shared;
    const std::vector<double> part = tau == 1 ? std::vector<double>{} : partsUpTo(e, tau);
    const int M = phases[0] * phases[1], K[] = {(phases[0] - 1) / 2, (phases[1] - 1) / 2};
    std::vector<std::array<int, 2>> place;
    std::vector<Complex> turn[2];
    for (std::size_t f = 0; f < 2; ++f)
        for (int m = 0; m < phases[f]; ++m)
            turn[f].push_back(std::polar(1.0, -2 * std::numbers::pi * m / phases[f]));
    FilonGrid grid;
    grid.node = e.node;
    for (int m = 0; m < phases[0]; ++m)
        for (int n = 0; n < phases[1]; ++n) {
            place.push_back({m, n});
            grid.phase.push_back(
                {2 * std::numbers::pi * m / phases[0], 2 * std::numbers::pi * n / phases[1]});
        }
    grid.weight.resize(e.node.size() * grid.phase.size());
    // k and -k are conjugate: half of them, twice.
    for (int k = 0; k <= K[0]; ++k)
        for (int l = k == 0 ? 0 : -K[1]; l <= K[1]; ++l) {
            const double rate = k * z[0] + l * z[1];
            const std::vector<Complex> b = tau == 1 ? weightsOf(e, rate) : weightsUpTo(e, rate, tau, part);
            const double share = (k == 0 && l == 0 ? 1.0 : 2.0) / M;
            for (std::size_t m = 0; m < place.size(); ++m) {
                const int at[] = {k * place[m][0] % phases[0], (l + phases[1]) * place[m][1] % phases[1]};
                const Complex wave =
                    turn[0][static_cast<std::size_t>(at[0])] * turn[1][static_cast<std::size_t>(at[1])];
                for (std::size_t i = 0; i < b.size(); ++i)
                    grid.weight[i * place.size() + m] += share * (b[i] * wave).real();
            }
        }
    return grid;
}

}  // namespace extremal
