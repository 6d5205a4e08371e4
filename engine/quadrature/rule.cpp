// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/legendre.hpp"

namespace extremal {
namespace {
using Quad = boost::multiprecision::float128;
}

template <class T>
Rule<T> gauss(int n) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    rule.degree = 2 * n - 1;
    for (int i = 0; i < n; ++i) {
        const W guess = -cos(pi<W>() * (4 * i + 3) / (4 * n + 2));
        const W x = newtonRoot(guess, [n](const W& y) {
            const Legendre<W> l(n, y);
            return std::pair(l.p, l.derivative);
        });
        const W slope = Legendre<W>(n, x).derivative;
        appendNode(rule, x, W(2 / ((1 - x * x) * slope * slope)));
    }
    symmetrise(rule);
    return rule;
}

template <class T>
Rule<T> lobatto(int n) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    rule.degree = 2 * n - 3;
    const int m = n - 1;
    for (int i = 0; i < n; ++i) {
        W x = i == 0 ? W(-1) : W(1);
        if (i > 0 && i < m) {
            // Roots of P_m'; the second derivative follows from Legendre's equation.
            x = newtonRoot(W(-cos(pi<W>() * i / m)), [m](const W& y) {
                const Legendre<W> l(m, y);
                return std::pair(l.derivative, W((2 * y * l.derivative - m * (m + 1) * l.p) / (1 - y * y)));
            });
        }
        const W p = Legendre<W>(m, x).p;
        appendNode(rule, x, W(2 / (n * m * p * p)));
    }
    symmetrise(rule);
    return rule;
}

template <class T>
Rule<T> clenshawCurtis(int n) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    const int m = n - 1;
    rule.degree = n % 2 == 1 ? n : n - 1;
    for (int i = 0; i < n; ++i) {
        W sum(1);
        for (int k = 1; k <= m / 2; ++k) {
            const W factor = 2 * k == m ? W(1) : W(2);
            sum -= factor * cos(2 * k * i * pi<W>() / m) / W(4 * k * k - 1);
        }
        const W ends = i == 0 || i == m ? W(1) : W(2);
        appendNode(rule, W(-cos(pi<W>() * i / m)), W(ends * sum / m));
    }
    symmetrise(rule);
    return rule;
}

template <class T>
Rule<T> trapezoid(int panels) {
    return merged(composite(lobatto<T>(2), panels));
}

template <class T>
Rule<T> composite(const Rule<T>& rule, int panels) {
    if (panels <= 1) return rule;
    const T slack = std::numeric_limits<T>::epsilon();
    Rule<T> all;
    all.degree = rule.degree;
    all.isSymmetric = rule.isSymmetric;
    all.caution = rule.caution;
    all.panels = panels;
    all.perPanel = rule.size();
    for (int j = 0; j < panels; ++j) {
        const T end = T(j + 1) / T(panels);
        for (std::size_t k = 0; k < rule.c.size(); ++k) {
            const T c = (T(j) + rule.c[k]) / T(panels);
            all.c.push_back(c >= end && j + 1 < panels ? T(end - end * slack) : c);
            all.b.push_back(rule.b[k] / T(panels));
        }
    }
    return all;
}

template <class T>
Rule<T> composite(const Rule<T>& rule, const std::vector<T>& ends) {
    using std::abs;
    const T slack = std::numeric_limits<T>::epsilon();
    const std::size_t panels = ends.size() - 1;
    Rule<T> all;
    all.degree = rule.degree;
    all.isSymmetric = rule.isSymmetric;
    all.caution = rule.caution;
    all.panels = static_cast<int>(panels);
    all.perPanel = rule.size();
    all.ends = ends;
    for (std::size_t j = 0; j < panels; ++j) {
        const T start = ends[j], end = ends[j + 1];
        if (abs(static_cast<double>(start + ends[panels - j] - 1)) > 1e-14) all.isSymmetric = false;
        for (std::size_t k = 0; k < rule.c.size(); ++k) {
            const T c = start + (end - start) * rule.c[k];
            // Ends are rounded: both sides keep away from where a function may have its kink.
            all.c.push_back(c >= end && j + 1 < panels ? T(end - 2 * end * slack)
                            : c <= start && j > 0      ? T(start + 2 * start * slack)
                                                       : c);
            all.b.push_back(rule.b[k] * (end - start));
        }
    }
    return all;
}

template <class T>
Rule<T> merged(const Rule<T>& rule) {
    const T slack = 4 * std::numeric_limits<T>::epsilon();
    Rule<T> result = rule;
    result.c.clear();
    result.b.clear();
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        if (!result.c.empty() && rule.c[i] - result.c.back() <= slack) {
            result.c.back() = rule.c[i];
            result.b.back() += rule.b[i];
            continue;
        }
        result.c.push_back(rule.c[i]);
        result.b.push_back(rule.b[i]);
    }
    return result;
}

template <class T>
void partialWeights(const Rule<T>& rule, const T& tau, std::span<T> share) {
    const int perPanel = rule.perPanel > 0 ? rule.perPanel : rule.size();
    const bool isMerged = rule.size() < rule.panels * perPanel;
    const int stride = isMerged ? perPanel - 1 : perPanel;
    // Exact for the cardinal polynomials of a panel; kept, as curves are asked for at many places.
    thread_local Rule<T> inner;
    if (inner.size() != perPanel / 2 + 1) inner = gauss<T>(perPanel / 2 + 1);
    std::fill(share.begin(), share.end(), T(0));
    for (int j = 0; j < rule.panels; ++j) {
        const auto endOf = [&](int panel) {
            return rule.ends.empty() ? T(panel) / T(rule.panels) : rule.ends[static_cast<std::size_t>(panel)];
        };
        const T start = endOf(j), end = endOf(j + 1);
        if (j > 0 && tau <= start) return;
        const T length = (tau < end || j + 1 == rule.panels ? tau : end) - start;
        const auto first = static_cast<std::size_t>(j * stride),
                   last = first + static_cast<std::size_t>(perPanel);
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t k = 0; k < inner.c.size(); ++k) {
                T cardinal(1);
                for (std::size_t l = first; l < last; ++l)
                    if (l != i)
                        cardinal *= (start + length * inner.c[k] - rule.c[l]) / (rule.c[i] - rule.c[l]);
                share[i] += length * inner.b[k] * cardinal;
            }
    }
}

template <class T>
Rule<T> makeRule(const Settings& q) {
    if (const RuleEntry* entry = findRule(q.type)) return makeRule<T>(*entry, q);
    throw InvalidScene("/quadrature/type", "unknown quadrature \"" + q.type + "\"",
                       suggestName(q.type, idsOf(quadratureCatalog())));
}

template <class T>
Rule<T> makeRule(const RuleEntry& entry, const Settings& q) {
    if (!entry.make) throw InvalidScene("/quadrature/type", entry.refusal, entry.hint);
    Rule<T> rule;
    if constexpr (std::is_same_v<T, double>) {
        rule = entry.make(q);
    } else {
        const Rule<__float128> plain = entry.makeQuadruple(q);
        rule.c.assign(plain.c.begin(), plain.c.end());
        rule.b.assign(plain.b.begin(), plain.b.end());
        rule.degree = plain.degree;
        rule.isSymmetric = plain.isSymmetric;
    }
    rule.isSymmetric = rule.isSymmetric && entry.isSymmetric;
    return composite(rule, q.integer("panels"));
}

#define EXTREMAL_INSTANTIATE(T)                                              \
    template Rule<T> gauss<T>(int);                                          \
    template Rule<T> lobatto<T>(int);                                        \
    template Rule<T> clenshawCurtis<T>(int);                                 \
    template Rule<T> trapezoid<T>(int);                                      \
    template Rule<T> composite<T>(const Rule<T>&, int);                      \
    template Rule<T> composite<T>(const Rule<T>&, const std::vector<T>&);    \
    template Rule<T> merged<T>(const Rule<T>&);                              \
    template void partialWeights<T>(const Rule<T>&, const T&, std::span<T>); \
    template Rule<T> makeRule<T>(const RuleEntry&, const Settings&);         \
    template Rule<T> makeRule<T>(const Settings&);
EXTREMAL_INSTANTIATE(double)
EXTREMAL_INSTANTIATE(Quad)
#undef EXTREMAL_INSTANTIATE

}  // namespace extremal
