// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/potential.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
            return fill(
                u, n, W, slope, curvature,
                [](double x) {
                    const double half = std::sin(x / 2);
                    return 2 * half * half;
                },
                [](double x) { return std::sin(x); }, [](double x) { return std::cos(x); });
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

double FieldPotential::operator()(double u) const {
    double value = 0;
    evaluate(&u, 1, &value, nullptr, nullptr);
    return value;
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
