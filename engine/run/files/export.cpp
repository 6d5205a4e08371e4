// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/export.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "engine/core/known_value.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/potential_levels.hpp"
#include "engine/run/files/event_files.hpp"
#include "engine/run/files/file_batch.hpp"
#include "engine/run/files/ring_files.hpp"
#include "engine/run/files/starts_files.hpp"
#include "engine/run/missing.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

constexpr const char* referenceCopy = "reference.csv";

/// Appends the columns row by row, from the start of the run on, handing the text over in blocks so that no
/// whole file is held in memory.
template <class Sink>
void writeRows(const Trajectory& trajectory, Sink&& sink) {
    constexpr std::size_t blockSize = 1 << 16;
    std::string block;
    for (std::size_t c = 0; c < trajectory.columns.size(); ++c) {
        if (c > 0) block += ',';
        block += csvCell(c == 0 ? trajectory.columns[c].symbol : trajectory.columns[c].name);
    }
    block += '\n';
    const std::size_t rows = trajectory.rows();
    const std::vector<double>& nodes = trajectory.nodes;
    const bool isBackwards = rows > 1 && nodes.size() == rows && nodes.front() > nodes.back();
    for (std::size_t i = 0; i < rows; ++i) {
        const std::size_t r = isBackwards ? rows - 1 - i : i;
        for (std::size_t c = 0; c < trajectory.columns.size(); ++c) {
            if (c > 0) block += ',';
            const double value = trajectory.columns[c].values[r];
            const auto& words = trajectory.columns[c].words;
            if (!std::isfinite(value)) continue;
            if (words.empty())
                block += formatNumber(value);
            else if (value >= 0 && value < static_cast<double>(words.size()))
                block += words[static_cast<std::size_t>(value)];
        }
        block += '\n';
        if (block.size() > blockSize) {
            sink(block);
            block.clear();
        }
    }
    sink(block);
}

/// The row of summary.csv as keys and values; null is an empty cell.
Value summaryRow(const Summary& s) {
    Value row{Value::Object{}};
    row.set("label", s.label);
    row.set("status", name(s.status));
    row.set("cause", knownText(name(s.cause)));
    row.set("failed_at", knownNumber(s.failedAt));
    row.set("t_end", knownNumber(s.tEnd));
    row.set("steps", static_cast<double>(s.steps));
    row.set("rejected", static_cast<double>(s.cost.rejected));
    row.set("newton_iterations", static_cast<double>(s.cost.iterations));
    row.set("evaluations", static_cast<double>(s.cost.evaluations));
    row.set("linear_solves", static_cast<double>(s.cost.linearSolves));
    row.set("cpu_seconds", knownNumber(s.cpuSeconds));
    row.set("max_energy_error", knownNumber(s.maxEnergyError));
    row.set("energy_drift_per_unit_time", knownNumber(s.energyDrift));
    row.set("max_momentum_error", knownNumber(s.maxMomentumError));
    row.set("max_norm_error", knownNumber(s.maxNormError));
    row.set("max_error", knownNumber(s.maxError));
    row.set("final_error", knownNumber(s.finalError));
    row.set("order_claimed", knownNumber(s.orderClaimed > 0 ? s.orderClaimed : Summary::unknown));
    row.set("order_measured", knownNumber(s.orderMeasured));
    row.set("error_bar_opens_at", knownNumber(s.opensAt));
    row.set("max_constraint", knownNumber(s.maxConstraint));
    row.set("impacts", knownNumber(s.impacts));
    row.set("floor", knownNumber(s.floor));
    row.set("floor_of", knownText(s.floorOf));
    return row;
}

std::string cellText(const Value& value) {
    if (value.isNumber()) return formatCount(value.asNumber());
    return value.isString() ? csvCell(value.asString()) : std::string();
}

/// t, the place (x, of a rectangle y too) and the components of the field: a row for each place of each
/// frame. Of a rectangle as many frames, evenly spread, as make half a million rows, which keeps the file
/// below 100 MB.
template <class Sink>
void writeFrames(const FieldSampling& field, const std::vector<Frame>& frames, Sink&& sink) {
    constexpr std::size_t blockSize = 1 << 16, mostRows = 1 << 19;
    std::string block = field.y.empty() ? "t,x" : "t,x,y";
    for (const std::string& name : field.components) block += ',' + csvCell(name);
    block += '\n';
    const std::size_t n = field.places(), columns = field.x.size(),
                      stride = field.y.empty() ? 1 : (frames.size() * n + mostRows - 1) / mostRows;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i % stride != 0 && i + 1 < frames.size()) continue;
        const Frame& frame = frames[i];
        const std::string t = formatNumber(frame.t);
        const std::span<const double> nodes = field.nodesOf(*frame.values);
        for (std::size_t j = 0; j < n; ++j) {
            block.append(t).append(",").append(formatNumber(nodes[j % columns]));
            if (!field.y.empty()) block.append(",").append(formatNumber(field.y[j / columns]));
            for (std::size_t c = 0; c < field.components.size(); ++c)
                addNumber(block, (*frame.values)[c * n + j]);
            block += '\n';
            if (block.size() > blockSize) {
                sink(block);
                block.clear();
            }
        }
    }
    sink(block);
}

/// t, node and x of every node of every frame, where nodes move.
template <class Sink>
void writeNodes(const FieldSampling& field, const std::vector<Frame>& frames, Sink&& sink) {
    std::string block = "t,node,x\n";
    for (const Frame& frame : frames) {
        const std::string t = formatNumber(frame.t);
        const std::span<const double> nodes = field.nodesOf(*frame.values);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            block.append(t)
                .append(",")
                .append(std::to_string(i))
                .append(",")
                .append(formatNumber(nodes[i]) + '\n');
        if (block.size() < 1 << 16) continue;
        sink(block);
        block.clear();
    }
    sink(block);
}

/// "parameter-map.csv", and "parameter-map-2.csv" for further views of the kind.
std::vector<std::pair<std::string, std::vector<const ParameterMap*>>> mapFiles(const Comparison& comparison) {
    std::vector<std::pair<std::string, std::vector<const ParameterMap*>>> files;
    std::size_t last = 0;
    const ParameterMaps* maps = comparison.products.find<ParameterMaps>();
    for (std::size_t i = 0; maps && i < maps->all.size(); ++i) {
        const auto& map = maps->all[i];
        if (files.empty() || map->view != last)
            files.push_back(
                {"parameter-map" + (files.empty() ? "" : "-" + std::to_string(files.size() + 1)) + ".csv",
                 {}});
        files.back().second.push_back(map.get());
        last = map->view;
    }
    return files;
}

std::string mapCsv(const std::vector<const ParameterMap*>& maps) {
    std::string text = "scheme,parameter,step,value,outcome\n";
    for (const ParameterMap* map : maps)
        for (std::size_t i = 0; i < map->grid.values.size(); ++i)
            for (std::size_t j = 0; j < map->grid.steps.size(); ++j) {
                const MapCell& cell = map->at(i, j);
                text.append(csvCell(map->scheme))
                    .append(",")
                    .append(formatNumber(map->grid.values[i]))
                    .append(",");
                text += formatNumber(map->grid.steps[j]);
                addNumber(text, cell.value);
                text.append(",").append(name(cell)).append("\n");
            }
    return text;
}

std::string patternCsv(const KktPattern& pattern) {
    std::string text = "row,column,part\n";
    const auto add = [&](const KktPattern::Entries& entries, const char* part) {
        for (const auto& [row, column] : entries)
            text += std::to_string(row) + "," + std::to_string(column) + "," + part + "\n";
    };
    add(pattern.action, "action");
    add(pattern.continuity, "continuity");
    return text;
}

std::string defectCsv(const ActionDefect& defect) {
    std::string text = "step,defect\n";
    for (std::size_t i = 0; i < defect.h.size(); ++i)
        text.append(formatNumber(defect.h[i]))
            .append(",")
            .append(formatNumber(defect.defect[i]))
            .append("\n");
    return text;
}

template <class Sink>
void writeSteps(const StepRecords& steps, Sink&& sink) {
    std::string text = "k,t,step,discrete_energy,density,outcome\n";
    for (const StepRecord& s : steps.all) {
        text += std::to_string(s.k);
        for (const double value : {s.t, s.step, s.discreteEnergy, s.density}) addNumber(text, value);
        text.append(",").append(s.outcomeText()).append("\n");
        if (text.size() < 1 << 16) continue;
        sink(text);
        text.clear();
    }
    sink(text);
}

std::string elementsCsv(const ElementClocks& clocks) {
    std::string text = "element,x,step,updates,energy\n";
    for (std::size_t e = 0; e < clocks.x.size(); ++e) {
        text += std::to_string(e);
        for (const double value : {clocks.x[e], clocks.step[e], clocks.updates[e], clocks.energy[e]})
            addNumber(text, value);
        text += '\n';
    }
    return text;
}

std::shared_ptr<const System> systemOf(const Comparison& comparison, const SchemeResult& scheme) {
    return scheme.scheme && scheme.scheme->ownSystem ? scheme.scheme->ownSystem : comparison.system;
}

/// The lowest energies of a wave function, where a view of the scene draws them; else empty.
std::vector<double> levelsOf(const Comparison& comparison, const SchemeResult& scheme) {
    const auto system = systemOf(comparison, scheme);
    const auto& views = comparison.scene.views;
    const bool isDrawn =
        std::any_of(views.begin(), views.end(), [](const View& view) { return view.id == "levels"; });
    const PotentialLevels* const levels = isDrawn && system ? system->parts.find<PotentialLevels>() : nullptr;
    if (!levels || !levels->problem.empty()) return {};
    return levels->lowest();
}

std::string levelsCsv(const std::vector<double>& levels) {
    std::string text = "level,energy\n";
    for (std::size_t k = 0; k < levels.size(); ++k) {
        text += std::to_string(k);
        addNumber(text, levels[k]);
        text += '\n';
    }
    return text;
}

/// A file of a folder, and what writes it into a batch that has it open.
struct ExportFile {
    std::string name;
    std::function<void(FileBatch&)> write;
};

/// The products of a scheme, each by its suffix: "<slug>.field.csv", ...
void addProducts(std::vector<ExportFile>& files, const std::string& slug, const SchemeResult& scheme,
                 const std::shared_ptr<const System>& system) {
    if (const FieldFrames* frames = scheme.products.find<FieldFrames>();
        frames && !frames->all.empty() && system) {
        files.push_back({slug + ".field.csv", [frames, system](FileBatch& batch) {
                             writeFrames(system->field, frames->all,
                                         [&](const std::string& block) { batch.append(block); });
                         }});
        if (system->field.hasMovingNodes)
            files.push_back({slug + ".mesh.csv", [frames, system](FileBatch& batch) {
                                 writeNodes(system->field, frames->all,
                                            [&](const std::string& block) { batch.append(block); });
                             }});
    }
    if (const StepRecords* steps = scheme.products.find<StepRecords>())
        files.push_back({slug + ".steps.csv", [steps](FileBatch& batch) {
                             writeSteps(*steps, [&](const std::string& block) { batch.append(block); });
                         }});
    if (const ElementClocks* clocks = scheme.products.find<ElementClocks>())
        files.push_back(
            {slug + ".elements.csv", [clocks](FileBatch& batch) { batch.append(elementsCsv(*clocks)); }});
    if (const Sections* sections = scheme.products.find<Sections>())
        for (std::size_t k = 0; k < sections->all.size(); ++k)
            files.push_back({slug + (k == 0 ? ".section.csv" : ".section-" + std::to_string(k + 1) + ".csv"),
                             [events = &sections->all[k].events](FileBatch& batch) {
                                 writeRows(*events, [&](const std::string& block) { batch.append(block); });
                             }});
    if (const MovedRings* rings = scheme.products.find<MovedRings>(); rings && system)
        files.push_back({slug + ".ring.csv", [rings, system](FileBatch& batch) {
                             writeRings(*rings, *system,
                                        [&](const std::string& block) { batch.append(block); });
                         }});
    if (const FoundEvents* found = scheme.products.find<FoundEvents>())
        files.push_back(
            {slug + ".events.csv", [found](FileBatch& batch) { batch.append(eventsCsv(*found)); }});
    if (const FoundImpacts* found = scheme.products.find<FoundImpacts>())
        files.push_back({slug + ".impacts.csv", [found](FileBatch& batch) {
                             writeRows(found->rows, [&](const std::string& block) { batch.append(block); });
                         }});
    if (const KktPattern* pattern = scheme.products.find<KktPattern>(); pattern && pattern->failure.empty())
        files.push_back(
            {slug + ".kkt.csv", [pattern](FileBatch& batch) { batch.append(patternCsv(*pattern)); }});
    if (const ActionDefect* defect = scheme.products.find<ActionDefect>(); defect && defect->failure.empty())
        files.push_back(
            {slug + ".action-defect.csv", [defect](FileBatch& batch) { batch.append(defectCsv(*defect)); }});
}

/// Whether the folder has a copy of the file that the scene is compared with, so that it can be taken
/// anywhere; not where that file is gone.
bool takesReference(const Scene& scene) {
    std::error_code ignored;
    const std::string& path = scene.reference.path;
    return !path.empty() && std::filesystem::is_regular_file(path, ignored) && std::ifstream(path).good();
}

/// The content of scene.json.
std::string sceneText(const Scene& scene) {
    if (!takesReference(scene)) return writeScene(scene);
    Scene named = scene;
    named.reference.path = referenceCopy;
    return writeScene(named);
}

std::vector<ExportFile> sceneFiles(const Scene& scene) {
    const auto write = [&scene](FileBatch& batch) { batch.append(sceneText(scene)); };
    if (!takesReference(scene)) return {{"scene.json", write}};
    const std::string path = scene.reference.path;
    const auto copy = [path](FileBatch& batch) {
        std::ifstream in(path, std::ios::binary);
        std::string block(1 << 16, '\0');
        while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
            batch.append(block.substr(0, static_cast<std::size_t>(in.gcount())));
    };
    return {{"scene.json", write}, {referenceCopy, copy}};
}

/// All but summary.csv and summary.json.
std::vector<ExportFile> filesOf(const Comparison& comparison) {
    std::vector<ExportFile> files = sceneFiles(comparison.scene);
    const std::vector<std::string> csv = csvNames(comparison);
    for (std::size_t i = 0; i < csv.size(); ++i) {
        const SchemeResult& scheme = *comparison.schemes[i];
        files.push_back({csv[i], [&scheme](FileBatch& batch) {
                             writeRows(scheme.trajectory,
                                       [&](const std::string& block) { batch.append(block); });
                         }});
        const std::string slug = csv[i].substr(0, csv[i].size() - 4);
        addProducts(files, slug, scheme, systemOf(comparison, scheme));
        if (std::vector<double> levels = levelsOf(comparison, scheme); !levels.empty())
            files.push_back({slug + ".levels.csv", [levels = std::move(levels)](FileBatch& batch) {
                                 batch.append(levelsCsv(levels));
                             }});
    }
    for (const auto& [name, set] : startFiles(comparison)) {
        files.push_back({name + ".csv", [set = set](FileBatch& batch) { batch.append(startsCsv(*set)); }});
        files.push_back(
            {name + ".points.csv", [set = set](FileBatch& batch) { batch.append(startPointsCsv(*set)); }});
    }
    for (const auto& [name, maps] : mapFiles(comparison))
        files.push_back({name, [maps = maps](FileBatch& batch) { batch.append(mapCsv(maps)); }});
    return files;
}

}  // namespace

std::string csvCell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted(1, '"');
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted += '"';
    return quoted;
}

void addNumber(std::string& text, double value) {
    text += ',';
    if (std::isfinite(value)) text += formatNumber(value);
}

std::string csvText(const Trajectory& trajectory) {
    std::string text;
    writeRows(trajectory, [&](const std::string& block) { text += block; });
    return text;
}

std::vector<std::string> csvNames(const Comparison& comparison) {
    std::vector<std::string> names;
    for (const auto& scheme : comparison.schemes) names.push_back(scheme->summary.label);
    std::vector<std::string> taken{"summary"};
    if (!comparison.scene.reference.path.empty()) taken.emplace_back("reference");
    for (const auto& [file, set] : startFiles(comparison)) taken.push_back(file);
    for (const auto& [file, maps] : mapFiles(comparison)) taken.push_back(file.substr(0, file.size() - 4));
    names = uniqueSlugs(names, taken);
    for (std::string& n : names) n += ".csv";
    return names;
}

std::string summaryCsv(const Comparison& comparison) {
    std::string text;
    const Value header = summaryRow({});
    for (const auto& [key, value] : header.asObject()) {
        if (!text.empty()) text += ',';
        text += key;
    }
    text += '\n';
    for (const auto& scheme : comparison.schemes) {
        const Value row = summaryRow(scheme->summary);
        for (std::size_t i = 0; i < row.asObject().size(); ++i) {
            if (i > 0) text += ',';
            text += cellText(row.asObject()[i].second);
        }
        text += '\n';
    }
    return text;
}

Value summaryValue(const Comparison& comparison) {
    Value::Array schemes, files;
    for (const auto& scheme : comparison.schemes) {
        Value &row = schemes.emplace_back(summaryRow(scheme->summary)), extremes{Value::Object{}};
        for (const Summary::Extreme& e : scheme->summary.extremes)
            extremes.set(e.column, knownNumber(e.value));
        row.set("extremes", extremes);
        if (const std::vector<Missing> missing = missingFrom(comparison, *scheme); !missing.empty()) {
            Value reasons{Value::Object{}};
            for (const Missing& m : missing) reasons.set(m.observable, m.reason);
            row.set("missing", reasons);
        }
        if (!scheme->summary.caution.empty()) row.set("caution", scheme->summary.caution);
        if (const FoundEvents* found = scheme->products.find<FoundEvents>())
            row.set("events", eventsValue(*found));
        if (const std::vector<double> levels = levelsOf(comparison, *scheme); !levels.empty())
            row.set("levels", Value::Array(levels.begin(), levels.end()));
    }
    for (const ExportFile& file : filesOf(comparison)) files.emplace_back(file.name);
    for (const char* file : {"summary.csv", "summary.json"}) files.emplace_back(file);
    Value reference{Value::Object{}};
    reference.set("type", comparison.reference.type);
    reference.set("estimated_error", knownNumber(comparison.reference.estimatedError));
    if (!comparison.reference.confirmedBy.empty()) {
        reference.set("chosen", comparison.reference.chosen);
        reference.set("confirmed_by", comparison.reference.confirmedBy);
        reference.set("agreed", knownNumber(comparison.reference.agreed));
        reference.set("bound", knownNumber(comparison.reference.bound));
        reference.set("horizon", knownNumber(comparison.reference.horizon));
    }
    Value::Array seen;
    for (const ReferenceInfo::At& pulse : comparison.reference.pulses)
        seen.push_back(Value::Object{{"t", pulse.t}, {"width", pulse.value}});
    if (!seen.empty()) reference.set("seen", std::move(seen));
    if (!comparison.reference.caution.empty()) reference.set("caution", comparison.reference.caution);
    if (!comparison.reference.problems.empty())
        reference.set("problem", comparison.reference.problems.front().message);
    Value summary{Value::Object{}};
    summary.set("extremal", 1);
    summary.set("title", comparison.scene.title);
    summary.set("schemes", schemes);
    summary.set("reference", reference);
    summary.set("files", files);
    // Tells a scene.json that was written by this run from one that was changed since.
    summary.set("scene", fingerprint(sceneText(comparison.scene)));
    return summary;
}

void checkExport(const Scene& scene, const std::filesystem::path& folder, const Replacing& replacing) {
    requireReplaceable(folder / "scene.json", replacing, sceneText(scene));
    std::vector<std::string> labels;
    for (const SchemeSpec& scheme : scene.schemes)
        if (scheme.isEnabled) labels.push_back(scheme.label);
    std::vector<std::string> names{"summary.csv", "summary.json"}, taken{"summary"};
    if (!scene.reference.path.empty()) taken.emplace_back("reference");
    for (const std::string& slug : uniqueSlugs(labels, taken))
        for (const char* ending : {".csv", ".checkpoint"}) names.push_back(slug + ending);
    for (const std::string& name : names) requireReplaceable(folder / name, replacing);
}

std::vector<std::string> exportComparison(const Comparison& comparison, const std::filesystem::path& folder,
                                          const Replacing& replacing) {
    prepareFolder(folder);
    FileBatch batch(folder);
    for (const ExportFile& file : filesOf(comparison)) {
        batch.open(file.name);
        file.write(batch);
        batch.close();
    }
    batch.write("summary.csv", summaryCsv(comparison));
    batch.write("summary.json", writeJson(summaryValue(comparison)));
    return batch.commit(replacing);
}

}  // namespace extremal
