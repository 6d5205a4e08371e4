// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/written.hpp"

#include "engine/family/galerkin/split.hpp"

namespace extremal::galerkin {

WrittenAction written(const Discretization& discretization) {
    WrittenAction w;
    const bool isByTerm = isSplit(discretization);
    w.meaning =
        "Y_1, …, Y_m are the unknowns of a step, φ_1, …, φ_m the functions of the space with φ_a(0) = 0: "
        "all but the last vanish at 1 as well, and φ_m(1) = 1. ";
    w.meaning +=
        isByTerm ? "The Lagrangian is the sum of L_r, each under the rule (b^r, c^r) of its own; coordinates "
                   "may have functions of their own."
                 : "The rule has the weights b_i and the nodes c_i.";
    const std::string nodes = isByTerm ? "^r" : "";
    w.action = {
        {"S(q_0, q_1) = h Σ" + std::string(isByTerm ? "_r Σ" : "") + "_i b_i" + nodes + " L" +
             (isByTerm ? "_r" : "") + "(t_0 + c_i" + nodes + " h, Q_i" + nodes + ", V_i" + nodes +
             "), stationary over Y_1, …, Y_{m−1}",
         isByTerm ? "S(q_0, q_1) = \\operatorname*{ext}_{Y_1, \\dots, Y_{m-1}}\\; h \\sum_r \\sum_i b_i^r\\, "
                    "L_r(t_0 + c_i^r h, Q_i^r, V_i^r)"
                  : "S(q_0, q_1) = \\operatorname*{ext}_{Y_1, \\dots, Y_{m-1}}\\; h \\sum_i b_i\\, "
                    "L(t_0 + c_i h, Q_i, V_i)"},
        {"Q_i = q_0 + Σ_a φ_a(c_i) Y_a,  h V_i = Σ_a φ_a′(c_i) Y_a,  q_1 = q_0 + Y_m",
         "Q_i = q_0 + \\sum_a \\varphi_a(c_i)\\, Y_a, \\qquad h V_i = \\sum_a \\varphi_a'(c_i)\\, Y_a, "
         "\\qquad "
         "q_1 = q_0 + Y_m"}};
    w.stationarity = {
        {"Σ_i b_i (h φ_a(c_i) ∂L/∂q(i) + φ_a′(c_i) ∂L/∂v(i)) = 0,  a = 1, …, m − 1",
         "\\sum_i b_i \\Bigl( h\\, \\varphi_a(c_i) \\frac{\\partial L}{\\partial q}\\Big|_i + "
         "\\varphi_a'(c_i) \\frac{\\partial L}{\\partial v}\\Big|_i \\Bigr) = 0, \\qquad a = 1, \\dots, "
         "m - 1"},
        {"p_1 = Σ_i b_i (h φ_m(c_i) ∂L/∂q(i) + φ_m′(c_i) ∂L/∂v(i)),  p_1 = p_0 + h Σ_i b_i ∂L/∂q(i)",
         "p_1 = \\sum_i b_i \\Bigl( h\\, \\varphi_m(c_i) \\frac{\\partial L}{\\partial q}\\Big|_i + "
         "\\varphi_m'(c_i) \\frac{\\partial L}{\\partial v}\\Big|_i \\Bigr), \\qquad p_1 = p_0 + h "
         "\\sum_i b_i \\frac{\\partial L}{\\partial q}\\Big|_i"}};
    return w;
}

}  // namespace extremal::galerkin
