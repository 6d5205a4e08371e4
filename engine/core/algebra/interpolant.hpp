// SPDX-License-Identifier: GPL-3.0-or-later
/// A function given by points: straight lines between them, or the natural cubic spline through them.
///
///     y(x) = sum_j c(k, j) (x - b_k)^j,    k: the piece with x_(k-1) <= x < x_k
///
/// With n points there are n + 1 pieces, the first and the last of them outside the points. Lines: the values
/// at the ends stay outside. Spline: y, y' and y'' are continuous, y'' = 0 at both ends, and it goes on
/// outside as a straight line. A derivative at a point where it jumps is that of the piece to the right.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace extremal {

class Interpolant {
public:
    enum class Kind { linear, cubic };

    /// x ascending, at least two points, all of them finite.
    Interpolant(Kind kind, std::vector<double> x, std::span<const double> y);

    /// The derivative of this order at x; order 0: the value. NaN where x is.
    template <class T>
    T at(const T& x, int order = 0) const {
        const std::size_t k = piece(x);
        const T s = x - T(bases_[k]);
        const std::array<double, 4>& c = coefficients_[k];
        T sum(0);
        for (int j = degree(); j >= order; --j) {
            double factor = c[static_cast<std::size_t>(j)];
            for (int i = 0; i < order; ++i) factor *= j - i;
            sum = sum * s + T(factor);
        }
        // Where x is not a number no piece is the right one.
        return s == s ? sum : s;
    }
    int degree() const { return kind_ == Kind::linear ? 1 : 3; }
    Kind kind() const { return kind_; }
    /// The function of formulas that looks up this kind.
    static constexpr const char* functionName(Kind kind) { return kind == Kind::cubic ? "spline" : "table"; }
    const std::vector<double>& abscissae() const { return x_; }
    std::size_t pieces() const { return bases_.size(); }
    double base(std::size_t piece) const { return bases_[piece]; }
    double coefficient(std::size_t piece, int power) const {
        return coefficients_[piece][static_cast<std::size_t>(power)];
    }
    std::uint64_t hash() const { return hash_; }
    bool operator==(const Interpolant& other) const {
        return kind_ == other.kind_ && x_ == other.x_ && coefficients_ == other.coefficients_;
    }

private:
    template <class T>
    std::size_t piece(const T& x) const {
        std::size_t low = 0, high = x_.size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (x < T(x_[middle]))
                high = middle;
            else
                low = middle + 1;
        }
        return low;
    }

    Kind kind_;
    std::vector<double> x_, bases_;
    std::vector<std::array<double, 4>> coefficients_;
    std::uint64_t hash_ = 0;
};

}  // namespace extremal
