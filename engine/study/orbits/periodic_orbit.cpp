// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/mechanism/tangent_space.hpp"
#include "engine/model/conservative.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

/// A multiplier is on the unit circle within this: the pair at 1 of an energy is defective, and errs by the
/// root of round-off times the size of M.
constexpr double onTheCircle = 1e-5;
constexpr double rankFloor = 1e-9;

OrbitKind kindOf(const System& system) {
    const Force* const force = system.parts.find<Force>();
    if (!timeDependentPart(system).empty() || (force && force->isTimeDependent)) return OrbitKind::forced;
    return energySource(system).empty() ? OrbitKind::conservative : OrbitKind::dissipative;
}

std::unique_ptr<Integrator> integratorOf(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    const std::string label = "\"" + scheme.spec.label + "\"";
    const System& system = *systemOf(scene, scheme);
    if (scheme.isAdaptive())
        throw InvalidScene("--scheme", label + " has steps that are chosen by a tolerance",
                           "a scheme with a given step: orbits close after whole steps");
    auto integrator =
        scheme.make(system, signedStep(scene.scene, scheme.spec.step.value), initialOf(scene, scheme));
    if (const std::string problem = motionMapProblem(*integrator); !problem.empty())
        throw InvalidScene("--scheme", label + " has " + problem,
                           "a Galerkin scheme, or a one-step baseline");
    if (integrator->tangentSize() != stateColumns(system).size())
        throw InvalidScene("/model/type",
                           "periodic orbits are sought of states in coordinates and momenta, which " +
                               scene.scene.model.type + " does not have",
                           "a typed Lagrangian, Hamiltonian or one-form");
    return integrator;
}

void refuse(const std::string& what, const std::string& remedy) {
    throw InvalidScene("/initial", what, remedy);
}

/// Along one entry of x, with the rounding that its size allows.
double slopeAlong(const EnergyFunction& energy, double t, Vector x, Index i, double size) {
    const double shift = 6e-6 * size, here = x(i);
    x(i) = here + shift;
    const double above = energy(t, x.data()), right = x(i);
    x(i) = here - shift;
    return (above - energy(t, x.data())) / (right - x(i));
}

}  // namespace

OrbitGuess guessOf(const PeriodicOrbit& orbit) {
    return {Eigen::Map<const Vector>(orbit.x.data(), static_cast<Index>(orbit.x.size())), orbit.period};
}

OrbitEquations::OrbitEquations(std::shared_ptr<const ResolvedScene> scene, std::size_t scheme,
                               long long steps)
    : scene_(std::move(scene)),
      system_(systemOf(*scene_, scene_->schemes[scheme]).get()),
      energy_(energyOf(*system_)),
      kind_(kindOf(*system_)),
      map_(integratorOf(*scene_, scene_->schemes[scheme]), scene_->scene.start.value, steps),
      free_(system_->hasCoordinates() ? freeVariations(*system_)
                                      : static_cast<Index>(stateColumns(*system_).size())) {
    if (kind_ == OrbitKind::conservative) hold_ = OrbitHold::energy;
}

double OrbitEquations::energyAt(const Vector& x) const {
    return energy_ ? energy_(map_.start(), x.data()) : std::numeric_limits<double>::quiet_NaN();
}

void OrbitEquations::measure(const OrbitGuess& guess) {
    std::vector<State> nodes;
    if (const Outcome outcome = follow(guess, nodes); outcome != Outcome::converged)
        refuse("the motion of the guess fails at t = " + formatNumber(map_.failedAt(), 4) + ": " +
                   std::string(name(outcome)),
               "a smaller step, or a start nearer to the orbit");
    const Index n = guess.x.size();
    sizes_ = Vector::Zero(n);
    for (const State& node : nodes)
        sizes_ = sizes_.cwiseMax(Eigen::Map<const Vector>(node.x.data(), n).cwiseAbs());
    // An entry that stays 0 on the guess may move on the orbit: it is as large as others of its kind.
    const Index half = system_->hasCoordinates() ? n / 2 : n;
    for (Index from = 0; from < n; from += half) {
        const double largest = sizes_.segment(from, half).maxCoeff();
        sizes_.segment(from, half) = sizes_.segment(from, half).cwiseMax(largest > 0 ? 1e-3 * largest : 1);
    }
    time_ = std::abs(guess.period);
    const Vector end = Eigen::Map<const Vector>(nodes.back().x.data(), n);
    turns_ = Vector::Zero(n);
    for (Index i = 0; system_->hasCoordinates() && i < half; ++i) {
        const double turn = 2 * std::numbers::pi, whole = turn * std::round((end(i) - guess.x(i)) / turn);
        if (whole == 0 || std::abs(end(i) - guess.x(i) - whole) > 0.25 * turn) continue;
        Vector shifted = guess.x, a, b;
        shifted(i) += whole;  // only where the motion from there is the same
        Matrix* const none = nullptr;
        if (map_.apply(guess.x, guess.period, a, none) == Outcome::converged &&
            map_.apply(shifted, guess.period, b, none) == Outcome::converged &&
            std::abs(b(i) - a(i) - whole) < 1e-6 && (b - a).cwiseAbs().maxCoeff() < std::abs(whole) + 1e-6)
            turns_(i) = whole;
    }
    setPhase(guess);
    if (kind_ != OrbitKind::forced) return;
    Vector later;
    map_.setStart(map_.start() + guess.period);
    const Outcome outcome = map_.apply(guess.x, guess.period, later, nullptr);
    map_.setStart(map_.start() - guess.period);
    if (outcome != Outcome::converged || (later - end).cwiseQuotient(sizes_).cwiseAbs().maxCoeff() > 1e-6)
        throw InvalidScene("--period",
                           "the equations change with time, and after " + formatNumber(guess.period, 9) +
                               " they are not what they were",
                           "the period of the drive, or a multiple of it: --period '2*pi/omega'");
}

void OrbitEquations::measureAs(const OrbitEquations& other, const OrbitGuess& guess) {
    sizes_ = other.sizes_;
    turns_ = other.turns_;
    time_ = other.time_;
    setPhase(guess);
}

void OrbitEquations::setPhase(const OrbitGuess& guess) {
    x_ = guess.x;
    if (kind_ == OrbitKind::forced) return;
    Vector first;
    phase_ = Vector::Zero(guess.x.size());
    if (map_.firstStep(guess.x, guess.period, first) == Outcome::converged)
        phase_ = (first - guess.x).cwiseQuotient(sizes_);
    const double length = phase_.norm();
    if (!(length > 1e-10 / static_cast<double>(steps())))
        refuse("the start is at rest, where every time is a period", "a start that moves");
    phase_ /= length;
}

void OrbitEquations::hold(OrbitHold what, double value) {
    hold_ = what;
    held_ = value;
}

Matrix OrbitEquations::basisAt(const Vector& x) const {
    if (free_ == x.size()) return Matrix(sizes_.asDiagonal());
    const std::vector<double> columns = tangentBasis(*system_)(map_.start(), x.data());
    return Eigen::Map<const Matrix>(columns.data(), x.size(), free_) * sizes_.maxCoeff();
}

Outcome OrbitEquations::evaluate(const OrbitGuess& at, Residual& residual, bool isDerivativeWanted) {
    const Index n = at.x.size();
    const bool hasPhase = kind_ != OrbitKind::forced;
    const bool isEnergyHeld = hold_ == OrbitHold::energy;
    const Index rows = n + (hasPhase ? 1 : 0) + (isEnergyHeld ? 1 : 0);
    Vector end;
    const Outcome outcome = map_.apply(at.x, at.period, end, isDerivativeWanted ? &residual.M : nullptr);
    if (outcome != Outcome::converged) return outcome;
    residual.value.resize(rows);
    residual.value.head(n) = (end - at.x - turns_).cwiseQuotient(sizes_);
    residual.gap = residual.value.head(n).cwiseAbs().maxCoeff();
    Index row = n;
    if (hasPhase) residual.value(row++) = phase_.dot((at.x - x_).cwiseQuotient(sizes_));
    Vector slopes;
    if (isEnergyHeld) {
        slopes.resize(n);
        for (Index i = 0; i < n; ++i)
            slopes(i) = slopeAlong(energy_, map_.start(), at.x, i, sizes_(i)) * sizes_(i);
        const double scale = std::max(slopes.norm(), std::numeric_limits<double>::min());
        slopes /= scale;
        residual.value(row) = (energyAt(at.x) - held_) / scale;
    }
    if (!isDerivativeWanted) return outcome;
    const Matrix B = basisAt(at.x);
    const Matrix moves = sizes_.cwiseInverse().asDiagonal() * B;
    residual.derivative.setZero(rows, unknowns());
    residual.derivative.topLeftCorner(n, free_) = sizes_.cwiseInverse().asDiagonal() * (residual.M * B - B);
    row = n;
    if (hasPhase) residual.derivative.row(row++).head(free_) = phase_.transpose() * moves;
    if (isEnergyHeld) residual.derivative.row(row).head(free_) = slopes.transpose() * moves;
    if (!isPeriodFree()) return outcome;
    Vector rate;
    const Outcome slope = map_.slope(at.x, at.period, rate);
    if (slope == Outcome::converged)
        residual.derivative.col(free_).head(n) = rate.cwiseQuotient(sizes_) * time_;
    return slope;
}

OrbitGuess OrbitEquations::moved(const OrbitGuess& from, const Vector& by) const {
    OrbitGuess to = from;
    to.x += basisAt(from.x) * by.head(free_);
    if (isPeriodFree()) to.period += time_ * by(free_);
    if (free_ < to.x.size()) {
        State state{map_.start(), 0, {to.x.data(), to.x.data() + to.x.size()}, {}};
        putOnConstraints(*system_, state, true);
        to.x = Eigen::Map<const Vector>(state.x.data(), to.x.size());
    }
    return to;
}

Vector OrbitEquations::between(const OrbitGuess& from, const OrbitGuess& to) const {
    Vector by(unknowns());
    const Matrix B = basisAt(from.x);
    by.head(free_) = free_ == from.x.size() ? Vector((to.x - from.x).cwiseQuotient(sizes_))
                                            : Vector(dense::leastSquares<double>(B, to.x - from.x));
    if (isPeriodFree()) by(free_) = (to.period - from.period) / time_;
    return by;
}

PeriodicOrbit OrbitEquations::orbitAt(const OrbitGuess& at, const Residual& residual,
                                      std::vector<double> closes) const {
    PeriodicOrbit orbit{{at.x.data(), at.x.data() + at.x.size()},
                        at.period,
                        energyAt(at.x),
                        residual.gap,
                        std::move(closes),
                        {}};
    const Matrix B = basisAt(at.x);
    const Matrix along = dense::leastSquares<double>(B, residual.M * B);
    orbit.trace = along.trace();
    const Eigen::VectorXcd values = dense::eigenvalues(along);
    orbit.multipliers.assign(values.data(), values.data() + values.size());
    std::sort(orbit.multipliers.begin(), orbit.multipliers.end(), [](const auto& a, const auto& b) {
        const double left = std::abs(a), right = std::abs(b);
        return left != right ? left > right : a.imag() > b.imag();
    });
    return orbit;
}

OrbitStability OrbitEquations::stabilityOf(const PeriodicOrbit& orbit) const {
    std::vector<std::complex<double>> others = orbit.multipliers;
    for (std::size_t k = 0; k < trivial() && !others.empty(); ++k)
        others.erase(std::min_element(others.begin(), others.end(), [](const auto& a, const auto& b) {
            return std::abs(a - 1.0) < std::abs(b - 1.0);
        }));
    double largest = 0;
    for (const auto& each : others) largest = std::max(largest, std::abs(each));
    if (largest > 1 + onTheCircle) return OrbitStability::unstable;
    return largest < 1 - onTheCircle && kind_ != OrbitKind::conservative ? OrbitStability::attracting
                                                                         : OrbitStability::elliptic;
}

Outcome OrbitEquations::follow(const OrbitGuess& orbit, std::vector<State>& nodes) {
    nodes.clear();
    return map_.follow(orbit.x, orbit.period, [&](long long, const State& state) { nodes.push_back(state); });
}

Vector leastCorrection(const Matrix& J, const Vector& r) {
    const Index size = std::max(J.rows(), J.cols());
    Matrix square = Matrix::Zero(size, size);
    square.topLeftCorner(J.rows(), J.cols()) = J;
    const dense::RightSingular svd = dense::rightSingular(square);
    Vector d = Vector::Zero(J.cols());
    for (Index i = 0; i < size && svd.values(i) > rankFloor * svd.values(0); ++i) {
        const Vector v = svd.V.col(i).head(J.cols());
        d -= v * ((J * v).dot(r) / (svd.values(i) * svd.values(i)));
    }
    return d;
}

}  // namespace extremal
