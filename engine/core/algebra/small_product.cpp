// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/small_product.hpp"

#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

using namespace registers;

/// Adds the first `count` of `sum`.
template <class Pack>
inline void addTo(double* C, const Pack& sum, int count) {
    if (count < lanesOf<Pack>) {
        for (int i = 0; i < count; ++i) C[i] += sum[i];
        return;
    }
    Pack before;
    load(before, C);
    before += sum;
    store(C, before);
}

// Every entry is a sum of its own in the order of the terms, whatever the tile. An addition has to wait for
// the one before: tiles have several sums that do not wait for each other.

/// One register of rows from r, of `width` columns from c.
template <class Pack, int width>
inline void tile(const SmallProduct& p, int r, int c) {
    Pack sum[width];
    for (int j = 0; j < width; ++j) sum[j] = Pack{};
    const double* A = p.A + r;
    const double* B = p.B + static_cast<long>(c) * p.strideB;
    for (int i = 0; i < p.depth; ++i, A += p.stride) {
        Pack a;
        load(a, A);
        for (int j = 0; j < width; ++j) sum[j] += a * B[static_cast<long>(j) * p.strideB + i];
    }
    for (int j = 0; j < width; ++j) addTo(p.C + static_cast<long>(c + j) * p.strideC + r, sum[j], p.rows - r);
}

/// The last columns, fewer than `width`.
template <class Pack, int width>
inline void narrow(const SmallProduct& p, int r, int c) {
    if constexpr (width > 1) {
        if (p.columns - c == width - 1) return tile<Pack, width - 1>(p, r, c);
        narrow<Pack, width - 1>(p, r, c);
    }
}

/// `height` registers of rows from r, of the only column.
template <class Pack, int height>
inline void strip(const SmallProduct& p, int r) {
    Pack sum[height];
    for (int k = 0; k < height; ++k) sum[k] = Pack{};
    const double* A = p.A + r;
    for (int i = 0; i < p.depth; ++i, A += p.stride)
        for (int k = 0; k < height; ++k) {
            Pack a;
            load(a, A + k * lanesOf<Pack>);
            sum[k] += a * p.B[i];
        }
    for (int k = 0; k < height; ++k)
        addTo(p.C + r + k * lanesOf<Pack>, sum[k], p.rows - r - k * lanesOf<Pack>);
}

template <class Pack>
inline void product(const SmallProduct& p) {
    constexpr int width = 8, height = 4;
    int r = 0;
    if (p.columns == 1)
        for (; r + height * lanesOf<Pack> <= p.rows; r += height * lanesOf<Pack>) strip<Pack, height>(p, r);
    for (; r < p.rows; r += lanesOf<Pack>) {
        int c = 0;
        for (; c + width <= p.columns; c += width) tile<Pack, width>(p, r, c);
        narrow<Pack, width>(p, r, c);
    }
}

/// Knuth's exact sums: what each addition loses is added up beside.
template <class Pack>
inline void sumOfTwo(const SumOfTwo& p) {
    for (int r = 0; r < p.rows; r += lanesOf<Pack>) {
        Pack sum{}, lost{};
        for (const auto& [A, a] : {std::pair{p.A, p.a}, std::pair{p.B, p.b}}) {
            const double* column = A + r;
            for (int i = 0; i < p.depth; ++i, column += p.stride) {
                Pack term;
                load(term, column);
                term *= a[i];
                const Pack next = sum + term, back = next - sum;
                lost += (sum - (next - back)) + (term - back);
                sum = next;
            }
        }
        sum += lost;
        const int count = p.rows - r < lanesOf<Pack> ? p.rows - r : lanesOf<Pack>;
        for (int i = 0; i < count; ++i) p.c[r + i] = sum[i];
    }
}

inline void combine(const double* p, const double* x, const double* q, const double* y,
                    double* __restrict out, int n) {
    for (int i = 0; i < n; ++i) out[i] = p[i] * x[i] + q[i] * y[i];
}

}  // namespace

NodeSums nodeSums() {
    return {ForThisMachine<&product<Eight>, &product<Four>, &product<Two>>::call(),
            ForThisMachine<&sumOfTwo<Eight>, &sumOfTwo<Four>, &sumOfTwo<Two>>::call(),
            ForThisMachine<&combine>::call()};
}

}  // namespace extremal
