#include "engine/run/judge.hpp"

#include <algorithm>
#include <bit>
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

/// By the number of the node alone, as the sizes of blocks follow the clock.
bool Judge::looksAt(long long node) const {
    constexpr long long often = 64, apart = 37;  // no common factor
    if (gains_ > 0) return true;
    if (node <= often) return std::has_single_bit(static_cast<unsigned long long>(node));
    return node % often == node / often * apart % often;
}

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
    startTime_ = lastTime_ = gainTime_ = start.t;
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

bool Judge::isSound(double t, const double* x) {
    if (!conserved_) return true;
    const double change = conserved_(t, x) - start_;
    if (kinetic_) {
        const double kinetic = kinetic_(t, x);
        if (std::abs(change) <= kinetic / 2) scale_ = std::max(scale_, kinetic);
        noteGain(t, change, kinetic);
    }
    return !(scale_ > 0 && std::abs(change) > band * scale_);
}

void Judge::noteGain(double t, double change, double kinetic) {
    constexpr double ofMean = 0.5, ofScale = 0.1;
    work_ += kinetic * std::abs(t - lastTime_);
    lastTime_ = t;
    const double mean = work_ / std::abs(t - startTime_);
    if (change > ofMean * mean && change > ofScale * scale_) {
        ++gains_;
    } else {
        gains_ = 0;
        gainTime_ = t;
    }
}

bool Judge::hasGained() const {
    constexpr int fewest = 3;
    return gains_ >= fewest && std::abs(lastTime_ - gainTime_) >= std::abs(lastTime_ - startTime_) / 2;
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
    if (!conserved_) return nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool isEnd = isLast && i + 1 == nodes.size();
        if (!isEnd && !looksAt(nodes.node(i))) continue;
        if (!isSound(nodes.t(i), nodes.x(i)) || (isEnd && hasGained())) return i;
    }
    return nodes.size();
}

}  // namespace extremal
