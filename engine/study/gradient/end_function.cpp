// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/gradient/end_function.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace extremal {

EndFunction::EndFunction(const std::string& text, const std::string& option, const RunDerivative& run)
    : states_(2 * run.dimension()) {
    const ResolvedScene& scene = run.scene();
    const std::vector<std::string>& varied = run.parameterNames();
    std::vector<std::string> names;
    for (const Coordinate& coordinate : scene.system->coordinates) names.push_back(coordinate.name);
    for (const Coordinate& coordinate : scene.system->coordinates) names.push_back("p_" + coordinate.name);
    names.emplace_back("t");
    names.insert(names.end(), varied.begin(), varied.end());
    others_.resize(1 + static_cast<Eigen::Index>(varied.size()));
    others_(0) = run.times().back();
    std::copy(run.parameters().begin(), run.parameters().end(), others_.data() + 1);
    std::vector<std::pair<std::string, double>> constants;
    for (const auto& [name, value] : formulaConstants(scene.scene, *scene.system))
        if (std::find(names.begin(), names.end(), name) == names.end()) constants.emplace_back(name, value);
    if (!text.empty()) function_.emplace(text, option, std::move(names), std::move(constants));
}

EndFunction::Values EndFunction::at(const Eigen::VectorXd& end) const {
    Values values;
    values.byState = Eigen::VectorXd::Zero(states_);
    values.byParameters = Eigen::VectorXd::Zero(others_.size() - 1);
    if (!function_) return values;
    Eigen::VectorXd y(states_ + others_.size()), gradient(y.size());
    y << end, others_;
    function_->evaluate(y.data(), &values.value, gradient.data(), nullptr);
    values.byState = gradient.head(states_);
    values.byParameters = gradient.tail(others_.size() - 1);
    return values;
}

}  // namespace extremal
