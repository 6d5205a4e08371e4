// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace extremal::typed {
namespace {

constexpr double largeDisc = 9, smallDisc = 6;
constexpr std::size_t few = 4;  // more bodies are smaller

/// "phi_2" is the letter phi and the label "2".
struct Name {
    std::string letter, label;
};

Name split(const std::string& name) {
    const std::size_t end = std::min(name.size(), name.find_first_of("_0123456789"));
    std::string label = name.substr(end);
    label.erase(0, std::min(label.size(), label.find_first_not_of('_')));
    return {name.substr(0, end), label};
}

bool isAngle(const std::string& letter) {
    constexpr std::array<std::string_view, 7> angles = {"theta", "phi",  "varphi", "psi",
                                                        "alpha", "beta", "gamma"};
    return std::find(angles.begin(), angles.end(), letter) != angles.end();
}

/// Places of the coordinates of a body; -1: it has none of that name.
struct TypedBody {
    std::string label;
    int x = -1, y = -1, z = -1, r = -1, angle = -1;
    bool isPolar() const { return r >= 0 && angle >= 0; }
    Point at(const double* q) const {
        const auto value = [&](int place) { return place < 0 ? 0.0 : q[place]; };
        if (isPolar()) return {q[r] * std::cos(q[angle]), q[r] * std::sin(q[angle]), 0};
        if (z >= 0) return {value(x), value(z), -value(y)};  // z up, as y is on the stage
        return {value(x), value(y), 0};
    }
};

/// One body per label, if every coordinate belongs to one, as x, y, z or as r and an angle.
std::optional<std::vector<TypedBody>> bodiesOf(const std::vector<std::string>& coordinates) {
    std::vector<TypedBody> bodies;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const Name name = split(coordinates[i]);
        auto body = std::find_if(bodies.begin(), bodies.end(),
                                 [&](const TypedBody& b) { return b.label == name.label; });
        if (body == bodies.end()) body = bodies.insert(bodies.end(), TypedBody{name.label});
        int* const place = name.letter == "x"                               ? &body->x
                           : name.letter == "y"                             ? &body->y
                           : name.letter == "z"                             ? &body->z
                           : name.letter == "r" || name.letter == "rho"     ? &body->r
                           : name.letter == "theta" || name.letter == "phi" ? &body->angle
                                                                            : nullptr;
        if (!place || *place >= 0) return {};
        *place = static_cast<int>(i);
    }
    const bool isWhole = std::all_of(bodies.begin(), bodies.end(), [](const TypedBody& b) {
        const bool isCartesian = b.x >= 0 || b.y >= 0 || b.z >= 0, hasPart = b.r >= 0 || b.angle >= 0;
        return isCartesian ? !hasPart : b.isPolar();
    });
    return isWhole ? std::optional(bodies) : std::nullopt;
}

/// The lengths of the rods of a chain, by their labels or their order.
std::vector<double> lengthsOf(const Formula& formula, const std::vector<int>& angles) {
    const auto parameter = [&](const std::string& name) -> std::optional<double> {
        for (const auto& [key, value] : formula.parameters)
            if (key == name && std::isfinite(value) && value > 0) return value;
        return {};
    };
    std::vector<double> lengths;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const std::string label = split(formula.coordinates[static_cast<std::size_t>(angles[i])]).label,
                          number = std::to_string(i + 1);
        std::optional<double> length;
        for (const std::string& name : {"l" + label, "l_" + label, "l" + number, "l_" + number, "L" + number,
                                        std::string("l"), std::string("L")})
            if (!length) length = parameter(name);
        lengths.push_back(length.value_or(1));
    }
    return lengths;
}

/// Rods from the downward vertical, hung up at the origin or at a coordinate.
Picture chain(const Formula& formula, int cart, const std::vector<int>& angles) {
    return {[cart, angles, lengths = lengthsOf(formula, angles)](const double* q, Drawing& drawing) {
        Point joint{cart < 0 ? 0 : q[cart], 0, 0};
        const double largest = *std::max_element(lengths.begin(), lengths.end());
        if (cart < 0)
            drawing.shapes.push_back(Support{joint, 0.5 * largest});
        else
            drawing.shapes.push_back(Disc{joint, smallDisc});
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const double angle = q[angles[i]];
            const Point next{joint[0] + lengths[i] * std::sin(angle), joint[1] - lengths[i] * std::cos(angle),
                             0};
            drawing.shapes.push_back(Segment{joint, next, 2});
            drawing.shapes.push_back(Disc{next, largeDisc});
            drawing.tracer = joint = next;
        }
    }};
}

/// A rod from a body to another one or to a fixed point.
struct Rod {
    std::size_t from = 0;
    std::optional<std::size_t> to = {};
    std::vector<double> anchor = {};  ///< places of the coordinates of `from`, where the other end is fixed
};

/// Second derivatives of one constraint, by (row, column) with column <= row, where they are constant.
using Curvature = std::map<std::pair<int, int>, double>;

/// Of all constraints; nothing for one whose second derivatives change with the place.
std::vector<std::optional<Curvature>> curvaturesOf(const Constraint& g, std::size_t d) {
    std::vector<double> q(d), other(d);
    for (std::size_t i = 0; i < d; ++i) {
        q[i] = 0.3 + 0.17 * static_cast<double>(i);
        other[i] = 1.1 - 0.23 * static_cast<double>(i);
    }
    const auto& entries = g.entries->curvature;
    std::vector<double> here(entries.size()), there(entries.size());
    g.entries->second(g.model.get(), 0, q.data(), here.data());
    g.entries->second(g.model.get(), 0, other.data(), there.data());
    std::vector<std::optional<Curvature>> all(static_cast<std::size_t>(g.count()), Curvature{});
    for (std::size_t e = 0; e < entries.size(); ++e) {
        std::optional<Curvature>& own = all[static_cast<std::size_t>(entries[e].constraint)];
        if (!own) continue;
        if (here[e] != there[e])
            own.reset();
        else if (here[e] != 0)
            (*own)[{entries[e].row, entries[e].column}] = here[e];
    }
    return all;
}

/// A constraint as a rod: c (|r_a - r_b|^2 - l^2), or c (|r_a - r_0|^2 - l^2), whose second derivatives are
/// constant and c times those of a squared distance. `anchor` is not set.
std::optional<Rod> rodOf(const Curvature& curvature, const std::vector<TypedBody>& bodies) {
    const auto axes = [](const TypedBody& b) { return std::array<int, 3>{b.x, b.y, b.z}; };
    std::vector<std::size_t> ends;
    double scale = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        for (const int axis : axes(bodies[b])) {
            const auto found = curvature.find({axis, axis});
            if (found == curvature.end()) continue;
            if (ends.empty() || ends.back() != b) ends.push_back(b);
            scale = found->second;
        }
    if (ends.empty() || ends.size() > 2) return {};
    Curvature expected;
    for (const std::size_t a : ends)
        for (const std::size_t b : ends)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int i = axes(bodies[a])[axis], j = axes(bodies[b])[axis];
                if (i >= 0 && j >= 0 && j <= i) expected[{i, j}] = a == b ? scale : -scale;
            }
    if (expected.size() != curvature.size()) return {};
    for (const auto& [place, value] : expected) {
        const auto found = curvature.find(place);
        if (found == curvature.end() || std::abs(found->second - value) > 1e-12 * std::abs(scale)) return {};
    }
    Rod rod{ends.front()};
    if (ends.size() == 2) rod.to = ends.back();
    return rod;
}

/// Where the other ends of rods to fixed points are: r_0 = r_a - g_q / c.
void findAnchor(Rod& rod, const Constraint& g, int k, double scale, std::size_t d) {
    const auto n = static_cast<std::size_t>(g.count());
    const auto& entries = g.entries->byPlace;
    std::vector<double> q(d, 0.0), value(n), byTime(n), byPlace(entries.size());
    g.entries->first(g.model.get(), 0, q.data(), value.data(), byPlace.data(), byTime.data());
    rod.anchor = q;
    for (std::size_t e = 0; e < entries.size(); ++e)
        if (entries[e].row == k)
            rod.anchor[static_cast<std::size_t>(entries[e].column)] -= byPlace[e] / scale;
}

std::vector<Rod> rodsOf(const Constraint* g, const std::vector<TypedBody>& bodies, std::size_t d) {
    std::vector<Rod> rods;
    if (!g || !g->entries) return rods;
    const auto curvatures = curvaturesOf(*g, d);
    for (int k = 0; k < g->count(); ++k) {
        const auto& curvature = curvatures[static_cast<std::size_t>(k)];
        if (!curvature) continue;
        auto rod = rodOf(*curvature, bodies);
        if (!rod) continue;
        if (!rod->to) findAnchor(*rod, *g, k, curvature->begin()->second, d);
        rods.push_back(*std::move(rod));
    }
    return rods;
}

Picture bodies(const std::vector<TypedBody>& all, const std::vector<Rod>& rods) {
    Picture picture;
    picture.isSpatial =
        std::any_of(all.begin(), all.end(), [](const TypedBody& b) { return b.z >= 0 && b.y >= 0; });
    picture.planeX = all.front().x;
    picture.planeY = all.front().y;
    picture.draw = [all, rods](const double* q, Drawing& drawing) {
        const bool isAlone = all.size() == 1;
        for (const Rod& rod : rods) {
            const Point end = rod.to ? all[*rod.to].at(q) : all[rod.from].at(rod.anchor.data());
            if (!rod.to) drawing.shapes.push_back(Disc{end, 3, ShapeRole::scenery});
            drawing.shapes.push_back(Segment{all[rod.from].at(q), end, 2});
        }
        if (isAlone && rods.empty()) drawing.shapes.push_back(Disc{{0, 0, 0}, 2, ShapeRole::scenery});
        for (const TypedBody& body : all) {
            const Point at = body.at(q);
            if (isAlone && body.y < 0 && !body.isPolar()) drawing.shapes.push_back(Segment{{0, 0, 0}, at, 2});
            drawing.shapes.push_back(Disc{at, all.size() > few ? smallDisc : largeDisc});
        }
        drawing.tracer = (rods.empty() ? all.front() : all.back()).at(q);
    };
    return picture;
}

Picture point(std::size_t d) {
    return {[d](const double* q, Drawing& drawing) {
        const Point at{q[0], d > 1 ? q[1] : 0, 0};
        drawing.shapes.push_back(Disc{{0, 0, 0}, 2, ShapeRole::scenery});
        if (d == 1) drawing.shapes.push_back(Segment{{0, 0, 0}, at, 2});
        drawing.shapes.push_back(Disc{at, largeDisc});
        drawing.tracer = at;
    }};
}

}  // namespace

Picture pictureOf(const Formula& formula, const Constraint* constraint) {
    const std::vector<std::string>& names = formula.coordinates;
    std::vector<int> angles;
    int cart = -1;
    bool isChain = true;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string letter = split(names[i]).letter;
        if (isAngle(letter))
            angles.push_back(static_cast<int>(i));
        else if (letter == "x" && cart < 0)
            cart = static_cast<int>(i);
        else
            isChain = false;
    }
    if (isChain && !angles.empty()) return chain(formula, cart, angles);
    if (const auto found = bodiesOf(names)) return bodies(*found, rodsOf(constraint, *found, names.size()));
    // Where others come after them, the first two may still say what they are: r and theta are no lengths
    // along two axes.
    if (names.size() > 2)
        if (const auto found = bodiesOf({names[0], names[1]}); found && found->size() == 1)
            return bodies(*found, {});
    if (names.size() <= 2 || !angles.empty()) return point(names.size());
    std::vector<TypedBody> beads;
    for (std::size_t i = 0; i < names.size(); ++i)
        beads.push_back({.label = names[i], .x = static_cast<int>(i)});
    return bodies(beads, {});
}

std::vector<std::pair<int, int>> planesOf(const Formula& formula) {
    std::vector<std::pair<int, int>> planes;
    if (const auto found = bodiesOf(formula.coordinates))
        for (const TypedBody& body : *found)
            if (body.x >= 0 && body.y >= 0 && body.z < 0) planes.emplace_back(body.x, body.y);
    return planes;
}

}  // namespace extremal::typed
