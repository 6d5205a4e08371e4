// SPDX-License-Identifier: GPL-3.0-or-later
/// Exponential integrators as an expert writes them, for the problems P5, P6 and P6n of the table of peers:
/// the phi functions by contour integrals (Kassam and Trefethen 2005, SIAM J. Sci. Comput. 26, 1214), the
/// weights of ETDRK4 (Cox and Matthews 2002, J. Comput. Phys. 176, 430), propagation of i c' = H c by a
/// Chebyshev series (Tal-Ezer and Kosloff 1984, J. Chem. Phys. 81, 3967) and by Krylov spaces of Lanczos
/// (Park and Light 1986, J. Chem. Phys. 85, 5870), and real Fourier transforms by measured plans of FFTW.
#pragma once

#include <fftw3.h>

#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal::bench {

using Complex = std::complex<double>;

// --- ETDRK4 ----------------------------------------------------------------------------------------------

/// The functions of z = h L that a step needs: exp(z), exp(z/2), phi_1(z/2)/2, and the weights of the first,
/// the middle and the last rate.
struct EtdFunctions {
    Complex whole, half, ofHalf, first, middle, last;

    /// Means over a circle of radius 1 about z, on which nothing cancels. L is not real, so neither half of
    /// it will do for the whole; beyond 16 points the means do not change, as coefficients of the series of
    /// phi_3 are below 1/19! from there on.
    static EtdFunctions at(Complex z) {
        constexpr int points = 16;
        EtdFunctions f{std::exp(z), std::exp(z / 2.0), 0, 0, 0, 0};
        for (int k = 0; k < points; ++k) {
            const Complex r = z + std::polar(1.0, 2 * std::numbers::pi * (k + 0.5) / points),
                          root = std::exp(r / 2.0), e = root * root, inverse = 1.0 / r,
                          cube = inverse * inverse * inverse / static_cast<double>(points);
            f.ofHalf += (root - 1.0) * inverse / static_cast<double>(points);
            f.first += (-4.0 - r + e * (4.0 - 3.0 * r + r * r)) * cube;
            f.middle += (4.0 + 2.0 * r + e * (-4.0 + 2.0 * r)) * cube;
            f.last += (-4.0 - 3.0 * r - r * r + e * (4.0 - r)) * cube;
        }
        return f;
    }
};

/// n steps of a splitting, the first and last stages of neighbouring steps joined. `makeFree(fraction)` makes
/// what `move` takes, once for each length; `kick(fraction)`.
template <class MakeFree, class Move, class Kick>
void takeJoinedSteps(const Splitting& table, int n, MakeFree&& makeFree, Move&& move, Kick&& kick) {
    using Free = decltype(makeFree(0.0));
    const std::size_t stages = table.stages.size();
    std::vector<Free> free(stages);
    for (std::size_t s = 0; s < stages; ++s)
        if (!table.stages[s].isKick) free[s] = makeFree(table.stages[s].fraction);
    const double joined = table.stages.front().fraction + table.stages.back().fraction;
    const Free both = table.stages.front().isKick ? Free{} : makeFree(joined);
    for (int step = 0; step < n; ++step)
        for (std::size_t s = step > 0 ? 1 : 0; s < stages; ++s) {
            const bool isJoined = s + 1 == stages && step + 1 < n;
            if (table.stages[s].isKick)
                kick(isJoined ? joined : table.stages[s].fraction);
            else
                move(isJoined ? both : free[s]);
        }
}

// --- exp(-i t H) ------------------------------------------------------------------------------------------

/// J_0(R) .. up to where they stay below `least`, by Miller's recurrence: J_0 + 2 (J_2 + J_4 + ..) = 1.
inline std::vector<double> besselSeries(double R, double least) {
    const int top = static_cast<int>(R + 20 * std::cbrt(R + 1)) + 30;
    std::vector<double> J(static_cast<std::size_t>(top) + 2);
    J[static_cast<std::size_t>(top)] = 1e-250;
    double sum = 0;
    for (int k = top; k > 0; --k) {
        const auto i = static_cast<std::size_t>(k);
        J[i - 1] = 2 * k / R * J[i] - J[i + 1];
        if (std::abs(J[i - 1]) > 1e250) {
            for (std::size_t j = i - 1; j < J.size(); ++j) J[j] *= 1e-250;
            sum *= 1e-250;
        }
        if (k % 2 == 1) sum += (k == 1 ? 1 : 2) * J[i - 1];
    }
    std::size_t last = 0;
    for (std::size_t k = 0; k < J.size(); ++k) {
        J[k] /= sum;
        if (std::abs(J[k]) > least) last = k;
    }
    J.resize(last + 1);
    return J;
}

/// What a product with H is followed by: next = scale (Hv - middle v) - before, sum += weight next; on the
/// real and the imaginary parts alike, since all factors are real.
struct ChebyshevTerm {
    const double *Hv, *v;
    double* before;  ///< becomes the next one
    double* sum;
    std::size_t size;
    double scale, middle, weight;
};
inline void addChebyshevTerm(ChebyshevTerm t) {
    for (std::size_t i = 0; i < t.size; ++i) {
        const double next = t.scale * (t.Hv[i] - t.middle * t.v[i]) - t.before[i];
        t.before[i] = next;
        t.sum[i] += t.weight * next;
    }
}

/// c <- exp(-i t H) c for an H whose spectrum is between `lowest` and `highest`, as far as the coefficients
/// reach `tolerance`. `apply(v, Hv)` on real and imaginary parts in turn.
template <class Apply>
void propagateByChebyshev(std::vector<double>& c, double t, double lowest, double highest, double tolerance,
                          Apply&& apply) {
    const double middle = (highest + lowest) / 2, width = (highest - lowest) / 2 * 1.0001;
    const std::vector<double> J = besselSeries(t * width, tolerance);
    const std::size_t size = c.size();
    // sum_k (2 - delta_k0) (-i)^k J_k T_k: those of even k, and i times those of odd k.
    std::vector<double> even(size), odd(size), before(size), now = c, Hv(size);
    for (std::size_t i = 0; i < size; ++i) even[i] = J[0] * c[i];
    const auto add = ForThisMachine<&addChebyshevTerm>::call();
    for (std::size_t k = 1; k < J.size(); ++k) {
        apply(now.data(), Hv.data());
        const double sign = k % 4 == 0 || k % 4 == 1 ? 1 : -1;
        if (k == 1) std::fill(before.begin(), before.end(), 0);
        add({Hv.data(), now.data(), before.data(), (k % 2 ? odd : even).data(), size,
             (k == 1 ? 1 : 2) / width, middle, 2 * J[k] * sign});
        before.swap(now);
    }
    const double re = std::cos(t * middle), im = -std::sin(t * middle);
    for (std::size_t i = 0; i < size; i += 2) {
        const double a = even[i] + odd[i + 1], b = even[i + 1] - odd[i];
        c[i] = re * a - im * b;
        c[i + 1] = re * b + im * a;
    }
}

/// The same over t in n steps, each in the space of v, Hv, .., H^(m-1) v. There H is a real matrix of three
/// diagonals, whose exponential of e_1 is a Chebyshev series again.
class LanczosPropagation {
public:
    LanczosPropagation(std::size_t size, std::size_t dimension) : m_(dimension), v_(dimension + 1) {
        for (auto& v : v_) v.resize(size);
        diagonal_.resize(m_);
        beside_.resize(m_ + 1);
    }
    template <class Apply>
    void run(std::vector<double>& c, double t, int n, Apply&& apply) {
        for (int step = 0; step < n; ++step) {
            const std::size_t used = build(c, apply);
            combine(c, t / n, used);
        }
    }

private:
    static void dot(const double* a, const double* b, std::size_t size, double* result) {
        Lanes sum(0.0);
        for (std::size_t i = 0; i < size; i += 8) sum += Lanes::load(a + i) * Lanes::load(b + i);
        *result = 0;
        for (const double each : sum.lane) *result += each;
    }
    static void subtract(double* w, const double* a, double by, const double* b, double byB,
                         std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) w[i] -= by * a[i] + byB * b[i];
    }
    static void multiply(double* to, const double* a, double by, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) to[i] = by * a[i];
    }
    double product(const std::vector<double>& a, const std::vector<double>& b) const {
        double result = 0;
        ForThisMachine<&dot>::call()(a.data(), b.data(), a.size(), &result);
        return result;
    }
    /// H is real and symmetric between real parts, and between imaginary parts: the products are real.
    template <class Apply>
    std::size_t build(const std::vector<double>& c, Apply& apply) {
        const std::size_t size = c.size();
        norm_ = std::sqrt(product(c, c));
        ForThisMachine<&multiply>::call()(v_[0].data(), c.data(), 1 / norm_, size);
        beside_[0] = 0;
        for (std::size_t j = 0; j < m_; ++j) {
            std::vector<double>& w = v_[j + 1];
            apply(v_[j].data(), w.data());
            diagonal_[j] = product(v_[j], w);
            ForThisMachine<&subtract>::call()(w.data(), v_[j].data(), diagonal_[j],
                                              v_[j > 0 ? j - 1 : 0].data(), beside_[j], size);
            beside_[j + 1] = std::sqrt(product(w, w));
            if (!(beside_[j + 1] > 1e-12)) return j + 1;
            ForThisMachine<&multiply>::call()(w.data(), w.data(), 1 / beside_[j + 1], size);
        }
        return m_;
    }
    void combine(std::vector<double>& c, double dt, std::size_t used) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t j = 0; j < used; ++j) {
            const double r = beside_[j] + (j + 1 < used ? beside_[j + 1] : 0);
            low = std::min(low, diagonal_[j] - r);
            high = std::max(high, diagonal_[j] + r);
        }
        std::vector<double> y(2 * used);
        y[0] = norm_;
        propagateByChebyshev(y, dt, low, high, 1e-17, [&](const double* x, double* Hx) {
            for (std::size_t j = 0; j < used; ++j)
                for (std::size_t part = 0; part < 2; ++part) {
                    double sum = diagonal_[j] * x[2 * j + part];
                    if (j > 0) sum += beside_[j] * x[2 * j - 2 + part];
                    if (j + 1 < used) sum += beside_[j + 1] * x[2 * j + 2 + part];
                    Hx[2 * j + part] = sum;
                }
        });
        std::fill(c.begin(), c.end(), 0);
        for (std::size_t j = 0; j < used; ++j)
            ForThisMachine<&addTurned>::call()(c.data(), v_[j].data(), y[2 * j], y[2 * j + 1], c.size());
    }
    /// c += (re + i im) v.
    static void addTurned(double* c, const double* v, double re, double im, std::size_t size) {
        for (std::size_t i = 0; i < size; i += 2) {
            c[i] += re * v[i] - im * v[i + 1];
            c[i + 1] += re * v[i + 1] + im * v[i];
        }
    }

    std::size_t m_;
    std::vector<std::vector<double>> v_;
    std::vector<double> diagonal_, beside_;
    double norm_ = 1;
};

// --- transforms -------------------------------------------------------------------------------------------

/// Real numbers to half of their modes and back, without factors.
class RealTransform {
public:
    explicit RealTransform(int size) {
        const auto n = static_cast<std::size_t>(size);
        double* const x = fftw_alloc_real(n);
        fftw_complex* const c = fftw_alloc_complex(n / 2 + 1);
        forward_ = fftw_plan_dft_r2c_1d(size, x, c, FFTW_MEASURE);
        back_ = fftw_plan_dft_c2r_1d(size, c, x, FFTW_MEASURE);
        fftw_free(x);
        fftw_free(c);
    }
    RealTransform(const RealTransform&) = delete;
    RealTransform& operator=(const RealTransform&) = delete;
    ~RealTransform() {
        fftw_destroy_plan(forward_);
        fftw_destroy_plan(back_);
    }
    /// Plans are made once per size.
    static const RealTransform& of(int size) {
        static std::map<int, std::unique_ptr<RealTransform>> all;
        auto& at = all[size];
        if (!at) at = std::make_unique<RealTransform>(size);
        return *at;
    }
    void toModes(double* x, Complex* c) const {
        fftw_execute_dft_r2c(forward_, x, reinterpret_cast<fftw_complex*>(c));
    }
    /// Uses c up.
    void toNodes(Complex* c, double* x) const {
        fftw_execute_dft_c2r(back_, reinterpret_cast<fftw_complex*>(c), x);
    }

private:
    fftw_plan forward_, back_;
};

/// Numbers where the transforms have met them: all at the same alignment.
template <class T>
struct FftwAllocator {
    using value_type = T;
    T* allocate(std::size_t n) { return static_cast<T*>(fftw_malloc(n * sizeof(T))); }
    void deallocate(T* p, std::size_t) { fftw_free(p); }
    bool operator==(const FftwAllocator&) const = default;
};
template <class T>
using FftwVector = std::vector<T, FftwAllocator<T>>;

}  // namespace extremal::bench
