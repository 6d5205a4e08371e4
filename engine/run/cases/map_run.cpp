// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/cases/map_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/problem.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/state_values.hpp"
#include "engine/run/reference/map_reference.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/overrides.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

using Cells = std::vector<MapCell>;

/// What was computed before, by all that it depends on.
class MapMemory {
public:
    std::optional<Cells> find(const std::string& key) const {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    void keep(const std::string& key, const Cells& cells) {
        constexpr std::size_t most = 4000;
        const std::lock_guard lock(mutex_);
        if (known_.size() >= most) known_.clear();
        known_[key] = cells;
    }

private:
    mutable std::mutex mutex_;
    std::map<std::string, Cells> known_;
};

MapMemory& mapMemory() {
    static MapMemory memory;
    return memory;
}

/// The scene of a column: the parameter changed, the time of a case, the schemes that have a map.
Value columnDocument(const Scene& scene, const MapGrid& grid, double value) {
    Value document = toValue(scene), mapped{Value::Array{}};
    std::vector<Change> changes;
    std::vector<Problem> errors;
    applyOverride(document, {grid.pointer, value}, changes, errors);
    for (const std::size_t i : mappedSchemes(scene)) {
        // Where the scheme's own step would be refused, others may do: seeing them fail is what a map is for.
        Value& scheme = mapped.asArray().emplace_back(document.find("schemes")->asArray()[i]);
        scheme.set("step", grid.steps.front());
        scheme.set("allow_unstable", true);
    }
    document.set("schemes", mapped);
    document.set("views", Value::Array{});
    document.set("observe", Value::Array{});
    document.set("time", Value(Value::Object{{"start", scene.start.value},
                                             {"end", scene.start.value + grid.duration}}));
    auto& members = document.asObject();
    std::erase_if(members, [](const Value::Member& m) {
        return m.first == "output" || m.first == "title" || m.first == "source" || m.first == "lesson" ||
               m.first == "notes";
    });
    return document;
}

/// All that the cells of one scheme in a column depend on; a file may change all the same.
std::string keyOf(Value document, const MapGrid& grid, std::size_t scheme) {
    Value own = document.find("schemes")->asArray()[scheme], steps{Value::Array{}};
    for (const char* key : {"label", "step", "style"}) own.set(key, nullptr);
    for (const double step : grid.steps) steps.asArray().emplace_back(step);
    document.set("schemes", Value::Array{own, steps, grid.column});
    return writeCompactJson(document);
}

double sizeOf(const double* x, std::size_t n) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i] * x[i];
    if (isSafeSquare(sum)) return std::sqrt(sum);
    return scaledDistance(n, x, std::vector<double>(n).data());
}

/// A column being computed: one value of the parameter.
struct MapColumn {
    const ResolvedScene& resolved;
    const MapGrid& grid;
    const ObservableEntry& observable;
    const std::stop_token& stop;
    MapReference reference;

    MapColumn(const ResolvedScene& scene, const MapGrid& grid_, const ObservableEntry& observable_,
              const std::stop_token& stop_)
        : resolved(scene), grid(grid_), observable(observable_), stop(stop_) {
        if (observable.needsReference) reference = MapReference(resolved, grid.steps, stop);
    }

    MapCell cell(const ResolvedScheme& scheme, std::size_t row) const {
        try {
            return contained("", [&] { return runCell(scheme, row); });
        } catch (const InvalidScene&) {
            return {MapCell::End::refused};
        }
    }

    MapCell runCell(const ResolvedScheme& scheme, std::size_t row) const {
        const double step = grid.steps[row];
        const System& system = *systemOf(resolved, scheme);
        const Scene& scene = resolved.scene;
        const State start = schemeStart(resolved, scheme, step);
        const auto integrator = scheme.make(system, step, start);
        const ExactSolution exact =
            observable.needsReference ? reference.at(row, resolved, scheme) : ExactSolution{};
        const Observer observer =
            observable.bind({system, start, exact, scheme.plain(), step, integrator->quantities()});
        const auto found = std::find_if(observer.columns.begin(), observer.columns.end(),
                                        [&](const Column& c) { return c.name == grid.column; });
        if (found == observer.columns.end()) return {MapCell::End::refused};
        const std::size_t width = observer.columns.size(), size = start.x.size();
        const double limit = 1e6 * sizeOf(start.x.data(), size);

        std::vector<double> values;
        MapCell result;
        result.end = MapCell::End::done;
        // Without a reference an error stays unknown; a state that grows is seen all the same.
        const bool isKnown = !observable.needsReference || exact;
        const StateValues stateValues(observable, observer, system, start);
        const auto soundNodes = [&](const NodeBlock& nodes) {
            values.resize(std::max(values.size(), width * nodes.capacity()),
                          std::numeric_limits<double>::quiet_NaN());
            if (!isKnown) return nodes.size();
            observer.evaluate(nodes, values.data(), width);
            return stateValues.finiteNodes(nodes, values.data(), width);
        };
        const auto measure = [&](const Stretch& stretch) {
            const NodeBlock& nodes = stretch.nodes;
            const double* column = values.data() + (found - observer.columns.begin());
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const double value = std::abs(column[i * width]);
                if (std::isfinite(value) && !(value <= result.value)) result.value = value;
                if (limit > 0 && sizeOf(nodes.x(i), size) > limit) result.end = MapCell::End::blownUp;
            }
            return result.isDone();
        };
        const MarchSink sink{measure, false, observer.readsQuantities, soundNodes};
        State state = start;
        const MarchGrid nodesOfTime = marchGrid(scene, scheme, step);
        const Outcome outcome = march(*integrator, state, nodesOfTime, {&sink, 1}, stop).outcome;
        if (outcome == Outcome::stopped) return {};
        if (outcome != Outcome::converged && result.isDone()) return {MapCell::End::failed, outcome};
        return result.isDone() ? result : MapCell{result.end};
    }
};

const ObservableEntry* observableOf(const ResolvedScene& resolved, const std::string& column) {
    for (const ObservedColumn& each : observableColumns(resolved.scene, *resolved.system))
        if (each.name == column) return findObservable(each.observable);
    return nullptr;
}

}  // namespace

MapRun::MapRun(const Scene& scene) : scene_(scene) {
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
        const View& view = scene.views[v];
        if (view.id != mapView || view.keys.keys.empty()) continue;
        const MapGrid grid = mapGridOf(scene, view);
        const std::size_t first = maps_.size();
        for (const std::size_t i : mappedSchemes(scene))
            maps_.push_back({v, scene.schemes[i].label, styleOf(scene.schemes[i], i), grid,
                             std::vector<std::string>(grid.values.size()),
                             Cells(grid.values.size() * grid.steps.size())});
        if (maps_.size() == first) continue;
        for (std::size_t c = 0; c < grid.values.size(); ++c) tasks_.push_back({first, c});
    }
    for (const ParameterMap& map : maps_) all_ += map.cells.size();
}

void MapRun::run(std::size_t task, const std::stop_token& stop) {
    const std::size_t first = tasks_[task].firstMap, column = tasks_[task].column;
    const MapGrid& grid = maps_[first].grid;
    const std::size_t rows = grid.steps.size(), schemes = mappedSchemes(scene_).size();
    const auto publish = [&](std::size_t s, const Cells& cells) {
        const std::lock_guard lock(mutex_);
        std::copy(cells.begin(), cells.end(),
                  maps_[first + s].cells.begin() + static_cast<std::ptrdiff_t>(column * rows));
        for (const MapCell& cell : cells) done_ += cell.end != MapCell::End::waiting;
    };
    const Value document = columnDocument(scene_, grid, grid.values[column]);
    std::vector<std::size_t> unknown;
    for (std::size_t s = 0; s < schemes; ++s) {
        if (const auto known = mapMemory().find(keyOf(document, grid, s)))
            publish(s, *known);
        else
            unknown.push_back(s);
    }
    if (unknown.empty() || stop.stop_requested()) return;

    const auto refuse = [&](const std::vector<Problem>& problems) {
        for (const std::size_t s : unknown) publish(s, Cells(rows, MapCell{MapCell::End::refused}));
        if (problems.empty()) return;
        const std::lock_guard lock(mutex_);
        for (const std::size_t s : unknown)
            maps_[first + s].problems[column] = problems.front().pointer + " " + problems.front().message;
    };
    const ReadScene read = readScene(document);
    if (!read.resolved) return refuse(read.errors);
    try {
        contained("", [&] {
            const ObservableEntry* observable = observableOf(*read.resolved, grid.column);
            if (!observable) return refuse({});
            const MapColumn computed(*read.resolved, grid, *observable, stop);
            for (; !unknown.empty(); unknown.erase(unknown.begin())) {  // what is left, `refuse` refuses
                const std::size_t s = unknown.front();
                Cells cells(rows);
                for (std::size_t r = 0; r < rows && !stop.stop_requested(); ++r)
                    cells[r] = computed.cell(read.resolved->schemes[s], r);
                const bool isWhole = std::none_of(cells.begin(), cells.end(), [](const MapCell& c) {
                    return c.end == MapCell::End::waiting;
                });
                if (isWhole && scene_.reference.kind != ReferenceSpec::Kind::file)
                    mapMemory().keep(keyOf(document, grid, s), cells);
                publish(s, cells);
            }
        });
    } catch (const InvalidScene& e) {
        refuse(e.problems());
    }
}

std::vector<std::shared_ptr<const ParameterMap>> MapRun::latest() const {
    std::vector<std::shared_ptr<const ParameterMap>> all;
    const std::lock_guard lock(mutex_);
    for (const ParameterMap& map : maps_) all.push_back(std::make_shared<const ParameterMap>(map));
    return all;
}

double MapRun::fraction() const {
    const std::lock_guard lock(mutex_);
    return all_ > 0 ? static_cast<double>(done_) / static_cast<double>(all_) : 1;
}

}  // namespace extremal
