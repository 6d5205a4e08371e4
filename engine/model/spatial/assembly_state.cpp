// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/assembly_state.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace extremal::spatial {
namespace {

/// Sets a key of an element where its numbers are others than before.
void setPlace(Value& element, const char* key, const Place& before, const Place& now) {
    constexpr double same = 1e-12;
    if ((now - before).norm() <= same * std::max(1.0, before.norm())) return;
    element.set(key, Value::Array{now(0), now(1), now(2)});
}

void setAttitude(Value& element, const Axes& before, const Axes& now) {
    constexpr double same = 1e-12;
    if ((now - before).norm() <= same) return;
    const Value* const given = element.find("attitude");
    if (given && given->isArray() && given->asArray().size() == 9) {
        Value::Array rows;
        for (int i = 0; i < 9; ++i) rows.emplace_back(now(i / 3, i % 3));
        element.set("attitude", rows);
        return;
    }
    const Eigen::AngleAxisd turn(now);
    const Place a = turn.angle() * turn.axis();
    element.set("attitude", Value::Array{a(0), a(1), a(2)});
}

/// The settings of a model whose parameters have their values.
Settings settingsOf(const WrittenForm& form, const Value& model) {
    Settings made;
    made.type = "mechanism-3d";
    for (const auto& [key, value] : model.asObject()) {
        const bool isKnown = key == "parameters" || key == "gravity" || key == "type";
        if (!isKnown) made.keys.emplace_back(key, value);
    }
    made.keys.emplace_back("parameters", *form.settings.find("parameters"));
    made.keys.emplace_back("gravity", 0);  // which no start has in it
    return made;
}

}  // namespace

Coordinates::Coordinates(const Assembly& assembly) : assembly_(assembly) {
    for (const BodyElement& b : assembly.bodies) {
        bodies_.push_back(count_);
        count_ += b.thinAxis ? 9 : 12;
    }
    for (const PointElement& p : assembly.points) {
        points_.push_back(p.isFree() ? count_ : -1);
        count_ += p.isFree() ? 3 : 0;
    }
}

Place Coordinates::centre(const double* q, std::size_t body) const {
    return Eigen::Map<const Place>(q + bodies_[body]);
}

Axes Coordinates::attitude(const double* q, std::size_t body) const {
    const std::optional<int> thin = assembly_.bodies[body].thinAxis;
    const double* next = q + bodies_[body] + 3;
    Axes R;
    for (int row = 0; row < 3; ++row)
        for (int j = 0; j < 3; ++j)
            if (thin != j) R(row, j) = *next++;
    if (thin) R.col(*thin) = Place(R.col((*thin + 1) % 3)).cross(Place(R.col((*thin + 2) % 3)));
    return R;
}

Place Coordinates::angularVelocity(const double* q, const double* v, std::size_t body) const {
    const std::optional<int> thin = assembly_.bodies[body].thinAxis;
    const Axes R = attitude(q, body);
    Axes rate = attitude(v, body);
    if (thin) {
        const int a = (*thin + 1) % 3, b = (*thin + 2) % 3;
        rate.col(*thin) =
            Place(rate.col(a)).cross(Place(R.col(b))) + Place(R.col(a)).cross(Place(rate.col(b)));
    }
    Place omega = Place::Zero();
    for (int j = 0; j < 3; ++j) omega += Place(R.col(j)).cross(Place(rate.col(j))) / 2;
    return omega;
}

Place Coordinates::at(const double* q, std::size_t point) const {
    const PointElement& p = assembly_.points[point];
    const Place own(p.at[0].value, p.at[1].value, p.at[2].value);
    if (p.isFixed) return own;
    if (p.body) return centre(q, *p.body) + attitude(q, *p.body) * own;
    return Eigen::Map<const Place>(q + points_[point]);
}

std::vector<std::vector<int>> Coordinates::groups() const {
    std::vector<std::vector<int>> all;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        all.emplace_back();
        for (int i = 0; i < (assembly_.bodies[b].thinAxis ? 9 : 12); ++i)
            all.back().push_back(bodies_[b] + i);
    }
    return all;
}

Value withStart(const WrittenForm& form, const Value& model, const double* q, const double* v) {
    const Assembly before = assemblyOf(settingsOf(form, model));
    const Coordinates at(before);
    Value changed = model;
    const auto elements = [&](const char* key) -> Value* {
        Value* const found = changed.find(key);
        return found && found->isObject() ? found : nullptr;
    };
    const auto moved = [&](std::optional<std::size_t> body, const Place& place) -> Place {
        if (!body) return place;
        const BodyElement& b = before.bodies[*body];
        return at.centre(q, *body) + at.attitude(q, *body) * b.attitude.transpose() * (place - b.at);
    };
    const auto turned = [&](std::optional<std::size_t> body, const Place& direction) -> Place {
        if (!body) return direction;
        return at.attitude(q, *body) * before.bodies[*body].attitude.transpose() * direction;
    };
    if (Value* const bodies = elements("bodies"))
        for (std::size_t b = 0; b < before.bodies.size(); ++b) {
            const BodyElement& own = before.bodies[b];
            Value& body = *bodies->find(own.name);
            const Axes R = at.attitude(q, b);
            setPlace(body, "at", own.at, at.centre(q, b));
            setAttitude(body, own.attitude, R);
            setPlace(body, "velocity", own.velocity, at.centre(v, b));
            setPlace(body, "spin", own.spin, R.transpose() * at.angularVelocity(q, v, b));
        }
    if (Value* const points = elements("points"))
        for (std::size_t k = 0; k < before.points.size(); ++k)
            if (before.points[k].isFree()) {
                Value& point = *points->find(before.points[k].name);
                setPlace(point, "at", placeAtStart(before, k), at.at(q, k));
                setPlace(point, "velocity", before.points[k].velocity, at.at(v, k));
            }
    if (Value* const joints = elements("joints"))
        for (const JointElement& j : before.joints) {
            Value& joint = *joints->find(j.name);
            setPlace(joint, "at", j.at, moved(j.body, j.at));
            setPlace(joint, "axis", j.axis, turned(j.body, j.axis));
            if (joint.find("second")) setPlace(joint, "second", j.second, turned(j.to, j.second));
        }
    return changed;
}

}  // namespace extremal::spatial
