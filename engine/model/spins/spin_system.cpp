// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spins/spin_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/body/rigid.hpp"
#include "engine/model/group/sphere_picture.hpp"

namespace extremal::spins {
namespace {

using Three = Eigen::Vector3d;
using Shared = std::shared_ptr<const SpinModel>;

/// The spins of a state.
std::vector<double> at(const SpinModel& model, const double* x) {
    std::vector<double> s(3 * static_cast<std::size_t>(model.count()));
    spinsOf(model, x, x + 2 * model.count(), s.data());
    return s;
}
Three vectorAt(const std::vector<double>& s, int i) { return Eigen::Map<const Three>(s.data() + 3 * i); }

/// In a fan, where a scene says nothing.
std::vector<double> exampleSpins(int count) {
    std::vector<double> s;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        s.insert(s.end(), {0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.8});
    }
    return s;
}

std::vector<double> startSpins(const SpinModel& model, const Settings& initial) {
    const Value* const given = initial.find("spins");
    if (!given || given->isNull()) return exampleSpins(model.count());
    const std::string count = std::to_string(model.count());
    if (!given->isArray() || given->asArray().size() != static_cast<std::size_t>(model.count()))
        throw InvalidScene("/spins", "must be a list of " + count + " vectors",
                           "[x, y, z] of length 1 for each");
    std::vector<double> s;
    for (std::size_t i = 0; i < given->asArray().size(); ++i) {
        const std::string pointer = "/spins/" + std::to_string(i);
        Three v(numbersIn(given->asArray()[i], pointer, 3, {}, "[0, 0.6, 0.8], say").data());
        if (!(std::abs(v.norm() - 1) <= 1e-6)) {
            const Three unit = v.normalized();
            throw InvalidScene(pointer, "has the length " + formatNumber(v.norm(), 6) + ", not 1",
                               unit.allFinite() ? "[" + formatNumber(unit(0)) + ", " + formatNumber(unit(1)) +
                                                      ", " + formatNumber(unit(2)) + "]"
                                                : "[0, 0, 1], say");
        }
        v.normalize();
        s.insert(s.end(), v.data(), v.data() + 3);
    }
    return s;
}

/// Whether H stays the same under all rotations about an axis: sum b_i x s_i has no part along it at random
/// spins.
bool isKept(const SpinModel& model, int axis) {
    std::mt19937 random(1788);
    std::normal_distribution<double> normal;
    std::vector<double> s(3 * static_cast<std::size_t>(model.count())), b(s.size());
    for (int probe = 0; probe < 8; ++probe) {
        for (int i = 0; i < model.count(); ++i)
            Eigen::Map<Three>(s.data() + 3 * i) =
                Three(normal(random), normal(random), normal(random)).normalized();
        energyOf(model, s.data(), b.data());
        double sum = 0, size = 0;
        for (int i = 0; i < model.count(); ++i) {
            const double part = so3::cross(vectorAt(b, i), vectorAt(s, i))(axis);
            sum += part;
            size += std::abs(part);
        }
        if (!(std::abs(sum) <= 1e-12 * size)) return false;
    }
    return true;
}

Measure momentumOf(const Shared& model) {
    std::vector<int> axes;
    std::vector<Quantity> columns;
    for (int axis = 0; axis < 3; ++axis)
        if (isKept(*model, axis)) {
            const std::string name(1, "xyz"[axis]);
            axes.push_back(axis);
            columns.push_back({"momentum." + name, "", "Σ w s_" + name, ""});
        }
    columns.push_back({"momentum_error", "", "change of Σ w s", ""});
    return {"momentum", columns, static_cast<int>(axes.size()),
            [model, axes](const State& initial) -> Measure::Evaluate {
                const auto sums = [model](const double* x) {
                    const std::vector<double> s = at(*model, x);
                    Three sum = Three::Zero();
                    for (int i = 0; i < model->count(); ++i)
                        sum += model->weights[static_cast<std::size_t>(i)] * vectorAt(s, i);
                    return sum;
                };
                return [axes, sums, first = sums(initial.x.data())](double, const double* x, double* values) {
                    const Three now = sums(x);
                    double change = 0;
                    for (const int axis : axes) {
                        *values++ = now(axis);
                        change = std::hypot(change, now(axis) - first(axis));
                    }
                    *values = change;
                };
            }};
}

/// The length that is furthest from 1.
Measure normOf(const Shared& model) {
    return {"norm",
            {{"norm", "", "|s|", ""}, {"norm_error", "", "|s| − 1", ""}},
            1,
            [model](const State&) -> Measure::Evaluate {
                return [model](double, const double* x, double* values) {
                    const std::vector<double> s = at(*model, x);
                    values[1] = 0;
                    for (int i = 0; i < model->count(); ++i) {
                        const double off = vectorAt(s, i).norm() - 1;
                        if (!(std::abs(off) <= std::abs(values[1]))) values[1] = off;
                    }
                    values[0] = 1 + values[1];
                };
            }};
}

Measure spinMeasure(const Shared& model) {
    std::vector<Quantity> columns;
    for (int i = 0; i < model->count(); ++i)
        for (int k = 1; k <= 3; ++k) {
            const std::string name = std::to_string(i + 1) + "." + std::to_string(k);
            columns.push_back({"s." + name, "", "s_" + name, ""});
        }
    return {"spins", columns, -1, [model](const State&) -> Measure::Evaluate {
                return [model](double, const double* x, double* values) {
                    spinsOf(*model, x, x + 2 * model->count(), values);
                };
            }};
}

void describeState(System& s, const Shared& model) {
    const auto column = [&](const char* name, const char* title, int i, const char* symbol) {
        const std::string number = std::to_string(i + 1);
        s.columns.push_back(
            {std::string(name) + "." + number, title + number, std::string(symbol) + "_" + number, ""});
    };
    for (int i = 0; i < model->count(); ++i) {
        column("a", "first entry of z, real part, ", i, "a");
        column("c", "second entry of z, real part, ", i, "c");
    }
    for (int i = 0; i < model->count(); ++i) {
        column("p.a", "momentum of a", i, "p_a");
        column("p.c", "momentum of c", i, "p_c");
    }
    s.phaseX = s.trajectoryX = "a.1";
    s.phaseY = "p.a.1";
    s.trajectoryY = "c.1";
    // Phases of z have no meaning: errors are those of the spins.
    s.error.columns = {{"error", "", "|s - s_ref|", ""}};
    s.error.evaluate = [model](const double* x, const double* reference, double* values) {
        const std::vector<double> here = at(*model, x), there = at(*model, reference);
        values[0] = scaledDistance(here.size(), here.data(), there.data());
    };
}

double fastestOf(const SpinModel& model, const double* x) {
    const std::vector<double> s = at(model, x);
    std::vector<double> b(s.size());
    energyOf(model, s.data(), b.data());
    double fastest = 0;
    for (int i = 0; i < model.count(); ++i)
        fastest =
            std::max(fastest, vectorAt(b, i).norm() / std::abs(model.weights[static_cast<std::size_t>(i)]));
    return fastest;
}

/// Arrows on a circle, each from its place.
void drawArrows(const std::vector<double>& s, int count, Drawing& drawing) {
    const double radius = count < 3 ? 1 : std::max(1.0, 0.16 * count);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        const Three middle(radius * std::cos(angle), radius * std::sin(angle), 0),
            tip = middle + 0.6 * vectorAt(s, i);
        const Point from = onStage(middle(0), middle(1), middle(2)), to = onStage(tip(0), tip(1), tip(2));
        if (i == 0) drawing.tracer = to;
        if (drawing.isTracerOnly) return;
        drawing.shapes.push_back(Segment{from, to, 3});
        drawing.shapes.push_back(Disc{to, 5});
        drawing.shapes.push_back(Disc{from, 3, ShapeRole::scenery});
    }
}

void drawPoints(const std::vector<double>& s, int count, Drawing& drawing) {
    drawing.tracer = onStage(s[0], s[1], s[2]);
    if (drawing.isTracerOnly) return;
    extremal::spheres::drawSphere(drawing);
    for (int i = 0; i < count; ++i) {
        const Three v = vectorAt(s, i);
        drawing.shapes.push_back(Disc{onStage(v(0), v(1), v(2)), 7});
    }
}

}  // namespace

FieldInfo startField(const char* title) {
    return optionalJsonField("spins", title, "One vector [x, y, z] of length 1 for each.");
}

std::vector<double> weightsOf(const Value& given, const std::string& pointer) {
    if (!given.isArray()) throw InvalidScene(pointer, "must be a list of numbers", "[1, 1, -1], say");
    std::vector<double> weights;
    for (const Value& each : given.asArray()) {
        const std::string place = pointer + "/" + std::to_string(weights.size());
        weights.push_back(numberIn(each, place, {}));
        if (weights.back() == 0)
            throw InvalidScene(place, "is not a number other than 0",
                               "a weight that is not 0: what has none has no motion of its own");
    }
    return weights;
}

System systemOf(const std::string& id, const SpinModel& given, SpinPicture picture) {
    const auto model = std::make_shared<const SpinModel>(given);
    System s;
    s.id = id;
    const PhaseMechanics mechanics = mechanicsOf(model);
    s.parts.set(mechanics);
    s.parts.set(Spins{model});
    describeState(s, model);
    const int d = mechanics.dimension;
    s.energy = [model](double, const double* x) { return energyOf(*model, at(*model, x).data(), nullptr); };
    s.rate = [flow = flowOf(mechanics), d](double t, const double* x, double* dx) {
        return flow.flow(flow.model.get(), t, x, x + d, dx, dx + d);
    };
    s.frequency = [model](double, const double* x) { return fastestOf(*model, x); };
    s.start = [model](const Settings& initial, double) {
        return stateOf(*model, startSpins(*model, initial).data());
    };
    for (const auto& measure : {momentumOf(model), normOf(model), spinMeasure(model)})
        if (measure.columns.size() > 1) s.measures.push_back(measure);
    s.isSpatial = true;
    s.draw = [model, picture](const double* x, Drawing& drawing) {
        (picture == SpinPicture::arrows ? drawArrows : drawPoints)(at(*model, x), model->count(), drawing);
    };
    return s;
}

void checkFinite(const System& system, const State& initial, const char* pointer) {
    const SpinModel& model = *system.part<Spins>().model;
    const std::vector<double> s = at(model, initial.x.data());
    std::vector<double> b(s.size());
    const double energy = energyOf(model, s.data(), b.data());
    if (!std::isfinite(energy) || !std::all_of(b.begin(), b.end(), [](double v) { return std::isfinite(v); }))
        throw InvalidScene(pointer, "has no finite energy and field at the initial data", "another start");
}

}  // namespace extremal::spins
