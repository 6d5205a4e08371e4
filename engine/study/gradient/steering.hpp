// SPDX-License-Identifier: GPL-3.0-or-later
/// Optimal control of a run by the controls of its model: the least
///
///     J = F(x_N) + sum_k sum_i h b_i c(t_i, q_i, v_i, u_i),   with  e_j(x_N) = 0  and  lower <= u <= upper.
///
/// Each control is a polynomial on every step, given by its values at as many Gauss points as half the order
/// of the scheme: with Gauss of degree s these are the nodes of the action, and u enters as in the discrete
/// principle of Lagrange and d'Alembert, dR_a/du_i = h b_i phi_a(c_i). J then has order 2 s, and the nodal
/// values of u have order s + 1.
///
/// The multipliers of the conditions are those of the discrete motion: l_N = dF/dx + sum_j lambda_j de_j/dx,
/// l_k = M_k^T l_{k+1} is the derivative of the least cost by the state at node k, the costate of the
/// indirect method (Lall and West 2006).
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {

struct SteeringRequest {
    std::vector<std::string> controls = {};    ///< names; empty: all of the model
    std::string of = {}, over = {};            ///< F and c; one of them may be empty
    std::vector<std::string> conditions = {};  ///< formulas that are to be 0 at the end
    std::vector<std::string> bounds = {};      ///< "u=-1:1"; one side may be left out
    std::string scheme = {};                   ///< its label; empty: the first enabled one
};

struct SteeringAnswer {
    std::string scheme;
    long long steps = 0;
    double cost = 0, integral = 0;
    double miss = 0;   ///< root of the sum of e_j^2
    double slope = 0;  ///< of the Lagrange function by the controls, in the norm of their integral
    int iterations = 0, products = 0, atBounds = 0;
    std::vector<double> multipliers;  ///< one for each condition
    StudyTable controls;              ///< t and each control, at its points
    StudyTable states;                ///< t, the state and the costates at nodes
    Value scene;                      ///< with the controls as tables
    std::string problem, remedy;      ///< why there is no minimum; empty: there is
    bool isFound() const { return problem.empty(); }
};

/// Throws InvalidScene ("--control", "--of", "--over", "--end", "--bounds", "--scheme").
SteeringAnswer steer(const ResolvedScene& scene, const SteeringRequest& request,
                     const std::stop_token& stop = {});

/// The answer as JSON, without its tables and its scene.
Value steeringValue(const SteeringAnswer& answer);

}  // namespace extremal
