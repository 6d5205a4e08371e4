// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/fit/fitted_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/sensitivities.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;

/// A node is where it is to this part of a step.
constexpr double sameTime = 1e-9;

std::vector<Override> overridesOf(const std::vector<std::string>& pointers, const Vector& numbers) {
    std::vector<Override> all;
    for (std::size_t i = 0; i < pointers.size(); ++i)
        all.push_back({pointers[i], Value(numbers(static_cast<Eigen::Index>(i)))});
    return all;
}

/// A number of the scene, where it is one; expressions of initial values are worth what they are.
double numberAt(const ResolvedScene& scene, const Value& document, const std::string& pointer) {
    if (const std::string problem = variedNumberProblem(scene.scene, *scene.system, pointer);
        !problem.empty())
        throw InvalidScene("--free", pointer + " " + problem, "for example /model/k, or /initial/q/0");
    const Value* const given = valueAt(document, pointer);
    if (given && given->isNumber()) return given->asNumber();
    const auto place = splitPointer(pointer).value_or(std::vector<std::string>{});
    const auto index = place.size() == 3 && place[0] == "initial" ? arrayIndex(place[2]) : std::nullopt;
    if (index && place[1] == "q" && *index < scene.scene.initial.q.size())
        return scene.scene.initial.q[*index].value;
    if (index && *index < scene.scene.initial.pOrV.size()) return scene.scene.initial.pOrV[*index].value;
    throw InvalidScene("--free", pointer + " is not a plain number",
                       "a number in the scene: --set " + pointer + "=VALUE");
}

}  // namespace

FittedMotion::FittedMotion(const ResolvedScene& scene, std::size_t scheme, std::vector<std::string> pointers,
                           const MeasuredData& data, double part)
    : document_(toValue(scene.scene)), pointers_(std::move(pointers)), data_(data), part_(part) {
    start_.resize(static_cast<Eigen::Index>(pointers_.size()));
    Value::Array listed;
    for (std::size_t i = 0; i < pointers_.size(); ++i) {
        start_(static_cast<Eigen::Index>(i)) = numberAt(scene, document_, pointers_[i]);
        listed.emplace_back(pointers_[i]);
    }
    keepAlone(document_, scheme);
    document_.set("observe", Value::Array{"sensitivity"});
    document_.set("sensitivity", std::move(listed));
    Value reference{Value::Object{}};
    reference.set("type", "none");
    document_.set("reference", std::move(reference));
    const ReadScene read = readScene(document_);
    if (!read.resolved) throw InvalidScene("--free", read.errors.front().message, read.errors.front().hint);
    if (const auto* const varied = read.resolved->system->parts.find<VariedNumbers>())
        for (const VariedNumbers::Each& each : varied->all) names_.push_back(each.name);
    const ResolvedScheme& own = read.resolved->schemes.front();
    const double step = own.spec.step.value * part_;
    const State& initial = initialOf(*read.resolved, own);
    const auto integrator = own.make(*systemOf(*read.resolved, own), step, initial);
    if (const std::string problem = sensitivityProblem(*read.resolved, own, *integrator, step, initial);
        !problem.empty() || names_.size() != pointers_.size())
        throw InvalidScene("--scheme", "\"" + own.spec.label + "\" cannot be differentiated: " + problem,
                           "a Galerkin scheme, or other numbers in --free");
}

bool FittedMotion::evaluate(const Vector& numbers, Values& values) {
    problem_.clear();
    const ReadScene read = readScene(document_, overridesOf(pointers_, numbers));
    if (!read.resolved) {
        problem_ = read.errors.front().pointer + " " + read.errors.front().message;
        return false;
    }
    return compute(*read.resolved, values);
}

bool FittedMotion::compute(const ResolvedScene& scene, Values& values) {
    const ResolvedScheme& scheme = scene.schemes.front();
    const System& system = *systemOf(scene, scheme);
    const double h = scheme.spec.step.value * part_;
    State state = initialOf(scene, scheme), there;
    const auto made = [&] {
        return measuringSensitivities(scheme.make(system, h, state), scene, scheme, h, state);
    };
    const auto integrator = made(), between = made();
    integrator->setStop(stop_);
    between->setStop(stop_);
    integrator->begin(state);
    const Clock clock{scene.scene.start.value, h};
    const auto size = static_cast<Eigen::Index>(data_.all.size());
    const auto free = static_cast<Eigen::Index>(pointers_.size());
    const std::size_t entries = stateColumns(system).size();
    values.computed.resize(size);
    values.residual.resize(size);
    values.derivative.resize(size, free);
    const auto fails = [&](const StepReport& report) {
        if (report.outcome == Outcome::converged) return false;
        problem_ =
            "a step at t = " + formatNumber(state.t, 4) + " fails: " + std::string(name(report.outcome));
        return true;
    };
    const State* at = &state;
    for (Eigen::Index i = 0; i < size; ++i) {
        const Measurement& each = data_.all[static_cast<std::size_t>(i)];
        while (clock.at(state.node + 1) <= each.t + sameTime * h) {
            if (fails(integrator->advance(state, clock.at(state.node + 1)))) return false;
            at = &state;
        }
        const double beyond = each.t - clock.at(state.node);
        if (std::abs(beyond) > sameTime * h && (at == &state || there.t != each.t)) {
            there = state;
            at = &there;
            between->setStep(beyond);
            if (fails(between->advance(there, each.t))) return false;
        }
        // What is carried along is the end of the memory (integrator/variation/accompanied.hpp).
        const std::size_t entry = data_.columns[each.column].entry;
        const double* const carried =
            at->memory.data() + at->memory.size() - entries * static_cast<std::size_t>(free);
        values.computed(i) = at->x[entry];
        values.residual(i) = (values.computed(i) - each.value) / each.deviation;
        for (Eigen::Index k = 0; k < free; ++k)
            values.derivative(i, k) = carried[static_cast<std::size_t>(k) * entries + entry] / each.deviation;
    }
    if (!values.residual.allFinite() || !values.derivative.allFinite()) {
        problem_ = "the motion or its derivative is not finite";
        return false;
    }
    return true;
}

Value FittedMotion::sceneWith(const Value& document, const Vector& numbers) const {
    const ReadScene read = readScene(document, overridesOf(pointers_, numbers));
    return read.errors.empty() ? toValue(read.scene) : document;
}

}  // namespace extremal
