// SPDX-License-Identifier: GPL-3.0-or-later
/// A sum over cells of a density at the nodes of a rule, of functions that are linear in two vectors of
/// nodal values:
///
///     S(a, b, t) = sum over cells and nodes q of w_q L(y_q, place_q, t + t_q),
///     y_q = sum over corners n of A_q,n a_n + B_q,n b_n,
/// for y = (u, u_t, u_x, [u_y]) of every component. Two such sums are all that a step needs: of a slab, a and
/// b are the values at its two levels and S is its discrete action; of an instant they are u and u_t and S is
/// the Lagrangian. Functions on equal rectangles, which are linear or constant along each axis
/// (FieldPlace): the factors are the same in all cells.
///
/// a, b, gradients: DensityProblem::size() numbers, component after component.
#pragma once

#include <Eigen/Core>

#include <array>
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
    /// Of an instant whose rule is the trapezoidal one, and of a density with p = m u_t (implicitBecause() is
    /// empty): the masses of all values, which are diagonal. Added.
    void addMass(double* mass) const;
    /// Of the same: f(stiffness, mass) with d2U = -d2L by the values of one cell, and their masses in it,
    /// component after component, corner after corner; cells like the one before are left out. Of values that
    /// are constant along an axis only those of the cell. Masses are positive (else the sign of L is taken to
    /// be the other one). False, without more, where masses have unlike signs or something is not finite.
    using Element = std::function<void(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& mass)>;
    bool forElements(double t, const double* u, const Element& f) const;
    /// d2S by one of both and another: add(i, j, value) for entries of each cell, i of `row`, j of `column`.
    using Add = std::function<void(std::size_t i, std::size_t j, double value)>;
    void addHessian(double t, const double* a, const double* b, By row, By column, const Add& add) const;
    /// Evaluations of the density in one sweep.
    long long evaluations() const;
    const DensityProblem& problem() const { return *problem_; }

private:
    static constexpr int mostKinds = 4, placesOfValues = 4;
    /// Of a, then of b: what a value at a corner adds to y.
    using Factors = double[2][mostCorners][mostKinds];
    /// A node of the rule in a cell.
    struct Node {
        double weight = 0, x = 0, y = 0, t = 0;  ///< x, y: from the corner of the cell
        Factors factor[placesOfValues] = {};     ///< by FieldPlace
    };
    const Factors& factors(const Node& node, std::size_t component) const {
        return node.factor[static_cast<std::size_t>(problem_->place(component))];
    }
    explicit CellSum(std::shared_ptr<const DensityProblem> problem) : problem_(std::move(problem)) {}
    void addNodes(const Rule<double>& space, double weight, double t, double atFirst, double atSecond,
                  double rateOfFirst, double rateOfSecond);
    /// f(node, corners, inputs of the density) at all nodes of all cells.
    template <class F>
    void sweep(double t, const double* a, const double* b, F&& f) const;
    using Corners = std::array<std::size_t, mostCorners>;
    Corners cornersOf(int i, int j) const;
    struct Block;
    /// Adds to the slopes of a block, by a (0) or b (1).
    static void addBlock(const CellSum* sum, int by, Block* block);
    int corners() const { return problem_->isPlane() ? 4 : 2; }

    std::shared_ptr<const DensityProblem> problem_;
    std::vector<Node> nodes_;
    bool isSlab_ = false;
};

}  // namespace extremal
