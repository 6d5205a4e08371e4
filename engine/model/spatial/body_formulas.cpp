// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/body_formulas.hpp"

#include <cmath>
#include <limits>

#include "engine/core/text/text.hpp"
#include "engine/model/cartesian/point_formulas.hpp"

namespace extremal::spatial {
namespace {

using cartesian::bracketed;
using cartesian::difference;
using cartesian::product;
using cartesian::sum;
using cartesian::textOf;

const std::array<const char*, 3> letters{"x_", "y_", "z_"};

std::string times(const std::string& a, const std::string& b) { return product(bracketed(a), bracketed(b)); }

/// A number of a vector as long as `size`; what is round-off beside it is 0.
std::string textOfNumber(double x, double size) {
    constexpr double roundOff = 16 * std::numeric_limits<double>::epsilon();
    return std::abs(x) <= roundOff * size ? "0" : formatNumber(x);
}

/// sum_j u_j d_j, of axes or of their rates.
Formulas combined(const BodyElement& body, const Formulas& u,
                  Formulas (*axis)(const BodyElement& body, int j)) {
    Formulas all{"0", "0", "0"};
    for (int j = 0; j < 3; ++j)
        if (u[static_cast<std::size_t>(j)] != "0")
            all = added(all, scaled(u[static_cast<std::size_t>(j)], axis(body, j)));
    return all;
}
Formulas numbersOf(const Place& u, double size) {
    return {textOfNumber(u(0), size), textOfNumber(u(1), size), textOfNumber(u(2), size)};
}
Formulas centreOf(const std::string& name, const char* ending) {
    Formulas all;
    for (std::size_t i = 0; i < 3; ++i) all[i] = letters[i] + name + ending;
    return all;
}

}  // namespace

std::string dot(const Formulas& a, const Formulas& b) {
    std::string all = "0";
    for (std::size_t i = 0; i < 3; ++i) all = sum(all, times(a[i], b[i]));
    return all;
}
Formulas cross(const Formulas& a, const Formulas& b) {
    Formulas all;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        all[i] = difference(times(a[j], b[k]), times(a[k], b[j]));
    }
    return all;
}
Formulas added(const Formulas& a, const Formulas& b) {
    return {sum(a[0], b[0]), sum(a[1], b[1]), sum(a[2], b[2])};
}
Formulas subtracted(const Formulas& a, const Formulas& b) {
    return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
}
Formulas scaled(const std::string& factor, const Formulas& a) {
    return {product(factor, a[0]), product(factor, a[1]), product(factor, a[2])};
}

std::string entryName(const BodyElement& body, int row, int column) {
    return "R" + std::to_string(row + 1) + std::to_string(column + 1) + "_" + body.name;
}

Formulas axisOf(const BodyElement& body, int j) {
    if (body.thinAxis == j) return cross(axisOf(body, (j + 1) % 3), axisOf(body, (j + 2) % 3));
    return {entryName(body, 0, j), entryName(body, 1, j), entryName(body, 2, j)};
}
Formulas axisRateOf(const BodyElement& body, int j) {
    if (body.thinAxis == j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3;
        return added(cross(axisRateOf(body, a), axisOf(body, b)),
                     cross(axisOf(body, a), axisRateOf(body, b)));
    }
    Formulas all = axisOf(body, j);
    for (std::string& name : all) name += "_t";
    return all;
}

Formulas directionOn(const Assembly& assembly, std::optional<std::size_t> body, const Place& direction) {
    if (!body) return numbersOf(direction, direction.norm());
    const BodyElement& b = assembly.bodies[*body];
    return combined(b, numbersOf(b.attitude.transpose() * direction, direction.norm()), axisOf);
}
Formulas placeOn(const Assembly& assembly, std::optional<std::size_t> body, const Place& place) {
    if (!body) return numbersOf(place, place.norm());
    const BodyElement& b = assembly.bodies[*body];
    const Place arm = b.attitude.transpose() * (place - b.at);
    return added(centreOf(b.name, ""), combined(b, numbersOf(arm, place.norm() + b.at.norm()), axisOf));
}

PointFormulas formulasOf(const Assembly& assembly, std::size_t point) {
    const PointElement& p = assembly.points[point];
    const Formulas at{textOf(p.at[0]), textOf(p.at[1]), textOf(p.at[2])};
    if (p.isFixed) return {at, {"0", "0", "0"}};
    if (!p.body) return {centreOf(p.name, ""), centreOf(p.name, "_t")};
    const BodyElement& b = assembly.bodies[*p.body];
    return {added(centreOf(b.name, ""), combined(b, at, axisOf)),
            added(centreOf(b.name, "_t"), combined(b, at, axisRateOf))};
}

}  // namespace extremal::spatial
