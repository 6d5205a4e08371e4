// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/tangent_space.hpp"

#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/mechanism/mechanism.hpp"

namespace extremal {
namespace {

class AllowedVariations {
public:
    explicit AllowedVariations(const Parts& parts) : mechanism_(parts, LinkedAlgebra::never) {}

    Eigen::MatrixXd basis(double t, const double* x) {
        using Rows = Mechanism::Rows;
        const int d = mechanism_.dimension(), n = mechanism_.constraints(), g = mechanism_.holonomic();
        const auto& L = mechanism_.mechanics();
        Eigen::VectorXd v = Eigen::VectorXd::Zero(d), gradient(2 * d), value(n), byTime(n), rate(n);
        Rows hessian(2 * d, 2 * d), byPlace = Rows::Zero(n, d);
        double lagrangian = 0;
        L.velocity(L.model.get(), t, x, x + d, v.data());
        L.jet(L.model.get(), t, x, v.data(), &lagrangian, gradient.data(), hessian.data());
        mechanism_.conditions(t, x, value, byPlace, byTime);
        // Rows of the conditions on (dq, dp), as columns.
        Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(2 * d, n + g);
        const Eigen::MatrixXd mass = hessian.bottomRightCorner(d, d);
        const Eigen::MatrixXd byMomentum = dense::solve<double>(mass, Eigen::MatrixXd(byPlace.transpose()));
        conditions.topLeftCorner(d, g) = byPlace.topRows(g).transpose();
        conditions.bottomRightCorner(d, n) = byMomentum;
        const Eigen::MatrixXd massRate = hessian.bottomLeftCorner(d, d);
        conditions.topRightCorner(d, n) = -massRate.transpose() * byMomentum;
        for (int i = 0; i < d; ++i) {
            mechanism_.rateAlong(t, x, v, Eigen::VectorXd::Unit(d, i), rate);
            conditions.topRightCorner(d, n).row(i) += rate.transpose();
        }
        return dense::qr<double>(conditions).Q.rightCols(2 * d - n - g);
    }

private:
    Mechanism mechanism_;
};

}  // namespace

TangentBasis tangentBasis(const System& system) {
    if (!system.parts.find<Constraint>() && !system.parts.find<Rolling>()) return {};
    return [allowed = AllowedVariations(system.parts)](double t, const double* x) mutable {
        const Eigen::MatrixXd basis = allowed.basis(t, x);
        return std::vector<double>(basis.data(), basis.data() + basis.size());
    };
}

int freeVariations(const System& system) {
    const Constraint* const constraint = system.parts.find<Constraint>();
    const Rolling* const rolling = system.parts.find<Rolling>();
    return 2 * system.dimension() - 2 * (constraint ? constraint->count() : 0) -
           (rolling ? rolling->count() : 0);
}

}  // namespace extremal
