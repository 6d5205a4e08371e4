#include "engine/family/moving_mesh/monitor.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

double Monitor::operator()(double u_x, double u_xx, double u_t, double speed) const {
    switch (kind) {
        case Kind::arclength:
            return std::sqrt(1 + alpha * alpha * (u_x * u_x + beta * u_t * u_t));
        case Kind::curvature:
            return std::pow(1 + alpha * alpha * u_xx * u_xx, 0.25);
        case Kind::actionError:
            break;
    }
    return std::cbrt(1 + alpha * alpha * std::max(0.0, 1 - speed * speed / c2) * u_xx * u_xx);
}

Monitor monitorOf(const Settings& space, double c2) {
    Monitor m;
    const std::string kind = space.text("monitor");
    m.kind = kind == "curvature"      ? Monitor::Kind::curvature
             : kind == "action-error" ? Monitor::Kind::actionError
                                      : Monitor::Kind::arclength;
    const Value* alpha = space.find("alpha");
    if (alpha && alpha->isNumber()) m.alpha = alpha->asNumber();
    m.beta = space.number("beta");
    m.c2 = c2;
    return m;
}

void curvatures(const double* x, const double* u, std::size_t n, std::vector<double>& u_xx) {
    u_xx.resize(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
        u_xx[i] = 2 * ((u[i + 1] - u[i]) / (x[i + 1] - x[i]) - (u[i] - u[i - 1]) / (x[i] - x[i - 1])) /
                  (x[i + 1] - x[i - 1]);
    u_xx[0] = n > 2 ? u_xx[1] : 0;
    u_xx[n - 1] = n > 2 ? u_xx[n - 2] : 0;
}

double automaticAlpha(const Monitor& monitor, const std::vector<double>& x, const std::vector<double>& u) {
    constexpr double share = 0.6;
    std::vector<double> u_xx;
    curvatures(x.data(), u.data(), x.size(), u_xx);
    double integral = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double h = x[i + 1] - x[i];
        integral += monitor.kind == Monitor::Kind::arclength
                        ? std::abs(u[i + 1] - u[i])
                        : h * std::pow(std::abs(u_xx[i] + u_xx[i + 1]) / 2, monitor.power());
    }
    const double length = x.back() - x.front();
    if (!(integral > 1e-12 * length)) return 1;
    return std::pow(share * length / integral, 1 / monitor.power());
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

}  // namespace extremal
