#include "engine/run/map_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/bind.hpp"
#include "engine/scene/two_positions.hpp"

namespace extremal {

MapReference::MapReference(const Scene& scene, const System& system, const State& initial,
                           const std::vector<double>& steps, const std::stop_token& stop) {
    constexpr double mostNumbers = 2e7;
    double nodes = 0;
    for (const double step : steps) nodes += (scene.end.value - scene.start.value) / step + 1;
    const bool isSmall = nodes * static_cast<double>(initial.x.size()) <= mostNumbers;
    const auto& spec = scene.reference.scheme;
    if (scene.reference.kind == ReferenceSpec::Kind::scheme && !isAdaptive(spec.front()) && isSmall) {
        runScheme(scene, system, initial, steps, stop);
        return;
    }
    reference_ = makeReference(scene, system, initial, stop);
    if (reference_.make && reference_.info.type != "exact" && isSmall)
        askSolution(scene, initial, steps, stop);
}

void MapReference::runScheme(const Scene& scene, const System& system, const State& initial,
                             const std::vector<double>& steps, const std::stop_token& stop) {
    const SchemeSpec& spec = scene.reference.scheme.front();
    for (const double step : steps) {
        if (stop.stop_requested()) return;
        const auto nodes = static_cast<std::size_t>(stepCount(scene.start.value, scene.end.value, step)) + 1;
        const double parts = std::max(1.0, std::ceil(step / spec.step.value - 1e-9)), part = step / parts;
        State state = schemeStart(scene, system, spec, part, initial);
        const std::size_t width = state.x.size();
        auto table = std::make_shared<Table>(Table{initial.t, step, width, state.x});
        const auto integrator = makeScheme(system, spec, part, state, scene.end.value);
        integrator->setStop(stop);
        bool isKnown = true;
        for (std::size_t k = 1; k < nodes && isKnown; ++k) {
            for (double i = 0; i < parts && isKnown; ++i)
                isKnown = integrator->advance(state).outcome == Outcome::converged;
            table->states.insert(table->states.end(), state.x.begin(), state.x.end());
        }
        if (!isKnown) table->states.assign(nodes * width, std::numeric_limits<double>::quiet_NaN());
        tables_.push_back(std::move(table));
    }
}

void MapReference::askSolution(const Scene& scene, const State& initial, const std::vector<double>& steps,
                               const std::stop_token& stop) {
    struct Node {
        double t;
        double* x;
    };
    std::vector<Node> all;
    const std::size_t width = initial.x.size();
    for (const double step : steps) {
        const auto count = static_cast<std::size_t>(stepCount(scene.start.value, scene.end.value, step)) + 1;
        auto table =
            std::make_shared<Table>(Table{initial.t, step, width, std::vector<double>(count * width)});
        for (std::size_t k = 0; k < count; ++k)
            all.push_back(
                {Clock{initial.t, step}.at(static_cast<long long>(k)), table->states.data() + k * width});
        tables_.push_back(std::move(table));
    }
    std::stable_sort(all.begin(), all.end(), [](const Node& a, const Node& b) { return a.t < b.t; });
    const ExactSolution solution = reference_.make();
    for (const Node& node : all) {
        if (stop.stop_requested()) return;
        solution(node.t, {node.x, width});
    }
}

ExactSolution MapReference::at(std::size_t row) const {
    if (row >= tables_.size()) return reference_.make ? reference_.make() : ExactSolution{};
    return [table = tables_[row]](double t, std::span<double> x) {
        const auto node = static_cast<std::size_t>(std::llround((t - table->start) / table->step));
        const auto from = table->states.begin() + static_cast<std::ptrdiff_t>(node * table->width);
        std::copy_n(from, table->width, x.begin());
    };
}

}  // namespace extremal
