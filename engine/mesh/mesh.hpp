// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of an interval: elements between ascending ends, and what holds at the ends of the interval.
///
/// Element e lies between x[e] and x[e + 1], e = 0..N-1. Where the interval is periodic x[N] is the place of
/// x[0]. A graded mesh has a ratio of sizes between its largest and its smallest elements, which a scheme has
/// to deal with: the smallest one sets the largest step of a synchronous scheme.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace extremal {

enum class Boundary {
    periodic,   ///< the ends are the same place
    dirichlet,  ///< the values at the ends stay as they are
    neumann,    ///< nothing acts on the ends
};
constexpr const char* name(Boundary b) {
    return b == Boundary::periodic ? "periodic" : b == Boundary::dirichlet ? "dirichlet" : "neumann";
}
/// "periodic", "dirichlet", "neumann"; anything else is periodic.
Boundary boundaryNamed(std::string_view name);

struct Mesh {
    std::vector<double> x;  ///< ends of the elements, N + 1
    Boundary boundary = Boundary::periodic;

    int elements() const { return static_cast<int>(x.size()) - 1; }
    double size(int e) const { return x[static_cast<std::size_t>(e) + 1] - x[static_cast<std::size_t>(e)]; }
    double left() const { return x.front(); }
    double length() const { return x.back() - x.front(); }
    bool isPeriodic() const { return boundary == Boundary::periodic; }
    /// All elements are of one size, to round-off of the places.
    bool isUniform() const;
    double smallest() const;
};

Mesh uniformMesh(double left, double length, int elements, Boundary boundary);

/// Sizes that grow geometrically from the middle to both ends: L_e = L_min ratio^(|2 e - (N - 1)| / (N - 1)),
/// so that the largest is `ratio` times the smallest.
Mesh gradedMesh(double left, double length, int elements, double ratio, Boundary boundary);

/// Equal elements, but for `notch` of them in the middle, whose size is the `ratio`-th part of the others'.
Mesh notchedMesh(double left, double length, int elements, int notch, double ratio, Boundary boundary);

}  // namespace extremal
