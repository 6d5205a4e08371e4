#include "engine/wave/spectrum.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/text.hpp"

namespace extremal {

double spectrumTail(const Hamiltonian& h, const Complex* c) {
    double tail = 0, all = 0;
    for (int i = 0; i < h.size(); ++i) {
        const double weight = std::norm(c[i]);
        all += weight;
        if (16 * std::abs(h.fourier().number(i)) > 7 * h.size()) tail += weight;
    }
    return all > 0 ? std::sqrt(tail / all) : 0;
}

std::string resolutionCaution(const Hamiltonian& h, const Complex* c) {
    const double tail = spectrumTail(h, c);
    if (!(tail > 1e-4)) return {};
    return "under-resolved: " + formatNumber(tail, 2) + " of the wave function is in the upper eighth of its " +
           std::to_string(h.size()) + " modes";
}

double meanMomentum(const Hamiltonian& h, const Complex* c) {
    double sum = 0, all = 0;
    for (int i = 0; i < h.size(); ++i) {
        const double weight = std::norm(c[i]);
        all += weight;
        if (2 * i != h.size()) sum += weight * h.fourier().waveNumber(i);
    }
    return h.hbar() * sum / all;
}

NodeMeans nodeMeans(const Hamiltonian& h, const Complex* c, Complex* work) {
    h.fourier().rawToNodes(c, work);
    const double k = 2 * std::numbers::pi / h.domain().length, left = h.domain().left;
    NodeMeans means;
    double all = 0;
    for (std::size_t j = 0; j < h.x().size(); ++j) {
        const double weight = std::norm(work[j]), x = h.x()[j];
        all += weight;
        means.x += weight * x;
        means.cosine += weight * std::cos(k * (x - left) + left);
    }
    means.x /= all;
    means.cosine /= all;
    return means;
}

double currentInTheMiddle(const Hamiltonian& h, const Complex* c, Complex* work, Complex* slope) {
    const int n = h.size();
    const auto middle = static_cast<std::size_t>(n / 2);
    for (int i = 0; i < n; ++i)
        slope[i] = 2 * i == n ? Complex(0) : Complex(0, h.fourier().waveNumber(i)) * c[i];
    h.fourier().toNodes(slope, work);
    const Complex derivative = work[middle];
    h.fourier().toNodes(c, work);
    return h.hbar() / h.mass() * (std::conj(work[middle]) * derivative).imag();
}

}  // namespace extremal
