// SPDX-License-Identifier: GPL-3.0-or-later
/// Two steps on moving meshes that the program does not offer, for the record of what they are worth: beside
/// the multiplier method they need no code of their own in the engine, and both are worse.
///
/// prescribed: the mesh is the one that equidistributes the new values, g(y_{k+1}, X_{k+1}) = 0, and the
/// action is stationary in the values alone. Implicit, and as non-variational in X as the explicit method.
/// penalty: nodes are free, and kappa/2 sum g_i^2 is a part of the potential energy.
#pragma once

#include <cmath>
#include <vector>

#include "engine/family/moving_mesh/constraint.hpp"
#include "engine/family/moving_mesh/slab_action.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal::moving {

class OtherStep {
public:
    enum class Kind { prescribed, penalty };

    OtherStep(Kind kind, const NodeSpace& space, const Monitor& monitor, double kappa)
        : kind_(kind),
          space_(space),
          constraint_(monitor, space.n),
          alpha2_(monitor.alpha * monitor.alpha),
          kappa_(kappa),
          action_(space),
          lu_(static_cast<int>(2 * space.n), 5),
          g_(space.n),
          Dg_(space.n),
          residual_(2 * space.n) {}

    /// z and p after the step. False: Newton's method does not converge, or an element is not longer than 0.
    bool advance(std::vector<double>& z, std::vector<double>& p, double h) {
        constexpr int most = 30;
        const std::vector<double> z0 = z;
        std::vector<double> z1 = z;
        if (!before_.empty())
            for (std::size_t k = 0; k < z.size(); ++k) z1[k] = 2 * z[k] - before_[k];
        for (int i = 0; i < most; ++i) {
            evaluate(z0, z1, p, h, true);
            for (const std::size_t end : {std::size_t{0}, space_.n - 1})
                for (std::size_t part = 0; part < 2; ++part) {
                    lu_.fix(static_cast<int>(2 * end + part));
                    residual_[2 * end + part] = 0;
                }
            if (!lu_.factorise()) return false;
            lu_.solve(residual_.data());
            double part = 1, largest = 0;
            const double least = 0.1 * space_.smallestElement(z0.data());
            for (int halvings = 0; halvings < 20 && !isLonger(z1, part, least); ++halvings) part /= 2;
            for (std::size_t k = 0; k < z1.size(); ++k) {
                z1[k] -= part * residual_[k];
                if (!(std::abs(part * residual_[k]) <= largest)) largest = std::abs(part * residual_[k]);
            }
            if (!std::isfinite(largest)) return false;
            if (part == 1 && largest < 1e-10) {
                evaluate(z0, z1, p, h, false);
                for (std::size_t k = 0; k < z1.size(); ++k) p[k] = action_.atEnd(k, h) - h / 2 * force_[k];
                energy_ = action_.energy() + penalty_;
                before_ = z0;
                z = z1;
                return space_.isOrdered(z.data());
            }
        }
        return false;
    }
    /// Of the slab.
    double energy() const { return energy_; }

private:
    bool isLonger(const std::vector<double>& z1, double part, double least) const {
        for (std::size_t e = 0; e + 1 < space_.n; ++e) {
            const double now = z1[2 * e + 3] - z1[2 * e + 1];
            if (now - part * (residual_[2 * e + 3] - residual_[2 * e + 1]) < least) return false;
        }
        return true;
    }

    void evaluate(const std::vector<double>& z0, const std::vector<double>& z1, const std::vector<double>& p,
                  double h, bool withJacobian) {
        const bool isPenalty = kind_ == Kind::penalty;
        const std::size_t n = space_.n;
        if (withJacobian) lu_.clear();
        Cost cost;
        const auto add = [this](std::size_t i, std::size_t j, double value) {
            lu_.add(static_cast<int>(i), static_cast<int>(j), value);
        };
        action_.evaluate(z0, z1, h, withJacobian, cost,
                         [&](std::size_t e, std::size_t a, std::size_t b, double value) {
                             if (isPenalty || a % 2 == 0) add(2 * e + a, 2 * e + b, value);
                         });
        std::vector<double> at = z1;
        for (std::size_t k = 0; k < at.size() && isPenalty; ++k) at[k] = (z0[k] + z1[k]) / 2;
        constraint_.evaluate(at.data(), g_, Dg_);
        force_.assign(2 * n, 0);  // of the penalty: its gradient
        penalty_ = 0;
        for (std::size_t i = 1; i + 1 < n && isPenalty; ++i) {
            penalty_ += kappa_ / 2 * g_[i] * g_[i];
            for (std::size_t a = 2; a < 8; ++a) force_[2 * i + a - 4] += kappa_ * g_[i] * Dg_[i][a];
        }
        for (std::size_t k = 0; k < 2 * n; ++k) {
            const bool isMesh = !isPenalty && k % 2 == 1;
            residual_[k] = isMesh ? g_[k / 2] : p[k] + action_.atStart(k, h) - h / 2 * force_[k];
        }
        if (!withJacobian) return;
        for (std::size_t i = 1; i + 1 < n; ++i)
            for (std::size_t a = 2; a < 8; ++a) {
                if (!isPenalty) {
                    add(2 * i + 1, 2 * i + a - 4, Dg_[i][a]);
                    continue;
                }
                for (std::size_t b = 2; b < 8; ++b)
                    add(2 * i + a - 4, 2 * i + b - 4, -h / 4 * kappa_ * Dg_[i][a] * Dg_[i][b]);
                // the second derivatives of g_i = m_i - m_{i-1}, m_e = alpha^2 dy^2 + h^2
                for (const auto& [e, sign] : {std::pair{i, 1.0}, std::pair{i - 1, -1.0}}) {
                    if (a != 2 && a != 3) break;  // once for y and once for X
                    const std::size_t left = 2 * e + a % 2, right = left + 2;
                    const double own = -h / 4 * kappa_ * g_[i] * sign * 2 * (a % 2 == 0 ? alpha2_ : 1);
                    add(left, left, own);
                    add(right, right, own);
                    add(left, right, -own);
                    add(right, left, -own);
                }
            }
    }

    Kind kind_;
    NodeSpace space_;
    MeshConstraint constraint_;
    double alpha2_, kappa_, energy_ = 0, penalty_ = 0;
    SlabAction action_;
    BandLu lu_;
    std::vector<double> g_;
    std::vector<MeshConstraint::Row> Dg_;
    std::vector<double> residual_, force_, before_;
};

}  // namespace extremal::moving
