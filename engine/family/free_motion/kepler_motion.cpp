// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/free_motion/kepler_motion.hpp"

#include <limits>
#include <span>
#include <vector>

#include "engine/family/free_motion/jacobi_motion.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal {
namespace {

class KeplerMotion final : public FlowMethod<Eigen::Dynamic> {
    using Varied = Dual<double, 1>;

public:
    KeplerMotion(const Mechanics<double>& mechanics, const HeldBodies& bodies, const Splitting& splitting,
                 double step)
        : FlowMethod(mechanics, step),
          bodies_(bodies),
          splitting_(splitting),
          motion_(bodies),
          kick_(motion_.none()),
          place_(Vector::Zero(d())),
          force_(Vector::Zero(d())),
          at_(Vector::Constant(d(), std::numeric_limits<double>::quiet_NaN())) {}

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<KeplerMotion>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(at_, force_, atTime_);
        return true;
    }

    /// From the start an arc; how far the motion is from it, by cubic Hermite interpolation in places and in
    /// velocities.
    void denseOutput(double tau, std::span<double> x) const override {
        const double h = endTime_ - startTime_, rest = 1 - tau;
        const double w = tau * tau * (3 - 2 * tau), s = -tau * tau * rest * h, s0 = tau * rest * rest * h;
        JacobiMotion<double> now(bodies_), end(bodies_), arc(bodies_);
        now.read(q0_.data(), p0_.data());
        end.read(q1_.data(), p1_.data());
        auto first = now.none(), last = first;
        Vector force = Vector::Zero(d());
        forceAt(startTime_, q0_, force);
        now.accelerations(force.data(), first);
        forceAt(endTime_, q1_, force);
        end.accelerations(force.data(), last);
        arc.read(q0_.data(), p0_.data());
        arc.move(h);
        now.move(tau * h);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < now.size(); ++i) {
                const double dv = end.velocities()[k][i] - arc.velocities()[k][i],
                             da = last[k][i] + end.fall(k, i) - arc.fall(k, i);
                now.places()[k][i] += w * (end.places()[k][i] - arc.places()[k][i]) + s * dv;
                now.velocities()[k][i] += s0 * first[k][i] + w * dv + s * da;
            }
        now.writePlaces(x.data());
        now.writeMomenta(x.data() + d());
    }

private:
    void forceAt(double t, const Vector& q, Vector& force) const {
        mechanics_.force(mechanics_.model.get(), t, q.data(), force.data());
    }
    /// Kicks are at the times of their knots.
    void step(double t) override {
        motion_.read(q1_.data(), p1_.data());
        place_ = q1_;
        // The last kick of a step and the first one of the next are at one place.
        bool isForceFresh = at_ == place_ && (!mechanics_.isTimeDependent || atTime_ == t);
        double passed = 0;
        for (const SplittingStage& stage : splitting_.stages) {
            if (!stage.isKick) {
                passed += stage.fraction;
                motion_.move(stage.fraction * h());
                motion_.writePlaces(place_.data());
                isForceFresh = false;
                continue;
            }
            if (!isForceFresh) {
                atTime_ = t + passed * h();
                forceAt(atTime_, place_, force_);
                at_ = place_;
                isForceFresh = true;
                ++report_.cost.evaluations;
            }
            const auto ofCentre = motion_.accelerations(force_.data(), kick_);
            motion_.kick(kick_, ofCentre, stage.fraction * h());
        }
        q1_ = place_;
        motion_.writeMomenta(p1_.data());
    }
    /// All columns go through the stages together: the second derivatives of the potential are found once.
    bool tangent(double t, Columns W) override {
        const auto half = static_cast<std::size_t>(d());
        std::vector<JacobiMotion<Varied>> motions(static_cast<std::size_t>(W.cols()),
                                                  JacobiMotion<Varied>(bodies_));
        auto kick = motions.front().none();
        std::vector<Varied> q(half), p(half);
        Vector place = q0_, force = p0_;
        for (Eigen::Index column = 0; column < W.cols(); ++column) {
            for (Eigen::Index i = 0; i < d(); ++i) {
                const auto at = static_cast<std::size_t>(i);
                q[at] = q0_(i);
                p[at] = p0_(i);
                q[at].g[0] = W(i, column);
                p[at].g[0] = W(d() + i, column);
            }
            motions[static_cast<std::size_t>(column)].read(q.data(), p.data());
        }
        double passed = 0;
        for (const SplittingStage& stage : splitting_.stages) {
            if (!stage.isKick) {
                passed += stage.fraction;
                for (auto& motion : motions) motion.move(stage.fraction * h());
                continue;
            }
            motions.front().writePlaces(q.data());
            for (std::size_t i = 0; i < half; ++i) place(static_cast<Eigen::Index>(i)) = q[i].value;
            const double now = t + passed * h();
            const Eigen::MatrixXd* const jacobian = flowJacobian(now, place, p0_);
            if (!jacobian) return false;
            forceAt(now, place, force);
            for (auto& motion : motions) {
                motion.writePlaces(q.data());
                for (std::size_t i = 0; i < half; ++i) {
                    const auto row = static_cast<Eigen::Index>(i);
                    p[i] = force(row);
                    for (std::size_t j = 0; j < half; ++j)
                        p[i].g[0] += (*jacobian)(d() + row, static_cast<Eigen::Index>(j)) * q[j].g[0];
                }
                const auto ofCentre = motion.accelerations(p.data(), kick);
                motion.kick(kick, ofCentre, stage.fraction * h());
            }
        }
        for (Eigen::Index column = 0; column < W.cols(); ++column) {
            motions[static_cast<std::size_t>(column)].writePlaces(q.data());
            motions[static_cast<std::size_t>(column)].writeMomenta(p.data());
            for (Eigen::Index i = 0; i < d(); ++i) {
                W(i, column) = q[static_cast<std::size_t>(i)].g[0];
                W(d() + i, column) = p[static_cast<std::size_t>(i)].g[0];
            }
        }
        return W.allFinite();
    }

    HeldBodies bodies_;
    Splitting splitting_;
    JacobiMotion<double> motion_;
    JacobiMotion<double>::Columns kick_;
    Vector place_, force_, at_;  ///< at_: where the force is that of
    double atTime_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> makeKeplerMotion(const System& system, const HeldBodies& bodies,
                                             const Splitting& splitting, double step) {
    return std::make_unique<KeplerMotion>(flowOf(system), bodies, splitting, step);
}

}  // namespace extremal
