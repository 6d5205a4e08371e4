// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear equations of a step of a wave function in the modes of the model, and its functions in both
/// directions. Of the two squares of a Lagrangian it has one alone: i hbar psi* psi' is linear in the
/// velocity, so that two values of psi are joined by a motion only where one is what the other becomes, and
/// the action along every motion is 0. There is no discrete Lagrangian between two positions to compare.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/family/step_equations.hpp"
#include "engine/family/wave/wave_slabs.hpp"
#include "engine/family/wave/wave_three_level.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {
namespace {

bool hasThreeLevels(const Settings& space) { return space.text("form") == "three-level"; }

/// Of one slab; the exact rule of lines is Gauss with 2 nodes.
Rule<double> ruleInTime(const Discretization& d) {
    if (d.space.text("time_basis") == "chebyshev") return chebyshevRoots(d.space.integer("degree"));
    return d.quadrature.type == "exact" ? gauss<double>(2) : makeRule<double>(d.quadrature);
}

Table<double> polynomialsInTime(const StepCase& c) {
    const int degree = c.discretization.space.integer("degree");
    return makeTable<double>(polynomialSpace<double>(degree, PolynomialBasis::lobatto),
                             ruleInTime(c.discretization));
}

/// The places in c of the modes with the least kinetic energy, in the order of their wave numbers; with a
/// Dirichlet boundary the first functions.
std::vector<int> slowestModes(const Hamiltonian& H, int most) {
    std::vector<int> places(static_cast<std::size_t>(H.size()));
    std::iota(places.begin(), places.end(), 0);
    const auto count = std::min(places.size(), static_cast<std::size_t>(most));
    if (H.isPeriodic())
        std::stable_sort(places.begin(), places.end(), [&](int a, int b) {
            return H.kinetic()[static_cast<std::size_t>(a)] < H.kinetic()[static_cast<std::size_t>(b)];
        });
    places.resize(count);
    const int n = H.grid().nx, m = H.grid().ny;
    const auto wave = [&](int place) {
        const int i = place % n, j = place / n;
        return std::pair(j > m / 2 ? j - m : j, i > n / 2 ? i - n : i);
    };
    if (H.isPeriodic())
        std::sort(places.begin(), places.end(), [&](int a, int b) { return wave(a) < wave(b); });
    return places;
}

/// H in these modes at a time.
Eigen::MatrixXcd inModes(const Hamiltonian& H, const std::vector<int>& modes, double t) {
    const auto n = static_cast<std::size_t>(H.size());
    std::vector<double> V = H.potential();
    if (H.isTimeDependent()) H.potentialAt(t, V.data());
    std::vector<Complex> c(n), out(n), work(n);
    const auto size = static_cast<Eigen::Index>(modes.size());
    Eigen::MatrixXcd matrix(size, size);
    for (Eigen::Index j = 0; j < size; ++j) {
        std::fill(c.begin(), c.end(), Complex(0));
        c[static_cast<std::size_t>(modes[static_cast<std::size_t>(j)])] = 1;
        H.apply(V.data(), c.data(), out.data(), work.data());
        for (Eigen::Index i = 0; i < size; ++i)
            matrix(i, j) = out[static_cast<std::size_t>(modes[static_cast<std::size_t>(i)])];
    }
    // What the transforms leave of a zero.
    const double zero = 256 * std::numeric_limits<double>::epsilon() * matrix.cwiseAbs().maxCoeff();
    return matrix.unaryExpr([&](const Complex& z) { return std::abs(z) <= zero ? Complex(0) : z; });
}

/// One block row for each node of the rule, one block column for each level:
/// i hbar psi_l'(c_i) / h - psi_l(c_i) (H - Ec); in three levels i hbar / (2 h) - alpha (H - Ec).
StepMatrix ofStages(const StepCase& c) {
    const Hamiltonian& H = *c.system.hamiltonian();
    const Discretization& d = c.discretization;
    const bool isThree = hasThreeLevels(d.space);
    const int s = isThree ? 1 : d.space.integer("degree");
    const std::vector<int> modes = slowestModes(H, std::max(1, largestMatrix / s));
    const auto n = static_cast<Eigen::Index>(modes.size());
    const Eigen::MatrixXcd identity = Eigen::MatrixXcd::Identity(n, n);
    const Rule<double> rule = ruleInTime(d);
    const auto basis = polynomialSpace<double>(s, PolynomialBasis::lobatto);
    std::vector<double> value(static_cast<std::size_t>(s) + 1), slope(value);
    StepMatrix result;
    result.magnitude = Eigen::MatrixXd::Zero(s * n, s * n);
    result.elements = 1;
    result.dimension = static_cast<int>(n);
    for (int i = 0; i < s; ++i) {
        const double place = isThree ? 1 : rule.c[static_cast<std::size_t>(i)];
        const Eigen::MatrixXcd E = inModes(H, modes, c.start.t + place * c.step);
        basis.evaluate(place, value, slope);
        for (int l = 1; l <= s; ++l) {
            const auto at = static_cast<std::size_t>(l);
            const double rate = isThree ? 0.5 : slope[at],
                         part = isThree ? threeLevelAlpha(d.quadrature) : value[at];
            result.magnitude.block(i * n, (l - 1) * n, n, n) =
                (Complex(0, H.hbar() * rate / c.step) * identity - part * E).cwiseAbs();
        }
        result.blocks.push_back({static_cast<int>(i * n), static_cast<int>(n), false, i + 1});
    }
    result.supports.functions = s;
    return result;
}

/// The first modes at the nodes of the model, real parts.
SpaceFunctions ofModes(const StepCase& c) {
    const Hamiltonian& H = *c.system.hamiltonian();
    const std::vector<int> modes = slowestModes(H, H.isPeriodic() ? 7 : 5);
    const auto n = static_cast<std::size_t>(H.size());
    SpaceFunctions f;
    f.axis = "x";
    std::vector<Complex> coefficients(n), psi(n);
    const std::vector<double>& x = H.x();
    for (std::size_t k = 0; k < modes.size(); ++k) {
        // Of a pair exp(+-i k x) one: the real parts are the same.
        if (H.isPeriodic() && k < modes.size() / 2) continue;
        std::fill(coefficients.begin(), coefficients.end(), Complex(0));
        coefficients[static_cast<std::size_t>(modes[k])] = 1;
        H.toNodes(coefficients.data(), psi.data());
        SpaceFunctions::Curve curve;
        curve.name = "mode " + std::to_string(f.curves.size() + (H.isPeriodic() ? 0 : 1));
        curve.x = x;
        for (std::size_t i = 0; i < x.size(); ++i) curve.y.push_back(psi[i].real());
        f.curves.push_back(std::move(curve));
    }
    f.text = std::to_string(H.size()) +
             (H.isPeriodic() ? " Fourier modes" : " polynomials that vanish at both ends") +
             ", the slowest of them";
    return f;
}

}  // namespace

StepEquations wave() {
    StepEquations e;
    e.family = "wave";
    e.matrix.make = ofStages;
    e.matrixTitle = "Matrix of a step";
    e.blockName = [](const UnknownBlock& b, int) { return "ψ" + std::to_string(b.index); };
    e.extent = [](const System& system, int, int modes) {
        return std::to_string(modes) + " of " + std::to_string(system.hamiltonian()->size()) + " modes";
    };
    e.functions.make = polynomialsInTime;
    e.spaceFunctions.make = ofModes;
    e.actions.instead =
        "made of an action that is linear in the velocity iħψ′, so that no two values of ψ are joined but "
        "those "
        "of one motion, along which the action is 0";
    return e;
}

}  // namespace extremal::equations
