// SPDX-License-Identifier: GPL-3.0-or-later
/// What a matrix group leaves invariant, found from its basis alone: how far a matrix is from the group, and
/// the way back.
///
///     forms      E^T K + K E = 0   =>  g^T K g = K           dual forms  E K + K E^T = 0  =>  g K g^T = K
///     commutant  E C = C E         =>  g C = C g             vectors     w^T E = 0 => w^T g = w^T, E w = 0
///     => g w = w trace E = 0                  =>  det g = 1
///
/// The distance is the largest entry of these defects, with the largest entry of each K, C and w being 1. The
/// cure is one Gauss-Newton step g <- g (1 + X), X the least solution of the defects linearised at 1, and
/// contracts quadratically; where there is one form it is the polar step. Round-off moves a product of 10^6
/// exponentials by 1e-13 to 1e-12 off its group, and compensated products do not help: it is that of exp.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/group/matrix_group.hpp"

namespace extremal {

class GroupInvariants {
public:
    explicit GroupInvariants(const MatrixGroup& group);

    double distance(const MatrixGroup::Entries& g) const;
    void cure(MatrixGroup::Entries& g) const;
    /// The dimension of what the invariants define; larger than the group's where it is not closed.
    int dimension() const { return dimension_; }
    /// Whether this factor leaves no more invariant than a form that is a multiple of 1: rotations.
    bool isOrthogonal(std::size_t factor) const { return parts_[factor].isOrthogonal; }

private:
    using Square = MatrixGroup::Square;
    struct Part {
        explicit Part(const MatrixGroup::Factor& f) : factor(f) {}
        MatrixGroup::Factor factor;
        std::vector<Square> forms, duals, commutant;
        std::vector<Eigen::VectorXd> rows, columns;
        bool isSpecial = false;  ///< det g = 1
        bool isOrthogonal = false;
        Eigen::MatrixXd back;  ///< from the defects to -X
    };
    template <class Add>
    static void defects(const Part& part, const Square& g, const Square& inverse, const Add& add);
    static void linearise(Part& part, int& dimension);

    std::vector<Part> parts_;
    int dimension_ = 0;
};

}  // namespace extremal
