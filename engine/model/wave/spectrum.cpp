#include "engine/model/wave/spectrum.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/text.hpp"
#include "engine/model/wave/interval.hpp"

namespace extremal {
namespace {

/// sum_i row_i c_i.
Complex combined(const double* row, Eigen::Index stride, const Complex* c, int n) {
    double re = 0, im = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        re += row[i * stride] * c[i].real();
        im += row[i * stride] * c[i].imag();
    }
    return {re, im};
}
Complex atPoint(const Eigen::MatrixXd& basis, Eigen::Index k, const Complex* c) {
    return combined(basis.data() + k * basis.rows(), 1, c, static_cast<int>(basis.rows()));
}

}  // namespace

Complex chebyshevCoefficient(const Hamiltonian& h, const Complex* c, int k) {
    const Eigen::MatrixXd& T = h.interval().coefficient;
    return combined(T.data() + k, T.rows(), c, h.size()) / std::sqrt(h.domain().length / 2);
}

double spectrumTail(const Hamiltonian& h, const Complex* c) {
    double tail = 0, all = 0;
    const auto add = [&](double weight, bool isInTail) {
        all += weight;
        if (isInTail) tail += weight;
    };
    if (h.isPeriodic()) {
        const Fourier& f = h.fourier();
        for (int i = 0; i < h.size(); ++i)
            add(std::norm(c[i]), 16 * std::abs(f.number(i)) > 7 * h.grid().nx ||
                                     (h.isPlane() && 16 * std::abs(f.numberY(i)) > 7 * h.grid().ny));
    } else {
        const int N = h.size() + 1;
        for (int k = 0; k <= N; ++k) add(std::norm(chebyshevCoefficient(h, c, k)), 8 * k > 7 * N);
    }
    return all > 0 ? std::sqrt(tail / all) : 0;
}

std::string resolutionCaution(const Hamiltonian& h, const Complex* c) {
    const double tail = spectrumTail(h, c);
    if (!(tail > 1e-4)) return {};
    return "under-resolved: " + formatNumber(tail, 2) +
           " of the wave function is in the upper eighth of its " + std::to_string(h.grid().nx) +
           (h.isPlane() ? " x " + std::to_string(h.grid().ny) : std::string()) + " modes";
}

MeanMomentum meanMomentum(const Hamiltonian& h, const Complex* c) {
    if (!h.isPeriodic()) {
        double sum = 0;
        const Interval& I = h.interval();
        for (Eigen::Index k = 0; k < I.points.size(); ++k)
            sum += I.weights(k) * (std::conj(atPoint(I.values, k, c)) * atPoint(I.slopes, k, c)).imag();
        return {h.hbar() * sum / (h.domain().length / 2) / squaredNorm(c, h.size())};
    }
    const Fourier& f = h.fourier();
    double x = 0, y = 0, all = 0;
    for (int i = 0; i < h.size(); ++i) {
        const double weight = std::norm(c[i]);
        all += weight;
        if (2 * f.number(i) != -h.grid().nx) x += weight * f.waveNumber(i);
        if (2 * f.numberY(i) != -h.grid().ny) y += weight * f.waveNumberY(i);
    }
    return {h.hbar() * x / all, h.hbar() * y / all};
}

NodeMeans nodeMeans(const Hamiltonian& h, const Complex* c, Complex* work) {
    const double k = 2 * std::numbers::pi / h.domain().length, left = h.domain().left;
    NodeMeans means;
    double all = 0;
    const auto add = [&](double x, double y, double weight) {
        all += weight;
        means.x += weight * x;
        means.y += weight * y;
        means.cosine += weight * std::cos(k * (x - left) + left);
    };
    if (h.isPeriodic()) {
        h.toNodes(c, work);
        for (const double y : h.y())
            for (const double x : h.x()) add(x, y, std::norm(*work++));
    } else {
        const Interval& I = h.interval();
        for (Eigen::Index i = 0; i < I.points.size(); ++i)
            add(left + (1 + I.points(i)) * h.domain().length / 2, 0,
                I.weights(i) * std::norm(atPoint(I.values, i, c)));
    }
    means.x /= all;
    means.y /= all;
    means.cosine /= all;
    return means;
}

double currentInTheMiddle(const Hamiltonian& h, const Complex* c, Complex* work, Complex* slope) {
    const int n = h.size();
    if (!h.isPeriodic()) {
        const double half = h.domain().length / 2;
        const Interval& I = h.interval();
        return h.hbar() / (h.mass() * half * half) *
               (std::conj(atPoint(I.values, n + 1, c)) * atPoint(I.slopes, n + 1, c)).imag();
    }
    const wave::Grid& grid = h.grid();
    for (int i = 0; i < n; ++i)
        slope[i] =
            2 * h.fourier().number(i) == -grid.nx ? Complex(0) : Complex(0, h.fourier().waveNumber(i)) * c[i];
    h.fourier().toNodes(slope, work);
    // The slopes on the line make room for the values.
    for (int j = 0; j < grid.ny; ++j) slope[j] = work[grid.nx / 2 + j * grid.nx];
    h.toNodes(c, work);
    double sum = 0;
    for (int j = 0; j < grid.ny; ++j) sum += (std::conj(work[grid.nx / 2 + j * grid.nx]) * slope[j]).imag();
    return h.hbar() / h.mass() * sum * grid.y.length / grid.ny;
}

}  // namespace extremal
