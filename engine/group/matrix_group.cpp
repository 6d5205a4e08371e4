// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/matrix_group.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"

namespace extremal {
namespace {

using Square = MatrixGroup::Square;

Square inverseOf(const MatrixGroup::View& g) { return Eigen::PartialPivLU<Square>(Square(g)).inverse(); }

}  // namespace

MatrixGroup::MatrixGroup(const std::vector<Definition>& factors) {
    for (const Definition& each : factors) {
        Factor f(each.name, each.basis, each.pointer);
        f.entry = entries_;
        f.coordinate = dimension_;
        dimension_ += f.d;
        entries_ += f.n * f.n;
        factors_.push_back(std::move(f));
    }
    if (entries_ > maxEntries)
        throw InvalidScene(
            "/group",
            "has " + std::to_string(entries_) + " entries; the limit is " + std::to_string(maxEntries),
            "fewer factors, or smaller ones");
    constants_ = StructureConstants(dimension_);
    for (const Factor& f : factors_)
        for (const StructureConstants::Bracket& b : f.constants.brackets())
            constants_.add({f.coordinate + b.i, f.coordinate + b.j, f.coordinate + b.k, b.value});
}

MatrixGroup::Entries MatrixGroup::identity() const {
    Entries g(entries_);
    for (const Factor& f : factors_) Eigen::Map<Square>(g.data() + f.entry, f.n, f.n).setIdentity();
    return g;
}
double MatrixGroup::adNorm(Given x) const {
    double largest = 0;
    for (const Factor& f : factors_) {
        const double own = f.constants.adNorm(Factor::Vector(x.segment(f.coordinate, f.d)));
        largest = std::isnan(own) ? own : std::max(largest, own);
        if (std::isnan(largest)) break;
    }
    return largest;
}
MatrixGroup::Entries MatrixGroup::hat(Given x) const {
    Entries X(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(X.data() + f.entry, f.n, f.n) = f.hat(x.segment(f.coordinate, f.d));
    return X;
}
void MatrixGroup::rate(Given g, Given x, Entries& rate) const {
    rate.resize(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(rate.data() + f.entry, f.n, f.n) =
            part(f, g).lazyProduct(f.hat(x.segment(f.coordinate, f.d)));
}
void MatrixGroup::exponential(Given x, Entries& e) const {
    e.resize(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(e.data() + f.entry, f.n, f.n) = f.exponential(x.segment(f.coordinate, f.d));
}
void MatrixGroup::product(Given g, Given h, Entries& gh) const {
    gh.resize(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(gh.data() + f.entry, f.n, f.n) = part(f, g).lazyProduct(part(f, h));
}
void MatrixGroup::moved(Given g, Given x, Entries& end) const {
    end.resize(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(end.data() + f.entry, f.n, f.n) =
            part(f, g).lazyProduct(f.exponential(x.segment(f.coordinate, f.d)));
}
void MatrixGroup::inverse(Given g, Entries& back) const {
    back.resize(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(back.data() + f.entry, f.n, f.n) = inverseOf(part(f, g));
}
MatrixGroup::Vector MatrixGroup::coordinatesOf(const Entries& X) const {
    Vector x(dimension_);
    for (const Factor& f : factors_) x.segment(f.coordinate, f.d) = f.coordinatesOf(part(f, X));
    return x;
}
void MatrixGroup::inBody(Given g, Given J, Vector& m) const {
    m.resize(dimension_);
    for (const Factor& f : factors_)
        m.segment(f.coordinate, f.d) = f.adjoint(part(f, g), inverseOf(part(f, g)))
                                           .transpose()
                                           .lazyProduct(J.segment(f.coordinate, f.d));
}
void MatrixGroup::inSpace(Given g, Given m, Vector& J, Vector* scale) const {
    J.resize(dimension_);
    if (scale) scale->resize(dimension_);
    for (const Factor& f : factors_) {
        const auto own = m.segment(f.coordinate, f.d);
        const auto back = f.adjoint(inverseOf(part(f, g)), part(f, g));
        J.segment(f.coordinate, f.d) = back.transpose().lazyProduct(own);
        if (scale)
            scale->segment(f.coordinate, f.d) = back.cwiseAbs().transpose().lazyProduct(own.cwiseAbs());
    }
}
void MatrixGroup::logarithm(Given g, Given near, Vector& xi) const {
    xi.resize(dimension_);
    for (const Factor& f : factors_)
        xi.segment(f.coordinate, f.d) = f.logarithm(part(f, g), near.segment(f.coordinate, f.d));
}

}  // namespace extremal
