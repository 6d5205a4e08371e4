// SPDX-License-Identifier: GPL-3.0-or-later
/// The run of a scheme as a function of numbers of its scene, of its start and of coefficients of its
/// controls on each step, with the derivatives of any number of functions of its end by all of them
/// (integrator/variation/backward_sweep.hpp).
///
/// The state is x = (q, u, p, P): behind the coordinates stand the numbers that formulas change with, the
/// weight of an integrand, whose momentum is its integral, and coefficients of controls
/// (scene/outlook/varied_scene.hpp).
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/integrator/variation/backward_sweep.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

class RunDerivative {
public:
    struct Request {
        std::vector<std::string> pointers = {};  ///< to the numbers
        std::string scheme = {};                 ///< a label; empty: the first enabled one
        std::string integrand = {};
        /// Controls with so many coefficients on each step, those of a polynomial in s in [-1/2, 1/2].
        std::vector<std::pair<std::string, int>> controls = {};
        std::string option = "--with";  ///< what pointers are refused as
    };
    /// Throws InvalidScene.
    RunDerivative(const ResolvedScene& scene, const Request& request);
    RunDerivative(const RunDerivative&) = delete;
    RunDerivative& operator=(const RunDerivative&) = delete;

    const std::string& scheme() const { return label_; }
    const ResolvedScene& scene() const { return *scene_; }
    int dimension() const { return d_; }
    long long steps() const { return static_cast<long long>(times_.size()) - 1; }
    /// Of nodes.
    const std::vector<double>& times() const { return times_; }
    /// Of the numbers.
    const std::vector<SensitivityColumn>& numbers() const { return numbers_; }
    /// The names in formulas of what is behind the coordinates, and values; with a weight of an integrand.
    const std::vector<std::string>& parameterNames() const { return names_; }
    const std::vector<double>& parameters() const { return parameters_; }
    int coefficients() const { return coefficients_; }

    /// Where the run begins, (q, p), and c(j, k): coefficient j on step k, control after control.
    Outcome run(const Eigen::VectorXd& start, const Eigen::MatrixXd& c, const std::stop_token& stop = {});
    Eigen::VectorXd start() const;
    Eigen::VectorXd end() const { return stateOf(sweep_->end()); }
    double integral() const;
    double failedAt() const { return sweep_->failedAt(); }
    std::size_t kept() const { return sweep_->kept(); }

    /// A column of derivatives by the end: by (q, p), by the integral, and by parameters, which may be none.
    Eigen::VectorXd columnOf(const Eigen::VectorXd& byState, double byIntegral,
                             const Eigen::VectorXd& byParameters = {}) const;
    struct Derivatives {
        Eigen::MatrixXd byStart;                      ///< (2 d, columns)
        Eigen::MatrixXd byNumbers;                    ///< (numbers, columns)
        std::vector<Eigen::MatrixXd> byCoefficients;  ///< of each column, as c
    };
    /// Sees the state (q, p) at node k and the derivatives by it, (2 d, columns), from the end to the start.
    using See =
        std::function<void(long long k, const Eigen::VectorXd& state, const Eigen::MatrixXd& byState)>;
    /// After a run() that converged.
    Outcome differentiate(Eigen::MatrixXd columns, Derivatives& derivatives, const See& see = {});

private:
    void findTimes(const ResolvedScheme& scheme, double step);
    Eigen::VectorXd stateOf(const State& state) const;
    Eigen::MatrixXd stateRows(const Eigen::MatrixXd& columns) const;
    Eigen::Index entry(Eigen::Index i) const { return i < d_ ? i : i + u_; }

    std::shared_ptr<const ResolvedScene> scene_;
    std::string label_;
    int d_ = 0, u_ = 0, coefficients_ = 0;
    std::vector<double> times_;
    std::vector<SensitivityColumn> numbers_;
    std::vector<std::string> names_;
    std::vector<double> parameters_;
    std::optional<std::size_t> integral_;
    struct Control {
        Eigen::Index first, count;  ///< coefficients in x; behind them the start of the step
    };
    std::vector<Control> controls_;
    State start_;
    Eigen::MatrixXd c_;
    std::unique_ptr<BackwardSweep> sweep_;
};

}  // namespace extremal
