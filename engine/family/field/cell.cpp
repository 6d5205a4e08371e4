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
    const LobattoBasis alongX(spaceDegree_), alongT(timeDegree_);
    const auto nx = static_cast<std::size_t>(spaceDegree_) + 1,
               nt = static_cast<std::size_t>(timeDegree_) + 1;
    std::vector<double> x(nx), dx(nx), t(nt), dt(nt);
    for (const double xi : space_.c)
        for (const double tau : time_.c) {
            alongX.at(xi, x.data(), dx.data());
            alongT.at(tau, t.data(), dt.data());
            for (std::size_t l = 0; l < nt; ++l)
                for (std::size_t a = 0; a < nx; ++a) {
                    value_.push_back(x[a] * t[l]);
                    slopeX_.push_back(dx[a] * t[l]);
                    slopeT_.push_back(x[a] * dt[l]);
                }
        }
}

double FieldCell::evaluate(int e, double h, const double* z, double* gradient, double* hessian) const {
    const auto m = static_cast<std::size_t>(unknowns());
    const double L = problem_->mesh.size(e), left = problem_->mesh.x[static_cast<std::size_t>(e)];
    if (gradient) std::fill_n(gradient, m, 0.0);
    if (hessian) std::fill_n(hessian, m * m, 0.0);
    double S = 0;
    std::size_t p = 0;
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
            const double a = problem_->coefficient ? problem_->coefficient(left + L * space_.c[i]) : 1;
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
