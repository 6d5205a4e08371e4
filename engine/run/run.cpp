// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <stop_token>
#include <thread>
#include <vector>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/pool.hpp"
#include "engine/core/problem.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/cases/map_run.hpp"
#include "engine/run/cases/starts_run.hpp"
#include "engine/run/equations.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/run/scheme_run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

/// One coordinator prepares the reference, then a pool takes the schemes in turn, and after them the starts
/// of views and the columns of maps: each is one task, so results do not depend on the number of threads.
struct Run::Impl {
    ResolvedScene resolved;
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    const State& initial = resolved.initial;
    ProductPlan plan;
    unsigned threads;
    std::vector<std::unique_ptr<SchemeRun>> tasks;
    std::vector<std::unique_ptr<SchemeCheckpoint>> checkpoints;  ///< of the tasks, or none
    MapRun maps;
    StartsRun starts;
    bool needsSchemes = false;  ///< not all results are known
    mutable std::mutex mutex;
    ReferenceInfo reference;  ///< guarded by mutex
    std::atomic<bool> isFinished{false}, isPreparing{false};
    std::condition_variable finished;
    std::jthread coordinator;

    Impl(ResolvedScene r, const RunOptions& options)
        : resolved(std::move(r)), plan(resolved), maps(resolved.scene), starts(resolved) {
        for (const Product product : options.products) plan.add(product);
        plan.isTimed = options.isTimed;
        threads = options.threads;
        for (std::size_t i = 0; i < scene.schemes.size(); ++i)
            if (scene.schemes[i].isEnabled) {
                const bool isKnown = i < options.known.size() && options.known[i];
                tasks.push_back(
                    std::make_unique<SchemeRun>(resolved, i, plan, isKnown ? options.known[i] : nullptr));
                needsSchemes = needsSchemes || !isKnown;
            }
        reference = options.reference;
        if (scene.reference.kind == ReferenceSpec::Kind::exact && !exactSolution(scene, system, initial))
            throw InvalidScene("/reference", "no exact solution is known for these initial data",
                               "use \"auto\"");
    }

    /// Beside the results, `csv` by scheme.
    void addCheckpoints(const CheckpointPlan& how, const std::vector<std::string>& csv) {
        Value owner;
        owner.set("scene", writeScene(scene));
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            const std::string slug = csv[i].substr(0, csv[i].size() - 4);
            owner.set("scheme", slug);
            checkpoints.push_back(
                std::make_unique<SchemeCheckpoint>(how.folder / (slug + ".checkpoint"), owner, how));
            tasks[i]->setCheckpoint(checkpoints.back().get());
        }
    }

    bool needsReference() const {
        return std::any_of(scene.observe.begin(), scene.observe.end(), [](const std::string& id) {
            const ObservableEntry* entry = findObservable(id);
            return entry && entry->needsReference;
        });
    }

    /// The scene without the schemes whose results are known.
    ResolvedScene unknownPart() const {
        ResolvedScene part = resolved;
        for (const auto& task : tasks)
            if (task->isKnown())
                part.scene.schemes[task->index()].isEnabled = part.schemes[task->index()].spec.isEnabled =
                    false;
        return part;
    }

    void work(const std::stop_token& stop) {
        Reference ref;
        if (scene.reference.kind == ReferenceSpec::Kind::companion) {
            if (needsReference()) {
                ref.info = companionInfo();
                ref.info.description = "each scheme by a better run of its own kind";
            }
        } else if (needsSchemes && needsReference()) {
            isPreparing = true;
            try {
                contained("/reference", [&] {
                    ref = makeReference(resolved, stop);
                    shareReference(ref, unknownPart());
                });
            } catch (const InvalidScene& e) {
                ref.info.problems = e.problems();  // the run goes on without errors
            }
            isPreparing = false;
        }
        if (needsSchemes) {
            const std::lock_guard lock(mutex);
            reference = ref.info;
        }
        const std::shared_ptr<ExactActions> exact = needsSchemes ? exactActionsOf(resolved, plan) : nullptr;
        std::vector<std::size_t> all(tasks.size() + starts.tasks() + maps.tasks());
        std::iota(all.begin(), all.end(), std::size_t{0});
        // A task that has not begun when a stop is requested still reports that it was stopped.
        forEachInPool(all, threads, {}, [&](std::size_t i) {
            if (i < tasks.size()) return tasks[i]->run(ref, exact.get(), stop);
            i -= tasks.size();
            i < starts.tasks() ? starts.run(i, stop) : maps.run(i - starts.tasks(), stop);
        });
        {
            const std::lock_guard lock(mutex);
            isFinished = true;
        }
        isFinished.notify_all();
        finished.notify_all();
    }
};

Run::Run(const Scene& scene, const RunOptions& options) : Run(resolve(scene), options) {}

Run::Run(ResolvedScene scene, const RunOptions& options)
    : impl_(std::make_unique<Impl>(std::move(scene), options)) {
    if (options.checkpoints) impl_->addCheckpoints(*options.checkpoints, csvNames(latest()));
}

Run::~Run() { stop(); }

void Run::start() {
    if (impl_->coordinator.joinable()) return;
    impl_->coordinator =
        std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->work(stop); });
}

void Run::stop() { impl_->coordinator.request_stop(); }

void Run::wait() {
    if (impl_->coordinator.joinable()) impl_->isFinished.wait(false);
}

bool Run::waitFor(std::chrono::milliseconds time) {
    std::unique_lock lock(impl_->mutex);
    return impl_->finished.wait_for(lock, time, [&] { return impl_->isFinished.load(); });
}

bool Run::isFinished() const { return impl_->isFinished; }

Comparison Run::latest() const {
    Comparison c;
    c.scene = impl_->scene;
    c.system = impl_->resolved.system;
    c.isFinished = impl_->isFinished;
    for (const auto& task : impl_->tasks) c.schemes.push_back(task->latest());
    if (impl_->plan.has(Product::parameterMap)) c.products.make<ParameterMaps>().all = impl_->maps.latest();
    if (impl_->starts.tasks() > 0) c.products.make<StartSets>() = impl_->starts.latest();
    const std::lock_guard lock(impl_->mutex);
    c.reference = impl_->reference;
    return c;
}

bool Run::isPreparing() const { return impl_->isPreparing; }

double Run::fraction() const {
    double sum = 0;
    int computed = 0;  // what is known from before does not count as work of this run
    for (const auto& task : impl_->tasks) {
        if (task->isKnown()) continue;
        const auto latest = task->latest();
        const RunStatus status = latest->summary.status;
        const bool isOver = status != RunStatus::waiting && status != RunStatus::running;
        sum += isOver ? 1 : latest->fraction;  // a scheme that has failed has no work left
        ++computed;
    }
    double schemes = computed == 0 ? 1 : sum / computed;
    if (impl_->starts.tasks() > 0) schemes = 0.5 * schemes + 0.5 * impl_->starts.fraction();
    return impl_->maps.tasks() > 0 ? 0.3 * schemes + 0.7 * impl_->maps.fraction() : schemes;
}

bool Run::hasCheckpoints() const {
    return std::any_of(impl_->checkpoints.begin(), impl_->checkpoints.end(),
                       [](const auto& each) { return each->isWritten(); });
}

std::string Run::checkpointFailure() const {
    for (const auto& each : impl_->checkpoints)
        if (!each->failure().empty()) return each->failure();
    return {};
}

void Run::removeCheckpoints() {
    for (const auto& each : impl_->checkpoints) each->remove();
}

Comparison run(const Scene& scene, const RunOptions& options) {
    Run r(scene, options);
    r.start();
    r.wait();
    return r.latest();
}

}  // namespace extremal
