// SPDX-License-Identifier: GPL-3.0-or-later
/// The element kernel: the discrete action of one element and its derivatives by the unknowns and by the
/// step,
///     S(h, z) = h sum_i b_i L(t_0 + c_i h, q(c_i), q'(c_i) / h),    q = sum_a phi_a z_a,
/// with the functions of a table in one of three parametrisations:
///   * ends: z = (q_0, Y_0, ..., Y_{m-2}, q_1), q = psi q_0 + sum_a phi_a Y_a + phi_{m-1} q_1
///   (action/table.hpp):
///     psi has the traces (1, 0), phi_{m-1} the traces (0, 1), the others vanish at both ends. Then
///         p_0 + dS/dq_0 = 0,    dS/dY_a = 0,    p_1 = dS/dq_1
///     are the step, and E_d = -dS/dh is its discrete energy;
///   * increments: z = (q_0, Y_0, ..., Y_{m-1}), q = q_0 + sum_a phi_a Y_a, q_1 = q_0 + Y_{m-1}: the same
///   element
///     in small numbers, for steps. Then dS/dY_a = 0 for a < m - 1, p_0 + dS/dq_0 - dS/dY_{m-1} = 0 and
///     p_1 = p_0 + dS/dq_0, as dS/dq_0 = h sum_i b_i L_q is the impulse;
///   * space: z are the coefficients in the basis of the space, as in the KKT system with its multipliers.
/// Derivatives by h are at fixed z (dq/dh = 0, dv/dh = -v/h):
///     dS/dh     = sum_i b_i [ L - L_v . v ],                d2S/dh2 = sum_i b_i (v . L_vv v) / h,
///     d2S/dz dh = sum_i b_i [ phi_a (L_q - L_qv v) - phi_a' L_vv v / h ].
/// They are known where L does not depend on time and the functions do not change with the step
/// (hasStepDerivatives()); else they are not numbers.
///
/// Nothing is solved here; see solve/discrete_lagrangian.hpp and solve/multipliers.hpp. Hot loops have sums
/// of their own (integrator/galerkin_step.hpp), which tests hold against this. Order of z: with one table for
/// all coordinates function by function, entry a d + k; with a table for each coordinate by coordinate. T:
/// double or quadruple precision. Source: Leok 2004, sec. 2.1, with s + 1 control points (the text numbers
/// s); 5 for the discrete energy.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/action/table.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

enum class ElementBasis { ends, increments, space };

enum class DerivativeOrder { none, first, second };

template <class T>
struct ElementDerivatives {
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    T action{};             ///< S
    Vector gradient;        ///< dS/dz
    T byStep{};             ///< dS/dh: minus the discrete energy
    Matrix hessian;         ///< d2S/dz2
    Vector gradientByStep;  ///< d2S/dz dh
    T byStepTwice{};        ///< d2S/dh2

    /// What the Lagrangian says at a node: room, so that a second evaluation into the same result allocates
    /// nothing.
    struct Node {
        T L{};
        Vector q, v, gradient, qv, vv;  ///< qv, vv: L_qv v and L_vv v
        Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> hessian;
        void resize(int d);
    };
    Node node;
};

template <class T>
class ElementKernel {
public:
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

    /// One table for all coordinates, or one for each; these share nodes and weights.
    ElementKernel(Mechanics<T> mechanics, const std::vector<Table<T>>& tables,
                  ElementBasis basis = ElementBasis::ends);
    ElementKernel(Mechanics<T> mechanics, const Table<T>& table, ElementBasis basis = ElementBasis::ends)
        : ElementKernel(std::move(mechanics), std::vector<Table<T>>{table}, basis) {}

    int dimension() const { return mechanics_.dimension; }
    int size() const { return size_; }
    /// Number of functions of a coordinate, and the place of its function a in z.
    int functions(int k = 0) const { return static_cast<int>(of(k).value.cols()); }
    int index(int k, int a) const { return functions_.size() == 1 ? a * dimension() + k : offset(k) + a; }
    bool hasStepDerivatives() const { return hasStepDerivatives_; }

    /// S and its derivatives up to the given order. False where they are not finite.
    bool evaluate(const T& t0, const T& h, const Vector& z, DerivativeOrder order,
                  ElementDerivatives<T>& result) const;

private:
    struct Functions {
        Matrix value, slope;  ///< (i, a): phi_a(c_i), phi_a'(c_i) by tau
    };
    const Functions& of(int k) const {
        return functions_.size() == 1 ? functions_.front() : functions_[static_cast<std::size_t>(k)];
    }
    int offset(int k) const { return offset_[static_cast<std::size_t>(k)]; }
    static Functions sample(const Table<T>& table, ElementBasis basis);
    void addFirst(int i, const T& h, ElementDerivatives<T>& to) const;
    void addSecond(int i, const T& h, ElementDerivatives<T>& to) const;

    Mechanics<T> mechanics_;
    Vector node_, weight_;
    std::vector<Functions> functions_;
    std::vector<int> offset_;
    int size_ = 0;
    bool hasStepDerivatives_ = true;
};

}  // namespace extremal
