// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/constraint.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

MeshConstraint::MeshConstraint(const Monitor& monitor, std::size_t nodes)
    : monitor_(monitor),
      n_(nodes),
      width_(monitor.kind == Monitor::Kind::arclength ? 1 : 2),
      m_(nodes - 1),
      slope_(nodes - 1) {}

void MeshConstraint::measure(const double* z) {
    const double a2 = monitor_.alpha * monitor_.alpha;
    if (monitor_.kind == Monitor::Kind::arclength) {
        for (std::size_t e = 0; e + 1 < n_; ++e) {
            const double dy = z[2 * e + 2] - z[2 * e], h = z[2 * e + 3] - z[2 * e + 1];
            m_[e] = a2 * dy * dy + h * h;
            slope_[e] = {0, 0, -2 * a2 * dy, -2 * h, 2 * a2 * dy, 2 * h, 0, 0};
        }
        return;
    }
    // M^2 = (1 + a2 K)^q with K the mean of the squared curvatures at both ends; at the ends of the mesh
    // that of the inner one. The curvature at node i is 2 (s_i - s_{i-1}) / (X_{i+1} - X_{i-1}).
    const double q = monitor_.power();
    for (std::size_t e = 0; e + 1 < n_; ++e) {
        const double h = z[2 * e + 3] - z[2 * e + 1];
        double K = 0;
        std::array<double, 8> dK{};
        const std::size_t first = std::max<std::size_t>(e, 1), last = std::min(e + 1, n_ - 2);
        const double share = first == last ? 1 : 0.5;
        for (std::size_t i = first; i <= last; ++i) {
            const double* left = z + 2 * (i - 1);
            const double hl = left[3] - left[1], hr = left[5] - left[3], both = hl + hr;
            const double sl = (left[2] - left[0]) / hl, sr = (left[4] - left[2]) / hr;
            const double k = 2 * (sr - sl) / both;
            K += share * k * k;
            const double by[6] = {2 / (both * hl),
                                  (k - 2 * sl / hl) / both,
                                  -2 / (both * hl) - 2 / (both * hr),
                                  2 * (sl / hl + sr / hr) / both,
                                  2 / (both * hr),
                                  (-k - 2 * sr / hr) / both};
            const std::size_t offset = 2 * (i - 1 + 1 - e);  // of node i - 1 among e - 1 .. e + 2
            for (std::size_t j = 0; j < 6; ++j) dK[offset + j] += share * 2 * k * by[j];
        }
        const double base = 1 + a2 * K, M2 = std::pow(base, q);
        m_[e] = h * h * M2;
        const double byK = h * h * q * M2 / base * a2;
        for (std::size_t j = 0; j < 8; ++j) slope_[e][j] = byK * dK[j];
        slope_[e][3] -= 2 * h * M2;
        slope_[e][5] += 2 * h * M2;
    }
}

void MeshConstraint::evaluate(const double* z, std::vector<double>& g) {
    measure(z);
    g[0] = g[n_ - 1] = 0;
    for (std::size_t i = 1; i + 1 < n_; ++i) g[i] = m_[i] - m_[i - 1];
}

void MeshConstraint::evaluate(const double* z, std::vector<double>& g, std::vector<Row>& Dg) {
    evaluate(z, g);
    Dg[0] = Dg[n_ - 1] = {};
    for (std::size_t i = 1; i + 1 < n_; ++i) {
        Row& row = Dg[i];
        row = {};
        // nodes i - 1 .. i + 2 of element i, and i - 2 .. i + 1 of element i - 1, among i - 2 .. i + 2
        for (std::size_t j = 0; j < 8; ++j) {
            row[j + 2] += slope_[i][j];
            row[j] -= slope_[i - 1][j];
        }
    }
}

void MeshConstraint::addTransposed(const std::vector<Row>& Dg, const std::vector<double>& lambda,
                                   double factor, std::vector<double>& to) const {
    for (std::size_t i = 1; i + 1 < n_; ++i)
        for (std::size_t k = mostWidth - width_; k <= mostWidth + width_; ++k) {
            if (i + k < mostWidth || i + k - mostWidth >= n_) continue;
            const std::size_t j = 2 * (i + k - mostWidth);
            to[j] += factor * lambda[i] * Dg[i][2 * k];
            to[j + 1] += factor * lambda[i] * Dg[i][2 * k + 1];
        }
}

double MeshConstraint::residual(const double* z) {
    measure(z);
    double mean = 0, most = 0;
    for (const double m : m_) mean += m / static_cast<double>(n_ - 1);
    for (std::size_t i = 1; i + 1 < n_; ++i) most = std::max(most, std::abs(m_[i] - m_[i - 1]));
    return most / mean;
}

}  // namespace extremal
