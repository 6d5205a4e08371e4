// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/membrane/membrane_system.hpp"

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/algebra/quiet_math.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

using SharedMembrane = std::shared_ptr<const MembraneProblem>;

/// u = amplitude J_m(j r) cos(m phi) cos(j (t - start)) with the n-th zero j of J_m: of a linear membrane
/// with a fixed rim, which starts at rest.
struct Mode {
    int m = 0;
    double amplitude = 0, frequency = 0;

    double shape(const std::array<double, 2>& at) const {
        const double r = std::hypot(at[0], at[1]);
        return amplitude * boost::math::cyl_bessel_j(m, frequency * r, quiet) *
               std::cos(m * std::atan2(at[1], at[0]));
    }
};

/// None where the initial data are expressions.
std::optional<Mode> modeOf(const Settings& initial, const MembraneProblem& problem) {
    const Value* const given = initial.find("mode");
    if (!given) return {};
    if (initial.find("displacement") || initial.find("velocity"))
        throw InvalidScene("/mode", "a mode starts at rest and gives the displacement", "keep one of them");
    if (!problem.isRimFixed || problem.material != MembraneProblem::Material::linear)
        throw InvalidScene("/mode", "modes are those of a linear membrane with a fixed rim",
                           "\"displacement\": \"1 - x^2 - y^2\"");
    const auto isWhole = [](const Value& v, double least) {
        return v.isNumber() && v.asNumber() == std::floor(v.asNumber()) && v.asNumber() >= least &&
               v.asNumber() <= 50;
    };
    if (!given->isArray() || given->asArray().size() != 2 || !isWhole(given->asArray()[0], 0) ||
        !isWhole(given->asArray()[1], 1))
        throw InvalidScene(
            "/mode", "must be [m, n]: m diameters from 0 to 50, n circles from 1 to 50 that stay at rest",
            "[0, 1]");
    Mode mode;
    mode.m = static_cast<int>(given->asArray()[0].asNumber());
    mode.frequency = boost::math::cyl_bessel_j_zero(static_cast<double>(mode.m),
                                                    static_cast<int>(given->asArray()[1].asNumber()));
    mode.amplitude = initial.find("amplitude") ? initial.number("amplitude") : 0.1;
    return mode;
}

std::vector<double> typedAtNodes(const Settings& initial, const char* key, const MembraneProblem& problem) {
    std::vector<double> values(problem.mesh.nodes.size(), 0);
    const Value* const given = initial.find(key);
    if (!given) return values;
    const std::string pointer = std::string("/") + key;
    if (given->isArray()) return valuesAtNodes(*given, pointer, values.size());
    const std::string text = given->isString()   ? given->asString()
                             : given->isNumber() ? formatNumber(given->asNumber())
                                                 : "";
    if (text.empty())
        throw InvalidScene(pointer, "must be an expression in x and y, or a list of values at the nodes");
    const typed::TypedFunction f(text, pointer, {"x", "y"}, {});
    for (std::size_t a = 0; a < values.size(); ++a) values[a] = f(problem.mesh.nodes[a].data());
    return values;
}

std::vector<double> startOf(const Settings& initial, const MembraneProblem& problem) {
    const std::size_t n = problem.mesh.nodes.size();
    std::vector<double> x(2 * n, 0);
    if (const auto mode = modeOf(initial, problem)) {
        for (std::size_t a = 0; a < n; ++a) x[a] = mode->shape(problem.mesh.nodes[a]);
    } else {
        const std::vector<double> u = typedAtNodes(initial, "displacement", problem),
                                  v = typedAtNodes(initial, "velocity", problem);
        std::copy(u.begin(), u.end(), x.begin());
        std::copy(v.begin(), v.end(), x.begin() + static_cast<std::ptrdiff_t>(n));
    }
    for (int a = 0; a < problem.size(); ++a)
        if (problem.isFixed(a)) x[n + static_cast<std::size_t>(a)] = 0;
    return x;
}

/// u and u_t along the diameter y = 0, from left to right, and behind them u and u_t at all nodes.
FieldSampling samplingOf(const SharedMembrane& problem) {
    const TriangleMesh& mesh = problem->mesh;
    std::vector<std::size_t> along;
    for (int k = mesh.rings - 1; k >= 0; --k)
        along.push_back(static_cast<std::size_t>(mesh.node(k, mesh.sectors / 2)));
    along.push_back(0);
    for (int k = 0; k < mesh.rings; ++k) along.push_back(static_cast<std::size_t>(mesh.node(k, 0)));
    FieldSampling f;
    for (const std::size_t a : along) f.x.push_back(mesh.nodes[a][0]);
    f.components = {"u", "u_t"};
    f.further = 2 * mesh.nodes.size();
    f.furtherNodes = mesh.nodes;
    f.sample = [along, n = mesh.nodes.size()](const double* x, double* values) {
        for (const std::size_t a : along) *values++ = x[a];
        for (const std::size_t a : along) *values++ = x[n + a];
        std::copy_n(x, 2 * n, values);
    };
    f.isHeld = [problem](std::size_t a) { return problem->isFixed(static_cast<int>(a)); };
    f.initial = [n = mesh.nodes.size(), first = 2 * along.size()](std::span<const double> values) {
        return componentValues({"displacement", "velocity"}, values.subspan(first), n);
    };
    return f;
}

/// Rings and spokes of the mesh, u upwards; few enough of them to be seen.
void drawMembrane(const MembraneProblem& problem, double unit, const double* values, Drawing& drawing) {
    constexpr int mostLines = 24;
    const TriangleMesh& mesh = problem.mesh;
    drawing.tracer = {0, 0, 0};
    if (drawing.isTracerOnly) return;
    const double* const u = values + 2 * (2 * mesh.rings + 1);
    const auto at = [&](int node, bool isFlat) {
        const auto a = static_cast<std::size_t>(node);
        return Point{mesh.nodes[a][0], isFlat ? 0 : unit * u[a], mesh.nodes[a][1]};
    };
    const auto ring = [&](int k, bool isFlat) {
        Curve curve;
        for (int j = 0; j <= mesh.sectors; ++j) curve.points.push_back(at(mesh.node(k, j), isFlat));
        return curve;
    };
    drawing.shapes.push_back(ring(mesh.rings - 1, true));
    const int everyRing = (mesh.rings + mostLines - 1) / mostLines,
              everySpoke = (mesh.sectors + mostLines - 1) / mostLines;
    for (int k = mesh.rings - 1; k >= 0; k -= everyRing) {
        Curve curve = ring(k, false);
        curve.role = ShapeRole::body;
        drawing.shapes.push_back(std::move(curve));
    }
    for (int j = 0; j < mesh.sectors; j += everySpoke) {
        Curve curve;
        curve.role = ShapeRole::body;
        curve.points.push_back(at(0, false));
        for (int k = 0; k < mesh.rings; ++k) curve.points.push_back(at(mesh.node(k, j), false));
        drawing.shapes.push_back(std::move(curve));
    }
}

}  // namespace

System makeMembraneSystem(SharedMembrane problem, double amplitude) {
    System s;
    s.parts.set(Membrane{problem});
    const auto n = problem->mesh.nodes.size();
    s.energy = [problem, n](double, const double* x) { return problem->energy(x, x + n); };
    s.error.columns = {{"error", "", "‖u - u_ref‖", ""}};
    s.error.evaluate = [problem](const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t a = 0; a < problem->mass.size(); ++a)
            sum += problem->mass[a] * (x[a] - reference[a]) * (x[a] - reference[a]);
        values[0] = std::sqrt(sum);
    };
    if (!problem->isRimFixed)
        s.momenta = {{"field", "∫u_t", "", [problem, n](const double* x, const double*) {
                          double sum = 0;
                          for (std::size_t a = 0; a < n; ++a) sum += problem->mass[a] * x[n + a];
                          return sum;
                      }}};
    s.start = [problem](const Settings& initial, double) { return startOf(initial, *problem); };
    s.exactFrom = [problem, n](const Settings& initial, const State& start) -> ExactSolution {
        const auto mode = modeOf(initial, *problem);
        if (!mode) return {};
        std::vector<double> shape;
        for (const auto& node : problem->mesh.nodes) shape.push_back(mode->shape(node));
        return [shape, n, w = mode->frequency, begin = start.t](double t, std::span<double> x) {
            const double c = std::cos(w * (t - begin)), d = -w * std::sin(w * (t - begin));
            for (std::size_t a = 0; a < n; ++a) {
                x[a] = c * shape[a];
                x[n + a] = d * shape[a];
            }
        };
    };
    s.field = samplingOf(problem);
    s.elementAxis = "r";
    s.isSpatial = true;
    s.draw = [problem, unit = 0.5 / amplitude](const double* values, Drawing& drawing) {
        drawMembrane(*problem, unit, values, drawing);
    };
    return s;
}

std::vector<FieldInfo> membraneStartFields() {
    FieldInfo amplitude = numberField("amplitude", "amplitude", "", 0.1, "Of a mode.");
    amplitude.fallback = nullptr;
    amplitude.isOptional = true;
    return {optionalJsonField("displacement", "displacement",
                              "u at the start, an expression in x and y, or values at the nodes."),
            optionalJsonField("velocity", "velocity", "u_t at the start, likewise; default 0."),
            optionalJsonField(
                "mode", "mode",
                "[m, n] in place of them: the mode with m diameters and n circles at rest, the rim among "
                "them, of a linear membrane with a fixed rim."),
            amplitude};
}

}  // namespace extremal
