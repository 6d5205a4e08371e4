// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/answers.hpp"

#include <sstream>

#include "engine/study/fit/fit.hpp"
#include "engine/study/fit/measured_data.hpp"
#include "engine/study/gradient/gradient.hpp"
#include "engine/study/gradient/steering.hpp"
#include "engine/study/orbits/orbit_request.hpp"
#include "library/data.hpp"

namespace extremal::api {

Value orbit(const Scene& scene, const OrbitOptions& options) {
    const OrbitAnswer answer = seekOrbit(
        *scene.data().read.resolved,
        {options.scheme, options.period, options.energy, options.hold, options.follow, options.points});
    Value document = orbitValue(answer);
    if (!answer.isFound()) return document;
    document.set("orbits", rowsValue(answer.table));
    document.set("scene", answer.scene);
    return document;
}

Value fit(const Scene& scene, const std::string& csv, const FitOptions& options) {
    const ResolvedScene& resolved = *scene.data().read.resolved;
    std::istringstream in(csv);
    const MeasuredData data = readMeasuredData(in, "data", *resolved.system, options.columns);
    const FitAnswer answer =
        extremal::fit(resolved, data, {options.free, options.scheme, options.columns, options.measuresBias});
    Value document = fitValue(answer);
    if (!answer.isFound()) return document;
    document.set("residuals", rowsValue(answer.residuals));
    document.set("scene", answer.scene);
    return document;
}

Value gradient(const Scene& scene, const GradientOptions& options) {
    return gradientValue(extremal::gradient(*scene.data().read.resolved,
                                            {options.of, options.over, options.with, options.scheme}));
}

Value steer(const Scene& scene, const SteerOptions& options) {
    const SteeringAnswer answer = extremal::steer(
        *scene.data().read.resolved,
        {options.controls, options.of, options.over, options.conditions, options.bounds, options.scheme});
    Value document = steeringValue(answer);
    if (!answer.isFound()) return document;
    document.set("controls", rowsValue(answer.controls));
    document.set("states", rowsValue(answer.states));
    document.set("scene", answer.scene);
    return document;
}

}  // namespace extremal::api
