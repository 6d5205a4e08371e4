/// The discrete action of one element and its derivatives, as a function of its two end positions and its
/// interior:
///     S(Z) = h sum_i b_i L(t_0 + c_i h, q(c_i), q'(c_i) / h),    q = psi q_0 + sum_a phi_a Y_a + phi q_1,
/// Z = (q_0, Y_0, ..., Y_{m-2}, q_1) from the functions of a table (action/table.hpp): psi has the traces (1,
/// 0), phi the traces (0, 1), the others vanish at both ends. Entry (k, b) of Z, d x (m + 1), is coordinate k
/// of function b, and the gradient and Hessian are ordered as Z column by column. Nothing is solved here; see
/// solve/discrete_lagrangian.hpp.
///
/// T: double or quadruple precision. Source: Leok 2004, sec. 2.1, with s + 1 control points (the text numbers
/// s).
#pragma once

#include <Eigen/Core>

#include "engine/action/table.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

template <class T>
class ElementAction {
public:
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    ElementAction(Mechanics<T> mechanics, Table<T> table);

    int dimension() const { return mechanics_.dimension; }
    int functions() const { return table_.unknowns() + 1; }
    int interior() const { return functions() - 2; }
    const Mechanics<T>& mechanics() const { return mechanics_; }
    const Table<T>& table() const { return table_; }

    /// S and, where asked for, its gradient and Hessian. False where they are not finite.
    bool evaluate(const T& t0, const T& h, const Matrix& Z, T& S, Vector* gradient, Matrix* hessian) const;

private:
    Mechanics<T> mechanics_;
    Table<T> table_;
};

}  // namespace extremal
