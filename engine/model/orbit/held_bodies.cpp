// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/orbit/held_bodies.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

constexpr int mostBodies = 12;          ///< whose pulls are found in a millisecond
constexpr double relativeRest = 1e-10;  ///< of the potential
constexpr double dominance = 10;

/// Where the axes of the bodies stand among the coordinates.
struct Layout {
    int bodies, axes;
    bool isBodyByBody;
    int at(int body, int axis) const { return isBodyByBody ? body * axes + axis : axis * bodies + body; }
};

/// V at q, which is H without momenta.
class SampledPotential {
public:
    explicit SampledPotential(const Mechanics<double>& m)
        : mechanics_(m), rest_(static_cast<std::size_t>(m.dimension)) {}
    double operator()(const std::vector<double>& q) const {
        return mechanics_.energy(mechanics_.model.get(), 0, q.data(), rest_.data());
    }
    /// Between -1 and 1, always the same.
    std::vector<double> randomPlace() {
        std::vector<double> q(rest_.size());
        for (double& each : q) {
            seed_ = seed_ * 6364136223846793005u + 1442695040888963407u;
            each = static_cast<double>(seed_ >> 11) * 0x1p-52 - 1;
        }
        return q;
    }

private:
    const Mechanics<double>& mechanics_;
    std::vector<double> rest_;
    std::uint64_t seed_ = 7;
};

/// V falls off with the distance: half of it where all is twice as large.
bool isOfInverseDistances(SampledPotential& potential) {
    for (int i = 0; i < 2; ++i) {
        std::vector<double> q = potential.randomPlace();
        const double near = potential(q);
        for (double& each : q) each *= 2;
        if (!(std::abs(2 * potential(q) - near) <= relativeRest * std::abs(near)) || near == 0) return false;
    }
    return true;
}

/// K_ij of i < j, and K_i as K_ii; empty where V is not their sum.
Eigen::MatrixXd pullsOf(SampledPotential& potential, const Layout& layout) {
    const int n = layout.bodies, unknowns = n * (n + 1) / 2, samples = unknowns + 8;
    Eigen::MatrixXd inverse(samples, unknowns);
    Eigen::VectorXd values(samples);
    for (int s = 0; s < samples; ++s) {
        const std::vector<double> q = potential.randomPlace();
        values(s) = -potential(q);
        int column = 0;
        for (int i = 0; i < n; ++i)
            for (int j = i; j < n; ++j) {
                double square = 0;
                for (int k = 0; k < layout.axes; ++k) {
                    const double x = q[static_cast<std::size_t>(layout.at(i, k))],
                                 y = i == j ? 0 : q[static_cast<std::size_t>(layout.at(j, k))];
                    square += (x - y) * (x - y);
                }
                inverse(s, column++) = 1 / std::sqrt(square);
            }
    }
    const Eigen::VectorXd found = dense::leastSquares<double>(inverse, values);
    const double size = values.cwiseAbs().maxCoeff(), rest = (inverse * found - values).cwiseAbs().maxCoeff();
    if (!(rest <= relativeRest * size)) return {};
    Eigen::MatrixXd pulls(n, n);
    for (int i = 0, column = 0; i < n; ++i)
        for (int j = i; j < n; ++j) {
            const double K = found(column++);
            // A pull that is round-off of the others counts as zero.
            pulls(i, j) = pulls(j, i) = std::abs(K) < 1e-14 * found.cwiseAbs().maxCoeff() ? 0 : K;
        }
    return pulls;
}

/// The centre -1 is the origin.
std::optional<HeldBodies> heldBy(int centre, const Eigen::MatrixXd& pulls, const Layout& layout,
                                 const double* masses) {
    HeldBodies held;
    double others = 0;
    const auto add = [&](int i, double strength) {
        HeldBodies::OneBody body{masses[layout.at(i, 0)], {-1, -1, -1}, strength};
        for (int k = 0; k < layout.axes; ++k) body.place[static_cast<std::size_t>(k)] = layout.at(i, k);
        held.bodies.push_back(body);
    };
    if (centre < 0)
        held.bodies.push_back({std::numeric_limits<double>::infinity(), {-1, -1, -1}, 0});
    else
        add(centre, 0);
    for (int i = 0; i < layout.bodies; ++i) {
        if (i == centre) continue;
        const double strength = centre < 0 ? pulls(i, i) : pulls(i, centre);
        double besides = centre < 0 ? 0 : std::abs(pulls(i, i));
        for (int j = 0; j < layout.bodies; ++j)
            if (j != i && j != centre) besides += std::abs(pulls(i, j));
        if (!(strength > 0) || strength < dominance * besides) return {};
        add(i, strength);
        others += masses[layout.at(i, 0)];
    }
    // A body that moves must not be pulled by the origin.
    if (centre >= 0 && (pulls(centre, centre) != 0 || held.bodies[0].mass < dominance * others)) return {};
    return held;
}

}  // namespace

std::optional<HeldBodies> heldBodiesIn(const Mechanics<double>& mechanics) {
    if (!mechanics.isSeparable || mechanics.isTimeDependent || !mechanics.energy) return {};
    SampledPotential potential(mechanics);
    const int d = mechanics.dimension;
    if (d > 3 * mostBodies || !isOfInverseDistances(potential)) return {};
    for (const int axes : {3, 2})
        for (const bool isBodyByBody : {true, false}) {
            if (d % axes != 0 || d / axes < 2 || d / axes > mostBodies) continue;
            const Layout layout{d / axes, axes, isBodyByBody};
            bool hasMasses = true;
            int heaviest = 0;
            for (int i = 0; i < layout.bodies; ++i) {
                for (int k = 1; k < axes; ++k)
                    hasMasses =
                        hasMasses && mechanics.masses[layout.at(i, k)] == mechanics.masses[layout.at(i, 0)];
                if (mechanics.masses[layout.at(i, 0)] > mechanics.masses[layout.at(heaviest, 0)])
                    heaviest = i;
            }
            if (!hasMasses) continue;
            const Eigen::MatrixXd pulls = pullsOf(potential, layout);
            if (pulls.size() == 0) continue;
            const bool isFixed = (pulls.diagonal().array() > 0).all();
            return heldBy(isFixed ? -1 : heaviest, pulls, layout, mechanics.masses);
        }
    return {};
}

}  // namespace extremal
