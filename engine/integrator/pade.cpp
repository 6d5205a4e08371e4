#include "engine/integrator/pade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace extremal {
namespace {

using Wide = __float128;

/// Complex numbers in quadruple precision: as much as is needed here.
struct WideComplex {
    Wide re = 0, im = 0;
    friend WideComplex operator+(WideComplex a, WideComplex b) { return {a.re + b.re, a.im + b.im}; }
    friend WideComplex operator-(WideComplex a, WideComplex b) { return {a.re - b.re, a.im - b.im}; }
    friend WideComplex operator*(WideComplex a, WideComplex b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend WideComplex operator/(WideComplex a, WideComplex b) {
        const Wide d = b.re * b.re + b.im * b.im;
        return {(a.re * b.re + a.im * b.im) / d, (a.im * b.re - a.re * b.im) / d};
    }
    WideComplex conjugate() const { return {re, -im}; }
    std::complex<double> rounded() const { return {static_cast<double>(re), static_cast<double>(im)}; }
};

/// All zeros at once by Aberth's iteration, on sum_j a_j z^j.
std::vector<WideComplex> zerosOf(const std::vector<Wide>& a) {
    const std::size_t s = a.size() - 1;
    std::vector<WideComplex> z(s);
    for (std::size_t j = 0; j < s; ++j) {
        // On an arc of the right half-plane, where they are known to be; off symmetry, so that no two move alike.
        const double angle = 2.2 * ((static_cast<double>(j) + 0.4) / static_cast<double>(s) - 0.5);
        z[j] = {1.2 * static_cast<double>(s) * std::cos(angle) + 1, 1.2 * static_cast<double>(s) * std::sin(angle)};
    }
    for (int iteration = 0; iteration < 400; ++iteration) {
        double largest = 0;
        for (std::size_t j = 0; j < s; ++j) {
            WideComplex p{a[s], 0}, dp{};
            for (std::size_t k = s; k-- > 0;) {
                dp = dp * z[j] + p;
                p = p * z[j] + WideComplex{a[k], 0};
            }
            const WideComplex newton = p / dp;
            WideComplex repulsion;
            for (std::size_t m = 0; m < s; ++m)
                if (m != j) repulsion = repulsion + WideComplex{1, 0} / (z[j] - z[m]);
            const WideComplex move = newton / (WideComplex{1, 0} - newton * repulsion);
            z[j] = z[j] - move;
            largest = std::max(largest, std::abs(move.rounded()));
        }
        if (largest < 1e-28) break;
    }
    return z;
}

std::vector<WideComplex> wideZeros(int s) {
    std::vector<Wide> a(static_cast<std::size_t>(s) + 1);
    a[0] = 1;
    for (int j = 0; j < s; ++j)  // ratio of consecutive coefficients
        a[static_cast<std::size_t>(j) + 1] = -a[static_cast<std::size_t>(j)] * (s - j) / (static_cast<Wide>(2 * s - j) * (j + 1));
    std::vector<WideComplex> z = zerosOf(a), ordered;
    std::sort(z.begin(), z.end(), [](const WideComplex& x, const WideComplex& y) { return x.im > y.im; });
    // Pairs from the real axis outwards; exact conjugates of each other.
    const auto size = static_cast<std::size_t>(s);
    for (std::size_t j = size / 2; j-- > 0;) {
        ordered.push_back(z[j]);
        ordered.push_back(z[j].conjugate());
    }
    if (s % 2 == 1) ordered.push_back({z[size / 2].re, 0});
    return ordered;
}

struct Known {
    std::vector<WideComplex> wide;
    std::vector<std::complex<double>> zeros;
};

const Known& known(int s) {
    static std::array<Known, 65> all;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    Known& k = all.at(static_cast<std::size_t>(s));
    if (k.wide.empty()) {
        k.wide = wideZeros(s);
        for (const WideComplex& z : k.wide) k.zeros.push_back(z.rounded());
    }
    return k;
}

}  // namespace

const std::vector<std::complex<double>>& padeZeros(int s) { return known(s).zeros; }

namespace {

std::vector<PoleGroup> makeGroups(int s, int together) {
    const std::vector<WideComplex>& zeros = known(s).wide;
    std::vector<PoleGroup> groups;
    for (std::size_t first = 0; first < zeros.size();) {
        const std::size_t count = std::min(static_cast<std::size_t>(together), zeros.size() - first);
        PoleGroup g;
        for (std::size_t j = 0; j < count; ++j) {
            const WideComplex zeta = zeros[first + j];
            WideComplex r{1, 0};
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

}  // namespace

const std::vector<PoleGroup>& padeGroups(int s, int together) {
    static std::map<std::pair<int, int>, std::vector<PoleGroup>> all;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    auto& groups = all[{s, together}];
    if (groups.empty()) groups = makeGroups(s, together);
    return groups;
}

std::complex<double> padeTurn(int s, double y) {
    // The phases of the factors add up; their moduli are 1.
    double angle = 0;
    for (const auto& zeta : padeZeros(s)) angle += 2 * std::atan2(-(zeta.imag() + y), zeta.real());
    return std::polar(1.0, angle);
}

}  // namespace extremal
