// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/complex_oscillator.hpp"

#include <array>

#include "engine/model/bind.hpp"

namespace extremal {
namespace {

struct ComplexOscillator {
    static constexpr int dimension = 2;
    double re = 1, im = 0;

    template <class T>
    std::array<T, 2> masses() const {
        return {T(1), T(-1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 2>& q) const {
        return (square(q[0]) - square(q[1])) * (re / 2) - q[0] * q[1] * im;
    }
};

}  // namespace

System complexOscillator(std::complex<double> W) {
    System s;
    s.id = "complex-oscillator";
    s.coordinates = {{"x", "real part", "x", "", ""}, {"y", "imaginary part", "y", "", ""}};
    s.parts.set(bindMechanics<double>(ComplexOscillator{W.real(), W.imag()}));
    return s;
}

}  // namespace extremal
