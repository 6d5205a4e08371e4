// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/phase_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/registers.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {
namespace {

struct Changes {
    int rows, columns;
    const double *now, *before;
    double *moved, *size;  ///< by column: the largest difference, and the largest of both; in eights
    double* defect;        ///< 0 where all differences are finite, else not a number
};

using namespace registers;

/// most = max(most, |v|), which a NaN escapes.
template <class Pack>
inline void raise(Pack& most, const Pack& v) {
    const auto size = reinterpret_cast<Pack>(reinterpret_cast<const Mask<Pack>&>(v) &
                                             std::numeric_limits<long long>::max());
    most = size > most ? size : most;
}

/// to_k = the largest entry of packs[k], as many as a pack has entries: those of two at a time are halved.
template <class Pack>
inline void largestOfEach(Pack* packs, double* to) {
    constexpr int width = lanesOf<Pack>;
    Mask<Pack> even, odd;
    for (int k = 0; k < width; ++k) even[k] = 2 * k, odd[k] = 2 * k + 1;
    for (int n = width / 2; n > 0; n /= 2)
        for (int k = 0; k < n; ++k) {
            const Pack one = __builtin_shuffle(packs[2 * k], packs[2 * k + 1], even),
                       other = __builtin_shuffle(packs[2 * k], packs[2 * k + 1], odd);
            packs[k] = other > one ? other : one;
        }
    store(to, packs[0]);
}

template <class Pack>
inline void changesOf(const Changes& c) {
    constexpr int width = lanesOf<Pack>;
    Pack defect{};
    for (int first = 0; first < c.columns; first += width) {
        Pack moved[width], size[width];
        for (int k = 0; k < width; ++k) {
            const double *now = c.now + (first + k) * c.rows, *before = c.before + (first + k) * c.rows;
            const int rows = first + k < c.columns ? c.rows : 0;
            Pack most{}, largest{};
            for (int i = 0; i < rows; i += width) {
                Pack a, b;
                load(a, now + i);
                load(b, before + i);
                const Pack difference = a - b;
                defect += difference - difference;
                raise(most, difference);
                raise(largest, a);
                raise(largest, b);
            }
            moved[k] = most;
            size[k] = largest;
        }
        largestOfEach(moved, c.moved + first);
        largestOfEach(size, c.size + first);
    }
    *c.defect = 0;
    for (int k = 0; k < width; ++k) *c.defect += defect[k];
}

/// factor of, with the last row repeated.
void fill(Eigen::MatrixXd& to, double factor, const Eigen::MatrixXd& of) {
    const Eigen::Index n = of.rows();
    for (Eigen::Index j = 0; j < of.cols(); ++j) {
        to.col(j).head(n) = factor * of.col(j);
        to.col(j).tail(to.rows() - n).setConstant(to(n - 1, j));
    }
}
/// v_i, and beyond the end the last one.
double entry(const Eigen::VectorXd& v, Eigen::Index i) { return v(std::min(i, v.size() - 1)); }

}  // namespace

PhaseLanes::PhaseLanes(const PhaseMechanics& mechanics, const SharedCell& cell)
    : H_(mechanics), cell_(cell), sums_(nodeSums()) {
    const Eigen::Index rows = inWholeLanes(cell->nodes()), columns = 2 * d(), eights = inWholeLanes(columns);
    A_ = B_ = Matrix::Zero(rows, cell->nodes());
    fromStart_.resize(rows);
    for (Eigen::Index i = 0; i < rows; ++i) fromStart_(i) = entry(cell->fromStart, i);
    times_ = Eigen::VectorXd::Zero(rows);
    places_ = gradients_ = next_ = Matrix::Zero(rows, columns);
    moved_ = size_ = Eigen::VectorXd::Zero(eights);
}

void PhaseLanes::start(const Eigen::Ref<const Matrix>& K, const Eigen::Ref<const Matrix>& F) {
    const Eigen::Index n = K.rows(), more = rows() - n;
    gradients_.topLeftCorner(n, d()) = -F;
    gradients_.topRightCorner(n, d()) = K;
    for (Eigen::Index i = 0; i < more; ++i) gradients_.row(n + i) = gradients_.row(n - 1);
}

void PhaseLanes::startAt(double t, const double* q0, const double* p0) {
    times_.setConstant(t);
    for (int k = 0; k < d(); ++k) {
        places_.col(k).setConstant(q0[k]);
        places_.col(d() + k).setConstant(p0[k]);
    }
    H_.gradients(H_.model.get(), times_.data(), rows(), places_.data(), places_.col(d()).data(),
                 gradients_.data());
}

void PhaseLanes::setStep(double h) {
    h_ = h;
    fill(A_, h, cell_->A);
    fill(B_, -h, cell_->B);
}

double PhaseLanes::sweep(double t, double h, const double* q0, const double* p0) {
    if (h != h_) setStep(h);
    const int n = cell_->nodes(), size = rows() * d();
    double *const Q = places_.data(), *const P = Q + size;
    for (int k = 0; k < d(); ++k) {
        std::fill_n(Q + k * rows(), rows(), q0[k]);
        for (int i = 0; i < rows(); ++i) P[k * rows() + i] = p0[k] * fromStart_(i);
    }
    sums_.product({A_.data(), rows(), gradients_.data() + size, rows(), Q, rows(), rows(), d(), n});
    sums_.product({B_.data(), rows(), gradients_.data(), rows(), P, rows(), rows(), d(), n});
    for (int i = 0; i < rows(); ++i) times_(i) = H_.isTimeDependent ? h * entry(cell_->place, i) + t : t;
    H_.gradients(H_.model.get(), times_.data(), rows(), Q, P, next_.data());
    const double worst = change(h, q0, p0);
    gradients_.swap(next_);
    return worst;
}

double PhaseLanes::change(double h, const double* q0, const double* p0) {
    static const auto measure = ForThisMachine<&changesOf<Eight>, &changesOf<Four>, &changesOf<Two>>::call();
    double defect = 0, worst = 0;
    measure({rows(), 2 * d(), next_.data(), gradients_.data(), moved_.data(), size_.data(), &defect});
    if (defect != 0) return std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2 * d(); ++k)
        worst = std::max(worst, relativeCorrection(std::abs(h) * moved_(k), std::abs(h) * size_(k),
                                                   k < d() ? p0[k] : q0[k - d()]));
    return worst;
}

void PhaseLanes::rates(Eigen::Ref<Matrix> K, Eigen::Ref<Matrix> F) const {
    K = gradients_.topRightCorner(K.rows(), d());
    F = -gradients_.topLeftCorner(F.rows(), d());
}

}  // namespace extremal
