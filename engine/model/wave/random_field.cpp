// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/random_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

namespace extremal::wave {
namespace {

/// The generator "splitmix64" of Steele, Lea and Flood (2014): whole numbers alone, so the same everywhere.
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    /// Uniform in [0, 1).
    double uniform() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    /// Nearly normal, by sums of twelve: no logarithm whose last bit differs from library to library.
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += uniform();
        return sum;
    }

private:
    std::uint64_t state_;
};

using Number = std::complex<double>;

struct Wave {
    double k, cosine, sine;
};

std::function<double(double, double, double)> fieldOnInterval(const Domain& domain,
                                                              const RandomField& field) {
    SplitMix random(static_cast<std::uint64_t>(field.seed));
    std::vector<Wave> waves;
    double variance = 0;
    for (int a = 1; a <= 4096; ++a) {
        const double k = 2 * std::numbers::pi * a / domain.length,
                     weight = std::exp(-k * k * field.correlation * field.correlation / 4);
        if (weight < 1e-17) break;
        const double cosine = random.normal(), sine = random.normal();
        waves.push_back({k, weight * cosine, weight * sine});
        variance += weight * weight;
    }
    const double scale = variance > 0 ? field.amplitude / std::sqrt(variance) : 0;
    for (Wave& w : waves) {
        w.cosine *= scale;
        w.sine *= scale;
    }
    return [waves, left = domain.left](double x, double, double) {
        double sum = 0;
        for (const Wave& w : waves)
            sum += w.cosine * std::cos(w.k * (x - left)) + w.sine * std::sin(w.k * (x - left));
        return sum;
    };
}

/// Rows b = 0, 1, .. of coefficients for a = -reach .. reach: the field is the real part of
/// sum_b e^{i l_b y} sum_a z_ab e^{i k_a x}.
struct Plane {
    Grid grid;
    int reach = 0;
    std::vector<std::vector<Number>> rows;

    /// The sums over a at one x, for each b.
    std::vector<Number> columnAt(double x) const {
        const Number stepX = std::polar(1.0, 2 * std::numbers::pi * (x - grid.x.left) / grid.x.length),
                     first =
                         std::polar(1.0, -2 * std::numbers::pi * reach * (x - grid.x.left) / grid.x.length);
        std::vector<Number> column;
        column.reserve(rows.size());
        for (const auto& row : rows) {
            // Horner's rule, from the highest a down.
            double re = 0, im = 0;
            for (std::size_t i = row.size(); i-- > 0;) {
                const double r = re * stepX.real() - im * stepX.imag() + row[i].real();
                im = re * stepX.imag() + im * stepX.real() + row[i].imag();
                re = r;
            }
            column.push_back(Number(re, im) * first);
        }
        return column;
    }

    double sumAlong(const std::vector<Number>& column, double y) const {
        const Number stepY = std::polar(1.0, 2 * std::numbers::pi * (y - grid.y.left) / grid.y.length);
        double sum = 0;
        Number turnY = 1;
        for (const Number& z : column) {
            sum += (z * turnY).real();
            turnY *= stepY;
        }
        return sum;
    }
};

/// The columns of a plane that were asked for: on the nodes of a rectangle there are far fewer of them than
/// nodes, and each is the larger part of the work. Any thread may ask.
class Columns {
public:
    explicit Columns(Plane plane) : plane_(std::move(plane)) {}
    double at(double x, double y) { return plane_.sumAlong(*columnAt(x), y); }

private:
    using Column = std::shared_ptr<const std::vector<Number>>;
    static constexpr std::size_t most = 1024;

    Column columnAt(double x) {
        const std::lock_guard lock(mutex_);
        if (const auto known = known_.find(x); known != known_.end()) return known->second;
        if (known_.size() >= most) known_.clear();
        return known_[x] = std::make_shared<const std::vector<Number>>(plane_.columnAt(x));
    }

    Plane plane_;
    std::mutex mutex_;
    std::unordered_map<double, Column> known_;
};

std::function<double(double, double, double)> fieldOnRectangle(const Grid& grid, const RandomField& field) {
    // Weights below 1e-12 do not count: the terms are many.
    const double l = field.correlation, furthest = std::sqrt(4 * std::log(1e12)) / l,
                 turn = 2 * std::numbers::pi;
    const auto reachOf = [&](const Domain& d) {
        return static_cast<int>(std::min(256.0, std::floor(furthest * d.length / turn)));
    };
    Plane plane{grid, reachOf(grid.x), {}};
    SplitMix random(static_cast<std::uint64_t>(field.seed));
    double variance = 0;
    for (int b = 0; b <= reachOf(grid.y); ++b) {
        auto& row = plane.rows.emplace_back();
        for (int a = -plane.reach; a <= plane.reach; ++a) {
            const double cosine = random.normal(), sine = random.normal();
            const double k = turn * a / grid.x.length, m = turn * b / grid.y.length;
            // Of opposite wave numbers one counts, and the mean is not a part of the field.
            const double weight = b > 0 || a > 0 ? std::exp(-(k * k + m * m) * l * l / 4) : 0;
            row.push_back(weight * Number(cosine, -sine));
            variance += weight * weight;
        }
    }
    const double scale = variance > 0 ? field.amplitude / std::sqrt(variance) : 0;
    for (auto& row : plane.rows)
        for (Number& z : row) z *= scale;
    return [columns = std::make_shared<Columns>(std::move(plane))](double x, double y, double) {
        return columns->at(x, y);
    };
}

}  // namespace

std::function<double(double x, double y, double t)> randomField(const Grid& grid, const RandomField& field) {
    return grid.dimension() == 2 ? fieldOnRectangle(grid, field) : fieldOnInterval(grid.x, field);
}

}  // namespace extremal::wave
