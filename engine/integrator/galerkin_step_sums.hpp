// SPDX-License-Identifier: GPL-3.0-or-later
/// The sums over the nodes in GalerkinStep: positions, forces, equations and their Jacobian. Included by
/// galerkin_step_build.hpp.
///
/// Few nodes are summed as they come, in plain loops; many (oscillatory tables) through the kernels of
/// small_product.hpp, with the Jacobian block by block.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "engine/core/work.hpp"
#include "engine/integrator/galerkin_step.hpp"

namespace extremal {

/// C += A B for the first `height` rows of A; C has strideC rows in memory.
template <class T, int D>
void GalerkinStep<T, D>::addProduct(const Square& A, int height, const T* B, int columns, T* C,
                                    int strideC) const {
    const auto depth = static_cast<int>(A.cols());
    if constexpr (std::is_same_v<T, double>) {
        if (isVectorised_)
            return sums_.product(
                {A.data(), static_cast<int>(A.rows()), B, depth, C, strideC, height, columns, depth});
    }
    for (int c = 0; c < columns; ++c)
        for (int i = 0; i < depth; ++i) {
            const T b = B[c * depth + i];
            const T* const column = A.col(i).data();
            for (int r = 0; r < height; ++r) C[c * strideC + r] += column[r] * b;
        }
}

/// q(c_i) and v(c_i) from Y.
template <class T, int D>
void GalerkinStep<T, D>::placeNodes() {
    for (int k = 0; k < d(); ++k) {
        if (!isVectorised_) {
            const T *value = functions(k).value.data(), *slope = functions(k).slope.data(),
                    *y = Y_.data() + offset(k);
            T *q = nodeQ_.data() + k * rows(), *v = nodeV_.data() + k * rows();
            for (int i = 0; i < rows(); ++i) {
                T position(0), velocity(0);
                for (int a = 0; a < m(k); ++a) {
                    position += value[a * rows() + i] * y[a];
                    velocity += slope[a * rows() + i] * y[a];
                }
                q[i] = q0_(k) + position;
                v[i] = velocity;
            }
            continue;
        }
        nodeQ_.col(k).setConstant(q0_(k));
        nodeV_.col(k).setZero();
        addProduct(functions(k).value, rows(), Y_.data() + offset(k), 1, nodeQ_.col(k).data(), rows());
        addProduct(functions(k).slope, rows(), Y_.data() + offset(k), 1, nodeV_.col(k).data(), rows());
    }
}

/// L_q and L_v at all nodes.
template <class T, int D>
void GalerkinStep<T, D>::evaluateGradients(const T& t) {
    report_.cost.evaluations += n();
    if (isVectorised_ && mechanics_.gradients) {
        times_ = node_ * h_;
        times_.array() += t;
        return mechanics_.gradients(mechanics_.model.get(), times_.data(), rows(), nodeQ_.data(),
                                    nodeV_.data(), gradient_.data());
    }
    for (int i = 0; i < n(); ++i) {
        for (int k = 0; k < d(); ++k) {
            placeQ_(k) = nodeQ_(i, k);
            placeV_(k) = nodeV_(i, k);
        }
        const T time = t + node_(i) * h_;
        if (parts_.empty())
            mechanics_.gradient(mechanics_.model.get(), time, placeQ_.data(), placeV_.data(),
                                jetGradient_.data());
        else
            partAt(i).gradient(partAt(i).model.get(), time, placeQ_.data(), placeV_.data(),
                               jetGradient_.data());
        for (int k = 0; k < 2 * d(); ++k) gradient_(i, k) = jetGradient_(k);
    }
}

/// grad_a = sum_i w_i [ L_q(i) phi_a(c_i) + L_v(i) phi_a'(c_i) ] of coordinate k, the chain rule for a table;
/// returns the same for the function 1, sum_i w_i L_q(i), in the precision in which it was added up.
template <class T, int D>
typename GalerkinStep<T, D>::Accumulator GalerkinStep<T, D>::actionGradient(int k, T* grad) {
    for (int i = 0; i < rows(); ++i) {
        weightedLq_(i) = weight_(i) * gradient_(i, k);
        weightedLv_(i) = weight_(i) * gradient_(i, d() + k);
    }
    if constexpr (std::is_same_v<T, double>) {
        if (isVectorised_) {
            Accumulator impulse(0);
            for (int i = 0; i < rows(); ++i) impulse += Accumulator(weightedLq_(i));
            sums_.sumOfTwo({functions(k).valueAt.data(), weightedLq_.data(), functions(k).slopeAt.data(),
                            weightedLv_.data(), static_cast<int>(functions(k).valueAt.rows()), m(k), rows(),
                            grad});
            return impulse;
        }
    }
    const T *value = functions(k).valueAt.data(), *slope = functions(k).slopeAt.data();
    T impulse(0);
    for (int i = 0; i < rows(); ++i, value += m(k), slope += m(k)) {
        const T q = weightedLq_(i), v = weightedLv_(i);
        impulse += q;
        for (int a = 0; a < m(k); ++a) grad[a] += value[a] * q + slope[a] * v;
    }
    return Accumulator(impulse);
}

/// The Hessians of L at all nodes, and which of their entries matter. Of few nodes the pivots say whether
/// they are finite.
template <class T, int D>
bool GalerkinStep<T, D>::evaluateHessians(const T& t) {
    const int size = 4 * d() * d();
    roomForNewton();
    report_.cost.evaluations += n();
    if (isVectorised_ && mechanics_.hessians) {
        times_ = node_ * h_;
        times_.array() += t;
        mechanics_.hessians(mechanics_.model.get(), times_.data(), rows(), nodeQ_.data(), nodeV_.data(),
                            hessians_.data());
    } else {
        T value;
        for (int i = 0; i < n(); ++i) {
            for (int k = 0; k < d(); ++k) {
                placeQ_(k) = nodeQ_(i, k);
                placeV_(k) = nodeV_(i, k);
            }
            const T time = t + node_(i) * h_;
            if (parts_.empty())
                mechanics_.jet(mechanics_.model.get(), time, placeQ_.data(), placeV_.data(), &value,
                               jetGradient_.data(), jetHessian_.data());
            else
                partAt(i).jet(partAt(i).model.get(), time, placeQ_.data(), placeV_.data(), &value,
                              jetGradient_.data(), jetHessian_.data());
            for (int j = 0; j < size; ++j) hessians_(i, j) = jetHessian_(j);
        }
    }
    if (!isVectorised_) return true;
    for (int i = 0; i < 2 * d(); ++i)
        for (int j = 0; j <= i; ++j) {
            const int entry = i * 2 * d() + j, mirrored = j * 2 * d() + i;
            const T sum = hessians_.col(entry).cwiseAbs().sum();
            if (!(sum <= std::numeric_limits<T>::max())) return false;
            isPresent_[static_cast<std::size_t>(entry)] = isPresent_[static_cast<std::size_t>(mirrored)] =
                sum != T(0);
        }
    return true;
}

/// applied_(i, c) = w_i (L_{x_k q_l} phi_c + L_{x_k v_l} phi_c') for x = q or v.
template <class T, int D>
void GalerkinStep<T, D>::applyHessian(int k, int l, bool isSlope) {
    const int dim = d(), onValue = (isSlope ? dim + k : k) * 2 * dim + l;
    const T* const byValue = hessians_.col(onValue).data();
    const T* const bySlope = hessians_.col(onValue + dim).data();
    const Functions& to = functions(l);
    T *const q = weightedLq_.data(), *const v = weightedLv_.data();
    for (int i = 0; i < rows(); ++i) {
        q[i] = weight_(i) * byValue[i];
        v[i] = weight_(i) * bySlope[i];
    }
    for (int c = 0; c < m(l); ++c) {
        const T* const value = to.value.col(c).data();
        const T* const slope = to.slope.col(c).data();
        T* const applied = applied_.col(c).data();
        if constexpr (std::is_same_v<T, double>) {
            if (isVectorised_) {
                sums_.combine(q, value, v, slope, applied, rows());
                continue;
            }
        }
        for (int i = 0; i < rows(); ++i) applied[i] = q[i] * value[i] + v[i] * slope[i];
    }
}

/// d R of coordinate k / d Y of coordinate l for k >= l, and its transpose, in the test functions phi_a; the
/// last rows become those of 1 - phi_{m-1}.
template <class T, int D>
void GalerkinStep<T, D>::assembleBlock(int k, int l) {
    const int height = m(k), columns = m(l), dim = d(), stride = static_cast<int>(jacobian_.rows());
    auto block = jacobian_.block(offset(k), offset(l), height, columns);
    const auto isPresent = [&](int i, int j) {
        return isPresent_[static_cast<std::size_t>(i * 2 * dim + j)];
    };
    block.setZero();
    if (isPresent(dim + k, l) || isPresent(dim + k, dim + l)) {
        applyHessian(k, l, true);
        addProduct(functions(k).slopeAt, height, applied_.data(), columns, &block(0, 0), stride);
    }
    const bool hasForce = isPresent(k, l) || isPresent(k, dim + l);
    if (hasForce) {
        applyHessian(k, l, false);
        addProduct(functions(k).valueAt, height, applied_.data(), columns, &block(0, 0), stride);
    }
    if (k != l) {
        auto other = jacobian_.block(offset(l), offset(k), columns, height);
        other = block.transpose();
        other.row(columns - 1) *= T(-1);
    }
    block.row(height - 1) *= T(-1);
    if (hasForce)
        for (int c = 0; c < columns; ++c) block(height - 1, c) += applied_.col(c).sum();
    if (k == l || !(isPresent(l, k) || isPresent(l, dim + k))) return;
    applyHessian(l, k, false);
    for (int c = 0; c < height; ++c)
        jacobian_(offset(l) + columns - 1, offset(k) + c) += applied_.col(c).sum();
}

/// What one node adds to dR/dY: few nodes and functions are summed as they come.
template <class T, int D>
void GalerkinStep<T, D>::assembleNode(int i) {
    const int dim = d(), all = static_cast<int>(jacobian_.rows());
    const T b = weight_(i);
    for (int k = 0; k < dim; ++k) {
        const int last = m(k) - 1;
        const T* const value = functions(k).valueAt.data() + i * (last + 1);
        const T* const slope = functions(k).slopeAt.data() + i * (last + 1);
        for (int l = 0; l < dim; ++l) {
            const int qq = k * 2 * dim + l, vq = (dim + k) * 2 * dim + l;
            const T byQQ = b * hessians_(i, qq), byQV = b * hessians_(i, qq + dim);
            const T byVQ = b * hessians_(i, vq), byVV = b * hessians_(i, vq + dim);
            const T* const to = functions(l).valueAt.data() + i * m(l);
            const T* const toSlope = functions(l).slopeAt.data() + i * m(l);
            for (int c = 0; c < m(l); ++c) {
                const T onValue = byQQ * to[c] + byQV * toSlope[c],
                        onSlope = byVQ * to[c] + byVV * toSlope[c];
                T* const column = jacobian_.data() + (offset(l) + c) * all + offset(k);
                for (int a = 0; a < last; ++a) column[a] += value[a] * onValue + slope[a] * onSlope;
                column[last] += onValue - (value[last] * onValue + slope[last] * onSlope);
            }
        }
    }
}

/// dR/dY at the present Y and its factorisation.
template <class T, int D>
bool GalerkinStep<T, D>::assembleJacobian(const T& t) {
    return sparse_ ? assembleSparse(t) : evaluateHessians(t) && factoriseJacobian();
}

template <class T, int D>
bool GalerkinStep<T, D>::assembleSparse(const T& t) {
    if constexpr (std::is_same_v<T, double>) {
        report_.cost.evaluations += n();
        ++report_.cost.linearSolves;
        work::spend(sparse_->work());
        for (int i = 0; i < n(); ++i) {
            placeQ_ = nodeQ_.row(i).transpose();
            placeV_ = nodeV_.row(i).transpose();
            sparse_->evaluate(i, t + node_(i) * h_, placeQ_.data(), placeV_.data());
        }
        const auto functionsOf = [&](int k) {
            return SparseJacobian::Functions{functions(k).value.data(), functions(k).slope.data()};
        };
        if (sparse_->factorise(weight_.data(), functionsOf) == Outcome::converged &&
            isRegular(T(sparse_->pivotRatio()), T(1)))
            return true;
    }
    // Pivots from all rows, not from those of a block alone, tell what is singular.
    sparse_.reset();
    return evaluateHessians(t) && factoriseJacobian();
}

/// dR/dY with the Hessians at hand.
template <class T, int D>
bool GalerkinStep<T, D>::factoriseJacobian() {
    // Seconds and more from some thousand unknowns on: the trial of a step, when a scene is read, is bounded.
    if (const auto size = static_cast<double>(jacobian_.rows()); size > 256)
        work::spend(size * size * (size / 3 + n()));
    if (isVectorised_) {
        for (int k = 0; k < d(); ++k)
            for (int l = 0; l <= k; ++l) assembleBlock(k, l);
    } else {
        jacobian_.setZero();
        for (int i = 0; i < n(); ++i) assembleNode(i);
    }
    lu_.compute(jacobian_);
    ++report_.cost.linearSolves;
    using std::abs;
    T smallest = abs(lu_.matrixLU()(0, 0)), largest = smallest;
    for (int k = 1; k < lu_.matrixLU().rows(); ++k) {
        const T pivot = abs(lu_.matrixLU()(k, k));
        if (!(pivot >= smallest)) smallest = pivot;
        if (pivot > largest) largest = pivot;
    }
    if (isRegular(smallest, largest)) return true;
    // Masses of very different sizes: each pivot against its own equation.
    T least(1);
    const auto& order = lu_.permutationP().indices();
    for (int row = 0; row < jacobian_.rows(); ++row) {
        const T size = jacobian_.row(row).cwiseAbs().maxCoeff(),
                pivot = abs(lu_.matrixLU()(order(row), order(row)));
        if (!(pivot >= least * size)) least = pivot / size;
    }
    return isRegular(least, T(1));
}

}  // namespace extremal
