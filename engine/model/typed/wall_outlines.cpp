// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/wall_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

namespace extremal::typed {
namespace {

class Outlines {
public:
    Outlines(const Wall& wall, int dimension)
        : wall_(wall),
          d_(static_cast<std::size_t>(dimension)),
          gap_(static_cast<std::size_t>(wall.count())),
          byPlace_(gap_.size() * d_),
          byTime_(gap_.size()) {}

    /// Of wall k to the body with these coordinates; empty where it is one of others as well.
    std::vector<Curve> of(int k, std::pair<int, int> plane, const double* start) {
        constexpr int rays = 180;
        constexpr double reach = 3;  // in distances of the nearest place
        q_.assign(start, start + d_);
        const std::size_t i = place(plane.first), j = place(plane.second), wall = place(k);
        const double x = q_[i], y = q_[j];
        if (!(at(wall) > 0) || !isOfOneBody(wall, plane)) return {};
        std::vector<std::optional<double>> hits;
        double nearest = std::numeric_limits<double>::infinity();
        for (int ray = 0; ray < rays; ++ray) {
            const double angle = 2 * std::numbers::pi * ray / rays;
            hits.push_back(hit(wall, i, j, x, y, std::cos(angle), std::sin(angle)));
            if (hits.back()) nearest = std::min(nearest, *hits.back());
        }
        std::vector<Curve> curves;
        bool isOpen = false;
        for (int ray = 0; ray <= rays; ++ray) {
            const auto& distance = hits[static_cast<std::size_t>(ray % rays)];
            if (!distance || !(*distance <= reach * nearest)) {
                isOpen = false;
                continue;
            }
            if (!isOpen) curves.push_back({{}, 2, 0.6});
            isOpen = true;
            const double angle = 2 * std::numbers::pi * ray / rays;
            curves.back().points.push_back(
                {x + *distance * std::cos(angle), y + *distance * std::sin(angle), 0});
        }
        return curves;
    }

private:
    static std::size_t place(int i) { return static_cast<std::size_t>(i); }
    double at(std::size_t wall) {
        wall_.first(wall_.model.get(), 0, q_.data(), gap_.data(), byPlace_.data(), byTime_.data());
        return gap_[wall];
    }
    bool isOfOneBody(std::size_t wall, std::pair<int, int> plane) const {
        bool isOfIt = false;
        for (std::size_t c = 0; c < d_; ++c) {
            const bool isIts = c == place(plane.first) || c == place(plane.second);
            const bool depends = byPlace_[wall * d_ + c] != 0;
            if (depends && !isIts) return false;
            isOfIt = isOfIt || (depends && isIts);
        }
        return isOfIt;
    }
    /// How far the gap stays open along a ray.
    std::optional<double> hit(std::size_t wall, std::size_t i, std::size_t j, double x, double y, double c,
                              double s) {
        const auto gapAt = [&](double distance) {
            q_[i] = x + distance * c;
            q_[j] = y + distance * s;
            return at(wall);
        };
        constexpr double first = 1e-3, factor = 1.15, farthest = 1e4;
        double open = 0, closed = first;
        while (gapAt(closed) > 0) {
            open = closed;
            closed *= factor;
            if (closed > farthest) return {};
        }
        for (int halvings = 0; halvings < 40; ++halvings) {
            const double middle = (open + closed) / 2;
            (gapAt(middle) > 0 ? open : closed) = middle;
        }
        return open;
    }

    Wall wall_;
    std::size_t d_;
    std::vector<double> gap_, byPlace_, byTime_, q_;
};

}  // namespace

Picture withWalls(Picture picture, const Wall& wall, const std::vector<std::pair<int, int>>& planes,
                  int dimension) {
    if (wall.isTimeDependent || picture.isSpatial) return picture;
    struct Kept {
        std::once_flag once;
        std::vector<Curve> curves;
    };
    picture.draw = [plain = std::move(picture.draw), wall, planes, dimension,
                    kept = std::make_shared<Kept>()](const double* q, Drawing& drawing) {
        std::call_once(kept->once, [&] {
            Outlines outlines(wall, dimension);
            for (int k = 0; k < wall.count(); ++k)
                for (const auto& plane : planes)
                    for (Curve& curve : outlines.of(k, plane, q)) kept->curves.push_back(std::move(curve));
        });
        for (const Curve& curve : kept->curves) drawing.shapes.push_back(curve);
        plain(q, drawing);
    };
    return picture;
}

}  // namespace extremal::typed
