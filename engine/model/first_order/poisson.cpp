// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/first_order/poisson.hpp"

#include <cmath>
#include <cstddef>

namespace extremal {

PoissonEquations::PoissonEquations(const PoissonStructure& of) : of_(of) {
    const auto m = static_cast<std::size_t>(of.variables);
    gradient_ = Eigen::VectorXd::Zero(of.variables);
    entries_.assign(m * m, 0);
    slopes_.assign(m * m * m, 0);
    J_ = hessian_ = jacobian_ = Matrix::Zero(of.variables, of.variables);
}

void PoissonEquations::evaluate(const double* x, bool withSlopes) {
    of_.structure(of_.model.get(), x, entries_.data(), withSlopes ? slopes_.data() : nullptr);
    J_ = Eigen::Map<const Matrix>(entries_.data(), of_.variables, of_.variables).transpose();
}

const Eigen::MatrixXd& PoissonEquations::structure(const double* x) {
    evaluate(x, false);
    return J_;
}

bool PoissonEquations::rate(const double* x, double* dx) {
    double value = 0;
    evaluate(x, false);
    of_.energy(of_.model.get(), x, &value, gradient_.data(), nullptr);
    Eigen::Map<Eigen::VectorXd> to(dx, of_.variables);
    to.noalias() = J_ * gradient_;
    return to.allFinite();
}

const Eigen::MatrixXd* PoissonEquations::jacobian(const double* x) {
    double value = 0;
    evaluate(x, !of_.isConstant);
    of_.energy(of_.model.get(), x, &value, gradient_.data(), hessian_.data());
    jacobian_.noalias() = J_ * hessian_;
    const auto m = static_cast<std::size_t>(of_.variables);
    for (std::size_t i = 0; i < m && !of_.isConstant; ++i)
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t k = 0; k < m; ++k)
                jacobian_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) +=
                    slopes_[(i * m + j) * m + k] * gradient_(static_cast<Eigen::Index>(j));
    return jacobian_.allFinite() ? &jacobian_ : nullptr;
}

PoissonEquations::Cyclic PoissonEquations::jacobiDefect(const double* x) {
    evaluate(x, true);
    const auto m = static_cast<std::size_t>(of_.variables);
    // sum_l J_al d_l J_bc, and the size of its terms.
    const auto part = [&](std::size_t a, std::size_t b, std::size_t c, double& size) {
        double sum = 0;
        for (std::size_t l = 0; l < m; ++l) {
            const double term = entries_[a * m + l] * slopes_[(b * m + c) * m + l];
            sum += term;
            size += std::abs(term);
        }
        return sum;
    };
    Cyclic worst;
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = i + 1; j < m; ++j)
            for (std::size_t k = j + 1; k < m; ++k) {
                double size = 0;
                const double sum = part(i, j, k, size) + part(j, k, i, size) + part(k, i, j, size);
                const double defect = size > 0 ? std::abs(sum) / size : size;
                if (!(defect <= worst.defect))
                    worst = {defect, static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)};
            }
    return worst;
}

FirstOrder firstOrderOf(const PoissonStructure& of) { return firstOrderBy<PoissonEquations>(of); }

}  // namespace extremal
