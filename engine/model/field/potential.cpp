// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

/// The three functions at every value; each is made only where it is wanted.
template <class W0, class W1, class W2>
void fill(const double* u, std::size_t n, double* W, double* slope, double* curvature, W0&& value, W1&& first,
          W2&& second) {
    if (W)
        for (std::size_t i = 0; i < n; ++i) W[i] = value(u[i]);
    if (slope)
        for (std::size_t i = 0; i < n; ++i) slope[i] = first(u[i]);
    if (curvature)
        for (std::size_t i = 0; i < n; ++i) curvature[i] = second(u[i]);
}

/// sin of n values, eight together; the last ones among zeros, so that each value has the same sine
/// everywhere.
inline void sineLanes(const double* u, std::size_t n, double* slope) {
    std::size_t i = 0;
    for (; i + Lanes::size <= n; i += Lanes::size) sin(Lanes::load(u + i)).store(slope + i);
    if (i == n) return;
    Lanes rest;
    for (std::size_t k = 0; i + k < n; ++k) rest.lane[k] = u[i + k];
    rest = sin(rest);
    for (std::size_t k = 0; i + k < n; ++k) slope[i + k] = rest.lane[k];
}

/// The same bits for values whose reduction would change nothing.
inline void smallSines(const double* u, std::size_t n, double* slope) {
    for (std::size_t i = 0; i < n; ++i) slope[i] = detail::sinNearZero(u[i], 0.0);
}
/// Whether all are. Neighbours are much alike: of most that are not, the ends say so.
bool areSmall(const double* u, std::size_t n) {
    double most = std::max(std::fabs(u[0]), std::fabs(u[n - 1]));
    for (std::size_t i = 0; i < n && most <= detail::largestUnreduced; i += Lanes::size) {
        double largest[Lanes::size] = {};
        for (std::size_t k = 0; k < Lanes::size; ++k) largest[k] = std::fabs(u[i + k]);
        for (const double each : largest) most = std::max(most, each);
    }
    return most <= detail::largestUnreduced;
}

/// A field that is at rest but for a few waves is small at most places.
void sines(const double* u, std::size_t n, double* slope) {
    constexpr std::size_t together = 32;
    static const auto any = ForThisMachine<&sineLanes>::call(), small = ForThisMachine<&smallSines>::call();
    std::size_t i = 0;
    for (; i + together <= n; i += together)
        (areSmall(u + i, together) ? small : any)(u + i, together, slope + i);
    any(u + i, n - i, slope + i);
}

}  // namespace

FieldPotential::FieldPotential(const std::string& text, double mass, const std::string& pointer)
    : mass_(mass) {
    if (text == "none") return;
    if (text == "klein-gordon") {
        kind_ = Kind::kleinGordon;
    } else if (text == "sine-gordon") {
        kind_ = Kind::sineGordon;
    } else if (text == "phi4") {
        kind_ = Kind::phi4;
    } else {
        kind_ = Kind::typed;
        typed_ = std::make_shared<const typed::TypedFunction>(
            text, pointer, std::vector<std::string>{"u"},
            std::vector<std::pair<std::string, double>>{{"mass", mass}});
    }
}

void FieldPotential::evaluate(const double* u, std::size_t n, double* W, double* slope,
                              double* curvature) const {
    const double m2 = mass_ * mass_;
    switch (kind_) {
        case Kind::none:
            for (double* zero : {W, slope, curvature})
                if (zero) std::fill_n(zero, n, 0.0);
            return;
        case Kind::kleinGordon:
            return fill(
                u, n, W, slope, curvature, [m2](double x) { return m2 * x * x / 2; },
                [m2](double x) { return m2 * x; }, [m2](double) { return m2; });
        case Kind::sineGordon:
            // 1 - cos u without cancellation.
            if (slope) sines(u, n, slope);
            return fill(
                u, n, W, nullptr, curvature,
                [](double x) {
                    const double half = std::sin(x / 2);
                    return 2 * half * half;
                },
                [](double) { return 0.0; }, [](double x) { return std::cos(x); });
        case Kind::phi4:
            return fill(
                u, n, W, slope, curvature, [](double x) { return (x * x - 1) * (x * x - 1) / 4; },
                [](double x) { return x * (x * x - 1); }, [](double x) { return 3 * x * x - 1; });
        case Kind::typed:
            for (std::size_t i = 0; i < n; ++i) {
                double value = 0, first = 0, second = 0;
                typed_->evaluate(u + i, &value, slope || curvature ? &first : nullptr,
                                 curvature ? &second : nullptr);
                if (W) W[i] = value;
                if (slope) slope[i] = first;
                if (curvature) curvature[i] = second;
            }
    }
}

std::optional<CubicSlope> FieldPotential::cubicSlope() const {
    switch (kind_) {
        case Kind::none:
            return CubicSlope{0, 0};
        case Kind::kleinGordon:
            return CubicSlope{mass_ * mass_, 0};
        case Kind::phi4:
            return CubicSlope{-1, 1};
        case Kind::sineGordon:
        case Kind::typed:
            break;
    }
    return std::nullopt;
}

double FieldPotential::operator()(double u) const {
    double value = 0;
    evaluate(&u, 1, &value, nullptr, nullptr);
    return value;
}

int polynomialDegree(const std::function<double(double)>& f) {
    constexpr int most = 12;
    constexpr std::size_t places = 2 * most + 2;
    std::array<double, places> values{};
    for (std::size_t i = 0; i < places; ++i)
        values[i] = f(2 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / places));
    double size = 0;
    for (const double each : values) size = std::max(size, std::abs(each));
    if (!std::isfinite(size)) return 0;
    // Coefficients of Chebyshev's polynomials T_k(s/2): those above the degree are round-off.
    int degree = 0;
    for (std::size_t k = 1; k < places; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < places; ++i)
            sum += values[i] * std::cos(std::numbers::pi * static_cast<double>(k) *
                                        (static_cast<double>(i) + 0.5) / places);
        if (std::abs(2 * sum / places) > 1e-13 * size) degree = static_cast<int>(k);
    }
    return degree > most ? 0 : std::max(degree, 1);
}

int FieldPotential::degree() const {
    if (isLinear()) return 2;
    if (kind_ == Kind::phi4) return 4;
    if (kind_ == Kind::sineGordon) return 0;
    return polynomialDegree(*this);
}

double FieldPotential::meanCurvature() const {
    constexpr std::size_t places = 64;
    std::array<double, places> u{}, curvature{};
    for (std::size_t i = 0; i < places; ++i) u[i] = (2 * static_cast<double>(i) + 1) / places - 1;
    evaluate(u.data(), places, nullptr, nullptr, curvature.data());
    double sum = 0;
    for (const double each : curvature) sum += each;
    return std::isfinite(sum) && sum > 0 ? sum / places : 0;
}

double FieldPotential::largestCurvature(double low, double high) const {
    constexpr int places = 400;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= places; ++i) {
        const double u = low + (high - low) * i / places;
        double curvature = 0;
        evaluate(&u, 1, nullptr, nullptr, &curvature);
        if (std::isfinite(curvature)) most = std::max(most, curvature);
    }
    return std::isfinite(most) ? most : 0;
}

}  // namespace extremal
