// SPDX-License-Identifier: GPL-3.0-or-later
/// P6n of the table of peers as an expert writes it: i psi_t = -psi_xx/2 - |psi|^2 psi in Fourier modes, with
/// measured plans of FFTW and sines in vector registers, by ETDRK4 (exponential_peers.hpp) and by splittings.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/bench/exponential_peers.hpp"

namespace extremal::bench {

/// psi <- scale exp(i t |psi|^2) psi, real and imaginary parts in turn.
inline void turnByDensity(double* psi, double t, double scale, std::size_t size) {
    for (std::size_t i = 0; i < size; i += 16) {
        Lanes re, im;
        for (std::size_t j = 0; j < 8; ++j) {
            re.lane[j] = psi[i + 2 * j];
            im.lane[j] = psi[i + 2 * j + 1];
        }
        const Lanes angle = Lanes(t) * (re * re + im * im), c = Lanes(scale) * cos(angle),
                    s = Lanes(scale) * sin(angle), a = re * c - im * s, b = im * c + re * s;
        for (std::size_t j = 0; j < 8; ++j) {
            psi[i + 2 * j] = a.lane[j];
            psi[i + 2 * j + 1] = b.lane[j];
        }
    }
}
/// i scale |psi|^2 psi.
inline void rateByDensity(double* psi, double scale, std::size_t size) {
    for (std::size_t i = 0; i < size; i += 2) {
        const double a = psi[i], b = psi[i + 1], w = scale * (a * a + b * b);
        psi[i] = -w * b;
        psi[i + 1] = w * a;
    }
}
/// to = by * from, and to += by * from, of complex numbers.
inline void multiplyComplex(double* to, const double* from, const double* by, std::size_t size) {
    for (std::size_t i = 0; i < size; i += 2) {
        const double a = from[i], b = from[i + 1];
        to[i] = by[i] * a - by[i + 1] * b;
        to[i + 1] = by[i] * b + by[i + 1] * a;
    }
}
inline void addComplex(double* to, const double* from, const double* by, std::size_t size) {
    for (std::size_t i = 0; i < size; i += 2) {
        const double a = from[i], b = from[i + 1];
        to[i] += by[i] * a - by[i + 1] * b;
        to[i + 1] += by[i] * b + by[i + 1] * a;
    }
}

/// Coefficients as those of the system (wave/basis/fourier.hpp): |psi|^2 at the nodes is that of a transform
/// without factors over the length.
class SolitonByHand {
public:
    using Numbers = FftwVector<Complex>;
    SolitonByHand(const Hamiltonian& h, const std::vector<double>& start, double length)
        : kinetic_(h.kinetic()),
          size_(kinetic_.size()),
          length_(length),
          fourier_(measured(h)),
          c_(coefficients(start.data()), coefficients(start.data()) + size_),
          psi_(size_) {}

    std::vector<double> bySplitting(const Splitting& table, double end, int n) {
        const double h = end / n;
        const auto phases = [&](double fraction) {
            Numbers all;
            for (const double E : kinetic_) all.push_back(std::polar(1.0, -fraction * h * E));
            return all;
        };
        takeJoinedSteps(
            table, n, phases, [&](const Numbers& free) { multiply(c_, c_, free); },
            [&](double fraction) { kick(fraction * h); });
        return result();
    }
    std::vector<double> byEtdRk4(double end, int n) {
        const double h = end / n;
        Numbers whole, half, ofHalf, twice, minus, first, middle, last;
        std::vector<EtdFunctions> functions;  // of k and -k the same
        for (std::size_t k = 0; k < size_; ++k) {
            functions.push_back(k > size_ / 2 ? functions[size_ - k]
                                              : EtdFunctions::at({0, -h * kinetic_[k]}));
            const EtdFunctions& f = functions.back();
            whole.push_back(f.whole);
            half.push_back(f.half);
            ofHalf.push_back(h * f.ofHalf);
            twice.push_back(2 * h * f.ofHalf);
            minus.push_back(-h * f.ofHalf);
            first.push_back(h * f.first);
            middle.push_back(h * f.middle);
            last.push_back(h * f.last);
        }
        Numbers free(size_), a(size_), b(size_), c(size_), at0(size_), atA(size_), atB(size_), atC(size_);
        for (int step = 0; step < n; ++step) {
            rate(c_, at0);
            multiply(free, c_, half);
            a = free;
            add(a, at0, ofHalf);
            rate(a, atA);
            b = free;
            add(b, atA, ofHalf);
            rate(b, atB);
            multiply(c, a, half);
            add(c, atB, twice);
            add(c, at0, minus);
            rate(c, atC);
            multiply(c_, c_, whole);
            add(c_, at0, first);
            add(c_, atA, middle);
            add(c_, atB, middle);
            add(c_, atC, last);
        }
        return result();
    }

private:
    static double* parts(Numbers& x) { return reinterpret_cast<double*>(x.data()); }
    static const double* parts(const Numbers& x) { return reinterpret_cast<const double*>(x.data()); }
    static const Fourier& measured(const Hamiltonian& h) {
        static std::map<int, Fourier> all;
        return all.try_emplace(h.size(), h.grid(), Fourier::Planning::measured).first->second;
    }
    void multiply(Numbers& to, const Numbers& from, const Numbers& by) const {
        ForThisMachine<&multiplyComplex>::call()(parts(to), parts(from), parts(by), 2 * size_);
    }
    void add(Numbers& to, const Numbers& from, const Numbers& by) const {
        ForThisMachine<&addComplex>::call()(parts(to), parts(from), parts(by), 2 * size_);
    }
    void kick(double t) {
        fourier_.rawToNodes(c_.data(), psi_.data());
        ForThisMachine<&turnByDensity>::call()(parts(psi_), t / length_, 1 / static_cast<double>(size_),
                                               2 * size_);
        fourier_.rawToCoefficients(psi_.data(), c_.data());
    }
    void rate(const Numbers& c, Numbers& to) {
        fourier_.rawToNodes(c.data(), psi_.data());
        ForThisMachine<&rateByDensity>::call()(parts(psi_), 1 / (length_ * static_cast<double>(size_)),
                                               2 * size_);
        fourier_.rawToCoefficients(psi_.data(), to.data());
    }
    std::vector<double> result() const { return {parts(c_), parts(c_) + 2 * size_}; }

    const std::vector<double>& kinetic_;
    std::size_t size_;
    double length_;
    const Fourier& fourier_;
    Numbers c_, psi_;
};

}  // namespace extremal::bench
