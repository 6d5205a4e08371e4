// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/pade.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace extremal {
namespace {

using Quad = __float128;
/// The zeros lose 0.6 digits for each degree: up to 24 quadruple precision is enough, and fast.
using Long =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>, boost::multiprecision::et_off>;
constexpr int mostForQuad = 24;

/// Complex numbers in more than double precision: as much as is needed here.
template <class Wide>
struct WideComplex {
    Wide re = 0, im = 0;
    friend WideComplex operator+(const WideComplex& a, const WideComplex& b) {
        return {a.re + b.re, a.im + b.im};
    }
    friend WideComplex operator-(const WideComplex& a, const WideComplex& b) {
        return {a.re - b.re, a.im - b.im};
    }
    friend WideComplex operator*(const WideComplex& a, const WideComplex& b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend WideComplex operator/(const WideComplex& a, const WideComplex& b) {
        const Wide d = b.re * b.re + b.im * b.im;
        return {(a.re * b.re + a.im * b.im) / d, (a.im * b.re - a.re * b.im) / d};
    }
    WideComplex conjugate() const { return {re, -im}; }
    std::complex<double> rounded() const { return {static_cast<double>(re), static_cast<double>(im)}; }
};

/// All zeros of Q_s at once by Aberth's iteration. Q_s(z) is, up to a factor, the reverse Bessel polynomial
/// theta_s(x) at x = -z/2, theta_n = (2n - 1) theta_{n-1} + x^2 theta_{n-2}: the sum of powers would lose all
/// digits from s = 40 on.
template <class Wide>
std::vector<WideComplex<Wide>> zerosOf(std::size_t s) {
    using Number = WideComplex<Wide>;
    std::vector<Number> x(s);
    for (std::size_t j = 0; j < s; ++j) {
        // On an arc of the left half-plane, where they are known to be; off symmetry, so that no two move
        // alike.
        const double angle = 2.2 * ((static_cast<double>(j) + 0.4) / static_cast<double>(s) - 0.5);
        x[j] = {-0.6 * static_cast<double>(s) * std::cos(angle) - 0.5,
                -0.6 * static_cast<double>(s) * std::sin(angle)};
    }
    double last = 1e300;
    for (int iteration = 0; iteration < 400; ++iteration) {
        double largest = 0;
        for (std::size_t j = 0; j < s; ++j) {
            const Number square = x[j] * x[j], twice = x[j] + x[j];
            Number before{1, 0}, now = x[j] + Number{1, 0}, slopeBefore{}, slope{1, 0};
            for (std::size_t n = 2; n <= s; ++n) {
                const Number odd{Wide(static_cast<double>(2 * n - 1)), 0};
                const Number next = odd * now + square * before;
                const Number nextSlope = odd * slope + square * slopeBefore + twice * before;
                before = now;
                now = next;
                slopeBefore = slope;
                slope = nextSlope;
            }
            const Number newton = now / slope;
            Number repulsion;
            for (std::size_t m = 0; m < s; ++m)
                if (m != j) repulsion = repulsion + Number{1, 0} / (x[j] - x[m]);
            const Number move = newton / (Number{1, 0} - newton * repulsion);
            x[j] = x[j] - move;
            largest = std::max(largest, std::abs(move.rounded()));
        }
        if (largest < 1e-15 && largest > 0.5 * last) break;  // round-off
        last = largest;
    }
    for (Number& value : x) value = Number{-2, 0} * value;
    return x;
}

/// Pairs from the real axis outwards, exact conjugates of each other, then the real one of odd degrees.
template <class Wide>
std::vector<WideComplex<Wide>> orderedZeros(int s) {
    const auto size = static_cast<std::size_t>(s);
    std::vector<WideComplex<Wide>> z = zerosOf<Wide>(size), ordered;
    std::sort(z.begin(), z.end(), [](const auto& a, const auto& b) { return a.im > b.im; });
    for (std::size_t j = size / 2; j-- > 0;) {
        ordered.push_back(z[j]);
        ordered.push_back(z[j].conjugate());
    }
    if (s % 2 == 1) ordered.push_back({z[size / 2].re, 0});
    return ordered;
}

template <class Wide>
std::vector<PoleGroup> makeGroups(const std::vector<WideComplex<Wide>>& zeros, int together) {
    std::vector<PoleGroup> groups;
    for (std::size_t first = 0; first < zeros.size();) {
        const std::size_t count = std::min(static_cast<std::size_t>(together), zeros.size() - first);
        PoleGroup g;
        for (std::size_t j = 0; j < count; ++j) {
            const WideComplex<Wide> zeta = zeros[first + j];
            WideComplex<Wide> r{1, 0};
            for (std::size_t m = 0; m < count; ++m) {
                r = r * (zeros[first + m].conjugate() + zeta);
                if (m != j) r = r / (zeros[first + m] - zeta);
            }
            g.zeta.push_back(zeta.rounded());
            g.residue.push_back(r.rounded());
        }
        g.sign = count % 2 == 0 ? 1 : -1;
        groups.push_back(std::move(g));
        first += count;
    }
    return groups;
}

/// What is known of a degree: its zeros, and their groups of 1, 2 and 4.
struct Known {
    std::vector<std::complex<double>> zeros;
    std::map<int, std::vector<PoleGroup>> groups;
};

const Known& known(int s) {
    static std::array<Known, 65> all;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    Known& k = all.at(static_cast<std::size_t>(s));
    const auto fill = [&](const auto& zeros) {
        for (const auto& z : zeros) k.zeros.push_back(z.rounded());
        for (const int count : {1, 2, 4}) k.groups[count] = makeGroups(zeros, count);
    };
    if (k.zeros.empty()) s <= mostForQuad ? fill(orderedZeros<Quad>(s)) : fill(orderedZeros<Long>(s));
    return k;
}

}  // namespace

const std::vector<std::complex<double>>& padeZeros(int s) { return known(s).zeros; }

const std::vector<PoleGroup>& padeGroups(int s, int together) { return known(s).groups.at(together); }

std::complex<double> padeTurn(int s, double y) {
    // The phases of the factors add up; their moduli are 1.
    double angle = 0;
    for (const auto& zeta : padeZeros(s)) angle += 2 * std::atan2(-(zeta.imag() + y), zeta.real());
    return std::polar(1.0, angle);
}

}  // namespace extremal
