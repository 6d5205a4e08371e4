// SPDX-License-Identifier: GPL-3.0-or-later
/// A family with one degree of freedom in each step and coordinate: straight lines from q_0, with the action
/// read off where the step begins,
///     S(v) = h L(t_0, q_0, v),   q(tau) = q_0 + tau h v.
/// Stationarity, with the multiplier at the start as the momentum, is one equation for v:
///     L_v(t_0, q_0, v) = p_0 + h L_q(t_0, q_0, v),   q_1 = q_0 + h v,   p_1 = L_v(t_0, q_0, v).
/// Of a separable system it is the symplectic Euler method.
#include <Eigen/Core>

#include <limits>

#include "engine/family/family.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/solve/newton.hpp"

namespace extremal::family {
namespace {

class LineStep final : public Integrator {
public:
    LineStep(const Mechanical& mechanics, double step) : m_(mechanics), h_(step), v_(m_.dimension) {
        v_.setZero();
    }

    double stepSize() const override { return h_; }
    void setStep(double step) override { h_ = step; }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<LineStep>(*this); }
    /// The velocity, from which the iteration of the next step starts.
    bool checkpoint(Archive& archive) override {
        archive(v_);
        return true;
    }

    StepReport advance(State& state, double until) override {
        const int d = m_.dimension;
        const Eigen::Map<Eigen::VectorXd> q(state.x.data(), d), p(state.x.data() + d, d);
        StepReport report;
        report.step = h_;
        Eigen::VectorXd gradient(2 * d);
        Eigen::MatrixXd hessian(2 * d, 2 * d);
        report.outcome =
            solveNewton<double>(v_, [&](const Eigen::VectorXd& v, Eigen::VectorXd& F, Eigen::MatrixXd* J) {
                double value = 0;
                m_.jet(m_.model.get(), state.t, q.data(), v.data(), &value, gradient.data(), hessian.data());
                ++report.cost.evaluations;
                F = gradient.tail(d) - p - h_ * gradient.head(d);
                if (J) *J = hessian.bottomRightCorner(d, d) - h_ * hessian.topRightCorner(d, d);
                return F.allFinite();
            });
        if (report.outcome != Outcome::converged) return report;
        start_ = state.x;
        m_.gradient(m_.model.get(), state.t, q.data(), v_.data(), gradient.data());
        for (int i = 0; i < d; ++i) {
            state.x[static_cast<std::size_t>(i)] += h_ * v_(i);
            state.x[static_cast<std::size_t>(d + i)] = gradient(d + i);
        }
        state.t = until;
        ++state.node;
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = start_[i] + (i < x.size() / 2 ? tau * h_ * v_(static_cast<Eigen::Index>(i)) : 0);
    }

private:
    Mechanical m_;
    double h_;
    Eigen::VectorXd v_;  ///< of the last step: the starting value of the next
    std::vector<double> start_;
};

SpaceEntry lineSpace() {
    SpaceEntry e;
    e.item = {"line", "line", "Straight lines, read off where they begin.", {}, {}, "coordinates"};
    return e;  // no table: the family has a step of its own
}

Properties describeLine(const Discretization&) {
    Properties p;
    p.claims = {1, false, true, {"momentum"}};
    p.curveOrder = 1;
    p.space = "straight lines";
    p.shortName = "line";
    p.stabilityLimit = 2;
    return p;
}

ChoiceGrid choices(const System&) {
    ChoiceGrid grid;
    grid.rows = {{"line", "straight lines"}};
    grid.cells = {{{{"line", {}, {}}, {"auto", {}, {}}, {}}, "line", "line", "1", "straight lines"}};
    return grid;
}

WrittenAction written(const Discretization&) {
    return {"A straight line in each element, and the rule with its one node where it begins.",
            {{"S = Σ_k h L(t_k, q_k, v_k)", "S = \\sum_k h\\, L(t_k, q_k, v_k)"}},
            {{"L_v(t_k, q_k, v_k) = p_k + h L_q(t_k, q_k, v_k)",
              "L_v(t_k, q_k, v_k) = p_k + h\\, L_q(t_k, q_k, v_k)"}}};
}

}  // namespace

Family line() {
    Family f;
    f.item = {"line", "line", "One degree of freedom in each step.", {}, {}, "coordinates"};
    f.source = "Leok 2004, sec. 2";
    f.spaces = {lineSpace()};
    f.completeRule = [](const Settings&, const Settings&) { return Settings{"auto", {}, {}}; };
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.describe = describeLine;
    // Nothing stands against a step but the stability limit that describeLine states.
    f.check = [](const SchemeCase&, Findings&) {};
    f.choices = choices;
    f.written = written;
    f.make = [](const System& system, const Discretization&, double step) -> std::unique_ptr<Integrator> {
        return std::make_unique<LineStep>(system.mechanics(), step);
    };
    // What only some families have is a part.
    f.parts.set(SolverMethods{{"newton"}});
    return f;
}

}  // namespace extremal::family
