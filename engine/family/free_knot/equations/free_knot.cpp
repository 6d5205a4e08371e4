// SPDX-License-Identifier: GPL-3.0-or-later
/// The second derivatives of the energy of a profile by what is stationary in it: the values at the knots
/// inside, and their places where knots are free. Nothing moves in time.
#include <algorithm>
#include <array>

#include "engine/family/step_equations.hpp"
#include "engine/model/static_problem.hpp"

namespace extremal::equations {
namespace {

/// Knots and values, by a march along the profile that was found.
struct Profile {
    std::vector<double> x, u;
};
Profile profileOf(const StepCase& c, double end) {
    const auto integrator = makeIntegrator(c.system, c.discretization, Clock{c.start.t, c.step});
    State state = c.start;
    Profile p{{state.t}, {state.x[0]}};
    while (state.t < end && integrator->advance(state, end).outcome == Outcome::converged) {
        p.x.push_back(state.t);
        p.u.push_back(state.x[0]);
    }
    return p;
}

StepMatrix hessianOfEnergy(const StepCase& c) {
    const StaticProblem& problem = *c.system.part<StaticPart>().problem;
    const Profile p = profileOf(c, problem.right);
    const bool isFree = c.discretization.space.text("place") == "free";
    const int each = isFree ? 2 : 1, knots = static_cast<int>(p.x.size()),
              inside = std::min(knots - 2, largestMatrix / each);
    StepMatrix m;
    if (inside < 1) {
        m.failure = "there is no knot inside";
        return m;
    }
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(each * inside, each * inside);
    for (int e = 0; e + 1 < knots; ++e) {
        const auto left = static_cast<std::size_t>(e);
        const std::array<double, 4> z{p.u[left], p.x[left], p.u[left + 1], p.x[left + 1]};
        const StaticElement element = staticElement(problem, z.data());
        // Entry 2 k + i of z: value (i = 0) or place (i = 1) of knot e + k; knots inside begin with 1.
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const int row = e + a / 2 - 1, column = e + b / 2 - 1;
                const bool isPlace = a % 2 == 1 || b % 2 == 1;
                if (std::min(row, column) < 0 || std::max(row, column) >= inside || (isPlace && !isFree))
                    continue;
                A(each * row + a % 2, each * column + b % 2) +=
                    element.hessian[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
            }
    }
    m.magnitude = A.cwiseAbs();
    m.blocks = {{0, each * inside, false, 0}};
    m.elements = knots - 1;
    m.dimension = inside;
    return m;
}

}  // namespace

StepEquations free_knot() {
    constexpr const char* still = "made of one profile that is found at once, without steps in time";
    StepEquations e;
    e.family = "free_knot";
    e.matrix.make = hessianOfEnergy;
    e.matrixTitle = "Hessian of the energy";
    e.blockName = [](const UnknownBlock&, int) { return std::string("u, x"); };
    e.extent = [](const System&, int elements, int shown) {
        return std::to_string(shown) + " of " + std::to_string(elements - 1) + " knots";
    };
    e.functions.instead = e.actions.instead = still;
    e.spaceFunctions.instead = "linear between knots, which the view step shows";
    return e;
}

}  // namespace extremal::equations
