// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scheme computes for measurements, as a function of numbers of the scene, with its derivative.
///
/// The motion is taken from node to node; a measurement between two nodes is compared with a shorter step of
/// the same scheme from the node before, which has the order of the scheme, where its dense output has less.
/// Derivatives are those of the discrete motion (integrator/variation/with_sensitivities.hpp).
#pragma once

#include <Eigen/Core>

#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"
#include "engine/study/fit/measured_data.hpp"

namespace extremal {

class FittedMotion {
public:
    /// `part`: of the scheme's step. The data must outlive it. Throws InvalidScene ("--free", "--scheme")
    /// where a pointer is not a number that can be varied.
    FittedMotion(const ResolvedScene& scene, std::size_t scheme, std::vector<std::string> pointers,
                 const MeasuredData& data, double part = 1);

    void setStop(std::stop_token stop) { stop_ = std::move(stop); }
    /// What the numbers are called, and their values in the scene.
    const std::vector<std::string>& names() const { return names_; }
    const Eigen::VectorXd& start() const { return start_; }

    struct Values {
        Eigen::VectorXd computed;    ///< of each measurement
        Eigen::VectorXd residual;    ///< computed less measured, over the standard deviation
        Eigen::MatrixXd derivative;  ///< of the residual by the numbers
    };
    /// False where there is no such motion: problem() says why.
    bool evaluate(const Eigen::VectorXd& numbers, Values& values);
    const std::string& problem() const { return problem_; }
    /// The scene with the numbers in place.
    Value sceneWith(const Value& document, const Eigen::VectorXd& numbers) const;

private:
    bool compute(const ResolvedScene& scene, Values& values);

    Value document_;
    std::vector<std::string> pointers_, names_;
    const MeasuredData& data_;
    double part_;
    Eigen::VectorXd start_;
    std::stop_token stop_;
    std::string problem_;
};

}  // namespace extremal
