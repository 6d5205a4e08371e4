// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/elliptic/elliptic.hpp"

#include <cmath>
#include <limits>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/elliptic.hpp"

namespace extremal {
namespace {

class Elliptic final : public Integrator {
public:
    Elliptic(const EllipticProblem& problem, int elements, EllipticElements kind)
        : kind_(kind), solution_(problem, elements), nodal_(solution_.nodal(kind)) {}

    double stepSize() const override { return 1.0 / solution_.elements(); }
    std::string tangentProblem() const override {
        return "it solves for the whole curve at once and takes no steps";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Elliptic>(*this); }

    StepReport advance(State& state, double until) override {
        StepReport report;
        const int n = solution_.elements();
        report.step = 1.0 / n;
        if (state.node >= n) {
            report.outcome = Outcome::stopped;
            return report;
        }
        report.cost.linearSolves = state.node == 0 ? 1 : 0;
        last_ = static_cast<int>(state.node);
        ++state.node;
        state.t = until;
        state.x[0] = nodal_[static_cast<std::size_t>(state.node)];
        state.x[1] = solution_.u(static_cast<double>(state.node) / n);
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        const double place = (last_ + tau) / solution_.elements();
        x[0] = solution_.between(kind_, nodal_, place);
        x[1] = solution_.u(place);
    }

private:
    EllipticElements kind_;
    EllipticSolution solution_;
    std::vector<double> nodal_;
    int last_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> makeEllipticIntegrator(const System& system, const Discretization& discretization,
                                                   double step) {
    const double n = std::round(1 / step);
    if (!(n >= 2 && n <= 1e5) || std::abs(n * step - 1) > 1e-9)
        throw InvalidScene("/step",
                           "must be a whole part of 1, from a half to 1e-5, got " + formatNumber(step),
                           "leave it out: it is 1/elements");
    const bool isLinear = discretization.space.text("functions") == "linear";
    return std::make_unique<Elliptic>(*system.part<EllipticPart>().problem, static_cast<int>(n),
                                      isLinear ? EllipticElements::linear : EllipticElements::multiscale);
}

}  // namespace extremal
