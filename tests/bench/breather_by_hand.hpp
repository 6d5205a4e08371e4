// SPDX-License-Identifier: GPL-3.0-or-later
/// P6 of the table of peers as an expert writes it: the breather in Fourier modes, with real transforms by
/// FFTW and sines in vector registers, by trigonometric integrators, their compositions, splittings, and
/// ETDRK4 (exponential_peers.hpp).
///
///     u_tt = (u_xx - m u) + (m u - sin u),   the first part exact, with frequencies w = sqrt(k^2 + m)
/// With m = 0 all of the sine is in the kicks, with m = 1 only what it is more than u. A step of a
/// trigonometric integrator is a kick by psi(h w) g/2, the free motion over h, and the same kick: psi = 1 is
/// the method of Deuflhard (1979), psi = sinc one of Gautschi's kind, whose error does not depend on the
/// frequencies (Hairer, Lubich, Wanner 2006, XIII.2, method E).
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/bench/exponential_peers.hpp"
#include "tests/bench/peer_table.hpp"

namespace extremal::bench {

/// m u - sin u, times `scale`.
inline void breatherForce(const double* u, double* g, double m, double scale, std::size_t size) {
    for (std::size_t i = 0; i < size; i += 8) {
        const Lanes at = Lanes::load(u + i);
        (Lanes(scale) * (Lanes(m) * at - sin(at))).store(g + i);
    }
}
/// The mode (a, b) <- (own a + other b, back a + own b).
inline void turnModes(double* a, double* b, const double* own, const double* other, const double* back,
                      std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
        const double x = own[i] * a[i] + other[i] * b[i];
        b[i] = back[i] * a[i] + own[i] * b[i];
        a[i] = x;
    }
}
inline void addModes(double* to, const double* from, const double* by, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) to[i] += by[i] * from[i];
}

class BreatherByHand {
public:
    using Numbers = FftwVector<double>;
    static constexpr double length = 160, end = 100, omega = 0.9;

    BreatherByHand(int modes, double m)
        : size_(static_cast<std::size_t>(modes)),
          half_(size_ / 2 + 1),
          m_(m),
          transform_(RealTransform::of(modes)),
          nodes_(size_),
          force_(size_),
          copy_(2 * half_) {
        // u = 4 atan(k/w sin(w t)/cosh(k x)): at t = 0 it is at rest in u, and moves.
        for (std::size_t j = 0; j < size_; ++j) nodes_[j] = 4 * depth() / std::cosh(depth() * place(j));
        u_.assign(2 * half_, 0);
        v_.resize(2 * half_);
        toModes(nodes_, v_);
        for (double& each : v_) each /= static_cast<double>(size_);
        for (std::size_t k = 0; k < half_; ++k)
            w_.push_back(std::sqrt(std::pow(2 * std::numbers::pi / length * static_cast<double>(k), 2) + m));
    }

    /// Of n steps, the free motions first or last at the ends joined with those of the neighbours.
    void bySplitting(const Splitting& table, int n) {
        const double h = end / n;
        takeJoinedSteps(
            table, n, [&](double fraction) { return freeMotion(fraction * h); },
            [&](const Free& free) { move(free); }, [&](double fraction) { kick(fraction * h); });
    }
    /// The parts of a composition of symmetric steps.
    void byTrigonometric(const std::vector<double>& parts, bool isFiltered, int n) {
        const double h = end / n;
        struct Part {
            Free free;
            Numbers filter;
        };
        std::vector<Part> all;
        for (const double part : parts) {
            Part p{freeMotion(part * h), Numbers(2 * half_)};
            for (std::size_t k = 0; k < half_; ++k) {
                const double z = part * h * w_[k],
                             sinc = isFiltered && std::abs(z) > 1e-8 ? std::sin(z) / z : 1;
                p.filter[2 * k] = p.filter[2 * k + 1] = sinc * part * h / 2;
            }
            all.push_back(std::move(p));
        }
        evaluate();
        for (int step = 0; step < n; ++step)
            for (const Part& p : all) {
                addForce(p.filter);
                move(p.free);
                evaluate();
                addForce(p.filter);
            }
    }
    /// phi_k(h L) = a + b h L for L of two rows, whose square is -w^2: with phi_k(i h w), a is the real part
    /// and b the imaginary one over h w.
    void byEtdRk4(int n) {
        const double h = end / n;
        const Free whole = freeMotion(h), half = freeMotion(h / 2);
        struct Weights {
            Numbers u, v;
        };
        Weights ofHalf, first, middle, last;
        for (std::size_t k = 0; k < half_; ++k) {
            const double z = h * w_[k];
            // Of w = 0, where b is a derivative: a frequency of nearly none.
            const double safe = std::max(z, 1e-5);
            const EtdFunctions f = EtdFunctions::at({0, safe});
            const auto add = [&](Weights& to, Complex phi) {
                for (int part = 0; part < 2; ++part) {
                    to.u.push_back(h * h * phi.imag() / safe);
                    to.v.push_back(h * phi.real());
                }
            };
            add(ofHalf, f.ofHalf);
            add(first, f.first);
            add(middle, f.middle);
            add(last, f.last);
        }
        Numbers u0, v0, ua, va, ga(2 * half_), gb, gc;
        const auto give = [&](const Weights& by, const Numbers& g) {
            ForThisMachine<&addModes>::call()(u_.data(), g.data(), by.u.data(), u_.size());
            ForThisMachine<&addModes>::call()(v_.data(), g.data(), by.v.data(), v_.size());
        };
        for (int step = 0; step < n; ++step) {
            u0 = u_;
            v0 = v_;
            evaluate();
            ga = modesOfForce_;
            move(half);
            ua = u_;  // half a step without forces
            va = v_;
            give(ofHalf, ga);
            const Numbers uA = u_, vA = v_;
            evaluate();
            gb = modesOfForce_;
            u_ = ua;
            v_ = va;
            give(ofHalf, gb);
            evaluate();
            gc = modesOfForce_;
            u_ = uA;
            v_ = vA;
            move(half);
            for (std::size_t i = 0; i < gc.size(); ++i) copy_[i] = 2 * gc[i] - ga[i];
            give(ofHalf, copy_);
            evaluate();
            u_ = u0;
            v_ = v0;
            move(whole);
            for (std::size_t i = 0; i < gc.size(); ++i) gb[i] += gc[i];
            give(first, ga);
            give(middle, gb);
            give(last, modesOfForce_);
        }
    }
    /// In L2, at the nodes.
    double error() {
        copy_ = u_;
        transform_.toNodes(coefficientsOf(copy_), nodes_.data());
        double sum = 0;
        for (std::size_t j = 0; j < size_; ++j) {
            const double u =
                4 * std::atan(depth() / omega * std::sin(omega * end) / std::cosh(depth() * place(j)));
            sum += length / static_cast<double>(size_) * (nodes_[j] - u) * (nodes_[j] - u);
        }
        return std::sqrt(sum);
    }

private:
    /// Of the mode k over a time, for its real and its imaginary part.
    struct Free {
        Numbers own, other, back;
    };
    static double depth() { return std::sqrt(1 - omega * omega); }
    double place(std::size_t j) const {
        return length * (static_cast<double>(j) / static_cast<double>(size_) - 0.5);
    }
    static Complex* coefficientsOf(Numbers& x) { return reinterpret_cast<Complex*>(x.data()); }
    void toModes(Numbers& nodes, Numbers& modes) { transform_.toModes(nodes.data(), coefficientsOf(modes)); }

    Free freeMotion(double t) const {
        Free free;
        for (const double w : w_)
            for (int part = 0; part < 2; ++part) {
                free.own.push_back(std::cos(w * t));
                free.other.push_back(w == 0 ? t : std::sin(w * t) / w);
                free.back.push_back(-w * std::sin(w * t));
            }
        return free;
    }
    void move(const Free& f) {
        ForThisMachine<&turnModes>::call()(u_.data(), v_.data(), f.own.data(), f.other.data(), f.back.data(),
                                           u_.size());
    }
    /// The modes of m u - sin u.
    void evaluate() {
        copy_ = u_;
        transform_.toNodes(coefficientsOf(copy_), nodes_.data());
        ForThisMachine<&breatherForce>::call()(nodes_.data(), force_.data(), m_,
                                               1 / static_cast<double>(size_), size_);
        modesOfForce_.resize(2 * half_);
        toModes(force_, modesOfForce_);
    }
    void addForce(const Numbers& by) {
        ForThisMachine<&addModes>::call()(v_.data(), modesOfForce_.data(), by.data(), v_.size());
    }
    void kick(double h) {
        evaluate();
        for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += h * modesOfForce_[i];
    }

    std::size_t size_, half_;
    double m_;
    const RealTransform& transform_;
    Numbers nodes_, force_, copy_, u_, v_, modesOfForce_;
    std::vector<double> w_;
};

/// The numbers of modes at which errors of 1e-3, 1e-6 and 1e-9 cost least, and one more.
inline void addBreathersByHand(std::vector<Curve>& curves) {
    for (const int modes : {192, 224, 256, 320})
        for (const double m : {0.0, 1.0}) {
            const std::string with = " with real FFTW, " + std::to_string(modes) + (m > 0 ? " about u" : "");
            const auto add = [&](const std::string& name, const std::vector<double>& steps, double longest,
                                 const auto& run) {
                curves.push_back(measure(name + with, true, steps, longest, [&](double n) {
                    BreatherByHand b(modes, m);
                    run(b, static_cast<int>(n));
                    return std::vector<double>{b.error()};
                }));
            };
            add("SRKN 11b", counts(20, 2000, 1.12), 0.02,
                [](auto& b, int n) { b.bySplitting(srkn11b(), n); });
            add("SRKN 14a", counts(20, 2000, 1.12), 0.02,
                [](auto& b, int n) { b.bySplitting(srkn14a(), n); });
            add("SRKN 19a", counts(15, 1500, 1.12), 0.02,
                [](auto& b, int n) { b.bySplitting(srkn19a(), n); });
            add("SRKN 19b", counts(15, 1500, 1.12), 0.02,
                [](auto& b, int n) { b.bySplitting(srkn19b(), n); });
            add("ETDRK4", counts(100, 8000, 1.4), 0.01, [](auto& b, int n) { b.byEtdRk4(n); });
            for (const bool isFiltered : {false, true})
                for (const double order : {4.0, 8.0}) {
                    const std::vector<double> parts =
                        order == 4 ? compositionParts({"suzuki", {{"order", 4.0}}, {}}, 2)
                                   : compositionParts({"kahan-li", {{"order", 8.0}}, {}}, 2);
                    add(std::string(isFiltered ? "Gautschi " : "Deuflhard ") + formatNumber(order),
                        counts(order == 8 ? 20 : 50, 2e4, 1.3), 0.01,
                        [&](auto& b, int n) { b.byTrigonometric(parts, isFiltered, n); });
                }
        }
}

}  // namespace extremal::bench
