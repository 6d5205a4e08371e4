#include "engine/integrator/small_product.hpp"

#include <cstring>
#include <utility>

#include "engine/core/instruction_set.hpp"

namespace extremal {
namespace {

/// Eight doubles, in as many registers as the machine needs.
using Eight = double __attribute__((vector_size(64)));

/// Eight rows from r of `width` columns from c.
template <int width>
inline void tile(const SmallProduct& p, int r, int c) {
    Eight sum[width];
    for (int j = 0; j < width; ++j) sum[j] = Eight{};
    const double* A = p.A + r;
    const double* B = p.B + static_cast<long>(c) * p.strideB;
    for (int i = 0; i < p.depth; ++i, A += p.stride) {
        Eight a;
        std::memcpy(&a, A, sizeof a);
        for (int j = 0; j < width; ++j) sum[j] += a * B[static_cast<long>(j) * p.strideB + i];
    }
    const int count = p.rows - r < 8 ? p.rows - r : 8;
    for (int j = 0; j < width; ++j) {
        double* C = p.C + static_cast<long>(c + j) * p.strideC + r;
        for (int i = 0; i < count; ++i) C[i] += sum[j][i];
    }
}

template <int width>
inline void product(const SmallProduct& p) {
    for (int r = 0; r < p.rows; r += 8) {
        int c = 0;
        for (; c + width <= p.columns; c += width) tile<width>(p, r, c);
        for (; c < p.columns; ++c) tile<1>(p, r, c);
    }
}

/// Knuth's exact sums: what each addition loses is added up beside.
inline void sumOfTwo(const SumOfTwo& p) {
    for (int r = 0; r < p.rows; r += 8) {
        Eight sum{}, lost{};
        for (const auto& [A, a] : {std::pair{p.A, p.a}, std::pair{p.B, p.b}}) {
            const double* column = A + r;
            for (int i = 0; i < p.depth; ++i, column += p.stride) {
                Eight term;
                std::memcpy(&term, column, sizeof term);
                term *= a[i];
                const Eight next = sum + term, back = next - sum;
                lost += (sum - (next - back)) + (term - back);
                sum = next;
            }
        }
        sum += lost;
        const int count = p.rows - r < 8 ? p.rows - r : 8;
        for (int i = 0; i < count; ++i) p.c[r + i] = sum[i];
    }
}

inline void combine(const double* p, const double* x, const double* q, const double* y,
                    double* __restrict out, int n) {
    for (int i = 0; i < n; ++i) out[i] = p[i] * x[i] + q[i] * y[i];
}

}  // namespace

NodeSums nodeSums() {
    return {ForThisMachine<&product<8>, &product<4>, &product<2>>::call(), ForThisMachine<&sumOfTwo>::call(),
            ForThisMachine<&combine>::call()};
}

}  // namespace extremal
