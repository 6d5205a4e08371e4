// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/known_value.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/fit/fitted_motion.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

constexpr int mostFitSteps = 200;
/// A singular value below this part of the largest is that of a direction without any effect.
constexpr double unseenPart = 1e-10;

/// The method of Levenberg and Marquardt, with the sizes of the columns as its metric.
class LeastSquares {
public:
    LeastSquares(FittedMotion& motion, bool isOfBias, const FitProgress& tell)
        : motion_(motion), isOfBias_(isOfBias), tell_(tell) {}

    /// From the numbers in `at`, which are moved to the minimum. False: problem() says why there is none.
    bool solve(Vector& at, const std::stop_token& stop) {
        if (!motion_.evaluate(at, values_)) {
            problem_ = "the motion with the numbers of the scene cannot be computed: " + motion_.problem();
            return false;
        }
        sums_.push_back(values_.residual.squaredNorm());
        tell(at);
        double damping = 1e-3;
        for (int step = 0; step < mostFitSteps && !stop.stop_requested(); ++step) {
            const Vector sizes = values_.derivative.colwise().norm().cwiseMax(1e-300).transpose();
            const Vector by = correction(sizes, damping);
            const Vector next = at + by;
            FittedMotion::Values there;
            const bool isComputed = motion_.evaluate(next, there);
            const double sum = isComputed ? there.residual.squaredNorm() : HUGE_VAL;
            // What the correction would lower a linear model by; below round-off nothing is to be gained.
            const double promised = sums_.back() - (values_.residual + values_.derivative * by).squaredNorm();
            const bool isSettled = promised <= 1e-13 * sums_.back() + 1e-30;
            if (sum < sums_.back()) {
                at = next;
                values_ = std::move(there);
                sums_.push_back(sum);
                tell(at);
                damping = std::max(damping / 10, 1e-12);
                if (isSettled) return true;
                continue;
            }
            if (isSettled) return true;
            damping *= 10;
            if (damping > 1e12) {
                problem_ = isComputed
                               ? "the sum of squares cannot be lowered further, and is not at a minimum"
                               : "no motion nearby can be computed: " + motion_.problem();
                return false;
            }
        }
        problem_ = stop.stop_requested() ? "interrupted"
                                         : "no minimum after " + std::to_string(mostFitSteps) + " steps";
        return false;
    }
    const FittedMotion::Values& values() const { return values_; }
    const std::vector<double>& sums() const { return sums_; }
    const std::string& problem() const { return problem_; }

private:
    void tell(const Vector& at) const {
        if (!tell_) return;
        const Vector& computed = values_.computed;
        tell_({{at.data(), at.data() + at.size()},
               {computed.data(), computed.data() + computed.size()},
               sums_.back(),
               isOfBias_});
    }
    Vector correction(const Vector& sizes, double damping) const {
        const Index n = values_.derivative.rows(), m = values_.derivative.cols();
        Matrix A = Matrix::Zero(n + m, m);
        Vector b = Vector::Zero(n + m);
        A.topRows(n) = values_.derivative;
        for (Index k = 0; k < m; ++k) A(n + k, k) = std::sqrt(damping) * sizes(k);
        b.head(n) = -values_.residual;
        return dense::leastSquares<double>(A, b);
    }

    FittedMotion& motion_;
    bool isOfBias_;
    const FitProgress& tell_;
    FittedMotion::Values values_;
    std::vector<double> sums_;
    std::string problem_;
};

void requireFree(const FitRequest& request, std::size_t measurements) {
    if (request.free.empty())
        throw InvalidScene("--free", "names no number to fit", "for example --free /model/k,/initial/q/0");
    if (request.free.size() > mostVariedNumbers)
        throw InvalidScene("--free", "takes at most " + std::to_string(mostVariedNumbers) + " numbers, got " +
                                         std::to_string(request.free.size()));
    std::set<std::string> seen;
    for (const std::string& pointer : request.free)
        if (!seen.insert(pointer).second) throw InvalidScene("--free", pointer + " is there twice", "once");
    if (measurements < request.free.size())
        throw InvalidScene("--data",
                           "has " + std::to_string(measurements) + " measurements for " +
                               std::to_string(request.free.size()) + " numbers",
                           "more measurements, or fewer numbers in --free");
}

/// Deviations, correlations and directions from J at the minimum.
void describeNumbers(const Matrix& J, const Vector& at, double s, FitAnswer& answer) {
    const Index m = at.size();
    Vector sizes = at.cwiseAbs();
    for (Index k = 0; k < m; ++k)
        if (sizes(k) == 0) sizes(k) = 1;
    const Matrix triangle = dense::triangleOf(J * sizes.asDiagonal());
    const dense::RightSingular svd = dense::rightSingular(triangle.topRows(m));
    Matrix covariance = Matrix::Zero(m, m);
    std::vector<bool> isSeen(static_cast<std::size_t>(m), true);
    for (Index i = 0; i < m; ++i) {
        const Vector v = svd.V.col(i);
        const bool isUnseen = !(svd.values(i) > unseenPart * svd.values(0));
        answer.directions.push_back({{v.data(), v.data() + m}, isUnseen ? HUGE_VAL : s / svd.values(i)});
        if (!isUnseen) covariance += v * v.transpose() * (s / svd.values(i)) * (s / svd.values(i));
        for (Index k = 0; isUnseen && k < m; ++k)
            if (std::abs(v(k)) > 1e-3) isSeen[static_cast<std::size_t>(k)] = false;
    }
    for (Index k = 0; k < m; ++k) {
        const auto place = static_cast<std::size_t>(k);
        if (isSeen[place]) answer.numbers[place].deviation = sizes(k) * std::sqrt(covariance(k, k));
        answer.correlations.emplace_back();
        for (Index j = 0; j < m; ++j) {
            const bool isKnown = isSeen[place] && isSeen[static_cast<std::size_t>(j)];
            answer.correlations.back().push_back(isKnown ? covariance(k, j) /
                                                               std::sqrt(covariance(k, k) * covariance(j, j))
                                                         : FittedNumber::unknown);
        }
    }
}

std::string directionText(const SeenDirection& direction, const std::vector<FittedNumber>& numbers) {
    std::string text;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        if (std::abs(direction.parts[k]) > 0.1)
            text +=
                (text.empty() ? "" : ", ") + numbers[k].name + " by " + formatNumber(direction.parts[k], 2);
    return text;
}

void addNotes(FitAnswer& answer) {
    constexpr double tooLarge = 1.5;
    if (answer.hasDeviations && answer.scatter > tooLarge)
        answer.notes.push_back("the residuals are " + formatNumber(answer.scatter, 2) +
                               " times the given deviations: the model does not explain the data with these "
                               "numbers alone");
    for (const SeenDirection& each : answer.directions) {
        if (each.deviation == HUGE_VAL)
            answer.notes.push_back("the data do not see a change of " + directionText(each, answer.numbers) +
                                   " (relative): leave one of them out of --free");
        else if (each.deviation > 0.5)
            answer.notes.push_back("the data hardly see a change of " + directionText(each, answer.numbers) +
                                   " (relative), known to " + formatNumber(100 * each.deviation, 2) + " %");
    }
    for (std::size_t i = 0; i < answer.numbers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (std::abs(answer.correlations[i][j]) > 0.95)
                answer.notes.push_back(answer.numbers[j].name + " and " + answer.numbers[i].name +
                                       " are correlated by " + formatNumber(answer.correlations[i][j], 3));
    for (const FittedNumber& each : answer.numbers)
        if (std::abs(each.bias) > 0.3 * each.deviation)
            answer.notes.push_back(each.name + " is off by " + formatNumber(each.bias, 2) +
                                   " for the step of the scheme, and known to " +
                                   formatNumber(each.deviation, 2) + ": a smaller step, or a higher degree");
}

StudyTable residualsTable(const MeasuredData& data, const FittedMotion::Values& values) {
    StudyTable table{"residuals", {"t", "column", "measured", "computed", "residual", "over_deviation"}, {}};
    for (std::size_t i = 0; i < data.all.size(); ++i) {
        const Measurement& each = data.all[i];
        const double computed = values.computed(static_cast<Index>(i)), r = computed - each.value;
        table.rows.push_back({each.t, data.columns[each.column].name, each.value, computed, r,
                              data.hasDeviations ? Value(r / each.deviation) : Value()});
    }
    return table;
}

}  // namespace

FitAnswer fit(const ResolvedScene& scene, const MeasuredData& data, const FitRequest& request,
              const std::stop_token& stop, const FitProgress& tell) {
    requireFree(request, data.all.size());
    const std::size_t place = schemeNamed(scene, request.scheme);
    const ResolvedScheme& scheme = scene.schemes[place];
    if (!scheme.isFixed())
        throw InvalidScene("--scheme", "\"" + scheme.spec.label + "\" has no given step",
                           "a scheme with one, whose motion depends smoothly on the numbers");
    if (data.all.front().t < scene.scene.start.value)
        throw InvalidScene("--data",
                           "begins at t = " + formatNumber(data.all.front().t) + ", before the scene",
                           "--set /time/start=" + formatNumber(data.all.front().t));
    FitAnswer answer;
    answer.scheme = scheme.spec.label;
    answer.measurements = data.all.size();
    answer.hasDeviations = data.hasDeviations;
    answer.data = data.name;
    answer.remark = data.remark;
    FittedMotion motion(scene, place, request.free, data);
    motion.setStop(stop);
    Vector at = motion.start();
    LeastSquares squares(motion, false, tell);
    const bool isFound = squares.solve(at, stop);
    answer.sums = squares.sums();
    for (Index k = 0; k < at.size(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        answer.numbers.push_back({motion.names()[i], request.free[i], motion.start()(k), at(k)});
    }
    if (!isFound) {
        answer.problem = squares.problem();
        answer.remedy = "other numbers to begin with: --set POINTER=VALUE; fewer numbers; or a smaller step";
        return answer;
    }
    const auto spare = data.all.size() - request.free.size();
    const double sum = squares.values().residual.squaredNorm();
    answer.scatter = spare > 0 ? std::sqrt(sum / static_cast<double>(spare)) : FittedNumber::unknown;
    describeNumbers(squares.values().derivative, at, data.hasDeviations ? 1 : answer.scatter, answer);
    if (request.measuresBias) {
        FittedMotion finer(scene, place, request.free, data, 0.5);
        finer.setStop(stop);
        LeastSquares again(finer, true, tell);
        Vector there = at;
        if (again.solve(there, stop))
            for (Index k = 0; k < at.size(); ++k)
                answer.numbers[static_cast<std::size_t>(k)].bias = at(k) - there(k);
    }
    addNotes(answer);
    answer.residuals = residualsTable(data, squares.values());
    answer.scene = motion.sceneWith(toValue(scene.scene), at);
    return answer;
}

StudyTable numbersTable(const FitAnswer& answer) {
    StudyTable table{"parameters", {"name", "pointer", "start", "value", "deviation", "bias"}, {}};
    for (const FittedNumber& each : answer.numbers) table.columns.push_back("correlation." + each.name);
    for (std::size_t i = 0; i < answer.numbers.size(); ++i) {
        const FittedNumber& each = answer.numbers[i];
        Value::Array row{each.name,
                         each.pointer,
                         each.start,
                         each.value,
                         knownNumber(each.deviation),
                         knownNumber(each.bias)};
        for (std::size_t j = 0; j < answer.numbers.size(); ++j)
            row.push_back(answer.correlations.empty() ? Value() : knownNumber(answer.correlations[i][j]));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Value fitValue(const FitAnswer& answer) {
    Value document{Value::Object{}};
    document.set("scheme", answer.scheme);
    document.set("found", answer.isFound());
    if (!answer.isFound()) {
        document.set("problem", answer.problem);
        document.set("remedy", answer.remedy);
    }
    document.set("measurements", static_cast<double>(answer.measurements));
    document.set("has_deviations", answer.hasDeviations);
    document.set("scatter", knownNumber(answer.scatter));
    document.set("parameters", rowsValue(numbersTable(answer)));
    Value::Array directions;
    for (const SeenDirection& each : answer.directions) {
        Value direction{Value::Object{}};
        Value parts{Value::Object{}};
        for (std::size_t k = 0; k < answer.numbers.size(); ++k)
            parts.set(answer.numbers[k].name, each.parts[k]);
        direction.set("relative", std::move(parts));
        direction.set("deviation", knownNumber(each.deviation));
        directions.push_back(std::move(direction));
    }
    document.set("directions", std::move(directions));
    Value::Array sums, notes;
    for (const double sum : answer.sums) sums.emplace_back(sum);
    for (const std::string& note : answer.notes) notes.emplace_back(note);
    document.set("sums_of_squares", std::move(sums));
    document.set("notes", std::move(notes));
    return document;
}

}  // namespace extremal
