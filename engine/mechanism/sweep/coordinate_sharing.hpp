// SPDX-License-Identifier: GPL-3.0-or-later
/// How the coordinates of a mechanism are shared out for a step: n constraints give n coordinates, which
/// depend on the f = d - n free ones, and what that is where the step starts.
///
/// With the columns G_D and G_F of g_q, a motion of the free coordinates has N = -G_D^-1 G_F along with it
/// (Constraint::dependence), and N^T M N for a mass. M = L_vv is constant, or that of the start of some step.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/core/text/archive.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/sweep/null_space_kernel.hpp"

namespace extremal {

class CoordinateSharing {
public:
    using Vector = Eigen::VectorXd;

    CoordinateSharing(const Mechanics<double>& mechanics, const Constraint& constraint);

    int freedoms() const { return d_ - n_; }
    SharedCoordinates shared() const {
        return {d_, n_, order_.data() + n_, order_.data() + 2 * n_, masses_.data(), mechanics_.isSeparable};
    }
    double mass(int k) const {
        return masses_[static_cast<std::size_t>(mechanics_.isSeparable ? k : k * d_ + k)];
    }
    /// The masses at a state, where they are not constant.
    void takeMasses(double t, const double* q, const double* v);
    /// Finds the order, for a curve from q to `end`, and N at q. False where constraints depend on each
    /// other.
    bool share(double t, const double* q, const double* end);
    /// How far a coordinate that depends on others moves with a free one, in the metric of the masses.
    double largest() const;
    /// Takes N from a place, where entry e is N[e * stride], and the factors of its masses.
    void moveTo(const double* N, int stride);
    /// The factors of the masses along N.
    void factorise();

    const std::vector<double>& N() const { return N_; }            ///< n x f
    const std::vector<double>& factor() const { return factor_; }  ///< as in factoriseMasses()
    /// N at other places, by the order at hand.
    const Constraint::AtNodes& dependence() const { return dependence_; }
    int dependent(int c) const { return order_[static_cast<std::size_t>(n_ + c)]; }

    /// Of constant masses: the impulse g_q^T kappa that brings momenta p to M v, v = N s.
    void project(const Vector& p, Vector& impulse) const;

    void checkpoint(Archive& archive);

private:
    using Rows = Mechanism::Rows;

    void takeOrder();

    Mechanics<double> mechanics_;
    Constraint constraint_;
    int d_, n_;
    std::vector<int> order_;  ///< constraints, the coordinates that depend on these, and the others
    Constraint::AtNodes dependence_;
    std::vector<double> N_, factor_, masses_;
    Rows G_[2];  ///< at the start and at the end of a curve, eliminated
    Vector g_, byTime_;
};

}  // namespace extremal
