// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/small_lu.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

using namespace registers;

constexpr int mostHeight = 8;  ///< registers of a column

template <class To, class From>
inline To as(const From& from) {
    return std::bit_cast<To>(from);
}
template <class Pack>
inline Pack loaded(const double* from) {
    Pack pack;
    load(pack, from);
    return pack;
}

/// The matrix is replaced by its factors, whose columns have whole registers.
struct Factorisation {
    double *matrix, *work;
    std::size_t size, stride;
    double* inverse;
    std::size_t* row;
    Outcome* outcome;
};

/// The rows of a column of `height` registers, and which of them wait for a pivot.
template <class Pack, int height>
struct Waiting {
    static constexpr std::size_t lanes = lanesOf<Pack>;

    explicit Waiting(std::size_t size) {
        for (int r = 0; r < height; ++r) {
            for (std::size_t i = 0; i < lanes; ++i)
                row[r][i] = last - static_cast<long long>(static_cast<std::size_t>(r) * lanes + i);
            isWaiting[r] = row[r] > last - static_cast<long long>(size);
        }
    }
    void remove(std::size_t pivot) {
        for (int r = 0; r < height; ++r) isWaiting[r] &= row[r] != last - static_cast<long long>(pivot);
    }
    /// The largest |column|, and of equal ones the first: as an integer, whose last bits are replaced by the
    /// row, so that the largest one says where it is. What is no number is larger than all numbers.
    std::size_t largest(const Pack* column) const {
        constexpr long long sizes = ~last & std::numeric_limits<long long>::max();
        Mask<Pack> most{};
        for (int r = 0; r < height; ++r) {
            const Mask<Pack> own = ((as<Mask<Pack>>(column[r]) & sizes) | row[r]) & isWaiting[r];
            most = most > own ? most : own;
        }
        long long all[lanes];
        std::memcpy(all, &most, sizeof all);
        for (std::size_t width = lanes / 2; width > 0; width /= 2)
            for (std::size_t i = 0; i < width; ++i) all[i] = std::max(all[i], all[i + width]);
        return static_cast<std::size_t>(last - (all[0] & last));
    }

    static constexpr long long last = 127;
    static_assert(mostHeight * Lanes::size <= last);
    Mask<Pack> isWaiting[height], row[height];  ///< row: counted from `last` down
};

template <class Pack, int height>
inline void factorise(const Factorisation& f) {
    constexpr std::size_t lanes = lanesOf<Pack>;
    for (std::size_t j = 0; j < f.size; ++j)
        for (std::size_t i = 0; i < f.size; ++i) f.work[j * f.stride + i] = f.matrix[j * f.size + i];
    Waiting<Pack, height> rows(f.size);
    Pack next[height], left[height];
    for (int r = 0; r < height; ++r) next[r] = loaded<Pack>(f.work + static_cast<std::size_t>(r) * lanes);
    std::size_t best = rows.largest(next);
    for (std::size_t k = 0; k < f.size; ++k) {
        double* column = f.work + k * f.stride;
        const double pivot = column[best];
        *f.outcome = !(std::abs(pivot) <= std::numeric_limits<double>::max()) ? Outcome::notFinite
                     : !(std::abs(pivot) > 0)                                 ? Outcome::singular
                                                                              : Outcome::converged;
        if (*f.outcome != Outcome::converged) return;
        f.row[k] = best;
        f.inverse[k] = 1 / pivot;
        rows.remove(best);
        for (int r = 0; r < height; ++r) {
            const auto own = as<Mask<Pack>>(Pack(next[r] * f.inverse[k])) & rows.isWaiting[r];
            left[r] = as<Pack>(own);
            store(column + static_cast<std::size_t>(r) * lanes,
                  as<Pack>(own | (as<Mask<Pack>>(next[r]) & ~rows.isWaiting[r])));
        }
        if (k + 1 == f.size) break;
        // The next pivot is found while the other columns are changed.
        column += f.stride;
        double factor = column[best];
        for (int r = 0; r < height; ++r) {
            double* const at = column + static_cast<std::size_t>(r) * lanes;
            next[r] = loaded<Pack>(at) - factor * left[r];
            store(at, next[r]);
        }
        const std::size_t after = rows.largest(next);
        for (std::size_t j = k + 2; j < f.size; ++j) {
            column += f.stride;
            factor = column[best];
            for (int r = 0; r < height; ++r) {
                double* const at = column + static_cast<std::size_t>(r) * lanes;
                store(at, Pack(loaded<Pack>(at) - factor * left[r]));
            }
        }
        best = after;
    }
    for (std::size_t j = 0; j < f.size; ++j)
        for (std::size_t k = 0; k < f.size; ++k) f.matrix[j * f.stride + k] = f.work[j * f.stride + f.row[k]];
}

struct Solution {
    const double* factors;
    std::size_t size, stride;
    const double* inverse;
    const std::size_t* row;
    double* x;
};

/// Register by register: of the one with the unknowns in question every lane waits for the one before, what
/// they do to the others does not.
template <class Pack>
inline void substitute(const Solution& s) {
    constexpr std::size_t lanes = lanesOf<Pack>;
    alignas(64) double right[mostHeight * Lanes::size];
    store(right + s.stride - lanes, Pack{});
    for (std::size_t k = 0; k < s.size; ++k) right[k] = s.x[s.row[k]];
    Mask<Pack> lane;
    for (std::size_t i = 0; i < lanes; ++i) lane[i] = static_cast<long long>(i);
    Pack factor[lanes];
    const auto diagonal = [&](std::size_t r, std::size_t i, const Mask<Pack>& others) {
        return as<Pack>(as<Mask<Pack>>(loaded<Pack>(s.factors + (r + i) * s.stride + r)) & others);
    };
    for (std::size_t r = 0; r < s.size; r += lanes) {
        Pack own = loaded<Pack>(right + r);
#pragma GCC unroll 8
        for (std::size_t i = 0; i < lanes; ++i) {
            if (r + i >= s.size) break;
            factor[i] = __builtin_shuffle(own, Mask<Pack>{} + static_cast<long long>(i));
            own -= factor[i] * diagonal(r, i, lane > static_cast<long long>(i));
        }
        store(right + r, own);
        for (std::size_t below = r + lanes; below < s.size; below += lanes) {
            Pack sum = loaded<Pack>(right + below);
            for (std::size_t i = 0; i < lanes; ++i)
                sum -= factor[i] * loaded<Pack>(s.factors + (r + i) * s.stride + below);
            store(right + below, sum);
        }
    }
    for (std::size_t r = s.stride; r > 0;) {
        r -= lanes;
        Pack own = loaded<Pack>(right + r);
#pragma GCC unroll 8
        for (std::size_t j = 0; j < lanes; ++j) {
            const std::size_t i = lanes - 1 - j;
            if (r + i >= s.size) continue;
            factor[i] = __builtin_shuffle(own, Mask<Pack>{} + static_cast<long long>(i)) * s.inverse[r + i];
            own -= factor[i] * diagonal(r, i, lane < static_cast<long long>(i));
        }
        for (std::size_t i = 0; i < lanes && r + i < s.size; ++i) s.x[r + i] = factor[i][0];
        const std::size_t count = std::min(lanes, s.size - r);
        for (std::size_t above = 0; above < r; above += lanes) {
            Pack sum = loaded<Pack>(right + above);
            for (std::size_t i = count; i-- > 0;)
                sum -= factor[i] * loaded<Pack>(s.factors + (r + i) * s.stride + above);
            store(right + above, sum);
        }
    }
}

/// The kernel of as many registers as a column has.
template <class Pack, int height = 1>
inline void factoriseAny(const Factorisation& f) {
    if (f.size <= height * lanesOf<Pack>) return factorise<Pack, height>(f);
    if constexpr (height < mostHeight) return factoriseAny<Pack, height + 1>(f);
}
struct Kernels {
    void (*factorise)(const Factorisation&) =
        ForThisMachine<&factoriseAny<Eight>, &factoriseAny<Four>, &factoriseAny<Two>>::call();
    void (*solve)(const Solution&) =
        ForThisMachine<&substitute<Eight>, &substitute<Four>, &substitute<Two>>::call();
    std::size_t most = mostHeight * (instructionSet() == InstructionSet::avx512 ? lanesOf<Eight>
                                     : instructionSet() == InstructionSet::avx2 ? lanesOf<Four>
                                                                                : lanesOf<Two>);
};
const Kernels& kernels() {
    static const Kernels ofThisMachine;
    return ofThisMachine;
}

}  // namespace

SmallLu<double>::SmallLu(int size)
    : size_(static_cast<std::size_t>(size)),
      a_(inWholeLanes(size_) * size_ / Lanes::size),
      work_(size_ <= kernels().most ? a_.size() : 0),
      inverse_(size_),
      row_(size_) {}

void SmallLu<double>::clear() { std::fill(a_.begin(), a_.end(), Lanes{}); }

Outcome SmallLu<double>::factorise() {
    if (work_.empty()) return lu::factorise(matrix(), size_, inverse_.data(), row_.data());
    Outcome outcome = Outcome::converged;
    kernels().factorise({matrix(), work_.data()->lane.data(), size_, inWholeLanes(size_), inverse_.data(),
                         row_.data(), &outcome});
    return outcome;
}

void SmallLu<double>::solve(double* x) const {
    if (work_.empty()) return lu::solve(matrix(), size_, inverse_.data(), row_.data(), x);
    kernels().solve({matrix(), size_, inWholeLanes(size_), inverse_.data(), row_.data(), x});
}

void SmallLu<double>::solveTransposed(double* x) const {
    if (work_.empty()) return lu::solveTransposed(matrix(), size_, inverse_.data(), row_.data(), x);
    std::array<double, mostHeight * Lanes::size> right;
    std::copy_n(x, size_, right.begin());
    for (std::size_t k = 0; k < size_; ++k) {
        const double* const column = matrix() + k * inWholeLanes(size_);
        for (std::size_t i = 0; i < k; ++i) right[k] -= column[i] * right[i];
        right[k] *= inverse_[k];
    }
    for (std::size_t k = size_; k-- > 0;) {
        const double* const column = matrix() + k * inWholeLanes(size_);
        for (std::size_t i = k + 1; i < size_; ++i) right[k] -= column[i] * right[i];
    }
    for (std::size_t k = 0; k < size_; ++k) x[row_[k]] = right[k];
}

}  // namespace extremal
