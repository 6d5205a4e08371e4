// SPDX-License-Identifier: GPL-3.0-or-later
/// The spherical midpoint method for spins:
///     w_i (s_i1 - s_i0) = h b_i(m) x m_i,     m_i = (s_i0 + s_i1) / |s_i0 + s_i1|,     b = dH/ds.
/// Symplectic on the product of spheres, symmetric, of order 2; lengths, and sums of spins about axes about
/// which H does not change, are kept (McLachlan, Modin and Verdier 2014, Phys. Rev. E 89, 061301).
///
/// The state is one of the complex vectors z over each spin (model/spins/spins.hpp): the step moves z by the
/// rotation that takes s_0 to s_1 along a great circle, and then by the phase that Schroedinger's equation
/// for z at the midpoint gives, so that z is smooth in time.
#include <Eigen/Geometry>

#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/core/corrections.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

using Three = Eigen::Vector3d;
using Spinor = Eigen::Vector2cd;

/// exp(-i angle/2 n . sigma) z for a quaternion (cos angle/2, sin angle/2 n).
Spinor turned(double scalar, const Three& vector, const Spinor& z) {
    const std::complex<double> i(0, 1), along = i * vector(2), across = i * vector(0) + vector(1);
    Spinor to;
    to << (scalar - along) * z(0) - across * z(1),
        (scalar + along) * z(1) - (i * vector(0) - vector(1)) * z(0);
    return to;
}

class SphericalMidpoint final : public FlowMethod<Eigen::Dynamic> {
public:
    SphericalMidpoint(const Mechanics<double>& mechanics, std::shared_ptr<const SpinModel> model, double step)
        : FlowMethod(mechanics, step), model_(std::move(model)) {
        for (Eigen::VectorXd* v : {&s0_, &s1_, &m_, &b_}) *v = Eigen::VectorXd::Zero(3 * model_->count());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<SphericalMidpoint>(*this); }
    std::size_t tangentSize() const override { return 0; }
    std::string tangentProblem() const override {
        return "it moves spins, and not the coordinates above them";
    }

private:
    void step(double) override {
        spins::spinsOf(*model_, q0_.data(), p0_.data(), s0_.data());
        s1_ = s0_;
        const CorrectionLimits limits{
            .most = 200, .last = 2 * CorrectionLimits::epsilon, .roundOff = 1e-13, .stall = 1};
        report_.outcome = solveByCorrections(
            limits, stop(), report_, [&](int, double) { return Correction{.size = iterate(), .scale = 1}; });
        if (report_.outcome == Outcome::converged) moveSpinors();
    }
    /// s_1 by the field at the last midpoint; the largest change of an entry.
    double iterate() {
        ++report_.cost.evaluations;
        for (int i = 0; i < model_->count(); ++i) at(m_, i) = (at(s0_, i) + at(s1_, i)).normalized();
        spins::energyOf(*model_, m_.data(), b_.data());
        double change = 0;
        for (int i = 0; i < model_->count(); ++i) {
            const Three turn = at(b_, i).cross(at(m_, i)) * (h() / weight(i));
            change = std::max(change, (at(s0_, i) + turn - at(s1_, i)).cwiseAbs().maxCoeff());
            at(s1_, i) = at(s0_, i) + turn;
        }
        return change;
    }
    void moveSpinors() {
        for (int i = 0; i < model_->count(); ++i) {
            const double w = 4 * weight(i);
            Spinor z;
            z << std::complex<double>(q0_(2 * i), p0_(2 * i) / w),
                std::complex<double>(q0_(2 * i + 1), p0_(2 * i + 1) / w);
            const Three from = at(s0_, i), to = at(s1_, i).normalized();
            Eigen::Vector4d arc;
            arc << 1 + from.dot(to), from.cross(to);
            arc.normalize();
            Spinor moved = turned(arc(0), arc.tail<3>(), z);
            const double angle = h() * at(b_, i).norm() / (2 * weight(i));
            const Spinor smooth = turned(std::cos(angle), at(b_, i).normalized() * std::sin(angle), z);
            const std::complex<double> phase = moved.dot(smooth);
            moved *= phase / std::abs(phase) / moved.norm();
            for (int k = 0; k < 2; ++k) {
                q1_(2 * i + k) = moved(k).real();
                p1_(2 * i + k) = w * moved(k).imag();
            }
        }
    }
    bool tangent(double, Columns) override { return false; }

    double weight(int i) const { return model_->weights[static_cast<std::size_t>(i)]; }
    static Eigen::Map<Three> at(Eigen::VectorXd& s, int i) { return Eigen::Map<Three>(s.data() + 3 * i); }

    std::shared_ptr<const SpinModel> model_;
    Eigen::VectorXd s0_, s1_, m_, b_;
};

}  // namespace

BaselineEntry spherical_midpoint() {
    BaselineEntry e;
    e.item = {
        "spherical-midpoint",
        "spherical midpoint",
        "For spins: the midpoint projected to each sphere. Symplectic there, lengths and sums are kept.",
        {},
        Claims{2, true, true, {"norm", "momentum"}},
        "spins"};
    e.takes = Takes::only<PhaseMechanics, Spins>();
    e.parts.set(SystemCondition{[](const System& system) { return system.parts.find<Spins>() != nullptr; }});
    e.make = [](const System& system, const BaselineOptions& options) {
        return std::make_unique<SphericalMidpoint>(flowOf(system), system.part<Spins>().model, options.step);
    };
    return e;
}

}  // namespace extremal::baselines
