/// The sums over the nodes in GalerkinStep: positions, forces, equations and their Jacobian. Included by
/// galerkin_step_build.hpp.
///
/// Few nodes are summed as they come, in plain loops; many (oscillatory tables) through the kernels of
/// small_product.hpp, with the Jacobian block by block.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "engine/integrator/galerkin_step.hpp"

namespace extremal {

/// C += A B for the first `height` rows of A; C has strideC rows in memory.
template <class T, int D>
void GalerkinStep<T, D>::addProduct(const Square& A, int height, const T* B, int columns, T* C,
                                    int strideC) const {
    const auto depth = static_cast<int>(A.cols());
    if constexpr (std::is_same_v<T, double>) {
        if (isRich_)
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
        if (!isRich_) {
            const T *value = functions(k).value.data(), *slope = functions(k).slope.data(),
                    *y = Y_.data() + offset(k);
            T *q = nodeQ_.data() + k * rows(), *v = nodeV_.data() + k * rows();
            for (int i = 0; i < rows(); ++i) {
                T far(0), fast(0);
                for (int a = 0; a < m(k); ++a) {
                    far += value[a * rows() + i] * y[a];
                    fast += slope[a * rows() + i] * y[a];
                }
                q[i] = q0_(k) + far;
                v[i] = fast;
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
void GalerkinStep<T, D>::evaluateForces(const T& t) {
    report_.evaluations += n();
    if (isRich_ && mechanics_.gradients) {
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
        mechanics_.gradient(mechanics_.model.get(), t + node_(i) * h_, placeQ_.data(), placeV_.data(),
                            jetGradient_.data());
        for (int k = 0; k < 2 * d(); ++k) gradient_(i, k) = jetGradient_(k);
    }
}

/// R from L_q, L_v; entry a of a coordinate is the equation of test function a, the last one that of 1 -
/// phi_{m-1}.
template <class T, int D>
void GalerkinStep<T, D>::residual() {
    R_.setZero();
    for (int k = 0; k < d(); ++k) {
        T* const R = R_.data() + offset(k);
        const int last = m(k) - 1;
        T total(0);
        if (!isRich_) {
            const T *value = functions(k).valueAt.data(), *slope = functions(k).slopeAt.data();
            for (int i = 0; i < rows(); ++i, value += last + 1, slope += last + 1) {
                const T q = weight_(i) * gradient_(i, k), v = weight_(i) * gradient_(i, d() + k);
                total += q;
                for (int a = 0; a <= last; ++a) R[a] += value[a] * q + slope[a] * v;
            }
            R[last] = p0_(k) + (total - R[last]);
            continue;
        }
        if constexpr (std::is_same_v<T, double>) {
            // On a fast motion both sums are far larger than what is left of them.
            Wide impulse(0);
            for (int i = 0; i < rows(); ++i) {
                impulse_(i) = weight_(i) * gradient_(i, k);
                thrust_(i) = weight_(i) * gradient_(i, d() + k);
                impulse += Wide(impulse_(i));
            }
            sums_.sumOfTwo({functions(k).valueAt.data(), impulse_.data(), functions(k).slopeAt.data(),
                            thrust_.data(), static_cast<int>(functions(k).valueAt.rows()), m(k), rows(), R});
            R[last] = static_cast<T>(Wide(p0_(k)) + (impulse - Wide(R[last])));
        }
    }
}

/// The Hessians of L at all nodes, and which of their entries matter. Of few nodes the pivots say whether
/// they are finite.
template <class T, int D>
bool GalerkinStep<T, D>::evaluateCurvature(const T& t) {
    const int size = 4 * d() * d();
    report_.evaluations += n();
    if (isRich_ && mechanics_.hessians) {
        times_ = node_ * h_;
        times_.array() += t;
        mechanics_.hessians(mechanics_.model.get(), times_.data(), rows(), nodeQ_.data(), nodeV_.data(),
                            curvature_.data());
    } else {
        T value;
        for (int i = 0; i < n(); ++i) {
            for (int k = 0; k < d(); ++k) {
                placeQ_(k) = nodeQ_(i, k);
                placeV_(k) = nodeV_(i, k);
            }
            mechanics_.jet(mechanics_.model.get(), t + node_(i) * h_, placeQ_.data(), placeV_.data(), &value,
                           jetGradient_.data(), jetHessian_.data());
            for (int j = 0; j < size; ++j) curvature_(i, j) = jetHessian_(j);
        }
    }
    if (isRich_)
        for (int j = 0; j < size; ++j)
            isCurved_[static_cast<std::size_t>(j)] = (curvature_.col(j).array() != T(0)).any();
    return !isRich_ || curvature_.allFinite();
}

/// bent_(i, c) = w_i (L_{x_k q_l} phi_c + L_{x_k v_l} phi_c') for x = q or v.
template <class T, int D>
void GalerkinStep<T, D>::bend(int k, int l, bool isSlope) {
    const int dim = d(), onValue = (isSlope ? dim + k : k) * 2 * dim + l;
    const T* const byValue = curvature_.col(onValue).data();
    const T* const bySlope = curvature_.col(onValue + dim).data();
    const Functions& to = functions(l);
    for (int i = 0; i < rows(); ++i) {
        impulse_(i) = weight_(i) * byValue[i];
        thrust_(i) = weight_(i) * bySlope[i];
    }
    for (int c = 0; c < m(l); ++c) {
        const T* const value = to.value.col(c).data();
        const T* const slope = to.slope.col(c).data();
        T* const bent = bent_.col(c).data();
        if constexpr (std::is_same_v<T, double>) {
            if (isRich_) {
                sums_.combine(impulse_.data(), value, thrust_.data(), slope, bent, rows());
                continue;
            }
        }
        for (int i = 0; i < rows(); ++i) bent[i] = impulse_(i) * value[i] + thrust_(i) * slope[i];
    }
}

/// d R of coordinate k / d Y of coordinate l for k >= l, and its transpose, in the test functions phi_a; the
/// last rows become those of 1 - phi_{m-1}.
template <class T, int D>
void GalerkinStep<T, D>::assembleBlock(int k, int l) {
    const int height = m(k), columns = m(l), dim = d(), stride = static_cast<int>(jacobian_.rows());
    auto block = jacobian_.block(offset(k), offset(l), height, columns);
    const auto isCurved = [&](int i, int j) { return isCurved_[static_cast<std::size_t>(i * 2 * dim + j)]; };
    block.setZero();
    if (isCurved(dim + k, l) || isCurved(dim + k, dim + l)) {
        bend(k, l, true);
        addProduct(functions(k).slopeAt, height, bent_.data(), columns, &block(0, 0), stride);
    }
    const bool hasForce = isCurved(k, l) || isCurved(k, dim + l);
    if (hasForce) {
        bend(k, l, false);
        addProduct(functions(k).valueAt, height, bent_.data(), columns, &block(0, 0), stride);
    }
    if (k != l) {
        auto other = jacobian_.block(offset(l), offset(k), columns, height);
        other = block.transpose();
        other.row(columns - 1) *= T(-1);
    }
    block.row(height - 1) *= T(-1);
    if (hasForce)
        for (int c = 0; c < columns; ++c) block(height - 1, c) += bent_.col(c).sum();
    if (k == l || !(isCurved(l, k) || isCurved(l, dim + k))) return;
    bend(l, k, false);
    for (int c = 0; c < height; ++c) jacobian_(offset(l) + columns - 1, offset(k) + c) += bent_.col(c).sum();
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
            const T byQQ = b * curvature_(i, qq), byQV = b * curvature_(i, qq + dim);
            const T byVQ = b * curvature_(i, vq), byVV = b * curvature_(i, vq + dim);
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
    if (!evaluateCurvature(t)) return false;
    if (isRich_) {
        for (int k = 0; k < d(); ++k)
            for (int l = 0; l <= k; ++l) assembleBlock(k, l);
    } else {
        jacobian_.setZero();
        for (int i = 0; i < n(); ++i) assembleNode(i);
    }
    lu_.compute(jacobian_);
    ++report_.linearSolves;
    using std::abs;
    T smallest = abs(lu_.matrixLU()(0, 0)), largest = smallest;
    for (int k = 1; k < lu_.matrixLU().rows(); ++k) {
        const T pivot = abs(lu_.matrixLU()(k, k));
        if (!(pivot >= smallest)) smallest = pivot;
        if (pivot > largest) largest = pivot;
    }
    return smallest > std::numeric_limits<T>::epsilon() * T(1e-3) * largest;
}

}  // namespace extremal
