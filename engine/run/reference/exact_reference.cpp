// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/exact_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/family/family.hpp"
#include "engine/model/parts/mesh_error.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/premise.hpp"

namespace extremal {
namespace {

/// Where the error is not one of the phase itself, most of the motion is slower than at its fastest (measured
/// in engine.run.reference).
double roundOffPart(const System& system, const State& initial, double duration) {
    const auto norm = [](const std::vector<double>& v) {
        double sum = 0;
        for (const double x : v) sum = std::hypot(sum, x);
        return sum;
    };
    double w = highestFrequency(system, initial);
    if (std::vector<double> rate(initial.x.size());
        w == 0 && rateOf(system, initial.t, initial.x.data(), rate.data()) && norm(initial.x) > 0)
        w = norm(rate) / norm(initial.x);
    if (system.error.isOfPhase) return 1e-14 * std::max(1.0, w * duration / 4);
    double scale = 0;
    for (const double v : initial.x) scale = std::max(scale, std::abs(v));
    return 2e-15 * scale * std::max(1.0, w * duration / 10);
}

constexpr int samplesOfRun = 199;  ///< of a run: a prime, not in step with the motion

/// What a double can say of the largest numbers that the motion comes to.
double sizePart(const Scene& scene, const System& system, const State& initial) {
    const ExactSolution exact = exactSolution(scene, system, initial);
    std::vector<double> x(initial.x.size());
    double most = 0;
    for (int k = 1; k <= samplesOfRun; ++k) {
        exact(scene.start.value + (scene.end.value - scene.start.value) * k / samplesOfRun, x);
        for (const double v : x)
            if (std::isfinite(v)) most = std::max(most, std::abs(v));
    }
    return 4 * std::numeric_limits<double>::epsilon() * most;
}

/// The largest distance over the run of motions whose initial data differ by half a unit in the last place of
/// one entry, summed over the entries. From differences over one unit and over many: the first are those that
/// matter where the motion depends on the data strongly, the others are less rough.
double conditionPart(const Scene& scene, const System& system, const State& initial,
                     const std::stop_token& stop) {
    constexpr double many = 1024;
    const double length = scene.end.value - scene.start.value;
    const ErrorMeasure measure = errorMeasure(system, initial);
    const ExactSolution exact = exactSolution(scene, system, initial);
    std::vector<double> x(initial.x.size()), y(x), values(measure.columns.size());
    const auto change = [&](std::size_t i, double units) {
        State moved = initial;
        const double unit = std::nextafter(std::abs(initial.x[i]), std::numeric_limits<double>::infinity()) -
                            std::abs(initial.x[i]);
        moved.x[i] += units * unit;
        const ExactSolution other = exactSolution(scene, system, moved);
        if (!other) return 0.0;
        double most = 0;
        for (int k = 1; k <= samplesOfRun && !stop.stop_requested(); ++k) {
            const double t = scene.start.value + length * k / samplesOfRun;
            exact(t, x);
            other(t, y);
            measure.evaluate(x.data(), y.data(), values.data());
            if (std::isfinite(values[0])) most = std::max(most, values[0]);
        }
        return most / (2 * units);
    };
    double sum = 0;
    for (std::size_t i = 0; i < initial.x.size(); ++i)
        if (initial.x[i] != 0) sum += std::max(change(i, 1), change(i, many));
    return sum;
}

}  // namespace

double errorOfExact(const ResolvedScene& resolved, const std::stop_token& stop) {
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    const State& initial = resolved.initial;
    double error = roundOffPart(system, initial, scene.end.value - scene.start.value);
    const ExactPremise premise = premiseOf(scene, system, initial);
    error = std::max(error, premise.error);
    if (const MeshError* const ofMesh = system.parts.find<MeshError>()) {
        // Cut off at a wall, a wave function converges so slowly that the next mesh is no better.
        const double mesh =
            ofMesh->ofExact({scene.initial.given, initial, scene.start.value, scene.end.value}, stop);
        error = std::max(error, premise.isViolated ? std::min(2.0, 3 * mesh) : mesh);
    }
    // Other initial data are typed as formulas, and unitary motions depend on theirs isometrically.
    if (system.isMotion() && !system.exactFrom && !system.isUnitary)
        error =
            std::max({error, sizePart(scene, system, initial), conditionPart(scene, system, initial, stop)});
    return error;
}

}  // namespace extremal
