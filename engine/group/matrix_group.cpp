// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/matrix_group.hpp"

#include <Eigen/LU>

#include <algorithm>

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
MatrixGroup::Entries MatrixGroup::hat(const Vector& x) const {
    Entries X(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(X.data() + f.entry, f.n, f.n) = f.hat(x.segment(f.coordinate, f.d));
    return X;
}
MatrixGroup::Entries MatrixGroup::exponential(const Vector& x) const {
    Entries g(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(g.data() + f.entry, f.n, f.n) = f.exponential(x.segment(f.coordinate, f.d));
    return g;
}
MatrixGroup::Entries MatrixGroup::product(const Entries& g, const Entries& h) const {
    Entries r(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(r.data() + f.entry, f.n, f.n) = part(f, g).lazyProduct(part(f, h));
    return r;
}
MatrixGroup::Entries MatrixGroup::inverse(const Entries& g) const {
    Entries r(entries_);
    for (const Factor& f : factors_) Eigen::Map<Square>(r.data() + f.entry, f.n, f.n) = inverseOf(part(f, g));
    return r;
}
MatrixGroup::Vector MatrixGroup::coordinatesOf(const Entries& X) const {
    Vector x(dimension_);
    for (const Factor& f : factors_) x.segment(f.coordinate, f.d) = f.coordinatesOf(part(f, X));
    return x;
}
MatrixGroup::Vector MatrixGroup::inBody(const Entries& g, const Vector& J) const {
    Vector m(dimension_);
    for (const Factor& f : factors_)
        m.segment(f.coordinate, f.d) = f.adjoint(part(f, g), inverseOf(part(f, g)))
                                           .transpose()
                                           .lazyProduct(J.segment(f.coordinate, f.d));
    return m;
}
MatrixGroup::Vector MatrixGroup::inSpace(const Entries& g, const Vector& m, Vector* scale) const {
    Vector J(dimension_);
    if (scale) scale->resize(dimension_);
    for (const Factor& f : factors_) {
        const auto own = m.segment(f.coordinate, f.d);
        const auto back = f.adjoint(inverseOf(part(f, g)), part(f, g));
        J.segment(f.coordinate, f.d) = back.transpose().lazyProduct(own);
        if (scale)
            scale->segment(f.coordinate, f.d) = back.cwiseAbs().transpose().lazyProduct(own.cwiseAbs());
    }
    return J;
}
MatrixGroup::Vector MatrixGroup::logarithm(const Entries& g, const Vector& near) const {
    Vector xi(dimension_);
    for (const Factor& f : factors_)
        xi.segment(f.coordinate, f.d) = f.logarithm(part(f, g), near.segment(f.coordinate, f.d));
    return xi;
}

}  // namespace extremal
