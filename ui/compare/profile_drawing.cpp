// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/profile_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostPlaces = 201;

/// No more digits than a mouse can draw.
Value::Array rounded(const std::vector<double>& values) {
    Value::Array all;
    for (const double v : values) all.emplace_back(std::round(v * 1e6) / 1e6);
    return all;
}

}  // namespace

double heightOfOne(const System& system) {
    const std::vector<double> ones(system.field.size(), 1.0);
    Drawing drawing;
    system.draw(ones.data(), drawing);
    for (const Shape& shape : drawing.shapes)
        if (const auto* curtain = std::get_if<Curtain>(&shape); curtain && !curtain->top.empty())
            return curtain->top.front()[1];
    return 0;
}

std::optional<ProfileDrawing> ProfileDrawing::of(const Scene& scene) {
    try {
        const System system = makeSystem(scene);
        const ScalarField* const field = system.parts.find<ScalarField>();
        if (!field || !system.draw) return {};
        const State start = initialState(scene, system);
        ProfileDrawing drawing;
        drawing.unit_ = heightOfOne(system);
        if (!(drawing.unit_ > 0)) return {};
        const FieldProblem& problem = *field->problem;
        drawing.isPeriodic_ = problem.mesh.isPeriodic();
        drawing.isHeld_ = problem.mesh.boundary == Boundary::dirichlet;
        std::vector<double> sample(system.field.size());
        system.field.sample(start.x.data(), sample.data());
        const std::vector<double>& nodes = system.field.x;
        const std::size_t n = nodes.size(), every = (n + mostPlaces - 2) / (mostPlaces - 1);
        const auto add = [&](double x, std::size_t i) {
            drawing.x_.push_back(x);
            drawing.u_.push_back(sample[i]);
            drawing.v_.push_back(sample[n + i]);
        };
        for (std::size_t i = 0; i + (drawing.isPeriodic_ ? 0 : 1) < n; i += every) add(nodes[i], i);
        if (drawing.isPeriodic_)
            add(problem.mesh.left() + problem.mesh.length(), 0);
        else
            add(nodes[n - 1], n - 1);
        return drawing;
    } catch (const InvalidScene&) {
        return {};
    }
}

void ProfileDrawing::stroke(const Point& from, const Point& to) {
    const Point &left = from[0] <= to[0] ? from : to, &right = from[0] <= to[0] ? to : from;
    // A place that lies between the points, and the nearest one in any case.
    const auto nearest = [&](double x) {
        const auto after = std::lower_bound(x_.begin(), x_.end(), x);
        if (after == x_.begin()) return std::size_t{0};
        const auto i = static_cast<std::size_t>(after - x_.begin());
        return after == x_.end() || x - x_[i - 1] < *after - x ? i - 1 : i;
    };
    const std::size_t first = nearest(left[0]), last = nearest(right[0]);
    for (std::size_t i = first; i <= last; ++i) {
        if (isHeld_ && (i == 0 || i + 1 == x_.size())) continue;
        const double part =
            right[0] > left[0] ? std::clamp((x_[i] - left[0]) / (right[0] - left[0]), 0.0, 1.0) : 0.5;
        u_[i] = ((1 - part) * left[1] + part * right[1]) / unit_;
    }
    if (isPeriodic_ && first == 0) u_.back() = u_.front();
    if (isPeriodic_ && last + 1 == x_.size()) u_.front() = u_.back();
}

std::vector<Point> ProfileDrawing::line() const {
    std::vector<Point> points;
    for (std::size_t i = 0; i < x_.size(); ++i) points.push_back({x_[i], unit_ * u_[i], 0});
    return points;
}

std::vector<Edit> ProfileDrawing::edits() const {
    Value values{Value::Object{}};
    values.set("x", rounded(x_));
    values.set("u", rounded(u_));
    if (std::any_of(v_.begin(), v_.end(), [](double v) { return v != 0; })) values.set("u_t", rounded(v_));
    Value initial{Value::Object{}};
    initial.set("values", values);
    return {{"/initial", initial}};
}

}  // namespace extremal
