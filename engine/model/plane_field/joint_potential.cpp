// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/joint_potential.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/known_keys.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

/// Rows of second derivatives of m components.
std::size_t triangle(std::size_t m) { return m * (m + 1) / 2; }

/// f(place) at the middles of equal boxes that fill a box, several hundred of them.
template <class F>
void forPlaces(std::size_t m, const double* low, const double* high, bool withEdges, F&& f) {
    constexpr double enough = 1000;
    const int side = std::max(3, static_cast<int>(std::pow(enough, 1 / static_cast<double>(m))));
    std::vector<int> at(m, 0);
    std::vector<double> place(m);
    for (bool isDone = false; !isDone;) {
        for (std::size_t c = 0; c < m; ++c) {
            const double part = withEdges ? static_cast<double>(at[c]) / (side - 1) : (at[c] + 0.5) / side;
            place[c] = low[c] + (high[c] - low[c]) * part;
        }
        f(place.data());
        std::size_t c = 0;
        while (c < m && ++at[c] == side) at[c++] = 0;
        isDone = c == m;
    }
}

double numberOf(const Value& given, const char* key, double fallback, const std::string& pointer) {
    const Value* const value = given.isObject() ? given.find(key) : nullptr;
    return value ? numberIn(*value, pointer + "/" + key, {}) : fallback;
}

void allowOwnKeys(const Value& given, const std::vector<std::string>& known, const std::string& pointer) {
    if (given.isObject()) allowKeys(given, "name", known, pointer, "this potential");
}

constexpr const char *complexName = "klein-gordon-complex", *ballName = "q-ball";

}  // namespace

JointPotential::JointPotential(FieldPotential single)
    : names_{"u"}, mass_(single.mass()), single_(std::move(single)) {}

JointPotential::JointPotential(const Value& given, double mass, std::vector<std::string> names,
                               const std::string& pointer)
    : names_(std::move(names)), mass_(mass) {
    const Value* const name = given.isObject() ? given.find("name") : &given;
    if (!name || !name->isString())
        throw InvalidScene(
            pointer,
            "must be a name, an expression in " + joinNames(names_) + " and mass, or an object with a name",
            "known: " + joinNames(JointPotential::names()));
    const std::string& text = name->asString();
    const auto& known = JointPotential::names();
    const bool isNamed = std::find(known.begin(), known.end(), text) != known.end();
    if (given.isObject() && !isNamed)
        throw InvalidScene(pointer + "/name", "unknown potential \"" + text + "\"", suggestName(text, known));
    if (isNamed) {
        readNamed(text, given, pointer);
        return;
    }
    kind_ = components() == 1 && names_.front() == "u" ? Kind::single : Kind::typed;
    if (kind_ == Kind::single) {
        single_ = FieldPotential(text, mass_, pointer);
        return;
    }
    typed_ = std::make_shared<const typed::TypedFunction>(
        text, pointer, names_, std::vector<std::pair<std::string, double>>{{"mass", mass_}});
}

void JointPotential::readNamed(const std::string& name, const Value& given, const std::string& pointer) {
    const bool isComplex = name == complexName || name == ballName;
    if (isComplex && components() != 2)
        throw InvalidScene(pointer,
                           name + " is for two components, and the field has " + std::to_string(components()),
                           "\"components\": [\"u\", \"v\"]");
    if (components() == 1) {
        allowOwnKeys(given, {}, pointer);
        single_ = FieldPotential(name, mass_, pointer);
        return;
    }
    if (!isComplex && name != "none" && name != "klein-gordon")
        throw InvalidScene(pointer,
                           name + " is for one component, and the field has " + std::to_string(components()),
                           "an expression in " + joinNames(names_));
    kind_ = Kind::radial;
    allowOwnKeys(given,
                 name == ballName      ? std::vector<std::string>{"a", "b"}
                 : name == complexName ? std::vector<std::string>{"lambda"}
                                       : std::vector<std::string>{},
                 pointer);
    if (name != "none") quadratic_ = mass_ * mass_;
    if (name == complexName) quartic_ = numberOf(given, "lambda", 1, pointer);
    if (name == ballName) {
        quartic_ = -numberOf(given, "a", 1, pointer);
        sextic_ = numberOf(given, "b", 0.25, pointer);
    }
}

const std::vector<std::string>& JointPotential::names() {
    static const std::vector<std::string> all = {"none", "klein-gordon", "sine-gordon",
                                                 "phi4", complexName,    ballName};
    return all;
}

bool JointPotential::isLinear() const {
    return kind_ == Kind::single ? single_.isLinear()
                                 : kind_ == Kind::radial && quartic_ == 0 && sextic_ == 0;
}

bool JointPotential::isZero() const {
    return kind_ == Kind::single ? single_.kind() == FieldPotential::Kind::none
                                 : isLinear() && quadratic_ == 0;
}

void JointPotential::evaluate(const double* u, std::size_t n, std::size_t stride, double* W, double* slope,
                              double* curvature) const {
    if (kind_ == Kind::single) return single_.evaluate(u, n, W, slope, curvature);
    if (kind_ == Kind::radial) return evaluateRadial(u, n, stride, W, slope, curvature);
    evaluateTyped(u, n, stride, W, slope, curvature);
}

void JointPotential::evaluateRadial(const double* u, std::size_t n, std::size_t stride, double* W,
                                    double* slope, double* curvature) const {
    const std::size_t m = components();
    for (std::size_t i = 0; i < n; ++i) {
        double square = 0;
        for (std::size_t c = 0; c < m; ++c) square += u[c * stride + i] * u[c * stride + i];
        if (W) W[i] = square * (quadratic_ / 2 + square * (quartic_ / 4 + square * sextic_ / 6));
        const double rate = quadratic_ + square * (quartic_ + square * sextic_);
        if (slope)
            for (std::size_t c = 0; c < m; ++c) slope[c * stride + i] = rate * u[c * stride + i];
        if (!curvature) continue;
        const double second = 2 * quartic_ + 4 * square * sextic_;
        for (std::size_t c = 0, row = 0; c < m; ++c)
            for (std::size_t d = 0; d <= c; ++d, ++row)
                curvature[row * stride + i] =
                    second * u[c * stride + i] * u[d * stride + i] + (c == d ? rate : 0);
    }
}

void JointPotential::evaluateTyped(const double* u, std::size_t n, std::size_t stride, double* W,
                                   double* slope, double* curvature) const {
    const std::size_t m = components(), rows = triangle(m);
    std::array<double, mostComponents> at{}, first{};
    std::array<double, mostComponents*(mostComponents + 1) / 2> second{};
    const bool hasSlope = slope || curvature;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < m; ++c) at[c] = u[c * stride + i];
        double value = 0;
        typed_->evaluate(at.data(), &value, hasSlope ? first.data() : nullptr,
                         curvature ? second.data() : nullptr);
        if (W) W[i] = value;
        if (slope)
            for (std::size_t c = 0; c < m; ++c) slope[c * stride + i] = first[c];
        if (curvature)
            for (std::size_t row = 0; row < rows; ++row) curvature[row * stride + i] = second[row];
    }
}

int JointPotential::degree() const {
    if (kind_ == Kind::single) return single_.degree();
    if (kind_ == Kind::radial) return sextic_ != 0 ? 6 : quartic_ != 0 ? 4 : 2;
    // Along a line in a general direction the terms of the highest degree do not cancel.
    constexpr int lines = 3;
    int most = 0;
    std::vector<double> place(components());
    for (int line = 0; line < lines; ++line) {
        const int degree = polynomialDegree([&](double s) {
            for (std::size_t c = 0; c < place.size(); ++c) {
                const double angle = 1.3 * (line + 1) + 2.1 * static_cast<double>(c);
                place[c] = std::cos(angle) * s + 0.1 * std::sin(3 * angle);
            }
            return (*typed_)(place.data());
        });
        if (degree == 0) return 0;
        most = std::max(most, degree);
    }
    return most;
}

std::vector<double> JointPotential::meanCurvatures() const {
    if (kind_ == Kind::single) return {single_.meanCurvature()};
    const std::size_t m = components();
    std::vector<double> sums(m, 0), curvature(triangle(m));
    const std::vector<double> low(m, -1), high(m, 1);
    double count = 0;
    forPlaces(m, low.data(), high.data(), false, [&](const double* u) {
        evaluate(u, 1, 1, nullptr, nullptr, curvature.data());
        for (std::size_t c = 0; c < m; ++c) sums[c] += curvature[triangle(c) + c];
        ++count;
    });
    for (double& sum : sums) sum = std::isfinite(sum) && sum > 0 ? sum / count : 0;
    return sums;
}

double JointPotential::largestCurvature(const std::vector<double>& low,
                                        const std::vector<double>& high) const {
    if (kind_ == Kind::single) return single_.largestCurvature(low.front(), high.front());
    const std::size_t m = components();
    const auto size = static_cast<Eigen::Index>(m);
    std::vector<double> curvature(triangle(m));
    Eigen::MatrixXd H(size, size);
    double most = -std::numeric_limits<double>::infinity();
    forPlaces(m, low.data(), high.data(), true, [&](const double* u) {
        evaluate(u, 1, 1, nullptr, nullptr, curvature.data());
        for (Eigen::Index c = 0, row = 0; c < size; ++c)
            for (Eigen::Index d = 0; d <= c; ++d, ++row)
                H(c, d) = H(d, c) = curvature[static_cast<std::size_t>(row)];
        if (H.allFinite())
            most = std::max(most, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H, Eigen::EigenvaluesOnly)
                                      .eigenvalues()
                                      .maxCoeff());
    });
    return std::isfinite(most) ? most : 0;
}

bool JointPotential::turns(std::size_t a, std::size_t b) const {
    if (kind_ != Kind::typed) return kind_ == Kind::radial;
    constexpr int probes = 24;
    constexpr double roundOff = 1e-12;
    std::vector<double> u(components()), slope(components());
    for (int k = 0; k < probes; ++k) {
        for (std::size_t c = 0; c < u.size(); ++c)
            u[c] = 1.5 * std::sin(1 + 2.7 * k + 1.9 * static_cast<double>(c) * (k + 1));
        evaluate(u.data(), 1, 1, nullptr, slope.data(), nullptr);
        const double first = u[a] * slope[b], second = u[b] * slope[a];
        if (!(std::abs(first - second) <= roundOff * (std::abs(first) + std::abs(second)))) return false;
    }
    return true;
}

}  // namespace extremal
