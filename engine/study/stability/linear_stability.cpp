// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/linear_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>

#include "engine/core/problem.hpp"
#include "engine/integrator/stability.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/one_step.hpp"

namespace extremal {
namespace {

using Complex = std::complex<double>;
using Point = LinearStability::Point;

/// z of the step h on the test problem.
class TestEquation {
public:
    /// Throws InvalidScene where the scheme cannot integrate it.
    TestEquation(const Scene& scene, std::size_t scheme, LinearTest test, const std::string& problem,
                 double frequency)
        : test_(test), frequency_(frequency) {
        const ReadScene problemRead = readScene(problem);
        Value document = toValue(problemRead.scene);
        Value own = toValue(scene).find("schemes")->asArray()[scheme];
        if (own.find("step")) own.set("step", 1.0);
        own.set("enabled", true);
        own.set("allow_unstable", true);
        document.set("schemes", Value::Array{own});
        const ReadScene read = readScene(document);
        if (!read.resolved) throw InvalidScene("", read.errors.front().message);
        scene_ = *read.resolved;
        start_ = initialOf(scene_, resolved());
        step_.emplace(resolved(), *systemOf(scene_, resolved()), 1, start_);
    }

    Point at(double z) {
        Point point;
        point.z = z;
        step_->setStep(z / frequency_);
        if (isOscillator())
            ofOscillator(point);
        else
            ofWaves(point);
        return point;
    }

    const ResolvedScheme& resolved() const { return scene_.schemes.front(); }
    bool isOscillator() const { return test_ == LinearTest::oscillator; }

private:
    bool step(State& state) { return step_->take(state); }

    void ofOscillator(Point& point) {
        double M[2][2];
        for (const int column : {0, 1}) {
            State state = start_;
            state.x = {column == 0 ? 1.0 : 0.0, column == 1 ? 1.0 : 0.0};
            step_->begin(state);
            if (resolved().isFixed() && !state.memory.empty())
                throw InvalidScene("", "its steps depend on more than the state");
            if (!step(state)) return;
            for (const int row : {0, 1}) M[row][column] = state.x[static_cast<std::size_t>(row)];
        }
        const double half = (M[0][0] + M[1][1]) / 2, det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
        const double square = half * half - det;
        if (square > 0) {
            point.amplification = std::abs(half) + std::sqrt(square);
            return;
        }
        point.amplification = std::sqrt(std::abs(det));
        const double phase = std::atan2(std::copysign(std::sqrt(-square), M[0][1]), half);
        point.phaseError = phaseError(phase, point.z);
    }

    void ofWaves(Point& point) {
        State state = start_;
        step_->begin(state);
        // Both roots of a scheme with levels are to be seen, not the physical one alone that it starts with.
        if (!state.memory.empty() && !step(state)) return;
        for (double& v : state.memory) v *= 0.7;
        const int levels = state.memory.empty() ? 1 : 2;
        std::vector<std::size_t> modes;
        std::vector<std::vector<Complex>> c;
        for (std::size_t k = 0; 2 * k + 1 < state.x.size(); ++k)
            if (std::hypot(state.x[2 * k], state.x[2 * k + 1]) > 0.1) modes.push_back(k);
        c.resize(modes.size());
        for (int n = 0;; ++n) {
            for (std::size_t i = 0; i < modes.size(); ++i)
                c[i].emplace_back(state.x[2 * modes[i]], state.x[2 * modes[i] + 1]);
            if (n == 2 * levels - 1) break;
            if (!step(state)) return;
        }
        point.amplification = 0;
        for (std::size_t i = 0; i < modes.size(); ++i) {
            std::vector<Complex> roots{c[i][1] / c[i][0]};
            if (levels == 2) {
                const Complex det = c[i][1] * c[i][1] - c[i][0] * c[i][2];
                const Complex a = (c[i][1] * c[i][2] - c[i][0] * c[i][3]) / det,
                              b = (c[i][1] * c[i][3] - c[i][2] * c[i][2]) / det;
                const Complex root = std::sqrt(a * a / 4.0 + b);
                roots = {a / 2.0 + root, a / 2.0 - root};
            }
            double nearest = HUGE_VAL;
            for (const Complex& r : roots) {
                point.amplification = std::max(point.amplification, std::abs(r));
                const double error = phaseError(std::abs(std::arg(r)), point.z);
                if (std::abs(error) < std::abs(nearest)) nearest = error;
            }
            if (!(std::abs(point.phaseError) >= std::abs(nearest))) point.phaseError = nearest;
        }
    }

    /// With the turns that bring it nearest.
    static double phaseError(double phase, double z) {
        constexpr double turn = 2 * std::numbers::pi;
        return (phase + turn * std::round((z - phase) / turn) - z) / z;
    }

    LinearTest test_;
    double frequency_;
    ResolvedScene scene_;
    State start_;
    std::optional<OneStep> step_;
};

TestEquation testEquation(const Scene& scene, std::size_t scheme, const System& system) {
    const LinearTest test = linearTestOf(system);
    if (test == LinearTest::oscillator)
        return {scene, scheme, test,
                R"({"extremal":1,"model":{"type":"harmonic-oscillator","m":1,"k":1},"initial":{"q":[1]},
                    "time":{"end":8},"reference":"none","schemes":[{"step":1,"scheme":"midpoint"}]})",
                1};
    if (test == LinearTest::phases)
        return {scene, scheme, test,
                R"json({"extremal":1,"model":{"type":"schrodinger","modes":16,"potential":"-1.25"},
                    "initial":{"psi":{"re":"cos(x)+cos(2*x)","im":"sin(x)+sin(2*x)"}},"time":{"end":8},
                    "reference":"none","schemes":[{"step":1,"baseline":"strang"}]})json",
                0.75};
    throw InvalidScene("", "there is no linear test equation for " + system.id);
}

/// In the whole range that a study shows.
void findLimit(TestEquation& equation, LinearStability& result, const std::stop_token& stop) {
    constexpr StabilityScan scan{.fine = 0.01, .fineEnd = 20, .coarse = 0, .ratio = 1.05, .end = 1e4};
    const StabilityEdge edge =
        firstInstability([&](double z) { return stop.stop_requested() || equation.at(z).isStable(); }, scan);
    result.hasLimit = edge.isFound() && !stop.stop_requested();
    if (!result.hasLimit) return;
    result.low = edge.low;
    result.high = edge.high;
}

/// By the coefficients of the scheme, where they say: between two neighbouring numbers.
bool takeKnownLimit(const ResolvedScheme& scheme, LinearStability& result) {
    const auto stability = stabilityOf(scheme);
    if (!stability || !stability->growthWithin) return false;
    const double limit = firstEdge(stability->intervals);
    result.hasLimit = std::isfinite(limit);
    if (!result.hasLimit) return true;
    result.low = limit;
    result.high = std::nextafter(limit, HUGE_VAL);
    return true;
}

LinearRegion regionOf(const ResolvedScheme& scheme, const std::stop_token& stop) {
    try {
        return linearRegion(scheme, stop);
    } catch (const InvalidScene& e) {
        LinearRegion none;
        none.reason = e.problems().front().message;
        return none;
    }
}

}  // namespace

LinearStability linearStability(const Scene& scene, std::size_t scheme, const std::stop_token& stop) {
    constexpr int parts = 252;  // steps of pi/63 up to 4 pi
    LinearStability result;
    try {
        TestEquation equation = testEquation(scene, scheme, *resolve(scene).system);
        for (int i = 1; i <= parts && !stop.stop_requested(); ++i)
            result.points.push_back(equation.at(4 * std::numbers::pi * i / parts));
        if (!equation.isOscillator() || !takeKnownLimit(equation.resolved(), result))
            findLimit(equation, result, stop);
        result.region = regionOf(equation.resolved(), stop);
    } catch (const InvalidScene& e) {
        result.points.clear();
        result.reason = e.problems().front().message;
    }
    return result;
}

}  // namespace extremal
