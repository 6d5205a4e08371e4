// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mesh/equidistribution.hpp"

namespace extremal {

void curvatures(const double* x, const double* u, std::size_t n, std::vector<double>& u_xx) {
    u_xx.resize(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
        u_xx[i] = 2 * ((u[i + 1] - u[i]) / (x[i + 1] - x[i]) - (u[i] - u[i - 1]) / (x[i] - x[i - 1])) /
                  (x[i + 1] - x[i - 1]);
    u_xx[0] = n > 2 ? u_xx[1] : 0;
    u_xx[n - 1] = n > 2 ? u_xx[n - 2] : 0;
}

void equidistribute(const std::vector<double>& x, const std::vector<double>& M, std::vector<double>& nodes) {
    double whole = 0;
    for (std::size_t e = 0; e + 1 < x.size(); ++e) whole += M[e] * (x[e + 1] - x[e]);
    const std::size_t n = nodes.size();
    nodes.front() = x.front();
    nodes.back() = x.back();
    std::size_t e = 0;
    double before = 0, own = M[0] * (x[1] - x[0]);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double wanted = whole * static_cast<double>(i) / static_cast<double>(n - 1);
        while (before + own < wanted && e + 2 < x.size()) {
            before += own;
            ++e;
            own = M[e] * (x[e + 1] - x[e]);
        }
        nodes[i] = x[e] + (wanted - before) / M[e];
    }
}

void smoothDensity(std::vector<double>& M) {
    for (int pass = 0; pass < 3; ++pass) {
        double left = M.front();
        for (std::size_t e = 0; e < M.size(); ++e) {
            const double own = M[e], right = e + 1 < M.size() ? M[e + 1] : own;
            M[e] = (left + 2 * own + right) / 4;
            left = own;
        }
    }
}

}  // namespace extremal
