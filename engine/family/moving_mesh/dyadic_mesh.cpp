// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/dyadic_mesh.hpp"

#include <algorithm>

namespace extremal {
namespace {

constexpr long long finest = 1LL << 40;  ///< elements of the finest level
constexpr double persistence = 2;

}  // namespace

DyadicMesh::DyadicMesh(double left, double length, std::size_t elements)
    : left_(left), unit_(length / static_cast<double>(finest)), elements_(elements) {
    heap_.reserve(elements + 1);
}

double DyadicMesh::integral(const std::vector<double>& x, const std::vector<double>& M, double upTo) const {
    const auto after = std::upper_bound(x.begin() + 1, x.end() - 1, upTo);
    const auto e = static_cast<std::size_t>(after - x.begin()) - 1;
    return sums_[e] + M[e] * (upTo - x[e]);
}

void DyadicMesh::choose(const std::vector<double>& x, const std::vector<double>& M,
                        std::vector<double>& nodes) {
    sums_.resize(x.size());
    sums_[0] = 0;
    for (std::size_t e = 0; e + 1 < x.size(); ++e) sums_[e + 1] = sums_[e] + M[e] * (x[e + 1] - x[e]);
    const auto add = [&](long long first, long long size) {
        const bool isInUse = std::binary_search(nodes.begin(), nodes.end(), place(first + size / 2));
        const double share = integral(x, M, place(first + size)) - integral(x, M, place(first));
        heap_.push_back({size > 1 ? (isInUse ? persistence : 1) * share : 0, first, size});
        std::push_heap(heap_.begin(), heap_.end());
    };
    heap_.clear();
    add(0, finest);
    while (heap_.size() < elements_) {
        std::pop_heap(heap_.begin(), heap_.end());
        const Element e = heap_.back();
        heap_.pop_back();
        add(e.first, e.size / 2);
        add(e.first + e.size / 2, e.size / 2);
    }
    nodes.resize(elements_ + 1);
    for (std::size_t e = 0; e < elements_; ++e) nodes[e] = place(heap_[e].first);
    nodes.back() = place(finest);
    std::sort(nodes.begin(), nodes.end());
}

}  // namespace extremal
