// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion that is given by a Poisson bracket and a Hamiltonian:
///     x' = J(x) grad H(x),    {f, g} = grad f . J grad g,    J^T = -J,
/// where J obeys Jacobi's identity, sum_l (J_il d_l J_jk + J_jl d_l J_ki + J_kl d_l J_ij) = 0. J may be
/// singular: functions C with J grad C = 0, Casimirs, are constant whatever H is.
///
/// Schemes want an even number m of variables: where the user has an odd number, one more follows them, which
/// is 0 and stays so. Arrays: J_ij at i m + j, its slopes d J_ij / dx_k at (i m + j) m + k; of H gradient[k],
/// Hessian at k m + l.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/first_order/first_order.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct PoissonStructure {
    static constexpr PartInfo part{"poisson", "a Poisson bracket"};

    int variables = 0;                  ///< m
    std::shared_ptr<const void> model;  ///< first argument of the calls below

    /// `slopes` may be null.
    void (*structure)(const void*, const double* x, double* J, double* slopes) = nullptr;
    /// Any of the last two may be null.
    void (*energy)(const void*, const double* x, double* value, double* gradient, double* hessian) = nullptr;
    bool isConstant = false;  ///< J does not depend on x

    struct Casimir {
        std::string name;
        /// C and, unless null, its gradient.
        std::function<double(const double* x, double* gradient)> value;
    };
    std::vector<Casimir> casimirs;  ///< those that the user names
};

/// The equations of a bracket at a state.
class PoissonEquations final : public FirstOrderEquations {
public:
    using Matrix = Eigen::MatrixXd;

    explicit PoissonEquations(const PoissonStructure& of);

    /// J(x).
    const Matrix& structure(const double* x);
    bool rate(const double* x, double* dx) override;
    const Matrix* jacobian(const double* x) override;
    /// The largest term-by-term relative defect of Jacobi's identity at x, and the three variables it is of;
    /// not a number where J is not finite.
    struct Cyclic {
        double defect = 0;
        int i = 0, j = 0, k = 0;
    };
    Cyclic jacobiDefect(const double* x);

private:
    void evaluate(const double* x, bool withSlopes);

    PoissonStructure of_;
    Eigen::VectorXd gradient_;
    std::vector<double> entries_, slopes_;
    Matrix J_, hessian_, jacobian_;
};

FirstOrder firstOrderOf(const PoissonStructure& of);

}  // namespace extremal
