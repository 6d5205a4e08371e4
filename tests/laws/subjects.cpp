// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/subjects.hpp"

#include <QtGlobal>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

#include "engine/family/parts/references.hpp"
#include "engine/model/density/part.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal::laws {
namespace {

constexpr int referenceSteps = 32;

bool dependsOnTime(const System& system, const State& start) {
    const EnergyFunction energy = energyOf(system);
    if (!energy) return false;
    const double first = energy(start.t, start.x.data());
    for (const double later : {0.37, 1.1, 2.3})
        if (energy(start.t + later, start.x.data()) != first) return true;
    return false;
}

/// The lowest eigenstates with weights 0.5, 0.3 and 0.2 (of a rectangle as well).
State superposed(const System& system) {
    const auto states = Eigenstates::of(system.hamiltonian());
    State s{0, 0, std::vector<double>(2 * static_cast<std::size_t>(states->size()))};
    int k = 0;
    for (const double weight : {0.5, 0.3, 0.2}) {
        const auto c = states->coefficients(k);
        for (std::size_t i = 0; i < c.size(); ++i)
            coefficients(s.x.data())[i] += std::sqrt(weight) * std::polar(1.0, 0.7 * k) * c[i];
        ++k;
    }
    return s;
}

/// Each form of the wave functions, small; and a potential that depends on time, from states of the potential
/// at rest.
std::vector<Subject> waves() {
    constexpr double time = 1.5;
    const Value well = "6*(1 - cos(x)) + sin(2*x)";
    const auto on = [&](const char* key, const char* value) {
        return systemNamed("schrodinger", {{"modes", 32}, {"potential", well}, {key, value}});
    };
    const auto with = [](const char* potential) {
        return systemNamed("schrodinger", {{"modes", 32}, {"potential", potential}});
    };
    const auto subject = [&](const char* name, const System& system) {
        return subjectOf(name, system, superposed(system), time);
    };
    return {
        subject("periodic", on("boundary", "periodic")), subject("convolution", on("product", "convolution")),
        subject("dirichlet", on("boundary", "dirichlet")),
        subject("plane",
                systemNamed(
                    "schrodinger-2d",
                    {{"modes", 16}, {"modes_y", 16}, {"potential", "2 - cos(x) - cos(y) + 0.3*sin(x + y)"}})),
        subjectOf("driven", with("6*(1 - cos(x - 0.2*sin(2*t)))"), superposed(with("6*(1 - cos(x))")), time)};
}

/// A mass that rotates on a stiff spring, without weight: a fast oscillation and a momentum, which no model
/// of the catalogue has together.
Subject rotatingSpring() {
    System system = systemNamed("lagrangian", {{"coordinates", Value(Value::Array{"a", "theta"})},
                                               {"parameters", Value(Value::Object{{"k", 1e4}})},
                                               {"lagrangian", "(a_t^2 + (1 + a)^2*theta_t^2 - k*a^2)/2"}});
    system.fast.frequency = 100;
    system.fast.coordinates = {0};
    return subjectOf("rotating spring", system, {0, 0, {0.01, 0.3, 0.05, 1}}, 0, 1);
}

/// Planets whose pull on each other is felt at the steps of the laws, as that of the outer ones is not.
Subject heavyPlanets() {
    return subjectOf("heavy planets", planets(),
                     {0, 0, {0, 0, 1, 0, -0.3, 1.9, 0, 0, 0, 0.05, -0.014, -0.002}}, 0, 4);
}

/// A charge without mass in a field that grows with the distance, whose one-form has both components and is
/// not affine: on the forms of the presets projections do no harm.
Subject masslessCharge() {
    const System system =
        systemNamed("phase-space",
                    {{"variables", Value(Value::Array{"x", "y"})},
                     {"parameters", Value(Value::Object{})},
                     {"one_form", Value(Value::Object{{"x", "-(1+x^2+y^2)/2*y"}, {"y", "(1+x^2+y^2)/2*x"}})},
                     {"hamiltonian", "cos(x) + sin(y)"}});
    return subjectOf("massless charge", system, {0, 0, {0.6, 0.4}}, 0, 4);
}

/// The value of the first "type" after "model", without reading the scene.
std::string modelOf(std::string_view json) {
    const auto model = json.find("\"model\""), key = json.find("\"type\"", model),
               from = json.find('"', json.find(':', key)) + 1;
    return std::string(json.substr(from, json.find('"', from) - from));
}

}  // namespace

State Subject::exactAt(double t) const {
    const auto integrator = trustedIntegrator(system, start, (t - start.t) / referenceSteps);
    const auto end = after(*integrator, start, referenceSteps);
    if (!end) qFatal("%s: no reference", name.c_str());
    return *end;
}

double distanceOn(const Subject& on, const State& a, const State& b) {
    double worst = 0;
    for (std::size_t i = 0; i < on.start.x.size(); ++i)
        worst = std::max(worst, std::abs(a.x[i] - b.x[i]) / on.scaleOf(i));
    return worst;
}

Subject subjectOf(std::string name, const System& system, const State& start, double time, double longest) {
    Subject s{std::move(name), system, start, time, 0, 0, {}, {}, !dependsOnTime(system, start)};
    if (time == 0) {
        const double w = highestFrequency(s.system, s.start);
        s.time = w > 0 ? std::min(longest, 4 / w) : longest;
    }
    const auto integrator = trustedIntegrator(s.system, s.start, s.time / referenceSteps);
    State state = s.start;
    s.own.assign(state.x.size(), 0);
    for (int k = 1; k <= referenceSteps; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged)
            qFatal("%s: no reference", s.name.c_str());
        if (k % (referenceSteps / 4) == 0)
            s.exact[static_cast<std::size_t>(4 * k / referenceSteps - 1)] = state;
        for (std::size_t i = 0; i < state.x.size(); ++i) {
            double& scale = s.hasHalves() && i >= s.half() ? s.scaleP : s.scaleQ;
            scale = std::max(scale, std::abs(state.x[i]));
            s.own[i] = std::max(s.own[i], std::abs(state.x[i]));
        }
    }
    if (!(s.scaleP > 0)) s.scaleP = 1;
    // Coordinates that hardly leave zero are lost in the round-off of the others; Pluto's momentum, 3e-6 of
    // Jupiter's, is not.
    for (std::size_t i = 0; i < s.own.size(); ++i) s.own[i] = std::max(s.own[i], 1e-4 * s.scaleOf(i));
    return s;
}

SubjectKind kindOfSubject(const System& system) {
    return system.hasCoordinates()     ? SubjectKind::coordinates
           : system.parts.find<Body>() ? SubjectKind::body
           : system.parts.find<Wave>() ? SubjectKind::wave
                                       : SubjectKind::other;
}

std::vector<const Preset*> onePerModel() {
    std::vector<const Preset*> all;
    std::set<std::string> seen;
    for (const Preset& preset : presets()) {
        // Steps of variable length, parameters that change on the way and rest on walls have tests of their
        // own. The four-bar drawn by hand moves as the one that is written down, and ten bodies as one, more
        // slowly. Controls that were found are tables with knots inside of steps, beyond which no order above
        // 4 is seen. Angles that pass a pole lose the digits that returns are measured by, as their lesson
        // shows; the same pendulum on its sphere is a subject. A rod that stands still and a top that is
        // nearly degenerate are stiff, with tests of their own. What moons do to each other and to the energy
        // is round-off in these steps: heavy planets are a subject.
        const auto has = [&](const char* text) { return preset.json.find(text) != std::string_view::npos; };
        if (has("\"monitor\"") || has("\"switch\"") || preset.id == "ball-on-a-ball" ||
            preset.id == "four-bar-by-hand" || preset.id == "body-chain" || preset.id == "pole-of-a-chart" ||
            preset.id == "bent-rod" || preset.id == "moons" || preset.id == "degenerate-top" || has("\"interpolation\": \"cubic\""))
            continue;
        const std::string model = modelOf(preset.json);
        const bool isTyped = model == "lagrangian" || model == "hamiltonian";
        // Fields with a typed density are of another kind than those with a potential.
        const bool hasDensity = model.starts_with("field") && has("\"lagrangian\"");
        if (seen.insert(isTyped ? std::string(preset.id) : hasDensity ? model + ", typed" : model).second)
            all.push_back(&preset);
    }
    return all;
}

std::vector<Subject> everySubject(SubjectKind kind) {
    if (kind == SubjectKind::wave) return waves();
    std::vector<Subject> subjects;
    for (const Preset* preset : onePerModel()) {
        const Scene scene = readScene(preset->json).scene;
        const System system = makeSystem(scene);
        // The orders of fields are those of the mesh and the step together: laws.claims_fields.
        // Membranes: tests/engine/family/asynchronous; rectangles: tests/engine/family/spectral_field; typed
        // densities: tests/engine/baseline/implicit_cells_test.cpp.
        if (kindOfSubject(system) != kind || !system.isMotion() || system.parts.find<ScalarField>() ||
            system.parts.find<Membrane>() || system.parts.find<PlaneField>() ||
            system.parts.find<DensityField>())
            continue;
        double longest = 0;
        for (const SchemeSpec& scheme : scene.schemes) longest = std::max(longest, 40 * scheme.step.value);
        subjects.push_back(
            subjectOf(std::string(preset->id), system, initialState(scene, system), 0, longest));
    }
    if (kind == SubjectKind::coordinates) subjects.push_back(rotatingSpring());
    if (kind == SubjectKind::coordinates) subjects.push_back(heavyPlanets());
    if (kind == SubjectKind::other) subjects.push_back(masslessCharge());
    return subjects;
}

}  // namespace extremal::laws
