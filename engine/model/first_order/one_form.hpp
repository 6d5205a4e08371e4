// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion in phase space that is given by a one-form and a Hamiltonian:
///     L = theta(x) . x' - H(x),    Om(x) x' = grad H,    Om_ij = d_i theta_j - d_j theta_i.
///
/// m variables x, an even number. Where half of them, y, have no velocity in L (theta_y = 0), L is
/// P(q, y) . q' - H(q, y) with the others as q: `places` and `free` are the indices of q and y in x, empty
/// where there is no such half, also not after a function's differential is taken off the form. Arrays:
/// theta[i], slopes d theta_i / dx_k at i m + k, curvatures d2 theta_i / dx_k dx_l at (i m + k) m + l; of H
/// gradient[k], Hessian at k m + l.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

#include "engine/model/first_order/first_order.hpp"
#include "engine/model/parts.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/typed/graph.hpp"

namespace extremal::typed {
class NodeTape;
}
namespace extremal {

struct OneForm {
    static constexpr PartInfo part{"one-form", "a one-form on phase space"};

    int variables = 0;                  ///< m
    std::shared_ptr<const void> model;  ///< first argument of the calls below

    /// Any of the last two may be null.
    void (*form)(const void*, const double* x, double* theta, double* slopes, double* curvatures) = nullptr;
    /// Likewise.
    void (*energy)(const void*, const double* x, double* value, double* gradient, double* hessian) = nullptr;
    /// The gradient of canonicalOf() as formulas, where it is known (null else).
    std::shared_ptr<const typed::NodeTape> together;

    std::vector<int> places, free;  ///< q and y
    /// First argument of `form` for theta - d chi, in which y has no velocity; null where theta is so itself.
    std::shared_ptr<const void> gauged;
    bool isAffine = false;  ///< P(q, y) is
    bool hasPlane() const { return !places.empty(); }
    const void* planeModel() const { return gauged ? gauged.get() : model.get(); }
};

/// The equations of a one-form at a state.
class OneFormEquations final : public FirstOrderEquations {
public:
    explicit OneFormEquations(const OneForm& of);

    /// Om(x), entry (i, j).
    const Eigen::MatrixXd& form(const double* x);
    /// x' = Om^{-1} grad H; false where Om is singular.
    bool rate(const double* x, double* dx) override;
    /// d x' / dx, entry (i, k); null where Om is singular.
    const Eigen::MatrixXd* jacobian(const double* x) override;

private:
    OneForm of_;
    Eigen::VectorXd theta_, gradient_, rate_;
    std::vector<double> slopes_, curvatures_;
    Eigen::MatrixXd form_, hessian_, jacobian_;
};

FirstOrder firstOrderOf(const OneForm& of);

/// The Hamiltonian of (q, p), p = P(q, y), of a form with a plane: H(q, Y(q, p)), where Y is found by
/// Newton's method from the place that this thread has been told last. Not a number where it finds none. Of
/// an affine P, as of point vortices, Y is affine too and known at once.
///
/// With F = H - P . V stationary in y and V, d H~/dp = V, d H~/dq = F_q, and the Hessian is the Schur
/// complement of that of F: P_y is inverted, and no formula for Y is needed.
PhaseMechanics canonicalOf(const OneForm& of);
/// Its gradient as formulas, of an affine form of few variables; `energy` adds H to a graph, with these nodes
/// for x. Null for others.
std::shared_ptr<const typed::NodeTape> canonicalTape(
    const OneForm& of,
    const std::function<typed::GraphFunction(typed::Graph& to, const std::vector<int>& variables)>& energy);
/// Where Newton's method begins on this thread, for what canonicalOf() has made: y of a state near by.
void setGuess(const PhaseMechanics& canonical, const double* y);
/// Y(q, p); false where it is not found.
bool freeVariables(const PhaseMechanics& canonical, const double* q, const double* p, double* y);

}  // namespace extremal
