// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {
namespace {

/// Elements of these sizes, scaled to fill the interval. The last end is exact.
Mesh fromSizes(double left, double length, const std::vector<double>& sizes, Boundary boundary) {
    double sum = 0;
    for (const double size : sizes) sum += size;
    Mesh mesh;
    mesh.boundary = boundary;
    mesh.x.push_back(left);
    double done = 0;
    for (const double size : sizes) {
        done += size;
        mesh.x.push_back(left + length * (done / sum));
    }
    mesh.x.back() = left + length;
    return mesh;
}

}  // namespace

Boundary boundaryNamed(std::string_view name) {
    return name == "dirichlet" ? Boundary::dirichlet
           : name == "neumann" ? Boundary::neumann
                               : Boundary::periodic;
}

bool Mesh::isUniform() const {
    const double h = length() / elements();
    const double roundOff =
        8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(x.front()), std::abs(x.back()));
    for (int e = 0; e < elements(); ++e)
        if (std::abs(size(e) - h) > roundOff) return false;
    return true;
}

double Mesh::smallest() const {
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < elements(); ++e) least = std::min(least, size(e));
    return least;
}

Mesh uniformMesh(double left, double length, int elements, Boundary boundary) {
    Mesh mesh;
    mesh.boundary = boundary;
    mesh.x.resize(static_cast<std::size_t>(elements) + 1);
    for (int e = 0; e <= elements; ++e)
        mesh.x[static_cast<std::size_t>(e)] = left + length * (static_cast<double>(e) / elements);
    return mesh;
}

Mesh gradedMesh(double left, double length, int elements, double ratio, Boundary boundary) {
    std::vector<double> sizes;
    for (int e = 0; e < elements; ++e)
        sizes.push_back(elements == 1 ? 1
                                      : std::pow(ratio, std::abs(2.0 * e - (elements - 1)) / (elements - 1)));
    return fromSizes(left, length, sizes, boundary);
}

Mesh notchedMesh(double left, double length, int elements, int notch, double ratio, Boundary boundary) {
    std::vector<double> sizes(static_cast<std::size_t>(elements), 1);
    const int first = (elements - notch) / 2;
    for (int e = first; e < first + notch; ++e) sizes[static_cast<std::size_t>(e)] = 1 / ratio;
    return fromSizes(left, length, sizes, boundary);
}

}  // namespace extremal
