// SPDX-License-Identifier: GPL-3.0-or-later
/// Inner products and sums of complex vectors of any length, against the plain loop in extended precision.
#include <QTest>

#include <cmath>
#include <complex>
#include <vector>

#include "engine/core/algebra/complex_vectors.hpp"
#include "tests/tools/test.hpp"

namespace extremal::complex_vectors_test {
namespace {

using Complex = std::complex<double>;

std::vector<Complex> numbers(std::size_t n, double start) {
    std::vector<Complex> v;
    for (std::size_t i = 0; i < n; ++i)
        v.push_back(
            std::polar(1 + 0.1 * std::sin(start + static_cast<double>(i)), start * static_cast<double>(i)));
    return v;
}

}  // namespace

class ComplexVectorsTest : public QObject {
    Q_OBJECT
private slots:
    void everyLength() {
        const ComplexVectors& vectors = ComplexVectors::ofThisMachine();
        for (const std::size_t n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 1001}) {
            const auto a = numbers(n, 1.3), b = numbers(n, 2.1);
            std::complex<long double> product = 0;
            long double square = 0;
            for (std::size_t i = 0; i < n; ++i) {
                product += std::conj(std::complex<long double>(a[i])) * std::complex<long double>(b[i]);
                square += std::norm(std::complex<long double>(a[i]));
            }
            Complex found;
            double foundSquare = -1;
            vectors.dot(a.data(), b.data(), n, &found);
            vectors.square(a.data(), n, &foundSquare);
            const double size = 1e-15 * (1 + static_cast<double>(n));
            QVERIFY(std::abs(found - Complex(product)) <= size);
            QVERIFY(std::abs(foundSquare - static_cast<double>(square)) <= size);
            // The conjugate is taken of the first: seen failing with the second.
            if (n > 2) QVERIFY(std::abs(found - std::conj(Complex(product))) > 1e-3);
            auto sum = a;
            const Complex factor(0.3, -1.7);
            vectors.add(sum.data(), factor, b.data(), n);
            for (std::size_t i = 0; i < n; ++i) QVERIFY(std::abs(sum[i] - (a[i] + factor * b[i])) < 1e-15);
        }
    }
    /// Whatever the machine: the parts are eight, in this order.
    void bitsAreThoseOfEightParts() {
        const auto a = numbers(1001, 1.3), b = numbers(1001, 2.1);
        double re[8] = {}, im[8] = {};
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t l = 2 * i % 8;
            re[l] += a[i].real() * b[i].real();
            re[l + 1] += a[i].imag() * b[i].imag();
            im[l] += a[i].real() * b[i].imag();
            im[l + 1] += a[i].imag() * b[i].real();
        }
        Complex found;
        ComplexVectors::ofThisMachine().dot(a.data(), b.data(), a.size(), &found);
        QCOMPARE(found.real(), ((re[0] + re[1]) + (re[2] + re[3])) + ((re[4] + re[5]) + (re[6] + re[7])));
        QCOMPARE(found.imag(), ((im[0] - im[1]) + (im[2] - im[3])) + ((im[4] - im[5]) + (im[6] - im[7])));
    }
};

EXTREMAL_TEST(ComplexVectorsTest)
}  // namespace extremal::complex_vectors_test

#include "complex_vectors_test.moc"
