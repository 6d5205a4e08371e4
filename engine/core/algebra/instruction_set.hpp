// SPDX-License-Identifier: GPL-3.0-or-later
/// Kernels compiled for several instruction sets and chosen at start.
///
/// A release runs on any x86-64; loops over Lanes are also compiled for AVX2 and AVX-512. Contraction is
/// off everywhere, so all of them give the same bits.
#pragma once

#include <string_view>

/// In front of a function: compile it, and everything it calls in line, for that set.
#if defined(__x86_64__) && defined(__GNUC__)
#define EXTREMAL_FOR_AVX512 [[gnu::target("arch=x86-64-v4,prefer-vector-width=512"), gnu::flatten]]
#define EXTREMAL_FOR_AVX2 [[gnu::target("arch=x86-64-v3"), gnu::flatten]]
#else
#define EXTREMAL_FOR_AVX512
#define EXTREMAL_FOR_AVX2
#endif

namespace extremal {

enum class InstructionSet { baseline, avx2, avx512 };

inline InstructionSet instructionSet() {
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("x86-64-v4")) return InstructionSet::avx512;
    if (__builtin_cpu_supports("x86-64-v3")) return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
}

constexpr std::string_view name(InstructionSet set) {
    switch (set) {
        case InstructionSet::avx512:
            return "AVX-512";
        case InstructionSet::avx2:
            return "AVX2";
        case InstructionSet::baseline:
            break;
    }
    return "baseline";
}

/// A kernel compiled for every set, and the one for this machine. Kernels of one signature, which differ at
/// most in a width.
template <auto forAvx512, auto forAvx2 = forAvx512, auto forBaseline = forAvx512>
struct ForThisMachine;

template <class... A, void (*forAvx512)(A...), void (*forAvx2)(A...), void (*forBaseline)(A...)>
struct ForThisMachine<forAvx512, forAvx2, forBaseline> {
    using Call = void (*)(A...);

    static Call call() {
        switch (instructionSet()) {
            case InstructionSet::avx512:
                return &avx512;
            case InstructionSet::avx2:
                return &avx2;
            case InstructionSet::baseline:
                break;
        }
        return &baseline;
    }

private:
    EXTREMAL_FOR_AVX512 static void avx512(A... a) { forAvx512(a...); }
    EXTREMAL_FOR_AVX2 static void avx2(A... a) { forAvx2(a...); }
    [[gnu::flatten]] static void baseline(A... a) { forBaseline(a...); }
};

}  // namespace extremal
