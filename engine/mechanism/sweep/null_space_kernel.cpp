// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/sweep/null_space_kernel.hpp"

#include <cmath>
#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

using namespace registers;
using Sweep = NullSpaceSweep;
using Index = NullSpaceSweep::Index;

/// Every lane becomes that of the node before; the first one is given.
[[gnu::always_inline]] inline void shift(Two& v, double first) {
    v = __builtin_shufflevector(v, Two{first}, 2, 0);
}
[[gnu::always_inline]] inline void shift(Four& v, double first) {
    v = __builtin_shufflevector(v, Four{first}, 4, 0, 1, 2);
}
[[gnu::always_inline]] inline void shift(Eight& v, double first) {
    v = __builtin_shufflevector(v, Eight{first}, 8, 0, 1, 2, 3, 4, 5, 6);
}

/// The sum of all lanes, by halves.
[[gnu::always_inline]] inline double folded(const Two& v) { return v[0] + v[1]; }
[[gnu::always_inline]] inline double folded(const Four& v) {
    return folded(Two(__builtin_shufflevector(v, v, 0, 1) + __builtin_shufflevector(v, v, 2, 3)));
}
[[gnu::always_inline]] inline double folded(const Eight& v) {
    return folded(
        Four(__builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7)));
}

template <class Pack>
struct NullSpace {
    static constexpr int width = lanesOf<Pack>;

    /// A kernel on a copy of what it is handed, of which the compiler keeps in registers what it needs: a
    /// store could be one to the original. In the usual sizes there is one block of nodes and one
    /// freedom, and the loops over these are left out.
    template <auto kernel, class... A>
    static void of(const Sweep& given, A... a) {
        Sweep s = given;
        if (s.places != 8 || s.inside != 8) return kernel(s, a...);
        s.places = s.inside = 8;
        if (s.shared.d != s.shared.n + 1) return kernel(s, a...);
        s.shared.d = s.shared.n + 1;
        kernel(s, a...);
    }

    /// What is known of the places e_1, e_2, .., at the tests i, i + 1, ..
    [[gnu::always_inline]] static inline void loadBefore(Pack& to, const double* at, double start, Index i) {
        if (i > 0) return load(to, at + i - 1);
        load(to, at);
        shift(to, start);
    }
    [[gnu::always_inline]] static inline void magnitude(Pack& v) {
        for (Index l = 0; l < width; ++l) v[l] = __builtin_fabs(v[l]);
    }
    /// The sum of what `add(sum, i)` adds for the nodes from i on, in the same order whatever the width of
    /// the registers.
    template <class Add>
    [[gnu::always_inline]] static inline double sumOverNodes(Index stride, const Add& add) {
        Pack part[8 / width] = {};
        for (Index i = 0; i < stride; i += 8)
            for (Index l = 0; l < 8 / width; ++l) add(part[l], i + l * width);
        for (Index half = 4 / width; half > 0; half /= 2)
            for (Index l = 0; l < half; ++l) part[l] += part[l + half];
        return folded(part[0]);
    }
    [[gnu::always_inline]] static inline void root(Pack& v) {
        for (Index l = 0; l < width; ++l) v[l] = __builtin_sqrt(v[l]);
    }

    /// `call(the coordinates from k on, as many as it is for)`: several sums that do not wait for each other
    /// share the columns that they read.
    template <class Call>
    [[gnu::always_inline]] static inline void inGroups(Index d, const Call& call) {
        Index k = 0;
        for (; k + 4 <= d; k += 4) call(k, std::integral_constant<int, 4>());
        if (k + 2 <= d) {
            call(k, std::integral_constant<int, 2>());
            k += 2;
        }
        if (k < d) call(k, std::integral_constant<int, 1>());
    }

    /// Terms for one sum and the other in turn, so that an addition does not wait for the one before.
    template <class Add>
    [[gnu::always_inline]] static inline void byTurns(Index terms, const Add& add) {
        Index j = 0;
        for (; j + 1 < terms; j += 2) {
            add(j, 0);
            add(j + 1, 1);
        }
        if (j < terms) add(j, 0);
    }

    [[gnu::always_inline]] static inline void extrapolate(const Sweep& s, const double* G,
                                                          const double* last) {
        for (Index i = 0; i < s.places; i += width)
            inGroups(s.shared.d, [&]<int count>(Index k, std::integral_constant<int, count>) {
                Pack sum[count] = {};
                for (Index j = 0; j < s.functions; ++j) {
                    Pack g;
                    load(g, G + j * s.places + i);
                    for (Index l = 0; l < count; ++l) sum[l] += g * last[(k + l) * s.places + j];
                }
                for (Index l = 0; l < count; ++l) place(s, (k + l) * s.places + i, s.q[k + l], sum[l]);
            });
    }
    [[gnu::always_inline]] static inline void place(const Sweep& s, Index at, double q, const Pack& U) {
        store(s.U + at, U);
        store(s.P + at, U + q);
    }

    [[gnu::always_inline]] static inline void move(const Sweep& s) {
        const SharedCoordinates& by = s.shared;
        for (Index c = 0; c < by.n; ++c)
            for (Index i = 0; i < s.places; i += width) {
                Pack U, back;
                double* const at = s.U + by.dependent[c] * s.places + i;
                load(U, at);
                load(back, s.back + c * s.places + i);
                store(at, U + back);
            }
        for (Index i = 0; i < s.inside; i += width)
            inGroups(by.d, [&]<int count>(Index k, std::integral_constant<int, count>) {
                Pack Q[2][count] = {}, V[2][count] = {};
                for (Index l = 0; l < count; ++l) Q[0][l] += s.q[k + l];
                byTurns(s.functions, [&](Index j, int turn) {
                    Pack value, slope;
                    load(value, s.value + j * s.inside + i);
                    load(slope, s.slope + j * s.inside + i);
                    for (Index l = 0; l < count; ++l) {
                        const double U = s.U[(k + l) * s.places + j];
                        Q[turn][l] += value * U;
                        V[turn][l] += slope * U;
                    }
                });
                for (Index l = 0; l < count; ++l) {
                    store(s.Q + (k + l) * s.inside + i, Q[0][l] + Q[1][l]);
                    store(s.V + (k + l) * s.inside + i, V[0][l] + V[1][l]);
                }
            });
    }

    /// h b_i (L_q + F) and b_i L_v in place of the gradients.
    [[gnu::always_inline]] static inline void weigh(const Sweep& s) {
        const Index d = s.shared.d;
        for (Index i = 0; i < s.inside; i += width) {
            Pack ofValue, ofSlope, F, L;
            load(ofValue, s.weightOfValue + i);
            load(ofSlope, s.weightOfSlope + i);
            for (Index k = 0; k < d; ++k) {
                double *const force = s.gradient + k * s.inside + i, *const momentum = force + d * s.inside;
                load(F, force);
                load(L, momentum);
                store(force, F * ofValue);
                store(momentum, L * ofSlope);
            }
        }
    }
    [[gnu::always_inline]] static inline void testResiduals(const Sweep& s, Index i) {
        const Index d = s.shared.d;
        inGroups(d, [&]<int count>(Index k, std::integral_constant<int, count>) {
            Pack byValue[2][count] = {}, bySlope[2][count] = {};
            for (Index l = 0; l < count; ++l) load(byValue[0][l], s.start + (k + l) * s.places + i);
            byTurns(s.nodes, [&](Index j, int turn) {
                Pack value, slope;
                load(value, s.testValue + j * s.places + i);
                load(slope, s.testSlope + j * s.places + i);
                for (Index l = 0; l < count; ++l) {
                    bySlope[turn][l] += slope * s.gradient[(d + k + l) * s.inside + j];
                    byValue[turn][l] += value * s.gradient[(k + l) * s.inside + j];
                }
            });
            for (Index l = 0; l < count; ++l)
                store(s.R + (k + l) * s.places + i,
                      (byValue[0][l] + bySlope[0][l]) + (byValue[1][l] + bySlope[1][l]));
        });
    }

    /// sum_c N_cj R_c, of the tests.
    [[gnu::always_inline]] static inline void alongN(const Sweep& s, Index j, Index i, Pack& sum) {
        const Index f = s.shared.freedoms();
        for (Index c = 0; c < s.shared.n; ++c) {
            const Index entry = c * f + j;
            Pack N, R;
            loadBefore(N, s.N + entry * s.places, s.startN[entry], i);
            load(R, s.R + s.shared.dependent[c] * s.places + i);
            sum += N * R;
        }
    }

    /// E_j = R_j + sum_c N_cj R_c and C_a^-1 of it, C the factors of the masses.
    [[gnu::always_inline]] static inline void restrictResiduals(const Sweep& s, Index i) {
        for (Index j = 0; j < s.shared.freedoms(); ++j) {
            const auto factor = [&](Pack& to, Index k) {
                const Index entry = s.shared.factor(j, k);
                loadBefore(to, s.factor + entry * s.places, s.startFactor[entry], i);
            };
            Pack sum, C;
            load(sum, s.R + s.shared.free[j] * s.places + i);
            alongN(s, j, i, sum);
            for (Index k = 0; k < j; ++k) {
                Pack E;
                factor(C, k);
                load(E, s.E + k * s.places + i);
                sum -= C * E;
            }
            factor(C, j);
            store(s.E + j * s.places + i, C * sum);
        }
    }

    /// S = C_b^-T (-h K^-1)_ba of those.
    [[gnu::always_inline]] static inline void solveForFree(const Sweep& s, Index i) {
        for (Index j = s.shared.freedoms() - 1; j >= 0; --j) {
            Pack even{}, odd{}, C, other;
            Index a = 0;
            for (; a + 1 < s.functions; a += 2) {
                load(C, s.inverse + a * s.places + i);
                load(other, s.inverse + (a + 1) * s.places + i);
                even += C * s.E[j * s.places + a];
                odd += other * s.E[j * s.places + a + 1];
            }
            if (a < s.functions) {
                load(C, s.inverse + a * s.places + i);
                even += C * s.E[j * s.places + a];
            }
            even += odd;
            for (Index k = j + 1; k < s.shared.freedoms(); ++k) {
                load(C, s.factor + s.shared.factor(k, j) * s.places + i);
                load(other, s.S + k * s.places + i);
                even -= C * other;
            }
            load(C, s.factor + s.shared.factor(j, j) * s.places + i);
            store(s.S + j * s.places + i, C * even);
        }
    }

    /// The largest of what a change counts.
    [[gnu::always_inline]] static inline void count(const Sweep& s, Index k, const Pack& size,
                                                    Pack& largest) {
        const Pack counted = (size - s.least[k]) * s.perSize[k];
        largest = counted > largest ? counted : largest;  // stays NaN where it is
    }

    /// The change at the places from i on; adds what counts of it.
    [[gnu::always_inline]] static inline void takeChange(const Sweep& s, Index i, Pack& sum) {
        const SharedCoordinates& by = s.shared;
        const Index f = by.freedoms();
        Pack largest{}, v, size;
        for (Index j = 0; j < f; ++j) {
            load(v, s.S + j * s.places + i);
            store(s.change + by.free[j] * s.places + i, v);
            if (j == 0) largest += v * 0.0;  // NaN where one is
            size = v;
            magnitude(size);
            count(s, by.free[j], size, largest);
        }
        for (Index c = 0; c < by.n; ++c) {
            Pack along{}, N;
            for (Index j = 0; j < f; ++j) {
                load(N, s.N + (c * f + j) * s.places + i);
                load(v, s.S + j * s.places + i);
                along += N * v;
            }
            store(s.change + by.dependent[c] * s.places + i, along);
            magnitude(along);
            load(size, s.back + c * s.places + i);
            magnitude(size);
            size += along;
            count(s, by.dependent[c], size, largest);
        }
        sum += largest;
    }

    [[gnu::always_inline]] static inline void factorise(const Sweep& s, Index i) {
        const Index f = s.shared.freedoms();
        const auto read = [&](Pack& to, Index c, Index j) { load(to, s.N + (c * f + j) * s.places + i); };
        const auto rootOf = [](Pack& v) { root(v); };
        if (f == 1) {
            Pack factor;
            factoriseMasses(s.shared, read, rootOf, &factor);
            return store(s.factor + i, factor);
        }
        Pack factor[SharedCoordinates::mostFree * (SharedCoordinates::mostFree + 1) / 2];
        factoriseMasses(s.shared, read, rootOf, factor);
        for (Index e = 0; e < s.shared.factors(); ++e) store(s.factor + e * s.places + i, factor[e]);
    }

    [[gnu::always_inline]] static inline void balance(const Sweep& s, double* all) {
        weigh(s);
        for (Index i = 0; i < s.places; i += width) testResiduals(s, i);
        if (s.isFirst)
            for (Index i = 0; i < s.places; i += width) factorise(s, i);
        for (Index i = 0; i < s.places; i += width) restrictResiduals(s, i);
        for (Index i = 0; i < s.places; i += width) solveForFree(s, i);
        *all = sumOverNodes(s.places, [&](Pack& sum, Index i) { takeChange(s, i, sum); });
    }

    [[gnu::always_inline]] static inline double sumOfSizes(const double* at, Index stride) {
        return sumOverNodes(stride, [&](Pack& sum, Index i) {
            Pack v;
            load(v, at + i);
            magnitude(v);
            sum += v;
        });
    }
    [[gnu::always_inline]] static inline void accelerate(const Sweep& s) {
        const auto sum = [&](const auto& term) {
            return sumOverNodes(s.places, [&](Pack& all, Index i) {
                for (Index j = 0; j < s.shared.freedoms(); ++j) {
                    Pack now, last;
                    load(now, s.S + j * s.places + i);
                    load(last, s.lastS + j * s.places + i);
                    last = (now - last) * s.perSize[s.shared.free[j]];
                    now *= s.perSize[s.shared.free[j]];
                    term(all, now, last);
                }
            });
        };
        const double along = sum([](Pack& all, const Pack& now, const Pack& more) { all += more * now; });
        const double size = sum([](Pack& all, const Pack&, const Pack& more) { all += more * more; });
        const double part = along / size;
        if (!(part * part <= 1)) return;
        for (Index i = 0; i < s.places; i += width)
            for (Index j = 0; j < s.shared.freedoms(); ++j) {
                Pack now, last, taken;
                load(now, s.S + j * s.places + i);
                load(last, s.lastS + j * s.places + i);
                load(taken, s.lastChange + s.shared.free[j] * s.places + i);
                store(s.S + j * s.places + i, now - part * (taken + now - last));
            }
        Pack counted{};
        for (Index i = 0; i < s.places; i += width) takeChange(s, i, counted);
    }

    [[gnu::always_inline]] static inline void measure(const Sweep& s, ChangeSize* sizes) {
        for (Index k = 0; k < s.shared.d; ++k)
            sizes[k] = {sumOfSizes(s.change + k * s.places, s.places),
                        sumOfSizes(s.U + k * s.places, s.places)};
        for (Index c = 0; c < s.shared.n; ++c)
            sizes[s.shared.dependent[c]].change += sumOfSizes(s.back + c * s.places, s.places);
    }

    [[gnu::always_inline]] static inline void apply(const Sweep& s) {
        for (Index k = 0; k < s.shared.d; ++k)
            for (Index i = 0; i < s.places; i += width) {
                const Index at = k * s.places + i;
                Pack U, change;
                load(U, s.U + at);
                load(change, s.change + at);
                place(s, at, s.q[k], U + change);
            }
    }

    /// Reactions are -R_c for what depends, and sum_c N_cj R_c for what is free.
    [[gnu::always_inline]] static inline void impulse(const Sweep& s, double* to) {
        const SharedCoordinates& by = s.shared;
        for (Index k = 0; k < by.d; ++k)
            to[k] = sumOverNodes(s.inside, [&](Pack& sum, Index i) {
                Pack weighed;
                load(weighed, s.gradient + k * s.inside + i);
                sum += weighed;
            });
        for (Index c = 0; c < by.n; ++c) {
            const Index k = by.dependent[c];
            to[k] += sumOverNodes(s.places, [&](Pack& sum, Index i) {
                Pack R;
                load(R, s.R + k * s.places + i);
                sum -= R;
            });
        }
        for (Index j = 0; j < by.freedoms(); ++j)
            to[by.free[j]] += sumOverNodes(s.places, [&](Pack& sum, Index i) { alongN(s, j, i, sum); });
    }
};

using A = NullSpace<Eight>;
using B = NullSpace<Four>;
using C = NullSpace<Two>;

}  // namespace

NullSpaceKernel nullSpaceKernel() {
    using Matrix = const double*;
    return {ForThisMachine<&A::of<&A::extrapolate, Matrix, Matrix>, &B::of<&B::extrapolate, Matrix, Matrix>,
                           &C::of<&C::extrapolate, Matrix, Matrix>>::call(),
            ForThisMachine<&A::of<&A::move>, &B::of<&B::move>, &C::of<&C::move>>::call(),
            ForThisMachine<&A::of<&A::balance, double*>, &B::of<&B::balance, double*>,
                           &C::of<&C::balance, double*>>::call(),
            ForThisMachine<&A::of<&A::accelerate>, &B::of<&B::accelerate>, &C::of<&C::accelerate>>::call(),
            ForThisMachine<&A::of<&A::measure, ChangeSize*>, &B::of<&B::measure, ChangeSize*>,
                           &C::of<&C::measure, ChangeSize*>>::call(),
            ForThisMachine<&A::of<&A::apply>, &B::of<&B::apply>, &C::of<&C::apply>>::call(),
            ForThisMachine<&A::of<&A::impulse, double*>, &B::of<&B::impulse, double*>,
                           &C::of<&C::impulse, double*>>::call()};
}

}  // namespace extremal
