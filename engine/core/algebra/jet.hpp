// SPDX-License-Identifier: GPL-3.0-or-later
/// Forward-mode automatic differentiation: first order (Dual) and second order (Jet) numbers.
///
/// A Dual<T, N> carries a value and its gradient in N variables; a Jet<T, N> also the Hessian, as the lower
/// triangle h[i (i + 1) / 2 + j], j <= i. Every elementary function f needs f, f', f'' at the value only:
///     grad f(u) = f' grad u,     hess f(u) = f' hess u + f'' grad u (x) grad u.
/// T is the scalar: double, or quadruple precision in tests. Models are written once, generic in the number.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace extremal {

template <class T, int N>
struct Dual {
    T value{};
    std::array<T, N> g{};

    Dual() = default;
    Dual(const T& v) : value(v) {}
    template <class U>
    requires(std::is_arithmetic_v<U> && !std::same_as<U, T>) Dual(U v) : value(static_cast<T>(v)) {}

    static Dual variable(const T& v, int index) {
        Dual d(v);
        d.g[static_cast<std::size_t>(index)] = T(1);
        return d;
    }
    /// f(u) from f and f' at u.
    Dual chain(const T& f, const T& df, const T&) const {
        Dual r(f);
        for (std::size_t i = 0; i < N; ++i) r.g[i] = df * g[i];
        return r;
    }
    Dual& operator+=(const Dual& b) {
        value += b.value;
        for (std::size_t i = 0; i < N; ++i) g[i] += b.g[i];
        return *this;
    }
    Dual& operator-=(const Dual& b) {
        value -= b.value;
        for (std::size_t i = 0; i < N; ++i) g[i] -= b.g[i];
        return *this;
    }
    Dual& scale(const T& s) {
        value *= s;
        for (std::size_t i = 0; i < N; ++i) g[i] *= s;
        return *this;
    }
    static Dual product(const Dual& a, const Dual& b) {
        Dual r(a.value * b.value);
        for (std::size_t i = 0; i < N; ++i) r.g[i] = a.value * b.g[i] + b.value * a.g[i];
        return r;
    }
};

template <class T, int N>
struct Jet {
    static constexpr std::size_t triangle = static_cast<std::size_t>(N) * (N + 1) / 2;
    T value{};
    std::array<T, N> g{};
    std::array<T, triangle> h{};

    Jet() = default;
    Jet(const T& v) : value(v) {}
    template <class U>
    requires(std::is_arithmetic_v<U> && !std::same_as<U, T>) Jet(U v) : value(static_cast<T>(v)) {}

    static Jet variable(const T& v, int index) {
        Jet j(v);
        j.g[static_cast<std::size_t>(index)] = T(1);
        return j;
    }
    /// f(u) from f, f' and f'' at u.
    Jet chain(const T& f, const T& df, const T& ddf) const {
        Jet r(f);
        std::size_t k = 0;
        for (std::size_t i = 0; i < N; ++i) {
            r.g[i] = df * g[i];
            const T c = ddf * g[i];
            for (std::size_t j = 0; j <= i; ++j, ++k) r.h[k] = df * h[k] + c * g[j];
        }
        return r;
    }
    Jet& operator+=(const Jet& b) {
        value += b.value;
        for (std::size_t i = 0; i < N; ++i) g[i] += b.g[i];
        for (std::size_t k = 0; k < triangle; ++k) h[k] += b.h[k];
        return *this;
    }
    Jet& operator-=(const Jet& b) {
        value -= b.value;
        for (std::size_t i = 0; i < N; ++i) g[i] -= b.g[i];
        for (std::size_t k = 0; k < triangle; ++k) h[k] -= b.h[k];
        return *this;
    }
    Jet& scale(const T& s) {
        value *= s;
        for (std::size_t i = 0; i < N; ++i) g[i] *= s;
        for (std::size_t k = 0; k < triangle; ++k) h[k] *= s;
        return *this;
    }
    static Jet product(const Jet& a, const Jet& b) {
        Jet r(a.value * b.value);
        std::size_t k = 0;
        for (std::size_t i = 0; i < N; ++i) {
            r.g[i] = a.value * b.g[i] + b.value * a.g[i];
            for (std::size_t j = 0; j <= i; ++j, ++k)
                r.h[k] = a.value * b.h[k] + b.value * a.h[k] + a.g[i] * b.g[j] + a.g[j] * b.g[i];
        }
        return r;
    }
};

namespace detail {
template <class J>
struct IsNumber : std::false_type {};
template <class T, int N>
struct IsNumber<Dual<T, N>> : std::true_type {
    using Scalar = T;
};
template <class T, int N>
struct IsNumber<Jet<T, N>> : std::true_type {
    using Scalar = T;
};
}  // namespace detail

/// A Dual or a Jet.
template <class J>
concept Differentiable = detail::IsNumber<J>::value;
template <class J>
using ScalarOf = typename detail::IsNumber<J>::Scalar;
/// A plain number that may be mixed with differentiable ones.
template <class U, class J>
concept ScalarFor = !Differentiable<U> && std::convertible_to<U, ScalarOf<J>>;

template <Differentiable J>
J operator+(J a, const J& b) {
    return a += b;
}
template <Differentiable J>
J operator-(J a, const J& b) {
    return a -= b;
}
template <Differentiable J>
J operator-(J a) {
    return a.scale(ScalarOf<J>(-1));
}
template <Differentiable J>
J operator*(const J& a, const J& b) {
    return J::product(a, b);
}
template <Differentiable J>
J reciprocal(const J& a) {
    const auto f = ScalarOf<J>(1) / a.value;
    return a.chain(f, -f * f, ScalarOf<J>(2) * f * f * f);
}
template <Differentiable J>
J operator/(const J& a, const J& b) {
    return a * reciprocal(b);
}
template <Differentiable J, ScalarFor<J> U>
J operator+(J a, const U& b) {
    a.value += static_cast<ScalarOf<J>>(b);
    return a;
}
template <Differentiable J, ScalarFor<J> U>
J operator+(const U& a, J b) {
    return std::move(b) + a;
}
template <Differentiable J, ScalarFor<J> U>
J operator-(J a, const U& b) {
    a.value -= static_cast<ScalarOf<J>>(b);
    return a;
}
template <Differentiable J, ScalarFor<J> U>
J operator-(const U& a, J b) {
    return -std::move(b) + a;
}
template <Differentiable J, ScalarFor<J> U>
J operator*(J a, const U& b) {
    return a.scale(static_cast<ScalarOf<J>>(b));
}
template <Differentiable J, ScalarFor<J> U>
J operator*(const U& a, J b) {
    return b.scale(static_cast<ScalarOf<J>>(a));
}
template <Differentiable J, ScalarFor<J> U>
J operator/(J a, const U& b) {
    return a.scale(ScalarOf<J>(1) / static_cast<ScalarOf<J>>(b));
}
template <Differentiable J, ScalarFor<J> U>
J operator/(const U& a, const J& b) {
    return reciprocal(b) * a;
}

template <Differentiable J>
J square(const J& a) {
    return a.chain(a.value * a.value, ScalarOf<J>(2) * a.value, ScalarOf<J>(2));
}
template <class T>
requires(!Differentiable<T>) T square(const T& a) { return a * a; }
template <Differentiable J>
J sin(const J& a) {
    using std::cos;
    using std::sin;
    const ScalarOf<J> s = sin(a.value), c = cos(a.value);
    return a.chain(s, c, -s);
}
template <Differentiable J>
J cos(const J& a) {
    using std::cos;
    using std::sin;
    const ScalarOf<J> s = sin(a.value), c = cos(a.value);
    return a.chain(c, -s, -c);
}
template <Differentiable J>
J exp(const J& a) {
    using std::exp;
    const ScalarOf<J> e = exp(a.value);
    return a.chain(e, e, e);
}
template <Differentiable J>
J log(const J& a) {
    using std::log;
    const ScalarOf<J> r = ScalarOf<J>(1) / a.value;
    return a.chain(log(a.value), r, -r * r);
}
template <Differentiable J>
J sqrt(const J& a) {
    using std::sqrt;
    const ScalarOf<J> r = sqrt(a.value), d = ScalarOf<J>(0.5) / r;
    return a.chain(r, d, ScalarOf<J>(-0.5) * d / a.value);
}

}  // namespace extremal
