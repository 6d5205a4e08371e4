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
    /// An argument: a vector, a column of a matrix, memory. Expressions are copied.
    using Given = const Eigen::Ref<const Vector>&;

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
    /// An upper bound of the row-sum norms of ad_x and its transpose, the largest one of a factor.
    double adNorm(Given x) const;

    Entries identity() const;
    /// exp(hat x), g h, g exp(hat x), and g^-1: entries that are not finite where g has none. What comes last
    /// is the result, and none of the others; where it has its size nothing is allocated.
    void exponential(Given x, Entries& e) const;
    void product(Given g, Given h, Entries& gh) const;
    void moved(Given g, Given x, Entries& end) const;
    void inverse(Given g, Entries& back) const;
    Entries exponential(Given x) const {
        return made([&](Entries& e) { exponential(x, e); });
    }
    Entries product(Given g, Given h) const {
        return made([&](Entries& gh) { product(g, h, gh); });
    }
    Entries inverse(Given g) const {
        return made([&](Entries& back) { inverse(g, back); });
    }
    /// hat(x), a matrix of each factor; g hat(x).
    Entries hat(Given x) const;
    void rate(Given g, Given x, Entries& rate) const;
    /// The coordinates of the part in the algebra of matrices.
    Vector coordinatesOf(const Entries& X) const;
    /// Momenta at g from those in space, mu = Ad_g^T J, and back; `scale`: the sums of absolute values that
    /// the latter are.
    void inBody(Given g, Given J, Vector& m) const;
    void inSpace(Given g, Given m, Vector& J, Vector* scale = nullptr) const;
    Vector inSpace(Given g, Given m, Vector* scale = nullptr) const {
        return made([&](Vector& J) { inSpace(g, m, J, scale); });
    }
    /// xi with exp(hat xi) = g, as GroupFactor finds it.
    void logarithm(Given g, Given near, Vector& xi) const;
    Vector logarithm(Given g, Given near) const {
        return made([&](Vector& xi) { logarithm(g, near, xi); });
    }

    View part(const Factor& f, Given g) const { return View(g.data() + f.entry, f.n, f.n); }

private:
    template <class Make>
    static Vector made(const Make& make) {
        Vector r;
        make(r);
        return r;
    }

    std::vector<Factor> factors_;
    StructureConstants constants_;
    int dimension_ = 0, entries_ = 0;
};

}  // namespace extremal
