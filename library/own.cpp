// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/own.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/own_entries.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/space/catalog.hpp"

namespace extremal::api {
namespace {

constexpr int most = 64;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

const LagrangianCalls& callsOf(const void* p) { return *static_cast<const LagrangianCalls*>(p); }

void jet(const void* p, const double& t, const double* q, const double* v, double* value, double* gradient,
         double* hessian) {
    callsOf(p).jet(&callsOf(p), t, q, v, value, gradient, hessian);
}

void gradient(const void* p, const double& t, const double* q, const double* v, double* g) {
    callsOf(p).gradient(&callsOf(p), t, q, v, g);
}

/// L, its gradient and Hessian in (q, v), in buffers of the thread.
struct Jets {
    double value = 0;
    std::vector<double> g, h;
};
Jets& jetsAt(const void* p, double t, const double* q, const double* v) {
    thread_local Jets jets;
    const auto n = static_cast<std::size_t>(2 * callsOf(p).dimension);
    jets.g.resize(n);
    jets.h.resize(n * n);
    jet(p, t, q, v, &jets.value, jets.g.data(), jets.h.data());
    return jets;
}

/// Newton on dL/dv(t, q, v) = p from v = 0, to round-off: one step where L is quadratic in v. A step out of
/// the domain of L, such as beyond the speed of light, is halved.
bool velocity(const void* p, const double& t, const double* q, const double* momentum, double* v) {
    const int d = callsOf(p).dimension;
    std::fill_n(v, d, 0.0);
    double last = -1;
    Vector change = Vector::Zero(d);
    for (int iteration = 0; iteration < 100; ++iteration) {
        const Jets& at = jetsAt(p, t, q, v);
        Matrix mass(d, d);
        Vector r(d);
        for (int i = 0; i < d; ++i) {
            r(i) = momentum[i] - at.g[static_cast<std::size_t>(d + i)];
            for (int j = 0; j < d; ++j) mass(i, j) = at.h[static_cast<std::size_t>((d + i) * 2 * d + d + j)];
        }
        if (!r.allFinite() || !mass.allFinite()) {
            change /= 2;
            for (int i = 0; i < d; ++i) v[i] -= change(i);
            last = -1;
            continue;
        }
        change = Eigen::PartialPivLU<Matrix>(mass).solve(r);
        double size = 0, scale = 0;
        for (int i = 0; i < d; ++i) {
            v[i] += change(i);
            size += std::abs(change(i));
            scale += std::abs(v[i]);
        }
        if (!std::isfinite(size)) return false;
        if (size <= 1e-15 * scale || (last >= 0 && size >= last && size <= 1e-8 * scale)) return true;
        last = size;
    }
    return false;
}

double energy(const void* p, const double& t, const double* q, const double* momentum) {
    const int d = callsOf(p).dimension;
    Vector v(d);
    if (!velocity(p, t, q, momentum, v.data())) return std::numeric_limits<double>::quiet_NaN();
    double sum = -jetsAt(p, t, q, v.data()).value;
    for (int i = 0; i < d; ++i) sum += momentum[i] * v(i);
    return sum;
}

bool flow(const void* p, const double& t, const double* q, const double* momentum, double* qdot,
          double* pdot) {
    const int d = callsOf(p).dimension;
    if (!velocity(p, t, q, momentum, qdot)) return false;
    const Jets& at = jetsAt(p, t, q, qdot);
    std::copy_n(at.g.begin(), d, pdot);
    return true;
}

std::vector<FieldInfo> fieldsOf(const std::vector<Parameter>& parameters) {
    std::vector<FieldInfo> fields;
    for (const Parameter& p : parameters) {
        fields.push_back(
            numberField(p.key, p.title.empty() ? p.key : p.title, p.unit, p.fallback, p.description));
        fields.back().symbol = p.key;
    }
    return fields;
}

Parameters valuesOf(const std::vector<Parameter>& parameters, const Settings& settings) {
    std::vector<std::pair<std::string, double>> values;
    for (const Parameter& p : parameters) values.emplace_back(p.key, settings.number(p.key));
    return Parameters(std::move(values));
}

}  // namespace

double Parameters::operator[](std::string_view key) const {
    for (const auto& [name, value] : values_)
        if (name == key) return value;
    throw std::out_of_range("there is no parameter \"" + std::string(key) + "\"");
}

void addSystemCalls(const SystemInfo& info,
                    std::function<std::shared_ptr<const LagrangianCalls>(const Parameters&)> make) {
    const auto d = info.coordinates.size();
    if (d < 1 || d > most)
        throw std::logic_error("\"" + info.id + "\" must have 1 to 64 coordinates, got " + std::to_string(d));
    ModelEntry entry;
    entry.item = {info.id, info.title, info.description, fieldsOf(info.parameters), {}, ""};
    entry.exampleQ.assign(d, 1);
    entry.exampleP.assign(d, 0);
    entry.make = [info, make = std::move(make)](const Settings& settings) {
        System system;
        system.id = info.id;
        for (const CoordinateInfo& c : info.coordinates)
            system.coordinates.push_back(
                {c.name, c.title.empty() ? c.name : c.title, c.name, c.unit, c.momentumUnit});
        const auto calls = make(valuesOf(info.parameters, settings));
        if (!calls || calls->dimension != system.dimension())
            throw std::logic_error("the model of \"" + info.id + "\" has another dimension than coordinates");
        Mechanical mechanics;
        mechanics.dimension = calls->dimension;
        mechanics.model = calls;
        mechanics.jet = &jet;
        mechanics.gradient = &gradient;
        mechanics.velocity = &velocity;
        mechanics.energy = &energy;
        mechanics.flow = &flow;
        mechanics.isTimeDependent = info.isTimeDependent;
        system.parts.set(std::move(mechanics));
        const std::string& first = info.coordinates.front().name;
        system.phaseX = "q." + first;
        system.phaseY = "p." + first;
        system.trajectoryX = info.coordinates.size() > 1 ? "q." + first : "t";
        system.trajectoryY = "q." + info.coordinates[info.coordinates.size() > 1 ? 1 : 0].name;
        system.draw = [](const double*, Drawing&) {};
        return system;
    };
    OwnEntries<ModelEntry>::add(std::move(entry));
}

void addSpace(const SpaceInfo& info, std::function<Basis(const Parameters&)> make) {
    SpaceEntry entry;
    entry.item = {info.id, info.title, info.description, fieldsOf(info.parameters), {}, ""};
    entry.make = [info, make = std::move(make)](const Settings& settings) {
        const Basis basis = make(valuesOf(info.parameters, settings));
        if (basis.size < 2 || !basis.evaluate)
            throw InvalidScene("/space",
                               "the basis of \"" + info.id + "\" has " + std::to_string(basis.size) +
                                   (basis.evaluate ? " functions" : " functions and no evaluate()"),
                               "at least two functions, and what evaluates them");
        Space<double> space;
        space.size = basis.size;
        space.degree = basis.degree;
        space.evaluate = [evaluate = basis.evaluate](const double& tau, std::span<double> value,
                                                     std::span<double> derivative) {
            evaluate(tau, value, derivative);
        };
        return space;
    };
    OwnEntries<SpaceEntry>::add(std::move(entry));
}

}  // namespace extremal::api
