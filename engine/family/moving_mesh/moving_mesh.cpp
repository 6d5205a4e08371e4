#include "engine/family/moving_mesh/moving_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/family/moving_mesh/explicit_step.hpp"
#include "engine/family/moving_mesh/hierarchical_step.hpp"
#include "engine/family/moving_mesh/multiplier_step.hpp"

namespace extremal {
namespace {

/// A mesh whose residual is larger has left its constraint: Newton's method leaves 1e-13, and one explicit
/// step more than 1e-3.
constexpr double onConstraint = 1e-8;
/// In wave speeds. Nodes that carry a front are as fast as it; where equidistribution asks for more it has to
/// follow what changes everywhere at once.
constexpr double fastestNodes = 1.5;

class MovingMesh final : public Integrator {
    using Method = MovingMeshOptions::Method;

public:
    MovingMesh(std::shared_ptr<const FieldProblem> problem, const MovingMeshOptions& options, double step)
        : space_(std::move(problem)),
          options_(options),
          h_(step),
          multiplier_(space_, options.monitor, options.tolerance, options.maxIterations),
          explicit_(space_, options.monitor, options.relaxation, options.speedLimit * std::sqrt(space_.c2),
                    options.tolerance, options.maxIterations),
          hierarchical_(space_, options.monitor, options.tolerance, options.maxIterations),
          constraint_(options.monitor, space_.n) {
        if (options.method == Method::free) multiplier_.setFree(options.meshMass);
        options_.hasFallback = options.hasFallback && options.method == Method::multiplier;
        for (auto* each : {&z_, &v_, &zBefore_, &vBefore_}) each->assign(2 * space_.n, 0);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }
    bool checksFinite() const override { return true; }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        unpack(state.x);
        report.outcome = step(report);
        if (report.outcome != Outcome::converged) return report;
        pack(state.x);
        state.t = until;
        ++state.node;
        return report;
    }

    std::span<const Quantity> quantities() const override {
        static const std::array<Quantity, 3> all{{{"discrete_energy", "discrete energy", "E_d", ""},
                                                  {"multiplier", "multiplier", "max |λ|", ""},
                                                  {"mesh_residual", "mesh residual", "max |g|", ""}}};
        return all;
    }
    void measure(const State&, double* values) const override {
        values[0] = last_ == Method::explicitMesh   ? explicit_.slabEnergy()
                    : last_ == Method::hierarchical ? hierarchical_.slabEnergy()
                                                    : multiplier_.slabEnergy();
        values[1] = last_ == Method::multiplier ? multiplier_.largestMultiplier() : std::nan("");
        values[2] = constraint_.residual(z_.data());
    }

    void denseOutput(double tau, std::span<double> x) const override {
        State state;
        state.x.resize(4 * space_.n);
        MovingMesh shorter = *this;
        shorter.z_ = zBefore_;
        shorter.v_ = vBefore_;
        shorter.pack(state.x);
        if (tau > 0) {
            shorter.setStep(tau * h_);
            (void)shorter.advance(state, 0);
        }
        std::copy(state.x.begin(), state.x.end(), x.begin());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MovingMesh>(*this); }

private:
    /// x = (y, y', X, X') to z and v, which are (y_i, X_i) and their rates node by node.
    void unpack(const std::vector<double>& x) {
        const std::size_t n = space_.n;
        for (std::size_t i = 0; i < n; ++i) {
            z_[2 * i] = x[i];
            v_[2 * i] = x[n + i];
            z_[2 * i + 1] = x[2 * n + i];
            v_[2 * i + 1] = x[3 * n + i];
        }
    }
    void pack(std::vector<double>& x) const {
        const std::size_t n = space_.n;
        for (std::size_t i = 0; i < n; ++i) {
            x[i] = z_[2 * i];
            x[n + i] = v_[2 * i];
            x[2 * n + i] = z_[2 * i + 1];
            x[3 * n + i] = v_[2 * i + 1];
        }
    }

    Outcome step(StepReport& report) {
        zBefore_ = z_;
        vBefore_ = v_;
        last_ = options_.method;
        if (last_ == Method::explicitMesh) return checked(explicit_.advance(z_, v_, h_, report, stop()));
        if (last_ == Method::hierarchical) return checked(hierarchical_.advance(z_, v_, h_, report, stop()));
        const bool isOff = options_.hasFallback && constraint_.residual(z_.data()) > onConstraint;
        Outcome outcome = Outcome::diverged;
        if (!isOff) {
            outcome = checked(multiplier_.advance(z_, v_, h_, report, stop()));
            const bool isSound = outcome == Outcome::converged && !isTooFast();
            if (!options_.hasFallback || isSound || outcome == Outcome::stopped) return outcome;
            ++report.cost.rejected;
        }
        z_ = zBefore_;
        v_ = vBefore_;
        last_ = Method::explicitMesh;
        report.event = StepEvent::meshFallback;
        return checked(explicit_.advance(z_, v_, h_, report, stop()));
    }
    bool isTooFast() const {
        const double most = fastestNodes * std::sqrt(space_.c2) * std::abs(h_);
        for (std::size_t i = 0; i < space_.n; ++i)
            if (std::abs(z_[2 * i + 1] - zBefore_[2 * i + 1]) > most) return true;
        return false;
    }
    Outcome checked(Outcome outcome) const {
        if (outcome != Outcome::converged) return outcome;
        double sum = 0;
        for (const double value : z_) sum += 0 * value;
        for (const double value : v_) sum += 0 * value;
        if (sum != 0) return Outcome::notFinite;
        return space_.isOrdered(z_.data()) ? Outcome::converged : Outcome::lost;
    }

    NodeSpace space_;
    MovingMeshOptions options_;
    double h_;
    MultiplierStep multiplier_;
    ExplicitStep explicit_;
    HierarchicalStep hierarchical_;
    mutable MeshConstraint constraint_;  ///< for what is measured: it has buffers
    Method last_ = Method::multiplier;   ///< of the last step
    std::vector<double> z_, v_, zBefore_, vBefore_;
};

}  // namespace

std::unique_ptr<Integrator> makeMovingMesh(std::shared_ptr<const FieldProblem> problem,
                                           const MovingMeshOptions& options, double step) {
    return std::make_unique<MovingMesh>(std::move(problem), options, step);
}

}  // namespace extremal
