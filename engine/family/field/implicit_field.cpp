// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/family/field/field_step.hpp"
#include "engine/family/field/mass_matrix.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace {

/// The levels U_1 .. U_s of a slab from u = U_0 and p = M v, with d_m = U_m - u:
///
///     R_l = [l = 0] M v + M sum_m mass(l, m) d_m / h - h sum_q b_q psi_l(c_q) dU/du(P_q) = 0, l = 0 .. s-1,
///     P_q = u + sum_m psi_m(c_q) d_m,
///     M v' = M sum_m mass(s, m) d_m / h - h sum_q b_q psi_s(c_q) dU/du(P_q).
/// Unknowns are ordered node by node, so that the Jacobian is banded. It is kept while it contracts.
class ImplicitField final : public FieldStep {
public:
    ImplicitField(std::shared_ptr<const SpatialForm> shape, const TimeTable& time, double step,
                  double tolerance, int maxIterations)
        : FieldStep(std::move(shape), step),
          time_(time),
          tolerance_(tolerance),
          maxIterations_(maxIterations),
          mass_(form()),
          order_(form().problem().nodes),
          s_(static_cast<std::size_t>(time.degree())) {
        const std::size_t size = n();
        const int s = time.degree();
        lu_ = BandLu(form().size() * s, order_.reach * s + s - 1);
        change_.resize(s_ * size);
        unknowns_.resize(s_ * size);
        momentum_.resize(size);
        for (auto* v : {&work_, &at_, &force_}) v->resize(size);
        forces_.resize(static_cast<std::size_t>(time.points()) * size);
        const auto width = static_cast<std::size_t>(form().width());
        hessian_.resize(static_cast<std::size_t>(form().problem().mesh.elements()) * width * width);
        for (int i = 0; i < form().size(); ++i) isFixed_.push_back(form().problem().isFixed(i));
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ImplicitField>(*this); }
    /// The factors of an earlier step, as long as they are good enough.
    bool checkpoint(Archive& archive) override {
        const bool isKnown = FieldStep::checkpoint(archive);
        archive(hasJacobian_);
        if (hasJacobian_) archive(lu_);
        return isKnown;
    }

private:
    void prepare() override { hasJacobian_ = false; }

    Outcome step(const double* u, double* next, StepReport& report) override {
        const std::size_t size = n();
        const double* v = u + size;
        form().applyMass(v, momentum_.data());
        for (std::size_t l = 0; l < s_; ++l)
            for (std::size_t i = 0; i < size; ++i)
                change_[l * size + i] = isFixed_[i] ? 0 : time_.level(static_cast<int>(l) + 1) * h() * v[i];
        const Outcome outcome = iterate(u, report);
        if (outcome != Outcome::converged) {
            hasJacobian_ = false;
            return outcome;
        }
        finish(u, v, next, report.cost);
        return Outcome::converged;
    }

    Outcome iterate(const double* u, StepReport& report) {
        // Linear equations are solved by one correction; a second one takes its round-off.
        const bool isLinear = form().problem().isLinear();
        NewtonPolicy<double> policy(NewtonLimits<double>::condensedStep(
            std::max(tolerance_, std::numeric_limits<double>::epsilon()), true));
        for (int iteration = 0; iteration < maxIterations_; ++iteration) {
            if (stop().stop_requested()) return Outcome::stopped;
            evaluate(u, report.cost);
            if (!hasJacobian_) {
                hasJacobian_ = factorise(u, lu_);
                if (!hasJacobian_) return Outcome::singular;
                policy.jacobianIsNew();
                ++report.cost.linearSolves;
            }
            const double size = correct(u);
            ++report.cost.iterations;
            ++report.cost.linearSolves;
            report.residual = size;
            if (isLinear && std::isfinite(size)) {
                if (!time_.isBalanced()) evaluate(u, report.cost);
                return Outcome::converged;
            }
            const NewtonVerdict verdict = policy.judge(size);
            if (const auto end = endOf(verdict)) {
                if (*end == Outcome::converged && !time_.isBalanced()) evaluate(u, report.cost);
                return *end;
            }
            hasJacobian_ = verdict != NewtonVerdict::slow;
        }
        return Outcome::diverged;
    }

    void placeAt(const double* u, int q) {
        const std::size_t size = n();
        std::copy_n(u, size, at_.begin());
        for (int m = 1; m <= time_.degree(); ++m) {
            const double value = time_.value(q, m);
            const double* d = change_.data() + static_cast<std::size_t>(m - 1) * size;
            for (std::size_t i = 0; i < size; ++i) at_[i] += value * d[i];
        }
    }
    /// The forces at all points in time.
    void evaluate(const double* u, Cost& cost) {
        std::fill(forces_.begin(), forces_.end(), 0.0);
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(u, q);
            form().addForce(at_.data(), 1, forces_.data() + static_cast<std::size_t>(q) * n());
            cost.evaluations += form().evaluations();
        }
    }
    bool factorise(const double* u, BandLu& lu) {
        const int s = time_.degree(), width = form().width();
        const FieldNodes& nodes = form().problem().nodes;
        lu.clear();
        const auto row = [&](int node, int l) {
            return order_.place[static_cast<std::size_t>(node)] * s + l;
        };
        forEachPair(nodes, [&](int i, int j, int a, int b, int e) {
            const double m = form().elementSize(e) * form().elementMass(e)[a * width + b];
            for (int l = 0; l < s; ++l)
                for (int k = 1; k <= s; ++k) lu.add(row(i, l), row(j, k - 1), time_.mass(l, k) / h() * m);
        });
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(u, q);
            form().hessians(at_.data(), hessian_.data());
            forEachPair(nodes, [&](int i, int j, int a, int b, int e) {
                const double H = hessian_[static_cast<std::size_t>((e * width + a) * width + b)];
                for (int l = 0; l < s; ++l)
                    for (int k = 1; k <= s; ++k)
                        lu.add(row(i, l), row(j, k - 1),
                               -h() * time_.weight(q) * time_.value(q, l) * time_.value(q, k) * H);
            });
        }
        for (std::size_t i = 0; i < isFixed_.size(); ++i)
            for (int l = 0; l < s && isFixed_[i]; ++l) lu.fix(row(static_cast<int>(i), l));
        return lu.factorise();
    }
    /// One correction of all levels; its size relative to the changes in the slab.
    double correct(const double* u) {
        const std::size_t size = n();
        const int s = time_.degree();
        for (int l = 0; l < s; ++l) {
            combine(l);
            form().applyMass(work_.data(), force_.data());
            for (std::size_t i = 0; i < size; ++i) {
                double residual = force_[i] + (l == 0 ? momentum_[i] : 0);
                for (int q = 0; q < time_.points(); ++q)
                    residual += h() * time_.weight(q) * time_.value(q, l) *
                                forces_[static_cast<std::size_t>(q) * size + i];
                unknowns_[static_cast<std::size_t>(order_.place[i] * s + l)] = isFixed_[i] ? 0 : -residual;
            }
        }
        lu_.solve(unknowns_.data());
        double largest = 0, increments = 0, value = 0;
        for (std::size_t l = 0; l < s_; ++l)
            for (std::size_t i = 0; i < size; ++i) {
                const double delta = unknowns_[static_cast<std::size_t>(order_.place[i]) * s_ + l];
                double& d = change_[l * size + i];
                d += delta;
                if (!(std::abs(delta) <= largest)) largest = std::abs(delta);
                increments = std::max(increments, std::abs(d));
                value = std::max(value, std::abs(u[i]));
            }
        return relativeCorrection(largest, increments, value);
    }
    /// work = sum_m mass(l, m) d_m / h.
    void combine(int l) {
        const std::size_t size = n();
        std::fill(work_.begin(), work_.end(), 0.0);
        for (int m = 1; m <= time_.degree(); ++m) {
            const double factor = time_.mass(l, m) / h();
            const double* d = change_.data() + static_cast<std::size_t>(m - 1) * size;
            for (std::size_t i = 0; i < size; ++i) work_[i] += factor * d[i];
        }
    }
    /// The end of the slab. With the midpoint rule v' = 2 d/h - v, whatever M is.
    void finish(const double* u, const double* v, double* next, Cost& cost) {
        const std::size_t size = n();
        const int s = time_.degree();
        double* nextV = next + size;
        const double* d = change_.data() + (s_ - 1) * size;
        for (std::size_t i = 0; i < size; ++i) next[i] = u[i] + d[i];
        if (time_.isBalanced()) {
            for (std::size_t i = 0; i < size; ++i) nextV[i] = isFixed_[i] ? 0 : 2 * d[i] / h() - v[i];
            return;
        }
        combine(s);
        std::fill(force_.begin(), force_.end(), 0.0);
        for (int q = 0; q < time_.points(); ++q)
            for (std::size_t i = 0; i < size; ++i)
                force_[i] += h() * time_.weight(q) * time_.value(q, s) *
                             forces_[static_cast<std::size_t>(q) * size + i];
        mass_.solve(force_.data());
        if (!form().isLumped()) ++cost.linearSolves;
        for (std::size_t i = 0; i < size; ++i) nextV[i] = isFixed_[i] ? 0 : work_[i] + force_[i];
    }
    /// The equations of the levels at the solution, linearised; the factors of the iteration are those of its
    /// beginning.
    bool hasVariations() const override { return true; }
    bool linearise() override {
        const int s = time_.degree();
        if (hessians_.empty()) {
            tangent_ = BandLu(form().size() * s, order_.reach * s + s - 1);
            hessians_.resize(static_cast<std::size_t>(time_.points()));
        }
        for (int q = 0; q < time_.points(); ++q) {
            placeAt(before().data(), q);
            hessians_[static_cast<std::size_t>(q)] = hessianAt(at_.data());
        }
        return factorise(before().data(), tangent_);
    }
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        const std::size_t size = n();
        const int s = time_.degree();
        for (int l = 0; l < s; ++l) {
            std::fill(force_.begin(), force_.end(), 0.0);
            for (int q = 0; q < time_.points(); ++q)
                addForceChange(hessians_[static_cast<std::size_t>(q)], du.data(),
                               h() * time_.weight(q) * time_.value(q, l), force_.data());
            for (std::size_t i = 0; i < size; ++i)
                unknowns_[static_cast<std::size_t>(order_.place[i] * s + l)] =
                    isFixed_[i] ? 0 : -(force_[i] + (l == 0 ? dp[i] : 0));
        }
        tangent_.solve(unknowns_.data());
        const auto level = [&](int m, std::size_t i) {
            return unknowns_[static_cast<std::size_t>(order_.place[i] * s + m - 1)];
        };
        if (time_.isBalanced()) {
            for (std::size_t i = 0; i < size; ++i) work_[i] = 2 / h() * level(s, i);
            form().applyMass(work_.data(), force_.data());
            for (std::size_t i = 0; i < size; ++i) dp[i] = isFixed_[i] ? 0 : force_[i] - dp[i];
        } else {
            std::fill(work_.begin(), work_.end(), 0.0);
            for (int m = 1; m <= s; ++m)
                for (std::size_t i = 0; i < size; ++i) work_[i] += time_.mass(s, m) / h() * level(m, i);
            form().applyMass(work_.data(), dp.data());
            for (int q = 0; q < time_.points(); ++q) {
                at_ = du;
                for (int m = 1; m <= s; ++m)
                    for (std::size_t i = 0; i < size; ++i) at_[i] += time_.value(q, m) * level(m, i);
                addForceChange(hessians_[static_cast<std::size_t>(q)], at_.data(),
                               h() * time_.weight(q) * time_.value(q, s), dp.data());
            }
        }
        for (std::size_t i = 0; i < size; ++i) du[i] += level(s, i);
    }
    double slabEnergy(const double* u, const double*) const override {
        const std::size_t size = n();
        std::vector<double> at(size), velocity(size);
        double energy = 0;
        for (int q = 0; q < time_.points(); ++q) {
            std::copy_n(u, size, at.begin());
            std::fill(velocity.begin(), velocity.end(), 0.0);
            for (int m = 1; m <= time_.degree(); ++m) {
                const double* d = change_.data() + static_cast<std::size_t>(m - 1) * size;
                const double value = time_.value(q, m), slope = time_.slope(q, m) / h();
                for (std::size_t i = 0; i < size; ++i) {
                    at[i] += value * d[i];
                    velocity[i] += slope * d[i];
                }
            }
            energy += time_.weight(q) * (form().kineticEnergy(velocity.data()) + form().energy(at.data()));
        }
        return energy;
    }

    TimeTable time_;
    double tolerance_;
    int maxIterations_;
    MassMatrix mass_;
    NodeOrder order_;
    BandLu lu_, tangent_;
    std::vector<std::vector<double>> hessians_;  ///< at the points in time, of the tangent map
    bool hasJacobian_ = false;
    std::size_t s_;
    std::vector<double> change_;  ///< d_m, level after level
    std::vector<double> unknowns_, momentum_, work_, at_, force_, forces_, hessian_;
    std::vector<bool> isFixed_;
};

}  // namespace

std::unique_ptr<Integrator> makeImplicitField(std::shared_ptr<const SpatialForm> form, const TimeTable& time,
                                              double step, double tolerance, int maxIterations) {
    return std::make_unique<ImplicitField>(std::move(form), time, step, tolerance, maxIterations);
}

}  // namespace extremal
