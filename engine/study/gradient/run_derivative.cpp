// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/gradient/run_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/varied_motion.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

constexpr long long mostSteps = 10'000'000;

/// The scene with one scheme, whose system names the numbers.
std::shared_ptr<const ResolvedScene> withNumbers(const ResolvedScene& scene, std::size_t scheme,
                                                 const RunDerivative::Request& request) {
    Value document = toValue(scene.scene);
    keepAlone(document, scheme);
    if (!request.pointers.empty()) {
        Value::Array listed;
        for (const std::string& pointer : request.pointers) listed.emplace_back(pointer);
        document.set("observe", Value::Array{"sensitivity"});
        document.set("sensitivity", std::move(listed));
    }
    Value reference{Value::Object{}};
    reference.set("type", "none");
    document.set("reference", std::move(reference));
    const ReadScene read = readScene(document);
    if (!read.resolved)
        throw InvalidScene(request.option, read.errors.front().message, read.errors.front().hint);
    return std::make_shared<const ResolvedScene>(*read.resolved);
}

}  // namespace

RunDerivative::RunDerivative(const ResolvedScene& scene, const Request& request) {
    for (const std::string& pointer : request.pointers)
        if (const std::string problem = variedNumberProblem(scene.scene, *scene.system, pointer);
            !problem.empty())
            throw InvalidScene(request.option, pointer + " " + problem,
                               "for example /model/k, or /initial/q/0");
    scene_ = withNumbers(scene, schemeNamed(scene, request.scheme), request);
    const ResolvedScheme& scheme = scene_->schemes.front();
    const System& system = *systemOf(*scene_, scheme);
    label_ = scheme.spec.label;
    const double step = signedStep(scene_->scene, scheme.spec.step.value);
    start_ = initialOf(*scene_, scheme);
    auto own = scheme.make(system, step, start_);
    const auto refuse = [&](const std::string& problem) {
        throw InvalidScene("--scheme", "\"" + label_ + "\" cannot be differentiated: it has " + problem,
                           "a Galerkin scheme, whose steps have tangent maps");
    };
    if (const std::string problem = differentiationProblem(*scene_, scheme, *own); !problem.empty())
        refuse(problem);
    VariedExtras extras;
    extras.integrand = request.integrand;
    for (const auto& [name, count] : request.controls) extras.controls.push_back({name, count, step});
    if (!request.controls.empty() && !scheme.isFixed())
        throw InvalidScene("--scheme", "\"" + label_ + "\" has no given step, which controls are bound to",
                           "a scheme with one");
    d_ = static_cast<int>(system.coordinates.size());
    const bool isVaried = !request.pointers.empty() || !extras.isEmpty();
    VariedMotion along;
    if (isVaried) along = variedMotion(*scene_, scheme, step, start_, VariedDirection::backward, extras);
    if (!along.problem.empty() && along.place == "--over") throw InvalidScene(along.place, along.problem);
    if (!along.problem.empty()) refuse(along.problem);
    if (!along.varied.problem.empty()) throw InvalidScene(request.option, along.varied.problem);
    findTimes(scheme, step);
    numbers_ = along.varied.numbers;
    names_ = along.varied.names;
    parameters_ = along.varied.parameters;
    u_ = static_cast<int>(parameters_.size());
    if (!extras.integrand.empty()) integral_ = along.varied.integral;
    for (std::size_t i = 0; i < extras.controls.size(); ++i) {
        controls_.push_back(
            {d_ + static_cast<Eigen::Index>(along.varied.controls[i]), extras.controls[i].coefficients});
        coefficients_ += extras.controls[i].coefficients;
    }
    if (along.integrator) start_ = along.start;
    start_.memory.clear();
    sweep_ = std::make_unique<BackwardSweep>(
        along.integrator ? std::move(along.integrator) : std::move(own),
        BackwardSweep::Steps{steps(), [this](long long k) { return times_[static_cast<std::size_t>(k)]; }},
        [this](long long k, std::span<double> x) {
            Eigen::Index row = 0;
            for (const Control& control : controls_) {
                for (Eigen::Index j = 0; j < control.count; ++j)
                    x[static_cast<std::size_t>(control.first + j)] = c_(row++, k);
                x[static_cast<std::size_t>(control.first + control.count)] =
                    times_[static_cast<std::size_t>(k)];
            }
        });
}

void RunDerivative::findTimes(const ResolvedScheme& scheme, double step) {
    const double start = scene_->scene.start.value, end = scene_->scene.end.value;
    const auto require = [&](long long count) {
        if (count > mostSteps)
            throw InvalidScene("--scheme", "\"" + label_ + "\" takes more than 1e7 steps", "a longer step");
    };
    times_.assign(1, start);
    if (scheme.isFixed()) {
        const long long count = stepCount(start, end, step);
        require(count);
        const Clock clock{start, step};
        for (long long k = 1; k <= count; ++k) times_.push_back(clock.at(k));
        return;
    }
    const auto integrator = scheme.make(*systemOf(*scene_, scheme), step, start_);
    State state = start_;
    integrator->begin(state);
    while (state.t != end) {
        const StepReport report = integrator->advance(state, end);
        if (report.outcome != Outcome::converged)
            throw InvalidScene("--scheme", "\"" + label_ + "\" stops at t = " + formatNumber(state.t, 4) +
                                               ": " + std::string(name(report.outcome)));
        times_.push_back(state.t);
        require(steps());
    }
}

Eigen::VectorXd RunDerivative::start() const { return stateOf(start_); }
Eigen::VectorXd RunDerivative::stateOf(const State& state) const {
    Eigen::VectorXd x(2 * d_);
    for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = state.x[static_cast<std::size_t>(entry(i))];
    return x;
}
Eigen::MatrixXd RunDerivative::stateRows(const Eigen::MatrixXd& columns) const {
    Eigen::MatrixXd rows(2 * d_, columns.cols());
    for (Eigen::Index i = 0; i < 2 * d_; ++i) rows.row(i) = columns.row(entry(i));
    return rows;
}
double RunDerivative::integral() const {
    return integral_ ? sweep_->end().x[static_cast<std::size_t>(2 * d_ + u_) + *integral_] : 0;
}

Outcome RunDerivative::run(const Eigen::VectorXd& start, const Eigen::MatrixXd& c,
                           const std::stop_token& stop) {
    State from = start_;
    for (Eigen::Index i = 0; i < start.size(); ++i) from.x[static_cast<std::size_t>(entry(i))] = start(i);
    c_ = c;
    sweep_->setStop(stop);
    return sweep_->forward(from);
}

Eigen::VectorXd RunDerivative::columnOf(const Eigen::VectorXd& byState, double byIntegral,
                                        const Eigen::VectorXd& byParameters) const {
    Eigen::VectorXd l = Eigen::VectorXd::Zero(2 * (d_ + u_));
    for (Eigen::Index i = 0; i < byState.size(); ++i) l(entry(i)) = byState(i);
    if (byParameters.size() > 0) l.segment(d_, u_) = byParameters;
    if (integral_) l(2 * d_ + u_ + static_cast<Eigen::Index>(*integral_)) = byIntegral;
    return l;
}

Outcome RunDerivative::differentiate(Eigen::MatrixXd columns, Derivatives& derivatives, const See& see) {
    if (see) see(steps(), end(), stateRows(columns));
    derivatives.byCoefficients.assign(static_cast<std::size_t>(columns.cols()),
                                      Eigen::MatrixXd::Zero(coefficients_, steps()));
    const Outcome outcome =
        sweep_->backward(columns, [&](long long k, const State& state, Eigen::MatrixXd& l) {
            Eigen::Index row = 0;
            for (const Control& control : controls_) {
                for (Eigen::Index j = 0; j < control.count; ++j, ++row)
                    for (Eigen::Index i = 0; i < l.cols(); ++i)
                        derivatives.byCoefficients[static_cast<std::size_t>(i)](row, k) =
                            l(control.first + j, i);
                l.middleRows(control.first, control.count + 1).setZero();
            }
            if (see) see(k, stateOf(state), stateRows(l));
        });
    if (outcome != Outcome::converged) return outcome;
    derivatives.byStart = stateRows(columns);
    derivatives.byNumbers.setZero(static_cast<Eigen::Index>(numbers_.size()), columns.cols());
    for (std::size_t n = 0; n < numbers_.size(); ++n) {
        auto row = derivatives.byNumbers.row(static_cast<Eigen::Index>(n));
        row = Eigen::Map<const Eigen::VectorXd>(numbers_[n].start.data(), 2 * d_).transpose() *
              derivatives.byStart;
        for (std::size_t u = 0; u < numbers_[n].parameters.size(); ++u)
            row += numbers_[n].parameters[u] * columns.row(d_ + static_cast<Eigen::Index>(u));
    }
    return outcome;
}

}  // namespace extremal
