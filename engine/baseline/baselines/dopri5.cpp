// SPDX-License-Identifier: GPL-3.0-or-later
/// Dormand-Prince 5(4) of Boost.odeint, without its dense output.
#include <utility>
#include <vector>

#include "engine/baseline/adaptive.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/mechanism/driven_flow.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal::baselines {
namespace {

/// Of the formula of order 5 (Dormand, Prince 1980); the seventh stage is for the error alone.
std::shared_ptr<const Tableau> dopri5Tableau(const Settings&) {
    using Fraction = std::pair<int, int>;
    const std::vector<std::vector<Fraction>> rows = {
        {},
        {{1, 5}},
        {{3, 40}, {9, 40}},
        {{44, 45}, {-56, 15}, {32, 9}},
        {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
        {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}};
    const std::vector<Fraction> weights = {{35, 384},  {0, 1},        {500, 1113},
                                           {125, 192}, {-2187, 6784}, {11, 84}};
    const auto quotient = [](const Fraction& f) { return Quad(f.first) / f.second; };
    Tableau::Matrix A = Tableau::Matrix::Zero(6, 6);
    Tableau::Vector b(6);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < rows[i].size(); ++j)
            A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = quotient(rows[i][j]);
        b(static_cast<Eigen::Index>(i)) = quotient(weights[i]);
    }
    return std::make_shared<const Tableau>(plainTableau(A, b));
}

}  // namespace

BaselineEntry dopri5() {
    using Stepper = boost::numeric::odeint::runge_kutta_dopri5<std::vector<double>>;
    BaselineEntry e;
    e.item = {"dopri5",
              "Dormand-Prince 5(4)",
              "Boost.odeint's explicit Runge-Kutta pair of order 5 under error control.",
              {},
              Claims{5, false, false, {}},
              "smooth forces"};
    e.grid = TimeGrid::landing;
    e.parts.set(BaselineTableau{dopri5Tableau});
    e.takes = drivenProblems().with<Spins>();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Adaptive<Stepper>>(drivenMechanics(system), options);
    };
    return e;
}

}  // namespace extremal::baselines
