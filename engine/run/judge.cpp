#include "engine/run/judge.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/model/conservative.hpp"

namespace extremal {
namespace {

using OfState = std::function<double(double t, const double* x)>;

OfState kineticEnergyOf(const System& system) {
    if (isMechanical(system)) {
        std::vector<double> v(static_cast<std::size_t>(system.dimension()));
        return [m = system.mechanics(), v](double t, const double* x) mutable {
            const double* const p = x + m.dimension;
            if (!m.velocity(m.model.get(), t, x, p, v.data())) return 0.0;
            double sum = 0;
            for (std::size_t k = 0; k < v.size(); ++k) sum += p[k] * v[k];
            return sum / 2;
        };
    }
    if (const Body* body = kindOf<Body>(system))
        return [body = *body](double, const double* x) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += x[4 + k] * x[4 + k] / body.inertia[k];
            if (body.dimension == 6)
                for (std::size_t k = 0; k < 3; ++k) sum += x[13 + k] * x[13 + k] / body.inertia[3 + k];
            return sum / 2;
        };
    return {};
}

}  // namespace

Judge::Judge(const System& system, const State& start, double step) {
    if (isWave(system)) {
        const std::size_t size = start.x.size();
        conserved_ = [size](double, const double* x) {
            double sum = 0;
            for (std::size_t k = 0; k < size; ++k) sum += x[k] * x[k];
            return sum;
        };
    } else if (conservesEnergy(system)) {
        conserved_ = energyOf(system);
        kinetic_ = kineticEnergyOf(system);
    }
    if (!conserved_) return;
    start_ = conserved_(start.t, start.x.data());
    scale_ = std::abs(start_);
    if (kinetic_) {
        constexpr double rest = 1e-30;
        const double own = kinetic_(start.t, start.x.data()),
                     gained = gainedKineticEnergy(system, start, step);
        scale_ = std::max({scale_, own, own <= rest * gained ? gained : 0});
    }
    // Without the parts of the energy its zero cannot be told from a small one.
    if (!std::isfinite(start_) || (!kinetic_ && !(scale_ > 0))) conserved_ = {};
}

bool Judge::isOut(double t, const double* x) const {
    return scale_ > 0 && std::abs(conserved_(t, x) - start_) > band * scale_;
}

void Judge::learn(double t, const double* x) {
    if (!kinetic_) return;
    const double size = kinetic_(t, x);
    if (std::abs(conserved_(t, x) - start_) <= size / 2) scale_ = std::max(scale_, size);
}

/// Of one explicit step from the start; 0 where it is not known.
double Judge::gainedKineticEnergy(const System& system, const State& start, double step) const {
    std::vector<double> x(start.x), rate(x.size());
    if (!rateOf(system, start.t, x.data(), rate.data())) return 0;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += step * rate[k];
    const double gained = kinetic_(start.t, x.data());
    return std::isfinite(gained) ? gained : 0;
}

std::size_t Judge::soundNodes(const NodeBlock& nodes, bool isLast) {
    constexpr long long often = 16;
    if (!conserved_ || nodes.size() == 0) return nodes.size();
    const std::size_t last = nodes.size() - 1;
    if (nodes.capacity() == 1 && !isLast && nodes.node(last) > often && nodes.node(last) % often != 0)
        return nodes.size();
    learn(nodes.t(last), nodes.x(last));
    if (!isOut(nodes.t(last), nodes.x(last))) return nodes.size();
    std::size_t sound = 0;
    while (!isOut(nodes.t(sound), nodes.x(sound))) ++sound;
    return sound;
}

}  // namespace extremal
