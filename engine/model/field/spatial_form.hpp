// SPDX-License-Identifier: GPL-3.0-or-later
/// The integrals of a field's Lagrangian over space, by one quadrature rule on each element:
///
///     L_h(u, v) = v^T M v / 2 - U(u),
///     M_ij = sum_e h_e sum_a w_a phi_i phi_j,   U = sum_e h_e sum_a w_a (a phi(u_x) + W(u)) at (e, a),
/// for u that is a polynomial of degree r on each element, or made of functions of its own
/// (element_functions.hpp). What every scheme in time needs of space: M, the
/// force -dU/du, U itself, and its Hessian by elements. Nothing here knows of a boundary: the entries of
/// fixed nodes are those of free ones.
///
/// u, v, force: one number per node (FieldNodes).
#pragma once

#include <memory>
#include <vector>

#include "engine/model/field/problem.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

class SpatialForm {
public:
    SpatialForm(std::shared_ptr<const FieldProblem> problem, const Rule<double>& rule);

    const FieldProblem& problem() const { return *problem_; }
    const std::shared_ptr<const FieldProblem>& shared() const { return problem_; }
    int size() const { return problem_->size(); }
    /// Nodes per element: r + 1.
    int width() const { return width_; }

    double elementSize(int e) const { return size_[static_cast<std::size_t>(e)]; }
    /// M of element e over its length: entry (a, b) at a width() + b.
    const double* elementMass(int e) const {
        return mass_.data() + (hasOwnTables() ? e * width_ * width_ : 0);
    }
    /// M is diagonal: sums of entries are at the nodes of the rule.
    bool isLumped() const { return isLumped_; }
    /// Of a lumped M.
    std::vector<double> lumpedMass() const;
    /// out = M v.
    void applyMass(const double* v, double* out) const;
    double kineticEnergy(const double* v) const;

    /// U(u).
    double energy(const double* u) const;
    /// f -= scale dU/du.
    void addForce(const double* u, double scale, double* f) const;
    /// The Hessian of U by elements: entry (a, b) of element e at (e width() + a) width() + b.
    void hessians(const double* u, double* H) const;
    /// Calls of W' that a force costs.
    long long evaluations() const {
        return static_cast<long long>(problem_->mesh.elements()) * static_cast<long long>(weight_.size());
    }

    /// The largest eigenvalue of an element's stiffness over its mass, over all elements: an upper bound of
    /// the largest of the whole mesh, and attained on uniform meshes by the wave that alternates from element
    /// to element (Irons and Treharne). Infinite where the rule does not see the mass of a mode. `u`: where
    /// the stiffness is taken.
    double largestEigenvalue(const double* u) const;

private:
    template <int A, class Use>
    void sweep(const double* u, Use&& use) const;
    template <int A>
    double energyOf(const double* u) const;
    template <int A>
    void addForceOf(const double* u, double scale, double* f) const;
    template <int A>
    void hessiansOf(const double* u, double* H) const;
    void usePolynomials(const Rule<double>& rule);
    void useFunctions(const ElementFunctions& functions, const Rule<double>& rule);
    int points() const { return static_cast<int>(weight_.size()); }
    bool hasOwnTables() const { return problem_->functions != nullptr; }
    const double* valueOf(int e) const {
        return value_.data() + (hasOwnTables() ? e * points() * width_ : 0);
    }
    const double* slopeOf(int e) const {
        return slope_.data() + (hasOwnTables() ? e * points() * width_ : 0);
    }
    double coefficient(int element, std::size_t q) const {
        return coefficient_.empty() ? 1
                                    : coefficient_[static_cast<std::size_t>(element) * weight_.size() + q];
    }

    std::shared_ptr<const FieldProblem> problem_;
    int width_;
    std::vector<double> weight_;  ///< of the rule, on an element
    /// Of function a at point q: q width + a; of each element its own where it has functions of its own.
    std::vector<double> value_, slope_;
    std::vector<double> size_;         ///< of the elements
    std::vector<double> coefficient_;  ///< at (element, point); empty: 1
    std::vector<double> mass_;
    bool isLumped_ = false;
};

}  // namespace extremal
