// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/free_motion/free_body_motion.hpp"

#include <limits>
#include <type_traits>

#include "engine/family/free_motion/free_body.hpp"

namespace extremal {
namespace {

class FreeMotion final : public BodyMethodOf<FreeMotion> {
    friend BodyMethodOf;

public:
    FreeMotion(const System& system, const Splitting& splitting, double step)
        : BodyMethodOf(system, step), splitting_(splitting), body_(system.body().inertia) {}
    bool checkpoint(Archive& archive) override {
        archive(at_, torque_, force_);
        return true;
    }

private:
    template <class T>
    void move(BodyMotion<T>& m, double h) {
        const auto& stages = splitting_.stages;
        const std::size_t lastDrift = stages.size() - (stages.back().isKick ? 2 : 1);
        for (std::size_t k = 0; k < stages.size(); ++k) {
            const SplittingStage& stage = stages[k];
            if (stage.isKick)
                kick(m, stage.fraction * h, k == 0, k + 1 == stages.size());
            else
                body_.move(m, stage.fraction * h);
            // Before a last kick, so that its pose is that of the state.
            if (k == lastDrift) m.q = so3::normalised(m.q);
        }
    }
    /// The last kick of a step and the first one of the next see the same pose.
    template <class T>
    void kick(BodyMotion<T>& m, double t, bool isFirst, bool isLast) {
        so3::Vector<T> torque, force;
        if constexpr (std::is_same_v<T, double>) {
            const auto pose = [&] {
                return std::array<double, 7>{m.q(0),        m.q(1),        m.q(2),       m.q(3),
                                             m.position(0), m.position(1), m.position(2)};
            };
            if (!isFirst || pose() != at_) forces(m, torque_, force_, true);
            if (isLast) at_ = pose();
            torque = torque_;
            force = force_;
        } else {
            forces(m, torque, force);
        }
        m.momentum += torque * T(t);
        if (BodyMethod::body_.dimension == 6) m.linear += so3::matrix(m.q) * force * T(t);
    }

    Splitting splitting_;
    FreeBody body_;
    std::array<double, 7> at_{std::numeric_limits<double>::quiet_NaN()};  ///< pose of the forces below
    Vector torque_ = Vector::Zero(), force_ = Vector::Zero();
};

}  // namespace

std::unique_ptr<Integrator> makeFreeBodyMotion(const System& system, const Splitting& splitting,
                                               double step) {
    return std::make_unique<FreeMotion>(system, splitting, step);
}

}  // namespace extremal
