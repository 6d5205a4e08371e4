#include "engine/quadrature/rule.hpp"

#include "engine/core/problem.hpp"

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

namespace extremal {
namespace {

using Quad = boost::multiprecision::float128;

template <class T>
T pi() {
    if constexpr (std::is_same_v<T, Quad>)
        return 4 * atan(Quad(1));
    else
        return std::numbers::pi_v<T>;
}

/// Double rules are computed with 64 bits of mantissa, quadruple ones in quadruple precision.
template <class T>
using Wide = std::conditional_t<std::is_same_v<T, double>, long double, T>;

/// Legendre polynomials P_n(x), P_{n-1}(x) and P_n'(x) by the three-term recurrence.
template <class W>
struct Legendre {
    W p, previous, derivative;
    Legendre(int n, const W& x) : p(1), previous(0), derivative(0) {
        W dPrevious(0);
        for (int k = 1; k <= n; ++k) {
            const W next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
            const W dNext = dPrevious + (2 * k - 1) * p;
            previous = p;
            p = next;
            dPrevious = derivative;
            derivative = dNext;
        }
    }
};

/// Newton from x until the correction no longer shrinks; f returns (value, derivative).
template <class W, class F>
W newton(W x, F f) {
    using std::abs;
    W last(2);
    for (int i = 0; i < 100; ++i) {
        const auto [value, slope] = f(x);
        const W delta = value / slope;
        x -= delta;
        const W size = abs(delta);
        if (size == 0 || (size >= last && size < W(1e-12))) break;
        last = size;
    }
    return x;
}

template <class T, class W>
void append(Rule<T>& rule, const W& x, const W& weight) {
    rule.c.push_back(static_cast<T>((1 + x) / 2));
    rule.b.push_back(static_cast<T>(weight / 2));
}

/// Gives a rule that is symmetric in theory exact mirror images: c_i + c_{n-1-i} = 1, b_i = b_{n-1-i}.
template <class T>
void symmetrise(Rule<T>& rule) {
    const std::size_t n = rule.c.size();
    for (std::size_t i = 0; i < n / 2; ++i) {
        rule.c[n - 1 - i] = T(1) - rule.c[i];
        rule.b[n - 1 - i] = rule.b[i];
    }
    if (n % 2 == 1) rule.c[n / 2] = T(0.5);
}

}  // namespace

template <class T>
Rule<T> gauss(int n) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    rule.degree = 2 * n - 1;
    for (int i = 0; i < n; ++i) {
        const W guess = -cos(pi<W>() * (4 * i + 3) / (4 * n + 2));
        const W x = newton(guess, [n](const W& y) {
            const Legendre<W> l(n, y);
            return std::pair(l.p, l.derivative);
        });
        const W slope = Legendre<W>(n, x).derivative;
        append(rule, x, W(2 / ((1 - x * x) * slope * slope)));
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
            x = newton(W(-cos(pi<W>() * i / m)), [m](const W& y) {
                const Legendre<W> l(m, y);
                return std::pair(l.derivative, W((2 * y * l.derivative - m * (m + 1) * l.p) / (1 - y * y)));
            });
        }
        const W p = Legendre<W>(m, x).p;
        append(rule, x, W(2 / (n * m * p * p)));
    }
    symmetrise(rule);
    return rule;
}

template <class T>
Rule<T> radau(int n, bool isRight) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    rule.degree = 2 * n - 2;
    rule.isSymmetric = false;
    append(rule, W(-1), W(W(2) / (n * n)));
    for (int i = 1; i < n; ++i) {
        // Roots of (P_{n-1} + P_n) / (1 + x).
        const W x = newton(W(-cos(pi<W>() * 2 * i / (2 * n - 1))), [n](const W& y) {
            const Legendre<W> l(n, y), k(n - 1, y);
            const W f = (l.p + k.p) / (1 + y);
            return std::pair(f, W((l.derivative + k.derivative - f) / (1 + y)));
        });
        const W p = Legendre<W>(n - 1, x).p;
        append(rule, x, W((1 - x) / (n * n * p * p)));
    }
    if (isRight) {
        std::reverse(rule.c.begin(), rule.c.end());
        std::reverse(rule.b.begin(), rule.b.end());
        for (T& c : rule.c) c = T(1) - c;
    }
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
        append(rule, W(-cos(pi<W>() * i / m)), W(ends * sum / m));
    }
    symmetrise(rule);
    return rule;
}

template <class T>
Rule<T> midpoint(int panels) {
    return composite(gauss<T>(1), panels);
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
        const T start = T(j) / T(rule.panels), end = T(j + 1) / T(rule.panels);
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
    if (q.type == "exact")
        throw InvalidScene("/quadrature/type",
                           "the integral of this action is not known: exact is for wave functions in "
                           "three-level form",
                           "gauss");
    const int n = q.integer("nodes"), panels = std::max(1, q.integer("panels"));
    if (q.type == "gauss") return composite(gauss<T>(n), panels);
    if (q.type == "lobatto") return composite(lobatto<T>(n), panels);
    if (q.type == "radau") return composite(radau<T>(n, q.text("end") != "left"), panels);
    if (q.type == "clenshaw-curtis") return composite(clenshawCurtis<T>(n), panels);
    if (q.type == "trapezoid") return composite(lobatto<T>(2), panels);
    return midpoint<T>(panels);
}

#define EXTREMAL_INSTANTIATE(T)                                              \
    template Rule<T> gauss<T>(int);                                          \
    template Rule<T> lobatto<T>(int);                                        \
    template Rule<T> radau<T>(int, bool);                                    \
    template Rule<T> clenshawCurtis<T>(int);                                 \
    template Rule<T> midpoint<T>(int);                                       \
    template Rule<T> trapezoid<T>(int);                                      \
    template Rule<T> composite<T>(const Rule<T>&, int);                      \
    template Rule<T> merged<T>(const Rule<T>&);                              \
    template void partialWeights<T>(const Rule<T>&, const T&, std::span<T>); \
    template Rule<T> makeRule<T>(const Settings&);
EXTREMAL_INSTANTIATE(double)
EXTREMAL_INSTANTIATE(Quad)
#undef EXTREMAL_INSTANTIATE

}  // namespace extremal
