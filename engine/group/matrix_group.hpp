// SPDX-License-Identifier: GPL-3.0-or-later
/// A product of matrix groups, each given by a basis of its algebra (group/group_factor.hpp); often of one.
///
/// The structure constants are block diagonal: factors do not see each other, and what is done here is done
/// factor by factor, so that work and room grow with their number and no faster. An element g is the list of
/// the entries of its factors, row by row, factor after factor; coordinates are likewise.
///
///     bracket(x, y) = [x, y] = ad_x y,                    coadjoint(x, m) = ad_x^T m.
///
/// Source: Leok 2004, sec. 3, for which a group is any Lie group.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "engine/group/group_factor.hpp"
#include "engine/group/structure_constants.hpp"

namespace extremal {

class MatrixGroup {
public:
    /// Entries of all factors: the columns of a run.
    static constexpr int maxEntries = 20'000;
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;
    using Entries = Eigen::VectorXd;
    using Factor = GroupFactor;
    using Square = GroupFactor::Square;
    using View = GroupFactor::View;

    /// The basis of a factor, and the pointer to it in messages.
    struct Definition {
        std::string name;
        std::vector<Square> basis;
        std::string pointer;
    };
    /// Throws InvalidScene as GroupFactor does.
    explicit MatrixGroup(const std::vector<Definition>& factors);

    const std::vector<Factor>& factors() const { return factors_; }
    int dimension() const { return dimension_; }
    int entries() const { return entries_; }

    const StructureConstants& constants() const { return constants_; }
    Vector bracket(const Vector& x, const Vector& y) const { return constants_.bracket(x, y); }
    Vector coadjoint(const Vector& x, const Vector& m) const { return constants_.coadjoint(x, m); }
    /// An upper bound of the row-sum norms of ad_x and its transpose.
    double adNorm(const Vector& x) const { return constants_.adNorm(x); }

    Entries identity() const;
    /// exp(hat x), and g h.
    Entries exponential(const Vector& x) const;
    Entries product(const Entries& g, const Entries& h) const;
    /// Throws nothing: entries that are not finite where g has no inverse.
    Entries inverse(const Entries& g) const;
    /// hat(x), a matrix of each factor.
    Entries hat(const Vector& x) const;
    /// The coordinates of the part in the algebra of matrices.
    Vector coordinatesOf(const Entries& X) const;
    /// Momenta at g from those in space, mu = Ad_g^T J, and back; `scale`: the sums of absolute values that
    /// the latter are.
    Vector inBody(const Entries& g, const Vector& J) const;
    Vector inSpace(const Entries& g, const Vector& m, Vector* scale = nullptr) const;
    /// xi with exp(hat xi) = g, as GroupFactor finds it.
    Vector logarithm(const Entries& g, const Vector& near) const;

    View part(const Factor& f, const Entries& g) const { return View(g.data() + f.entry, f.n, f.n); }

private:
    std::vector<Factor> factors_;
    StructureConstants constants_;
    int dimension_ = 0, entries_ = 0;
};

}  // namespace extremal
