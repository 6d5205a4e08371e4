// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/cell.hpp"

#include <algorithm>

namespace extremal {

FieldCell::FieldCell(const FieldProblem& problem, int timeDegree, const Rule<double>& space,
                     const Rule<double>& time)
    : problem_(&problem),
      spaceDegree_(problem.nodes.degree),
      timeDegree_(timeDegree),
      space_(space),
      time_(time) {
    const ElementFunctions* const own = problem.functions.get();
    const LobattoBasis alongX(spaceDegree_), alongT(timeDegree_);
    const auto nx = static_cast<std::size_t>(spaceDegree_) + 1,
               nt = static_cast<std::size_t>(timeDegree_) + 1;
    std::vector<double> x(nx), dx(nx), t(nt), dt(nt);
    const auto addPoints = [&] {
        for (const double tau : time_.c) {
            alongT.at(tau, t.data(), dt.data());
            for (std::size_t l = 0; l < nt; ++l)
                for (std::size_t a = 0; a < nx; ++a) {
                    value_.push_back(x[a] * t[l]);
                    slopeX_.push_back(dx[a] * t[l]);
                    slopeT_.push_back(x[a] * dt[l]);
                }
        }
    };
    if (!own) {
        for (const double xi : space_.c) {
            alongX.at(xi, x.data(), dx.data());
            addPoints();
        }
        return;
    }
    // The rule on each part of an element, as in SpatialForm.
    for (int e = 0; e < problem.mesh.elements(); ++e)
        for (int k = 0; k < own->parts; ++k)
            for (const double c : space.c) {
                const double from = own->at(e, k), to = own->at(e, k + 1), phi = from + c * (to - from);
                x = {1 - phi, phi};
                dx = {(from - to) * own->parts, (to - from) * own->parts};
                addPoints();
            }
    space_.c.clear();
    space_.b.clear();
    for (int k = 0; k < own->parts; ++k)
        for (std::size_t q = 0; q < space.c.size(); ++q) {
            space_.c.push_back((k + space.c[q]) / own->parts);
            space_.b.push_back(space.b[q] / own->parts);
        }
}

double FieldCell::evaluate(int e, double h, const double* z, double* gradient, double* hessian) const {
    const auto m = static_cast<std::size_t>(unknowns());
    const double L = problem_->mesh.size(e), left = problem_->mesh.x[static_cast<std::size_t>(e)];
    if (gradient) std::fill_n(gradient, m, 0.0);
    if (hessian) std::fill_n(hessian, m * m, 0.0);
    const ElementFunctions* const own = problem_->functions.get();
    const std::size_t rule = own ? space_.c.size() / static_cast<std::size_t>(own->parts) : 1;
    double S = 0;
    std::size_t p = own ? static_cast<std::size_t>(e) * space_.c.size() * time_.c.size() : 0;
    for (std::size_t i = 0; i < space_.c.size(); ++i)
        for (std::size_t j = 0; j < time_.c.size(); ++j, ++p) {
            const double *phi = &value_[p * m], *phiX = &slopeX_[p * m], *phiT = &slopeT_[p * m];
            double u = 0, ux = 0, ut = 0;
            for (std::size_t k = 0; k < m; ++k) {
                u += phi[k] * z[k];
                ux += phiX[k] * z[k];
                ut += phiT[k] * z[k];
            }
            ux /= L;
            ut /= h;
            const double weight = h * L * space_.b[i] * time_.b[j];
            const double a = own ? own->coefficient[static_cast<std::size_t>(e * own->parts) + i / rule]
                             : problem_->coefficient ? problem_->coefficient(left + L * space_.c[i])
                                                     : 1;
            const Elasticity::Values elastic = problem_->elastic.at(ux);
            double W = 0, slope = 0, curvature = 0;
            problem_->potential.evaluate(&u, 1, &W, &slope, &curvature);
            S += weight * (ut * ut / 2 - a * elastic.energy - W);
            if (gradient)
                for (std::size_t k = 0; k < m; ++k)
                    gradient[k] +=
                        weight * (ut * phiT[k] / h - a * elastic.stress * phiX[k] / L - slope * phi[k]);
            if (hessian)
                for (std::size_t k = 0; k < m; ++k)
                    for (std::size_t n = 0; n < m; ++n)
                        hessian[k * m + n] += weight * (phiT[k] * phiT[n] / (h * h) -
                                                        a * elastic.modulus * phiX[k] * phiX[n] / (L * L) -
                                                        curvature * phi[k] * phi[n]);
        }
    return S;
}

}  // namespace extremal
