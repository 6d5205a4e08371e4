// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/static_problem.hpp"

#include <algorithm>
#include <cmath>

#include "engine/model/typed/typed_function.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

constexpr int gaussNodes = 8;

struct PointValues {
    double W, W_u, W_x, W_uu;
};

PointValues valuesAt(const StaticProblem& problem, double x, double u) {
    const double y[2] = {u, x};
    double value, gradient[2], hessian[3];
    problem.W->evaluate(y, &value, gradient, hessian);
    return {value, gradient[0], gradient[1], hessian[0]};
}

}  // namespace

StaticElement staticElement(const StaticProblem& problem, const double* z) {
    static const Rule<double> rule = gauss<double>(gaussNodes);
    const double uL = z[0], xL = z[1], uR = z[2], xR = z[3], h = xR - xL, s = (uR - uL) / h,
                 k = problem.stiffness;
    double W = 0, I0 = 0, I1 = 0, J00 = 0, J01 = 0, J11 = 0;
    double from = xL;
    auto jump = std::upper_bound(problem.jumps.begin(), problem.jumps.end(), xL);
    while (from < xR) {
        const bool cuts = jump != problem.jumps.end() && *jump < xR;
        const double to = cuts ? *jump++ : xR;
        const double panels = std::max(1.0, std::ceil((to - from) / problem.resolution)),
                     width = (to - from) / panels;
        for (double p = 0; p < panels; ++p)
            for (std::size_t q = 0; q < rule.c.size(); ++q) {
                const double x = from + (p + rule.c[q]) * width, xi = (x - xL) / h, w = rule.b[q] * width;
                const PointValues at = valuesAt(problem, x, uL + (uR - uL) * xi);
                W += w * at.W;
                I0 += w * at.W_u * (1 - xi);
                I1 += w * at.W_u * xi;
                J00 += w * at.W_uu * (1 - xi) * (1 - xi);
                J01 += w * at.W_uu * (1 - xi) * xi;
                J11 += w * at.W_uu * xi * xi;
            }
        from = to;
    }
    // Of both ends, seen from inside.
    const double inside = 1e-12 * h;
    const PointValues atL = valuesAt(problem, xL + inside, uL), atR = valuesAt(problem, xR - inside, uR);
    StaticElement e;
    e.energy = k * s * s * h / 2 + W;
    e.gradient = {-k * s + I0, -atL.W - s * I0 + k * s * s / 2, k * s + I1, atR.W - s * I1 - k * s * s / 2};
    const std::array<double, 4> ds = {-1 / h, s / h, 1 / h, -s / h},
                                dI0 = {J00, -atL.W_u - s * J00 + I0 / h, J01, -s * J01 + I1 / h},
                                dI1 = {J01, -s * J01 - I0 / h, J11, atR.W_u - s * J11 - I1 / h},
                                dL = {atL.W_u, atL.W_x, 0, 0}, dR = {0, 0, atR.W_u, atR.W_x};
    for (std::size_t j = 0; j < 4; ++j) {
        e.hessian[0][j] = -k * ds[j] + dI0[j];
        e.hessian[1][j] = -dL[j] - ds[j] * I0 - s * dI0[j] + k * s * ds[j];
        e.hessian[2][j] = k * ds[j] + dI1[j];
        e.hessian[3][j] = dR[j] - ds[j] * I1 - s * dI1[j] - k * s * ds[j];
    }
    return e;
}

}  // namespace extremal
