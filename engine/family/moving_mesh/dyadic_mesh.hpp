// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of a hierarchy of hat functions: elements are halves of halves of the domain, and as many at all
/// times.
///
/// From the whole domain the element with the largest share of a density is halved until there are enough. A
/// halving that is in use counts twice, so that the mesh does not change for little.
#pragma once

#include <cstddef>
#include <vector>

namespace extremal {

class DyadicMesh {
public:
    DyadicMesh(double left, double length, std::size_t elements);

    /// For a density M[e], constant on the elements of the mesh x. nodes: those in use, and then the new
    /// ones.
    void choose(const std::vector<double>& x, const std::vector<double>& M, std::vector<double>& nodes);

private:
    /// In units of the finest level.
    struct Element {
        double priority;
        long long first, size;
        bool operator<(const Element& other) const { return priority < other.priority; }
    };
    double place(long long k) const { return left_ + unit_ * static_cast<double>(k); }
    double integral(const std::vector<double>& x, const std::vector<double>& M, double upTo) const;

    double left_, unit_;
    std::size_t elements_;
    std::vector<double> sums_;
    std::vector<Element> heap_;
};

}  // namespace extremal
