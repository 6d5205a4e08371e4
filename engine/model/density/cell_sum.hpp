// SPDX-License-Identifier: GPL-3.0-or-later
/// A sum over cells of a density at the nodes of a rule, of functions that are linear in two vectors of
/// nodal values:
///
///     S(a, b, t) = sum over cells and nodes q of w_q L(y_q, place_q, t + t_q),
///     y_q = sum over corners n of A_q,n a_n + B_q,n b_n,
/// for y = (u, u_t, u_x, [u_y]) of every component. Two such sums are all that a step needs: of a slab, a and
/// b are the values at its two levels and S is its discrete action; of an instant they are u and u_t and S is
/// the Lagrangian. Hat functions on equal rectangles: the factors are the same in all cells.
///
/// a, b, gradients: DensityProblem::size() numbers, component after component.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/model/density/problem.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

class CellSum {
public:
    /// The Lagrangian of an instant, by a rule along each direction of space.
    static CellSum ofInstant(std::shared_ptr<const DensityProblem> problem, const Rule<double>& space);
    /// The action of a slab of length h, linear in time, by rules of space and time.
    static CellSum ofSlab(std::shared_ptr<const DensityProblem> problem, const Rule<double>& space,
                          const Rule<double>& time, double h);

    enum class By { first, second };  ///< a, b
    static constexpr int mostCorners = 4;

    double value(double t, const double* a, const double* b) const;
    /// sum of w (y . dL/dy - L) over the arguments u_t alone: of an instant the energy.
    double energy(double t, const double* a, const double* b) const;
    /// -sum of w L_{u_t} . u_x, or u_y: the momentum along a direction.
    double momentum(double t, const double* a, const double* b, int direction) const;
    /// dS/da or dS/db, added to `slope`.
    void addGradient(double t, const double* a, const double* b, By by, double* slope) const;
    /// d2S by one of both and another: add(i, j, value) for entries of each cell, i of `row`, j of `column`.
    using Add = std::function<void(std::size_t i, std::size_t j, double value)>;
    void addHessian(double t, const double* a, const double* b, By row, By column, const Add& add) const;
    /// Evaluations of the density in one sweep.
    long long evaluations() const;
    const DensityProblem& problem() const { return *problem_; }

private:
    static constexpr int mostKinds = 4;
    /// A node of the rule in a cell.
    struct Node {
        double weight = 0, x = 0, y = 0, t = 0;  ///< x, y: from the corner of the cell
        double factor[2][mostCorners][mostKinds] = {};
    };
    explicit CellSum(std::shared_ptr<const DensityProblem> problem) : problem_(std::move(problem)) {}
    void addNodes(const Rule<double>& space, double weight, double t, double atFirst, double atSecond,
                  double rateOfFirst, double rateOfSecond);
    /// f(node, corners, inputs of the density) at all nodes of all cells.
    template <class F>
    void sweep(double t, const double* a, const double* b, F&& f) const;
    int corners() const { return problem_->isPlane() ? 4 : 2; }

    std::shared_ptr<const DensityProblem> problem_;
    std::vector<Node> nodes_;
    bool isSlab_ = false;
};

}  // namespace extremal
