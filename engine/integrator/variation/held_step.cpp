// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/held_step.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/integrator/shared_force.hpp"
#include "engine/integrator/variation/hessian_pull.hpp"
#include "engine/integrator/variation/transposed_step.hpp"

namespace extremal {
namespace {

class HeldStep final : public Integrator, public TransposedStep {
public:
    HeldStep(std::unique_ptr<Integrator> scheme, HeldCoordinates held, std::optional<std::size_t> integral)
        : scheme_(std::move(scheme)),
          nodes_(dynamic_cast<TransposedStep*>(scheme_.get())),
          sharing_(dynamic_cast<SharesForce*>(scheme_.get())),
          unmoved_(sharing_ ? scheme_->clone() : nullptr),
          held_(std::move(held)),
          integral_(integral),
          pull_(held_.whole(), held_.wholeForce(), held_.held()),
          d_(static_cast<std::size_t>(held_.dimension())),
          u_(static_cast<std::size_t>(held_.held())),
          place_(d_ + u_),
          atRest_(d_ + u_),
          gradient_(2 * (d_ + u_)) {
        inner_.x.resize(2 * d_);
    }
    HeldStep(const HeldStep& other) : HeldStep(other.scheme_->clone(), other.held_, other.integral_) {
        inner_ = other.inner_;
        if (sharing_) unmoved_ = other.unmoved_->clone();
    }
    HeldStep& operator=(const HeldStep&) = delete;
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<HeldStep>(*this); }

    double stepSize() const override { return scheme_->stepSize(); }
    void setStep(double h) override { scheme_->setStep(h); }
    void begin(State& state) override {
        state.memory.clear();
        read(state);
        scheme_->begin(inner_);
    }
    bool checkpoint(Archive& archive) override {
        const std::span<double> held = held_.values();
        std::vector<double> values(held.begin(), held.end());
        archive(values);
        std::copy(values.begin(), values.end(), held.begin());
        return scheme_->checkpoint(archive);
    }
    StepReport advance(State& state, double until) override {
        read(state);
        scheme_->setStop(stop());
        const StepReport report = scheme_->advance(inner_, until);
        if (report.outcome != Outcome::converged) return report;
        std::copy_n(inner_.x.data(), d_, state.x.data());
        std::copy_n(inner_.x.data() + d_, d_, state.x.data() + d_ + u_);
        state.t = inner_.t;
        state.node = inner_.node;
        if (integral_) state.x[2 * d_ + u_ + *integral_] += integral();
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> inner(2 * d_);
        scheme_->denseOutput(tau, inner);
        std::copy_n(inner.data(), d_, x.data());
        std::copy_n(inner.data() + d_, d_, x.data() + d_ + u_);
    }

    std::size_t tangentSize() const override { return 2 * (d_ + u_); }
    bool applyTangent(std::span<double> W) override {
        const auto n = static_cast<Eigen::Index>(tangentSize());
        Eigen::MatrixXd transposed = Eigen::MatrixXd::Identity(n, n);
        if (!applyTransposed({transposed.data(), static_cast<std::size_t>(transposed.size())})) return false;
        Eigen::Map<Eigen::MatrixXd> given(W.data(), n, static_cast<Eigen::Index>(W.size()) / n);
        given = (transposed.transpose() * given).eval();
        return true;
    }
    bool applyTransposed(std::span<double> W) override {
        const std::size_t rows = tangentSize(), columns = W.size() / rows;
        columns_.resize(2 * d_ * columns);
        for (std::size_t c = 0; c < columns; ++c) {
            std::copy_n(W.data() + c * rows, d_, columns_.data() + c * 2 * d_);
            std::copy_n(W.data() + c * rows + d_ + u_, d_, columns_.data() + c * 2 * d_ + d_);
        }
        pull_.beginStep(static_cast<int>(columns));
        pull_.setHeld(held_.values(), W.data() + 2 * d_ + u_, rows);
        if (!nodes_->pullBack(columns_, pull_)) return false;
        for (std::size_t c = 0; c < columns; ++c) {
            Eigen::Map<Eigen::VectorXd>(W.data() + c * rows + d_, static_cast<Eigen::Index>(u_)) +=
                pull_.byHeld(static_cast<int>(c));
            std::copy_n(columns_.data() + c * 2 * d_, d_, W.data() + c * rows);
            std::copy_n(columns_.data() + c * 2 * d_ + d_, d_, W.data() + c * rows + d_ + u_);
        }
        return true;
    }

private:
    void read(const State& state) {
        inner_.t = state.t;
        inner_.node = state.node;
        std::copy_n(state.x.data(), d_, inner_.x.data());
        std::copy_n(state.x.data() + d_ + u_, d_, inner_.x.data() + d_);
        if (std::equal(held_.values().data(), held_.values().data() + u_, state.x.data() + d_)) return;
        std::copy_n(state.x.data() + d_, u_, held_.values().data());
        // Its last force was that of other numbers.
        if (sharing_) sharing_->takeForce(dynamic_cast<const SharesForce&>(*unmoved_));
    }
    /// sum_i w_i L_u(i), of the one u.
    double integral() {
        const Mechanics<double>& L = held_.whole();
        double sum = 0;
        std::copy_n(held_.values().data(), u_, place_.data() + d_);
        nodes_->visitNodes([&](const NodePull::Node& node) {
            if (node.isOfForce) return;
            std::copy_n(node.q, d_, place_.data());
            std::copy_n(node.v, d_, atRest_.data());
            L.gradient(L.model.get(), node.t, place_.data(), atRest_.data(), gradient_.data());
            sum += node.weight * gradient_[d_ + *integral_];
        });
        return sum;
    }

    std::unique_ptr<Integrator> scheme_;
    TransposedStep* nodes_;
    SharesForce* sharing_;
    std::unique_ptr<Integrator> unmoved_;  ///< with no last force; null where it keeps none
    HeldCoordinates held_;
    std::optional<std::size_t> integral_;
    HessianPull pull_;
    std::size_t d_, u_;
    State inner_;
    std::vector<double> columns_;
    std::vector<double> place_, atRest_, gradient_;
};

}  // namespace

std::unique_ptr<Integrator> heldStep(std::unique_ptr<Integrator> scheme, HeldCoordinates held,
                                     std::optional<std::size_t> integral) {
    const auto* const nodes = dynamic_cast<const TransposedStep*>(scheme.get());
    if (!nodes || !nodes->hasNodes()) return nullptr;
    return std::make_unique<HeldStep>(std::move(scheme), std::move(held), integral);
}

}  // namespace extremal
