// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/run.hpp"

#include <atomic>
#include <future>
#include <stdexcept>
#include <stop_token>

#include "engine/core/text/text.hpp"
#include "engine/run/cases/many_run.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/single_scheme.hpp"
#include "library/data.hpp"

namespace extremal::api {
namespace {

const Column& columnOf(const extremal::SchemeResult& result, std::string_view name) {
    if (const Column* const column = result.trajectory.find(name)) return *column;
    std::vector<std::string> names;
    for (const Column& column : result.trajectory.columns) names.push_back(column.name);
    throw std::out_of_range(result.summary.label + " has no column \"" + std::string(name) + "\" (it has " +
                            joinNames(names) + ")");
}

const FieldFrames* framesOf(const extremal::SchemeResult& result) {
    return result.products.find<FieldFrames>();
}

const System* systemOf(const SchemeResult::Data& data) {
    const auto& own = data.result->scheme ? data.result->scheme->ownSystem : nullptr;
    return own ? own.get() : data.comparison->system.get();
}

SchemeResult handleOf(std::shared_ptr<const extremal::Comparison> comparison, std::size_t index) {
    SchemeResult::Data data{comparison->schemes[index], comparison, {}, {}};
    for (const Column& column : data.result->trajectory.columns) data.columns.push_back(column.name);
    if (const System* const system = systemOf(data); system && system->field && framesOf(*data.result)) {
        const FieldSampling& field = system->field;
        for (std::size_t j = 0; j < std::max<std::size_t>(1, field.y.size()); ++j)
            data.x.insert(data.x.end(), field.x.begin(), field.x.end());
    }
    return SchemeResult(std::make_shared<const SchemeResult::Data>(std::move(data)));
}

/// Repeating short runs for their times would make thousands of them many times as long.
RunOptions optionsWith(unsigned threads) {
    RunOptions options;
    options.threads = threads;
    options.isTimed = false;
    return options;
}

Comparison latestOf(const extremal::Run& run) {
    return Comparison(std::make_shared<const Comparison::Data>(
        Comparison::Data{std::make_shared<const extremal::Comparison>(run.latest())}));
}

}  // namespace

SchemeResult::SchemeResult(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const std::string& SchemeResult::label() const { return data_->result->spec.label; }
std::string SchemeResult::status() const { return name(data_->result->summary.status); }
std::string SchemeResult::cause() const {
    const Outcome cause = data_->result->summary.cause;
    return cause == Outcome::converged ? "" : std::string(name(cause));
}
Value SchemeResult::summary() const {
    const Value document = summaryValue(*data_->comparison);
    for (const Value& row : document.find("schemes")->asArray())
        if (row.find("label")->asString() == label()) return row;
    return {};
}
const std::vector<std::string>& SchemeResult::columns() const { return data_->columns; }
std::span<const double> SchemeResult::operator[](std::string_view column) const {
    return columnOf(*data_->result, column).values;
}
const std::string& SchemeResult::unit(std::string_view column) const {
    return columnOf(*data_->result, column).unit;
}
std::size_t SchemeResult::rows() const { return data_->result->trajectory.rows(); }

std::vector<std::string> SchemeResult::components() const {
    const System* const system = systemOf(*data_);
    return system && framesOf(*data_->result) ? system->field.components : std::vector<std::string>();
}
std::size_t SchemeResult::frames() const {
    const FieldFrames* const frames = framesOf(*data_->result);
    return frames ? frames->all.size() : 0;
}
Frame SchemeResult::frame(std::size_t index) const {
    if (index >= frames())
        throw std::out_of_range(label() + " has " + std::to_string(frames()) + " frames, not one of number " +
                                std::to_string(index));
    const FieldSampling& field = systemOf(*data_)->field;
    const extremal::Frame& frame = framesOf(*data_->result)->all[index];
    const std::span<const double> values(*frame.values);
    const std::span<const double> x = field.hasMovingNodes ? field.nodesOf(*frame.values) : data_->x;
    return {frame.t, x, values.first(field.places() * field.components.size())};
}

Comparison::Comparison(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::size_t Comparison::size() const { return data_->comparison->schemes.size(); }
SchemeResult Comparison::operator[](std::size_t scheme) const {
    if (scheme >= size())
        throw std::out_of_range("the comparison has " + std::to_string(size()) +
                                " schemes, not one of number " + std::to_string(scheme));
    return handleOf(data_->comparison, scheme);
}
SchemeResult Comparison::operator[](std::string_view label) const {
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < size(); ++i) {
        labels.push_back(data_->comparison->schemes[i]->spec.label);
        if (labels.back() == label) return handleOf(data_->comparison, i);
    }
    throw std::out_of_range("there is no scheme \"" + std::string(label) + "\" (there is " +
                            joinNames(labels) + ")");
}
bool Comparison::isFinished() const { return data_->comparison->isFinished; }
Value Comparison::summary() const { return summaryValue(*data_->comparison); }
std::vector<std::string> Comparison::write(const std::string& folder) const {
    try {
        prepareFolder(folder);
        return exportComparison(*data_->comparison, folder);
    } catch (const ExportError& e) {
        throw std::runtime_error(e.path.string() + " cannot be written: " + e.what());
    }
}

struct Run::Data {
    extremal::Run run;
};

Run::Run(const Scene& scene, unsigned threads)
    : data_(new Data{extremal::Run(ResolvedScene(*scene.data().read.resolved), optionsWith(threads))}) {}
Run::~Run() = default;

void Run::start() { data_->run.start(); }
void Run::stop() { data_->run.stop(); }
void Run::wait() { data_->run.wait(); }
bool Run::isFinished() const { return data_->run.isFinished(); }
double Run::fraction() const { return data_->run.fraction(); }
Comparison Run::latest() const { return latestOf(data_->run); }

Comparison run(const Scene& scene, unsigned threads, const Progress& progress) {
    extremal::Run work(ResolvedScene(*scene.data().read.resolved), optionsWith(threads));
    work.start();
    if (!watch([&](auto time) { return work.waitFor(time); }, [&] { return work.fraction(); }, progress))
        work.stop();
    work.wait();
    return latestOf(work);
}

Motions runMany(const Scene& scene, std::span<const double> starts, std::string_view scheme, unsigned threads,
                const Progress& progress) {
    const ResolvedScene& resolved = *scene.data().read.resolved;
    const std::size_t index = schemeNamed(resolved, std::string(scheme));
    const System& system = *extremal::systemOf(resolved, resolved.schemes[index]);
    Motions result;
    for (const Quantity& column : stateColumns(system)) result.columns.push_back(column.name);
    const std::size_t width = result.columns.size();
    if (width == 0)
        throw InvalidScene("/starts", "the state of " + system.id + " is a field, which has no columns",
                           "models with coordinates, and rigid bodies");
    if (starts.size() % width != 0)
        throw InvalidScene("/starts",
                           "must be whole states of " + std::to_string(width) + " numbers, got " +
                               std::to_string(starts.size()) + " numbers",
                           joinNames(result.columns));
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < starts.size(); i += width)
        all.emplace_back(starts.begin() + static_cast<std::ptrdiff_t>(i),
                         starts.begin() + static_cast<std::ptrdiff_t>(i + width));
    std::atomic<std::size_t> done{0};
    ManyOptions options{threads, true, [&done](std::size_t now) { done = now; }};
    std::stop_source stop;
    auto work = std::async(std::launch::async, [&] {
        return extremal::runMany(resolved, index, all, options, stop.get_token());
    });
    const auto fraction = [&] {
        return all.empty() ? 1 : static_cast<double>(done) / static_cast<double>(all.size());
    };
    if (!watch([&](auto time) { return work.wait_for(time) == std::future_status::ready; }, fraction,
               progress))
        stop.request_stop();
    ManyMotions motions = work.get();
    result.together = motions.together;
    for (std::size_t i = 0; i < all.size(); ++i) {
        ManyMotions::Motion& motion = motions.all[i];
        if (motion.x.empty()) motion.x = all[i];  // stopped before it began
        result.states.insert(result.states.end(), motion.x.begin(), motion.x.end());
        result.causes.emplace_back(name(motion.outcome));
        result.steps.push_back(motion.steps);
        result.t.push_back(motion.steps > 0 ? motion.t : resolved.scene.start.value);
        result.energyError.push_back(motion.energyError);
    }
    return result;
}

}  // namespace extremal::api
