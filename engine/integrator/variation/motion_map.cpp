// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/motion_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solve/newton.hpp"

namespace extremal {
namespace {

/// The error of a central difference is d^2 and eps / d: the cube root of eps balances them.
constexpr double differencePart = 6e-6;

}  // namespace

std::string motionMapProblem(const Integrator& integrator) {
    if (integrator.grid() == TimeGrid::landing) return "steps that are chosen by a tolerance";
    if (integrator.grid() == TimeGrid::free) return "steps whose times are unknowns";
    if (integrator.tangentSize() == 0) return "no tangent map: " + integrator.tangentProblem();
    if (!integrator.memoryParts().empty()) return "a memory besides its state";
    return {};
}

MotionMap::MotionMap(std::unique_ptr<Integrator> integrator, double start, long long steps)
    : integrator_(std::move(integrator)), start_(start), steps_(steps) {}

void MotionMap::begin(const Eigen::VectorXd& x, double length) {
    const double h = length / static_cast<double>(steps_);
    if (h != integrator_->stepSize()) integrator_->setStep(h);
    clock_ = {start_, h};
    state_ = State{start_, 0, {x.data(), x.data() + x.size()}, {}};
    integrator_->begin(state_);
}

StepReport MotionMap::step(long long k) {
    StepReport report = integrator_->advance(state_, clock_.at(k));
    if (report.outcome == Outcome::converged &&
        !std::all_of(state_.x.begin(), state_.x.end(), [](double x) { return std::isfinite(x); }))
        report.outcome = Outcome::notFinite;
    if (report.outcome != Outcome::converged) failedAt_ = clock_.at(k - 1);
    return report;
}

Outcome MotionMap::apply(const Eigen::VectorXd& x, double length, Eigen::VectorXd& image,
                         Eigen::MatrixXd* M) {
    const bool hasTangents = integrator_->tangentSize() > 0;
    if (M && !hasTangents)
        if (const Outcome outcome = differences(x, length, *M); outcome != Outcome::converged) return outcome;
    begin(x, length);
    if (M && hasTangents) *M = Eigen::MatrixXd::Identity(x.size(), x.size());
    for (long long k = 1; k <= steps_; ++k) {
        const StepReport report = step(k);
        if (report.outcome != Outcome::converged) return report.outcome;
        if (!M || !hasTangents) continue;
        const std::span<double> columns(M->data(), static_cast<std::size_t>(M->size()));
        if (report.event != StepEvent::none || !integrator_->applyTangent(columns)) {
            failedAt_ = clock_.at(k - 1);
            return Outcome::refused;
        }
    }
    image = Eigen::Map<const Eigen::VectorXd>(state_.x.data(), x.size());
    return Outcome::converged;
}

Outcome MotionMap::differences(const Eigen::VectorXd& x, double length, Eigen::MatrixXd& M) {
    const Eigen::Index n = x.size();
    M.resize(n, n);
    Eigen::VectorXd moved = x, above, below;
    const double least = 1e-3 * x.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < n; ++i) {
        const double shift = differencePart * std::max({std::abs(x(i)), least, 1e-300});
        moved(i) = x(i) + shift;
        if (const Outcome o = apply(moved, length, above, nullptr); o != Outcome::converged) return o;
        moved(i) = x(i) - shift;
        if (const Outcome o = apply(moved, length, below, nullptr); o != Outcome::converged) return o;
        moved(i) = x(i);
        M.col(i) = (above - below) / (2 * shift);
    }
    return Outcome::converged;
}

Outcome MotionMap::firstStep(const Eigen::VectorXd& x, double length, Eigen::VectorXd& image) {
    begin(x, length);
    const StepReport report = step(1);
    image = Eigen::Map<const Eigen::VectorXd>(state_.x.data(), x.size());
    return report.outcome;
}

Outcome MotionMap::slope(const Eigen::VectorXd& x, double length, Eigen::VectorXd& slope) {
    const double shift = differencePart * std::abs(length);
    Eigen::VectorXd below;
    if (const Outcome o = apply(x, length - shift, below, nullptr); o != Outcome::converged) return o;
    if (const Outcome o = apply(x, length + shift, slope, nullptr); o != Outcome::converged) return o;
    slope = (slope - below) / (2 * shift);
    return Outcome::converged;
}

Outcome arrive(MotionMap& map, Eigen::VectorXd& x, double length, const Eigen::VectorXd& goal,
               std::vector<double>* misses) {
    const Eigen::Index d = goal.size();
    Eigen::VectorXd p = x.tail(d), image;
    Eigen::MatrixXd M;
    Outcome trouble = Outcome::converged;
    const Outcome outcome = solveNewton<double>(
        p, [&](const Eigen::VectorXd& momenta, Eigen::VectorXd& miss, Eigen::MatrixXd* J) {
            x.tail(d) = momenta;
            trouble = map.apply(x, length, image, J ? &M : nullptr);
            if (trouble != Outcome::converged) return false;
            miss = image.head(d) - goal;
            if (J) *J = M.topRightCorner(d, d);
            if (J && misses) misses->push_back(miss.norm());
            return true;
        });
    x.tail(d) = p;
    return outcome == Outcome::notFinite && trouble != Outcome::converged ? trouble : outcome;
}

}  // namespace extremal
