// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a scene from measurements of its motion: least squares,
///
///     S(a) = sum_i ((x(t_i; a) - x_i) / sd_i)^2,
///
/// by the method of Levenberg and Marquardt on the derivatives of the discrete motion. With J the derivative
/// of the residuals at the minimum the covariance is s^2 (J^T J)^-1, s^2 = S / (measurements - numbers), or 1
/// where every measurement has a standard deviation of its own.
///
/// What the data do not see shows in the singular values s_i and vectors v_i of J diag(|a|): along v_i the
/// logarithms of the numbers are known to s / s_i. The numbers belong to the discrete motion: `bias` is what
/// they are less those of half the step, to be compared with sd.
#pragma once

#include <functional>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {

struct MeasuredData;

struct FitRequest {
    std::vector<std::string> free = {};     ///< pointers to the numbers
    std::string scheme = {};                ///< its label; empty: the first enabled one
    std::vector<std::string> columns = {};  ///< of the file; empty: all
    bool measuresBias = true;
};

struct FittedNumber {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::string name, pointer;
    double start = 0, value = 0;
    double deviation = unknown;  ///< NaN where the data do not see it
    double bias = unknown;       ///< of the scheme; NaN where it is not known
};

/// A direction of relative changes of the numbers, and how well the data know it.
struct SeenDirection {
    std::vector<double> parts;  ///< of length 1, one for each number
    double deviation = 0;       ///< relative; infinite where it is not seen
};

struct FitAnswer {
    std::string scheme;
    std::string data, remark;  ///< the name of the file, and what it says about itself
    std::vector<FittedNumber> numbers;
    std::vector<std::vector<double>> correlations;
    std::vector<SeenDirection> directions;  ///< the best known first
    std::vector<double> sums;               ///< S of each step of the method, the start first
    std::size_t measurements = 0;
    double scatter = 0;  ///< s: of the residuals, over their standard deviations
    bool hasDeviations = false;
    std::string problem, remedy;  ///< why there is no minimum; empty: there is
    std::vector<std::string> notes;
    Value scene;           ///< with the numbers in place
    StudyTable residuals;  ///< t, column, measured, computed, residual, over_deviation
    bool isFound() const { return problem.empty(); }
};

/// Where the method has come to: after the start, and after each step that lowers the sum.
struct FitStep {
    std::vector<double> values;    ///< of the numbers
    std::vector<double> computed;  ///< of the measurements
    double sum = 0;
    bool isOfBias = false;  ///< the minimum is known, and that of half the step is sought
};
using FitProgress = std::function<void(const FitStep&)>;

/// Throws InvalidScene ("--free", "--data", "--scheme") where the request cannot be met.
FitAnswer fit(const ResolvedScene& scene, const MeasuredData& data, const FitRequest& request,
              const std::stop_token& stop = {}, const FitProgress& tell = {});

/// parameters.csv: a row per number, with its correlations.
StudyTable numbersTable(const FitAnswer& answer);
/// The answer as JSON, without scene and residuals.
Value fitValue(const FitAnswer& answer);

}  // namespace extremal
