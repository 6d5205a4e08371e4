// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/gradient/steering.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/interpolant.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/constrained_minimum.hpp"
#include "engine/study/gradient/end_function.hpp"
#include "engine/study/gradient/run_derivative.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

/// Of runs whose controls are sought: each iteration takes many runs.
constexpr long long mostSteeredSteps = 100'000;

std::vector<std::string> controlsIn(const ResolvedScene& scene, const SteeringRequest& request) {
    std::vector<std::string> known;
    if (const Value* const all = scene.scene.model.find("controls"); all && all->isObject())
        for (const auto& [name, control] : all->asObject()) known.push_back(name);
    if (known.empty())
        throw InvalidScene("--control", scene.scene.model.type + " has no controls",
                           R"(a typed Lagrangian with "controls": {"u": "0"} and u in a force)");
    for (const std::string& name : request.controls)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InvalidScene("--control", "there is no control \"" + name + "\"", suggestName(name, known));
    return request.controls.empty() ? known : request.controls;
}

/// Where a control begins: what the scene has.
std::function<double(double t)> guessOf(const ResolvedScene& scene, const std::string& name) {
    const Value& control = *scene.scene.model.find("controls")->find(name);
    if (!control.isString()) {
        std::vector<double> times, values;
        for (const Value& row : control.find("table")->asArray()) {
            times.push_back(row.asArray()[0].asNumber());
            values.push_back(row.asArray()[1].asNumber());
        }
        const Value* const kind = control.find("interpolation");
        const bool isCubic = kind && *kind == Value("cubic");
        return [curve = Interpolant(isCubic ? Interpolant::Kind::cubic : Interpolant::Kind::linear, times,
                                    values)](double t) { return curve.at(t); };
    }
    return [constants = formulaConstants(scene.scene, *scene.system),
            formula = parseExpression(control.asString())](double t) {
        return evaluate(formula, [&](std::string_view each) -> std::optional<double> {
            if (each == "t") return t;
            const auto found = constants.find(std::string(each));
            return found == constants.end() ? std::nullopt : std::optional(found->second);
        });
    };
}

struct Bounds {
    double lower = -HUGE_VAL, upper = HUGE_VAL;
};
std::vector<Bounds> boundsOf(const std::vector<std::string>& texts, const std::vector<std::string>& names) {
    std::vector<Bounds> all(names.size());
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('='), colon = text.find(':', equals);
        const auto refuse = [&] {
            throw InvalidScene("--bounds", "must be NAME=LOWER:UPPER, got \"" + text + "\"",
                               names.front() + "=-1:1; one side may be left out: " + names.front() + "=0:");
        };
        if (equals == std::string::npos || colon == std::string::npos) refuse();
        const auto at = std::find(names.begin(), names.end(), text.substr(0, equals));
        if (at == names.end())
            throw InvalidScene("--bounds", "\"" + text.substr(0, equals) + "\" is not one of the controls, " +
                                               joinNames(names));
        Bounds& bounds = all[static_cast<std::size_t>(at - names.begin())];
        const auto side = [&](const std::string& number, double& to) {
            if (number.empty()) return;
            const auto read = parseNumber(number);
            if (!read || !std::isfinite(*read)) refuse();
            to = *read;
        };
        side(text.substr(equals + 1, colon - equals - 1), bounds.lower);
        side(text.substr(colon + 1), bounds.upper);
        if (!(bounds.lower < bounds.upper)) refuse();
    }
    return all;
}

/// Values of the controls at Gauss points of each step, control after control, step after step, and the run
/// that they make.
class SteeredRun {
public:
    SteeredRun(const ResolvedScene& scene, const SteeringRequest& request, std::stop_token stop)
        : names_(controlsIn(scene, request)),
          points_(pointsOf(scene, request)),
          rule_(gauss<double>(points_)),
          run_(scene, requestOf(request)),
          cost_(request.of, "--of", run_),
          stop_(std::move(stop)) {
        if (run_.steps() < 1 || run_.steps() > mostSteeredSteps)
            throw InvalidScene("--scheme",
                               "\"" + run_.scheme() + "\" takes " + std::to_string(run_.steps()) +
                                   " steps, and controls are found for 1 to " +
                                   std::to_string(mostSteeredSteps),
                               "another step, or another end of the scene");
        for (const std::string& text : request.conditions) conditions_.emplace_back(text, "--end", run_);
        Matrix powers(points_, points_);
        for (Index i = 0; i < points_; ++i)
            for (Index j = 0; j < points_; ++j)
                powers(i, j) = std::pow(rule_.c[static_cast<std::size_t>(i)] - 0.5, static_cast<double>(j));
        toCoefficients_ = dense::inverse<double>(powers);
    }

    RunDerivative& run() { return run_; }
    const std::vector<std::string>& names() const { return names_; }
    Index unknowns() const { return run_.coefficients() * run_.steps(); }
    double timeOf(Index i) const {
        const auto k = static_cast<std::size_t>(i / run_.coefficients());
        const auto at = static_cast<std::size_t>(i % points_);
        return run_.times()[k] + rule_.c[at] * (run_.times()[k + 1] - run_.times()[k]);
    }
    std::size_t controlOf(Index i) const {
        return static_cast<std::size_t>(i % run_.coefficients() / points_);
    }
    /// h b_i, the weights of an integral over the run.
    double weightOf(Index i) const {
        const auto k = static_cast<std::size_t>(i / run_.coefficients());
        return std::abs(run_.times()[k + 1] - run_.times()[k]) *
               rule_.b[static_cast<std::size_t>(i % points_)];
    }

    bool evaluate(const Vector& u, double& J, Vector& misses) {
        Matrix c = Eigen::Map<const Matrix>(u.data(), run_.coefficients(), run_.steps());
        for (Index first = 0; first < c.rows(); first += points_)
            c.middleRows(first, points_) = (toCoefficients_ * c.middleRows(first, points_)).eval();
        outcome_ = run_.run(run_.start(), c, stop_);
        if (outcome_ != Outcome::converged) return false;
        const Vector end = run_.end();
        const EndFunction::Values cost = cost_.at(end);
        J = cost.value + run_.integral();
        columns_.resize(run_.columnOf(cost.byState, 1, cost.byParameters).size(),
                        1 + static_cast<Index>(conditions_.size()));
        columns_.col(0) = run_.columnOf(cost.byState, 1, cost.byParameters);
        misses.resize(static_cast<Index>(conditions_.size()));
        for (std::size_t j = 0; j < conditions_.size(); ++j) {
            const EndFunction::Values at = conditions_[j].at(end);
            misses(static_cast<Index>(j)) = at.value;
            columns_.col(1 + static_cast<Index>(j)) = run_.columnOf(at.byState, 0, at.byParameters);
        }
        return true;
    }
    bool differentiate(const Matrix& weights, Matrix& gradients, const RunDerivative::See& see = {}) {
        RunDerivative::Derivatives by;
        outcome_ = run_.differentiate(columns_ * weights, by, see);
        if (outcome_ != Outcome::converged) return false;
        gradients.resize(unknowns(), weights.cols());
        for (Index column = 0; column < weights.cols(); ++column) {
            Matrix& c = by.byCoefficients[static_cast<std::size_t>(column)];
            for (Index first = 0; first < c.rows(); first += points_)
                c.middleRows(first, points_) =
                    (toCoefficients_.transpose() * c.middleRows(first, points_)).eval();
            gradients.col(column) = Eigen::Map<const Vector>(c.data(), c.size());
        }
        return true;
    }
    std::string problem() const {
        return "a step at t = " + formatNumber(run_.failedAt(), 4) + " fails: " + std::string(name(outcome_));
    }
    Outcome outcome() const { return outcome_; }

private:
    static int pointsOf(const ResolvedScene& scene, const SteeringRequest& request) {
        return std::max(1, scene.schemes[schemeNamed(scene, request.scheme)].claims.order / 2);
    }
    RunDerivative::Request requestOf(const SteeringRequest& request) const {
        if (request.of.empty() && request.over.empty())
            throw InvalidScene("--over", "or --of must say what is to be least",
                               "--over '" + names_.front() + "^2/2' for an integral over the run");
        RunDerivative::Request made;
        made.scheme = request.scheme;
        made.integrand = request.over;
        for (const std::string& name : names_) made.controls.emplace_back(name, points_);
        return made;
    }

    std::vector<std::string> names_;
    int points_;
    Rule<double> rule_;
    RunDerivative run_;
    EndFunction cost_;
    std::vector<EndFunction> conditions_;
    Matrix toCoefficients_, columns_;
    Outcome outcome_ = Outcome::converged;
    std::stop_token stop_;
};

StudyTable controlsTable(const SteeredRun& steered, const Vector& u) {
    StudyTable table{"controls", {"t"}, {}};
    for (const std::string& name : steered.names()) table.columns.push_back(name);
    const auto count = static_cast<Index>(steered.names().size()), all = u.size();
    const Index perStep = all / count;
    for (Index row = 0; row < perStep; ++row) table.rows.emplace_back();
    std::vector<Index> next(static_cast<std::size_t>(count), 0);
    for (Index i = 0; i < all; ++i) {
        const std::size_t control = steered.controlOf(i);
        Value::Array& row = table.rows[static_cast<std::size_t>(next[control]++)];
        if (control == 0) row.emplace_back(steered.timeOf(i));
        row.emplace_back(u(i));
    }
    return table;
}

Value steeredScene(const ResolvedScene& scene, const StudyTable& controls) {
    Value document = toValue(scene.scene);
    Value& all = *document.find("model")->find("controls");
    for (std::size_t c = 1; c < controls.columns.size(); ++c) {
        Value::Array rows;
        for (const Value::Array& row : controls.rows) rows.emplace_back(Value::Array{row[0], row[c]});
        const bool isBackwards =
            rows.size() > 1 && rows[1].asArray()[0].asNumber() < rows[0].asArray()[0].asNumber();
        if (isBackwards) std::reverse(rows.begin(), rows.end());
        Value table{Value::Object{}};
        table.set("table", std::move(rows));
        table.set("interpolation", "cubic");
        all.set(controls.columns[c], std::move(table));
    }
    return document;
}

/// The state and the costates at nodes, from one more sweep.
StudyTable statesTable(const ResolvedScene& scene, SteeredRun& steered, const Minimum& least) {
    StudyTable table{"states", {"t"}, {}};
    const std::vector<Quantity> columns = stateColumns(*scene.system);
    for (const Quantity& each : columns) table.columns.push_back(each.name);
    for (const Quantity& each : columns) table.columns.push_back("costate." + each.name);
    double J = 0;
    Vector r;
    Matrix weights(1 + least.multipliers.size(), 1), gradients;
    weights << 1, least.multipliers;
    if (!steered.evaluate(least.u, J, r)) return table;
    const RunDerivative& run = steered.run();
    (void)steered.differentiate(weights, gradients, [&](long long k, const Vector& x, const Matrix& costate) {
        Value::Array row{run.times()[static_cast<std::size_t>(k)]};
        for (Index i = 0; i < x.size(); ++i) row.emplace_back(x(i));
        for (Index i = 0; i < x.size(); ++i) row.emplace_back(costate(i, 0));
        table.rows.push_back(std::move(row));
    });
    std::reverse(table.rows.begin(), table.rows.end());
    return table;
}

/// Without bounds, and then between bounds that close in on those wanted: steps of an active set are whole,
/// and must begin near.
Minimum leastOf(const ResolvedScene& scene, SteeredRun& steered, const std::vector<Bounds>& bounds,
                const std::stop_token& stop) {
    constexpr int stages = 8;
    const Index n = steered.unknowns();
    MinimumProblem problem;
    problem.evaluate = [&](const Vector& at, double& J, Vector& r) { return steered.evaluate(at, J, r); };
    problem.differentiate = [&](const Matrix& w, Matrix& g) { return steered.differentiate(w, g); };
    problem.metric.resize(n);
    std::vector<std::function<double(double t)>> guesses;
    for (const std::string& name : steered.names()) guesses.push_back(guessOf(scene, name));
    Minimum least;
    least.u.resize(n);
    for (Index i = 0; i < n; ++i) {
        problem.metric(i) = steered.weightOf(i);
        least.u(i) = guesses[steered.controlOf(i)](steered.timeOf(i));
    }
    least = constrainedMinimum(problem, least, stop);
    const auto bound = [&](Index i) { return bounds[steered.controlOf(i)]; };
    bool isWithin = true;
    std::vector<Bounds> reached(bounds.size(), {HUGE_VAL, -HUGE_VAL});
    for (Index i = 0; i < n; ++i) {
        Bounds& of = reached[steered.controlOf(i)];
        of = {std::min(of.lower, least.u(i)), std::max(of.upper, least.u(i))};
        isWithin = isWithin && least.u(i) >= bound(i).lower && least.u(i) <= bound(i).upper;
    }
    problem.lower.resize(n);
    problem.upper.resize(n);
    for (int stage = 1; stage <= stages && !isWithin && least.problem.empty(); ++stage) {
        const double left = 1 - static_cast<double>(stage) / stages;
        for (Index i = 0; i < n; ++i) {
            const Bounds& of = reached[steered.controlOf(i)];
            problem.lower(i) = bound(i).lower + left * std::min(0.0, of.lower - bound(i).lower);
            problem.upper(i) = bound(i).upper + left * std::max(0.0, of.upper - bound(i).upper);
        }
        const int iterations = least.iterations, products = least.products;
        least = constrainedMinimum(problem, least, stop);
        least.iterations += iterations;
        least.products += products;
    }
    return least;
}

}  // namespace

SteeringAnswer steer(const ResolvedScene& scene, const SteeringRequest& request,
                     const std::stop_token& stop) {
    SteeredRun steered(scene, request, stop);
    const std::vector<Bounds> bounds = boundsOf(request.bounds, steered.names());
    const Minimum least = leastOf(scene, steered, bounds, stop);
    SteeringAnswer answer;
    answer.scheme = steered.run().scheme();
    answer.steps = steered.run().steps();
    answer.cost = least.J;
    answer.miss = least.miss;
    answer.slope = least.slope;
    answer.iterations = least.iterations;
    answer.products = least.products;
    answer.atBounds = least.atBounds;
    answer.multipliers.assign(least.multipliers.data(), least.multipliers.data() + least.multipliers.size());
    if (!least.problem.empty()) {
        answer.problem = least.problem;
        if (steered.outcome() != Outcome::converged) answer.problem += ": " + steered.problem();
        answer.remedy =
            "other controls to begin with, in the scene; wider bounds; a smaller step; or fewer conditions";
        return answer;
    }
    answer.controls = controlsTable(steered, least.u);
    answer.states = statesTable(scene, steered, least);
    answer.integral = steered.run().integral();
    answer.scene = steeredScene(scene, answer.controls);
    return answer;
}

Value steeringValue(const SteeringAnswer& answer) {
    Value document{Value::Object{}};
    document.set("found", answer.isFound());
    document.set("scheme", answer.scheme);
    document.set("steps", static_cast<double>(answer.steps));
    document.set("iterations", answer.iterations);
    document.set("products", answer.products);
    if (!answer.isFound()) {
        document.set("problem", answer.problem);
        document.set("remedy", answer.remedy);
        return document;
    }
    document.set("cost", answer.cost);
    document.set("integral", answer.integral);
    document.set("miss", answer.miss);
    document.set("slope", answer.slope);
    document.set("at_bounds", answer.atBounds);
    Value::Array multipliers;
    for (const double each : answer.multipliers) multipliers.emplace_back(each);
    document.set("multipliers", std::move(multipliers));
    return document;
}

}  // namespace extremal
