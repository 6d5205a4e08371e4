// SPDX-License-Identifier: GPL-3.0-or-later
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

double automaticAlpha(const Monitor& monitor, const std::vector<double>& x, const std::vector<double>& u,
                      const std::vector<double>& u_t) {
    constexpr double share = 0.6;
    std::vector<double> u_xx;
    curvatures(x.data(), u.data(), x.size(), u_xx);
    double integral = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double h = x[i + 1] - x[i];
        integral += monitor.kind == Monitor::Kind::arclength
                        ? std::hypot(u[i + 1] - u[i], h * std::sqrt(monitor.beta) * (u_t[i] + u_t[i + 1]) / 2)
                        : h * std::pow(std::abs(u_xx[i] + u_xx[i + 1]) / 2, monitor.power());
    }
    const double length = x.back() - x.front();
    if (!(integral > 1e-12 * length)) return 1;
    return std::pow(share * length / integral, 1 / monitor.power());
}

}  // namespace extremal
