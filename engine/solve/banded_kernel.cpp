// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/banded_kernel.hpp"

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

// Loops over arrays of registers are unrolled and stay there, which loops over plain doubles that live
// through a loop do not.
using namespace registers;

/// Adds v, or both halves of what has two.
[[gnu::always_inline]] inline void addFolded(Four& to, const Four& v) { to += v; }
[[gnu::always_inline]] inline void addFolded(Four& to, const Eight& v) {
    to += __builtin_shufflevector(v, v, 0, 1, 2, 3);
    to += __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

/// M vectors of type V make K groups times G poles.
template <class V, int M, int K>
struct Kernel {
    static constexpr int width = static_cast<int>(sizeof(V) / sizeof(double)), lanes = M * width;
    struct Row {
        V re[M], im[M];
    };

    [[gnu::always_inline]] static inline void loadRow(Row& row, const double* from) {
        for (int m = 0; m < M; ++m) {
            load(row.re[m], from + m * width);
            load(row.im[m], from + lanes + m * width);
        }
    }
    [[gnu::always_inline]] static inline void storeRow(double* to, const Row& row) {
        for (int m = 0; m < M; ++m) {
            store(to + m * width, row.re[m]);
            store(to + lanes + m * width, row.im[m]);
        }
    }
    /// K numbers, again and again.
    [[gnu::always_inline]] static inline void repeat(V (&to)[M], const double* from) {
        for (int m = 0; m < M; ++m) {
            if constexpr (width <= K) {
                load(to[m], from + m * width % K);
            } else if constexpr (width == 4) {
                Two h;
                load(h, from);
                to[m] = __builtin_shufflevector(h, h, 0, 1, 0, 1);
            } else if constexpr (K == 2) {
                Two h;
                load(h, from);
                to[m] = __builtin_shufflevector(h, h, 0, 1, 0, 1, 0, 1, 0, 1);
            } else {
                Four h;
                load(h, from);
                to[m] = __builtin_shufflevector(h, h, 0, 1, 2, 3, 0, 1, 2, 3);
            }
        }
    }
    /// a - b c.
    [[gnu::always_inline]] static inline void subtractProduct(Row& a, const Row& b, const Row& c) {
        for (int m = 0; m < M; ++m) {
            a.re[m] = (a.re[m] - b.re[m] * c.re[m]) + b.im[m] * c.im[m];
            a.im[m] = (a.im[m] - b.re[m] * c.im[m]) - b.im[m] * c.re[m];
        }
    }
    [[gnu::always_inline]] static inline void multiply(Row& a, const Row& b) {
        for (int m = 0; m < M; ++m) {
            const V re = b.re[m] * a.re[m] - b.im[m] * a.im[m];
            a.im[m] = b.re[m] * a.im[m] + b.im[m] * a.re[m];
            a.re[m] = re;
        }
    }
    /// z <- sum over the poles of residue times y.
    [[gnu::always_inline]] static inline void add(Row y, const Row& residue, double* z) {
        multiply(y, residue);
        if constexpr (K == 4 && width >= 4) {
            Four re{}, im{};
            for (int m = 0; m < M; ++m) {
                addFolded(re, y.re[m]);
                addFolded(im, y.im[m]);
            }
            store(z, __builtin_shufflevector(re, im, 0, 4, 1, 5));
            store(z + 4, __builtin_shufflevector(re, im, 2, 6, 3, 7));
            return;
        }
        double re[lanes], im[lanes];
        for (int m = 0; m < M; ++m) {
            store(re + m * width, y.re[m]);
            store(im + m * width, y.im[m]);
        }
        for (int g = 0; g < K; ++g) {
            double a = re[g], b = im[g];
            for (int j = K; j < lanes; j += K) {
                a += re[j + g];
                b += im[j + g];
            }
            z[2 * g] = a;
            z[2 * g + 1] = b;
        }
    }

    [[gnu::always_inline]] static inline void forward(const BandedSweep& s) {
        Row y, l, before{};
        for (int r = 0; r < s.rows; ++r) {
            repeat(y.re, s.x + 2 * K * r);
            repeat(y.im, s.x + 2 * K * r + K);
            if (s.band == 1) {  // the row before stays in registers
                loadRow(l, s.l + 2 * lanes * r);
                subtractProduct(y, l, before);
            } else {
                for (int d = (r < s.band ? r : s.band) - 1; d >= 0; --d) {
                    loadRow(l, s.l + 2 * lanes * (r * s.band + d));
                    loadRow(before, s.y + 2 * lanes * (r - 1 - d));
                    subtractProduct(y, l, before);
                }
            }
            before = y;
            storeRow(s.y + 2 * lanes * r, y);
        }
    }
    [[gnu::always_inline]] static inline void backward(const BandedSweep& s) {
        Row y, p, u, after, residue;
        loadRow(residue, s.residue);
        for (int r = s.rows - 1; r >= s.rows - s.band; --r) {
            loadRow(after, s.y + 2 * lanes * r);
            add(after, residue, s.z + 2 * K * r);
        }
        loadRow(after, s.y + 2 * lanes * (s.rows - 1));
        for (int r = s.rows - s.band - 1; r >= 0; --r) {
            loadRow(y, s.y + 2 * lanes * r);
            loadRow(p, s.p + 2 * lanes * r);
            multiply(y, p);
            if (s.band == 1) {
                loadRow(u, s.u + 2 * lanes * r);
                subtractProduct(y, u, after);
            } else {
                for (int d = s.band - 1; d >= 0; --d) {
                    loadRow(u, s.u + 2 * lanes * (r * s.band + d));
                    loadRow(after, s.y + 2 * lanes * (r + 1 + d));
                    subtractProduct(y, u, after);
                }
            }
            after = y;
            storeRow(s.y + 2 * lanes * r, y);
            add(y, residue, s.z + 2 * K * r);
        }
    }
    [[gnu::always_inline]] static inline void factor(const BandedFactoring& s) {
        Row zeta, below, above, p{}, l, u;
        loadRow(zeta, s.zeta);
        loadRow(below, s.below);
        loadRow(above, s.above);
        for (int r = 0; r < s.rows; ++r) {
            l = p;
            multiply(l, below);
            storeRow(s.l + 2 * lanes * r, l);
            for (int m = 0; m < M; ++m) {
                V d;
                load(d, s.d + lanes * r + m * width);
                const V re = zeta.re[m] + s.squared * p.re[m], im = zeta.im[m] + d + s.squared * p.im[m];
                const V scale = 1 / (re * re + im * im);
                p.re[m] = re * scale;
                p.im[m] = -im * scale;
            }
            storeRow(s.p + 2 * lanes * r, p);
            u = p;
            multiply(u, above);
            storeRow(s.u + 2 * lanes * r, u);
        }
    }
};

#define EXTREMAL_KERNEL(name, target, V, M, K)                                         \
    target void forward##name(const BandedSweep& s) { Kernel<V, M, K>::forward(s); }   \
    target void backward##name(const BandedSweep& s) { Kernel<V, M, K>::backward(s); } \
    target void factor##name(const BandedFactoring& s) { Kernel<V, M, K>::factor(s); } \
    constexpr BandedCalls calls##name{&forward##name, &backward##name, &factor##name};

EXTREMAL_KERNEL(Base21, , Two, 1, 2)
EXTREMAL_KERNEL(Base22, , Two, 2, 2)
EXTREMAL_KERNEL(Base24, , Two, 4, 2)
EXTREMAL_KERNEL(Base41, , Two, 2, 4)
EXTREMAL_KERNEL(Base42, , Two, 4, 4)
EXTREMAL_KERNEL(Base44, , Two, 8, 4)
EXTREMAL_KERNEL(Avx22, EXTREMAL_FOR_AVX2, Four, 1, 2)
EXTREMAL_KERNEL(Avx24, EXTREMAL_FOR_AVX2, Four, 2, 2)
EXTREMAL_KERNEL(Avx41, EXTREMAL_FOR_AVX2, Four, 1, 4)
EXTREMAL_KERNEL(Avx42, EXTREMAL_FOR_AVX2, Four, 2, 4)
EXTREMAL_KERNEL(Avx44, EXTREMAL_FOR_AVX2, Four, 4, 4)
EXTREMAL_KERNEL(Wide24, EXTREMAL_FOR_AVX512, Eight, 1, 2)
EXTREMAL_KERNEL(Wide42, EXTREMAL_FOR_AVX512, Eight, 1, 4)
EXTREMAL_KERNEL(Wide44, EXTREMAL_FOR_AVX512, Eight, 2, 4)
#undef EXTREMAL_KERNEL

}  // namespace

BandedCalls bandedCalls(int groups, int poles) {
    const InstructionSet set = instructionSet();
    const bool isWide = set == InstructionSet::avx512, isBase = set == InstructionSet::baseline;
    const int which = 10 * groups + poles;
    if (which == 21) return callsBase21;
    if (which == 22) return isBase ? callsBase22 : callsAvx22;
    if (which == 24) return isBase ? callsBase24 : isWide ? callsWide24 : callsAvx24;
    if (which == 41) return isBase ? callsBase41 : callsAvx41;
    if (which == 42) return isBase ? callsBase42 : isWide ? callsWide42 : callsAvx42;
    return isBase ? callsBase44 : isWide ? callsWide44 : callsAvx44;
}

}  // namespace extremal
